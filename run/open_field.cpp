#include "run/open_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/undisturbed.hpp"
#include "scene/opened.hpp"

namespace undex::run {
namespace {

constexpr int cells_in_charge = 400;
constexpr double endless = std::numeric_limits<double>::infinity();

/// The scene's charge in its medium alone, which has no end.
scene::Scene open_water(const scene::Scene& scene, const Sphere& charge, std::size_t charge_index, std::size_t medium_index) {
  scene::Scene open = scene;
  open.fluid.walls.clear();
  open.obstacles.clear();
  open.solids.bodies.clear();
  open.structures.clear();
  sph::Body medium = scene.fluid.bodies[medium_index];
  medium.shape.base = Sphere{charge.center, 2.0 * scene::endless};
  std::erase_if(medium.shape.removed, [&](const Primitive& hole) {
    const auto* other = std::get_if<Sphere>(&hole);
    return !other || other->center != charge.center || other->radius != charge.radius;
  });
  open.fluid.bodies = {scene.fluid.bodies[charge_index], medium};
  return open;
}

}  // namespace

OpenField::OpenField(const scene::Scene& scene, const std::filesystem::path& folder, bool goes_on) {
  if (!scene.output.wants("one_dimensional")) return;
  const std::size_t charge = charge_of(scene), medium = medium_of(scene, charge);
  const Sphere sphere = std::get<Sphere>(scene.fluid.bodies[charge].shape.base);
  const std::vector<Undisturbed> others = not_shared_by(scene, open_water(scene, sphere, charge, medium));
  const auto distance = [&](const Vec3& x) {
    double least = endless;
    for (const Undisturbed& other : others) least = std::min(least, std::max(0.0, other.distance(x)));
    for (int a = 0; a < 3; ++a)  // a plane beside the charge mirrors it
      if (scene.fluid.symmetry.axis[a] && sphere.center[a] > 0.0) least = std::min(least, std::abs(x[a]));
    return least;
  };
  echo_ = distance(sphere.center);
  // A probe averages over the particles within 2.4 spacings (Fluid::at).
  const double averaged = on_a_line(scene.geometry) ? 0.0 : 2.4 * scene.fluid.lattice.spacing;
  double farthest = 0;
  for (const scene::Probe& probe : scene.probes) {
    if (probe.kind != scene::Probe::Kind::fluid) continue;
    Place& place = places_.emplace_back();
    place.name = probe.name + "_1d";
    place.radius = (probe.point - sphere.center).norm();
    place.away = std::max(0.0, distance(probe.point) - averaged);
    place.end = endless;
    place.path = folder / "history" / (place.name + ".csv");
    place.samples = output::Samples({{"time", "s"}, {"pressure", "Pa"}});
    farthest = std::max(farthest, place.radius);
    if (!goes_on) place.history.emplace(place.path, place.samples.columns);
  }
  if (places_.empty()) return;
  const double way = std::max({2.0 * farthest, 4.0 * sphere.radius, std::isfinite(echo_) ? 1.1 * echo_ : 0.0});
  flow_.emplace(scene, way, cells_in_charge);
}

void OpenField::visit_state(StateVisitor& state) {
  std::string known;  // names, each with a line's end
  for (const Place& place : places_) known += place.name + "\n";
  state("names", known);
  if (!known.empty() && flow_) {
    state.part("flow", [&] { flow_->visit_state(state); });
    state("echoed", echoed_);
  }
  for (Place& place : places_) {
    if (("\n" + known).find("\n" + place.name + "\n") != std::string::npos)
      state.part(place.name, [&] {
        place.samples.visit_state(state);
        state("end", place.end);
      });
    if (state.restores()) place.history.emplace(output::History::continued(place.path, place.samples));
  }
}

/// When the front has come to what sends a wave back, that sets out for the probes: no faster than sound and flow together are
/// anywhere behind the front.
void OpenField::look_for_echoes() {
  const exact::Lagrangian1D& mesh = flow_->mesh();
  if (echoed_ || flow_->front() < 0.98 * echo_) return;
  echoed_ = true;
  double fastest = mesh.cell_sound().back();
  for (int i = mesh.first_cell(1); i < mesh.cells(); ++i)
    fastest = std::max(fastest, mesh.cell_sound()[std::size_t(i)] + std::abs(mesh.node_velocity()[std::size_t(i)]));
  for (Place& place : places_) place.end = flow_->time() + place.away / fastest;
}

void OpenField::sample(double time) {
  if (!flow_) return;
  // It looks for echoes whenever the front has gone on a little.
  const auto wanted = [&] {
    return std::any_of(places_.begin(), places_.end(), [&](const Place& p) { return p.end > flow_->time(); });
  };
  while (wanted() && flow_->time() < time) {
    const double stride = std::isfinite(echo_) && !echoed_ ? 0.005 * echo_ / 2e3 : time - flow_->time();
    flow_->advance(std::min(time, flow_->time() + stride));
    look_for_echoes();
  }
  if (flow_->time() < time) return;
  for (Place& place : places_) {
    if (time >= place.end) continue;
    const double row[] = {time, flow_->mesh().at(place.radius).pressure};
    place.history->append(row);
    place.samples.append(row);
  }
}

void OpenField::flush() {
  for (Place& place : places_) place.history->flush();
}

std::map<std::string, output::Samples> OpenField::samples() const {
  std::map<std::string, output::Samples> all;
  for (const Place& place : places_) all[place.name] = place.samples;
  return all;
}

}  // namespace undex::run
