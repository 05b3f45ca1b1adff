// The strong-stability-preserving Runge-Kutta method of third order (Shu, Osher 1988, J. Comput. Phys. 77, 439, eq. 2.18), for
// u = (x, v, ln rho, e, and alpha of a viscosity with a switch):
//   u1 = u + dt L(u),   u2 = 3/4 u + 1/4 (u1 + dt L(u1)),   u' = 1/3 u + 2/3 (u2 + dt L(u2))
// that is u' = u + dt (L(u)/6 + L(u1)/6 + 2 L(u2)/3): what walls receive is booked with these weights, so nothing is lost.
// The logarithm keeps densities positive. Rates of the step's end are those of the next step's beginning: three evaluations.
// A step of which a stage goes wrong is not taken.
#include <algorithm>
#include <cmath>

#include "sph_fluid/water/solver.hpp"
#include "sph_fluid/pairs/sums.hpp"

namespace undex::sph {

void Fluid::Implementation::step_ssp_rk3(double dt) {
  const std::vector<WallMotion> walls_before = walls_seen, walls_after = wall_motions();
  const struct {
    double share, weight, at;  // see stage(); time of the stage's result as a share of the step
  } stages[] = {{1.0, 1.0 / 6.0, 1.0}, {0.25, 1.0 / 6.0, 0.5}, {2.0 / 3.0, 2.0 / 3.0, 1.0}};
  for (const auto& [share, weight, at] : stages) {
    require(stage(dt, share, weight));
    evaluation_time = time + at * dt;
    for (std::size_t w = 0; w < moving.size(); ++w)
      show(moving[w], at < 1.0 ? between(walls_before[w], walls_after[w], dt, at) : walls_after[w]);
    evaluate(0.0, 0.0);
    require(sound);
  }
}

bool Fluid::Implementation::stage(double dt, double share, double weight) {
  const auto timer = timers.measure("integration");
  book_exchange(weight * dt);
  Particles& p = particles;
  const ParticleState& start = p.start;
  const double kept = 1.0 - share, low = settings.numerics.alpha_min, high = settings.numerics.alpha;
  double largest_square = 0;
#pragma omp parallel for schedule(static) reduction(max : largest_square)
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    const SumRow& rate = p.rate[i];
    p.x[i] = kept * start.x[i] + share * (p.x[i] + dt * p.vx[i]);
    p.y[i] = kept * start.y[i] + share * (p.y[i] + dt * p.vy[i]);
    p.z[i] = kept * start.z[i] + share * (p.z[i] + dt * p.vz[i]);
    p.vx[i] = kept * start.vx[i] + share * (p.vx[i] + dt * rate.fx);
    p.vy[i] = kept * start.vy[i] + share * (p.vy[i] + dt * rate.fy);
    p.vz[i] = kept * start.vz[i] + share * (p.vz[i] + dt * rate.fz);
    largest_square = std::max(largest_square, p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
    p.rho[i] = start.rho[i] * std::exp(share * (std::log(p.rho[i] / start.rho[i]) + dt * rate.compression));
    if (has_energy) p.energy[i] = kept * start.energy[i] + share * (p.energy[i] + dt * rate.heat);
    if (!p.viscosity.empty()) {
      const auto [decay, source] = switch_rates(i);
      double& alpha = p.viscosity[i].alpha;
      alpha = kept * start.viscosity[i].alpha + share * (alpha + dt * (decay * (low - alpha) + source * (high - alpha)));
      alpha = std::clamp(alpha, low, high);  // left at steps beyond the limits only
    }
  }
  cross_mirrors();
  return largest_square < fastest * fastest;
}

std::vector<WallMotion> Fluid::Implementation::wall_motions() const {
  std::vector<WallMotion> motions;
  for (const MovingWall& wall : moving) motions.push_back({wall.position, wall.velocity, wall.normal});
  return motions;
}

WallMotion Fluid::Implementation::between(const WallMotion& before, const WallMotion& after, double dt, double share) {
  WallMotion wall = after;
  const double s = share, r = 1.0 - share;
  for (std::size_t k = 0; k < wall.position.size(); ++k) {
    wall.position[k] = r * r * (1.0 + 2.0 * s) * before.position[k] + s * s * (1.0 + 2.0 * r) * after.position[k] +
                       s * r * dt * (r * before.velocity[k] - s * after.velocity[k]);
    wall.velocity[k] = r * before.velocity[k] + s * after.velocity[k];
    if (wall.normal.size() > k) wall.normal[k] = (r * before.normal[k] + s * after.normal[k]).normalized();
  }
  return wall;
}

void Fluid::Implementation::show(MovingWall& wall, const WallMotion& motion) {
  wall.position = motion.position;
  wall.velocity = motion.velocity;
  wall.normal = motion.normal;
}

}  // namespace undex::sph
