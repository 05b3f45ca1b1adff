#include "sph_solid/solid_particles.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace undex::solid {

void SolidParticles::resize(std::size_t n) {
  for (auto* field : {&start, &x, &v, &force}) field->assign(n, Vec3::Zero());
  for (auto& component : deviator) component.assign(n, 0.0);
  for (auto* field : {&mass, &rho, &pressure, &viscous_pressure, &plastic_strain, &temperature, &damage, &energy, &plastic_energy,
                      &viscous_energy, &contact_pressure, &contact_reference, &sound, &heat, &rate})
    field->assign(n, 0.0);
  touching.assign(n, 0);
}

std::size_t SolidParticles::memory_bytes() const {
  return size() * (4 * sizeof(Vec3) + (6 + 15) * sizeof(double) + sizeof(std::uint32_t));
}

void SolidParticles::visit_state(StateVisitor& state) {
  state("position", x);
  state("velocity", v);
  state("mass", mass);
  state("density", rho);
  for (int k = 0; k < 6; ++k) state("deviator_" + std::to_string(k), deviator[k]);
  state("pressure", pressure);
  state("viscous pressure", viscous_pressure);
  state("plastic strain", plastic_strain);
  state("temperature", temperature);
  state("damage", damage);
  state("energy", energy);
  state("plastic energy", plastic_energy);
  state("viscous energy", viscous_energy);
  state("contact pressure", contact_pressure);
  state("contact reference", contact_reference);
  state("sound", sound);
  state("touching", touching);
  state("force", force);
  state("heat", heat);
  state("rate", rate);
}

Mat3 SolidParticles::stress(std::size_t i) const {
  Mat3 s;
  s << deviator[0][i], deviator[5][i], deviator[4][i],  //
      deviator[5][i], deviator[1][i], deviator[3][i],   //
      deviator[4][i], deviator[3][i], deviator[2][i];
  return s - pressure[i] * Mat3::Identity();
}

void Deformation::append(std::uint32_t particle, const Mat3& before, const Mat3& after, double density_after) {
  const Mat3 g = (after - before) * (0.5 * (after + before)).inverse();
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) gradient[a][b][count] = g(a, b);
  density[count] = density_after;
  index[count++] = particle;
}

void update_stress(const materials::Solid& solid, const BulkViscosity& viscosity, Deformation& step, double dt,
                   SolidParticles& p) {
  constexpr int N = materials::points_at_once;
  for (int l = step.count; l < N; ++l) {  // idle lanes repeat the last particle
    step.index[l] = step.index[step.count - 1];
    step.density[l] = step.density[step.count - 1];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) step.gradient[a][b][l] = step.gradient[a][b][step.count - 1];
  }
  materials::SolidPoints points;
  materials::SolidStep done;
  materials::EightPoints specific_volume, pressure;
  for (int l = 0; l < N; ++l) {
    const std::uint32_t i = step.index[l];
    for (int k = 0; k < 6; ++k) points.deviator[k][l] = p.deviator[k][i];
    points.plastic_strain[l] = p.plastic_strain[i];
    points.temperature[l] = p.temperature[i];
    points.damage[l] = p.damage[i];
    pressure[l] = p.pressure[i];
    specific_volume[l] = 1.0 / step.density[l];
  }
  materials::advance_deviator(solid, step.gradient, specific_volume, pressure, dt, points, done);
  const bool fails = materials::can_fail(solid);
  for (int l = 0; l < step.count; ++l) {
    const std::uint32_t i = step.index[l];
    for (int k = 0; k < 6; ++k) p.deviator[k][i] = points.deviator[k][l];
    p.plastic_strain[i] = points.plastic_strain[l];
    p.temperature[i] = points.temperature[l];

    // Per mass. The work of the new pressure enters the energy that it depends on: two corrections.
    const double old_volume = 1.0 / p.rho[i], volume = specific_volume[l], opened = volume - old_volume;
    const double deviatoric = 0.5 * (old_volume * done.old_work[l] + volume * done.new_work[l]);
    const double plastic = 0.5 * (old_volume + volume) * done.plastic_work[l];
    const double closing = std::max(0.0, -opened / (0.5 * (volume + old_volume) * dt));
    const double q = step.density[l] * viscosity.length * closing *
                     (viscosity.linear * p.sound[i] + viscosity.quadratic * viscosity.quadratic * viscosity.length * closing);
    const double viscous = dt * p.heat[i] - 0.5 * (p.viscous_pressure[i] + q) * opened;
    const double other = p.energy[i] + deviatoric + viscous;
    auto state = materials::evaluate(solid.pressure, solid.rho0, step.density[l], p.energy[i]);
    for (int correction = 0; correction < 2; ++correction)
      state = materials::evaluate(solid.pressure, solid.rho0, step.density[l],
                                  other - 0.5 * (p.pressure[i] + state.pressure) * opened);
    if (fails) p.damage[i] = materials::spalls(solid, state.pressure) ? materials::failed : points.damage[l];
    const double carried = materials::carried_pressure(solid, state.pressure, p.damage[i]);
    const double pressure_work = -0.5 * (p.pressure[i] + carried) * opened;
    const bool broken = fails && p.damage[i] >= materials::failed;
    const materials::Warming warming =
        materials::warming(solid, {.before = old_volume,
                                   .after = volume,
                                   .energy = p.energy[i],
                                   .pressure_work = pressure_work,
                                   .dissipated = viscous,
                                   .parted = materials::is_parted(solid, std::min(p.pressure[i], carried), broken)});
    p.temperature[i] = warming(p.temperature[i]);
    p.energy[i] = other + pressure_work;
    p.plastic_energy[i] += plastic;
    p.viscous_energy[i] += viscous;
    p.pressure[i] = carried;
    p.viscous_pressure[i] = q;
    p.rho[i] = step.density[l];
    p.sound[i] = std::sqrt(state.bulk_sound * state.bulk_sound + 4.0 / 3.0 * solid.shear_modulus * volume);
  }
}

}  // namespace undex::solid
