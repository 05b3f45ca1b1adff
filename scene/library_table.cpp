#include "scene/library_table.hpp"

#include <cmath>
#include <cstdio>

#include "materials/burn.hpp"
#include "materials/library.hpp"
#include "materials/pedigree.hpp"

namespace undex::scene {
namespace {

using namespace materials;

std::string row(const std::string& name, const std::string& law, double rho0, const std::string& detonation) {
  const Pedigree pedigree = *find_pedigree(name);
  char numbers[80];
  std::snprintf(numbers, sizeof numbers, " | %.6g | %s | %.4g | ", rho0, pedigree.grade.c_str(), pedigree.valid_to * 1e-9);
  return "| `" + name + "` | " + pedigree.kind + " | " + law + numbers + detonation + " |\n";
}

std::string detonation_of(const Fluid& fluid) {
  const auto* products = std::get_if<Jwl>(&fluid.law);
  if (!products) return "-";
  const ChapmanJouguet own = chapman_jouguet(*products);
  char text[80];
  std::snprintf(text, sizeof text, "%.0f, %.2f%s", own.detonation_speed, own.pressure * 1e-9,
                is_verified(*find_pedigree(fluid.name), own) ? "" : " (unverified)");
  return text;
}

}  // namespace

std::string library_table() {
  std::string table =
      "| name | kind | law | rho0 kg/m^3 | grade | up to GPa | own D m/s, p_cj GPa |\n|---|---|---|---|---|---|---|\n";
  const auto name_of = [](const auto& law) { return law.name; };
  for (const std::string& name : fluid_names()) {
    const Fluid fluid = *find_fluid(name);
    table += row(name, std::visit(name_of, fluid.law), fluid.rho0, detonation_of(fluid));
  }
  for (const std::string& name : solid_names()) {
    const Solid solid = *find_solid(name);
    std::string law = std::visit(name_of, solid.pressure);
    law += std::string(", ") + std::visit(name_of, solid.flow) + (solid.damage ? ", damage" : "");
    table += row(name, law, solid.rho0, "-");
  }
  return table;
}

}  // namespace undex::scene
