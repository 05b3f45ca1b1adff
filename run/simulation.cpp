#include "run/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/errors.hpp"
#include "coupling/wall_depth.hpp"
#include "fem_structure/structure.hpp"
#include "output/text_table.hpp"
#include "scene/revolution.hpp"
#include "sph_fluid/walls/slip_faces.hpp"
#include "sph_solid/solids.hpp"

namespace undex::run {
namespace {

/// The mass of finite elements cannot change.
bool in_particles(const std::unique_ptr<DeformableBody>& body) { return body->size().particles > 0; }

/// Axes along which a wall pushes the fluid unbooked: those of its rigid faces' normals where the fluid is mirrored in them; all,
/// where dummy particles stand behind them.
std::array<bool, 3> pushed_by(const sph::Wall& wall, bool mirrors) {
  std::array<bool, 3> pushed{};
  for (int a = 0; a < 3; ++a) {
    const auto closed = [&](const std::string& face) {
      const auto found = wall.faces.find(face);
      if (found == wall.faces.end()) return true;
      return found->second != sph::FaceCondition::open && found->second != sph::FaceCondition::radiating;
    };
    if (std::holds_alternative<Sphere>(wall.container)) pushed[a] = closed("side");
    else if (const auto* round = std::get_if<Cylinder>(&wall.container))
      pushed[a] = a == round->axis ? closed("low") || closed("high") : closed("side");
    else if (const auto* cone = std::get_if<Cone>(&wall.container))
      pushed[a] = closed("side") || (a == cone->axis && (closed("low") || closed("high")));
    else pushed[a] = closed(std::string(1, "xyz"[a]) + "_low") || closed(std::string(1, "xyz"[a]) + "_high");
  }
  const bool lined = !mirrors || std::any_of(wall.faces.begin(), wall.faces.end(),
                                             [](const auto& face) { return face.second == sph::FaceCondition::no_slip; });
  if (lined && (pushed[0] || pushed[1] || pushed[2])) pushed.fill(true);
  return pushed;
}

/// Axes along which nothing gives an impulse that is not booked.
std::array<bool, 3> balanced_axes(const scene::Scene& scene) {
  std::array<bool, 3> balanced;
  for (int a = 0; a < 3; ++a) balanced[a] = a < scene.fluid.dimension && !scene.fluid.symmetry.axis[a];
  if (on_a_line(scene.geometry)) {
    const scene::Line line = scene::line_of(scene);
    balanced[0] = scene.geometry == scene::Geometry::plane;
    for (const int end : {0, 1}) balanced[0] = balanced[0] && !line.closed[end] && !line.radiating[end];
    return {balanced[0], false, false};
  }
  const bool mirrors = sph::mirrors_fluid(scene.fluid.numerics.scheme);
  for (const sph::Wall& wall : scene.fluid.walls) {
    const auto pushed = pushed_by(wall, mirrors);
    for (int a = 0; a < 3; ++a) balanced[a] = balanced[a] && !pushed[a];
  }
  const auto held = [&](const std::vector<Support>& supports) {
    for (const Support& support : supports)
      for (std::size_t a = 0; a < 3; ++a) balanced[a] = balanced[a] && !support.fixed[a];
  };
  for (const fem::Settings& structure : scene.structures) held(structure.supports);
  for (const solid::Body& solid : scene.solids.bodies) held(solid.supports);
  return balanced;
}

/// Sum of V p^2/(2 rho c^2) [J]: what small waves against the present pressure are measured by. A law's own energy does not say
/// it, for its zero may lie at that very pressure.
double compression_energy(const sph::Fluid& fluid) {
  const auto p = fluid.field("pressure"), rho = fluid.field("density"), c = fluid.field("sound_speed"), m = fluid.field("mass");
  double sum = 0;
  for (std::size_t i = 0; i < m.size(); ++i)
    if (c[i] > 0) sum += 0.5 * m[i] * std::pow(p[i] / (rho[i] * c[i]), 2);
  return sum;
}

/// Energy [J] of a strain of 1e-10 and of the motion that goes with it, in structure and solids: far above what rounding makes
/// of a body at rest, far below what anybody computes.
double rounding_energy(const scene::Scene& scene, const std::vector<std::unique_ptr<DeformableBody>>& bodies) {
  double fastest = 0, mass = 0;
  for (const fem::Settings& structure : scene.structures) {
    fastest = std::max(fastest, materials::wave_speed(structure.material));
    for (const fem::Part& part : structure.parts)
      if (part.material) fastest = std::max(fastest, materials::wave_speed(*part.material));
  }
  for (const solid::Body& solid : scene.solids.bodies) fastest = std::max(fastest, materials::wave_speed(solid.material));
  for (const auto& body : bodies) mass += body->ledger().mass;
  return 0.5 * mass * std::pow(1e-10 * fastest, 2);
}

/// The table of the scene that a solver's complaint is about: it opens with the kind and the name, in quotes, of what is wrong,
/// or with the key itself.
std::string table_of(const std::string& complaint, const std::string& otherwise) {
  for (const auto& [word, list] : {std::pair("body '", "bodies."), {"solid '", "solids."}, {"wall '", "walls."}})
    if (complaint.starts_with(word)) {
      const std::size_t begin = std::string_view(word).size();
      return list + complaint.substr(begin, complaint.find('\'', begin) - begin);
    }
  const std::string key = complaint.substr(0, complaint.find_first_of(" :"));
  return key.find('.') != std::string::npos ? key : otherwise;
}

/// The fastest of particles with velocities v and places x, three components each.
std::string fastest_of(const std::vector<double>& v, const std::vector<double>& x, const std::vector<double>& id) {
  const auto square = [&](std::size_t i) {
    return v[3 * i] * v[3 * i] + v[3 * i + 1] * v[3 * i + 1] + v[3 * i + 2] * v[3 * i + 2];
  };
  std::size_t i = 0;
  for (std::size_t k = 0; k < id.size(); ++k)
    if (square(k) > square(i)) i = k;
  char text[200];
  std::snprintf(text, sizeof text, "; the fastest is particle %.0f with %.3g m/s at (%.5g, %.5g, %.5g) m", id[i],
                std::sqrt(square(i)), x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  return text;
}

/// "27,288 particles".
std::string counted(std::size_t count, const std::string& what) { return output::grouped(std::int64_t(count)) + " " + what; }

/// Bodies with a spacing of their own.
std::string spacings_of(const scene::Scene& scene) {
  std::string text;
  for (const sph::Body& body : scene.fluid.bodies)
    if (body.spacing && *body.spacing != scene.fluid.lattice.spacing)
      text += ", '" + body.name + "' of " + output::with_unit(*body.spacing, "m");
  return text;
}

}  // namespace

Simulation::Simulation(const scene::Scene& scene, Stages* stages) : meridian_(scene.meridian) {
  const scene::Scene solved = scene::for_solvers(scene);
  copies_ = scene::mirror_copies(scene);
  mirrored_ = scene.fluid.symmetry.axis;
  Stages silent;
  build(solved, stages ? *stages : silent);
  take_start(solved);
}

void Simulation::build(const scene::Scene& scene, Stages& stages) {
  std::vector<Finding> findings;
  const auto attempt = [&](const std::string& table, auto build) {
    try {
      build();
    } catch (const std::invalid_argument& mistake) {
      findings.push_back(scene.places.finding(table_of(mistake.what(), table), mistake.what()));
    }
  };
  if (on_a_line(scene.geometry)) {
    stages.begin("mesh");
    line_ = std::make_unique<LineFlow>(scene);
    driver_ = std::make_unique<OnALine>(*line_);
    stages.end(counted(line_->cells(), "cells in one dimension"));
    return;
  }
  if (!scene.fluid.bodies.empty())
    attempt("resolution", [&] {
      stages.begin("lattice, walls");
      fluid_ = std::make_unique<sph::Fluid>(scene.fluid);
      stages.end(counted(fluid_->particle_count(), "particles") + " of " + output::with_unit(scene.fluid.lattice.spacing, "m") +
                 spacings_of(scene));
    });
  for (const fem::Settings& structure : scene.structures)
    attempt(scene.path_of(structure), [&] {
      stages.begin("structure");
      bodies_.push_back(std::make_unique<fem::Structure>(structure));
      stages.end("'" + structure.name + "': " + counted(bodies_.back()->size().cells, "cells"));
    });
  solid::Solids* solids = nullptr;
  if (!scene.solids.bodies.empty())
    attempt("solids", [&] {
      stages.begin("solids");
      auto built = std::make_unique<solid::Solids>(scene.solids, scene.fluid);
      if (fluid_) {
        const double on_wall = 1e-6 * scene.fluid.lattice.spacing;
        built->mesh_wet_faces([&](const Vec3& x) { return coupling::depth_in_walls(x, scene.fluid) <= on_wall; });
      }
      solids = built.get();
      bodies_.push_back(std::move(built));
      stages.end(counted(bodies_.back()->size().particles, "particles"));
    });
  if (findings.empty() && fluid_)
    attempt("obstacles", [&] {
      flow_ = std::make_unique<coupling::Flow>(*fluid_, scene.obstacles);
      for (const auto& body : bodies_) flow_->watch(*body);
    });
  if (findings.empty()) attempt("coupling", [&] { make_driver(scene, solids); });
  if (findings.empty() && fluid_) settle(stages);
  if (!findings.empty()) throw SceneError(scene.file.string(), findings);
}

void Simulation::settle(Stages& stages) {
  std::size_t most = 0;
  double last = 0;
  const auto words = [&](std::size_t moved) {
    return counted(moved, "particles moved until they rest; pressure uneven by ") + output::print("%.2g %%", 100 * last);
  };
  stages.begin("settling");
  fluid_->settle([&](std::size_t moved, double unevenness) {
    most = std::max(most, moved);
    last = unevenness;
    stages.news([&] { return words(moved); });
  });
  if (most > 0) stages.end(words(most));
}

/// Water acts on the bodies that it touches, on several structures as one; others follow in time.
void Simulation::make_driver(const scene::Scene& scene, solid::Solids* solids) {
  if (solids && fluid_) {
    driver_ = std::make_unique<OneSystem>(*flow_, *solids, scene.coupling);
    return;
  }
  WetBody* body = bodies_.empty() ? nullptr : bodies_.front().get();
  if (scene.structures.size() > 1) {
    std::vector<coupling::BodyGroup::Member> members;
    for (std::size_t k = 0; k < bodies_.size(); ++k) members.push_back({scene.structures[k].name, bodies_[k].get()});
    group_ = std::make_unique<coupling::BodyGroup>(std::move(members));
    body = group_.get();
  }
  if (!fluid_) {
    driver_ = std::make_unique<BodyAlone>(*body, in_particles(bodies_.front()));
  } else if (body && !body->wet_surface().faces.empty()) {
    driver_ = std::make_unique<Coupled>(*flow_, *body, scene.coupling);
  } else {
    driver_ = std::make_unique<WaterAlone>(*flow_);
    if (body) followers_.push_back(body);
  }
}

void Simulation::take_start(const scene::Scene& scene) {
  balanced_ = balanced_axes(scene);
  gravity_ = scene.fluid.gravity;
  surrounded_ = scene.fluid.surroundings.pressure > 0;
  closed_ = copies_ == 1 && !meridian_ && gravity_.isZero() && scene.fluid.walls.empty() && scene.solids.planes.empty() &&
            scene.structures.empty() &&
            std::all_of(scene.solids.bodies.begin(), scene.solids.bodies.end(),
                        [](const solid::Body& solid) { return solid.supports.empty(); });
  start_time_ = time();
  start_mass_ = mass();
  start_momentum_ = momentum();
  start_angular_momentum_ = angular_momentum();
  start_energy_ = energy().total();
  if (group_)
    for (const auto& member : group_->members()) start_balance_.push_back(member.body->ledger().balance());
  const double compression = fluid_ ? compression_energy(*fluid_) : line_ ? line_->compression_energy() : 0.0;
  least_scale_ = copies_ * (compression + rounding_energy(scene, bodies_));
}

double Simulation::time() const { return line_ ? line_->time() : fluid_ ? fluid_->time() : bodies_.front()->time(); }
long Simulation::steps() const {
  if (line_) return line_->steps();
  if (fluid_) return fluid_->steps();
  return group_ ? group_->steps() : bodies_.front()->steps();
}

void Simulation::advance(double end) {
  last_ = driver_->advance(end);
  for (WetBody* body : followers_) body->advance(time());
}

void Simulation::visit_state(StateVisitor& state) {
  if (line_) state.part("line", [&] { line_->visit_state(state); });
  if (fluid_) state.part("fluid", [&] { fluid_->visit_state(state); });
  if (flow_) state.part("obstacles", [&] { flow_->visit_state(state); });
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    state.part("body " + std::to_string(b), [&] { bodies_[b]->visit_state(state); });
  if (group_) state.part("group", [&] { group_->visit_state(state); });
  state.part("driver", [&] { driver_->visit_state(state); });
  state("last step", last_.words);
  state("last step size", last_.size);
}

void Simulation::find_rates_anew() {
  if (fluid_) fluid_->find_rates_anew();
}

EnergyBalance Simulation::energy() const {
  EnergyBalance e;
  if (line_) {
    const LineLedger l = line_->ledger();
    e.kinetic = copies_ * l.kinetic;
    e.internal = copies_ * l.internal;
    e.dissipated = copies_ * l.dissipated;
    e.structure_kinetic = copies_ * l.solid_kinetic;
    e.elastic = copies_ * l.elastic;
    e.plastic = copies_ * l.plastic;
    (surrounded_ ? e.surroundings : e.external) = copies_ * l.external;
    e.gravity = copies_ * l.gravity;
    e.radiated = copies_ * l.radiated;
  }
  if (fluid_) {
    const sph::Ledger l = fluid_->ledger();
    e.kinetic = copies_ * l.kinetic;
    e.internal = copies_ * l.internal;
    e.dissipated = copies_ * l.dissipated;
    e.work_given = copies_ * l.wall_work;
    e.gravity = copies_ * l.gravity;
    e.surroundings = copies_ * l.surroundings;
    e.radiated = copies_ * l.radiated;
  }
  for (const auto& body : bodies_) {
    const BodyLedger l = body->ledger();
    e.structure_kinetic += copies_ * l.kinetic;
    e.elastic += copies_ * l.elastic;
    e.plastic += copies_ * l.plastic;
    e.viscous += copies_ * (l.viscous + l.impact);
    e.gravity += copies_ * l.gravity;
    e.work_received += copies_ * l.received;
    e.external += copies_ * l.external;
  }
  for (const coupling::RigidObstacle& obstacle : obstacles()) {
    const coupling::ObstacleLedger l = obstacle.ledger();
    e.obstacle_kinetic += copies_ * l.kinetic;
    e.work_received += copies_ * l.work_received;
    e.external += copies_ * l.external;
    e.gravity += copies_ * l.gravity;
  }
  e.start = start_energy_;
  e.scale = std::max({std::abs(start_energy_), least_scale_, std::abs(e.external), std::abs(e.gravity), std::abs(e.surroundings),
                      std::abs(e.radiated), e.kinetic + e.structure_kinetic + e.obstacle_kinetic});
  return e;
}

std::vector<StructureAccount> Simulation::accounts() const {
  std::vector<StructureAccount> all;
  for (std::size_t k = 0; group_ && k < group_->members().size(); ++k) {
    const auto& [name, body] = group_->members()[k];
    const BodyLedger l = body->ledger();
    const Vec3& given = group_->received_by(k);
    const double scale =
        std::max({l.kinetic + l.elastic + l.plastic, std::abs(l.received), std::abs(l.external), std::abs(l.gravity)});
    all.push_back({.name = name,
                   .cells = body->size().cells,
                   .steps = body->steps(),
                   .kinetic = copies_ * l.kinetic,
                   .elastic = copies_ * l.elastic,
                   .plastic = copies_ * l.plastic,
                   .viscous = copies_ * (l.viscous + l.impact),
                   .received = copies_ * l.received,
                   .external = copies_ * l.external,
                   .gravity = copies_ * l.gravity,
                   .error = scale > 0 ? (l.balance() - start_balance_[k]) / scale : 0.0,
                   .impulse = meridian_ ? meridian_->vector_in_space(Vec3(0.0, given[1], 0.0), meridian_->outward()) : given});
  }
  return all;
}

/// Of what is in particles [kg].
double Simulation::mass() const {
  double mass = fluid_ ? fluid_->ledger().mass : line_ ? line_->ledger().mass : 0.0;
  for (const auto& body : bodies_)
    if (in_particles(body)) mass += body->ledger().mass;
  return mass;
}

double Simulation::all_mass() const {
  double mass = fluid_ ? fluid_->ledger().mass : line_ ? line_->ledger().mass : 0.0;
  for (const auto& body : bodies_) mass += body->ledger().mass;
  return mass;
}

Vec3 Simulation::momentum() const {
  Vec3 momentum = Vec3::Zero();
  if (fluid_) momentum += fluid_->ledger().momentum;
  if (line_) momentum[0] += line_->ledger().momentum;
  for (const auto& body : bodies_) momentum += body->ledger().momentum;
  for (const coupling::RigidObstacle& obstacle : obstacles()) momentum += obstacle.ledger().momentum;
  return momentum;
}

Vec3 Simulation::impulse() const {
  Vec3 impulse = all_mass() * (time() - start_time_) * gravity_;
  if (fluid_) impulse -= fluid_->ledger().radiated_momentum;
  for (const auto& body : bodies_) impulse += body->ledger().impulse;
  for (const coupling::RigidObstacle& obstacle : obstacles()) impulse += obstacle.ledger().outside;
  return impulse;
}

/// Of the bodies.
Vec3 Simulation::angular_momentum() const {
  Vec3 momentum = Vec3::Zero();
  for (const auto& body : bodies_) momentum += body->ledger().angular_momentum;
  return momentum;
}

double Simulation::mass_error() const { return start_mass_ > 0 ? std::abs(mass() / start_mass_ - 1.0) : 0.0; }

double Simulation::momentum_error() const {
  if (balanced_ == std::array{false, false, false}) return std::numeric_limits<double>::quiet_NaN();
  const EnergyBalance e = energy();
  const Vec3 given = impulse();
  double mass = all_mass();
  for (const coupling::RigidObstacle& obstacle : obstacles()) mass += obstacle.ledger().mass;
  const double one_way = std::sqrt(2.0 * (e.kinetic + e.structure_kinetic + e.obstacle_kinetic) / copies_ * mass);
  const double scale = std::max(one_way, given.norm());
  Vec3 change = momentum() - start_momentum_ - given;
  for (int a = 0; a < 3; ++a)
    if (!balanced_[a]) change[a] = 0;
  return scale > 0 ? change.norm() / scale : 0.0;
}

std::optional<double> Simulation::angular_momentum_error() const {
  if (fluid_ || line_ || !closed_ || !std::all_of(bodies_.begin(), bodies_.end(), in_particles)) return std::nullopt;
  double kinetic = 0, inertia = 0;  // [J], [kg m^2]
  for (const auto& body : bodies_) {
    kinetic += body->ledger().kinetic;
    const auto mass = body->masses();
    for (std::size_t i = 0; i < mass.size(); ++i) inertia += mass[i] * body->positions()[i].squaredNorm();
  }
  const double scale = std::sqrt(2.0 * kinetic * inertia);  // no motion of that energy has more
  return scale > 0 ? (angular_momentum() - start_angular_momentum_).norm() / scale : 0.0;
}

std::optional<coupling::InterfaceLedger> Simulation::interface() const {
  std::optional<coupling::InterfaceLedger> ledger = driver_->interface();
  if (obstacles().empty()) return ledger;
  coupling::InterfaceLedger all = ledger.value_or(coupling::InterfaceLedger{});
  all.work_given = fluid_->ledger().wall_work;
  for (const coupling::RigidObstacle& obstacle : obstacles()) {
    const coupling::ObstacleLedger l = obstacle.ledger();
    all.impulse_given += l.received;
    all.impulse_received += l.received;
    all.impulse_exchanged += l.exchanged;
    all.work_received += l.work_received;
  }
  return all;
}

std::optional<double> Simulation::interface_energy_error() const {
  const auto l = interface();
  if (!l) return std::nullopt;
  const EnergyBalance e = energy();
  const double scale =
      std::max({std::abs(l->work_given), std::abs(l->work_received), 1e-6 * std::max(e.scale, std::abs(e.internal)) / copies_});
  return scale > 0 ? (l->work_given - l->work_received) / scale : 0.0;
}

coupling::ObstacleState Simulation::obstacle_state(std::size_t which) const {
  coupling::ObstacleState state = obstacles()[which].state();
  if (!meridian_) return state;
  const Vec3 outward = meridian_->outward();
  state.position = meridian_->place_in_space(state.position, outward);
  for (Vec3* vector : {&state.displacement, &state.velocity, &state.force, &state.impulse})
    *vector = meridian_->vector_in_space(*vector, outward);
  return state;
}

std::optional<double> Simulation::interface_impulse_error() const {
  const auto l = interface();
  if (!l) return std::nullopt;
  return l->impulse_exchanged > 0 ? (l->impulse_given - l->impulse_received).norm() / l->impulse_exchanged : 0.0;
}

double Simulation::maximum_pressure() const {
  double most = fluid_ ? fluid_->maximum_pressure() : line_ ? line_->maximum_pressure() : 0.0;
  for (const auto& body : bodies_) most = std::max(most, body->maximum_pressure());
  return most;
}

std::vector<sph::BodyTotals> Simulation::body_totals() const {
  std::vector<sph::BodyTotals> all;
  if (fluid_) all = fluid_->totals();
  if (line_) {
    const Vec3 middle = line_->line().center;
    for (const LayerTotals& l : line_->totals())
      all.push_back({.mass = l.mass,
                     .volume = l.volume,
                     .kinetic = l.kinetic,
                     .internal = l.internal,
                     .pressure_volume = l.pressure_volume,
                     .cavitated = l.cavitated,
                     .voids = l.voids,
                     .moment = line_->is_plane() ? Vec3(l.moment, 0, 0) : Vec3(l.mass * middle)});
  }
  for (sph::BodyTotals& one : all) {
    if (meridian_)
      one.moment = one.mass * meridian_->place_in_space(Vec3(0.0, one.moment[1] / one.mass, 0.0), meridian_->outward());
    for (int a = 0; a < 3; ++a)
      if (mirrored_[a]) one.moment[a] = 0.0;
    one.mass *= copies_;
    one.volume *= copies_;
    one.kinetic *= copies_;
    one.internal *= copies_;
    one.pressure_volume *= copies_;
    one.cavitated *= copies_;
    one.voids *= copies_;
    one.moment *= copies_;
  }
  return all;
}

std::vector<LargestOf> Simulation::largest() const {
  std::vector<LargestOf> all;
  const auto add = [&](std::vector<LargestOf> some) {
    for (LargestOf& each : some) all.push_back(std::move(each));
  };
  if (fluid_) add(fluid_->largest());
  if (line_) add(line_->largest());
  for (const auto& body : bodies_) add(body->largest());
  for (std::size_t k = 0; group_ && k < group_->members().size(); ++k)  // the group is all bodies that there are
    all[all.size() - group_->members().size() + k].part = group_->members()[k].name;
  if (meridian_)
    for (LargestOf& part : all)
      for (auto& [quantity, largest] : part.quantities)
        largest.place = meridian_->place_in_space(largest.place, meridian_->outward());
  return all;
}

std::string Simulation::fastest_particle() const {
  if (fluid_) return fastest_of(fluid_->field("velocity"), fluid_->field("position"), fluid_->field("id"));
  for (const auto& body : bodies_)
    if (in_particles(body)) {
      const std::string names[] = {"velocity", "position", "id"};
      const BodySnapshot now = body->snapshot(names);
      return fastest_of(now.of_points[0].values, now.of_points[1].values, now.of_points[2].values);
    }
  return {};
}

output::NamedNumbers Simulation::passes() const {
  output::NamedNumbers all;
  const auto add = [&](const PassTimers& timers) {
    for (const auto& pass : timers.seconds()) {
      const auto known = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.first == pass.first; });
      if (known == all.end()) all.push_back(pass);
      else known->second += pass.second;
    }
  };
  if (fluid_) add(fluid_->timers());
  if (flow_ && !obstacles().empty()) add(flow_->timers());
  add(driver_->timers());
  for (const auto& body : bodies_) add(body->timers());
  return all;
}

}  // namespace undex::run
