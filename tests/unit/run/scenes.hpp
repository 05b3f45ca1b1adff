// Scenes written by a test, and run in this process.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"
#include "scene/scene.hpp"

namespace undex::run::test {

/// The scene of that text. Throws SceneError.
scene::Scene read_text(const std::string& text, const std::vector<scene::Override>& overrides = {});

/// From the present time to `end` [s].
void run_to(Simulation& simulation, double end);

/// A plate on a square column of water at 0.1 MPa, closed below; what the plate bears from behind is the test's. SI units.
extern const std::string plate_on_water;

}  // namespace undex::run::test
