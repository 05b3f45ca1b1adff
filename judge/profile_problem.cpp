#include "judge/profile_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace undex::judge {
namespace {

using scene::Solution;

void require(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument(message);
}

bool at_rest(const sph::Body& body) { return body.velocity.isZero() && body.radial_velocity == 0.0; }

const materials::IdealGas* ideal_gas(const sph::Body& body) { return std::get_if<materials::IdealGas>(&body.material.law); }

ProfileProblem riemann(const sph::Settings& fluid) {
  require(fluid.bodies.size() == 2,
          "\"riemann\" needs two bodies side by side along x; the scene has " + std::to_string(fluid.bodies.size()));
  Bounds box[2];
  for (const int k : {0, 1}) {
    const sph::Body& body = fluid.bodies[k];
    require(!body.burn,
            "\"riemann\" needs uniform states, but body '" + body.name + "' burns from a point; use burn = \"instantaneous\"");
    require(body.radial_velocity == 0.0 && body.velocity[1] == 0.0 && body.velocity[2] == 0.0,
            "\"riemann\" is a flow along x; body '" + body.name + "' must have no velocity across it");
    box[k] = bounds(body.shape, fluid.dimension);
  }
  const std::size_t left = box[0].low[0] < box[1].low[0] ? 0 : 1, right = 1 - left;
  const double interface = box[left].high[0], gap = box[right].low[0] - interface;
  require(std::abs(gap) < 1e-9 * (box[right].high[0] - box[left].low[0]),
          "\"riemann\" needs bodies that meet in one plane across x; '" + fluid.bodies[left].name +
              "' ends at x = " + std::to_string(interface) + " m, '" + fluid.bodies[right].name + "' begins at " +
              std::to_string(box[right].low[0]) + " m");
  return {.solution = Solution::riemann, .first = left, .second = right, .center = Vec3(interface, 0, 0)};
}

/// Is the body a box between slip walls (or symmetry planes, which a wall's box spans) on all sides along x?
bool fills_a_duct(const sph::Settings& fluid, const sph::Body& body) {
  const auto* box = std::get_if<Box>(&body.shape.base);
  if (fluid.dimension == 1 || box == nullptr) return fluid.dimension == 1;
  return std::any_of(fluid.walls.begin(), fluid.walls.end(), [&](const sph::Wall& wall) {
    const auto* duct = std::get_if<Box>(&wall.container);
    if (duct == nullptr) return false;
    for (int a = 1; a < fluid.dimension; ++a) {
      if (std::abs(duct->low[a] - box->low[a]) + std::abs(duct->high[a] - box->high[a]) > 1e-9 * (box->high[a] - box->low[a]))
        return false;
      for (const char* side : {"_low", "_high"}) {
        const auto face = wall.faces.find("xyz"[a] + std::string(side));
        if (face != wall.faces.end() && face->second != sph::FaceCondition::free_slip) return false;
      }
    }
    return true;
  });
}

ProfileProblem taylor_wave(const sph::Settings& fluid) {
  require(fluid.bodies.size() == 1 && fluid.bodies[0].burn && at_rest(fluid.bodies[0]),
          "\"taylor_wave\" needs one body alone, a charge at rest with a programmed burn");
  return {
      .solution = Solution::taylor_wave, .plane = fills_a_duct(fluid, fluid.bodies[0]), .center = fluid.bodies[0].burn->origin};
}

ProfileProblem sedov(const sph::Settings& fluid) {
  const char* const wanted =
      "\"sedov\" needs two bodies at rest of one ideal gas (law \"ideal_gas\", the same gamma and density): "
      "a hot one and, round it, one whose energy is less than a thousandth of the hot one's";
  require(fluid.bodies.size() == 2, wanted);
  const auto &a = fluid.bodies[0], &b = fluid.bodies[1];
  require(ideal_gas(a) && ideal_gas(b) && ideal_gas(a)->parameters().gamma == ideal_gas(b)->parameters().gamma, wanted);
  require(at_rest(a) && at_rest(b) && start_density(a) == start_density(b), wanted);
  const std::size_t hot = start_energy(a) > start_energy(b) ? 0 : 1, cold = 1 - hot;
  require(start_energy(fluid.bodies[cold]) < 1e-3 * start_energy(fluid.bodies[hot]), wanted);
  return {
      .solution = Solution::sedov, .first = hot, .second = cold, .center = middle(fluid.bodies[hot].shape.base, fluid.dimension)};
}

ProfileProblem noh(const sph::Settings& fluid) {
  require(fluid.bodies.size() == 1 && ideal_gas(fluid.bodies[0]) && start_energy(fluid.bodies[0]) == 0.0 &&
              fluid.bodies[0].velocity.isZero() && fluid.bodies[0].radial_velocity < 0.0,
          "\"noh\" needs one body alone, of law \"ideal_gas\", without energy and with a negative radial_velocity");
  return {.solution = Solution::noh, .center = middle(fluid.bodies[0].shape.base, fluid.dimension)};
}

}  // namespace

ProfileProblem profile_problem(const sph::Settings& fluid, Solution solution) {
  switch (solution) {
    case Solution::riemann: return riemann(fluid);
    case Solution::taylor_wave: return taylor_wave(fluid);
    case Solution::sedov: return sedov(fluid);
    case Solution::noh: break;
  }
  return noh(fluid);
}

}  // namespace undex::judge
