// Programmed burn, and the Chapman-Jouguet state of a JWL set.
#include "materials/burn.hpp"

#include <stdexcept>

namespace undex::materials {

double ProgrammedBurn::fraction(const Vec3& x, double t, double compression) const {
  if (instantaneous) return 1.0;
  const double advance = (t - lighting_time(x)) * D;  // of the front beyond x [m]
  if (advance >= width && advance > 0.0) return 1.0;
  double burned = advance > 0.0 ? advance / width : 0.0;
  if (cj_compression > 1.0 && compression > 1.0)
    burned = std::max(burned, (1.0 - 1.0 / compression) / (1.0 - 1.0 / cj_compression));
  return std::min(burned, 1.0);
}

ProgrammedBurn programmed_burn(const Jwl& products, const Vec3& origin, double width) {
  ProgrammedBurn burn;
  burn.origin = origin;
  burn.D = products.parameters().D;
  burn.width = width;
  burn.cj_compression = chapman_jouguet(products).density / products.parameters().rho0;
  return burn;
}

ChapmanJouguet chapman_jouguet(const Jwl& products) {
  const Jwl::Parameters& p = products.parameters();
  const auto hugoniot = [&](double rho) {
    // e = E0 + (pressure/2) (1/rho0 - 1/rho) put into the law, which is linear in e.
    const double volume_change = 1.0 / p.rho0 - 1.0 / rho;
    const double cold = products.evaluate(rho, 0.0).pressure;
    ChapmanJouguet s{};
    s.density = rho;
    s.pressure = (cold + p.omega * rho * p.E0) / (1.0 - 0.5 * p.omega * rho * volume_change);
    s.energy = p.E0 + 0.5 * s.pressure * volume_change;
    s.detonation_speed = std::sqrt(s.pressure / volume_change) / p.rho0;
    s.particle_speed = std::sqrt(s.pressure * volume_change);
    s.sound_speed = products.evaluate(rho, s.energy).sound_speed;
    return s;
  };
  const auto supersonic = [&](const ChapmanJouguet& s) { return s.density * s.sound_speed < p.rho0 * s.detonation_speed; };

  double low = 1.001 * p.rho0, high = low;
  while (supersonic(hugoniot(high))) {
    low = high;
    high *= 1.02;
    if (high > 5.0 * p.rho0) throw std::domain_error("JWL set has no Chapman-Jouguet state below five times its initial density");
  }
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (supersonic(hugoniot(middle)) ? low : high) = middle;
  return hugoniot(high);
}

}  // namespace undex::materials
