#include "run/validity.hpp"

#include <algorithm>
#include <cstdio>

#include "materials/pedigree.hpp"
#include "scene/numbers.hpp"

namespace undex::run {
namespace {

constexpr double margin = 1.05;  // the sets' own pressures are round numbers

std::string gigapascals(double pressure) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g GPa", 1e-9 * pressure);
  return text;
}

}  // namespace

std::vector<std::string> beyond_validity(const scene::Scene& scene, const std::vector<output::LargestRecord>& largest) {
  std::vector<std::string> found;
  const auto look = [&](const std::string& table, const std::string& name, const std::string& material) {
    const auto pedigree = materials::find_pedigree(material);
    const auto most = std::find_if(largest.begin(), largest.end(), [&](const output::LargestRecord& each) {
      return each.part == name && each.quantity == "pressure";
    });
    if (!pedigree || most == largest.end() || !(most->value > margin * pedigree->valid_to)) return;
    std::string place;
    for (double x : most->place) place += (place.empty() ? "" : ", ") + scene::rounded(x);
    char time[40];
    std::snprintf(time, sizeof time, "%.3g s", most->time_s);
    found.push_back(table + "." + name + " reached " + gigapascals(most->value) + " at (" + place + ") m, " + time +
                    ", beyond the " + gigapascals(pedigree->valid_to) + " to which '" + material +
                    "' may be used; 'undex materials --kind " + pedigree->kind + "' shows sets that go further");
  };
  for (const sph::Body& body : scene.fluid.bodies) look("bodies", body.name, body.material.name);
  for (const solid::Body& body : scene.solids.bodies) look("solids", body.name, body.material.name);
  return found;
}

}  // namespace undex::run
