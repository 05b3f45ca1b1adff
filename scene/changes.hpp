// What of a scene may change between a checkpoint and the run that goes on from it.
#pragma once

#include <string>
#include <vector>

namespace undex::scene {

/// Keys, dotted, of two resolved scenes that differ although the state depends on them, each with both values. The end time,
/// threads, title, output and comparison may differ, probes and lines may be added.
std::vector<std::string> changes_of_state(const std::string& before, const std::string& after);

}  // namespace undex::scene
