#include "run/line_flow.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "core/errors.hpp"
#include "run/rest.hpp"

namespace undex::run {
namespace {

constexpr int least_cells = 8;        // of a layer
constexpr double compressed = 1e-4;   // share of the density by which a front is known that is not followed
constexpr double fastest = 1e4;       // [m/s] no front goes by more between two looks
constexpr double most_growth = 1.1;   // of the way of the front between two merges
constexpr int steps_to_merge = 16;    // behind a front that is followed
constexpr double just_before = 1e-9;  // a probe, and just behind it: share of its place
// Width that cells may have, over their distance from the front: as merged behind one that is followed, or is not.
constexpr double behind_followed = 1.0 / 50, behind_smeared = 1.0 / 800;
// And over their radius: the flow round a bubble, u ~ 1/r^2, outlasts the wave.
constexpr double of_radius = 1.0 / 64;

/// Lays a layer out in cells of about the widths that the line asks for. Where the wave's front will be followed they need only
/// begin so: the front leaves new ones behind.
void cut(const scene::Line& line, double spacing, bool followed, exact::Layer& layer) {
  const double length = layer.outer - layer.inner, most = length / least_cells;
  const auto width = [&](double gone) {
    const double place = layer.inner + gone;
    if (!followed) return std::min(most, line.cell_width(place, spacing));
    return std::min(most, line.front_width(place, spacing) * (1.0 + gone / (line.core_high - line.core_low)));
  };
  std::vector<double> ends{0.0};
  while (ends.back() < length) ends.push_back(ends.back() + width(ends.back() + 0.5 * width(ends.back())));
  if (ends.back() - length > 0.5 * (ends.back() - ends[ends.size() - 2])) ends.pop_back();
  layer.cells = static_cast<int>(ends.size()) - 1;
  for (int i = 1; i < layer.cells; ++i) layer.places.push_back(layer.inner + ends[i] * (length / ends.back()));
}

exact::Layer layer_of(const sph::Body& body, const scene::Scene& scene, const scene::Line& line, double spacing, bool followed,
                      double inner, double outer) {
  exact::Layer layer{.law = body.material.law, .inner = inner, .outer = outer};
  cut(line, spacing, followed, layer);
  layer.density = start_density(body);
  layer.energy = start_energy(body);
  layer.velocity = body.velocity[0] + body.radial_velocity;
  if (body.burn && !body.burn->instantaneous) {
    layer.burn = body.burn;
    layer.burn->origin -= line.center;
  }
  if (!body.start && !body.level) return layer;
  const bool hydrostatic = body.level && !scene.fluid.gravity.isZero();
  layer.start = [&body, hydrostatic, at_rest = rest_of(body, scene), velocity = layer.velocity,
                 width = (outer - inner) / layer.cells](double x) {
    const Vec3 place(x, 0, 0);
    const Rest rest = at_rest(place);
    if (!body.start) return exact::StartPoint{rest.density, velocity, rest.energy};
    const sph::StartState state = body.start->state(place, width);
    exact::StartPoint point{state.density, state.velocity[0], state.energy};
    if (!hydrostatic || !body.start->rest_pressure) return point;
    // The column's pressure, beyond that of the wave's medium, comes on top of it.
    const materials::FluidLaw& law = body.material.law;
    const double wave = std::visit([&](const auto& each) { return each.evaluate(point.density, point.energy).pressure; }, law);
    point.density = materials::density_at(law, wave + rest.pressure - *body.start->rest_pressure, point.energy);
    return point;
  };
  return layer;
}

exact::Layer layer_of(const solid::Body& body, const scene::Line& line, double spacing, double inner, double outer) {
  exact::Layer layer{.law = body.material, .inner = inner, .outer = outer};
  cut(line, spacing, false, layer);
  layer.density = body.material.rho0;
  layer.velocity = body.velocity[0];
  return layer;
}

exact::Lagrangian1D mesh_of(const scene::Scene& scene, const scene::Line& line) {
  std::vector<exact::Layer> layers;
  const double spacing = scene.fluid.lattice.spacing;
  const bool follows = line.graded && line.rests_ahead;
  exact::Lagrangian1DOptions options;
  for (const scene::LineLayer& layer : line.layers)
    if (layer.is_solid) layers.push_back(layer_of(scene.solids.bodies[layer.index], line, spacing, layer.inner, layer.outer));
    else
      layers.push_back(layer_of(scene.fluid.bodies[layer.index], scene, line, spacing, follows && layer.inner >= line.core_high,
                                layer.inner, layer.outer));
  options.held_pressure = line.held;
  if (follows) options.front_width = [line, spacing](double radius) { return line.front_width(radius, spacing); };
  options.outer_pressure = line.outside_pressure;
  options.gravity = scene.fluid.gravity[0];
  options.inner_pressure = options.ambient = scene.fluid.surroundings.pressure;
  const auto end = [&](int which) {
    return line.closed[which]      ? exact::Boundary::rigid
           : line.radiating[which] ? exact::Boundary::radiating
                                   : exact::Boundary::free;
  };
  try {
    return {scene.geometry == scene::Geometry::spherical ? 3 : 1, std::move(layers), end(0), end(1), options};
  } catch (const std::logic_error& mistake) {
    throw SceneError(scene.file.string(), {scene.places.finding("dimension", mistake.what())});
  }
}

}  // namespace

LineFlow::LineFlow(const scene::Scene& scene)
    : spherical_(scene.geometry == scene::Geometry::spherical),
      line_(scene::line_of(scene)),
      spacing_(scene.fluid.lattice.spacing),
      around_(scene.fluid.surroundings.pressure),
      mesh_(mesh_of(scene, line_)) {
  for (const scene::LineLayer& layer : line_.layers) {
    material_.push_back(double(layer.index + (layer.is_solid ? scene.fluid.bodies.size() : 0)));
    names_.push_back(layer.is_solid ? scene.solids.bodies[layer.index].name : scene.fluid.bodies[layer.index].name);
  }
  for (const scene::Probe& probe : scene.probes)
    if (probe.kind == scene::Probe::Kind::fluid) probes_.push_back(place_of(probe.point));
  std::sort(probes_.begin(), probes_.end());
}

Step LineFlow::advance(double end) {
  const double next = std::min(end, time() + step_to_probe());
  const double size = mesh_.step_towards(next);
  if (mesh_.front_is_fitted()) merge_behind_front();
  else if (line_.graded && time() >= next_look_) look_for_front();
  if (reached_end_ < 0 && mesh_.reached_outer_end()) reached_end_ = time();
  return {size, "cell"};
}

/// The front that is followed stops just before each probe, and just behind it, so that a history has both.
double LineFlow::step_to_probe() const {
  if (!mesh_.front_is_fitted()) return std::numeric_limits<double>::infinity();
  const double front = mesh_.front_radius();
  const auto next = std::upper_bound(probes_.begin(), probes_.end(), front);
  if (next == probes_.end()) return std::numeric_limits<double>::infinity();
  const double left = *next - front, little = just_before * *next;
  return (left > 2.0 * little ? left - little : left + little) / mesh_.front_speed();
}

void LineFlow::merge_behind_front() {
  front_ = mesh_.front_radius() - line_.core_high;
  last_look_ = next_look_ = time();
  if (mesh_.steps() % steps_to_merge == 0) merge(behind_followed, line_.front_width(mesh_.front_radius(), spacing_));
}

/// Looks for a front that is not followed no farther than it can have come: what sets out from the outer end is no front.
void LineFlow::look_for_front() {
  const double core = line_.core_high - line_.core_low;
  const double limit = line_.core_high + front_ + fastest * (time() - last_look_);
  front_ = std::max(front_, mesh_.front(compressed, limit) - line_.core_high);
  last_look_ = time();
  next_look_ = time() + 0.05 * (core + front_) / fastest;
  mesh_.end_burns();
  if (core + front_ < most_growth * (core + merged_at_)) return;
  merge(behind_smeared, line_.cell_width(line_.core_high + front_, spacing_));
}

/// Merges cells that are narrower than `width` [m] and so much more for every metre behind the front, in spheres up to their
/// share of the radius.
void LineFlow::merge(double growth, double width) {
  merged_at_ = front_;
  mesh_.end_burns();
  const double at = line_.core_high + front_;
  mesh_.coarsen(
      [=, this](double place) {
        const double behind = width + growth * std::max(0.0, at - place);
        return spherical_ ? std::min(behind, std::max(width, of_radius * place)) : behind;
      },
      least_cells);
}

void LineFlow::visit_state(StateVisitor& state) {
  mesh_.visit_state(state);
  state("next look", next_look_);
  state("last look", last_look_);
  state("front", front_);
  state("merged at", merged_at_);
  state("reached end", reached_end_);
  ledger_.reset();
}

const LineLedger& LineFlow::ledger() const {
  if (ledger_ && ledger_->step == steps()) return *ledger_;
  LineLedger all{.step = steps()};
  const auto u = mesh_.node_velocity(), m = mesh_.cell_mass(), e = mesh_.cell_energy(), node = mesh_.node_mass();
  for (int i = 0; i < mesh_.cells(); ++i) {
    all.mass += m[i];
    const double inner = mesh_.inner_velocity(i), kinetic = 0.25 * m[i] * (inner * inner + u[i + 1] * u[i + 1]);
    (is_solid(i) ? all.solid_kinetic : all.kinetic) += kinetic;
    (is_solid(i) ? all.elastic : all.internal) += m[i] * e[i];
  }
  for (std::size_t k = 0; k < node.size(); ++k) all.momentum += node[k] * u[k];  // plane
  for (const double work : mesh_.solids().plastic_energy) all.plastic += work;
  all.elastic -= all.plastic;
  all.dissipated = mesh_.barotropic_heat();
  all.internal -= all.dissipated;
  all.gravity = mesh_.gravity_work();
  const double given = mesh_.boundary_work() + all.gravity;
  if (line_.radiating[0] || line_.radiating[1]) all.radiated = given;
  else all.external = -given;
  ledger_ = all;
  return *ledger_;
}

double LineFlow::compression_energy() const {
  const auto p = mesh_.cell_pressure(), rho = mesh_.cell_density(), c = mesh_.cell_sound(), m = mesh_.cell_mass();
  double sum = 0;
  for (std::size_t i = 0; i < m.size(); ++i)
    if (c[i] > 0) sum += 0.5 * m[i] * std::pow(p[i] / (rho[i] * c[i]), 2);
  return sum;
}

double LineFlow::maximum_pressure() const {
  const auto p = mesh_.cell_pressure();
  return *std::max_element(p.begin(), p.end());
}

std::vector<LayerTotals> LineFlow::totals() const {
  const auto u = mesh_.node_velocity(), r = mesh_.node_radius(), m = mesh_.cell_mass(), e = mesh_.cell_energy(),
             rho = mesh_.cell_density(), p = mesh_.cell_pressure();
  std::vector<LayerTotals> all;
  for (int k = 0; k < mesh_.layers(); ++k) {
    const auto* fluid = std::get_if<materials::FluidLaw>(&mesh_.layer(k).law);
    if (!fluid) continue;
    const std::size_t body = line_.layers[k].index;
    if (all.size() <= body) all.resize(body + 1);
    LayerTotals& one = all[body];
    const int begin = mesh_.first_cell(k), end = k + 1 < mesh_.layers() ? mesh_.first_cell(k + 1) : mesh_.cells();
    std::visit(
        [&](const auto& law) {
          using Law = std::remove_cvref_t<decltype(law)>;
          for (int i = begin; i < end; ++i) {
            const double inner = mesh_.inner_velocity(i), volume = m[i] / rho[i];
            one.mass += m[i];
            one.volume += volume;
            one.kinetic += 0.25 * m[i] * (inner * inner + u[i + 1] * u[i + 1]);
            if constexpr (Law::uses_energy) one.internal += m[i] * e[i];
            else one.internal += m[i] * law.barotropic_energy(rho[i]);
            one.pressure_volume += volume * p[i];
            if constexpr (!Law::is_gas)
              if (const double share = law.void_fraction(rho[i], e[i]); share > 0) {
                one.cavitated += volume;
                one.voids += share * volume;
              }
            one.moment += m[i] * 0.5 * (r[i] + r[i + 1]);
          }
        },
        *fluid);
  }
  return all;
}

std::vector<LargestOf> LineFlow::largest() const {
  const auto u = mesh_.node_velocity(), r = mesh_.node_radius(), p = mesh_.cell_pressure();
  std::vector<LargestOf> all;
  for (int k = 0; k < mesh_.layers(); ++k) {
    const int begin = mesh_.first_cell(k), end = k + 1 < mesh_.layers() ? mesh_.first_cell(k + 1) : mesh_.cells();
    LargestOf found{names_[k], {}};
    const auto look = [&](const char* quantity, int nodes, auto of) {
      const int last = end + nodes;
      double most[4] = {-1e300, -1e300, -1e300, -1e300};  // of every fourth: four chains, for this is asked after every step
      int i = begin;
      for (; i + 4 <= last; i += 4)
        for (int lane = 0; lane < 4; ++lane) most[lane] = std::max(most[lane], of(i + lane));
      for (; i < last; ++i) most[0] = std::max(most[0], of(i));
      const double value = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
      i = begin;
      while (i + 1 < last && of(i) != value) ++i;
      found.quantities.push_back(
          {quantity, {.value = value, .place = point_at(nodes ? r[i] : 0.5 * (r[i] + r[i + 1])), .owner = std::uint32_t(i)}});
    };
    look("pressure", 0, [&](int i) { return p[i]; });
    look("speed", 1, [&](int i) { return std::abs(u[i]); });
    if (is_solid(begin)) {
      look("plastic_strain", 0, [&](int i) { return mesh_.solids().plastic_strain[i]; });
      if (materials::can_fail(std::get<materials::Solid>(mesh_.layer(k).law)))
        look("damage", 0, [&](int i) { return mesh_.solids().damage[i]; });
      look("temperature", 0, [&](int i) { return mesh_.solids().temperature[i]; });
    }
    all.push_back(std::move(found));
  }
  return all;
}

double LineFlow::place_of(const Vec3& x) const { return spherical_ ? (x - line_.center).norm() : x[0]; }

Vec3 LineFlow::outward(const Vec3& x) const {
  if (!spherical_) return Vec3::UnitX();
  const double r = place_of(x);
  return r > 0 ? Vec3((x - line_.center) / r) : Vec3(Vec3::UnitX());
}

Vec3 LineFlow::point_at(double place) const {
  return spherical_ ? Vec3(line_.center + place * Vec3::UnitX()) : Vec3(place, 0, 0);
}

FluidPoint LineFlow::fluid_point(double density, double energy, double pressure, int layer, double velocity,
                                 const Vec3& along) const {
  const auto* fluid = std::get_if<materials::FluidLaw>(&mesh_.layer(layer).law);
  if (!fluid) return {};
  return {.pressure = pressure,
          .density = density,
          .void_fraction = std::visit([&](const auto& law) { return law.void_fraction(density, energy); }, *fluid),
          .velocity = velocity * along,
          .neighbours = 1};
}

FluidPoint LineFlow::at(const Vec3& x) const {
  const auto r = mesh_.node_radius();
  const double place = place_of(x), slack = 1e-9 * (r.back() - r.front());
  if (place < r.front() - slack || place > r.back() + slack) return {};
  const exact::PointState state = mesh_.at(std::clamp(place, r.front(), r.back()));
  return fluid_point(state.density, state.energy, state.pressure, state.layer, state.velocity, outward(x));
}

std::function<FluidPoint()> LineFlow::at_surface(const Vec3& start) const {
  const double place = place_of(start);
  const int last = mesh_.layers() - 1;
  // Ends of layers, each with the layer of fluid beside it.
  struct End {
    double place;
    int layer;
    bool outer;  // of that layer
  };
  std::vector<End> ends;
  if (line_.closed[0]) ends.push_back({line_.inner(), 0, false});
  if (line_.closed[1]) ends.push_back({line_.outer(), last, true});
  for (int k = 0; k <= last; ++k) {
    if (!line_.layers[k].is_solid) continue;
    if (k > 0) ends.push_back({line_.layers[k].inner, k - 1, true});
    if (k < last) ends.push_back({line_.layers[k].outer, k + 1, false});
  }
  if (ends.empty()) return [] { return FluidPoint{}; };
  const End nearest = *std::min_element(ends.begin(), ends.end(), [&](const End& a, const End& b) {
    return std::abs(a.place - place) < std::abs(b.place - place);
  });
  return [this, nearest, along = outward(start)] {
    const int node = nearest.outer ? (nearest.layer + 1 < mesh_.layers() ? mesh_.first_cell(nearest.layer + 1) : mesh_.cells())
                                   : mesh_.first_cell(nearest.layer);
    const int cell = nearest.outer ? node - 1 : node;
    return fluid_point(mesh_.cell_density()[cell], mesh_.cell_energy()[cell], mesh_.cell_pressure()[cell], nearest.layer,
                       mesh_.node_velocity()[node], along);
  };
}

std::function<MaterialPoint()> LineFlow::in_solid(const Vec3& start) const {
  const double place = place_of(start);
  int layer = -1;
  double least = 1e300;
  for (int k = 0; k < mesh_.layers(); ++k) {
    if (!line_.layers[k].is_solid) continue;
    const double away = std::max({0.0, line_.layers[k].inner - place, place - line_.layers[k].outer});
    if (away < least) {
      least = away;
      layer = k;
    }
  }
  if (layer < 0) return [] { return MaterialPoint{}; };
  // The mass of the layer inside of the point stays what it is, however cells are merged.
  const auto volume = [this](double r) { return spherical_ ? r * r * r : r; };
  const double inner = line_.layers[layer].inner, outer = line_.layers[layer].outer;
  const double share = std::clamp((volume(place) - volume(inner)) / (volume(outer) - volume(inner)), 0.0, 1.0);
  return [=, this, along = outward(start)] {
    const auto m = mesh_.cell_mass(), r = mesh_.node_radius(), u = mesh_.node_velocity();
    const int begin = mesh_.first_cell(layer), end = layer + 1 < mesh_.layers() ? mesh_.first_cell(layer + 1) : mesh_.cells();
    double below = 0, whole = 0;
    for (int i = begin; i < end; ++i) whole += m[i];
    int cell = begin;
    while (cell + 1 < end && below + m[cell] < share * whole) below += m[cell++];
    const double within = std::clamp((share * whole - below) / m[cell], 0.0, 1.0);
    const double cubes = volume(r[cell]) + within * (volume(r[cell + 1]) - volume(r[cell]));
    const double now = spherical_ ? std::cbrt(cubes) : cubes;
    const double weight = (now - r[cell]) / (r[cell + 1] - r[cell]);
    MaterialPoint point;
    point.displacement = (now - place) * along;
    point.position = start + point.displacement;
    point.velocity = (u[cell] + weight * (u[cell + 1] - u[cell])) * along;
    const double p = mesh_.cell_pressure()[cell] - around_, s = mesh_.solids().deviator[cell];
    const Mat3 radial = along * along.transpose();
    point.stress = (s - p) * radial + (-0.5 * s - p) * (Mat3::Identity() - radial);
    point.plastic_strain = mesh_.solids().plastic_strain[cell];
    point.temperature = mesh_.solids().temperature[cell];
    return point;
  };
}

std::vector<double> LineFlow::field(const std::string& name) const {
  const int n = mesh_.cells();
  const auto r = mesh_.node_radius(), u = mesh_.node_velocity();
  const auto copied = [](std::span<const double> values) { return std::vector<double>(values.begin(), values.end()); };
  if (name == "pressure") return copied(mesh_.cell_pressure());
  if (name == "density") return copied(mesh_.cell_density());
  if (name == "energy") return copied(mesh_.cell_energy());
  if (name == "sound_speed") return copied(mesh_.cell_sound());
  if (name == "mass") return copied(mesh_.cell_mass());
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(n) * 3);
  for (int i = 0; i < n; ++i) {
    const int layer = mesh_.cell_layer()[i];
    if (name == "position") {
      const Vec3 x = point_at(0.5 * (r[i] + r[i + 1]));
      values.insert(values.end(), x.begin(), x.end());
    } else if (name == "velocity") {
      values.insert(values.end(), {0.5 * (mesh_.inner_velocity(i) + u[i + 1]), 0.0, 0.0});
    } else if (name == "id") {
      values.push_back(i);
    } else if (name == "material") {
      values.push_back(material_[layer]);
    } else if (name == "smoothing_length") {
      values.push_back(r[i + 1] - r[i]);
    } else if (name == "void_fraction") {
      const double rho = mesh_.cell_density()[i], e = mesh_.cell_energy()[i];
      values.push_back(fluid_point(rho, e, 0.0, layer, 0.0, Vec3::Zero()).void_fraction);
    } else {
      throw std::invalid_argument("no field '" + name + "' of cells");
    }
  }
  return values;
}

std::string LineFlow::remark() const {
  if (reached_end_ < 0 || line_.radiating[1]) return "";
  char text[300];
  std::snprintf(
      text, sizeof text,
      "the wave reached the outer end, at %.6g m, at %.6g s, and what that sends back is felt ever farther inside; for a "
      "longer run without it take more of the outermost layer",
      line_.outer(), reached_end_);
  return text;
}

std::vector<std::size_t> LineFlow::cells_by_layer() const {
  std::vector<std::size_t> count(line_.layers.size(), 0);
  for (const int layer : mesh_.cell_layer()) ++count[layer];
  return count;
}

std::size_t LineFlow::memory_bytes() const { return 40 * sizeof(double) * cells(); }

}  // namespace undex::run
