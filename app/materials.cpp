// The library of materials as text, for people and for programs.
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

#include "app/commands.hpp"
#include "core/errors.hpp"
#include "materials/burn.hpp"
#include "materials/library.hpp"
#include "materials/pedigree.hpp"
#include "scene/suggestion.hpp"

namespace undex::app {
namespace {

using namespace materials;

/// A set as it is shown.
struct Sheet {
  Pedigree pedigree;
  std::string source;
  std::vector<std::pair<std::string, std::string>> laws;  ///< what the law is of, and its name
  std::vector<std::pair<std::string, double>> constants;  ///< "B [Pa]"
  std::optional<ChapmanJouguet> own;                      ///< of an explosive
};

Sheet sheet_of(const Fluid& fluid) {
  Sheet sheet{*find_pedigree(fluid.name), fluid.source, {}, parameters(fluid), {}};
  sheet.laws.emplace_back("law", std::visit([](const auto& law) { return law.name; }, fluid.law));
  if (const auto* products = std::get_if<Jwl>(&fluid.law)) sheet.own = chapman_jouguet(*products);
  return sheet;
}

Sheet sheet_of(const Solid& solid) {
  Sheet sheet{*find_pedigree(solid.name), solid.source, {}, parameters(solid), {}};
  const auto name = [](const auto& law) { return law.name; };
  sheet.laws.emplace_back("pressure", std::visit(name, solid.pressure));
  sheet.laws.emplace_back("flow", std::visit(name, solid.flow));
  if (solid.damage) sheet.laws.emplace_back("damage", "johnson_cook");
  return sheet;
}

std::vector<Sheet> all_sheets() {
  std::vector<Sheet> sheets;
  for (const std::string& name : fluid_names()) sheets.push_back(sheet_of(*find_fluid(name)));
  for (const std::string& name : solid_names()) sheets.push_back(sheet_of(*find_solid(name)));
  return sheets;
}

/// The sheets that are asked for. Throws UsageError where there are none.
std::vector<Sheet> chosen(const MaterialsArguments& arguments) {
  std::vector<Sheet> some;
  std::vector<std::string> names, kinds;
  for (Sheet& sheet : all_sheets()) {
    const Pedigree& pedigree = sheet.pedigree;
    names.push_back(pedigree.name);
    if (kinds.empty() || kinds.back() != pedigree.kind) kinds.push_back(pedigree.kind);
    if (!arguments.name.empty() && arguments.name != pedigree.name) continue;
    if (!arguments.kind.empty() && arguments.kind != pedigree.kind) {
      if (!arguments.name.empty()) throw UsageError("'" + pedigree.name + "' is of the kind " + pedigree.kind);
      continue;
    }
    some.push_back(std::move(sheet));
  }
  if (!some.empty()) return some;
  if (!arguments.name.empty())
    throw UsageError("no material '" + arguments.name + "'" + scene::suggestion(arguments.name, names));
  throw UsageError("no kind '" + arguments.kind + "'" + scene::suggestion(arguments.kind, kinds));
}

std::string number(double value, const char* format = "%.6g") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string pressure(double value) {
  if (std::abs(value) >= 1e9) return number(value * 1e-9) + " GPa";
  if (std::abs(value) >= 1e6) return number(value * 1e-6) + " MPa";
  return number(value) + " Pa";
}

/// Words after each other in lines of at most 118 characters.
void print_words(const std::vector<std::string>& words) {
  std::printf(" ");
  std::size_t column = 1;
  for (const std::string& word : words) {
    if (column + 1 + word.size() > 118) {
      std::printf("\n ");
      column = 1;
    }
    std::printf(" %s", word.c_str());
    column += 1 + word.size();
  }
  std::printf("\n");
}

/// "D is 4 % off", or nothing.
std::string disagreement(const char* name, const std::optional<double>& listed, double own) {
  if (!listed || std::abs(*listed / own - 1) <= agreement) return "";
  return std::string(name) + " is " + number(100 * std::abs(*listed / own - 1), "%.0f") + " % off";
}

void print_detonation(const Sheet& sheet) {
  const ChapmanJouguet& own = *sheet.own;
  const Pedigree& pedigree = sheet.pedigree;
  const auto beside = [](const std::optional<double>& listed, double unit) {
    return listed ? " (listed " + number(*listed * unit) + ")" : std::string(" (none listed)");
  };
  std::printf("  own Chapman-Jouguet state: D = %.0f m/s%s, p = %.2f GPa%s, rho/rho0 = %.4f, u = %.0f m/s\n",
              own.detonation_speed, beside(pedigree.listed_D, 1).c_str(), own.pressure * 1e-9,
              beside(pedigree.listed_p_cj, 1e-9).c_str(), own.detonation_speed / (own.detonation_speed - own.particle_speed),
              own.particle_speed);
  if (is_verified(pedigree, own)) return;
  const std::string speed = disagreement("D", pedigree.listed_D, own.detonation_speed);
  const std::string front = disagreement("p_cj", pedigree.listed_p_cj, own.pressure);
  std::printf("  UNVERIFIED: %s%s%s\n", speed.c_str(), speed.empty() || front.empty() ? "" : ", ", front.c_str());
}

void print(const Sheet& sheet) {
  const Pedigree& pedigree = sheet.pedigree;
  std::printf("%s\n  %s\n", pedigree.name.c_str(), sheet.source.c_str());
  std::string laws;
  for (const auto& [of, law] : sheet.laws) laws += ", " + of + " \"" + law + '"';
  std::printf("  %s%s; grade %s; for %s to %s\n  checked: %s\n", pedigree.kind.c_str(), laws.c_str(), pedigree.grade.c_str(),
              pressure(pedigree.valid_from).c_str(), pressure(pedigree.valid_to).c_str(), pedigree.checked.c_str());
  std::vector<std::string> constants;
  for (const auto& [name, value] : sheet.constants) constants.push_back(name + " = " + number(value) + ';');
  print_words(constants);
  if (sheet.own) print_detonation(sheet);
  std::printf("\n");
}

nlohmann::ordered_json json(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

nlohmann::ordered_json json(const Sheet& sheet) {
  const Pedigree& pedigree = sheet.pedigree;
  nlohmann::ordered_json all{{"name", pedigree.name},
                             {"kind", pedigree.kind},
                             {"source", sheet.source},
                             {"grade", pedigree.grade},
                             {"checked", pedigree.checked}};
  all["valid"] = {pedigree.valid_from, pedigree.valid_to};
  for (const auto& [of, law] : sheet.laws) all["laws"][of] = law;
  for (const auto& [name, value] : sheet.constants) all["constants"][name] = value;
  if (!sheet.own) return all;
  all["listed"] = {{"D", json(pedigree.listed_D)}, {"p_cj", json(pedigree.listed_p_cj)}};
  all["chapman_jouguet"] = {{"D", sheet.own->detonation_speed},
                            {"p_cj", sheet.own->pressure},
                            {"density", sheet.own->density},
                            {"particle_speed", sheet.own->particle_speed}};
  all["verified"] = is_verified(pedigree, *sheet.own);
  return all;
}

}  // namespace

int print_materials(const MaterialsArguments& arguments) {
  const std::vector<Sheet> sheets = chosen(arguments);
  if (arguments.json) {
    auto all = nlohmann::ordered_json::array();
    for (const Sheet& sheet : sheets) all.push_back(json(sheet));
    std::printf("%s\n", all.dump(2).c_str());
    return exit_done;
  }
  for (const Sheet& sheet : sheets) print(sheet);
  return exit_done;
}

}  // namespace undex::app
