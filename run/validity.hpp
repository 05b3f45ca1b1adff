// Pressures of a run beside those to which its materials may be used.
#pragma once

#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// A sentence for each body and solid whose largest pressure lies beyond its set of the library (scene::beyond_set).
std::vector<std::string> beyond_validity(const scene::Scene& scene, const std::vector<output::LargestRecord>& largest);

}  // namespace undex::run
