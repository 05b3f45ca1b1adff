// Waves on a plate and in the open: exact answers of made-up histories, and Taylor's formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "exact/classical.hpp"
#include "judge/free_field.hpp"
#include "judge/judge.hpp"
#include "judge/taylor_plate.hpp"
#include "run/plane_wave_start.hpp"

namespace undex::judge {
namespace {

using namespace output;

double get(const NamedNumbers& numbers, const std::string& name) {
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const auto& n) { return n.first == name; });
  if (found == numbers.end()) throw std::runtime_error("no metric " + name);
  return found->second;
}

TEST(PlateMetrics, TrianglesGiveTheirExactAnswers) {
  // 0 to 2 MPa at 1 us, back to 0 at 11 us; the plate gains 4 m/s until then and 5 m/s until 21 us.
  const PlateHistories histories{{{0, 1e-6, 11e-6, 21e-6}, {0, 2e6, 0, 0}}, {{0, 11e-6, 21e-6}, {0, 4, 5}}};
  const NamedNumbers metrics = plate_metrics(histories, 10.0, 1e6);
  EXPECT_NEAR(get(metrics, "cavitation_s"), 11e-6, 1e-12);
  EXPECT_NEAR(get(metrics, "impulse_pa_s"), 40.0, 1e-6);
  EXPECT_NEAR(get(metrics, "end_impulse_pa_s"), 45.0, 1e-6);
  EXPECT_NEAR(get(plate_metrics(histories, 10.0, 1e6, "_1d"), "cavitation_1d_s"), 11e-6, 1e-12);
}

TEST(PlateMetrics, OscillationOnTheWayIsNotPartOfTheFall) {
  // Through 0.1 MPa at about 5 us and up again; the last fall runs from 0.2 MPa at 10 us to zero at 12 us.
  const PlateHistories histories{{{0, 1e-6, 5e-6, 6e-6, 10e-6, 12e-6, 20e-6}, {0, 2e6, 0.09e6, 0.2e6, 0.2e6, 0, 0}},
                                 {{0, 20e-6}, {0, 1}}};
  EXPECT_NEAR(get(plate_metrics(histories, 1.0, 1e6), "cavitation_s"), 12e-6, 1e-12);
}

TEST(PlateMetrics, TaylorsPressureCavitatesWhenItShould) {
  const double theta = 20e-6, z = 1.794, p0 = 1e6, exact = theta * std::log(z) / (z - 1);
  PlateHistories histories;
  histories.pressure.append(-1e-9, 0.0);
  for (int i = 0; i <= 2000; ++i) {
    const double t = 1.2 * exact * i / 2000, a = t / theta;
    const double p = 2 * p0 * (std::exp(-a) - z * (std::exp(-a) - std::exp(-z * a)) / (z - 1));
    histories.pressure.append(t, std::max(p, 0.0));
    histories.velocity.append(t, 1.0);
  }
  EXPECT_NEAR(get(plate_metrics(histories, 1.0, p0), "cavitation_s") / exact, 1.0, 0.01);  // the line is a little early
}

TEST(PlateMetrics, WhatDidNotHappenIsNaN) {
  for (const PlateHistories& histories : {PlateHistories{{{0, 1e-5}, {0, 2e6}}, {{0, 1e-5}, {0, 1}}},
                                          PlateHistories{{{0, 1e-5}, {0, 1e3}}, {{0, 1e-5}, {0, 1}}}, PlateHistories{}})
    for (const auto& [name, value] : plate_metrics(histories, 1.0, 1e6)) EXPECT_TRUE(std::isnan(value)) << name;
  EXPECT_THROW(plate_metrics({{{0, 1e-5}, {0, std::nan("")}}, {}}, 1.0, 1e6), std::invalid_argument);
}

/// Where water at rest has a pressure, a wave whose front stands at the plate begins above its own peak.
TEST(PlateMetrics, APressureThatBeginsAboveThePeakHasReachedIt) {
  const PlateHistories histories{{{0, 10e-6, 20e-6}, {1.1e6, 0, 0}}, {{0, 20e-6}, {0, 2}}};
  EXPECT_NEAR(get(plate_metrics(histories, 1.0, 1e6), "cavitation_s"), 10e-6, 1e-12);
}

TEST(Missing, EveryReasonIsOneLine) {
  EXPECT_EQ(missing_text({}), "");
  EXPECT_EQ(missing_text({{"a", "it rained"}, {"b", "no probe"}, {"c", "it rained"}}),
            "no value: a, c: it rained\nno value: b: no probe\n");
}

/// A sharp exponential wave as a mesh would show it, its front smeared over eight cells: the peak is found behind it.
TEST(BlastMetrics, PeakBehindASmearedFront) {
  Blast blast{.pressure = {}, .smear = 0.1e-6};
  for (double t = 0; t < 40e-6; t += 0.02e-6)
    blast.pressure.append(t, 1e5 + 1e9 * std::exp(-(t - 10e-6) / 8e-6) * 0.5 * (1 + std::tanh((t - 10e-6) / 0.15e-6)));
  EXPECT_LT(maximum(blast.pressure, 0, 1).y, 0.97e9);
  EXPECT_NEAR(peak_behind_front(blast) / 1e9, 1.0, 0.003);
}

TEST(BlastMetrics, APeakThatPassedBeforeTheRunBeganIsNotItsOwn) {
  const Series reference{{0, 10e-6, 11e-6, 21e-6, 40e-6}, {0, 0, 1e7, 0, 0}}, run{{15e-6, 21e-6, 40e-6}, {6e6, 0, 0}};
  const NamedNumbers metrics = blast_metrics(run, {reference}, "r2", 15e-6, 40e-6);
  EXPECT_TRUE(std::isnan(get(metrics, "peak_r2_pa")));
  EXPECT_TRUE(std::isnan(get(metrics, "arrival_r2_s")));
  EXPECT_DOUBLE_EQ(get(metrics, "peak_1d_r2_pa"), 1e7);
  EXPECT_NEAR(get(metrics, "impulse_1d_r2_pa_s"), 18, 1e-9);
}

/// The one-dimensional reference at 2 and 3 charge radii: converged to 0.3 %, and the same however far the water goes.
TEST(FreeField, ReferenceIsConverged) {
  const auto peaks = [](const char* water, int cells) {
    const scene::Scene scene =
        scene::read(UNDEX_CASES "/free_field", comparison_kinds(),
                    {{"bodies.water.shape.radius", water},
                     {"probes", "[{name = \"a\", point = [0.02, 0, 0]}, {name = \"b\", point = [0.03, 0, 0]}]"}});
    std::vector<double> found;
    for (const Blast& blast : free_field_in_one_dimension(scene, 9e-6, cells)) found.push_back(peak_behind_front(blast));
    return found;
  };
  const auto usual = peaks("0.1", 400), wide = peaks("0.2", 400), fine = peaks("0.1", 800);
  for (int k = 0; k < 2; ++k) {
    RecordProperty("peak_" + std::to_string(k), std::to_string(usual[k]) + " " + std::to_string(fine[k]));
    EXPECT_DOUBLE_EQ(usual[k], wide[k]);
    EXPECT_NEAR(usual[k] / fine[k], 1.0, 0.003);
  }
}

/// A wave far longer than the water: its mesh is as fine as the water asks for, and the plate follows Taylor's formula.
TEST(PlateReference, LongWavesAreResolved) {
  const scene::Scene scene = scene::read(UNDEX_CASES "/taylor_plate", comparison_kinds(), {{"start.decay", "0.01"}});
  const Series v = plate_in_one_dimension(scene, 15e-6).velocity;
  const exact::PlaneWave wave = run::plane_wave(scene);
  const exact::TaylorPlate theory{.peak = 1e6, .decay = 0.01, .impedance = wave.impedance(), .plate_mass = 2700 * 0.00635};
  for (const double t : {5e-6, 10e-6, 15e-6}) EXPECT_NEAR(value_at(v, t) / theory.velocity(t), 1.0, 3e-3) << t;
}

TEST(PlateReference, WhatWouldTakeForeverIsRefusedBeforeTheRun) {
  for (const auto& [key, value] :
       {std::pair{"start.decay", "1e-9"}, {"start.decay", "1e-15"}, {"structure.material.rho0", "1e-6"}}) {
    try {
      scene::read(UNDEX_CASES "/taylor_plate", comparison_kinds(), {{key, value}});
      ADD_FAILURE() << key << " = " << value << " is accepted";
    } catch (const SceneError& refused) {
      EXPECT_NE(std::string(refused.what()).find("start.decay"), std::string::npos) << refused.what();
    }
  }
}

TEST(BlastMetrics, TrianglesGiveTheirExactAnswers) {
  const Series run{{0, 10e-6, 12e-6, 22e-6, 40e-6}, {0, 0, 8e6, 0, 0}},
      reference{{0, 10e-6, 11e-6, 21e-6, 40e-6}, {0, 0, 1e7, 0, 0}};
  const NamedNumbers metrics = blast_metrics(run, {reference}, "r4", 0, 40e-6);
  EXPECT_DOUBLE_EQ(get(metrics, "peak_r4_pa"), 8e6);
  EXPECT_DOUBLE_EQ(get(metrics, "peak_1d_r4_pa"), 1e7);
  EXPECT_NEAR(get(metrics, "arrival_r4_s"), 11e-6, 1e-12);
  EXPECT_NEAR(get(metrics, "arrival_1d_r4_s"), 10.5e-6, 1e-12);
  EXPECT_NEAR(get(metrics, "impulse_r4_pa_s"), 48, 1e-9);
  EXPECT_NEAR(get(metrics, "impulse_1d_r4_pa_s"), 55, 1e-9);
  EXPECT_EQ(get(blast_metrics(reference, {reference}, "r4", 0, 40e-6), "l1_pressure_r4"), 0.0);
  EXPECT_GT(get(metrics, "l1_pressure_r4"), (55 - 48) / 40e-6 / 1e7 - 1e-12);  // at least the impulses' difference
}

TEST(BlastMetrics, OutsideOfTheHistoriesIsNaN) {
  const Series run{{0, 10e-6}, {0, 1e6}}, reference{{0, 40e-6}, {0, 1e6}};
  EXPECT_TRUE(std::isnan(get(blast_metrics(run, {reference}, "a", 0, 40e-6), "l1_pressure_a")));
  EXPECT_TRUE(std::isnan(get(blast_metrics(run, {reference}, "a", 0, 40e-6), "impulse_a_pa_s")));
}

}  // namespace
}  // namespace undex::judge
