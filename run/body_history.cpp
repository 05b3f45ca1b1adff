#include "run/body_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace undex::run {
namespace {

constexpr long steps_a_row = 10, steps_a_row_on_a_line = 50;  // there a row costs as much as two steps
constexpr double turned = 0.01;                               // share of its radius by which a bubble has turned

bool is_liquid(const sph::Body& body) { return !materials::is_gas(body.material.law); }

/// Does a volume of the scene have the radius of a sphere, or of a circle?
bool has_radius(const scene::Scene& scene) { return scene.fluid.dimension > 1 && scene.geometry != scene::Geometry::plane; }

double radius_of(double volume, const scene::Scene& scene) {
  return scene.fluid.dimension == 3 ? std::cbrt(0.75 * volume / std::numbers::pi) : std::sqrt(volume / std::numbers::pi);
}

int centre_components(const scene::Scene& scene) { return scene.geometry == scene::Geometry::plane ? 1 : scene.fluid.dimension; }

std::vector<output::Column> columns_of(const scene::Scene& scene) {
  std::vector<output::Column> columns{{"time", "s"}};
  for (const sph::Body& body : scene.fluid.bodies) {
    const auto add = [&](const std::string& name, const char* unit) { columns.push_back({body.name + '.' + name, unit}); };
    add("volume", "m3");
    if (has_radius(scene)) add("radius", "m");
    for (int a = 0; a < centre_components(scene); ++a) add(std::string("centre_") + "xyz"[a], "m");
    add("pressure", "Pa");
    add("kinetic", "J");
    add("internal", "J");
    if (!is_liquid(body)) continue;
    add("cavitated_volume", "m3");
    add("void_volume", "m3");
  }
  return columns;
}

}  // namespace

BodyHistory::BodyHistory(const scene::Scene& scene, const std::filesystem::path& folder, bool goes_on)
    : scene_(scene),
      wanted_(scene.output.wants("bodies") && !scene.fluid.bodies.empty()),
      path_(folder / "bodies.csv"),
      samples_(wanted_ ? columns_of(scene) : std::vector<output::Column>{}) {
  if (wanted_ && !goes_on) history_.emplace(path_, samples_.columns);
}

void BodyHistory::visit_state(StateVisitor& state) {
  bool known = wanted_;  // by the checkpoint
  state("wanted", known);
  state("calls", calls_);
  if (known && wanted_) {
    samples_.visit_state(state);
  } else if (known) {
    output::Samples passed_over(columns_of(scene_));
    passed_over.visit_state(state);
  }
  if (wanted_ && state.restores()) history_.emplace(output::History::continued(path_, samples_));
}

void BodyHistory::sample(const Simulation& simulation) {
  if (!wanted_) return;
  const bool at_end = simulation.time() >= scene_.end_time * (1 - 1e-12);
  if (calls_++ % (simulation.line() ? steps_a_row_on_a_line : steps_a_row) != 0 && scene_.output.history_interval == 0 && !at_end)
    return;
  std::vector<double> row{simulation.time()};
  const std::vector<sph::BodyTotals> all = simulation.body_totals();
  for (std::size_t b = 0; b < all.size(); ++b) {
    const sph::BodyTotals& one = all[b];
    row.push_back(one.volume);
    if (has_radius(scene_)) row.push_back(radius_of(one.volume, scene_));
    const Vec3 centre = one.moment / one.mass;
    row.insert(row.end(), centre.data(), centre.data() + centre_components(scene_));
    row.insert(row.end(), {one.pressure_volume / one.volume, one.kinetic, one.internal});
    if (is_liquid(scene_.fluid.bodies[b])) row.insert(row.end(), {one.cavitated, one.voids});
  }
  history_->append(row);
  samples_.append(row);
}

void BodyHistory::flush() {
  if (history_) history_->flush();
}

std::vector<output::BubbleRecord> BodyHistory::bubbles() const {
  const auto& bodies = scene_.fluid.bodies;
  std::vector<output::BubbleRecord> all;
  if (!wanted_ || !has_radius(scene_) || std::none_of(bodies.begin(), bodies.end(), is_liquid)) return all;
  for (const sph::Body& body : bodies) {
    if (is_liquid(body)) continue;
    all.push_back(bubble_of(samples_.series(body.name + ".radius")));
    all.back().body = body.name;
  }
  return all;
}

output::BubbleRecord bubble_of(const output::Series& radius) {
  const auto& [t, r] = radius;
  output::BubbleRecord found;
  if (r.empty()) return found;
  const std::size_t top = std::size_t(std::max_element(r.begin(), r.end()) - r.begin());
  const auto shrunk = std::find_if(r.begin() + long(top), r.end(), [&](double now) { return now < (1.0 - turned) * r[top]; });
  if (shrunk == r.end()) {
    found.missing = "the run ends before the bubble has shrunk by a hundredth from its largest radius; take a larger end_time";
    return found;
  }
  found.largest_radius_m = r[top];
  found.largest_radius_time_s = t[top];
  std::size_t least = std::size_t(shrunk - r.begin());
  for (std::size_t i = least; i < r.size(); ++i) {
    if (r[i] < r[least]) least = i;
    if (r[i] <= (1.0 + turned) * r[least]) continue;
    found.least_radius_m = r[least];
    found.period_s = t[least];
    return found;
  }
  found.missing = "the run ends before the bubble's first minimum; take a larger end_time";
  return found;
}

}  // namespace undex::run
