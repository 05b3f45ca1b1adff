#include "study/run_labels.hpp"

#include <gtest/gtest.h>

namespace undex::study {
namespace {

using Labels = std::vector<std::string>;

Labels labels(const std::vector<RunSettings>& runs) { return run_labels(differing_settings(runs), {"out/a", "out/b", "out/c"}); }

TEST(RunLabels, TheFewestSettingsThatTellRunsApart) {
  const RunSettings fem{
      {"name", "tube"}, {"scheme.courant", "0.3"}, {"resolution.spacing", "0.003"}, {"structure.method", "fem"}};
  RunSettings sph = fem, fine = fem;
  sph[3].second = "sph";
  fine[2].second = "0.0015";
  fine[1].second = "0.2";
  EXPECT_EQ(labels({fem, sph, fine}), (Labels{"fem 3 mm", "sph 3 mm", "fem 1.5 mm"}));
  const auto differing = differing_settings({fem, sph, fine});
  ASSERT_EQ(differing.size(), 3u);
  EXPECT_EQ(differing[0].key, "structure.method");
  EXPECT_EQ(differing[2].values, (Labels{"0.3", "0.3", "0.2"}));
}

TEST(RunLabels, NumbersAndSwitchesSayWhatTheyAre) {
  EXPECT_EQ(labels({{{"scheme.courant", "0.3"}}, {{"scheme.courant", "0.35"}}, {{"scheme.courant", "0.4"}}}),
            (Labels{"courant 0.3", "courant 0.35", "courant 0.4"}));
  EXPECT_EQ(labels({{{"structure.cells", "2x64x48"}}, {{"structure.cells", "1x32x24"}}, {{"structure.cells", "1x8x8"}}}),
            (Labels{"2x64x48 cells", "1x32x24 cells", "1x8x8 cells"}));
  EXPECT_EQ(run_labels({{"coupling.slip", {"true", "false"}}}, {"a", "b"}), (Labels{"slip", "no slip"}));
  EXPECT_EQ(run_labels({{"symmetry.planes", {"x y", "x y z"}}}, {"a", "b"}), (Labels{"planes x y", "planes x y z"}));
  EXPECT_EQ(run_labels({{"scheme.kernel", {"gaussian", "wendland_c2"}}}, {"a", "b"}), (Labels{"gaussian", "wendland_c2"}));
}

TEST(RunLabels, WhatEveryRunHasComesFirst) {
  const auto differing = differing_settings({{{"structure.method", "sph"}, {"end_time", "1"}}, {{"end_time", "2"}}});
  ASSERT_EQ(differing.size(), 2u);
  EXPECT_EQ(differing[0].key, "end_time");
  EXPECT_EQ(differing[1].values, (Labels{"sph", ""}));
}

TEST(RunLabels, RunsOfOneSceneAreCalledByTheirFolders) {
  const RunSettings same{{"name", "tube"}};
  EXPECT_EQ(labels({same, same, {{"name", "rod"}}}), (Labels{"tube out/a", "tube out/b", "rod"}));
  EXPECT_EQ(labels({same, same, same}), (Labels{"out/a", "out/b", "out/c"}));
}

}  // namespace
}  // namespace undex::study
