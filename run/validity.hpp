// Pressures of a run beside those to which its materials may be used.
#pragma once

#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// A sentence for each body and solid whose set of the library has been left: its largest pressure lies more than a twentieth
/// beyond the set's own (materials/pedigree.hpp). Sets of one's own have no such pressure.
std::vector<std::string> beyond_validity(const scene::Scene& scene, const std::vector<output::LargestRecord>& largest);

}  // namespace undex::run
