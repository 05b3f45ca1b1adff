#include "run/particle_state.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run/rest.hpp"
#include "scene/revolution.hpp"
#include "sph_fluid/lattice.hpp"

namespace undex::run {
namespace {

constexpr sph::KernelName kernel = sph::KernelName::wendland_c2;
constexpr double support = 2.0;  // of the kernel, in h

constexpr double spacings = 1.2;       // h over the particles' spacing
constexpr double of_width = 0.559017;  // h over the width of a cell of the same variance: 4 h^2/15 = width^2/12
constexpr double least_volume = 0.1;   // share of the volume about a place without which nobody is there

/// Fits q ~ a + b . (x - x0)/h to weighted neighbours; a is the value at x0.
class LinearFit {
 public:
  explicit LinearFit(int dimension) {
    for (int a = dimension; a < 3; ++a) moments_(a + 1, a + 1) = 1.0;  // there are no offsets
  }
  void add(double weight, const Vec3& offset) {
    const Eigen::Vector4d powers(1.0, offset[0], offset[1], offset[2]);
    moments_ += weight * powers * powers.transpose();
    neighbours_.push_back({weight, powers});
  }
  bool empty() const { return moments_(0, 0) <= 0; }
  /// Factors of the neighbours' values; their sum is one. Where the neighbours span no gradient: those of the mean.
  std::vector<double> factors() const {
    Eigen::Vector4d row = Eigen::Vector4d::Unit(0) / moments_(0, 0);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(moments_ / moments_(0, 0));
    constexpr double least = 1e-3;  // of the eigenvalues; on a lattice the least is some 0.2
    if (solver.eigenvalues()[0] > least) row = moments_.ldlt().solve(Eigen::Vector4d(Eigen::Vector4d::Unit(0)));
    std::vector<double> factors;
    factors.reserve(neighbours_.size());
    for (const Neighbour& one : neighbours_) factors.push_back(one.weight * row.dot(one.powers));
    return factors;
  }

 private:
  struct Neighbour {
    double weight;
    Eigen::Vector4d powers;
  };
  Eigen::Matrix4d moments_ = Eigen::Matrix4d::Zero();
  std::vector<Neighbour> neighbours_;
};

/// A weighted sum of differences from a value, within the range of what was summed.
struct Mean {
  double base, sum = 0, least = 1e300, most = -1e300;
  void add(double factor, double value) {
    sum += factor * (value - base);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double value() const { return std::clamp(base + sum, least, most); }
};

}  // namespace

std::vector<Vec3> ParticleState::places_of(const Simulation& simulation) {
  const std::vector<double> x = simulation.fluid()->field("position"), id = simulation.fluid()->field("id");
  std::vector<Vec3> places(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) places[std::size_t(id[i])] = Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  return places;
}

ParticleState::ParticleState(const scene::Scene& scene, const Simulation& simulation, const std::vector<Vec3>& start,
                             double threshold, double widest)
    : dimension_(scene.meridian ? 2 : scene.fluid.dimension), meridian_(scene.meridian), spacing_(scene.fluid.lattice.spacing) {
  planes_ = scene::for_solvers(scene).fluid.symmetry.axis;
  const sph::Fluid& fluid = *simulation.fluid();
  const auto x = fluid.field("position"), v = fluid.field("velocity"), m = fluid.field("mass"), rho = fluid.field("density"),
             e = fluid.field("energy"), h = fluid.field("smoothing_length"), body = fluid.field("material"),
             id = fluid.field("id");
  const std::size_t count = scene.fluid.bodies.size();
  bodies_.resize(count);
  totals_.resize(count);
  // At rest: density, speed of sound; a signal as share of both, and the way that it moves a particle [m].
  std::vector<double> at_rest(count), sound(count), signal(count), step(count);
  for (std::size_t b = 0; b < count; ++b) {
    const sph::Body& one = scene.fluid.bodies[b];
    at_rest[b] = start_density(one);
    sound[b] =
        std::visit([&](const auto& law) { return law.evaluate(at_rest[b], start_energy(one)).sound_speed; }, one.material.law);
    signal[b] = std::min(0.01, threshold / (at_rest[b] * sound[b] * sound[b]));
    step[b] = signal[b] * sph::smoothing_length(scene.fluid, one.spacing.value_or(spacing_));
  }
  std::vector<std::function<Rest(const Vec3&)>> column(count);  // of bodies that are hydrostatic
  for (std::size_t b = 0; b < count; ++b)
    if (scene.fluid.bodies[b].level) column[b] = rest_of(scene.fluid.bodies[b], scene);
  const auto in_space = [&](const Vec3& place) {
    return meridian_ ? meridian_->place_in_space(place, meridian_->outward()) : place;
  };
  const int copies = scene::mirror_copies(scene);
  std::vector<Vec3> momentum(count, Vec3::Zero());
  for (std::size_t i = 0; i < m.size(); ++i) {
    const std::size_t b = std::size_t(body[i]);
    Particle p;
    p.x = Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
    p.v = Vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    p.rho = rho[i];
    p.energy = e[i];
    p.volume = m[i] / rho[i];
    if (meridian_) p.volume /= 2.0 * std::numbers::pi * std::max(p.x[0], 1e-6 * spacing_);
    p.h = h[i] * spacings / scene.fluid.numerics.eta;
    p.image = false;
    const double rest = column[b] ? column[b](in_space(p.x)).density : at_rest[b];
    const auto number = std::size_t(id[i]);  // beyond those of the start: half of one that has split
    p.moved = p.v.norm() > signal[b] * sound[b] || std::abs(p.rho - rest) > signal[b] * rest || number >= start.size() ||
              (p.x - start[number]).norm() > step[b];
    bodies_[b].moved = bodies_[b].moved || p.moved;
    bodies_[b].particles.push_back(p);
    BodyTotals& sum = totals_[b];
    sum.mass += copies * m[i];
    sum.kinetic += copies * 0.5 * m[i] * p.v.squaredNorm();
    sum.internal += copies * m[i] * e[i];
    momentum[b] += m[i] * p.v;
  }
  for (std::size_t b = 0; b < count; ++b) {
    for (int a = 0; a < dimension_; ++a) {  // what a plane mirrors goes both ways
      if (planes_[a]) continue;
      const Vec3 axis = !meridian_ ? Vec3(Vec3::Unit(a)) : Vec3(meridian_->along());
      totals_[b].momentum += copies * momentum[b][a] * axis;
    }
    // Images, behind one plane after another.
    std::vector<Particle>& particles = bodies_[b].particles;
    double reach = 0;
    for (const Particle& p : particles) reach = std::max(reach, support * std::max(p.h, of_width * widest));
    bodies_[b].reach = reach;
    for (int a = 0; a < dimension_; ++a) {
      if (!planes_[a]) continue;
      const std::size_t before = particles.size();
      for (std::size_t k = 0; k < before; ++k)
        if (particles[k].x[a] < reach) {
          Particle image = particles[k];
          image.x[a] = -image.x[a];
          image.v[a] = -image.v[a];
          image.image = true;
          particles.push_back(image);
        }
    }
    bodies_[b].sort();
  }
}

void ParticleState::Body::sort() {
  first.assign(2, 0);
  if (particles.empty()) return;
  Bounds box;
  for (const Particle& p : particles) box.include(p.x);
  low = box.low;
  cell = reach;
  for (int a = 0; a < 3; ++a) count[a] = std::max(1, int((box.high[a] - box.low[a]) / cell) + 1);
  const auto cell_of = [&](const Vec3& x) {
    std::size_t index = 0;
    for (int a = 2; a >= 0; --a) index = index * count[a] + std::clamp(int((x[a] - low[a]) / cell), 0, count[a] - 1);
    return index;
  };
  std::stable_sort(particles.begin(), particles.end(),
                   [&](const Particle& one, const Particle& other) { return cell_of(one.x) < cell_of(other.x); });
  first.assign(std::size_t(count[0]) * count[1] * count[2] + 1, particles.size());
  for (std::size_t k = particles.size(); k-- > 0;) first[cell_of(particles[k].x)] = k;
  for (std::size_t k = first.size() - 1; k-- > 0;) first[k] = std::min(first[k], first[k + 1]);
}

/// Calls visit(particle, offset from x, smoothing length) for all whose kernels reach x.
template <class Visit>
void ParticleState::Body::around(const Vec3& x, double width, Visit visit) const {
  if (particles.empty()) return;
  int from[3], to[3];
  for (int a = 0; a < 3; ++a) {
    const double at = (x[a] - low[a]) / cell;
    if (!(at > -1.5) || !(at < count[a] + 1.5)) return;
    from[a] = std::max(0, int(std::floor(at)) - 1);
    to[a] = std::min(count[a] - 1, int(std::floor(at)) + 1);
  }
  for (int iz = from[2]; iz <= to[2]; ++iz)
    for (int iy = from[1]; iy <= to[1]; ++iy) {
      const std::size_t row = (std::size_t(iz) * count[1] + iy) * count[0];
      for (std::size_t k = first[row + from[0]]; k < first[row + to[0] + 1]; ++k) {
        const Particle& p = particles[k];
        const double h = std::max(p.h, of_width * width);
        const Vec3 offset = p.x - x;
        if (offset.squaredNorm() < support * support * h * h) visit(p, offset, h);
      }
    }
}

ParticleState::Place ParticleState::place_of(const Vec3& x) const {
  Place place{.x = x, .outward = Vec3::Zero()};
  if (meridian_) {
    place.outward = meridian_->outward_at(x);
    place.x = meridian_->place(x);
  }
  for (int a = 0; a < dimension_; ++a)
    if (planes_[a] && place.x[a] < 0.0) {
      place.x[a] = -place.x[a];
      place.mirrored[a] = true;
    }
  return place;
}

ParticleState::Owner ParticleState::owner_at(const Vec3& x) const {
  const Place place = place_of(x);
  Owner owner;
  double most = 0, all = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    double share = 0;
    bodies_[b].around(place.x, 0.0, [&](const Particle& p, const Vec3& offset, double h) {
      share += p.volume * sph::kernel_value(kernel, offset.norm(), h, dimension_);
      owner.still = owner.still && !p.moved;
    });
    all += share;
    if (share > most) {
      most = share;
      owner.body = b;
    }
  }
  if (all < least_volume) owner.body.reset();
  return owner;
}

sph::StartState ParticleState::state(std::size_t body, const Vec3& x, double width, const sph::StartState& at_rest) const {
  const Place place = place_of(x);
  LinearFit fit(dimension_);
  std::vector<const Particle*> near;
  bodies_[body].around(place.x, width, [&](const Particle& p, const Vec3& offset, double h) {
    fit.add(p.volume * sph::kernel_value(kernel, offset.norm(), h, dimension_), offset / h);
    near.push_back(&p);
  });
  if (fit.empty()) return at_rest;
  const std::vector<double> factors = fit.factors();
  Mean density{at_rest.density}, energy{at_rest.density * at_rest.energy}, specific{0}, velocity[3] = {{0}, {0}, {0}};
  for (std::size_t k = 0; k < near.size(); ++k) {
    const Particle& p = *near[k];
    density.add(factors[k], p.rho);
    energy.add(factors[k], p.rho * p.energy);
    specific.add(0.0, p.energy);
    for (int a = 0; a < 3; ++a) velocity[a].add(factors[k], p.v[a]);
  }
  sph::StartState state;
  state.density = density.value();
  state.energy = std::clamp(energy.value() / state.density, specific.least, specific.most);
  for (int a = 0; a < 3; ++a) state.velocity[a] = (place.mirrored[a] ? -1.0 : 1.0) * velocity[a].value();
  if (meridian_) state.velocity = meridian_->vector_in_space(state.velocity, place.outward);
  return state;
}

double ParticleState::clearance(const Distance& distance) const {
  double best = 1e300;
  // A ring is searched arc by arc, as far as anything nearer may be on it.
  const std::function<void(const Vec3&, double, double, double)> search = [&](const Vec3& place, double from, double to,
                                                                              double nearest) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from) * place[0];
    const Vec3 along = meridian_->along(), one = meridian_->outward(), other = along.cross(one);
    const double here = distance(meridian_->place_in_space(place, std::cos(middle) * one + std::sin(middle) * other));
    best = std::min(best, here);
    if (here - half >= best || half < nearest) return;
    search(place, from, middle, nearest);
    search(place, middle, to, nearest);
  };
  for (const Body& body : bodies_)
    for (const Particle& p : body.particles) {
      if (!p.moved || p.image) continue;
      for (int image = 0; image < 1 << dimension_; ++image) {
        Vec3 x = p.x;
        bool wanted = true;
        for (int a = 0; a < dimension_; ++a)
          if (image >> a & 1) {
            wanted = wanted && planes_[a] && !(meridian_ && a == 0);
            x[a] = -x[a];
          }
        if (!wanted) continue;
        if (meridian_) search(x, -std::numbers::pi, std::numbers::pi, 0.5 * spacing_);
        else best = std::min(best, distance(x));
      }
    }
  return best;
}

}  // namespace undex::run
