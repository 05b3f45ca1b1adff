#include "run/driver.hpp"

#include <algorithm>
#include <cmath>

namespace undex::run {
namespace {

std::string set_by(const sph::StepLimit& limit) { return limit.criterion + " (" + limit.body; }

}  // namespace

Step WaterAlone::advance(double end) {
  const sph::StepLimit limit = flow_.step_limit();
  const double left = end - flow_.time();
  // The last few steps before `end` share what is left, so that none is tiny.
  const double size = left < 3.0 * limit.step ? left / std::ceil(left / limit.step - 1e-9) : limit.step;
  flow_.step(size);
  return {size, set_by(limit) + ", particle " + std::to_string(limit.particle) + ")"};
}

Step BodyAlone::advance(double end) {
  const Step step{std::min(body_.stable_step(), end - body_.time()), of_particles_ ? body_.stable_step_owner() : "element"};
  body_.advance(body_.time() + step.size);
  return step;
}

Step Coupled::advance(double end) {
  const coupling::Coupler::Window window = coupler_.advance(end);
  return {window.step, set_by(window.limit) + ") x" + std::to_string(window.fluid_steps) + ", structure x" +
                           std::to_string(window.structure_steps)};
}

Step OneSystem::advance(double end) {
  const coupling::ParticleSystem::Step step = system_.advance(end);
  return {step.step, set_by(step.limit) + "), solids x" + std::to_string(step.solid_steps)};
}

}  // namespace undex::run
