// What others ask of solids in particles.
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "core/surface.hpp"
#include "sph_solid/solids_implementation.hpp"
#include "sph_fluid/pairs/sums.hpp"

namespace undex::solid {

using namespace sph;  // pairs, cells and kernels
namespace {

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

std::size_t Solids::particle_count() const { return self_->particles.size(); }
double Solids::time() const { return self_->time; }
long Solids::steps() const { return self_->steps; }
const PassTimers& Solids::timers() const { return self_->timers; }
std::span<const Vec3> Solids::positions() const { return self_->particles.x; }
std::span<const Vec3> Solids::velocities() const { return self_->particles.v; }
std::span<const Vec3> Solids::accelerations() const { return self_->acceleration; }
std::span<const double> Solids::masses() const { return self_->particles.mass; }
BodySize Solids::size() const { return {.particles = particle_count()}; }
Mat3 Solids::stress(std::size_t particle) const { return self_->particles.stress(particle); }

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

std::string Solids::description() const {
  static constexpr const char* unit[3] = {"m", "m^2", "m^3"};  // of a volume, by dimension
  const sph::Settings& around = self_->around;
  Bounds kept{Vec3::Constant(-1e300), Vec3::Constant(1e300)};
  for (int a = 0; a < 3; ++a)
    if (around.symmetry.axis[a]) kept.low[a] = 0;
  std::string text = "solids in particles\n";
  char line[512];
  for (const SolidGroup& group : self_->groups) {
    const Body& solid = *group.body;
    std::snprintf(line, sizeof line, "  %-16s %10zu particles  %.6g %s of %s, spacing %.6g m, %s Lagrangian\n",
                  solid.name.c_str(), std::size_t(group.end - group.begin),
                  around.axisymmetric ? volume_of_revolution(solid.shape, kept) : volume(solid.shape, kept, around.dimension),
                  unit[around.axisymmetric ? 2 : around.dimension - 1], solid.material.name.c_str(), group.spacing,
                  group.lagrangian ? "total" : "updated");
    text += line;
  }
  std::snprintf(line, sizeof line, "  %.6g kg, stable step %.4g us (%s)\n", ledger().mass, stable_step() * 1e6,
                stable_step_owner().c_str());
  return text + line;
}

BodyLedger Solids::ledger() const {
  const SolidParticles& p = self_->particles;
  const std::uint32_t n = std::uint32_t(p.size());
  BodyLedger ledger;
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
  ledger.received = self_->received_work;
  ledger.external = self_->plane_work;
  ledger.impulse = self_->plane_impulse;
  const Vec3& g = self_->around.gravity;
  ledger.gravity = sum([&](std::uint32_t i) { return p.mass[i] * g.dot(p.x[i] - p.start[i]); });
  ledger.integrator = self_->integrator_jumps - self_->integrator_held;
  ledger.momentum = blocked_sum<Sum3>(0, n, [&](std::uint32_t i) -> Vec3 { return p.mass[i] * p.v[i]; }).value;
  ledger.angular_momentum =
      blocked_sum<Sum3>(0, n, [&](std::uint32_t i) -> Vec3 { return p.mass[i] * p.x[i].cross(p.v[i]); }).value;
  if (self_->around.axisymmetric) {  // whole rings have momentum along the axis only
    ledger.momentum = Vec3(0.0, ledger.momentum[1], 0.0);
    ledger.angular_momentum.setZero();
  }
  return ledger;
}

double Solids::maximum_pressure() const {
  const auto& pressure = self_->particles.pressure;
  return pressure.empty() ? 0.0 : *std::max_element(pressure.begin(), pressure.end());
}

std::vector<LargestOf> Solids::largest() const {
  const SolidParticles& p = self_->particles;
  std::vector<LargestOf> all;
  for (const SolidGroup& group : self_->groups) {
    LargestOf found{group.body->name, {}};
    const auto look = [&](const char* quantity, auto of) {
      Largest most;
      for (std::uint32_t i = group.begin; i < group.end; ++i) most.take(of(i), i, [&] { return p.x[i]; });
      found.quantities.push_back({quantity, most});
    };
    look("pressure", [&](std::uint32_t i) { return p.pressure[i]; });
    look("speed", [&](std::uint32_t i) { return p.v[i].squaredNorm(); });
    double& speed = found.quantities.back().second.value;
    speed = std::sqrt(std::max(0.0, speed));
    look("plastic_strain", [&](std::uint32_t i) { return p.plastic_strain[i]; });
    if (materials::can_fail(group.body->material)) look("damage", [&](std::uint32_t i) { return p.damage[i]; });
    look("temperature", [&](std::uint32_t i) { return p.temperature[i]; });
    all.push_back(std::move(found));
  }
  return all;
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

BodySnapshot Solids::snapshot(std::span<const std::string> fields) const {
  BodySnapshot snapshot;
  snapshot.position = self_->particles.x;
  for (const std::string& name : fields) {
    std::vector<double> values = field(name);
    const int components = int(values.size() / std::max<std::size_t>(particle_count(), 1));
    snapshot.of_points.push_back({name, components, std::move(values)});
  }
  return snapshot;
}

}  // namespace undex::solid
