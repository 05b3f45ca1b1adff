// Set-up and step of solids in particles.
#include "sph_solid/solids.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/errors.hpp"
#include "sph_fluid/lattice.hpp"
#include "sph_solid/meridian.hpp"
#include "sph_solid/solid_faces.hpp"
#include "sph_solid/solid_lattice.hpp"
#include "sph_solid/solids_implementation.hpp"
#include "sph_fluid/pairs/sums.hpp"

namespace undex::solid {

using namespace sph;  // pairs, cells and kernels
namespace {

/// Axis and middle of a shape with a circular section, and its radius.
struct Round {
  int axis;
  Vec3 center;
  double radius;
};

Round round_of(const Body& body) {
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape.base)) return {cylinder->axis, cylinder->center, cylinder->radius};
  if (const auto* disc = std::get_if<Sphere>(&body.shape.base)) return {2, disc->center, disc->radius};
  throw std::invalid_argument("solid '" + body.name + "': residual_stress needs a cylinder (or a disc, in two dimensions)");
}

Vec3 middle_of(const Shape& shape, int dimension) {
  const Bounds box = bounds(shape, dimension);
  Vec3 middle = Vec3::Zero();
  for (int a = 0; a < dimension; ++a)
    if (box.high[a] < 1e200 && box.low[a] > -1e200) middle[a] = 0.5 * (box.low[a] + box.high[a]);
  return middle;
}

}  // namespace

Solids::Implementation::Implementation(const Settings& given, const sph::Settings& of_all)
    : around(of_all), settings(in_meridian(given, of_all)) {
  if (settings.planes.size() > most_planes) throw std::invalid_argument("planes: at most 32 are possible");
  if (around.numerics.threads > 0) omp_set_num_threads(around.numerics.threads);
  time = around.start_time;
  fill();
  find_touching(0.0);
  find_forces(0.0);
  find_acceleration();
  first_step = 1.0 / particles.rate[fastest()];
}

void Solids::Implementation::fill() {
  const std::vector<BodyParticles> bodies = fill_solids(settings, around);
  std::size_t n = 0;
  for (const BodyParticles& body : bodies) n += body.position.size();
  particles.resize(n);
  acceleration.assign(n, Vec3::Zero());
  impulse_force.assign(n, Vec3::Zero());
  std::uint32_t at = 0;
  bool updated = false;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = settings.bodies[b];
    const materials::Solid& solid = body.material;
    SolidGroup group{
        &body,   at, at + std::uint32_t(bodies[b].position.size()), body.spacing.value_or(around.lattice.spacing), 0.0,
        nullptr, {}};
    group.h = settings.numerics.eta * group.spacing;
    for (std::size_t k = 0; k < bodies[b].position.size(); ++k, ++at) {
      particles.start[at] = particles.x[at] = bodies[b].position[k];
      particles.rho[at] = solid.rho0;
      particles.mass[at] = solid.rho0 * bodies[b].volume[k];
      particles.temperature[at] = solid.T_room;
      particles.sound[at] = materials::wave_speed(solid);
    }
    start_motion(group);
    hold_supports(group);
    for (const RigidPlane& plane : settings.planes)
      group.layer.push_back(outer_layer(plane, body, particles, group.begin, group.end, group.spacing, around.dimension));
    if (body.residual_stress != 0.0) start_stress(group);
    if (body.description == Description::total_lagrangian)
      group.lagrangian = std::make_unique<TotalLagrangian>(settings, around, body, group.begin, group.end, group.h, group.spacing,
                                                           bodies[b].volume, group.layer, particles);
    else updated = true;
    groups.push_back(std::move(group));
  }
  if (updated || groups.size() > 1) {
    std::vector<SolidPairs::Range> ranges;
    for (const SolidGroup& group : groups)
      ranges.push_back({.begin = group.begin,
                        .end = group.end,
                        .spacing = group.spacing,
                        .h = group.h,
                        .updated = group.lagrangian == nullptr,
                        .body = group.body});
    pairs = std::make_unique<SolidPairs>(settings, around, std::move(ranges));
  }
}

void Solids::Implementation::start_motion(const SolidGroup& group) {
  const Vec3 middle = middle_of(group.body->shape, around.dimension);
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    particles.v[i] = group.body->velocity + group.body->spin.cross(particles.x[i] - middle);
    if (group.body->radial) particles.v[i] += group.body->radial->at(particles.x[i]);
  }
}

void Solids::Implementation::hold_supports(const SolidGroup& group) {
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    std::array<bool, 3> fixed{};
    for (const Support& support : group.body->supports)
      if (is_near_face(*group.body, support.face, particles.start[i], group.spacing, around.dimension))
        for (std::size_t a = 0; a < 3; ++a) fixed[a] = fixed[a] || support.fixed[a];
    if (fixed != std::array<bool, 3>{}) held.push_back({i, fixed});
  }
  hold(particles.v);
}

void Solids::Implementation::start_stress(const SolidGroup& group) {
  const Round body = round_of(*group.body);
  const materials::Solid& solid = group.body->material;
  const double S = group.body->residual_stress, nu3 = 3.0 * materials::bulk_modulus(solid) - 2.0 * solid.shear_modulus;
  const double poisson = nu3 / (2.0 * (3.0 * materials::bulk_modulus(solid) + solid.shear_modulus));
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    Vec3 radial = particles.x[i] - body.center;
    radial[body.axis] = 0.0;
    const double square = radial.squaredNorm() / (body.radius * body.radius);
    const Vec3 e = radial.normalized();
    Mat3 sigma = S * (1.0 - 3.0 * square) * Mat3::Identity() + 2.0 * S * square * e * e.transpose();
    // Plane strain along the axis; a free cylinder of finite length is not in equilibrium near its ends.
    for (int a = 0; a < 3; ++a) sigma(body.axis, a) = sigma(a, body.axis) = 0.0;
    sigma(body.axis, body.axis) = around.dimension == 2 ? poisson * sigma.trace() : 0.0;
    const double pressure = -sigma.trace() / 3.0;
    const Mat3 s = sigma + pressure * Mat3::Identity();
    const double component[6] = {s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(2, 0), s(0, 1)};
    for (int k = 0; k < 6; ++k) particles.deviator[k][i] = component[k];
    // The density that carries this pressure, by the tangent at rest and one correction.
    double rho = solid.rho0 * (1.0 + pressure / materials::bulk_modulus(solid));
    rho += solid.rho0 * (pressure - materials::evaluate(solid.pressure, solid.rho0, rho, 0.0).pressure) /
           materials::bulk_modulus(solid);
    particles.mass[i] *= rho / particles.rho[i];
    particles.rho[i] = rho;
    particles.pressure[i] = materials::evaluate(solid.pressure, solid.rho0, rho, 0.0).pressure;
  }
}

// ---- The step -------------------------------------------------------------------------------------------------------

void Solids::Implementation::step(double dt) {
  const std::uint32_t n = std::uint32_t(particles.size());
  integrator_jumps += held_back(dt) - integrator_held;
  {
    const auto timer = timers.measure("solid integration");
    received_work += 0.5 * dt * blocked_sum<double>(0, n, [&](std::uint32_t i) {
                       return impulse_force[i].dot(particles.v[i] + 0.5 * dt * acceleration[i]);
                     });
#pragma omp parallel for schedule(static)
    for (std::uint32_t i = 0; i < n; ++i) particles.v[i] += 0.5 * dt * acceleration[i];
    book_images(0.5 * dt);
    meet_planes(dt);
#pragma omp parallel for schedule(static)
    for (std::uint32_t i = 0; i < n; ++i) particles.x[i] += dt * particles.v[i];
  }
  find_forces(dt);
  find_acceleration();
  expect_sound(dt);
  time += dt;
  last_step = dt;
  ++steps;
  {
    const auto timer = timers.measure("solid integration");
    received_work += 0.5 * dt * blocked_sum<double>(0, n, [&](std::uint32_t i) { return impulse_force[i].dot(particles.v[i]); });
#pragma omp parallel for schedule(static)
    for (std::uint32_t i = 0; i < n; ++i) particles.v[i] += 0.5 * dt * acceleration[i];
    book_images(0.5 * dt);
    release();
  }
  integrator_held = held_back(dt);
}

void Solids::Implementation::expect_sound(double dt) {
  std::uint32_t worst = fastest();
  const char* what = "is crushed: its stable step has fallen below 1e-4 of the first one";
  bool good = particles.rate[worst] < 1e4 / first_step;
  for (std::uint32_t i = 0; i < particles.size(); ++i)
    if (!acceleration[i].allFinite() || !std::isfinite(particles.rate[i])) {
      worst = i;
      what = "holds a value that is not finite";
      good = false;
      break;
    }
  if (good) return;
  const std::string text = description_of(worst, what, dt);
  for (std::uint32_t i = 0; i < particles.size(); ++i) particles.x[i] -= 0.5 * dt * particles.v[i];
  time += 0.5 * dt;
  throw NumericalStop(text);
}

void Solids::Implementation::find_forces(double dt) {
  const auto timer = timers.measure("solid forces");
  std::fill(particles.force.begin(), particles.force.end(), Vec3::Zero());
  if (dt > 0.0)
    for (const SolidGroup& group : groups)
      if (group.lagrangian) group.lagrangian->update(particles, dt);
  for (const SolidGroup& group : groups)
    if (group.lagrangian) group.lagrangian->add_forces(particles, acceleration, dt);
  if (pairs) pairs->add_forces(particles, acceleration, dt);
}

void Solids::Implementation::find_acceleration() {
#pragma omp parallel for schedule(static)
  for (std::uint32_t i = 0; i < particles.size(); ++i)
    acceleration[i] = (particles.force[i] + impulse_force[i]) / particles.mass[i] + around.gravity;
  hold(acceleration);
}

void Solids::Implementation::hold(std::vector<Vec3>& vectors) const {
  for (const auto& [particle, fixed] : held)
    for (std::size_t a = 0; a < 3; ++a)
      if (fixed[a]) vectors[particle][Eigen::Index(a)] = 0.0;
}

double Solids::Implementation::held_back(double dt) const {
  return dt * dt / 8.0 * blocked_sum<double>(0, std::uint32_t(particles.size()), [&](std::uint32_t i) {
           return particles.mass[i] * acceleration[i].squaredNorm();
         });
}

std::uint32_t Solids::Implementation::fastest() const {
  std::uint32_t at = 0;
  for (std::uint32_t i = 1; i < particles.size(); ++i)
    if (!(particles.rate[i] <= particles.rate[at])) at = i;
  return at;
}

const SolidGroup& Solids::Implementation::group_of(std::uint32_t particle) const {
  for (const SolidGroup& group : groups)
    if (particle < group.end) return group;
  return groups.back();
}

std::string Solids::Implementation::description_of(std::uint32_t i, const char* what, double dt) const {
  std::ostringstream text;
  const Vec3 &x = particles.x[i], &start = particles.start[i];
  text << "solid '" << group_of(i).body->name << "', step " << steps << ", time " << time << " s: particle " << i << ", from ("
       << start[0] << ", " << start[1] << ", " << start[2] << ") m, now at (" << x[0] << ", " << x[1] << ", " << x[2] << ") m, "
       << what << "; the step was " << dt << " s; a smaller solid_scheme.courant (" << settings.numerics.courant
       << "), or description = \"updated_lagrangian\" for a body that is torn, may help";
  return text.str();
}

double Solids::Implementation::stable_step() const { return settings.numerics.courant / particles.rate[fastest()]; }

void Solids::Implementation::advance(double t_end, std::span<const Vec3> wet_impulse) {
  if (!wet_impulse.empty() && wet_impulse.size() != surface.nodes.size())
    throw std::invalid_argument("solids: " + std::to_string(wet_impulse.size()) + " impulses for " +
                                std::to_string(surface.nodes.size()) + " wet nodes; give one per node of wet_surface(), or none");
  const double interval = t_end - time;
  if (!(interval > 0.0) || !std::isfinite(interval)) {
    std::ostringstream text;
    text << "solids: cannot advance from " << time << " s to " << t_end << " s; give a later time";
    throw std::invalid_argument(text.str());
  }
  if (around.numerics.threads > 0) omp_set_num_threads(around.numerics.threads);
  surface_has_moved = !surface_points.empty();
  spread_impulse(wet_impulse, interval);
  find_acceleration();
  for (;;) {
    const double left = t_end - time;
    const double count = std::max(1.0, std::ceil(left / stable_step() * (1.0 - 1e-12)));
    step(left / count);
    if (count == 1.0) break;
  }
  time = t_end;
}

/// What a step goes on from, and what others read between two steps.
void Solids::Implementation::visit_state(StateVisitor& state) {
  state("time", time);
  state("steps", steps);
  state("last step", last_step);
  state("received work", received_work);
  state("plane work", plane_work);
  state("plane impulse", plane_impulse);
  state("integrator jumps", integrator_jumps);
  state("integrator held", integrator_held);
  state.part("particles", [&] { particles.visit_state(state); });
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].lagrangian) state.part("body " + std::to_string(g), [&] { groups[g].lagrangian->visit_state(state); });
  state("acceleration", acceleration);
  state("impulse force", impulse_force);
  state("timers", timers);
  surface_has_moved = surface_has_moved || (state.restores() && !surface_points.empty());
}

// ---- The public face ------------------------------------------------------------------------------------------------

Solids::Solids(const Settings& settings, const sph::Settings& around)
    : self_(std::make_unique<Implementation>(settings, around)) {}
Solids::~Solids() = default;
Solids::Solids(Solids&&) noexcept = default;
Solids& Solids::operator=(Solids&&) noexcept = default;

void Solids::visit_state(StateVisitor& state) { self_->visit_state(state); }
double Solids::stable_step() const { return self_->stable_step(); }
void Solids::advance(double t_end, std::span<const Vec3> impulse) { self_->advance(t_end, impulse); }

void Solids::kick(std::span<const Vec3> impulse) {
  Implementation& s = *self_;
  for (std::size_t i = 0; i < s.particles.size(); ++i) {
    const Vec3 change = impulse[i] / s.particles.mass[i];
    s.received_work += impulse[i].dot(s.particles.v[i] + 0.5 * change);
    s.particles.v[i] += change;
  }
  s.hold(s.particles.v);
  s.surface_has_moved = !s.surface_points.empty();
}

}  // namespace undex::solid
