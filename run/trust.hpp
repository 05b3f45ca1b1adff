// Whether a run's numbers can be trusted, in plain words: its ledgers, its clamps, its resolution, and what is known of the
// scheme.
#pragma once

#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// One sentence a matter, the ledgers first. `given`: the scene as it was read. The record is complete but for these.
/// Thresholds: energy within 1 % is good, beyond 5 % bad; mass 1e-9; ten spacings in a charge's radius and five in a wall's
/// thickness are good (docs/reference/outputs.md has all of them).
std::vector<output::TrustRecord> trust_of(const scene::Scene& given, const output::RunRecord& record);

/// The block that ends a run: a line a matter, and the verdict.
std::string trust_text(const std::vector<output::TrustRecord>& matters);

}  // namespace undex::run
