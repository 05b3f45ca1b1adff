#include "run/snapshots.hpp"

#include <cmath>
#include <limits>
#include <numeric>

namespace undex::run {
namespace {

using Fields = std::vector<BodySnapshot::Field>;

/// Puts 0 for what is not finite, and appends a field that says where.
void flag(Fields& fields) {
  if (fields.empty()) return;
  std::vector<double> flags(fields.front().values.size() / fields.front().components, 0.0);
  for (BodySnapshot::Field& field : fields)
    for (std::size_t k = 0; k < field.values.size(); ++k)
      if (!std::isfinite(field.values[k])) {
        field.values[k] = 0.0;
        flags[k / field.components] = 1.0;
      }
  fields.push_back({"not_finite", 1, std::move(flags)});
}

std::vector<output::Field> borrowed(const Fields& fields) {
  std::vector<output::Field> all;
  for (const BodySnapshot::Field& field : fields) all.push_back({field.name, field.components, field.values});
  return all;
}

/// The water's places and the named fields of it.
BodySnapshot snapshot_of(const sph::Fluid& fluid, const std::vector<std::string>& names) {
  const std::vector<double> place = fluid.field("position");
  BodySnapshot snapshot;
  snapshot.position.resize(fluid.particle_count());
  for (std::size_t i = 0; i < snapshot.position.size(); ++i)
    snapshot.position[i] = {place[3 * i], place[3 * i + 1], place[3 * i + 2]};
  for (const std::string& name : names) snapshot.of_points.push_back({name, name == "velocity" ? 3 : 1, fluid.field(name)});
  return snapshot;
}

void write_particles(double time, BodySnapshot snapshot, const std::vector<std::int64_t>& ids, bool at_stop,
                     output::ParticleFields& file) {
  if (at_stop) flag(snapshot.of_points);
  file.write(time, snapshot.position, borrowed(snapshot.of_points), ids);
}

void write_cells(double time, BodySnapshot snapshot, bool at_stop, output::StructureFields& file) {
  if (at_stop) flag(snapshot.of_cells);
  file.write(time, {snapshot.position, snapshot.cells, borrowed(snapshot.of_points), borrowed(snapshot.of_cells)});
}

}  // namespace

Snapshots::Snapshots(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder)
    : simulation_(simulation), folder_(folder / "fields"), wanted_(scene.output) {
  if (wanted_.field_interval > 0 || !wanted_.field_times.empty()) open();
}

/// One file a kind; a second body of a kind has a number.
void Snapshots::open() {
  std::filesystem::create_directories(folder_);
  if (simulation_.fluid()) water_.emplace(folder_ / "particles.h5part");
  int of_particles = 0, of_cells = 0;
  const auto numbered = [](const std::string& stem, int count) { return count > 1 ? stem + std::to_string(count) : stem; };
  for (const auto& body : simulation_.bodies()) {
    BodyFile file{.body = body.get(), .particles = {}, .cells = {}};
    if (body->size().particles > 0) file.particles.emplace(folder_ / (numbered("solids", ++of_particles) + ".h5part"));
    else if (wanted_.structure_fields) file.cells.emplace(folder_, numbered("structure", ++of_cells));
    if (file.particles || file.cells) bodies_.push_back(std::move(file));
  }
}

double Snapshots::next_after(double time) const {
  const double beyond = time + 1e-12 * std::abs(time) + 1e-15;
  double next = std::numeric_limits<double>::infinity();
  if (wanted_.field_interval > 0) next = (std::floor(beyond / wanted_.field_interval) + 1.0) * wanted_.field_interval;
  for (const double at : wanted_.field_times)
    if (at > beyond && at < next) next = at;
  return next;
}

bool Snapshots::write_at_stop() {
  if (!is_open()) open();
  if (simulation_.time() != last_time_) write(true);
  return is_open();
}

void Snapshots::write(bool at_stop) {
  last_time_ = simulation_.time();
  // A coupled run that is stopped has its solvers up to a step apart.
  if (const sph::Fluid* fluid = simulation_.fluid(); fluid && water_) {
    const std::vector<double> id = fluid->field("id");
    write_particles(fluid->time(), snapshot_of(*fluid, wanted_.particle_fields), {id.begin(), id.end()}, at_stop, *water_);
  }
  for (BodyFile& file : bodies_) {
    const double time = file.body->time();
    if (file.cells) write_cells(time, file.body->snapshot({}), at_stop, *file.cells);
    if (!file.particles) continue;
    std::vector<std::int64_t> ids(file.body->size().particles);
    std::iota(ids.begin(), ids.end(), 0);
    write_particles(time, file.body->snapshot(wanted_.solid_fields), ids, at_stop, *file.particles);
  }
}

}  // namespace undex::run
