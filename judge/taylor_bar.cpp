#include "judge/taylor_bar.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "judge/comparisons.hpp"
#include "scene/table_reader.hpp"

namespace undex::judge {
namespace {

void check_taylor_bar(const scene::TableReader& table, const scene::Scene& scene) {
  const auto& solids = scene.solids.bodies;
  const fem::Settings* structure = scene.only_structure();
  const bool rod = structure ? std::holds_alternative<fem::RodMesh>(structure->mesh)
                             : !solids.empty() && std::holds_alternative<Cylinder>(solids[0].shape.base);
  if (!rod)
    table.complain("kind",
                   "comparison.kind = \"taylor_bar\" compares the shape of a [structure] of type \"rod\", or of the first "
                   "of [[solids]], a cylinder; there is none");
}

std::vector<std::string> last_fields_of_taylor_bar(const scene::Scene&) { return {"body.position"}; }

Verdict judge_taylor_bar(const scene::Scene& scene, const output::Evidence& evidence, const Reference&) {
  const std::vector<Vec3> points = evidence.field(last_fields_of_taylor_bar(scene)[0]).vectors();
  if (const fem::Settings* structure = scene.only_structure()) {
    const auto& rod = std::get<fem::RodMesh>(structure->mesh);
    return {.metrics = taylor_bar_metrics(points, rod.axis, rod.center, rod.high - rod.low)};
  }
  const solid::Body& body = scene.solids.bodies.front();
  const auto& rod = std::get<Cylinder>(body.shape.base);
  return {.metrics = taylor_bar_metrics(points, rod.axis, rod.center, rod.high - rod.low,
                                        0.5 * body.spacing.value_or(scene.fluid.lattice.spacing))};
}

}  // namespace

output::NamedNumbers taylor_bar_metrics(const std::vector<Vec3>& points, int axis, const Vec3& center, double initial_length,
                                        double skin) {
  double low = forever, high = -forever;
  for (const Vec3& x : points) {
    low = std::min(low, x[axis] - skin);
    high = std::max(high, x[axis] + skin);
  }
  struct Widest {
    double height = nan, radius = -forever;
  };
  const auto widest = [&](double from, double to) {
    Widest found;
    for (const Vec3& x : points) {
      const double height = x[axis] - low;
      const double radius =
          std::hypot(x[(axis + 1) % 3] - center[(axis + 1) % 3], x[(axis + 2) % 3] - center[(axis + 2) % 3]) + skin;
      if (height >= from && height <= to && radius > found.radius) found = {height, radius};
    }
    return found;
  };
  const double fifth = 0.2 * initial_length, slice = 0.05 * initial_length;
  const Widest foot = widest(0.0, 0.1 * initial_length), below = widest(fifth - slice, fifth),
               above = widest(fifth, fifth + slice);
  double radius = nan;
  if (std::isfinite(below.radius) && std::isfinite(above.radius)) {
    const double gap = above.height - below.height;
    radius = gap > 0 ? below.radius + (fifth - below.height) / gap * (above.radius - below.radius) : below.radius;
  }
  return {{"final_length_m", points.empty() ? nan : high - low},
          {"foot_radius_m", std::isfinite(foot.radius) ? foot.radius : nan},
          {"radius_at_fifth_m", radius}};
}

Comparison taylor_bar() {
  return {.kind = {.name = "taylor_bar", .check = check_taylor_bar},
          .title = "shape of a bar that has hit an anvil",
          .last_fields = last_fields_of_taylor_bar,
          .judge = judge_taylor_bar};
}

}  // namespace undex::judge
