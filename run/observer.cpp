#include "run/observer.hpp"

#include <algorithm>
#include <cmath>

namespace undex::run {
namespace {

/// Of each of several structures, beside the sums of all.
std::vector<output::Column> columns_of(const std::string& structure, bool gravity) {
  std::vector<output::Column> all;
  for (const char* name : {"structure_kinetic", "structure_elastic", "structure_plastic", "structure_viscous",
                           "interface_work_received", "external", "gravity"})
    if (gravity || name != std::string("gravity")) all.push_back({name + ("." + structure), "J"});
  return all;
}

std::vector<output::Column> energy_columns(bool gravity, bool surroundings, bool obstacles, bool radiating,
                                           const std::vector<fem::Settings>& structures) {
  std::vector<output::Column> all{{"time", "s"}};
  for (const char* name : {"kinetic", "internal", "dissipated", "structure_kinetic", "structure_elastic", "structure_plastic",
                           "structure_viscous", "interface_work_given", "interface_work_received", "external"})
    all.push_back({name, "J"});
  if (gravity) all.push_back({"gravity", "J"});
  if (surroundings) all.push_back({"surroundings", "J"});
  if (obstacles) all.push_back({"obstacle_kinetic", "J"});
  if (radiating) all.push_back({"radiated", "J"});
  all.push_back({"total", "J"});
  all.push_back({"error", ""});
  for (std::size_t k = 0; structures.size() > 1 && k < structures.size(); ++k)
    for (const output::Column& column : columns_of(structures[k].name, gravity)) all.push_back(column);
  return all;
}

/// A field of the present state; empty where the run has no such body.
output::LastField last_field(const Simulation& simulation, const std::string& name) {
  const std::string body = name.substr(0, name.find('.')), field = name.substr(name.find('.') + 1);
  output::LastField last{.components = field == "position" || field == "velocity" ? 3 : 1, .values = {}};
  if (body == "fluid" && simulation.has_fluid()) {
    last.values = simulation.fluid_field(field);
  } else if (name == "body.position" && !simulation.bodies().empty()) {
    for (const Vec3& x : simulation.bodies().front()->positions()) last.values.insert(last.values.end(), x.begin(), x.end());
  }
  if (const std::optional<Meridian>& meridian = simulation.meridian(); meridian && last.components == 3) {
    const Vec3 outward = meridian->outward();
    for (std::size_t k = 0; k < last.values.size(); k += 3) {
      Eigen::Map<Vec3> value(last.values.data() + k);
      value = field == "position" ? meridian->place_in_space(value, outward) : meridian->vector_in_space(value, outward);
    }
  }
  return last;
}

}  // namespace

EnergyHistory::EnergyHistory(const std::filesystem::path& folder, const scene::Scene& scene, bool goes_on)
    : gravity_(!scene.fluid.gravity.isZero()),
      surroundings_(scene.fluid.surroundings.pressure > 0),
      obstacles_(!scene.obstacles.empty()),
      radiating_(
          std::any_of(scene.fluid.walls.begin(), scene.fluid.walls.end(), [](const sph::Wall& wall) { return wall.radiates(); })),
      path_(folder / "energy.csv"),
      samples_(energy_columns(gravity_, surroundings_, obstacles_, radiating_, scene.structures)) {
  if (!goes_on) history_.emplace(path_, samples_.columns);
}

void EnergyHistory::visit_state(StateVisitor& state) {
  samples_.visit_state(state);
  if (state.restores()) history_.emplace(output::History::continued(path_, samples_));
}

void EnergyHistory::sample(const Simulation& simulation) {
  const EnergyBalance e = simulation.energy();
  std::vector<double> row{simulation.time(), e.kinetic, e.internal,   e.dissipated,    e.structure_kinetic, e.elastic,
                          e.plastic,         e.viscous, e.work_given, e.work_received, e.external};
  if (gravity_) row.push_back(e.gravity);
  if (surroundings_) row.push_back(e.surroundings);
  if (obstacles_) row.push_back(e.obstacle_kinetic);
  if (radiating_) row.push_back(e.radiated);
  row.insert(row.end(), {e.total(), e.error()});
  for (const StructureAccount& each : simulation.accounts()) {
    row.insert(row.end(), {each.kinetic, each.elastic, each.plastic, each.viscous, each.received, each.external});
    if (gravity_) row.push_back(each.gravity);
  }
  history_->append(row);
  samples_.append(row);
}

Observer::Observer(const scene::Scene& scene, const scene::Scene& read, const Simulation& simulation,
                   const std::filesystem::path& folder, bool goes_on)
    : scene_(scene),
      simulation_(simulation),
      probes_(scene, simulation, folder, goes_on),
      energy_(folder, scene, goes_on),
      bodies_(scene, folder, goes_on),
      forces_(scene, simulation, folder, goes_on),
      largest_(scene.output.wants("largest")),
      lines_(scene, simulation, folder, goes_on),
      open_field_(read, folder, goes_on),
      snapshots_(scene, simulation, folder, goes_on),
      next_snapshot_(snapshots_.next_after(simulation.time() > 0 ? simulation.time() : -1.0)) {}

void Observer::visit_state(StateVisitor& state) {
  state.part("probes", [&] { probes_.visit_state(state); });
  state.part("energy", [&] { energy_.visit_state(state); });
  state.part("bodies", [&] { bodies_.visit_state(state); });
  state.part("forces", [&] { forces_.visit_state(state); });
  state.part("largest", [&] { largest_.visit_state(state); });
  state.part("lines", [&] { lines_.visit_state(state); });
  state.part("open field", [&] { open_field_.visit_state(state); });
  state.part("steps", [&] { steps_.visit_state(state); });
  state.part("fields", [&] { snapshots_.visit_state(state); });
  state("next history", next_history_);
  if (state.restores()) next_snapshot_ = snapshots_.next_after(simulation_.time());  // times of snapshots may be others now
}

void Observer::begin(const Simulation& simulation) {
  if (simulation.time() > 0) probes_.sample_before(0.0);
  observe(simulation);
}

void Observer::observe(const Simulation& simulation) {
  const double now = simulation.time() * (1 + 1e-12);
  if (simulation.last_step_size() > 0) steps_.count(simulation.last_step());
  largest_.look(simulation);
  lines_.look(simulation);
  if (now >= next_history_ || now >= scene_.end_time) {
    probes_.sample(simulation);
    energy_.sample(simulation);
    bodies_.sample(simulation);
    forces_.sample(simulation);
    open_field_.sample(simulation.time());
    const double interval = scene_.output.history_interval;
    next_history_ = interval > 0 ? (std::floor(now / interval) + 1) * interval : 0.0;
  }
  // Rows wait for a few steps, and never for one that takes long: they are on disk within a second of being computed.
  constexpr std::chrono::milliseconds most{50};
  const bool snapshot = now >= next_snapshot_;
  if (snapshot || std::chrono::steady_clock::now() - last_flush_ > most) flush();
  if (snapshot) {
    snapshots_.write();
    next_snapshot_ = snapshots_.next_after(simulation.time());
  }
}

void Observer::flush() {
  probes_.flush();
  energy_.flush();
  bodies_.flush();
  forces_.flush();
  lines_.flush();
  open_field_.flush();
  last_flush_ = std::chrono::steady_clock::now();
}

void Observer::add_to(output::RunRecord& record) const {
  record.largest = largest_.records(!scene_.structures.empty() ? 3 : scene_.fluid.dimension);
  record.bubbles = bodies_.bubbles();
  record.step_limits = steps_.counts();
}

output::Evidence Observer::evidence(const Simulation& simulation, const std::vector<std::string>& last_fields) const {
  output::Evidence evidence{.time = simulation.time(),
                            .probes = probes_.samples(),
                            .energy = energy_.samples(),
                            .bodies = bodies_.samples(),
                            .forces = forces_.samples(),
                            .lines = lines_.samples(),
                            .fields = {}};
  evidence.probes.merge(open_field_.samples());
  for (const std::string& name : last_fields) evidence.fields[name] = last_field(simulation, name);
  return evidence;
}

}  // namespace undex::run
