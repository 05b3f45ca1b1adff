#include "run/probes.hpp"

namespace undex::run {
namespace {

using Read = std::function<void(std::vector<double>& row)>;

template <class Point>
void add_columns(const std::vector<PointQuantity<Point>>& quantities, int dimension, std::vector<output::Column>& columns) {
  for (const PointQuantity<Point>& quantity : quantities)
    for (const std::string& name : columns_of(quantity, dimension)) columns.push_back({name, quantity.unit});
}

/// Reads `point` and gives the quantities of it.
template <class Point>
Read reader(std::vector<PointQuantity<Point>> quantities, int dimension, std::function<Point()> point) {
  return [=](std::vector<double>& row) {
    const Point now = point();
    for (const PointQuantity<Point>& quantity : quantities) append_values(quantity, now, dimension, row);
  };
}

/// The material point nearest to x at the start, of whichever body, or of the structure of that number.
std::function<MaterialPoint()> material_point(const Simulation& simulation, const Vec3& x, std::optional<std::size_t> of) {
  if (simulation.line()) return simulation.line()->in_solid(x);
  const DeformableBody* owner = nullptr;
  BodyPoint nearest;
  const auto& bodies = simulation.bodies();
  for (std::size_t k = of.value_or(0); k < (of ? *of + 1 : bodies.size()); ++k)
    if (BodyPoint point = bodies[k]->locate(x); !owner || point.distance < nearest.distance) {
      owner = bodies[k].get();
      nearest = std::move(point);
    }
  return [=] { return owner->read(nearest); };
}

/// Where the fluid is read: at x, or where a body's surface near it takes it. A probe farther from bodies is one of a rigid wall.
std::function<Vec3()> place_on_wall(const Simulation& simulation, const Vec3& x, double reach) {
  std::function<Vec3()> nearest;
  for (const auto& body : simulation.bodies())
    if (auto place = body->follow_surface(x, reach); place && (!nearest || (place() - x).norm() < (nearest() - x).norm()))
      nearest = std::move(place);
  if (nearest) return nearest;
  for (const coupling::RigidObstacle& obstacle : simulation.obstacles())
    if (std::abs(obstacle.signed_distance(x)) <= reach) return [&obstacle, x] { return obstacle.body().place(x); };
  return [x] { return x; };
}

/// What is read of a scene's meridian, in space: in the half-plane of the probe.
FluidPoint in_space(FluidPoint point, const Meridian& meridian, const Vec3& outward) {
  point.velocity = meridian.vector_in_space(point.velocity, outward);
  return point;
}
MaterialPoint in_space(MaterialPoint point, const Meridian& meridian, const Vec3& outward) {
  point.position = meridian.place_in_space(point.position, outward);
  for (Vec3* vector : {&point.displacement, &point.velocity, &point.acceleration})
    *vector = meridian.vector_in_space(*vector, outward);
  point.stress = meridian.tensor_in_space(point.stress, outward);
  return point;
}
template <class Point>
std::function<Point()> in_space(std::function<Point()> point, const std::optional<Meridian>& meridian, const Vec3& x) {
  if (!meridian) return point;
  return [=, line = *meridian, outward = meridian->outward_at(x)] { return in_space(point(), line, outward); };
}

/// The number of the structure that a probe names.
std::optional<std::size_t> named_by(const scene::Probe& probe, const std::vector<fem::Settings>& structures) {
  for (std::size_t k = 0; k < structures.size(); ++k)
    if (probe.structure && *probe.structure == structures[k].name) return k;
  return std::nullopt;
}

/// The fluid at x, or on the wall or body near it.
std::function<FluidPoint()> fluid_point(const Simulation& simulation, const Vec3& x, bool on_wall, double reach) {
  if (const LineFlow* line = simulation.line()) {
    if (on_wall) return line->at_surface(x);
    return [=] { return line->at(x); };
  }
  const std::function<Vec3()> place = on_wall ? place_on_wall(simulation, x, reach) : [x] { return x; };
  return [fluid = simulation.fluid(), place] { return fluid->at(place()); };
}

/// What is written of an obstacle: vectors in as many components as the scene has, turns about the axes that are left.
std::vector<output::Column> obstacle_columns(int dimension) {
  std::vector<output::Column> columns{{"time", "s"}};
  const auto add = [&](const std::string& name, const char* unit, int first, int end) {
    for (int a = first; a < end; ++a) columns.push_back({name + '_' + "xyz"[a], unit});
  };
  const int turns = dimension == 3 ? 0 : dimension == 2 ? 2 : 3;
  add("position", "m", 0, dimension);
  add("velocity", "m/s", 0, dimension);
  add("rotation", "rad", turns, 3);
  add("spin", "rad/s", turns, 3);
  add("force", "N", 0, dimension);
  add("moment", "N m", turns, 3);
  add("impulse", "N s", 0, dimension);
  return columns;
}

void append_state(const coupling::ObstacleState& state, int dimension, std::vector<double>& row) {
  const auto add = [&](const Vec3& v, int first, int end) { row.insert(row.end(), v.data() + first, v.data() + end); };
  const int turns = dimension == 3 ? 0 : dimension == 2 ? 2 : 3;
  add(state.position, 0, dimension);
  add(state.velocity, 0, dimension);
  add(state.rotation, turns, 3);
  add(state.spin, turns, 3);
  add(state.force, 0, dimension);
  add(state.moment, turns, 3);
  add(state.impulse, 0, dimension);
}

}  // namespace

FluidPoint fluid_at(const Simulation& simulation, const Vec3& x) {
  if (const LineFlow* line = simulation.line()) return line->at(x);
  const std::optional<Meridian>& meridian = simulation.meridian();
  if (!meridian) return simulation.fluid()->at(x);
  return in_space(simulation.fluid()->at(meridian->place(x)), *meridian, meridian->outward_at(x));
}

Probes::Probes(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder, bool goes_on) {
  const int dimension = !scene.structures.empty() ? 3 : scene.fluid.dimension;
  if (!scene.probes.empty() || !scene.obstacles.empty()) std::filesystem::create_directories(folder / "history");
  const std::optional<Meridian>& meridian = simulation.meridian();
  for (const scene::Probe& probe : scene.probes) {
    const Vec3 x = meridian ? meridian->place(probe.point) : probe.point;
    std::vector<output::Column> columns{{"time", "s"}};
    Read read;
    if (probe.kind == scene::Probe::Kind::structure) {
      const auto quantities = chosen(material_quantities, probe.quantities);
      add_columns(quantities, dimension, columns);
      read = reader<MaterialPoint>(
          quantities, dimension,
          in_space(material_point(simulation, x, named_by(probe, scene.structures)), meridian, probe.point));
    } else {
      const auto quantities = chosen(fluid_quantities, probe.quantities);
      add_columns(quantities, dimension, columns);
      const bool on_wall = probe.kind == scene::Probe::Kind::wall;
      const auto point = fluid_point(simulation, x, on_wall, 2.0 * scene.fluid.lattice.spacing);
      read = reader<FluidPoint>(quantities, dimension, in_space(point, meridian, probe.point));
    }
    channels_.push_back({.name = probe.name,
                         .may_lie_in_wave = probe.kind == scene::Probe::Kind::fluid,
                         .read = std::move(read),
                         .path = folder / "history" / (probe.name + ".csv"),
                         .samples = output::Samples(std::move(columns)),
                         .history = {}});
    if (!goes_on) channels_.back().history.emplace(channels_.back().path, channels_.back().samples.columns);
  }
  for (std::size_t k = 0; k < simulation.obstacles().size(); ++k) {
    const coupling::RigidObstacle& obstacle = simulation.obstacles()[k];
    Channel& channel = channels_.emplace_back();
    channel.name = obstacle.given().name;
    channel.read = [&simulation, k, dimension](std::vector<double>& row) {
      append_state(simulation.obstacle_state(k), dimension, row);
    };
    channel.path = folder / "history" / (channel.name + ".csv");
    channel.samples = output::Samples(obstacle_columns(dimension));
    if (!goes_on) channel.history.emplace(channel.path, channel.samples.columns);
  }
}

void Probes::visit_state(StateVisitor& state) {
  std::string known;  // names, each with a line's end
  for (const Channel& channel : channels_) known += channel.name + "\n";
  state("names", known);
  for (Channel& channel : channels_) {
    if (("\n" + known).find("\n" + channel.name + "\n") != std::string::npos)
      state.part("history " + channel.name, [&] { channel.samples.visit_state(state); });
    if (state.restores()) channel.history.emplace(output::History::continued(channel.path, channel.samples));
  }
}

void Probes::append(Channel& channel, const std::vector<double>& row) {
  channel.history->append(row);
  channel.samples.append(row);
}

std::vector<double> Probes::row_of(const Channel& channel, double time) {
  std::vector<double> row{time};
  channel.read(row);
  return row;
}

void Probes::sample(const Simulation& simulation) {
  for (Channel& channel : channels_) append(channel, row_of(channel, simulation.time()));
}

void Probes::sample_before(double time) {
  for (Channel& channel : channels_)
    if (!channel.may_lie_in_wave) append(channel, row_of(channel, time));
}

void Probes::flush() {
  for (Channel& channel : channels_) channel.history->flush();
}

std::map<std::string, output::Samples> Probes::samples() const {
  std::map<std::string, output::Samples> all;
  for (const Channel& channel : channels_) all[channel.name] = channel.samples;
  return all;
}

}  // namespace undex::run
