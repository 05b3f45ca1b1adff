#include "judge/comparison.hpp"

#include <cmath>
#include <cstdio>

#include "judge/free_field.hpp"
#include "judge/profile.hpp"
#include "judge/taylor_plate.hpp"
#include "judge/comparison_table.hpp"
#include "judge/metrics.hpp"

namespace undex::judge {
namespace {

const scene::Probe* find_probe(const scene::Scene& scene, const std::string& name) {
  for (const scene::Probe& probe : scene.probes)
    if (probe.name == name) return &probe;
  return nullptr;
}

/// The tube that a probe lies on: the structure, or the nearest solid of such a shape.
std::optional<TubeShape> tube_at(const scene::Scene& scene, const Vec3& point) {
  if (scene.structure)
    if (const auto* t = std::get_if<fem::TubeMesh>(&scene.structure->mesh))
      return TubeShape{t->axis, t->center, t->inner_radius, t->outer_radius, t->low, t->high};
  std::optional<TubeShape> nearest;
  double least = 1e300;
  for (const solid::Body& solid : scene.solids.bodies) {
    const double away = signed_distance(solid.shape, point, scene.fluid.dimension);
    if (const auto* t = std::get_if<TubeShape>(&solid.shape.base); t && away < least) {
      least = away;
      nearest = *t;
    }
  }
  return nearest;
}

/// The component of a vector history along the outward radius at the probe.
output::Series radial(const scene::Scene& scene, const run::Probes& probes, const scene::Probe& probe,
                      const std::string& quantity) {
  const std::optional<TubeShape> tube = tube_at(scene, probe.point);
  Vec3 outward = probe.point - (tube ? tube->center : Vec3::Zero());
  outward[tube ? tube->axis : 2] = 0.0;
  outward.normalize();
  output::Series sum;
  const char* const component[3] = {"_x", "_y", "_z"};
  for (int a = 0; a < 3; ++a) {
    const output::Series part = probes.series(probe.name, quantity + component[a]);
    if (part.empty()) continue;  // a plane scene has no z
    if (sum.empty()) sum = {part.t, std::vector<double>(part.y.size(), 0.0)};
    for (std::size_t k = 0; k < part.y.size(); ++k) sum.y[k] += outward[a] * part.y[k];
  }
  return sum;
}

std::filesystem::path reference_path(const scene::Scene& scene) { return scene.file.parent_path() / scene.comparison.reference; }

output::NamedNumbers rigid_cylinder(const scene::Scene& scene, const run::Probes& probes) {
  output::Series reference;
  if (!scene.comparison.reference.empty()) {
    const std::filesystem::path history = reference_path(scene).parent_path() / "midline_wall_pressure.csv";
    if (std::filesystem::exists(history)) reference = output::read_series(history);
  }
  return output::rigid_cylinder_metrics(probes.series(scene.comparison.probe, "pressure"), reference);
}

/// The compared probe gives displacement and velocity; the first wall probe gives the pressure; the plastic strain is that
/// of another structure probe (mid-wall), or of the compared one.
output::NamedNumbers tube(const scene::Scene& scene, const run::Probes& probes) {
  output::TubeHistories histories;
  const scene::Probe* outer = find_probe(scene, scene.comparison.probe);
  if (outer && outer->kind == scene::Probe::Kind::structure) {
    histories.displacement = radial(scene, probes, *outer, "displacement");
    histories.velocity = radial(scene, probes, *outer, "velocity");
    histories.plastic_strain = probes.series(outer->name, "plastic_strain");
  }
  for (const scene::Probe& probe : scene.probes) {
    if (probe.kind == scene::Probe::Kind::wall && histories.pressure.empty())
      histories.pressure = probes.series(probe.name, "pressure");
    if (probe.kind == scene::Probe::Kind::structure && probe.name != scene.comparison.probe) {
      const output::Series strain = probes.series(probe.name, "plastic_strain");
      if (!strain.empty()) histories.plastic_strain = strain;
    }
  }
  return output::tube_metrics(histories);
}

output::NamedNumbers taylor_bar(const scene::Scene& scene, const run::Simulation& simulation) {
  const auto x = simulation.bodies().front()->positions();
  if (scene.structure) {
    const auto& rod = std::get<fem::RodMesh>(scene.structure->mesh);
    return output::taylor_bar_metrics({x.begin(), x.end()}, rod.axis, rod.center, rod.high - rod.low);
  }
  const solid::Body& body = scene.solids.bodies.front();
  const auto& rod = std::get<Cylinder>(body.shape.base);
  return output::taylor_bar_metrics({x.begin(), x.end()}, rod.axis, rod.center, rod.high - rod.low,
                                    0.5 * body.spacing.value_or(scene.fluid.lattice.spacing));
}

}  // namespace

output::NamedNumbers compare(const scene::Scene& scene, const run::Simulation& simulation, const run::Probes& probes,
                             const std::filesystem::path& folder) {
  if (scene.comparison.kind == "profile") return compare_profile(scene, simulation, folder);
  if (scene.comparison.kind == "rigid_cylinder") return rigid_cylinder(scene, probes);
  if (scene.comparison.kind == "tube") return tube(scene, probes);
  if (scene.comparison.kind == "taylor_bar") return taylor_bar(scene, simulation);
  if (scene.comparison.kind == "taylor_plate") return taylor_plate(scene, probes, simulation.time());
  if (scene.comparison.kind == "free_field") return free_field(scene, probes, simulation.time());
  return {};
}

std::string comparison_table(const scene::Scene& scene, const output::NamedNumbers& metrics) {
  if (scene.comparison.kind == "profile") {
    std::string text;
    char line[120];
    for (const auto& [name, value] : metrics) {
      std::snprintf(line, sizeof line, "%-34s %.5g\n", name.c_str(), value);
      text += line;
    }
    return text;
  }
  if (metrics.empty() || scene.comparison.reference.empty()) return "";
  return output::format_comparison(metrics, output::read_reference_table(reference_path(scene)));
}

}  // namespace undex::judge
