// What others ask of solids in particles.
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/surface.hpp"
#include "sph_fluid/pairs/kernels.hpp"
#include "sph_solid/solids_implementation.hpp"
#include "sph_fluid/pairs/sums.hpp"

namespace undex::sph {
namespace {

using undex::mirrored;  // of vectors; of symmetric tensors:
Mat3 mirrored(Mat3 s, unsigned image) {
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if ((image >> a & 1) != (image >> b & 1)) s(a, b) = -s(a, b);
  return s;
}

/// Sums of vectors start from zero, which Eigen's do not.
struct Sum3 {
  Vec3 value = Vec3::Zero();
  Sum3& operator+=(const Sum3& other) {
    value += other.value;
    return *this;
  }
  Sum3& operator+=(const Vec3& more) {
    value += more;
    return *this;
  }
};

}  // namespace

const Settings& Solids::settings() const { return self_->settings; }
std::size_t Solids::particle_count() const { return self_->particles.size(); }
double Solids::time() const { return self_->time; }
long Solids::steps() const { return self_->steps; }
const PassTimers& Solids::timers() const { return self_->timers; }
std::span<const Vec3> Solids::positions() const { return self_->particles.x; }
std::span<const Vec3> Solids::velocities() const { return self_->particles.v; }
std::span<const Vec3> Solids::accelerations() const { return self_->acceleration; }
double Solids::particle_mass(std::size_t particle) const { return self_->particles.mass[particle]; }
Mat3 Solids::stress(std::size_t particle) const { return self_->particles.stress(particle); }
const std::vector<std::uint32_t>& Solids::wet_particles() const { return self_->wet; }

std::vector<std::size_t> Solids::particles_by_body() const {
  std::vector<std::size_t> counts;
  for (const SolidGroup& group : self_->groups) counts.push_back(group.end - group.begin);
  return counts;
}

std::size_t Solids::memory_bytes() const {
  std::size_t bytes = self_->particles.memory_bytes() + 2 * particle_count() * sizeof(Vec3);
  for (const SolidGroup& group : self_->groups)
    if (group.lagrangian) bytes += group.lagrangian->memory_bytes();
  return bytes + (self_->pairs ? self_->pairs->memory_bytes() : 0);
}

std::string Solids::stable_step_owner() const {
  const std::uint32_t i = self_->fastest();
  const Vec3& x = self_->particles.x[i];
  std::ostringstream text;
  text << "particle " << i << " of '" << self_->group_of(i).body->name << "' at (" << x[0] << ", " << x[1] << ", " << x[2]
       << ") m";
  return text.str();
}

SolidLedger Solids::ledger() const {
  const SolidParticles& p = self_->particles;
  const std::uint32_t n = std::uint32_t(p.size());
  SolidLedger ledger;
  const auto sum = [&](auto of) { return blocked_sum<double>(0, n, of); };
  ledger.mass = sum([&](std::uint32_t i) { return p.mass[i]; });
  ledger.kinetic = sum([&](std::uint32_t i) { return 0.5 * p.mass[i] * p.v[i].squaredNorm(); });
  ledger.plastic = sum([&](std::uint32_t i) { return p.mass[i] * p.plastic_energy[i]; });
  ledger.viscous = sum([&](std::uint32_t i) { return p.mass[i] * p.viscous_energy[i]; });
  ledger.elastic = sum([&](std::uint32_t i) { return p.mass[i] * p.energy[i]; }) - ledger.plastic - ledger.viscous;
  for (const SolidGroup& group : self_->groups) {
    if (group.lagrangian) ledger.elastic += group.lagrangian->hourglass_energy();
    const materials::Solid& solid = group.body->material;
    const double modulus = materials::bulk_modulus(solid) + 4.0 / 3.0 * solid.shear_modulus;
    ledger.elastic += blocked_sum<double>(group.begin, group.end, [&](std::uint32_t i) {
      return 0.5 * p.contact_pressure[i] * p.contact_pressure[i] / modulus * p.mass[i] / p.rho[i];
    });
  }
  ledger.external = self_->external_work;
  const Vec3& g = self_->settings.gravity;
  ledger.gravity = sum([&](std::uint32_t i) { return p.mass[i] * g.dot(p.x[i] - p.start[i]); });
  ledger.integrator = self_->integrator_jumps - self_->integrator_held;
  ledger.momentum = blocked_sum<Sum3>(0, n, [&](std::uint32_t i) -> Vec3 { return p.mass[i] * p.v[i]; }).value;
  ledger.angular_momentum =
      blocked_sum<Sum3>(0, n, [&](std::uint32_t i) -> Vec3 { return p.mass[i] * p.x[i].cross(p.v[i]); }).value;
  return ledger;
}

double Solids::maximum_pressure() const {
  const auto& pressure = self_->particles.pressure;
  return pressure.empty() ? 0.0 : *std::max_element(pressure.begin(), pressure.end());
}

std::vector<double> Solids::field(std::string_view name) const {
  const SolidParticles& p = self_->particles;
  const std::size_t n = p.size();
  std::vector<double> out;
  const auto scalars = [&](auto of) {
    out.resize(n);
    for (std::size_t i = 0; i < n; ++i) out[i] = of(i);
  };
  const auto vectors = [&](auto of) {
    out.resize(3 * n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 value = of(i);
      for (int a = 0; a < 3; ++a) out[3 * i + a] = value[a];
    }
  };
  if (name == "position") vectors([&](std::size_t i) { return p.x[i]; });
  else if (name == "displacement") vectors([&](std::size_t i) -> Vec3 { return p.x[i] - p.start[i]; });
  else if (name == "velocity") vectors([&](std::size_t i) { return p.v[i]; });
  else if (name == "pressure") scalars([&](std::size_t i) { return p.pressure[i]; });
  else if (name == "density") scalars([&](std::size_t i) { return p.rho[i]; });
  else if (name == "plastic_strain") scalars([&](std::size_t i) { return p.plastic_strain[i]; });
  else if (name == "temperature") scalars([&](std::size_t i) { return p.temperature[i]; });
  else if (name == "energy") scalars([&](std::size_t i) { return p.energy[i]; });
  else if (name == "damage") scalars([&](std::size_t i) { return p.damage[i]; });
  else if (name == "sound_speed") scalars([&](std::size_t i) { return p.sound[i]; });
  else if (name == "mass") scalars([&](std::size_t i) { return p.mass[i]; });
  else if (name == "id") scalars([&](std::size_t i) { return double(i); });
  else if (name == "von_mises")
    scalars([&](std::size_t i) {
      double square = 0;
      for (int k = 0; k < 6; ++k) square += (k < 3 ? 1.0 : 2.0) * p.deviator[k][i] * p.deviator[k][i];
      return std::sqrt(1.5 * square);
    });
  else if (name == "material") {
    out.reserve(n);
    for (std::size_t g = 0; g < self_->groups.size(); ++g)
      out.insert(out.end(), self_->groups[g].end - self_->groups[g].begin, double(g));
  } else {
    throw std::invalid_argument("solids have no field '" + std::string(name) + "'");
  }
  return out;
}

Solids::Point Solids::locate(const Vec3& place) const {
  const SolidParticles& p = self_->particles;
  const int dimension = self_->settings.dimension;
  // The body of the nearest particle; then weights W V (1 + b.(X - place)) that are exact for linear fields.
  Point point;
  std::uint32_t nearest = 0;
  double best = 1e300;
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    const double d = (p.start[i] - place).squaredNorm();
    if (d < best) best = d, nearest = i;
  }
  point.distance = std::sqrt(best);
  const SolidGroup& group = self_->group_of(nearest);
  for (double h = group.h;; h *= 1.25) {
    point.particles.clear(), point.weights.clear(), point.images.clear();
    Eigen::Matrix4d moment = Eigen::Matrix4d::Zero();
    for (int a = dimension; a < 3; ++a) moment(a + 1, a + 1) = 1.0;
    for (unsigned image = 0; image < 8; ++image) {
      bool wanted = true;
      for (int a = 0; a < 3; ++a)
        wanted = wanted && (!(image >> a & 1) || (self_->settings.symmetry.axis[a] && place[a] < WendlandC2::support * h));
      if (!wanted) continue;
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const Vec3 d = (mirrored(p.start[i], image) - place) / h;
        const double w = WendlandC2::shape(d.norm());
        if (w <= 0.0) continue;
        point.particles.push_back(i);
        point.weights.push_back(w);
        point.images.push_back(static_cast<unsigned char>(image));
        Eigen::Vector4d basis(1.0, d[0], d[1], d[2]);
        moment += w * basis * basis.transpose();
      }
    }
    if (!(moment.determinant() > 1e-6) && h < 20.0 * group.h) continue;
    const Eigen::Vector4d coefficient = moment.fullPivLu().solve(Eigen::Vector4d::Unit(0));
    for (std::size_t k = 0; k < point.weights.size(); ++k) {
      const Vec3 d = (mirrored(p.start[point.particles[k]], point.images[k]) - place) / h;
      point.weights[k] *= coefficient.dot(Eigen::Vector4d(1.0, d[0], d[1], d[2]));
    }
    return point;
  }
}

Solids::PointValues Solids::read(const Point& point) const {
  const SolidParticles& p = self_->particles;
  PointValues values{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Mat3::Zero(), 0.0, 0.0};
  for (std::size_t k = 0; k < point.particles.size(); ++k) {
    const std::uint32_t i = point.particles[k];
    const unsigned image = point.images[k];
    const double w = point.weights[k];
    values.position += w * mirrored(p.x[i], image);
    values.displacement += w * mirrored(Vec3(p.x[i] - p.start[i]), image);
    values.velocity += w * mirrored(p.v[i], image);
    values.acceleration += w * mirrored(self_->acceleration[i], image);
    values.stress += w * mirrored(p.stress(i), image);
    values.plastic_strain += w * p.plastic_strain[i];
    values.temperature += w * p.temperature[i];
  }
  return values;
}

void Solids::distribute(const Point& point, const Vec3& impulse, std::vector<Vec3>& particle_impulse) const {
  for (std::size_t k = 0; k < point.particles.size(); ++k)
    particle_impulse[point.particles[k]] += point.weights[k] * mirrored(impulse, point.images[k]);
}

MovingWall Solids::wet_wall(bool free_slip) const {
  const Implementation& s = *self_;
  const std::size_t n = s.wet.size();
  MovingWall wall;
  wall.free_slip = free_slip;
  for (auto* field : {&wall.position, &wall.velocity, &wall.normal, &wall.impulse}) field->assign(n, Vec3::Zero());
  wall.volume.resize(n);
  move_wall(wall, 0.0);
  return wall;
}

void Solids::move_wall(MovingWall& wall, double ahead) const {
  const Implementation& s = *self_;
  const SolidParticles& p = s.particles;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < s.wet.size(); ++k) {
    const std::uint32_t i = s.wet[k];
    wall.position[k] = p.x[i] + ahead * (p.v[i] + 0.5 * ahead * s.acceleration[i]);
    wall.velocity[k] = p.v[i] + ahead * s.acceleration[i];
    wall.volume[k] = p.mass[i] / p.rho[i];
    const SolidGroup& group = s.group_of(i);
    // Area vectors go with the inverse transpose.
    const Mat3 inverse = group.lagrangian ? Mat3(group.lagrangian->deformation(i).inverse()) : s.pairs->inverse_deformation(i);
    wall.normal[k] = (inverse.transpose() * s.wet_normal[k]).normalized();
  }
}

}  // namespace undex::sph
