#include "run/laid_start.hpp"

#include "core/errors.hpp"
#include "output/checkpoint.hpp"

namespace undex::run {
namespace {

constexpr const char* file_name = "start.h5";

/// The particles of all bodies, in the order of their numbers, and the clock.
struct LaidStart {
  double time = 0, heat = 0;  // [s]; dissipated before [J]
  std::vector<std::size_t> of_body;
  sph::LaidParticles all;

  void visit_state(StateVisitor& state) {
    state("time", time);
    state("heat", heat);
    state("particles of bodies", of_body);
    state("position", all.position);
    state("velocity", all.velocity);
    state("density", all.density);
    state("mass", all.mass);
    state("energy", all.energy);
  }
};

template <class Value>
std::vector<Value> part(const std::vector<Value>& all, std::size_t begin, std::size_t end) {
  return {all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)};
}

}  // namespace

void keep_start(const Simulation& simulation, const std::filesystem::path& folder) {
  const sph::Fluid& fluid = *simulation.fluid();
  const auto id = fluid.field("id");
  LaidStart start{.time = fluid.time(), .heat = fluid.ledger().dissipated, .of_body = fluid.particles_by_body(), .all = {}};
  const auto ordered = [&](const char* name) {
    const auto values = fluid.field(name);
    std::vector<double> sorted(id.size());
    for (std::size_t i = 0; i < id.size(); ++i) sorted[std::size_t(id[i])] = values[i];
    return sorted;
  };
  const auto vectors = [&](const char* name) {
    const auto values = fluid.field(name);
    std::vector<Vec3> sorted(id.size());
    for (std::size_t i = 0; i < id.size(); ++i)
      sorted[std::size_t(id[i])] = Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    return sorted;
  };
  start.all = {vectors("position"), vectors("velocity"), ordered("density"), ordered("mass"), ordered("energy")};
  output::write_state(folder / file_name, [&](StateVisitor& state) { start.visit_state(state); });
}

bool take_start(const std::filesystem::path& folder, scene::Scene& scene) {
  LaidStart start;
  try {
    output::read_state(folder / file_name, [&](StateVisitor& state) { start.visit_state(state); });
  } catch (const FileError&) {
    return false;
  }
  if (start.of_body.size() != scene.fluid.bodies.size()) return false;
  std::size_t begin = 0;
  for (std::size_t b = 0; b < start.of_body.size(); ++b) {
    const std::size_t end = begin + start.of_body[b];
    auto field = std::make_shared<sph::StartField>();
    field->laid = {part(start.all.position, begin, end), part(start.all.velocity, begin, end),
                   part(start.all.density, begin, end), part(start.all.mass, begin, end), part(start.all.energy, begin, end)};
    begin = end;
    scene.fluid.bodies[b].start = field;
    scene.fluid.bodies[b].burn.reset();  // it has burned
  }
  scene.fluid.start_time = start.time;
  scene.fluid.heat_before = start.heat;
  for (fem::Settings& structure : scene.structures) structure.start_time = start.time;
  return true;
}

}  // namespace undex::run
