// comparison.kind = "profile": the particles at the end beside an exact solution in space (docs/reference/outputs.md,
// "Metrics: profile").
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "core/constants.hpp"
#include "exact/classical.hpp"
#include "exact/detonation.hpp"
#include "exact/riemann.hpp"
#include "judge/comparisons.hpp"
#include "judge/profile_points.hpp"
#include "judge/profile_problem.hpp"
#include "scene/table_reader.hpp"

namespace undex::judge {
namespace {

using output::NamedNumbers;

/// Pressures beside a contact, and apart from contacts and shocks, are looked at within and beyond so many spacings: three
/// kernels of a liquid, one of a gas that has expanded as far as h follows it.
constexpr double near = 10;

/// What the metrics of all solutions need.
struct Case {
  const scene::Scene& scene;
  const ProfileProblem& problem;
  double time, spacing;
  int dimension;
  std::function<FlowState(double)> exact = {};                // of the coordinate
  std::function<NamedNumbers(const Case&)> own_metrics = {};  // of this solution alone
  Profile profile = {};                                       // within the window

  const sph::Body& body(std::size_t k) const { return scene.fluid.bodies[k]; }
  Profile shells() const { return judge::shells(profile, spacing); }
};

/// `name`, `exact_name` and their distance in spacings.
void add_position(NamedNumbers& metrics, const Case& c, const std::string& name, double run, double exact) {
  metrics.insert(metrics.end(),
                 {{name + "_m", run}, {"exact_" + name + "_m", exact}, {name + "_error_spacings", (run - exact) / c.spacing}});
}

void add_pair(NamedNumbers& metrics, const std::string& name, double run, double exact) {
  metrics.insert(metrics.end(), {{name, run}, {"exact_" + name, exact}});
}

bool planar(const Case& c) { return c.problem.solution == scene::Solution::riemann; }

void collect(Case& c, const output::Evidence& evidence) {
  const auto field = [&](const char* name) -> const std::vector<double>& { return evidence.field(name).values; };
  const std::vector<double>&x = field("fluid.position"), &v = field("fluid.velocity"), &rho = field("fluid.density"),
        &p = field("fluid.pressure"), &mass = field("fluid.mass"), &body = field("fluid.material");
  for (std::size_t i = 0; i < rho.size(); ++i) {
    const Vec3 at(x[3 * i], x[3 * i + 1], x[3 * i + 2]), velocity(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    const Vec3 away = at - c.problem.center;
    if (c.scene.comparison.core && std::max(std::abs(at[1]), std::abs(at[2])) > *c.scene.comparison.core) continue;
    ProfilePoint point;
    point.coordinate = planar(c) ? at[0] : away.norm();
    if (point.coordinate < c.scene.comparison.window_low || point.coordinate > c.scene.comparison.window_high) continue;
    point.volume = mass[i] / rho[i];
    point.body = int(body[i]);
    point.run = {rho[i], planar(c) ? velocity[0] : away.norm() > 0 ? velocity.dot(away) / away.norm() : 0.0, p[i]};
    point.exact = c.exact(point.coordinate);
    c.profile.push_back(point);
  }
  std::stable_sort(c.profile.begin(), c.profile.end(),
                   [](const ProfilePoint& a, const ProfilePoint& b) { return a.coordinate < b.coordinate; });
}

/// The exact solution at a thousand places across the window's particles.
Profile exact_line(const Case& c) {
  Profile line;
  if (c.profile.empty()) return line;
  const double low = c.profile.front().coordinate, high = c.profile.back().coordinate;
  for (int k = 0; k <= 1000; ++k) {
    ProfilePoint point;
    point.coordinate = low + (high - low) * k / 1000;
    point.exact = c.exact(point.coordinate);
    line.push_back(point);
  }
  return line;
}

// ---------------------------------------------------------------------------------------------------- Riemann problem

exact::RiemannSide side_of(const sph::Body& body) {
  return {.law = body.material.law,
          .density = sph::start_density(body),
          .velocity = body.velocity[0],
          .energy = sph::start_energy(body)};
}

/// Where the exact pressure on one side has changed by half from the outer state to the star's, as x/t [m/s].
double half_way(const exact::RiemannSolution& solution, int side) {
  if (solution.shock(side)) return solution.head(side);
  double inner = solution.tail(side), outer = solution.head(side);
  const double start = solution.sample(outer).pressure, level = 0.5 * (start + solution.star(side).pressure);
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (inner + outer);
    (solution.sample(middle).pressure > level ? outer : inner) = middle;
  }
  return 0.5 * (inner + outer);
}

/// Edge of one fluid at its contact [m]: half a particle beyond its last one.
double inner_edge(const Case& c, int side) {
  const std::size_t body = side == 0 ? c.problem.first : c.problem.second;
  double edge = nan;
  for (const ProfilePoint& p : c.profile) {
    if (p.body != int(body)) continue;
    const double half = 0.5 * p.volume / std::pow(c.spacing, c.dimension - 1);
    edge = side == 0 ? std::fmax(edge, p.coordinate + half) : std::fmin(edge, p.coordinate - half);
  }
  return edge;
}

NamedNumbers riemann_metrics(const Case& c, const exact::RiemannSolution& solution) {
  NamedNumbers metrics;
  const double x0 = c.problem.center[0], t = c.time;
  const char* const names[2] = {"left", "right"};
  const Profile shells = c.shells();
  double shock[2] = {nan, nan}, start[2];
  for (const int side : {0, 1}) {
    start[side] = solution.sample(side == 0 ? -1e300 : 1e300).pressure;
    const double exact = x0 + t * half_way(solution, side);
    if (solution.shock(side)) shock[side] = exact;
    const double level = 0.5 * (start[side] + solution.star(side).pressure);
    add_position(metrics, c, std::string(names[side]) + "_front", front_position(shells, &FlowState::pressure, level, side == 1),
                 exact);
  }
  const double edge[2] = {inner_edge(c, 0), inner_edge(c, 1)};
  const double exact_edge[2] = {x0 + t * solution.star(0).velocity, x0 + t * solution.star(1).velocity};
  if (solution.cavity())
    add_position(metrics, c, "void_half_width", 0.5 * (edge[1] - edge[0]), 0.5 * (exact_edge[1] - exact_edge[0]));
  else add_position(metrics, c, "contact", 0.5 * (edge[0] + edge[1]), exact_edge[0]);

  for (const int side : {0, 1}) {
    // The middle third between contact and wave.
    const double reach = x0 + t * solution.head(side) - exact_edge[side];
    const double a = exact_edge[side] + reach / 3, b = exact_edge[side] + 2 * reach / 3;
    const ProfileMean mean = profile_mean(c.profile, std::min(a, b), std::max(a, b));
    const double before = c.body(side == 0 ? c.problem.first : c.problem.second).velocity[0];
    const std::string name = names[side];
    add_pair(metrics, name + "_velocity_change_m_s", mean.run.velocity - before, mean.exact.velocity - before);
    add_pair(metrics, name + "_pressure_pa", mean.run.pressure, mean.exact.pressure);
  }

  const double jump = std::max({start[0], start[1], solution.pressure()}) - std::min({start[0], start[1], solution.pressure()});
  const auto far_from_shocks = [&](const ProfilePoint& p) {
    return !(std::abs(p.coordinate - shock[0]) < near * c.spacing) && !(std::abs(p.coordinate - shock[1]) < near * c.spacing);
  };
  const auto beside_contact = [&](const ProfilePoint& p) {
    return std::abs(p.coordinate - edge[p.body == int(c.problem.first) ? 0 : 1]) < near * c.spacing;
  };
  metrics.emplace_back("contact_oscillation", largest_pressure_error(c.profile, [&](const ProfilePoint& p) {
                                                return beside_contact(p) && far_from_shocks(p);
                                              }) / jump);
  for (const int side : {0, 1}) {
    double most = nan;
    if (solution.shock(side))
      for (const ProfilePoint& p : c.profile)
        if ((side == 0) == (p.body == int(c.problem.first)) && !beside_contact(p) &&
            (side == 0 ? p.coordinate > shock[0] : p.coordinate < shock[1]))
          most = std::fmax(most, (p.run.pressure - solution.pressure()) / (solution.pressure() - start[side]));
    metrics.emplace_back(std::string(names[side]) + "_overshoot", most);
  }
  return metrics;
}

// ---------------------------------------------------------------------------------------------------- round flows

NamedNumbers taylor_wave_metrics(const Case& c, const exact::TaylorWave& solution) {
  NamedNumbers metrics;
  const double front = solution.front().detonation_speed * c.time;
  add_position(metrics, c, "front", front_position(c.shells(), &FlowState::pressure, 0.5 * solution.front().pressure, true),
               front);
  double peak = nan;
  for (const ProfilePoint& p : c.profile) peak = std::fmax(peak, p.run.pressure);
  add_pair(metrics, "peak_pressure_pa", peak, solution.front().pressure);
  const ProfileMean core = profile_mean(c.profile, 0, 0.8 * solution.core_share() * front);
  add_pair(metrics, "core_pressure_pa", core.run.pressure, core.exact.pressure);
  add_pair(metrics, "core_density_kg_m3", core.run.density, core.exact.density);
  return metrics;
}

/// The largest of a quantity in means over shells.
double shell_peak(const Profile& shells, double FlowState::*quantity) {
  double most = nan;
  for (const ProfilePoint& p : shells) most = std::fmax(most, p.run.*quantity);
  return most;
}

NamedNumbers sedov_metrics(const Case& c, const exact::Sedov& solution) {
  NamedNumbers metrics;
  const Profile shells = c.shells();
  const double front = solution.shock_radius(c.time), rho0 = sph::start_density(c.body(c.problem.second));
  const double peak = shell_peak(shells, &FlowState::density);
  const FlowState behind = c.exact(front * (1 - 1e-9));
  add_position(metrics, c, "front", front_position(shells, &FlowState::density, 0.5 * (rho0 + peak), true), front);
  add_pair(metrics, "peak_density_kg_m3", peak, behind.density);
  add_pair(metrics, "peak_pressure_pa", shell_peak(shells, &FlowState::pressure), behind.pressure);
  const ProfileMean core = profile_mean(c.profile, 0, 0.4 * front);
  add_pair(metrics, "core_pressure_pa", core.run.pressure, core.exact.pressure);
  return metrics;
}

NamedNumbers noh_metrics(const Case& c, const exact::Noh& solution) {
  NamedNumbers metrics;
  const double front = solution.shock_radius(c.time);
  const FlowState behind = c.exact(0.0);
  add_position(metrics, c, "front", front_position(c.shells(), &FlowState::pressure, 0.5 * behind.pressure, true), front);
  const ProfileMean plateau = profile_mean(c.profile, 0.3 * front, 0.8 * front);
  add_pair(metrics, "density_kg_m3", plateau.run.density, plateau.exact.density);
  add_pair(metrics, "pressure_pa", plateau.run.pressure, plateau.exact.pressure);
  const ProfileMean centre = profile_mean(c.profile, 0, 0.2 * front);
  add_pair(metrics, "centre_density_kg_m3", centre.run.density, centre.exact.density);
  add_pair(metrics, "centre_pressure_pa", centre.run.pressure, centre.exact.pressure);
  return metrics;
}

FlowState state(const exact::GasSample& s) { return {s.density, s.velocity, s.pressure}; }

double gamma_of(const sph::Body& body) { return std::get<materials::IdealGas>(body.material.law).parameters().gamma; }

exact::Sedov sedov(const Case& c) {
  const sph::Body &hot = c.body(c.problem.first), &cold = c.body(c.problem.second);
  // Shapes are given whole, whatever the symmetry planes.
  const double volume_of_hot = volume(hot.shape, bounds(hot.shape, c.dimension), c.dimension);
  const double energy = sph::start_density(hot) * volume_of_hot * sph::start_energy(hot);
  return {c.dimension, gamma_of(hot), sph::start_density(cold), c.dimension == 1 ? 0.5 * energy : energy};
}

// ---------------------------------------------------------------------------------------------------- the four problems

void pose_riemann(Case& c) {
  const auto solution =
      std::make_shared<exact::RiemannSolution>(side_of(c.body(c.problem.first)), side_of(c.body(c.problem.second)));
  c.exact = [solution, x0 = c.problem.center[0], t = c.time](double x) {
    const exact::RiemannSample s = solution->sample((x - x0) / t);
    return FlowState{s.density, s.velocity, s.pressure};
  };
  c.own_metrics = [solution](const Case& posed) { return riemann_metrics(posed, *solution); };
}

void pose_taylor_wave(Case& c) {
  const auto solution = std::make_shared<exact::TaylorWave>(std::get<materials::Jwl>(c.body(c.problem.first).material.law),
                                                            c.problem.plane ? 1 : c.dimension);
  c.exact = [solution, t = c.time](double r) {
    const exact::TaylorWave::Sample s = solution->sample(r, t);
    return FlowState{s.density, s.velocity, s.pressure};
  };
  c.own_metrics = [solution](const Case& posed) { return taylor_wave_metrics(posed, *solution); };
}

void pose_sedov(Case& c) {
  const auto solution = std::make_shared<exact::Sedov>(sedov(c));
  c.exact = [solution, t = c.time](double r) { return state(solution->sample(r, t)); };
  c.own_metrics = [solution](const Case& posed) { return sedov_metrics(posed, *solution); };
}

void pose_noh(Case& c) {
  const sph::Body& gas = c.body(c.problem.first);
  const exact::Noh solution{c.dimension, gamma_of(gas), sph::start_density(gas), -gas.radial_velocity};
  c.exact = [solution, t = c.time](double r) { return state(solution.sample(r, t)); };
  c.own_metrics = [solution](const Case& posed) { return noh_metrics(posed, solution); };
}

void pose(Case& c) {
  switch (c.problem.solution) {
    case scene::Solution::riemann: return pose_riemann(c);
    case scene::Solution::taylor_wave: return pose_taylor_wave(c);
    case scene::Solution::sedov: return pose_sedov(c);
    case scene::Solution::noh: return pose_noh(c);
  }
}

// ---------------------------------------------------------------------------------------------------- the comparison

/// Whether the bodies pose such a problem.
void check_profile(const scene::TableReader& table, const scene::Scene& scene) {
  const scene::Comparison& comparison = scene.comparison;
  if (!comparison.solution) return;
  if (comparison.core && *comparison.solution != scene::Solution::riemann)
    table.complain("core", table.path_of("core") + " is for solution = \"riemann\": round flows have no axis; leave it out");
  if (scene.meridian && *comparison.solution == scene::Solution::riemann)
    table.complain("solution",
                   table.path_of("solution") + ": a plane flow is compared in 1, 2 or 3 dimensions, not in a meridian");
  if (!table.report().empty()) return;  // bodies that are not sound pose nothing
  try {
    const ProfileProblem problem = profile_problem(scene.fluid, *comparison.solution);
    Case c{.scene = scene,
           .problem = problem,
           .time = scene.end_time,
           .spacing = scene.fluid.lattice.spacing,
           .dimension = scene.fluid.dimension};
    pose(c);  // a solution that does not exist is known before the run
  } catch (const std::invalid_argument& misfit) {
    table.complain("solution", table.path_of("solution") + ": " + misfit.what());
  } catch (const std::domain_error& none) {
    table.complain("solution", table.path_of("solution") + ": these bodies have no such solution: " + none.what() +
                                   "; change their states or laws, or leave out [comparison]");
  }
}

std::vector<std::string> last_fields_of_profile(const scene::Scene&) {
  return {"fluid.position", "fluid.velocity", "fluid.density", "fluid.pressure", "fluid.mass", "fluid.material"};
}

Verdict judge_profile(const scene::Scene& scene, const output::Evidence& evidence, const Reference&) {
  if (!(evidence.time > 0)) return {.metrics = {}, .missing = {{"all", "the run has taken no step"}}};
  const ProfileProblem problem = profile_problem(scene.fluid, *scene.comparison.solution);
  Case c{.scene = scene,
         .problem = problem,
         .time = evidence.time,
         .spacing = scene.fluid.lattice.spacing,
         .dimension = scene.fluid.dimension};
  pose(c);
  collect(c, evidence);
  Verdict verdict;
  verdict.metrics = profile_errors(c.profile);
  const NamedNumbers own = c.own_metrics(c);
  verdict.metrics.insert(verdict.metrics.end(), own.begin(), own.end());
  verdict.tables = {{"profile.csv", profile_table(c.profile)}, {"profile_exact.csv", exact_profile_table(exact_line(c))}};
  return verdict;
}

}  // namespace

Comparison profile() {
  return {.kind = {.name = "profile", .keys = {"solution", "window", "core"}, .check = check_profile},
          .title = "the particles at the end beside an exact solution in space",
          .beside_table = false,
          .last_fields = last_fields_of_profile,
          .judge = judge_profile};
}

}  // namespace undex::judge
