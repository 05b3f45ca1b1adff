#include "judge/similitude.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "judge/comparisons.hpp"
#include "scene/table_reader.hpp"

namespace undex::judge {
namespace {

using output::Series;

constexpr double decays = 6.7;  // to which impulse and energy are taken

bool is_explosive(const sph::Body& body) { return std::holds_alternative<materials::Jwl>(body.material.law); }

/// The scene's one charge; null where there is none, or more.
const sph::Body* charge_of(const scene::Scene& scene) {
  const auto& bodies = scene.fluid.bodies;
  if (std::count_if(bodies.begin(), bodies.end(), is_explosive) != 1) return nullptr;
  return &*std::find_if(bodies.begin(), bodies.end(), is_explosive);
}

bool is_sphere(const sph::Body& body) { return std::holds_alternative<Sphere>(body.shape.base) && body.shape.removed.empty(); }

Vec3 middle_of(const sph::Body& charge) {
  const Bounds extent = bounds(charge.shape, 3);
  return 0.5 * (extent.low + extent.high);
}

double charge_mass(const scene::Scene& scene) {
  if (scene.comparison.similitude.charge_mass) return *scene.comparison.similitude.charge_mass;
  const sph::Body& charge = *charge_of(scene);
  return start_density(charge) * 4.0 / 3.0 * std::numbers::pi * std::pow(std::get<Sphere>(charge.shape.base).radius, 3);
}

std::vector<scene::Probe> probes_of_similitude(const scene::Scene& scene) {
  std::vector<scene::Probe> found;
  for (const scene::Probe& probe : scene.probes)
    if (probe.kind == scene::Probe::Kind::fluid) found.push_back(probe);
  return found;
}

/// The body that a place belongs to at the start; null: none.
const sph::Body* body_at(const scene::Scene& scene, const Vec3& x) {
  for (const sph::Body& body : scene.fluid.bodies)
    if (signed_distance(body.shape, x, 3) <= 0) return &body;
  return nullptr;
}

/// rho c at the start [Pa s/m].
double impedance_of(const sph::Body& body) {
  const double rho = start_density(body), energy = start_energy(body);
  return rho * std::visit([&](const auto& law) { return law.evaluate(rho, energy).sound_speed; }, body.material.law);
}

/// The named explosive's laws, with those of the scene in their place.
SimilitudeLaws laws_of(const scene::Similitude& asked) {
  SimilitudeLaws laws;
  for (const SimilitudeLaws& each : known_similitude())
    if (each.name == asked.explosive) laws = each;
  const auto take = [](const std::vector<double>& own, std::optional<PowerLaw>& law) {
    if (!own.empty()) law = PowerLaw{own[0], own[1]};
  };
  take(asked.peak, laws.peak);
  take(asked.decay, laws.decay);
  take(asked.impulse, laws.impulse);
  take(asked.energy_flux, laws.energy_flux);
  return laws;
}

void check_similitude(const scene::TableReader& table, const scene::Scene& scene) {
  const scene::Similitude& asked = scene.comparison.similitude;
  std::vector<std::string> names;
  for (const SimilitudeLaws& each : known_similitude()) names.push_back(each.name);
  if (!asked.explosive.empty() && std::find(names.begin(), names.end(), asked.explosive) == names.end())
    table.unknown_word("explosive", asked.explosive, names);
  else if (!laws_of(asked).peak)
    table.complain("kind",
                   "comparison.kind = \"similitude\" needs an explosive with known laws, e.g. explosive = \"tnt\", or its own "
                   "peak = [K, exponent]");
  if (scene.fluid.dimension != 3 || scene.geometry == scene::Geometry::plane)
    table.complain("kind", "comparison.kind = \"similitude\" needs space: dimension = 3, \"axisymmetric\" or \"spherical\"");
  const sph::Body* charge = charge_of(scene);
  if (!charge)
    return table.complain("kind", "comparison.kind = \"similitude\" needs one charge, a body of law \"jwl\", and its water");
  if (!asked.charge_mass && !is_sphere(*charge))
    table.complain("kind", "comparison.charge_mass: the charge is no sphere; give its mass in kg");
  const std::vector<scene::Probe> probes = probes_of_similitude(scene);
  if (probes.empty())
    table.complain("kind", "comparison.kind = \"similitude\" reads the pressures of fluid probes; add [[probes]]");
  for (const scene::Probe& probe : probes)
    if (const sph::Body* body = body_at(scene, probe.point); body == charge)
      table.complain("kind",
                     "comparison.kind = \"similitude\": probes." + probe.name + " lies in the charge; move it into the water");
}

Verdict judge_similitude(const scene::Scene& scene, const output::Evidence& evidence, const Reference&) {
  const SimilitudeLaws laws = laws_of(scene.comparison.similitude);
  const double mass = charge_mass(scene), scale = std::cbrt(mass);
  const Vec3 middle = middle_of(*charge_of(scene));
  Verdict verdict;
  output::Samples table({{"distance", "m"},
                         {"reduced_distance", "m/kg^(1/3)"},
                         {"peak", "Pa"},
                         {"peak_similitude", "Pa"},
                         {"decay", "s"},
                         {"decay_similitude", "s"},
                         {"impulse", "Pa s"},
                         {"impulse_similitude", "Pa s"},
                         {"energy_flux", "J/m^2"},
                         {"energy_flux_similitude", "J/m^2"}});
  std::vector<std::vector<double>> rows;
  for (const scene::Probe& probe : probes_of_similitude(scene)) {
    const Series pressure = evidence.series(probe.name, "pressure");
    const sph::Body* water = body_at(scene, probe.point);
    if (pressure.empty() || !water) continue;
    const ShockWave wave = shock_wave(pressure, impedance_of(*water));
    const double distance = (probe.point - middle).norm();
    std::vector<double> row{distance, distance / scale};
    const auto add = [&](const std::string& what, const std::string& unit, double value, const std::optional<PowerLaw>& law,
                         double factor) {
      const double known = law ? factor * law->factor * std::pow(scale / distance, law->exponent) : nan;
      verdict.metrics.emplace_back(what + "_" + probe.name + unit, value);
      if (law) {
        verdict.metrics.emplace_back(what + "_similitude_" + probe.name + unit, known);
        verdict.metrics.emplace_back(what + "_ratio_" + probe.name, value / known);
      }
      row.insert(row.end(), {value, known});
    };
    add("peak", "_pa", wave.peak, laws.peak, 1.0);
    add("decay", "_s", wave.decay, laws.decay, scale);
    add("impulse", "_pa_s", wave.impulse, laws.impulse, scale);
    add("energy_flux", "_j_m2", wave.energy_flux, laws.energy_flux, scale);
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end());
  for (const std::vector<double>& row : rows) table.append(row);
  verdict.tables["similitude.csv"] = table;
  return verdict;
}

}  // namespace

const std::vector<SimilitudeLaws>& known_similitude() {
  // Decay: theta = k s (s/R)^b, b below 0. Impulse and energy, and all of pentolite, Composition B and HBX-1, are from one public
  // table that names no measurement.
  static const std::vector<SimilitudeLaws> all{
      {"tnt",
       "peak and decay: TNT of 1600 kg/m^3 after T. L. Geers and K. S. Hunter (2002), as public codes quote it in SI; impulse "
       "and "
       "energy: BlastDaemon's table, without a source",
       PowerLaw{52.4e6, 1.13}, PowerLaw{84e-6, -0.23}, PowerLaw{5750, 0.89}, PowerLaw{84.4e3, 2.04}},
      {"tnt-arons", "after A. B. Arons, as public codes quote it", PowerLaw{50.4e6, 1.13}, PowerLaw{92.5e-6, -0.22}, {}, {}},
      {"pentolite", "BlastDaemon's table, without a source", PowerLaw{56.1e6, 1.14}, PowerLaw{84e-6, -0.22}, PowerLaw{6520, 0.91},
       PowerLaw{100.2e3, 2.06}},
      {"comp-b", "BlastDaemon's table, without a source", PowerLaw{53.4e6, 1.13}, PowerLaw{92e-6, -0.24}, PowerLaw{6110, 0.91},
       PowerLaw{95.8e3, 2.05}},
      {"hbx-1", "BlastDaemon's table, without a source", PowerLaw{53.5e6, 1.14}, PowerLaw{106e-6, -0.28}, PowerLaw{7150, 0.86},
       PowerLaw{111e3, 2.03}},
  };
  return all;
}

ShockWave shock_wave(const Series& pressure, double impedance) {
  require_valid(pressure);
  ShockWave wave{nan, nan, nan, nan};
  Series over = pressure;
  for (double& p : over.y) p -= pressure.y.front();
  const output::Extremum top = maximum(over, -forever, forever);
  // One that is there from the start has passed; one that still rises at the end has not come.
  if (!(top.y > 0) || top.t <= over.t.front() || top.t >= over.t.back()) return wave;
  wave.peak = top.y;
  wave.decay =
      first_below(over, top.y / std::numbers::e, std::nextafter(top.t, forever), forever) - top.t;  // a jump is two samples
  const double end = top.t + decays * wave.decay;
  if (!(end <= over.t.back())) return wave;
  wave.impulse = wave.energy_flux = 0;
  for (std::size_t i = 1; i < over.t.size() && over.t[i - 1] < end; ++i) {
    const double until = std::min(over.t[i], end), step = until - over.t[i - 1];
    const double a = over.y[i - 1], b = until < over.t[i] ? value_at(over, end) : over.y[i];
    wave.impulse += 0.5 * step * (a + b);
    wave.energy_flux += step * (a * a + a * b + b * b) / (3.0 * impedance);
  }
  return wave;
}

Comparison similitude() {
  return {.kind = {.name = "similitude",
                   .keys = {"explosive", "charge_mass", "peak", "decay", "impulse", "energy_flux"},
                   .check = check_similitude},
          .title = "peak, decay, impulse and energy of a charge's shock wave, beside the laws of similitude",
          .without_value =
              "the wave does not come by the probe within the run, or the run ends before 6.7 decays after its peak; take "
              "a longer end_time (or an earlier start.time, where the wave had passed)",
          .judge = judge_similitude};
}

}  // namespace undex::judge
