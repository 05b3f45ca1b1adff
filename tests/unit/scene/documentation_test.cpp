// docs/reference/scene-file.md names every key, with its unit, and its examples are good scenes.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "materials/library.hpp"
#include "scene/key_tables.hpp"
#include "scene/numbers.hpp"
#include "scene/schema.hpp"
#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene;
using namespace undex::scene::test;

std::string page() {
  std::ifstream file(std::string(UNDEX_ROOT) + "/docs/reference/scene-file.md");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Documentation, NamesEveryKeyWithItsUnit) {
  const std::string text = page();
  for (const Section& section : schema())
    for (const Key& key : section.keys) {
      bool found = false;
      for (auto at = text.find(std::string("`") + key.name + '`'); at != std::string::npos && !found;
           at = text.find(std::string("`") + key.name + '`', at + 1)) {
        const auto begin = text.rfind('\n', at) + 1;
        const std::string line = text.substr(begin, text.find('\n', at) - begin);
        found = !*key.unit || line.find(std::string("| ") + key.unit + " |") != std::string::npos;
      }
      EXPECT_TRUE(found) << "[" << section.name << "] " << key.name << " [" << key.unit << "]";
    }
}

TEST(Documentation, NumericDefaultsAreThoseOfTheSettings) {
  const std::string text = page();
  const auto part = [&](const std::string& heading) {
    const auto begin = text.find("\n## " + heading);
    return text.substr(begin, text.find("\n## ", begin + 1) - begin);
  };
  const sph::Numerics numerics;
  const fem::Settings structure{};
  const coupling::Settings coupling;
  const auto expect = [&](const std::string& heading, const std::string& key, double value) {
    const std::string row = "\n| `" + key + "` | - | " + shortest(value);
    const auto at = part(heading).find(row);
    EXPECT_TRUE(at != std::string::npos && std::string(" ;").find(part(heading)[at + row.size()]) != std::string::npos)
        << heading << " " << key << ": " << value;
  };
  expect("[scheme]", "eta", numerics.eta);
  expect("[scheme]", "alpha", numerics.alpha);
  expect("[scheme]", "beta", numerics.beta);
  expect("[scheme]", "alpha_min", numerics.alpha_min);
  expect("[scheme]", "courant", numerics.courant);
  expect("[scheme]", "signal", numerics.signal);
  expect("[scheme]", "h_low", numerics.h_low);
  expect("[scheme]", "h_high", numerics.h_high);
  expect("[structure]", "courant", structure.courant);
  expect("[structure]", "linear_viscosity", structure.linear_viscosity);
  expect("[structure]", "quadratic_viscosity", structure.quadratic_viscosity);
  const solid::Numerics solids;
  expect("[solid_scheme]", "eta", solids.eta);
  expect("[solid_scheme]", "courant", solids.courant);
  expect("[solid_scheme]", "linear_viscosity", solids.linear_viscosity);
  expect("[solid_scheme]", "quadratic_viscosity", solids.quadratic_viscosity);
  expect("[solid_scheme]", "hourglass", solids.hourglass);
  expect("[solid_scheme]", "alpha", solids.alpha);
  expect("[solid_scheme]", "beta", solids.beta);
  expect("[solid_scheme]", "artificial_stress", solids.artificial_stress);
  expect("[coupling]", "window", coupling.window);
  EXPECT_NE(part("[scheme]")
                .find(numerics.scheme == sph::SchemeName::riemann ? "`name` | - | \"riemann\"" : "`name` | - | \"monaghan\""),
            std::string::npos);
}

TEST(Documentation, TablesAreThoseOfTheRecords) {
  const std::string text = page();
  EXPECT_EQ(with_key_tables(text, "the page"), text) << "write them anew: undex keys docs/reference/scene-file.md";
}

TEST(Documentation, MarksOfATableMustBeSound) {
  const auto refused = [](const std::string& text) {
    try {
      with_key_tables(text, "page.md");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused("<!-- table: scheme -->\n<!-- end -->\n"), "");
  EXPECT_NE(refused("<!-- table: schema -->\n<!-- end -->\n").find("page.md: there is no table 'schema'"), std::string::npos);
  EXPECT_NE(refused("<!-- table: scheme -->\n").find("must be <!-- table: name --> on a line of its own"), std::string::npos);
  EXPECT_EQ(with_key_tables("no marks", ""), "no marks");
}

TEST(Documentation, ExamplesAreGoodScenes) {
  const std::string text = page();
  int count = 0;
  for (auto at = text.find("```toml\n"); at != std::string::npos; at = text.find("```toml\n", at + 1)) {
    const auto begin = at + 8;
    const std::string example = text.substr(begin, text.find("```", begin) - begin);
    if (example.find("end_time") == std::string::npos) continue;  // a fragment
    ++count;
    EXPECT_EQ(mistakes(example), "") << example;
  }
  EXPECT_GE(count, 5);
}

}  // namespace
