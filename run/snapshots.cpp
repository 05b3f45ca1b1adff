#include "run/snapshots.hpp"

#include <cmath>
#include <limits>

namespace undex::run {
namespace {

/// Fields of one snapshot, with the memory they stand in.
class Columns {
 public:
  void add(const std::string& name, int components, std::vector<double> values) {
    values_.push_back(std::move(values));
    names_.push_back({name, components});
  }
  /// Puts 0 for what is not finite, and appends a field that says where.
  void flag() {
    std::vector<double> flags(values_.front().size() / names_.front().second, 0.0);
    for (std::size_t f = 0; f < values_.size(); ++f)
      for (std::size_t k = 0; k < values_[f].size(); ++k)
        if (!std::isfinite(values_[f][k])) {
          values_[f][k] = 0.0;
          flags[k / names_[f].second] = 1.0;
        }
    add("not_finite", 1, std::move(flags));
  }
  std::vector<output::Field> fields() const {
    std::vector<output::Field> fields;
    for (std::size_t f = 0; f < values_.size(); ++f) fields.push_back({names_[f].first, names_[f].second, values_[f]});
    return fields;
  }

 private:
  std::vector<std::vector<double>> values_;
  std::vector<std::pair<std::string, int>> names_;
};

/// The named fields of fluid or solids as the next snapshot of a file.
template <class Particles>
void write_particles(const Particles& particles, const std::vector<std::string>& names, bool at_stop,
                     output::ParticleFields& file) {
  const std::vector<double> place = particles.field("position");
  std::vector<Vec3> position(place.size() / 3);
  for (std::size_t i = 0; i < position.size(); ++i) position[i] = {place[3 * i], place[3 * i + 1], place[3 * i + 2]};
  const std::vector<double> id = particles.field("id");
  const std::vector<std::int64_t> ids(id.begin(), id.end());
  Columns columns;
  for (const std::string& name : names)
    columns.add(name, name == "velocity" || name == "displacement" ? 3 : 1, particles.field(name));
  if (at_stop && !names.empty()) columns.flag();
  file.write(particles.time(), position, columns.fields(), ids);
}

std::vector<double> copied(std::span<const Vec3> vectors) {
  const std::span<const double> values = output::as_components(vectors);
  return {values.begin(), values.end()};
}

}  // namespace

Snapshots::Snapshots(const scene::Scene& scene, const std::filesystem::path& folder)
    : scene_(scene), folder_(folder / "fields"), wanted_(scene.output) {
  if (wanted_.field_interval > 0 || !wanted_.field_times.empty()) open();
}

void Snapshots::open() {
  std::filesystem::create_directories(folder_);
  if (!scene_.fluid.bodies.empty()) particles_.emplace(folder_ / "particles.h5part");
  if (!scene_.fluid.solids.empty()) solids_.emplace(folder_ / "solids.h5part");
  if (scene_.structure && wanted_.structure_fields) structure_.emplace(folder_);
}

double Snapshots::next_after(double time) const {
  const double beyond = time + 1e-12 * std::abs(time) + 1e-15;
  double next = std::numeric_limits<double>::infinity();
  if (wanted_.field_interval > 0) next = (std::floor(beyond / wanted_.field_interval) + 1.0) * wanted_.field_interval;
  for (const double at : wanted_.field_times)
    if (at > beyond && at < next) next = at;
  return next;
}

void Snapshots::write(const Simulation& simulation) { write(simulation, false); }

bool Snapshots::write_at_stop(const Simulation& simulation) {
  if (!particles_ && !solids_ && !structure_) open();
  if (simulation.time() != last_time_) write(simulation, true);
  return particles_ || solids_ || structure_;
}

void Snapshots::write(const Simulation& simulation, bool at_stop) {
  last_time_ = simulation.time();
  // A coupled run that is stopped has its solvers up to a step apart.
  if (particles_) write_particles(*simulation.fluid(), wanted_.particle_fields, at_stop, *particles_);
  if (solids_) write_particles(*simulation.solids(), wanted_.solid_fields, at_stop, *solids_);
  if (structure_) {
    const fem::FieldView view = simulation.structure()->fields();
    Columns points, cells;
    points.add("displacement", 3, copied(view.displacement));
    points.add("velocity", 3, copied(view.velocity));
    cells.add("pressure", 1, view.pressure);
    cells.add("von_mises", 1, view.von_mises);
    cells.add("plastic_strain", 1, view.plastic_strain);
    cells.add("temperature", 1, view.temperature);
    if (at_stop) cells.flag();
    structure_->write(simulation.structure()->time(), {view.position, view.cells, points.fields(), cells.fields()});
  }
}

}  // namespace undex::run
