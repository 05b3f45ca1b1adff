// Set-up of a fluid: particles in their places, walls, the first evaluation.
#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "sph_fluid/lattice.hpp"
#include "sph_fluid/water/fluid_implementation.hpp"
#include "sph_fluid/water/settle.hpp"
namespace undex::sph {
namespace {

/// Names are those of the library or of the scene's tables; changed copies have names of their own.
bool same_material(const materials::Fluid& a, const materials::Fluid& b) {
  return a.name == b.name && a.law.index() == b.law.index() && a.rho0 == b.rho0;
}

}  // namespace

Fluid::Implementation::Implementation(const Settings& given) : Water(given), local_steps(*this) { begin(fill_bodies(settings)); }

void Fluid::Implementation::begin(std::vector<BodyParticles> bodies) {
  all = ParticleSet{};
  exchange = {.dissipated = settings.heat_before};
  clamps = {};
  evaluation.count_anew();
  fill(std::move(bodies));
  lifted = fall();
  filled = volume();
  evaluation.pack_walls(all);
  all.particles.make_room(evaluation.loops().second, settings.numerics.alpha, settings.numerics.integrator == Integrator::ssp_rk3,
                          settings.axisymmetric);
  evaluation.signals().expect_everywhere();
  radiating.begin_anew();
  evaluate(all, {.time = clock.time});
  if (walls.lined.empty() && walls.mirrors.size() == radiating.count()) evaluation.signals().watch(settings, all);
}

void Fluid::Implementation::settle(const SettleNews& news) {
  if (settings.lattice.settle && !settings.bodies.empty()) {
    // From one start rings may find no way to the goal, and another start leads elsewhere.
    constexpr double as_laid = 1e300;
    // Beside moving walls a section settled as a plane is all there is.
    const bool beside = settings.axisymmetric && !walls.mirrors.empty();
    std::vector<double> starts{as_laid};
    if (beside) starts = {settled_residual};
    else if (settings.axisymmetric) starts = {2e-2, as_laid, settled_residual};
    std::vector<BodyParticles> best;
    double least = 1e300;
    for (const double start : starts) {
      std::vector<BodyParticles> bodies = fill_bodies(settings);
      if (start < as_laid) settle_section(bodies, start, news);
      const double left = beside ? 0.0 : settle_in_place(bodies, news);
      if (left < least) best = std::move(bodies), least = left;
      if (least <= settled_residual) break;
    }
    begin(std::move(best));
  }
  for (Body& body : settings.bodies) body.start.reset();  // it may hold much
}

double Fluid::Implementation::settle_in_place(std::vector<BodyParticles>& bodies, const SettleNews& news) {
  const std::vector<Body> given = settings.bodies;
  const Vec3 gravity = settings.gravity;
  const Surroundings surroundings = settings.surroundings;
  const double left = sph::settle(*this, bodies, settled_residual, news).residual;
  std::copy(given.begin(), given.end(), settings.bodies.begin());  // groups point to them
  settings.gravity = gravity;
  settings.surroundings = surroundings;
  return left;
}

void Fluid::Implementation::settle_section(std::vector<BodyParticles>& bodies, double goal, const SettleNews& news) const {
  Settings flat = settings;
  flat.axisymmetric = false;
  std::vector<BodyParticles> sections = fill_bodies(flat);
  Water plane(flat);
  plane.walls = walls;
  if (!sph::settle(plane, sections, goal, news).moved) return;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::vector<double>& volume = bodies[b].volume;
    const double before = std::accumulate(volume.begin(), volume.end(), 0.0);
    for (std::size_t k = 0; k < volume.size(); ++k) volume[k] *= sections[b].position[k][0] / bodies[b].position[k][0];
    const double scale = before / std::accumulate(volume.begin(), volume.end(), 0.0);
    for (double& one : volume) one *= scale;
    bodies[b].position = std::move(sections[b].position);
  }
}

void Fluid::Implementation::fill(std::vector<BodyParticles> bodies) {
  std::size_t n = 0;
  for (const BodyParticles& body : bodies) n += body.position.size();
  bool has_energy = false;
  for (const Body& body : settings.bodies) has_energy = has_energy || materials::uses_energy(body.material.law);
  Particles& particles = all.particles;
  particles.resize(n, has_energy);
  std::uint32_t at = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = settings.bodies[b];
    Group group;
    group.body = &settings.bodies[b];
    group.begin = group.first_id = at;
    group.spacing = body.spacing.value_or(settings.lattice.spacing);
    group.h0 = group.h_max = smoothing_length(settings, group.spacing);
    const double energy = start_energy(body), rho = start_density(body);
    const Vec3 center = middle(body.shape.base, settings.dimension);
    group.rest_density = rho;
    std::optional<materials::HydrostaticColumn> column;
    if (body.level) column = hydrostatic_column(body, settings.gravity, settings.dimension);
    for (std::size_t k = 0; k < bodies[b].position.size(); ++k, ++at) {
      const Vec3& x = bodies[b].position[k];
      Vec3 velocity = body.velocity;
      if (const Vec3 away = x - center; body.radial_velocity != 0.0) velocity += body.radial_velocity / away.norm() * away;
      if (body.radial) velocity += body.radial->at(x);
      if (!body.spin.isZero(0.0)) velocity += body.spin.cross(x - center);
      particles.x[at] = x[0];
      particles.y[at] = x[1];
      particles.z[at] = x[2];
      particles.vx[at] = velocity[0];
      particles.vy[at] = velocity[1];
      particles.vz[at] = velocity[2];
      particles.rho[at] = column ? column->density((x - *body.level).dot(settings.gravity) / settings.gravity.norm()) : rho;
      particles.mass[at] = particles.rho[at] * bodies[b].volume[k];
      if (has_energy) particles.energy[at] = energy;
      particles.id[at] = at;
      if (body.burn) group.lighting.push_back(body.burn->lighting_time(x));
    }
    group.end = at;
    group.laid = group.end - group.begin;
    group.material = std::uint32_t(b);
    for (std::size_t earlier = b; earlier-- > 0;)
      if (same_material(settings.bodies[earlier].material, body.material)) group.material = std::uint32_t(earlier);
    bodies[b] = {};  // its memory is wanted
    if (body.start && !body.start->laid.position.empty()) take(body.start->laid, group);
    else if (body.start) lay_on(*body.start, group);
    if (body.start && body.start->laid.position.empty() && body.start->rest_pressure && column)
      weigh_down(group, *column, *body.start->rest_pressure);
    all.groups.push_back(std::move(group));
  }
}

void Fluid::Implementation::take(const LaidParticles& laid, const Group& group) {
  Particles& p = all.particles;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::size_t k = i - group.begin;
    p.rho[i] = laid.density[k];
    p.mass[i] = laid.mass[k];
    p.vx[i] = laid.velocity[k][0];
    p.vy[i] = laid.velocity[k][1];
    p.vz[i] = laid.velocity[k][2];
    if (materials::uses_energy(group.body->material.law)) p.energy[i] = laid.energy[k];
  }
}

void Fluid::Implementation::lay_on(const StartField& start, Group& group) {
  Particles& p = all.particles;
  const bool with_energy = materials::uses_energy(group.body->material.law);
  double mass = 0, kinetic = 0, internal = 0;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const double cell = p.mass[i] / p.rho[i];
    const StartState state = start.state({p.x[i], p.y[i], p.z[i]}, group.spacing);
    p.rho[i] = state.density;
    p.mass[i] = state.density * cell;
    p.vx[i] = state.velocity[0];
    p.vy[i] = state.velocity[1];
    p.vz[i] = state.velocity[2];
    if (with_energy) p.energy[i] = state.energy;
    mass += p.mass[i];
    kinetic += 0.5 * p.mass[i] * state.velocity.squaredNorm();
    internal += p.mass[i] * state.energy;
  }
  if (start.mass <= 0) return;
  const double heavier = start.mass / mass;
  if (start.exact) return make_exact(start, group, heavier);
  // Velocities are means by mass and keep their momentum; scaled to the kinetic energy they would push too hard (by 1 %
  // at a spacing of a tenth of the charge's radius).
  const double heat = start.kinetic_energy - kinetic * heavier;
  const double hotter = internal > 0 ? (start.internal_energy + heat) / (internal * heavier) : 1.0;
  if (!with_energy) exchange.dissipated += heat;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    p.mass[i] *= heavier;
    if (with_energy) p.energy[i] *= hotter;
  }
}

void Fluid::Implementation::weigh_down(const Group& group, const materials::HydrostaticColumn& column, double rest_pressure) {
  Particles& p = all.particles;
  const Body& body = *group.body;
  const materials::FluidLaw& law = body.material.law;
  const Vec3 down = settings.gravity.normalized();
  const bool with_energy = materials::uses_energy(law);
#pragma omp parallel for schedule(static)
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const double energy = with_energy ? p.energy[i] : 0.0;
    const auto [pressure, voids] = std::visit(
        [&](const auto& each) {
          return std::pair(each.evaluate(p.rho[i], energy).pressure, each.void_fraction(p.rho[i], energy));
        },
        law);
    if (voids > 0.0) continue;  // vapour weighs nothing
    const double more = column.pressure((place_of(p, i) - *body.level).dot(down)) - rest_pressure;
    const double rho = materials::density_at(law, std::max(pressure + more, materials::least_pressure(law)), energy);
    p.mass[i] *= rho / p.rho[i];
    p.rho[i] = rho;
  }
}

void Fluid::Implementation::make_exact(const StartField& start, const Group& group, double heavier) {
  Particles& p = all.particles;
  const materials::FluidLaw& law = group.body->material.law;
  const bool with_energy = materials::uses_energy(law);
  const auto velocity = [&](std::uint32_t i) { return Vec3(p.vx[i], p.vy[i], p.vz[i]); };

  Vec3 momentum = Vec3::Zero();
  double sum_of_speeds = 0;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    p.mass[i] *= heavier;
    momentum += p.mass[i] * velocity(i);
    sum_of_speeds += p.mass[i] * velocity(i).norm();
  }
  Vec3 lacking = start.momentum - momentum;
  for (int a = 0; a < 3; ++a)
    if (a >= settings.dimension || settings.symmetry.axis[a]) lacking[a] = 0.0;
  if (lacking.norm() > 1e-15 * sum_of_speeds && sum_of_speeds > 0)  // in proportion to the speed, so that rest stays rest
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const Vec3 more = velocity(i).norm() / sum_of_speeds * lacking;
      p.vx[i] += more[0];
      p.vy[i] += more[1];
      p.vz[i] += more[2];
    }

  double kinetic = 0, internal = 0;
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    kinetic += 0.5 * p.mass[i] * velocity(i).squaredNorm();
    internal += p.mass[i] * (with_energy ? p.energy[i] : materials::barotropic_energy(law, p.rho[i]));
  }
  const double heat = start.kinetic_energy + start.internal_energy - kinetic - internal;
  if (!with_energy) {
    exchange.dissipated += heat;
    return;
  }
  // Motion that is lost becomes heat where it was; but none is taken where there is little.
  const auto share = [&](std::uint32_t i) { return kinetic > 0 ? 0.5 * velocity(i).squaredNorm() * heat / kinetic : 0.0; };
  bool in_motion = kinetic > 0;
  for (std::uint32_t i = group.begin; i < group.end; ++i) in_motion = in_motion && share(i) >= -0.5 * std::abs(p.energy[i]);
  for (std::uint32_t i = group.begin; i < group.end; ++i)
    p.energy[i] += in_motion ? share(i) : p.energy[i] * (internal != 0 ? heat / internal : 0.0);
}

}  // namespace undex::sph
