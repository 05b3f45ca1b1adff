// Hand-made particles for the pair loops, and the same sums once more by brute force: every particle against every other,
// mirrored images written out, scalar arithmetic, formulas taken from the paper and not from the code under test.
#pragma once

#include <omp.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/vector.hpp"
#include "sph_fluid/pairs/blocks.hpp"
#include "sph_fluid/pairs/pair_memory.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/schemes/loops.hpp"

namespace undex::sph::testing {

/// Runs the pair loops at the instruction set `level` while it lives; the one used before comes back after it.
class AtLevel {
 public:
  explicit AtLevel(const char* level) {
    if (const char* before = std::getenv("UNDEX_CPU_LEVEL")) before_ = before;
    setenv("UNDEX_CPU_LEVEL", level, 1);
  }
  AtLevel(const AtLevel&) = delete;
  AtLevel& operator=(const AtLevel&) = delete;
  ~AtLevel() { before_.empty() ? unsetenv("UNDEX_CPU_LEVEL") : setenv("UNDEX_CPU_LEVEL", before_.c_str(), 1); }

 private:
  std::string before_;
};

/// A fluid particle and a wall's, each with its place.
struct Particle : FluidRow {
  double x = 0, y = 0, z = 0;
};
struct WallParticle : WallRow {
  double x = 0, y = 0, z = 0;
};

/// Particles of one body.
inline WallParticle wall_particle(const Vec3& x, const Vec3& v, const Vec3& n, double volume, double slip) {
  WallParticle wall;
  wall.vx = v[0], wall.vy = v[1], wall.vz = v[2];
  wall.nx = n[0], wall.ny = n[1], wall.nz = n[2];
  wall.volume = volume;
  wall.slip = slip;
  wall.x = x[0], wall.y = x[1], wall.z = x[2];
  return wall;
}
struct Set {
  std::vector<Particle> particles;
  bool variable_h = false;
  double cell_width = 1.0;  ///< [m]
};

struct Sample {
  int dimension = 3;
  KernelName kernel = KernelName::wendland_c2;
  SchemeName scheme = SchemeName::monaghan;
  Precision precision = Precision::full;
  int threads = 0;  ///< 0: as many as there are
  double alpha = 1.0, beta = 10.0;
  bool mirror[3] = {false, false, false};
  std::vector<Set> sets;
  std::vector<WallParticle> walls;
};

/// Rates of one particle, or the force on one wall particle in `a`.
struct Rate {
  Vec3 a = Vec3::Zero();
  double compression = 0, heat = 0, closing = 0;
  Vec3 size = Vec3::Zero();  ///< sum of the terms' absolute values in `a`: what round-off is measured against
  double compression_size = 0, heat_size = 0;
};

/// What the pair loops made of a sample, in the order in which the cells put the particles.
struct Result {
  std::vector<Particle> particles;
  std::vector<WallParticle> walls;
  std::vector<GradientRow> gradients;  ///< of the Riemann scheme
  std::vector<Rate> rates, wall_forces;
  long long interactions = 0;
};

/// The coefficient of viscosity of a particle: anything within its bounds where it is a state, the same for an image.
inline double alpha_of(const Sample& s, const Particle& q) {
  return s.scheme == SchemeName::monaghan_switch ? s.alpha * (0.1 + 0.9 * std::abs(std::sin(1e4 * q.x))) : s.alpha;
}

inline Result run(const Sample& sample) {
  const PairLoops loops = pair_loops(sample.kernel, sample.scheme, sample.precision);
  Result result;
  std::vector<double> x, y, z;
  std::vector<GroupView> groups;
  std::vector<CellList> cells(sample.sets.size());
  std::vector<Particle> all;
  for (const Set& set : sample.sets) all.insert(all.end(), set.particles.begin(), set.particles.end());
  for (const Particle& q : all) {
    x.push_back(q.x);
    y.push_back(q.y);
    z.push_back(q.z);
  }
  std::uint32_t begin = 0;
  double h_largest = 0;
  for (std::size_t g = 0; g < sample.sets.size(); ++g) {
    const Set& set = sample.sets[g];
    const std::uint32_t end = begin + std::uint32_t(set.particles.size());
    cells[g].build(x.data(), y.data(), z.data(), begin, end, set.cell_width);
    for (const std::uint32_t k : cells[g].order()) result.particles.push_back(all[k]);
    double h_max = 0;
    for (const Particle& q : set.particles) h_max = std::max(h_max, q.h);
    groups.push_back({.begin = begin,
                      .end = end,
                      .grid = cells[g].view(),
                      .h_max = h_max,
                      .variable_h = set.variable_h,
                      .gas = set.variable_h,
                      .material = std::uint32_t(g)});
    h_largest = std::max(h_largest, h_max);
    begin = end;
  }
  const std::size_t n = all.size(), m = sample.walls.size();
  std::vector<FluidRow> rows(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = result.particles[i].x;
    y[i] = result.particles[i].y;
    z[i] = result.particles[i].z;
    rows[i] = result.particles[i];
  }
  std::vector<double> wx(m), wy(m), wz(m);
  std::vector<WallRow> wall_rows;
  CellList wall_cells;
  const auto spread = [&](const std::vector<WallParticle>& walls) {
    for (std::size_t k = 0; k < m; ++k) {
      wx[k] = walls[k].x;
      wy[k] = walls[k].y;
      wz[k] = walls[k].z;
    }
  };
  if (m > 0) {
    spread(sample.walls);
    wall_cells.build(wx.data(), wy.data(), wz.data(), 0, std::uint32_t(m), sample.sets.at(0).cell_width);
    for (const std::uint32_t k : wall_cells.order()) result.walls.push_back(sample.walls[k]);
    spread(result.walls);
    wall_rows.assign(result.walls.begin(), result.walls.end());
  }

  BlockOrder blocks;
  const int threads = sample.threads > 0 ? sample.threads : omp_get_max_threads();
  blocks.build(groups, loops.support * h_largest, threads);
  PairMemory memory(threads);
  PairInput in{};
  in.dimension = sample.dimension;
  in.kernel_scale = 1.0;
  in.x = x.data();
  in.y = y.data();
  in.z = z.data();
  in.fluid = rows.data();
  in.kernel = kernel_choice(sample.kernel, sample.dimension);
  result.gradients.resize(loops.second == SecondRow::gradient ? n : 0);
  std::vector<CorrectedRow> corrected(loops.second == SecondRow::corrected ? n : 0);
  std::vector<ViscosityRow> viscosity(loops.second == SecondRow::viscosity ? n : 0);
  for (std::size_t i = 0; i < viscosity.size(); ++i) viscosity[i].alpha = alpha_of(sample, result.particles[i]);
  in.second = loops.second == SecondRow::gradient    ? static_cast<void*>(result.gradients.data())
              : loops.second == SecondRow::corrected ? static_cast<void*>(corrected.data())
                                                     : viscosity.data();
  in.groups = groups.data();
  in.group_count = int(groups.size());
  in.wall_x = wx.data();
  in.wall_y = wy.data();
  in.wall_z = wz.data();
  in.wall = wall_rows.data();
  if (m > 0) in.wall_grid = wall_cells.view();
  in.wall_count = std::uint32_t(m);
  for (int a = 0; a < 3; ++a) in.mirror[a] = sample.mirror[a];
  in.alpha = sample.alpha;
  in.beta = sample.beta;
  blocks.describe(in);
  memory.describe(in);

  std::vector<SumRow> sums(n);
  std::vector<ForceRow> forces(m);
  std::vector<long long> interactions(blocks.block_count());
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  const PairOutput out{
      .fluid = sums.data(), .wall = m > 0 ? forces.data() : nullptr, .images = nullptr, .interactions = interactions.data()};
  if (loops.gradients) loops.gradients(in, out);
  loops.rates(in, out);
  omp_set_num_threads(before);
  for (std::size_t i = 0; i < n; ++i) {
    const double specific = 1.0 / rows[i].rho;
    Rate rate;
    rate.a = specific * Vec3(sums[i].fx, sums[i].fy, sums[i].fz);
    rate.compression = sums[i].compression;
    rate.heat = specific * sums[i].heat;
    rate.closing = sums[i].closing;
    result.rates.push_back(rate);
  }
  for (const ForceRow& f : forces) {
    Rate force;
    force.a = {f.fx, f.fy, f.fz};
    result.wall_forces.push_back(force);
  }
  for (const long long count : interactions) result.interactions += count;
  return result;
}

inline Vec3 place(const Particle& q) { return {q.x, q.y, q.z}; }
inline Vec3 place(const WallParticle& q) { return {q.x, q.y, q.z}; }
inline Vec3 speed(const Particle& q) { return {q.vx, q.vy, q.vz}; }
inline Vec3 speed(const WallParticle& q) { return {q.vx, q.vy, q.vz}; }

/// w(q) of the kernel named, from its formula.
inline double reference_shape(KernelName kernel, double q) {
  const auto above = [&](double end, int power) { return q < end ? std::pow(end - q, power) : 0.0; };
  const double s = q < 2.0 ? 1.0 - q / 2.0 : 0.0;
  switch (kernel) {
    case KernelName::gaussian: return q < 3.0 ? std::exp(-q * q) - std::exp(-9.0) : 0.0;
    case KernelName::wendland_c2: return std::pow(s, 4) * (2 * q + 1);
    case KernelName::wendland_c4: return std::pow(s, 6) * (35.0 / 12.0 * q * q + 3 * q + 1);
    case KernelName::wendland_c6: return std::pow(s, 8) * (4 * q * q * q + 6.25 * q * q + 4 * q + 1);
    case KernelName::cubic_spline: return above(2, 3) / 4 - above(1, 3);
    case KernelName::quintic_spline: return above(3, 5) - 6 * above(2, 5) + 15 * above(1, 5);
  }
  return 0.0;
}

/// (dw/dq)/q.
inline double reference_slope(KernelName kernel, double q) {
  const auto above = [&](double end, int power) { return q < end ? std::pow(end - q, power) : 0.0; };
  const double s = q < 2.0 ? 1.0 - q / 2.0 : 0.0;
  switch (kernel) {
    case KernelName::gaussian: return q < 3.0 ? -2.0 * std::exp(-q * q) : 0.0;
    case KernelName::wendland_c2: return -5.0 * std::pow(s, 3);
    case KernelName::wendland_c4:
      return (-3 * std::pow(s, 5) * (35.0 / 12.0 * q * q + 3 * q + 1) + std::pow(s, 6) * (35.0 / 6.0 * q + 3)) / q;
    case KernelName::wendland_c6:
      return (-4 * std::pow(s, 7) * (4 * q * q * q + 6.25 * q * q + 4 * q + 1) + std::pow(s, 8) * (12 * q * q + 12.5 * q + 4)) /
             q;
    case KernelName::cubic_spline: return (-0.75 * above(2, 2) + 3 * above(1, 2)) / q;
    case KernelName::quintic_spline: return (-5 * above(3, 4) + 30 * above(2, 4) - 75 * above(1, 4)) / q;
  }
  return 0.0;
}

inline double reference_support(KernelName kernel) {
  return kernel == KernelName::gaussian || kernel == KernelName::quintic_spline ? 3.0 : 2.0;
}

/// The factor by which (dw/dq)/q is (dW/dr)/r at h = 1: w's integral over the ball, shell by shell (Simpson's rule).
inline double reference_scale(KernelName kernel, int d) {
  const double pi = std::numbers::pi, end = reference_support(kernel);
  double integral = 0;
  const int n = 6000;
  for (int k = 0; k <= n; ++k) {
    const double s = end * k / n, weight = (k == 0 || k == n ? 1.0 : k % 2 ? 4.0 : 2.0) * end / n / 3.0;
    const double shell = d == 1 ? 2.0 : d == 2 ? 2.0 * pi * s : 4.0 * pi * s * s;
    integral += weight * shell * reference_shape(kernel, s);
  }
  return 1.0 / integral;
}

/// Monaghan's viscosity (eq. 6) with alpha and beta; `approach` is v_ij . x_ij.
inline double reference_viscosity(const Sample& s, double approach, double r2, double h, double c, double rho) {
  if (approach >= 0) return 0.0;
  const double phi = h * approach / (r2 + 0.01 * h * h);
  return (-s.alpha * c * phi + s.beta * phi * phi) / rho;
}

template <class Item>
Item mirrored(const Item& original, int image) {
  Item q = original;
  const double sx = image & 1 ? -1 : 1, sy = image & 2 ? -1 : 1, sz = image & 4 ? -1 : 1;
  q.x *= sx;
  q.y *= sy;
  q.z *= sz;
  q.vx *= sx;
  q.vy *= sy;
  q.vz *= sz;
  if constexpr (std::is_same_v<Item, WallParticle>) {
    q.nx *= sx;
    q.ny *= sy;
    q.nz *= sz;
  }
  return q;
}

inline bool has_image(const Sample& s, int image) {
  for (int a = 0; a < 3; ++a)
    if (image >> a & 1 && !s.mirror[a]) return false;
  return true;
}

/// What wall particle w does to fluid particle i: the fluid's own state mirrored at the wall's motion.
inline void add_wall(const Sample& s, const Particle& i, const WallParticle& w, Rate& sum, double gradient) {
  const Vec3 x = place(i) - place(w), u = speed(i) - speed(w), n(w.nx, w.ny, w.nz);
  const Vec3 across = w.slip > 0.5 ? Vec3(x.dot(n) * n) : x;
  const bool paper = s.scheme == SchemeName::paper;  // v_d = v_w, and the dummy's side of the work is heat
  const double approach = (paper ? 1.0 : 2.0) * u.dot(across);
  const double Pi = alpha_of(s, i) / s.alpha * reference_viscosity(s, approach, x.squaredNorm(), i.h, i.c, i.rho);
  const double mass = i.rho * w.volume;
  const Vec3 pull = -mass * (2.0 * i.p / (i.rho * i.rho) + Pi) * gradient * across;
  sum.a += pull;
  sum.size += pull.cwiseAbs();
  sum.compression += w.volume * gradient * approach;
  sum.compression_size += std::abs(w.volume * gradient * approach);
  const double heat = mass * (paper ? i.p / (i.rho * i.rho) + Pi : 0.5 * Pi) * gradient * approach;
  sum.heat += heat;
  sum.heat_size += std::abs(heat);
  sum.closing = std::max(sum.closing, std::max(0.0, -i.h * approach / (x.squaredNorm() + 0.01 * i.h * i.h)));
}

/// The sums that run() should have made, for its order of particles.
inline Result brute_force(const Sample& s, const Result& order) {
  Result result = order;
  const double support = reference_support(s.kernel);
  result.interactions = 0;
  const double scale = reference_scale(s.kernel, s.dimension);
  const auto gradient = [&](double r, double h) {
    const double q = r / h;
    return q < support ? scale * reference_slope(s.kernel, q) / std::pow(h, s.dimension + 2) : 0.0;
  };
  for (std::size_t k = 0; k < order.particles.size(); ++k) {
    const Particle& i = order.particles[k];
    Rate sum;
    for (int image = 0; image < 8; ++image) {
      if (!has_image(s, image)) continue;
      for (std::size_t l = 0; l < order.particles.size(); ++l) {
        if (l == k && image == 0) continue;
        const Particle j = mirrored(order.particles[l], image);
        const double h = 0.5 * (i.h + j.h);
        const Vec3 x = place(i) - place(j), v = speed(i) - speed(j);
        const double r = x.norm();
        if (r >= support * h) continue;
        ++result.interactions;
        const double F = gradient(r, h), approach = v.dot(x), mass = j.rho * j.volume;
        const double Pi = 0.5 * (alpha_of(s, i) + alpha_of(s, j)) / s.alpha *
                          reference_viscosity(s, approach, r * r, h, 0.5 * (i.c + j.c), 0.5 * (i.rho + j.rho));
        const Vec3 push = -mass * ((i.p + j.p) / (i.rho * j.rho) + Pi) * F * x;
        sum.a += push;
        sum.size += push.cwiseAbs();
        sum.compression += j.volume * F * approach;
        sum.compression_size += std::abs(j.volume * F * approach);
        sum.heat += 0.5 * mass * Pi * F * approach;
        sum.heat_size += std::abs(0.5 * mass * Pi * F * approach);
        sum.closing = std::max(sum.closing, std::max(0.0, -h * approach / (r * r + 0.01 * h * h)));
      }
      for (const WallParticle& wall : order.walls) {
        const WallParticle w = mirrored(wall, image);
        const double r = (place(i) - place(w)).norm();
        if (r >= support * i.h) continue;
        ++result.interactions;
        add_wall(s, i, w, sum, gradient(r, i.h));
      }
    }
    result.rates[k] = sum;
  }
  for (std::size_t k = 0; k < order.walls.size(); ++k) {
    Rate force;
    for (int image = 0; image < 8; ++image) {
      if (!has_image(s, image)) continue;
      for (const Particle& particle : order.particles) {
        const Particle i = mirrored(particle, image);
        const double r = (place(i) - place(order.walls[k])).norm();
        if (r >= support * i.h) continue;
        Rate one;
        add_wall(s, i, order.walls[k], one, gradient(r, i.h));
        force.a -= i.rho * i.volume * one.a;
        force.size += i.rho * i.volume * one.size;
      }
    }
    result.wall_forces[k] = force;
  }
  return result;
}

/// Random numbers from a fixed seed.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * double(engine_()) / 4294967296.0; }

 private:
  std::mt19937 engine_;
};

/// One particle with a random state about rho0, p0 and c0.
inline Particle random_particle(Dice& dice, const Vec3& x, int dimension, double h, double dx, double rho0, double p0,
                                double c0) {
  Particle q{};
  q.x = x[0];
  q.y = x[1];
  q.z = x[2];
  q.vx = dice.between(-100, 100);
  if (dimension > 1) q.vy = dice.between(-100, 100);
  if (dimension > 2) q.vz = dice.between(-100, 100);
  q.p = p0 * dice.between(-0.2, 1);
  q.rho = rho0 * dice.between(0.8, 1.2);
  q.c = c0 * dice.between(0.8, 1.2);
  q.volume = std::pow(dx, dimension) * dice.between(0.8, 1.2);
  q.h = h;
  return q;
}

}  // namespace undex::sph::testing
