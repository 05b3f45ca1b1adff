#include "run/record.hpp"

#include <omp.h>

namespace undex::run {
namespace {

void add(const sph::Fluid& fluid, output::RunRecord& record) {
  record.fluid_substeps = fluid.substeps();
  record.particles = std::int64_t(fluid.particle_count());
  record.wall_particles = std::int64_t(fluid.wall_particle_count());
  record.particle_updates = fluid.updates();
  const std::vector<std::size_t> laid = fluid.particles_by_body_at_start(), now = fluid.particles_by_body();
  for (std::size_t b = 0; b < now.size(); ++b)
    if (now[b] > laid[b]) record.splits.push_back({fluid.settings().bodies[b].name, std::int64_t(laid[b]), std::int64_t(now[b])});
  record.neighbour_interactions = fluid.neighbour_interactions();
  record.solver_memory_bytes += std::int64_t(fluid.memory_bytes());
  const sph::Clamps clamps = fluid.clamps();
  record.clamps = {
      {"density", clamps.density}, {"smoothing", clamps.smoothing}, {"filling", clamps.filling}, {"energy", clamps.energy}};
}

void add(const LineFlow& line, output::RunRecord& record) {
  record.cells = std::int64_t(line.cells());
  record.solver_memory_bytes += std::int64_t(line.memory_bytes());
}

void add(const DeformableBody& body, output::RunRecord& record) {
  const auto particles = std::int64_t(body.size().particles);
  record.particles += particles;
  record.particle_updates += particles * body.steps();
  record.cells += std::int64_t(body.size().cells);
  record.solver_memory_bytes += std::int64_t(body.memory_bytes());
}

output::ObstacleRecord record_of(const coupling::Obstacle& given, const coupling::ObstacleState& state, int dimension) {
  const int turns = dimension == 3 ? 0 : dimension == 2 ? 2 : 3;
  const auto part = [](const Vec3& v, int first, int end) { return std::vector<double>(v.data() + first, v.data() + end); };
  return {.name = given.name,
          .motion = word_of(given.motion),
          .mass = state.mass,
          .displacement = part(state.displacement, 0, dimension),
          .rotation = part(state.rotation, turns, 3),
          .velocity = part(state.velocity, 0, dimension),
          .spin = part(state.spin, turns, 3),
          .impulse = part(state.impulse, 0, dimension)};
}

}  // namespace

void Stopwatch::visit_state(StateVisitor& state) {
  double wall_time = wall(), cpu_time = cpu();
  state("wall time", wall_time);
  state("CPU time", cpu_time);
  if (!state.restores()) return;
  before_[0] += wall_time;
  before_[1] += cpu_time;
}

output::RunRecord record_of(const scene::Scene& scene, const Simulation& simulation, const Stopwatch& since) {
  output::RunRecord record;
  record.scene = scene.name;
  record.time_s = simulation.time();
  record.steps = simulation.steps();
  record.wall_time_s = since.wall();
  record.cpu_time_s = since.cpu();
  record.threads = omp_get_max_threads();
  if (const sph::Fluid* fluid = simulation.fluid()) add(*fluid, record);
  if (const LineFlow* line = simulation.line()) add(*line, record);
  for (const auto& body : simulation.bodies()) add(*body, record);
  for (const StructureAccount& each : simulation.accounts())
    record.structures.push_back({.name = each.name,
                                 .cells = std::int64_t(each.cells),
                                 .steps = each.steps,
                                 .kinetic = each.kinetic,
                                 .elastic = each.elastic,
                                 .plastic = each.plastic,
                                 .viscous = each.viscous,
                                 .received = each.received,
                                 .external = each.external,
                                 .energy_error = each.error,
                                 .impulse = {each.impulse.begin(), each.impulse.end()}});
  for (std::size_t k = 0; k < simulation.obstacles().size(); ++k)
    record.obstacles.push_back(record_of(simulation.obstacles()[k].given(), simulation.obstacle_state(k), scene.fluid.dimension));
  record.peak_memory_bytes = output::peak_memory_bytes();
  record.mass_error = simulation.mass_error();
  record.momentum_error = simulation.momentum_error();
  record.angular_momentum_error = simulation.angular_momentum_error();
  record.energy_error = simulation.energy().error();
  record.interface_energy_error = simulation.interface_energy_error();
  record.interface_impulse_error = simulation.interface_impulse_error();
  record.passes = simulation.passes();
  return record;
}

}  // namespace undex::run
