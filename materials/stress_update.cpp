#include "materials/stress_update.hpp"

#include <algorithm>
#include <cmath>

namespace undex::materials {
namespace {

constexpr int N = points_at_once;

/// a : b of two symmetric tensors at point q.
inline double contracted(const EightPoints (&a)[6], const EightPoints (&b)[6], int q) {
  return a[0][q] * b[0][q] + a[1][q] * b[1][q] + a[2][q] * b[2][q] +
         2.0 * (a[3][q] * b[3][q] + a[4][q] * b[4][q] + a[5][q] * b[5][q]);
}

/// The trial deviator, and the deviatoric strain increment that leads to it.
inline void rotate_and_strain(double shear, const EightPoints (&gradient)[3][3], SolidPoints& points, SolidStep& step,
                              EightPoints (&strain)[6]) {
  EightPoints(&s)[6] = points.deviator;
  for (int q = 0; q < N; ++q) {
    const double mean = (gradient[0][0][q] + gradient[1][1][q] + gradient[2][2][q]) / 3.0;
    strain[0][q] = gradient[0][0][q] - mean;
    strain[1][q] = gradient[1][1][q] - mean;
    strain[2][q] = gradient[2][2][q] - mean;
    strain[3][q] = 0.5 * (gradient[1][2][q] + gradient[2][1][q]);
    strain[4][q] = 0.5 * (gradient[2][0][q] + gradient[0][2][q]);
    strain[5][q] = 0.5 * (gradient[0][1][q] + gradient[1][0][q]);
    step.strain_norm[q] = std::sqrt(contracted(strain, strain, q)) + std::abs(mean);
    step.old_work[q] = contracted(s, strain, q);
  }
  for (int q = 0; q < N; ++q) {
    // Cayley rotation R = I + 2/(1 + a.a) (A + A A), A the skew matrix of a, half the step's rotation vector.
    const double ax = 0.25 * (gradient[2][1][q] - gradient[1][2][q]);
    const double ay = 0.25 * (gradient[0][2][q] - gradient[2][0][q]);
    const double az = 0.25 * (gradient[1][0][q] - gradient[0][1][q]);
    const double square = ax * ax + ay * ay + az * az, factor = 2.0 / (1.0 + square);
    const double r00 = 1.0 + factor * (ax * ax - square), r11 = 1.0 + factor * (ay * ay - square),
                 r22 = 1.0 + factor * (az * az - square);
    const double r01 = factor * (ax * ay - az), r10 = factor * (ax * ay + az);
    const double r02 = factor * (ax * az + ay), r20 = factor * (ax * az - ay);
    const double r12 = factor * (ay * az - ax), r21 = factor * (ay * az + ax);
    const double sxx = s[0][q] + shear * strain[0][q], syy = s[1][q] + shear * strain[1][q], szz = s[2][q] + shear * strain[2][q],
                 syz = s[3][q] + shear * strain[3][q], szx = s[4][q] + shear * strain[4][q], sxy = s[5][q] + shear * strain[5][q];
    const double t00 = r00 * sxx + r01 * sxy + r02 * szx, t01 = r00 * sxy + r01 * syy + r02 * syz,
                 t02 = r00 * szx + r01 * syz + r02 * szz;
    const double t10 = r10 * sxx + r11 * sxy + r12 * szx, t11 = r10 * sxy + r11 * syy + r12 * syz,
                 t12 = r10 * szx + r11 * syz + r12 * szz;
    const double t20 = r20 * sxx + r21 * sxy + r22 * szx, t21 = r20 * sxy + r21 * syy + r22 * syz,
                 t22 = r20 * szx + r21 * syz + r22 * szz;
    s[0][q] = t00 * r00 + t01 * r01 + t02 * r02 + shear * strain[0][q];
    s[1][q] = t10 * r10 + t11 * r11 + t12 * r12 + shear * strain[1][q];
    s[2][q] = t20 * r20 + t21 * r21 + t22 * r22 + shear * strain[2][q];
    s[3][q] = t10 * r20 + t11 * r21 + t12 * r22 + shear * strain[3][q];
    s[4][q] = t20 * r00 + t21 * r01 + t22 * r02 + shear * strain[4][q];
    s[5][q] = t00 * r10 + t01 * r11 + t02 * r12 + shear * strain[5][q];
  }
}

/// Elastic energy per volume [J/m^3] in the deviator at point q.
inline double stored(const Solid& solid, const EightPoints (&s)[6], int q) {
  return contracted(s, s, q) / (4.0 * solid.shear_modulus);
}

/// Counts the damage of a step that ends at von Mises stress `mises` [Pa].
inline void add_damage(const JohnsonCookDamage& law, double pressure, double mises, double plastic_strain, double dt,
                       double temperature, double& damage) {
  const double triaxiality = -pressure / std::max(mises, 1.0);  // one pascal: molten metal has no stress to divide by
  damage += plastic_strain / fracture_strain(law, triaxiality, plastic_strain / dt, temperature);
  damage = std::min(damage, failed);
}

}  // namespace

void advance_deviator(const Solid& solid, const EightPoints (&gradient)[3][3], const EightPoints& specific_volume,
                      const EightPoints& pressure, double dt, SolidPoints& points, SolidStep& step) {
  EightPoints strain[6], stored_before;
  EightPoints(&s)[6] = points.deviator;
  const bool breaks = can_fail(solid);
  if (breaks)
    for (int q = 0; q < N; ++q) stored_before[q] = stored(solid, s, q);
  rotate_and_strain(solid.shear_modulus, gradient, points, step, strain);
  const double heating = solid.taylor_quinney / solid.heat_capacity;
  const bool yields = !std::holds_alternative<Elastic>(solid.flow);
  for (int q = 0; q < N; ++q) {
    step.plastic_work[q] = 0.0;
    if (yields && !(breaks && points.damage[q] >= failed)) {
      const double trial = std::sqrt(1.5 * contracted(s, s, q));
      const PlasticStep plastic = radial_return(solid, trial, points.plastic_strain[q], points.temperature[q], dt);
      if (plastic.plastic_strain > 0.0) {
        for (int k = 0; k < 6; ++k) s[k][q] *= plastic.scale;
        if (breaks && solid.damage)
          add_damage(*solid.damage, pressure[q], plastic.scale * trial, plastic.plastic_strain, dt, points.temperature[q],
                     points.damage[q]);
        points.plastic_strain[q] += plastic.plastic_strain;
        points.temperature[q] += heating * specific_volume[q] * plastic.work;
        step.plastic_work[q] = plastic.work;
      }
    }
    if (breaks && points.damage[q] >= failed) {
      for (int k = 0; k < 6; ++k) s[k][q] = 0.0;
      // All that was stored is spent, and what the old stress, still there for half of the step, added.
      step.plastic_work[q] = stored_before[q] + 0.5 * step.old_work[q];
    }
    step.new_work[q] = contracted(s, strain, q);
  }
}

}  // namespace undex::materials
