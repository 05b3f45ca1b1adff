#include "run/record.hpp"

#include <omp.h>

namespace undex::run {
namespace {

void add(const sph::Fluid& fluid, output::RunRecord& record) {
  record.fluid_substeps = fluid.substeps();
  record.particles = std::int64_t(fluid.particle_count());
  record.wall_particles = std::int64_t(fluid.wall_particle_count());
  record.particle_updates = record.particles * record.steps;
  record.neighbour_interactions = fluid.neighbour_interactions();
  record.solver_memory_bytes += std::int64_t(fluid.memory_bytes());
  const sph::Clamps clamps = fluid.clamps();
  record.clamps = {
      {"density", clamps.density}, {"smoothing", clamps.smoothing}, {"filling", clamps.filling}, {"energy", clamps.energy}};
}

void add(const sph::Solids& solids, output::RunRecord& record) {
  record.particles += std::int64_t(solids.particle_count());
  record.particle_updates += std::int64_t(solids.particle_count()) * solids.steps();
  record.solver_memory_bytes += std::int64_t(solids.memory_bytes());
}

void add(const fem::Structure& structure, output::RunRecord& record) {
  record.cells = std::int64_t(structure.cell_count());
  record.solver_memory_bytes += std::int64_t(structure.memory_bytes());
}

}  // namespace

output::RunRecord record_of(const scene::Scene& scene, const Simulation& simulation, const Stopwatch& since) {
  output::RunRecord record;
  record.scene = scene.name;
  record.time_s = simulation.time();
  record.steps = simulation.steps();
  record.wall_time_s = since.wall();
  record.cpu_time_s = since.cpu();
  record.threads = omp_get_max_threads();
  if (const sph::Fluid* fluid = simulation.fluid()) add(*fluid, record);
  if (const sph::Solids* solids = simulation.solids()) add(*solids, record);
  if (const fem::Structure* structure = simulation.structure()) add(*structure, record);
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
