#include "app/snapshots.hpp"

#include <cmath>
#include <limits>

namespace undex::app {
namespace {

/// The named fields of fluid or solids as the next snapshot of a file.
template <class Particles>
void write_particles(const Particles& particles, double time, const std::vector<std::string>& names, output::ParticleFields& file) {
  const std::vector<double> place = particles.field("position");
  std::vector<Vec3> position(place.size() / 3);
  for (std::size_t i = 0; i < position.size(); ++i) position[i] = {place[3 * i], place[3 * i + 1], place[3 * i + 2]};
  const std::vector<double> id = particles.field("id");
  const std::vector<std::int64_t> ids(id.begin(), id.end());
  std::vector<std::vector<double>> values;
  for (const std::string& name : names) values.push_back(particles.field(name));
  std::vector<output::Field> fields;
  for (std::size_t f = 0; f < values.size(); ++f)
    fields.push_back({names[f], names[f] == "velocity" || names[f] == "displacement" ? 3 : 1, values[f]});
  file.write(time, position, fields, ids);
}

}  // namespace

Snapshots::Snapshots(const scene::Scene& scene, const std::filesystem::path& folder) : wanted_(scene.output) {
  if (wanted_.field_interval <= 0 && wanted_.field_times.empty()) return;
  std::filesystem::create_directories(folder / "fields");
  if (!scene.fluid.bodies.empty()) particles_.emplace(folder / "fields" / "particles.h5part");
  if (!scene.fluid.solids.empty()) solids_.emplace(folder / "fields" / "solids.h5part");
  if (scene.structure && wanted_.structure_fields) structure_.emplace(folder / "fields");
}

double Snapshots::next_after(double time) const {
  const double beyond = time + 1e-12 * std::abs(time) + 1e-15;
  double next = std::numeric_limits<double>::infinity();
  if (wanted_.field_interval > 0) next = (std::floor(beyond / wanted_.field_interval) + 1.0) * wanted_.field_interval;
  for (const double at : wanted_.field_times)
    if (at > beyond && at < next) next = at;
  return next;
}

void Snapshots::write(const Simulation& simulation) {
  if (particles_) write_particles(*simulation.fluid(), simulation.time(), wanted_.particle_fields, *particles_);
  if (solids_) write_particles(*simulation.solids(), simulation.time(), wanted_.solid_fields, *solids_);
  if (structure_) {
    const fem::FieldView view = simulation.structure()->fields();
    output::StructureSnapshot snapshot{view.position, view.cells, {}, {}};
    snapshot.point_data = {{"displacement", 3, output::as_components(view.displacement)},
                           {"velocity", 3, output::as_components(view.velocity)}};
    snapshot.cell_data = {{"pressure", 1, view.pressure},
                          {"von_mises", 1, view.von_mises},
                          {"plastic_strain", 1, view.plastic_strain},
                          {"temperature", 1, view.temperature}};
    structure_->write(simulation.time(), snapshot);
  }
}

}  // namespace undex::app
