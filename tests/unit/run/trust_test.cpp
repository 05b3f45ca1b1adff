// What a run says of how far it can be trusted.
#include "run/trust.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "judge/comparisons.hpp"
#include "run/step_limits.hpp"
#include "scenes.hpp"

namespace undex::run {
namespace {

using output::Trust;

output::RunRecord sound_record() {
  output::RunRecord record;
  record.status = "done";
  record.particle_updates = 1'000'000;
  record.mass_error = 1e-16;
  record.momentum_error = std::numeric_limits<double>::quiet_NaN();
  record.energy_error = 2e-3;
  record.clamps = {{"density", 0}, {"smoothing", 0}};
  return record;
}

scene::Scene cylinder(const std::string& spacing, const std::string& start = "spherical") {
  return scene::read(UNDEX_CASES "/rigid_cylinder", judge::comparison_kinds(),
                     {{"resolution.spacing", spacing}, {"start.kind", start}});
}

Trust level_of(const std::vector<output::TrustRecord>& matters, const std::string& about) {
  const auto found = std::find_if(matters.begin(), matters.end(), [&](const auto& matter) { return matter.about == about; });
  if (found == matters.end()) throw std::logic_error("nothing is said of " + about);
  return found->level;
}

TEST(Trust, ASoundRunIsTrusted) {
  const auto matters = trust_of(cylinder("0.001"), sound_record());
  for (const auto& matter : matters) EXPECT_EQ(matter.level, Trust::good) << matter.about << ": " << matter.text;
  EXPECT_NE(trust_text(matters).find("Yes:"), std::string::npos);
}

TEST(Trust, LedgersThatDoNotCloseAreNot) {
  for (const auto& [error, level] : {std::pair(0.02, Trust::notice), {-0.2, Trust::bad}, {std::nan(""), Trust::bad}}) {
    output::RunRecord record = sound_record();
    record.energy_error = error;
    EXPECT_EQ(level_of(trust_of(cylinder("0.001"), record), "energy"), level) << error;
  }
  output::RunRecord record = sound_record();
  record.mass_error = 1e-3;
  const auto matters = trust_of(cylinder("0.001"), record);
  EXPECT_EQ(level_of(matters, "mass"), Trust::bad);
  EXPECT_NE(trust_text(matters).find("No:"), std::string::npos);
}

TEST(Trust, ARunThatWasCutIsNot) {
  output::RunRecord record = sound_record();
  record.status = "interrupted";
  EXPECT_EQ(level_of(trust_of(cylinder("0.001"), record), "end"), Trust::bad);
}

TEST(Trust, AnInterfaceThatLosesEnergyIsNamed) {
  output::RunRecord record = sound_record();
  record.interface_energy_error = 0.03;
  EXPECT_EQ(level_of(trust_of(cylinder("0.001"), record), "interface"), Trust::notice);
}

TEST(Trust, CoarseChargesAreNamed) {
  EXPECT_EQ(level_of(trust_of(cylinder("0.001", "plain"), sound_record()), "charge"), Trust::good);
  EXPECT_EQ(level_of(trust_of(cylinder("0.003", "plain"), sound_record()), "charge"), Trust::notice);
  EXPECT_EQ(level_of(trust_of(cylinder("0.006", "plain"), sound_record()), "charge"), Trust::bad);
  EXPECT_EQ(level_of(trust_of(cylinder("0.003"), sound_record()), "charge"), Trust::good);  // computed finer at first
}

TEST(Trust, WallsAreMeasuredInSpacingsOfTheWater) {
  const auto tube = [](const std::string& spacing) {
    return scene::read(UNDEX_CASES "/al_tube_fem", judge::comparison_kinds(), {{"resolution.spacing", spacing}});
  };
  EXPECT_EQ(level_of(trust_of(tube("0.001"), sound_record()), "wall"), Trust::good);
  EXPECT_EQ(level_of(trust_of(tube("0.003"), sound_record()), "wall"), Trust::notice);
}

TEST(Trust, BoundsThatActOftenAreNamed) {
  output::RunRecord record = sound_record();
  record.clamps = {{"density", 20'000}};
  EXPECT_EQ(level_of(trust_of(cylinder("0.001"), record), "clamps"), Trust::notice);
  record.clamps = {{"density", 20}};
  EXPECT_EQ(level_of(trust_of(cylinder("0.001"), record), "clamps"), Trust::good);
}

TEST(Trust, WarningsAreCounted) {
  output::RunRecord record = sound_record();
  record.warnings = {"something computes badly"};
  EXPECT_EQ(level_of(trust_of(cylinder("0.001"), record), "warnings"), Trust::notice);
}

TEST(StepLimits, AreCountedByWhatSetThem) {
  StepLimits limits;
  for (const char* words :
       {"element", "Courant (water, particle 12)", "Courant (water, particle 7)", "Courant (water) x1, structure x2"})
    limits.count(words);
  const std::vector<std::pair<std::string, std::int64_t>> expected{{"Courant (water)", 3}, {"element", 1}};
  EXPECT_EQ(limits.counts(), expected);
}

}  // namespace
}  // namespace undex::run
