#include "run/snapshots.hpp"

#include <algorithm>
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
BodySnapshot snapshot_of(const Simulation& simulation, const std::vector<std::string>& names) {
  const std::vector<double> place = simulation.fluid_field("position");
  BodySnapshot snapshot;
  snapshot.position.resize(place.size() / 3);
  for (std::size_t i = 0; i < snapshot.position.size(); ++i)
    snapshot.position[i] = {place[3 * i], place[3 * i + 1], place[3 * i + 2]};
  for (const std::string& name : names)
    snapshot.of_points.push_back({name, name == "velocity" ? 3 : 1, simulation.fluid_field(name)});
  return snapshot;
}

/// Places and vectors of a meridian, in the half-plane that stands for all.
BodySnapshot in_space(BodySnapshot snapshot, const std::optional<Meridian>& meridian) {
  if (!meridian) return snapshot;
  const Vec3 outward = meridian->outward();
  for (Vec3& x : snapshot.position) x = meridian->place_in_space(x, outward);
  for (Fields* fields : {&snapshot.of_points, &snapshot.of_cells})
    for (BodySnapshot::Field& field : *fields)
      for (std::size_t k = 0; field.components == 3 && k < field.values.size(); k += 3) {
        Eigen::Map<Vec3> vector(field.values.data() + k);
        vector = meridian->vector_in_space(vector, outward);
      }
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

Snapshots::Snapshots(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder, bool goes_on)
    : simulation_(simulation), folder_(folder / "fields"), wanted_(scene.output), structures_(scene.structures) {
  // Of particles that split neither mass nor body can be told from the number.
  if (std::any_of(scene.fluid.bodies.begin(), scene.fluid.bodies.end(),
                  [](const sph::Body& body) { return body.variable_h && body.split > 1; }))
    for (const char* name : {"material", "mass"})
      if (std::find(wanted_.particle_fields.begin(), wanted_.particle_fields.end(), name) == wanted_.particle_fields.end())
        wanted_.particle_fields.emplace_back(name);
  if (wanted_.field_interval > 0 || !wanted_.field_times.empty()) open(goes_on);
}

/// One file a kind; each of several structures has its own, with its name.
void Snapshots::open(bool goes_on) {
  std::filesystem::create_directories(folder_);
  const auto particles = [&](const std::string& name) {
    const std::filesystem::path path = folder_ / (name + ".h5part");
    return goes_on ? output::ParticleFields::continued(path) : output::ParticleFields(path);
  };
  if (simulation_.has_fluid()) water_ = particles("particles");
  if (!simulation_.obstacles().empty()) obstacles_.emplace(folder_, "obstacles");
  for (std::size_t k = 0; k < simulation_.bodies().size(); ++k) {
    const auto& body = simulation_.bodies()[k];
    const bool in_particles = body->size().particles > 0;
    const std::string name = in_particles ? "solids" : structures_.size() > 1 ? "structure_" + structures_[k].name : "structure";
    BodyFile file{.body = body.get(), .name = name, .particles = {}, .cells = {}};
    if (in_particles) file.particles = particles(name);
    else if (wanted_.structure_fields) file.cells.emplace(folder_, name);
    if (file.particles || file.cells) bodies_.push_back(std::move(file));
  }
}

void Snapshots::visit_state(StateVisitor& state) {
  state("last time", last_time_);
  std::string known;  // names of the files, each with a line's end
  if (water_) known += "particles\n";
  if (obstacles_) known += "obstacles\n";
  for (const BodyFile& file : bodies_) known += file.name + "\n";
  state("files", known);
  const auto visit = [&](const std::string& name, auto& file, const auto& begin_anew) {
    if (known.find(name + "\n") != std::string::npos) state.part(name, [&] { file->visit_state(state); });
    else if (state.restores()) begin_anew();
  };
  if (water_) visit("particles", water_, [&] { water_.emplace(folder_ / "particles.h5part"); });
  if (obstacles_) visit("obstacles", obstacles_, [] {});
  for (BodyFile& file : bodies_) {
    if (file.particles) visit(file.name, file.particles, [&] { file.particles.emplace(folder_ / (file.name + ".h5part")); });
    if (file.cells) visit(file.name, file.cells, [] {});
  }
}

double next_snapshot_after(const scene::Output& output, double time) {
  const double beyond = time + 1e-12 * std::abs(time) + 1e-15;
  double next = std::numeric_limits<double>::infinity();
  if (output.field_interval > 0) next = (std::floor(beyond / output.field_interval) + 1.0) * output.field_interval;
  for (const double at : output.field_times)
    if (at > beyond && at < next) next = at;
  return next;
}

bool Snapshots::write_at_stop() {
  if (!is_open()) open(/*goes_on=*/false);
  if (simulation_.time() != last_time_) write(true);
  return is_open();
}

void Snapshots::write(bool at_stop) {
  last_time_ = simulation_.time();
  const std::optional<Meridian>& meridian = simulation_.meridian();
  // A coupled run that is stopped has its solvers up to a step apart.
  if (water_) {
    const std::vector<double> id = simulation_.fluid_field("id");
    write_particles(simulation_.time(), in_space(snapshot_of(simulation_, wanted_.particle_fields), meridian),
                    {id.begin(), id.end()}, at_stop, *water_);
  }
  if (obstacles_) write_cells(simulation_.time(), in_space(simulation_.obstacle_surfaces(), meridian), at_stop, *obstacles_);
  for (BodyFile& file : bodies_) {
    const double time = file.body->time();
    if (file.cells) write_cells(time, in_space(file.body->snapshot({}), meridian), at_stop, *file.cells);
    if (!file.particles) continue;
    std::vector<std::int64_t> ids(file.body->size().particles);
    std::iota(ids.begin(), ids.end(), 0);
    write_particles(time, in_space(file.body->snapshot(wanted_.solid_fields), meridian), ids, at_stop, *file.particles);
  }
}

}  // namespace undex::run
