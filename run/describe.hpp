// What a run of a scene would be, and what it was.
#pragma once

#include <string>

#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// Particles by body, cells, expected step, steps, memory and run time, as text of several lines. The solvers are set up
/// and a few steps are taken to know; nothing is written. Throws SceneError where a solver refuses its part of the scene.
/// `drawing`: where the picture of the start goes (run/picture.hpp), if one is wanted.
std::string describe(const scene::Scene& scene, std::string* drawing = nullptr);

/// What a run cost and how well its ledgers close, as text of a few lines.
std::string cost_text(const output::RunRecord& record);

/// The largest values of the run, with their places and times; empty where none were looked for.
std::string largest_text(const output::RunRecord& record);

}  // namespace undex::run
