#include "judge/taylor_plate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "exact/classical.hpp"
#include "exact/isentrope.hpp"
#include "exact/lagrangian_1d.hpp"
#include "judge/comparisons.hpp"
#include "run/plane_wave_start.hpp"
#include "run/rest.hpp"
#include "scene/numbers.hpp"
#include "scene/table_reader.hpp"

namespace undex::judge {
namespace {

using output::NamedNumbers;
using output::Series;

/// The plate's extent along the wave's way, and the faces at its ends.
struct Plate {
  double low, high;  // [m]
  std::string low_face, high_face;

  /// Those that look along a wave's way and against it.
  const std::string& back(bool upward) const { return upward ? high_face : low_face; }
  const std::string& front(bool upward) const { return upward ? low_face : high_face; }
};

/// A plate; or a disc whose axis is that of the wave.
std::optional<Plate> plate_of(const scene::Scene& scene) {
  const fem::Settings* structure = scene.only_structure();
  if (!structure) return std::nullopt;
  const int axis = scene.start.wave.axis;
  const std::string letter(1, "xyz"[axis]);
  if (const auto* plate = std::get_if<fem::PlateMesh>(&structure->mesh))
    return Plate{plate->low[axis], plate->high[axis], letter + "_low", letter + "_high"};
  if (const auto* disc = std::get_if<fem::RodMesh>(&structure->mesh); disc && disc->axis == axis)
    return Plate{disc->low, disc->high, "low", "high"};
  return std::nullopt;
}

/// The scene along the wave's way, with the plate's wet face at zero and the water below it.
struct Line {
  double way;            // sign of the wave's direction
  double length, front;  // of the water; of the wave's front [m]
  double plate_mass;     // per area [kg/m^2]
  double gravity;        // along the wave's way [m/s^2]
  double around;         // the surroundings' pressure [Pa]
  output::Series load;   // on the plate's back beside it [Pa]; empty: none
  bool closed;           // is the water's far end at a wall?

  /// Does anything drive the plate back?
  bool returns() const { return gravity != 0.0 || around > 0.0 || !load.empty(); }
};

/// Is there a wall's closed face across the axis at that place [m]?
bool is_closed(const scene::Scene& scene, int axis, bool low, double place) {
  const double same = 1e-6 * scene.fluid.lattice.spacing;
  for (const sph::Wall& wall : scene.fluid.walls) {
    const Bounds box = bounds(wall.container, scene.fluid.dimension);
    if (std::abs((low ? box.low : box.high)[axis] - place) > same) continue;
    const char* end = low ? "low" : "high";
    for (const std::string& face : {std::string(1, "xyz"[axis]) + "_" + end, std::string(end)}) {
      const auto found = wall.faces.find(face);
      if (found != wall.faces.end() && found->second != sph::FaceCondition::open) return true;
    }
  }
  return false;
}

/// The sum of all loads on the plate's back.
output::Series load_on(const scene::Scene& scene, const std::string& face) {
  output::Series sum;
  std::vector<output::Series> loads;
  for (const fem::PressureLoad& load : scene.only_structure()->loads) {
    if (load.face != face) continue;
    loads.push_back({load.time, load.pressure});
    sum.t.insert(sum.t.end(), load.time.begin(), load.time.end());
  }
  std::sort(sum.t.begin(), sum.t.end());
  for (const double t : sum.t) {
    double p = 0;
    for (const output::Series& load : loads) p += value_held(load, t);
    sum.y.push_back(p);
  }
  return sum;
}

Line line_of(const scene::Scene& scene) {
  const scene::Start::Wave& wave = scene.start.wave;
  const Plate plate = plate_of(scene).value();
  const double way = wave.upward ? 1.0 : -1.0;
  const double face = wave.upward ? plate.low : plate.high;
  const Bounds water = bounds(scene.fluid.bodies[run::wave_body(scene)].shape, scene.fluid.dimension);
  const double far_end = wave.upward ? water.low[wave.axis] : water.high[wave.axis];
  return {.way = way,
          .length = way * (face - far_end),
          .front = way * (wave.front - face),
          .plate_mass = scene.only_structure()->material.rho0 * (plate.high - plate.low),
          .gravity = way * scene.fluid.gravity[wave.axis],
          .around = scene.fluid.surroundings.pressure,
          .load = load_on(scene, plate.back(wave.upward)),
          .closed = is_closed(scene, wave.axis, wave.upward, far_end)};
}

/// The one-dimensional mesh of the water: as fine as the wave asks for, and finer towards a plate that weighs less
/// than little water.
struct LineMesh {
  double cells, uniform, last;  // number; width of uniform ones and of that at the plate [m]
};

LineMesh mesh_of(const Line& line, const exact::PlaneWave& wave, int refinement) {
  const double cells = refinement * std::ceil(std::max(300.0 * line.length / wave.length(), 100.0));
  const double uniform = line.length / cells;
  return {
      .cells = cells, .uniform = uniform, .last = std::min(uniform, line.plate_mass / wave.rest().density / (40.0 * refinement))};
}

/// Whether the one-dimensional solution can be computed, beside the run, in minutes.
void expect_affordable(const scene::TableReader& table, const scene::Scene& scene) {
  constexpr double most_cells = 1e5, most_work = 3e9;
  const exact::PlaneWave wave = run::plane_wave(scene);
  const Line line = line_of(scene);
  const LineMesh mesh = mesh_of(line, wave, 1);
  const exact::PlaneWaveState front = wave.front();
  const double sound =
      exact::true_pressure_sound(scene.fluid.bodies[run::wave_body(scene)].material.law, front.density, front.energy).sound_speed;
  const double steps = scene.end_time * std::max(sound, wave.rest_sound()) * front.density / wave.rest().density / mesh.last;
  if (mesh.cells <= most_cells && mesh.cells * steps <= most_work) return;
  table.complain("kind", "comparison.kind = \"taylor_plate\": the one-dimensional solution would take " +
                             scene::rounded(mesh.cells) + " cells and " + scene::rounded(steps) + " steps, for a wave of " +
                             scene::rounded(wave.length()) + " m (start.decay) in water of " + scene::rounded(line.length) +
                             " m, and a plate as heavy as " + scene::rounded(line.plate_mass / wave.rest().density) +
                             " m of it; take a longer wave or a heavier plate, or leave out [comparison]");
}

/// A plate that a plane wave meets head-on.
void check_taylor_plate(const scene::TableReader& table, const scene::Scene& scene) {
  const scene::Start::Wave& wave = scene.start.wave;
  const std::optional<Plate> plate = plate_of(scene);
  const std::string face = !plate ? "" : plate->front(wave.upward);
  if (scene.start.kind != scene::Start::Kind::plane_wave || !plate)
    table.complain(
        "kind",
        "comparison.kind = \"taylor_plate\" needs start.kind = \"plane_wave\" and a [structure] of type \"plate\", or of "
        "type \"rod\" along the wave: a disc");
  else if (scene.only_structure()->wet_faces != std::vector<std::string>{face})
    table.complain("kind", "comparison.kind = \"taylor_plate\": the wave runs onto the plate's face '" + face + "'; write " +
                               scene.path_of(*scene.only_structure()) + ".wet = [\"" + face + "\"]");
  Vec3 across = scene.fluid.gravity;
  across[wave.axis] = 0;
  if (!across.isZero())
    table.complain("kind", "comparison.kind = \"taylor_plate\": gravity must act along the wave's way, start.axis");
  if (plate)
    for (const fem::PressureLoad& load : scene.only_structure()->loads)
      if (load.face != plate->back(wave.upward))
        table.complain("kind", "comparison.kind = \"taylor_plate\": the load on the plate's face '" + load.face +
                                   "' is not in the one-dimensional solution, which knows those on '" + plate->back(wave.upward) +
                                   "'");
  const auto reads_water = [&](const scene::Probe& probe) {
    return probe.name == scene.comparison.probe && probe.kind != scene::Probe::Kind::structure;
  };
  if (std::any_of(scene.probes.begin(), scene.probes.end(), reads_water))
    table.complain("probe", "comparison.probe must be a structure probe: the plate's velocity is compared");
  if (!table.report().empty()) return;
  try {
    expect_affordable(table, scene);
  } catch (const SceneError&) {  // no such wave: the start says so itself
  }
}

/// Time at which y, above `level` at `from`, first falls through it.
double fall_through(const Series& series, double level, double from) {
  for (std::size_t i = 1; i < series.t.size(); ++i)
    if (series.t[i - 1] >= from && series.y[i - 1] >= level && series.y[i] < level)
      return series.t[i - 1] + (series.y[i - 1] - level) / (series.y[i - 1] - series.y[i]) * (series.t[i] - series.t[i - 1]);
  return nan;
}

/// When the pressure is gone [s], or why that is not known.
struct Fall {
  double t = nan;
  const char* unknown = "";
};

Fall fall_to_zero(const Series& p, double peak) {
  const auto reached = std::find_if(p.y.begin(), p.y.end(), [&](double y) { return y >= peak; });
  if (reached == p.y.end()) return {.unknown = "the pressure at the plate has not reached the wave's peak before the end"};
  const double from = p.t[reached - p.y.begin()];
  const double low = fall_through(p, 0.05 * peak, from);
  if (std::isnan(low))
    return {.unknown = "the pressure at the plate has not fallen to a twentieth of the wave's peak before the end"};
  // The last fall before that, so that an oscillation on the way does not stretch the line.
  double high = nan;
  for (double at = fall_through(p, 0.1 * peak, from); at <= low; at = fall_through(p, 0.1 * peak, std::nextafter(at, forever)))
    high = at;
  return {.t = std::isnan(high) ? low : low + (low - high)};
}

/// Of the run (pressure of the first wall probe, velocity of the compared one), of the one-dimensional solution (label "_1d"),
/// and of G. I. Taylor's linear theory ("_acoustic"); and
///   cavitation_error, impulse_error, end_impulse_error   of the run, as a share of the one-dimensional solution's
///   velocity_l1             mean difference of the plate's velocity from that solution, over its largest
Verdict judge_taylor_plate(const scene::Scene& scene, const output::Evidence& evidence, const Reference&) {
  const Line line = line_of(scene);
  const double end = evidence.time;
  const scene::Start::Wave& given = scene.start.wave;
  PlateHistories run;
  for (const scene::Probe& probe : scene.probes)
    if (probe.kind == scene::Probe::Kind::wall && run.pressure.empty()) run.pressure = evidence.series(probe.name, "pressure");
  const char letter = "xyz"[given.axis];
  run.velocity = evidence.series(scene.comparison.probe, std::string("velocity_") + letter);
  for (double& v : run.velocity.y) v *= line.way;

  const PlateReference reference = plate_in_one_dimension(scene, end);
  NamedNumbers metrics = plate_metrics(run, line.plate_mass, given.peak);
  const NamedNumbers exact = plate_metrics(reference, line.plate_mass, given.peak, "_1d");
  const NamedNumbers own = metrics;
  metrics.insert(metrics.end(), exact.begin(), exact.end());

  const exact::PlaneWave wave = run::plane_wave(scene);
  const exact::TaylorPlate theory{
      .peak = given.peak, .decay = given.decay, .impedance = wave.impedance(), .plate_mass = line.plate_mass};
  metrics.emplace_back("cavitation_acoustic_s", theory.cavitation_time() - line.front / wave.rest_sound());
  metrics.emplace_back("impulse_acoustic_pa_s", theory.impulse());
  Verdict verdict;
  for (const std::string label : {"", "_1d"}) {
    const Series& pressure = label.empty() ? run.pressure : reference.pressure;
    std::string why = fall_to_zero(pressure, given.peak).unknown;
    if (why.empty()) continue;
    if (pressure.empty()) why = "the scene has no wall probe with the pressure, at the plate's wet face";
    if (!label.empty()) why = "of the one-dimensional solution: " + why;
    for (const std::string& name : {"cavitation" + label + "_s", "impulse" + label + "_pa_s", "end_impulse" + label + "_pa_s"})
      verdict.missing.emplace_back(name, why);
    for (const char* name : {"cavitation_error", "impulse_error", "end_impulse_error"}) verdict.missing.emplace_back(name, why);
  }
  const char* const names[] = {"cavitation_error", "impulse_error", "end_impulse_error"};
  for (int k = 0; k < 3; ++k) metrics.emplace_back(names[k], own[k].second / exact[k].second - 1.0);
  metrics.emplace_back("velocity_l1", output::difference_norms(run.velocity, reference.velocity, 0.0, end).l1);
  if (line.returns()) {
    run.displacement = evidence.series(scene.comparison.probe, std::string("displacement_") + letter);
    for (double& u : run.displacement.y) u *= line.way;
    for (const NamedNumbers& more : {return_metrics(run), return_metrics(reference, "_1d")})
      metrics.insert(metrics.end(), more.begin(), more.end());
    metrics.emplace_back("first_void_1d_s", reference.first_void);
    for (const auto& [name, value] : metrics)
      if (name.starts_with("closure") && std::isnan(value))
        verdict.missing.emplace_back(name, "the plate has not come back and been stopped before the end");
      else if (name == "first_void_1d_s" && std::isnan(value))
        verdict.missing.emplace_back(name, "the water of the one-dimensional solution does not cavitate");
    metrics.emplace_back("displacement_l1", output::difference_norms(run.displacement, reference.displacement, 0.0, end).l1);
  }
  verdict.metrics = std::move(metrics);
  return verdict;
}

}  // namespace

NamedNumbers plate_metrics(const PlateHistories& histories, double mass, double peak, const std::string& label) {
  require_valid(histories.pressure);
  require_valid(histories.velocity);
  const Series& v = histories.velocity;
  const double cavitation = fall_to_zero(histories.pressure, peak).t;
  const bool reached = !std::isnan(cavitation) && !v.empty() && v.t.back() > cavitation;
  return {
      {"cavitation" + label + "_s", cavitation},
      {"impulse" + label + "_pa_s", reached ? mass * value_at(v, cavitation) : nan},
      {"end_impulse" + label + "_pa_s", reached ? mass * integral(v, cavitation, v.t.back()) / (v.t.back() - cavitation) : nan}};
}

NamedNumbers return_metrics(const PlateHistories& histories, const std::string& label) {
  require_valid(histories.velocity);
  require_valid(histories.displacement);
  const auto largest = [](const Series& series) {
    return series.empty() ? nan : *std::max_element(series.y.begin(), series.y.end());
  };
  const Series& v = histories.velocity;
  double closure = nan;
  if (const auto fastest = std::min_element(v.y.begin(), v.y.end()); fastest != v.y.end() && *fastest < 0.0) {
    Series back = v;
    for (double& each : back.y) each = -each;
    closure = fall_through(back, -0.5 * *fastest, v.t[fastest - v.y.begin()]);
  }
  return {{"peak_velocity" + label + "_m_s", largest(v)},
          {"peak_displacement" + label + "_m", largest(histories.displacement)},
          {"closure" + label + "_s", closure}};
}

PlateReference plate_in_one_dimension(const scene::Scene& scene, double end, int refinement) {
  const Line line = line_of(scene);
  const exact::PlaneWave wave = run::plane_wave(scene);
  const LineMesh line_mesh = mesh_of(line, wave, refinement);
  const int cells = int(line_mesh.cells);
  const sph::Body& body = scene.fluid.bodies[run::wave_body(scene)];
  exact::Layer water{.law = body.material.law, .inner = -line.length, .outer = 0.0, .cells = cells};
  if (line_mesh.last < 0.99 * line_mesh.uniform) water.ratio = 1.0 / exact::grading(line.length, cells, line_mesh.last);
  // Under gravity the column's pressure, beyond that at its level, comes on top of the wave's.
  const int axis = scene.start.wave.axis;
  const double face = scene.start.wave.front - line.way * line.front;
  const auto at_rest = run::rest_of(body, scene);
  water.start = [&](double x) {
    const exact::PlaneWaveState s = wave.at(line.front - x);
    if (line.gravity == 0.0) return exact::StartPoint{s.density, s.velocity, s.energy};
    const double more = at_rest((face + line.way * x) * Vec3::Unit(axis)).pressure - wave.rest().pressure;
    return exact::StartPoint{materials::density_at(body.material.law, s.pressure + more, s.energy), s.velocity, s.energy};
  };
  exact::Lagrangian1DOptions options{.outer_mass = line.plate_mass};
  options.inner_pressure = options.outer_pressure = line.around;
  options.gravity = line.gravity;
  if (!line.load.empty()) options.outer_load = [&](double t) { return value_held(line.load, t); };
  exact::Lagrangian1D mesh(1, {water}, line.closed ? exact::Boundary::rigid : exact::Boundary::free, exact::Boundary::free,
                           options);
  const auto has_void = [&] {
    const auto rho = mesh.cell_density(), e = mesh.cell_energy();
    for (int i = 0; i < mesh.cells(); ++i)
      if (std::visit([&](const auto& law) { return law.void_fraction(rho[i], e[i]); }, body.material.law) > 1e-6) return true;
    return false;
  };
  PlateReference reference{{}, nan};
  constexpr int samples = 1000;
  const double start = mesh.node_radius().back();
  for (int i = 0; i <= samples; ++i) {
    mesh.advance(end * i / samples);
    reference.pressure.append(mesh.time(), mesh.cell_pressure().back());
    reference.velocity.append(mesh.time(), mesh.node_velocity().back());
    reference.displacement.append(mesh.time(), mesh.node_radius().back() - start);
    if (std::isnan(reference.first_void) && has_void()) reference.first_void = mesh.time();
  }
  return reference;
}

Comparison taylor_plate() {
  return {.kind = {.name = "taylor_plate", .needs_probe = true, .check = check_taylor_plate},
          .title = "a plate that a plane wave throws, beside a one-dimensional solution and Taylor's theory",
          .judge = judge_taylor_plate};
}

}  // namespace undex::judge
