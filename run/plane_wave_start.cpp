#include "run/plane_wave_start.hpp"

#include <cstdio>
#include <stdexcept>

#include "core/errors.hpp"

namespace undex::run {

std::size_t wave_body(const scene::Scene& scene) {
  const auto& bodies = scene.fluid.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == scene.start.body) return i;
  return 0;
}

exact::PlaneWave plane_wave(const scene::Scene& scene) {
  const sph::Body& body = scene.fluid.bodies[wave_body(scene)];
  const scene::Start::Wave& wave = scene.start.wave;
  const double energy = body.energy.value_or(0.0);
  const double density = body.density    ? *body.density
                         : body.pressure ? materials::density_at(body.material.law, *body.pressure, energy)
                                         : body.material.rho0;
  try {
    return {body.material.law, density, energy, wave.peak, wave.decay};
  } catch (const std::logic_error& mistake) {  // of arguments, or of the law's domain
    throw SceneError(scene.file.string(), {scene.places.finding("start.kind", "start.kind = \"plane_wave\" in bodies." +
                                                                                  body.name + ": " + mistake.what())});
  }
}

std::string begin_with_plane_wave(scene::Scene& scene) {
  const scene::Start::Wave& given = scene.start.wave;
  const exact::PlaneWave wave = plane_wave(scene);
  const double way = given.upward ? 1.0 : -1.0;
  sph::Body& body = scene.fluid.bodies[wave_body(scene)];
  auto field = std::make_shared<sph::StartField>();
  field->rest_pressure = wave.rest().pressure;
  field->state = [=](const Vec3& x, double spacing) {
    const double behind = way * (given.front - x[given.axis]);
    const exact::PlaneWaveState mean = wave.mean(behind - 0.5 * spacing, behind + 0.5 * spacing);
    return sph::StartState{mean.density, mean.energy, way * mean.velocity * Vec3::Unit(given.axis)};
  };
  body.start = field;

  const exact::PlaneWaveState front = wave.front();
  char text[300];
  std::snprintf(text, sizeof text, "%.4g MPa, %.4g kg/m^3 and %.4g m/s at its front, %.4g mm long in water of %.4g m/s",
                front.pressure * 1e-6, front.density, front.velocity, wave.length() * 1e3, wave.rest_sound());
  return text;
}

}  // namespace undex::run
