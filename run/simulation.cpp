#include "run/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/errors.hpp"

namespace undex::run {

Simulation::Simulation(const scene::Scene& scene) {
  std::vector<Finding> findings;
  const auto attempt = [&](auto build) {
    try {
      build();
    } catch (const std::invalid_argument& mistake) {
      findings.push_back({{}, mistake.what()});
    }
  };
  if (!scene.fluid.bodies.empty()) attempt([&] { fluid_ = std::make_unique<sph::Fluid>(scene.fluid); });
  if (scene.structure) attempt([&] { structure_ = std::make_unique<fem::Structure>(*scene.structure); });
  if (structure_ && scene.fluid.start_time > 0) structure_->advance(scene.fluid.start_time, {});
  if (!scene.fluid.solids.empty()) attempt([&] { solids_ = std::make_unique<sph::Solids>(scene.fluid); });
  const bool as_surface = scene.coupling.solids == coupling::SolidContact::surface;
  if (fluid_ && solids_ && !as_surface)
    attempt([&] { particle_system_ = std::make_unique<sph::ParticleSystem>(*fluid_, *solids_, scene.coupling.free_slip); });
  attempt([&] {
    if (fluid_ && structure_ && !structure_->wet_surface().faces.empty())
      participant_ = std::make_unique<coupling::ElementParticipant>(*structure_);
    else if (fluid_ && solids_ && as_surface) participant_ = std::make_unique<coupling::ParticleParticipant>(*solids_);
    if (participant_) coupler_ = std::make_unique<coupling::Coupler>(*fluid_, *participant_, scene.coupling);
  });
  if (!findings.empty()) throw SceneError(scene.file.string(), findings);

  bool planes = false;
  for (int a = 0; a < 3; ++a)
    if (scene.fluid.symmetry.axis[a]) {
      copies_ *= 2;
      planes = true;
    }
  const bool supports = scene.structure && (!scene.structure->supports.empty() || !scene.structure->loads.empty() ||
                                            !scene.structure->planes.empty());
  closed_ = !planes && scene.fluid.gravity.isZero() && scene.fluid.walls.empty() && scene.fluid.planes.empty() && !supports;
  start_mass_ = mass();
  start_momentum_ = momentum();
  if (solids_) start_angular_momentum_ = solids_->ledger().angular_momentum;
  const EnergyBalance start = energy();
  start_energy_ = start.total();
  energy_scale_ = std::abs(start_energy_);
}

double Simulation::time() const { return fluid_ ? fluid_->time() : structure_ ? structure_->time() : solids_->time(); }
long Simulation::steps() const { return fluid_ ? fluid_->steps() : structure_ ? structure_->steps() : solids_->steps(); }

void Simulation::advance(double end) {
  char text[200];
  if (coupler_) {
    const coupling::Coupler::Window window = coupler_->advance(end);
    last_step_ = window.step;
    std::snprintf(text, sizeof text, "%s (%s) x%ld, structure x%ld", window.limit.criterion.c_str(), window.limit.body.c_str(),
                  window.fluid_steps, window.structure_steps);
  } else if (particle_system_) {
    const sph::ParticleSystem::Step step = particle_system_->advance(end);
    last_step_ = step.step;
    std::snprintf(text, sizeof text, "%s (%s), solids x%ld", step.limit.criterion.c_str(), step.limit.body.c_str(),
                  step.solid_steps);
  } else if (fluid_) {
    const sph::StepLimit limit = fluid_->step_limit();
    const double left = end - fluid_->time();
    // The last few steps before `end` share what is left, so that none is tiny.
    last_step_ = left < 3.0 * limit.step ? left / std::ceil(left / limit.step - 1e-9) : limit.step;
    fluid_->step(last_step_);
    std::snprintf(text, sizeof text, "%s (%s, particle %u)", limit.criterion.c_str(), limit.body.c_str(), limit.particle);
  } else if (solids_) {
    last_step_ = std::min(solids_->stable_step(), end - solids_->time());
    std::snprintf(text, sizeof text, "%s", solids_->stable_step_owner().c_str());
    solids_->advance(solids_->time() + last_step_);
  } else {
    last_step_ = std::min(structure_->stable_step(), end - structure_->time());
    const auto timer = timers_.measure("structure");
    structure_->advance(structure_->time() + last_step_, {});
    std::snprintf(text, sizeof text, "element");
  }
  if (fluid_ && structure_ && !coupler_) structure_->advance(fluid_->time(), {});
  last_text_ = text;
}

std::string Simulation::last_step() const { return last_text_; }

EnergyBalance Simulation::energy() const {
  EnergyBalance e;
  double external = 0;
  if (fluid_) {
    const sph::Ledger l = fluid_->ledger();
    e.kinetic = copies_ * l.kinetic;
    e.internal = copies_ * l.internal;
    e.dissipated = copies_ * l.dissipated;
    e.work_given = copies_ * l.wall_work;
    e.gravity = copies_ * l.gravity;
  }
  if (structure_) {
    const fem::Energies s = structure_->energies();
    e.structure_kinetic = copies_ * s.kinetic;
    e.elastic = copies_ * s.elastic;
    e.plastic = copies_ * s.plastic;
    e.viscous = copies_ * (s.viscous + s.impact);
    external = copies_ * s.external;
    e.gravity += copies_ * s.gravity;
  }
  if (solids_) {
    const sph::SolidLedger s = solids_->ledger();
    e.structure_kinetic = copies_ * s.kinetic;
    e.elastic = copies_ * s.elastic;
    e.plastic = copies_ * s.plastic;
    e.viscous = copies_ * s.viscous;
    external = copies_ * s.external;
    e.gravity += copies_ * s.gravity;
  }
  if (coupler_ || particle_system_) e.work_received = external;
  else e.external = external;
  e.start = start_energy_;
  e.scale = std::max({energy_scale_, std::abs(e.external), std::abs(e.gravity), e.kinetic + e.structure_kinetic});
  return e;
}

/// Of what is in particles [kg]: the mass of finite elements cannot change.
double Simulation::mass() const { return (fluid_ ? fluid_->ledger().mass : 0.0) + (solids_ ? solids_->ledger().mass : 0.0); }

Vec3 Simulation::momentum() const {
  Vec3 momentum = Vec3::Zero();
  if (fluid_) momentum += fluid_->ledger().momentum;
  if (structure_) momentum += structure_->momentum();
  if (solids_) momentum += solids_->ledger().momentum;
  return momentum;
}

double Simulation::mass_error() const { return start_mass_ > 0 ? std::abs(mass() / start_mass_ - 1.0) : 0.0; }

double Simulation::momentum_error() const {
  if (!closed_) return std::numeric_limits<double>::quiet_NaN();
  const EnergyBalance e = energy();
  const double moving = mass() + (structure_ ? structure_->total_mass() : 0.0);
  const double scale = std::sqrt(2.0 * (e.kinetic + e.structure_kinetic) * moving);  // momentum if all of it went one way
  return scale > 0 ? (momentum() - start_momentum_).norm() / scale : 0.0;
}

std::optional<double> Simulation::angular_momentum_error() const {
  if (!solids_ || fluid_ || !closed_) return std::nullopt;
  const sph::SolidLedger l = solids_->ledger();
  const std::vector<double> mass = solids_->field("mass");
  double inertia = 0;  // [kg m^2]
  for (std::size_t i = 0; i < mass.size(); ++i) inertia += mass[i] * solids_->positions()[i].squaredNorm();
  const double scale = std::sqrt(2.0 * l.kinetic * inertia);  // no motion of that energy has more
  return scale > 0 ? (l.angular_momentum - start_angular_momentum_).norm() / scale : 0.0;
}

std::optional<double> Simulation::interface_energy_error() const {
  if (!coupler_) return std::nullopt;
  const coupling::InterfaceLedger l = coupler_->ledger();
  const double scale = std::max(std::abs(l.work_given), std::abs(l.work_received));
  return scale > 0 ? (l.work_given - l.work_received) / scale : 0.0;
}

std::optional<double> Simulation::interface_impulse_error() const {
  if (!coupler_) return std::nullopt;
  const coupling::InterfaceLedger l = coupler_->ledger();
  return l.impulse_exchanged > 0 ? (l.impulse_given - l.impulse_received).norm() / l.impulse_exchanged : 0.0;
}

double Simulation::maximum_pressure() const {
  return std::max(fluid_ ? fluid_->maximum_pressure() : 0.0, solids_ ? solids_->maximum_pressure() : 0.0);
}

output::NamedNumbers Simulation::passes() const {
  output::NamedNumbers all;
  const auto add = [&](const PassTimers& timers) {
    for (const auto& pass : timers.seconds()) all.push_back(pass);
  };
  if (fluid_) add(fluid_->timers());
  if (coupler_) add(coupler_->timers());
  if (solids_) add(solids_->timers());
  add(timers_);
  return all;
}

}  // namespace undex::run
