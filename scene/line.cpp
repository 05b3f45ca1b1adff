#include "scene/line.hpp"

#include <algorithm>
#include <cmath>

#include "scene/numbers.hpp"

namespace undex::scene {
namespace {

constexpr int cells_in_core = 400;
constexpr double same = 1e-6;  // share of a length within which two places are one

struct Interval {
  double low, high;
};

/// Cuts an interval out of others.
std::vector<Interval> without(const std::vector<Interval>& all, const Interval& hole) {
  std::vector<Interval> left;
  for (const Interval& one : all) {
    const double tolerance = same * (one.high - one.low);
    if (hole.low > one.low + tolerance) left.push_back({one.low, std::min(one.high, hole.low)});
    if (hole.high < one.high - tolerance) left.push_back({std::max(one.low, hole.high), one.high});
  }
  return left;
}

class Builder {
 public:
  explicit Builder(const Scene& scene) : scene_(scene), spherical_(scene.geometry == Geometry::spherical) {}

  Line build() {
    for (std::size_t i = 0; i < scene_.fluid.bodies.size(); ++i) add(false, i, scene_.fluid.bodies[i].shape);
    for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) add(true, i, scene_.solids.bodies[i].shape);
    if (line_.layers.empty()) return line_;
    join();
    close();
    choose_core();
    look_ahead();
    return line_;
  }

 private:
  void complain(const char* list, std::size_t index, const char* key, const std::string& why) {
    const std::string& name = std::string_view(list) == "bodies"   ? scene_.fluid.bodies[index].name
                              : std::string_view(list) == "solids" ? scene_.solids.bodies[index].name
                                                                   : scene_.fluid.walls[index].name;
    line_.flaws.push_back({list, index, key, std::string(list) + "." + name + why});
  }
  const char* list_of(bool solid) const { return solid ? "solids" : "bodies"; }
  const char* words() const { return spherical_ ? "dimension = \"spherical\"" : "dimension = \"plane\""; }

  /// A sphere about the common middle as the interval of its radii.
  bool is_concentric(const Primitive& shape, Interval& interval) {
    const auto* sphere = std::get_if<Sphere>(&shape);
    if (!sphere) return false;
    if (!has_center_) line_.center = sphere->center;
    has_center_ = true;
    interval = {0.0, sphere->radius};
    return (sphere->center - line_.center).norm() <= same * sphere->radius;
  }

  void add(bool solid, std::size_t index, const Shape& shape) {
    Interval base{0, 0};
    if (spherical_) {
      if (!is_concentric(shape.base, base))
        return complain(list_of(solid), index, "shape",
                        std::string(".shape: with ") + words() + " bodies are spheres about one middle, less smaller ones");
      for (int a = 0; a < 3; ++a)
        if (scene_.fluid.symmetry.axis[a] && std::abs(line_.center[a]) > same * base.high)
          return complain(list_of(solid), index, "shape", ".shape: its middle must lie on every symmetry plane");
    } else {
      const Bounds extent = bounds(shape.base, 1);
      base = {extent.low[0], extent.high[0]};
      if (!(base.high - base.low < 1e200))
        return complain(list_of(solid), index, "shape", ".shape has no end along x; take a box instead of a slab");
    }
    std::vector<Interval> kept{base};
    for (const Primitive& removed : shape.removed) {
      Interval hole{0, 0};
      if (spherical_) {
        if (!is_concentric(removed, hole))
          return complain(list_of(solid), index, "subtract",
                          std::string(".subtract: with ") + words() + " what is taken out are spheres about the common middle");
      } else {
        const Bounds extent = bounds(removed, 1);
        hole = {extent.low[0], extent.high[0]};
      }
      kept = without(kept, hole);
    }
    if (!spherical_ && scene_.fluid.symmetry.axis[0]) kept = without(kept, {-1e300, 0.0});
    if (kept.empty()) return complain(list_of(solid), index, "shape", ": nothing is left of it");
    for (const Interval& one : kept) line_.layers.push_back({solid, index, one.low, one.high});
  }

  /// Sorts the layers and lets each begin where the last ends.
  void join() {
    std::sort(line_.layers.begin(), line_.layers.end(), [](const auto& a, const auto& b) { return a.inner < b.inner; });
    for (std::size_t k = 1; k < line_.layers.size(); ++k) {
      const LineLayer& below = line_.layers[k - 1];
      LineLayer& layer = line_.layers[k];
      const double gap = layer.inner - below.outer;
      const double tolerance = same * std::min(layer.outer - layer.inner, below.outer - below.inner);
      if (std::abs(gap) > tolerance)
        complain(list_of(layer.is_solid), layer.index, "shape",
                 std::string(gap > 0 ? ": there is nothing between " : ": something else lies between ") +
                     rounded(std::min(layer.inner, below.outer)) + " and " + rounded(std::max(layer.inner, below.outer)) +
                     " m, but with " + words() + " layers touch and do not overlap; " +
                     (gap > 0 ? "fill the gap with a gas, or let them touch" : "subtract the one from the other"));
      layer.inner = below.outer;
    }
  }

  void close() {
    const double length = line_.outer() - line_.inner();
    if (spherical_) line_.closed[0] = line_.inner() == 0.0;
    else line_.closed[0] = scene_.fluid.symmetry.axis[0] && line_.inner() <= same * length;
    for (std::size_t w = 0; w < scene_.fluid.walls.size(); ++w) close_by(scene_.fluid.walls[w], w);
  }

  void close_by(const sph::Wall& wall, std::size_t index) {
    const auto is_open = [&](const std::string& face) {
      const auto found = wall.faces.find(face);
      return found != wall.faces.end() && found->second == sph::FaceCondition::open;
    };
    const auto radiates = [&](const std::string& face) {
      const auto found = wall.faces.find(face);
      return found != wall.faces.end() && found->second == sph::FaceCondition::radiating;
    };
    const auto meet = [&](const std::string& face, int end, double place) {
      if (is_open(face)) return;
      const double edge = end == 0 ? line_.inner() : line_.outer();
      if (end == 0 && line_.closed[0]) return;
      if (std::abs(place - edge) <= same * (line_.outer() - line_.inner())) {
        (radiates(face) ? line_.radiating : line_.closed)[end] = true;
        const LineLayer& layer = end == 0 ? line_.layers.front() : line_.layers.back();
        if (radiates(face) &&
            (layer.is_solid || std::holds_alternative<materials::Jwl>(scene_.fluid.bodies[layer.index].material.law)))
          complain("walls", index, "condition",
                   ": the layer at its radiating face \"" + face +
                       "\" is no fluid at rest; let water (or a gas) end there, or take another condition");
      } else
        complain("walls", index, "shape",
                 ".shape: its face \"" + face + "\" lies at " + rounded(place) + " m, and the outermost layer ends at " +
                     rounded(edge) + " m; let them meet, or open the face: a layer that comes to a wall later is not built");
    };
    if (spherical_) {
      Interval radii{0, 0};
      if (!is_concentric(wall.container, radii))
        return complain("walls", index, "shape", ".shape must be a sphere about the common middle");
      return meet("side", 1, radii.high);
    }
    const Bounds extent = bounds(wall.container, 1);
    const bool box = std::holds_alternative<Box>(wall.container);
    if (!box) return complain("walls", index, "shape", std::string(".shape: with ") + words() + " a wall is a box");
    meet("x_low", 0, extent.low[0]);
    meet("x_high", 1, extent.high[0]);
  }

  void choose_core() {
    const auto is_charge = [&](const LineLayer& layer) {
      return !layer.is_solid && std::holds_alternative<materials::Jwl>(scene_.fluid.bodies[layer.index].material.law);
    };
    const auto charge = std::find_if(line_.layers.begin(), line_.layers.end(), is_charge);
    const bool found = charge != line_.layers.end();
    const LineLayer& core = found ? *charge : line_.layers.front();
    line_.core_low = core.inner;
    line_.core_high = core.outer;
    line_.graded = line_.layers.size() > 1 && (spherical_ || found);
  }

  /// At the start [Pa].
  double pressure_of(const LineLayer& layer) const {
    if (layer.is_solid) return scene_.fluid.surroundings.pressure;
    const sph::Body& body = scene_.fluid.bodies[layer.index];
    return std::visit([&](const auto& law) { return law.evaluate(start_density(body), start_energy(body)).pressure; },
                      body.material.law);
  }
  bool rests(const LineLayer& layer) const {
    if (layer.is_solid) return !scene_.solids.bodies[layer.index].moves();
    const sph::Body& body = scene_.fluid.bodies[layer.index];
    return !body.start && !body.burn && !body.moves();
  }

  void look_ahead() {
    const LineLayer& last = line_.layers.back();
    line_.outside_pressure = scene_.fluid.surroundings.pressure;
    if (line_.outside_pressure == 0 && spherical_ && line_.layers.size() > 1 && last.inner >= line_.core_high)
      line_.outside_pressure = pressure_of(last);
    double before = 0;
    bool ahead = false, balanced = true;
    for (const LineLayer& layer : line_.layers) {
      const double p = pressure_of(layer);
      if (layer.inner == line_.core_low) line_.held = 1e-3 * std::abs(p);
      if (layer.inner < line_.core_high) continue;
      balanced = balanced && rests(layer) && (!ahead || std::abs(p - before) <= line_.held);
      ahead = true;
      before = p;
    }
    if (ahead && !line_.closed[1] && !line_.radiating[1])
      balanced = balanced && std::abs(before - line_.outside_pressure) <= line_.held;
    // The front sets out a cell ahead of the contact: a shock catches up with it, sound never would.
    constexpr double least_of_a_shock = 1e9;  // in the core [Pa]
    line_.rests_ahead = ahead && balanced && scene_.fluid.gravity.isZero() && 1e3 * line_.held >= least_of_a_shock;
  }

  const Scene& scene_;
  bool spherical_, has_center_ = false;
  Line line_;
};

}  // namespace

double Line::cell_width(double place, double spacing) const {
  if (!graded) return spacing;
  const double away = std::max({0.0, core_low - place, place - core_high});
  return spacing * std::pow(1.0 + 0.5 * away / (core_high - core_low), 0.25);
}

double Line::front_width(double place, double spacing) const {
  const double away = std::max(0.0, place - core_high) / (core_high - core_low);
  return spacing * std::min(4.0, 1.0 + 4.0 * away) * std::pow(1.0 + 0.05 * away, 0.25);
}

Line line_of(const Scene& scene) { return Builder(scene).build(); }

double default_spacing(const Line& line) { return (line.core_high - line.core_low) / cells_in_core; }

}  // namespace undex::scene
