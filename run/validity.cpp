#include "run/validity.hpp"

#include <algorithm>
#include <cstdio>

#include "scene/numbers.hpp"
#include "scene/plausible.hpp"

namespace undex::run {

std::vector<std::string> beyond_validity(const scene::Scene& scene, const std::vector<output::LargestRecord>& largest) {
  std::vector<std::string> found;
  const auto look = [&](const std::string& table, const std::string& name, const std::string& material) {
    const auto most = std::find_if(largest.begin(), largest.end(), [&](const output::LargestRecord& each) {
      return each.part == name && each.quantity == "pressure";
    });
    if (most == largest.end()) return;
    const std::string beyond = scene::beyond_set(material, most->value);
    if (beyond.empty()) return;
    char value[40], time[40];
    std::snprintf(value, sizeof value, "%.3g GPa", 1e-9 * most->value);
    std::snprintf(time, sizeof time, "%.3g s", most->time_s);
    std::string place;
    for (double x : most->place) place += (place.empty() ? "" : ", ") + scene::rounded(x);
    found.push_back(table + "." + name + " reached " + value + " at (" + place + ") m, " + time + ", " + beyond);
  };
  for (const sph::Body& body : scene.fluid.bodies) look("bodies", body.name, body.material.name);
  for (const solid::Body& body : scene.solids.bodies) look("solids", body.name, body.material.name);
  return found;
}

}  // namespace undex::run
