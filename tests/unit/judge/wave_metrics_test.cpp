// Waves on a plate and in the open: exact answers of made-up histories, and Taylor's formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "exact/classical.hpp"
#include "judge/free_field.hpp"
#include "judge/judge.hpp"
#include "judge/similitude.hpp"
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

/// A history that jumps to P over 1e5 Pa at 1 ms and decays with theta.
Series shock(double peak, double theta, double end, double step) {
  Series p{{0.0, 1e-3}, {1e5, 1e5}};
  for (double t = 0; t <= end; t += step) p.append(1e-3 + t, 1e5 + peak * std::exp(-t / theta));
  return p;
}

TEST(Similitude, ReadsTheMarksOfAnExponentialWave) {
  const double peak = 20e6, theta = 100e-6, impedance = 1.5e6;
  const ShockWave wave = shock_wave(shock(peak, theta, 1e-3, 1e-7), impedance);
  EXPECT_NEAR(wave.peak / peak, 1.0, 1e-12);
  EXPECT_NEAR(wave.decay / theta, 1.0, 1e-6);
  EXPECT_NEAR(wave.impulse / (peak * theta * (1 - std::exp(-6.7))), 1.0, 1e-5);
  EXPECT_NEAR(wave.energy_flux / (peak * peak * theta / (2 * impedance) * (1 - std::exp(-13.4))), 1.0, 1e-5);
  // Before 6.7 decays have passed there is no impulse, before one no decay; a wave that is there from the start has no peak.
  const ShockWave early = shock_wave(shock(peak, theta, 5 * theta, 1e-7), impedance);
  EXPECT_NEAR(early.decay / theta, 1.0, 1e-6);
  EXPECT_TRUE(std::isnan(early.impulse) && std::isnan(early.energy_flux));
  EXPECT_TRUE(std::isnan(shock_wave(shock(peak, theta, 0.5 * theta, 1e-7), impedance).decay));
  EXPECT_TRUE(std::isnan(shock_wave({{0, 1, 2}, {3e6, 2e6, 1e6}}, impedance).peak));
  EXPECT_TRUE(std::isnan(shock_wave({{0, 1, 2}, {1e5, 1e5, 1e5}}, impedance).peak));
  EXPECT_TRUE(std::isnan(shock_wave({{0, 1, 2}, {1e5, 1e5, 2e5}}, impedance).peak)) << "it still rises";
}

/// Histories that follow the laws give ratios of one, whatever the kind of run.
TEST(Similitude, RatiosOfAWaveThatFollowsTheLawsAreOne) {
  for (const char* dimension : {"\"spherical\"", "\"axisymmetric\"", "3"}) {
    std::vector<scene::Override> changes{{"dimension", dimension},
                                         {"comparison.kind", "\"similitude\""},
                                         {"comparison.charge_mass", "2.5"},
                                         {"comparison.peak", "[52.4e6, 1.13]"},
                                         {"comparison.decay", "[84e-6, -0.23]"}};
    if (std::string(dimension) != "\"spherical\"") changes.push_back({"resolution.spacing", "0.025"});
    const scene::Scene scene = scene::read(UNDEX_CASES "/free_field/tnt.toml", comparison_kinds(), changes);
    Evidence evidence;
    evidence.time = 3e-3;
    const double scale = std::cbrt(2.5);
    for (const scene::Probe& probe : scene.probes) {
      const double R = probe.point.norm();
      const Series p = shock(52.4e6 * std::pow(scale / R, 1.13), 84e-6 * scale * std::pow(scale / R, -0.23), 2e-3, 2e-7);
      Samples samples({{"time", "s"}, {"pressure", "Pa"}});
      for (std::size_t i = 0; i < p.t.size(); ++i) samples.append({p.t[i], p.y[i]});
      evidence.probes[probe.name] = samples;
    }
    const Verdict verdict = Judge(scene).verdict(evidence);
    int seen = 0;
    for (const auto& [name, value] : verdict.metrics)
      if (name.starts_with("peak_ratio_") || name.starts_with("decay_ratio_")) {
        EXPECT_NEAR(value, 1.0, 1e-5) << name << " " << dimension;
        ++seen;
      }
    EXPECT_EQ(seen, 2 * int(scene.probes.size())) << dimension;
    EXPECT_EQ(verdict.tables.at("similitude.csv").rows(), scene.probes.size());
  }
}

TEST(Similitude, RefusesWhatHasNoLaws) {
  const auto refusal = [](std::vector<scene::Override> changes) -> std::string {
    try {
      scene::read(UNDEX_CASES "/free_field/tnt.toml", comparison_kinds(), changes);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({}), "");
  const auto has = [&](std::vector<scene::Override> changes, const char* what) {
    const std::string said = refusal(std::move(changes));
    EXPECT_NE(said.find(what), std::string::npos) << what << ": " << said;
  };
  has({{"comparison.explosive", "\"tntt\""}}, "tnt");
  has({{"comparison.explosive", "\"\""}}, "needs an explosive with known laws");
  has({{"comparison.peak", "[1]"}}, "must be [factor, exponent]");
  has({{"comparison.charge_mass", "-1"}}, "charge_mass");
  has({{"probes.r5.point", "[0.02, 0, 0]"}}, "lies in the charge");
  has({{"bodies.charge.material", "\"water-tait\""}}, "needs one charge");
}

}  // namespace
}  // namespace undex::judge
