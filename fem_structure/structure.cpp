#include "fem_structure/structure.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

#include "core/bilinear_patch.hpp"
#include "core/errors.hpp"
#include "fem_structure/element_parts.hpp"
#include "fem_structure/grid.hpp"
#include "fem_structure/mistakes.hpp"
#include "fem_structure/shell_elements.hpp"

namespace undex::fem {
namespace {

constexpr std::size_t nodes_worth_threads = 4096;  // nodes: fewer are not worth waking threads for

std::string listed(const Grid& grid) {
  std::string names;
  for (const auto& [name, quads] : grid.faces) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

/// How far a point is beyond the plane [m]; negative on the body's side.
double depth(const RigidPlane& plane, const Vec3& x) {
  return plane.body_above ? plane.position - x[plane.axis] : x[plane.axis] - plane.position;
}

/// What is not of revolution.
void check_meridian(Mistakes& mistakes, const Settings& settings) {
  const auto along_axis = [](const Vec3& v) { return v[0] == 0.0 && v[2] == 0.0; };
  mistakes.require(along_axis(settings.initial_velocity), "the initial velocity (", settings.initial_velocity.transpose(),
                   ") m/s is not along the axis of revolution; make it so, or compute in 3D");
  mistakes.require(along_axis(settings.gravity), "gravity (", settings.gravity.transpose(),
                   ") m/s^2 is not along the axis of revolution; make it so, or compute in 3D");
  for (const RigidPlane& plane : settings.planes)
    mistakes.require(plane.axis == 1, "a rigid plane across axis ", plane.axis,
                     " is not of revolution; put it across the axis of revolution, or compute in 3D");
  for (const int axis : settings.symmetry_axes)
    mistakes.require(axis == 1, "symmetry axis ", axis, " does not exist in a meridian; only that along the axis, 1, does");
}

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// Every cell has a material, and every part is one of the mesh.
void check_materials(Mistakes& mistakes, const Settings& settings, const Grid& grid) {
  const std::vector<int> part_of = parts_of(settings, grid);
  std::set<std::string> groups;
  for (const int group : grid.groups) groups.insert(grid.group_names.of(group));
  std::set<std::string> named;
  for (const Part& part : settings.parts) {
    const std::string group = grid.group_names.meant_by(part.group);
    mistakes.require(groups.count(group) > 0, "a part names the group '", part.group, "'; the groups of this mesh are ",
                     listed(groups));
    mistakes.require(named.insert(group).second, "two parts name the group '", part.group, "'; leave out one of them");
  }
  std::set<int> used(part_of.begin(), part_of.end());
  for (const int p : used) {
    const materials::Solid& material = material_of(settings, p);
    mistakes.require(material.rho0 > 0.0 && material.shear_modulus > 0.0, "material '", material.name, "' has density ",
                     material.rho0, " kg/m^3 and shear modulus ", material.shear_modulus, " Pa; both must be positive");
    mistakes.require(material.heat_capacity > 0.0, "material '", material.name, "' has heat capacity ", material.heat_capacity,
                     " J/kg/K; it must be positive");
  }
}

void check(const Settings& settings, const Grid& grid) {
  Mistakes mistakes("structure '" + settings.name + "'");
  const auto known = [&](const std::string& face, const char* where) {
    mistakes.require(grid.faces.count(face) > 0, where, " names the face '", face, "'; the faces of this mesh are ",
                     listed(grid));
  };
  for (const Support& support : settings.supports) known(support.face, "a support");
  for (const std::string& face : settings.wet_faces) known(face, "wet_faces");
  for (const PressureLoad& load : settings.loads) {
    known(load.face, "a pressure load");
    mistakes.require(!load.time.empty() && load.time.size() == load.pressure.size(), "the pressure load on '", load.face,
                     "' has ", load.time.size(), " times and ", load.pressure.size(),
                     " pressures; give at least one, and as many of each");
    mistakes.require(std::adjacent_find(load.time.begin(), load.time.end(), std::greater_equal<>()) == load.time.end(),
                     "the times of the pressure load on '", load.face, "' must increase");
  }
  mistakes.require(settings.courant > 0.0 && settings.courant <= 1.0, "courant = ", settings.courant,
                   "; give a share of the stable step in (0, 1], 0.8 is usual");
  mistakes.require(settings.linear_viscosity >= 0.0 && settings.quadratic_viscosity >= 0.0, "bulk viscosities ",
                   settings.linear_viscosity, " and ", settings.quadratic_viscosity,
                   " must not be negative; 0.06 and 1.2 are usual, 0 switches one off");
  check_materials(mistakes, settings, grid);
  mistakes.require(settings.initial_velocity.allFinite() && settings.spin.allFinite(), "the initial velocity is not finite");
  mistakes.require(settings.points_through >= 2 && settings.points_through <= most_layers,
                   "points_through = ", settings.points_through, "; give 2 to ", most_layers);

  if (settings.axisymmetric) check_meridian(mistakes, settings);

  double extent = 0.0;
  for (const Vec3& x : grid.nodes) extent = std::max(extent, x.cwiseAbs().maxCoeff());
  for (const RigidPlane& plane : settings.planes) {
    mistakes.require(plane.axis >= 0 && plane.axis <= 2 && std::isfinite(plane.position), "a rigid plane has axis ", plane.axis,
                     " and position ", plane.position, " m; give axis 0, 1 or 2 and a finite position");
    if (plane.axis < 0 || plane.axis > 2) continue;
    double deepest = 0.0;
    for (const Vec3& x : grid.nodes) deepest = std::max(deepest, depth(plane, x));
    mistakes.require(deepest <= 1e-9 * extent, "the body begins ", deepest, " m beyond the rigid plane at ", plane.position,
                     " m; move one of them, or take the plane's other side");
  }
  for (int axis : settings.symmetry_axes) {
    if (axis < 0 || axis > 2) {
      mistakes.require(false, "symmetry axis ", axis, " does not exist; give 0, 1 or 2 (x, y, z)");
      continue;
    }
    double lowest = 0.0;
    for (const Vec3& x : grid.nodes) lowest = std::min(lowest, x[axis]);
    mistakes.require(lowest >= -1e-9 * extent, "the mesh reaches ", lowest, " m along axis ", axis,
                     ", beyond the symmetry plane at 0; mesh only the part at and above it");
  }
  mistakes.throw_if_any();
}

double interpolated(const PressureLoad& load, double time) {
  if (time <= load.time.front()) return load.pressure.front();
  if (time >= load.time.back()) return load.pressure.back();
  const std::size_t i = std::upper_bound(load.time.begin(), load.time.end(), time) - load.time.begin();
  const double share = (time - load.time[i - 1]) / (load.time[i] - load.time[i - 1]);
  return load.pressure[i - 1] + share * (load.pressure[i] - load.pressure[i - 1]);
}

/// The settings with the faces' own names where their numbers stand.
Settings with_names(Settings settings, const Grid& grid) {
  const auto rename = [&](std::string& face) { face = grid.face_names.meant_by(face); };
  for (Support& support : settings.supports) rename(support.face);
  for (PressureLoad& load : settings.loads) rename(load.face);
  for (std::string& face : settings.wet_faces) rename(face);
  return settings;
}

/// Every node's mass, handed on along the cells' edges in equal shares to those nearer to `nodes`: what arrives there.
std::vector<double> carried_by(const std::vector<int>& nodes, const Grid& grid, std::vector<double> mass) {
  if (nodes.empty()) return {};
  constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  std::vector<std::vector<int>> neighbours(grid.nodes.size());
  const auto join = [&](int a, int b) {
    std::vector<int>& known = neighbours[a];
    if (std::find(known.begin(), known.end(), b) == known.end()) known.push_back(b);
  };
  for (const auto& cell : grid.cells)
    for (const auto& [a, b] : edges) {
      join(cell[a], cell[b]);
      join(cell[b], cell[a]);
    }
  for (const HexahedralMesh::Tie& tie : grid.ties)
    for (const auto& [node, weight] : tie.to) {
      join(tie.node, node);
      join(node, tie.node);
    }
  // Nearest first, by the number of edges; then from the farthest back.
  std::vector<int> order = nodes, distance(grid.nodes.size(), -1);
  for (const int node : nodes) distance[node] = 0;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const int next : neighbours[order[k]])
      if (distance[next] < 0) {
        distance[next] = distance[order[k]] + 1;
        order.push_back(next);
      }
  for (std::size_t k = order.size(); k-- > nodes.size();) {
    const int node = order[k];
    const auto nearer = [&](int other) { return distance[other] < distance[node]; };
    const auto count = std::count_if(neighbours[node].begin(), neighbours[node].end(), nearer);
    for (const int other : neighbours[node])
      if (nearer(other)) mass[other] += mass[node] / double(count);
  }
  std::vector<double> carried;
  for (const int node : nodes) carried.push_back(mass[node]);
  return carried;
}

/// Nodal forces of a unit pressure on a bilinear face, exact: its normal is the cross product of the two tangents,
/// pointing into the structure, and 2x2 Gauss points integrate it times a shape function without error.
std::array<Vec3, 4> pressed(const std::array<Vec3, 4>& x) {
  const double near = 0.5 - 0.5 / std::sqrt(3.0);
  std::array<Vec3, 4> force;
  force.fill(Vec3::Zero());
  for (double v : {near, 1.0 - near})
    for (double u : {near, 1.0 - near}) {
      const Vec3 area = 0.25 * slope_along_u(x, v).cross(slope_along_v(x, u));
      const std::array<double, 4> weight = bilinear_weights(u, v);
      for (int node = 0; node < 4; ++node) force[node] += weight[node] * area;
    }
  return force;
}

/// The same of a segment's ring: its normal is one, and the node's shape function times the radius is integrated without error.
std::array<Vec3, 4> pressed_ring(const Vec3& a, const Vec3& b) {
  const Vec3 into = std::numbers::pi / 3.0 * Vec3(b[1] - a[1], a[0] - b[0], 0.0);
  return {(2.0 * a[0] + b[0]) * into, (a[0] + 2.0 * b[0]) * into, Vec3::Zero(), Vec3::Zero()};
}

std::string written(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ") m";
  return text.str();
}

}  // namespace

struct Structure::Implementation {
  Settings settings;
  Mesher mesher;
  const Grid& grid;
  ElementParts elements;
  std::vector<double> mass;  ///< [kg] of nodes; those tied have given theirs to what they are tied to

  // State, per node.
  std::vector<Vec3> position, velocity;
  double time = 0.0, last_step = 0.0;
  long steps = 0;
  double received_work = 0.0, load_work = 0.0, integrator_jumps = 0.0, integrator_held = 0.0, first_critical_step = 0.0;
  double impact_loss = 0.0;
  Vec3 plane_impulse = Vec3::Zero(), load_impulse = Vec3::Zero();

  // What follows from the state, and scratch, per node.
  std::vector<Vec3> acceleration, increment, internal_force, load_force, impulse_force, coming_velocity;
  std::vector<Vec3> inverse_mass;  ///< zero where a component is held

  PassTimers timers;

  WetSurface wet;
  std::vector<NamedFaces> wet_faces;
  std::vector<int> wet_nodes;
  std::vector<Vec3> wet_position, wet_velocity, wet_acceleration;
  std::vector<double> wet_mass;

  explicit Implementation(const Settings& given)
      : settings(given),
        mesher(settings),
        grid((settings = with_names(settings, mesher.grid()), check(settings, mesher.grid()), mesher.grid())),
        elements(settings, grid),
        mass(elements.nodal_mass()) {
    const std::size_t n = grid.nodes.size();
    position = grid.nodes;
    time = settings.start_time;
    inverse_mass.resize(n);
    for (const HexahedralMesh::Tie& tie : grid.ties) {
      for (const auto& [node, weight] : tie.to) mass[node] += weight * mass[tie.node];
      mass[tie.node] = 0.0;
    }
    for (std::size_t i = 0; i < n; ++i) inverse_mass[i].setConstant(mass[i] > 0.0 ? 1.0 / mass[i] : 0.0);
    double extent = 0.0;
    for (const Vec3& x : grid.nodes) extent = std::max(extent, x.cwiseAbs().maxCoeff());
    for (int axis : settings.symmetry_axes)
      for (std::size_t i = 0; i < n; ++i)
        if (std::abs(grid.nodes[i][axis]) <= 1e-9 * extent) inverse_mass[i][axis] = 0.0;
    if (settings.axisymmetric)
      for (std::size_t i = 0; i < n; ++i) {
        inverse_mass[i][2] = 0.0;
        if (grid.nodes[i][0] == 0.0) inverse_mass[i][0] = 0.0;
      }
    for (const Support& support : settings.supports)
      for (const auto& quad : grid.faces.at(support.face))
        for (int node : quad)
          for (int d = 0; d < 3; ++d)
            if (support.fixed[d]) inverse_mass[node][d] = 0.0;
    hold_with_tied();
    velocity.assign(n, settings.initial_velocity);
    if (settings.radial)
      for (std::size_t i = 0; i < n; ++i) velocity[i] += settings.radial->at(grid.nodes[i]);
    if (!settings.spin.isZero(0.0)) {
      Bounds box;
      for (const Vec3& x : grid.nodes) box.include(x);
      for (std::size_t i = 0; i < n; ++i) velocity[i] += settings.spin.cross(grid.nodes[i] - 0.5 * (box.low + box.high));
    }
    for (std::size_t i = 0; i < n; ++i)
      for (int d = 0; d < 3; ++d)
        if (inverse_mass[i][d] == 0.0) velocity[i][d] = 0.0;
    follow_ties(velocity);
    for (auto* field : {&acceleration, &increment, &internal_force, &load_force, &impulse_force, &coming_velocity})
      field->assign(n, Vec3::Zero());
    take_wet_surface();
    first_critical_step = elements.critical_step();
    find_load_force();
    find_acceleration();
    show_wet_motion();
  }

  void take_wet_surface() {
    std::vector<std::string> names = settings.wet_faces;
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::vector<int> number(grid.nodes.size(), -1);
    for (const std::string& name : names) {
      wet_faces.push_back({name, wet.faces.size(), wet.faces.size() + grid.faces.at(name).size()});
      for (const auto& quad : grid.faces.at(name)) {
        std::array<int, 4> face;
        for (int v = 0; v < 4; ++v) {
          int& wet_index = number[quad[v]];
          if (wet_index < 0) {
            wet_index = static_cast<int>(wet_nodes.size());
            wet_nodes.push_back(quad[v]);
            wet.nodes.push_back(grid.nodes[quad[v]]);
          }
          face[v] = wet_index;
        }
        wet.faces.push_back(face);
      }
    }
    for (auto* field : {&wet_position, &wet_velocity, &wet_acceleration}) field->resize(wet_nodes.size());
    wet_mass = carried_by(wet_nodes, grid, elements.nodal_mass());
  }

  /// What holds a tied node holds those that it is tied to.
  void hold_with_tied() {
    if (grid.ties.empty()) return;
    std::vector<char> is_tied(grid.nodes.size(), 0);
    for (const HexahedralMesh::Tie& tie : grid.ties) is_tied[tie.node] = 1;
    const auto hold = [&](int node, int d) {
      for (const HexahedralMesh::Tie& tie : grid.ties)
        if (tie.node == node)
          for (const auto& [to, weight] : tie.to)
            if (weight > 1e-9) inverse_mass[to][d] = 0.0;
    };
    for (const Support& support : settings.supports)
      for (const auto& quad : grid.faces.at(support.face))
        for (int node : quad)
          for (int d = 0; d < 3; ++d)
            if (support.fixed[d] && is_tied[node]) hold(node, d);
  }

  /// Of tied nodes the mean of those that they are tied to.
  void follow_ties(std::vector<Vec3>& field) const {
    for (const HexahedralMesh::Tie& tie : grid.ties) {
      Vec3 sum = Vec3::Zero();
      for (const auto& [node, weight] : tie.to) sum += weight * field[node];
      field[tie.node] = sum;
    }
  }

  void show_wet_motion() {
    for (std::size_t i = 0; i < wet_nodes.size(); ++i) {
      wet_position[i] = position[wet_nodes[i]];
      wet_velocity[i] = velocity[wet_nodes[i]];
      wet_acceleration[i] = acceleration[wet_nodes[i]];
    }
  }

  void find_load_force() {
    if (settings.loads.empty()) return;
    std::fill(load_force.begin(), load_force.end(), Vec3::Zero());
    for (const PressureLoad& load : settings.loads) {
      const double pressure = interpolated(load, time);
      for (const auto& quad : grid.faces.at(load.face)) {
        const auto force =
            is_segment(quad) ? pressed_ring(position[quad[0]], position[quad[1]]) : pressed(corners_of(quad, position));
        for (int v = 0; v < 4; ++v) load_force[quad[v]] += pressure * force[v];
      }
    }
  }

  void find_acceleration() {
    const long n = static_cast<long>(position.size());
#pragma omp parallel for schedule(static) if (position.size() > nodes_worth_threads)
    for (long i = 0; i < n; ++i)
      acceleration[i] =
          (load_force[i] + impulse_force[i] - internal_force[i] + mass[i] * settings.gravity).cwiseProduct(inverse_mass[i]);
    if (grid.ties.empty()) return;
    for (const HexahedralMesh::Tie& tie : grid.ties) {
      const Vec3 force = load_force[tie.node] + impulse_force[tie.node] - internal_force[tie.node];
      for (const auto& [node, weight] : tie.to) acceleration[node] += weight * force.cwiseProduct(inverse_mass[node]);
    }
    follow_ties(acceleration);
  }

  /// dt^2/8 m a.a, by which half the product of the neighbouring half-step velocities falls short of m v.v/2.
  double held_back(double dt) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < acceleration.size(); ++i) sum += mass[i] * acceleration[i].squaredNorm();
    return dt * dt / 8.0 * sum;
  }

  /// Impulse and work of the loads over half of a step of dt [s].
  void book_loads(double dt) {
    if (settings.loads.empty()) return;
    for (std::size_t i = 0; i < load_force.size(); ++i) {
      load_impulse += 0.5 * dt * load_force[i];
      load_work += 0.5 * load_force[i].dot(increment[i]);
    }
  }

  /// Nodes that would end the step of dt [s] beyond a rigid plane end it on the plane: a push, never a pull. A node that
  /// rests there receives its load back and no work; one that arrives loses the kinetic energy of its motion into the plane.
  void meet_planes(double dt) {
    for (const RigidPlane& plane : settings.planes)
      for (std::size_t i = 0; i < position.size(); ++i) {
        double& v = velocity[i][plane.axis];
        if (depth(plane, position[i] + dt * velocity[i]) <= 0.0 || inverse_mass[i][plane.axis] == 0.0) continue;
        const double allowed = (plane.position - position[i][plane.axis]) / dt;
        const double change = allowed - v;
        plane_impulse[plane.axis] += mass[i] * change;
        // Work of the push with the mean of the half-step velocities before and after it.
        impact_loss -= 0.5 * mass[i] * change * (v + allowed - dt * acceleration[i][plane.axis]);
        v = allowed;
      }
  }

  /// One step of central differences: kick, drift, new forces, kick. The two half kicks with their own forces make it
  /// exact for a step that varies: a(t) acts over half of either neighbouring step.
  void step(double dt) {
    const long n = static_cast<long>(position.size());
    integrator_jumps += held_back(dt) - integrator_held;
#pragma omp parallel for schedule(static) if (position.size() > nodes_worth_threads)
    for (long i = 0; i < n; ++i) velocity[i] += 0.5 * dt * acceleration[i];
    meet_planes(dt);
    follow_ties(velocity);
#pragma omp parallel for schedule(static) if (position.size() > nodes_worth_threads)
    for (long i = 0; i < n; ++i) {
      increment[i] = dt * velocity[i];
      position[i] += increment[i];
    }
    book_loads(dt);
    const long failed = elements.advance(position, increment, dt, internal_force);
    last_step = dt;
    if (failed >= 0) take_back_and_stop(failed, dt);
    time += dt;
    ++steps;
    find_load_force();
    book_loads(dt);
    for (int node : wet_nodes) received_work += impulse_force[node].dot(increment[node]);
    find_acceleration();
#pragma omp parallel for schedule(static) if (position.size() > nodes_worth_threads)
    for (long i = 0; i < n; ++i) velocity[i] += 0.5 * dt * acceleration[i];
    integrator_held = held_back(dt);
  }

  void visit_state(StateVisitor& state) {
    state("time", time);
    state("steps", steps);
    state("last step", last_step);
    state("received work", received_work);
    state("load work", load_work);
    state("load impulse", load_impulse);
    state("integrator jumps", integrator_jumps);
    state("integrator held", integrator_held);
    state("impact loss", impact_loss);
    state("plane impulse", plane_impulse);
    state("position", position);
    state("velocity", velocity);
    state("acceleration", acceleration);
    state("internal force", internal_force);
    state("load force", load_force);
    state("impulse force", impulse_force);
    state.part("elements", [&] { elements.visit_state(state); });
    state("timers", timers);
    if (state.restores()) show_wet_motion();
  }

  Vec3 center(std::size_t cell) const {
    Vec3 x = Vec3::Zero();
    for (int node : grid.cells[cell]) x += grid.nodes[node] / 8.0;
    return x;
  }

  std::string owner() const {
    const std::size_t cell = elements.critical_cell();
    return "cell " + std::to_string(cell) + " of '" + settings.name + "', reference position " + written(center(cell));
  }

  std::string description_of(std::size_t cell, const std::string& what) const {
    std::ostringstream text;
    text << "structure '" << settings.name << "', step " << steps << ", time " << time << " s: cell " << cell
         << ", reference position " << written(center(cell)) << ", now near " << written(position[grid.cells[cell][0]]) << ", "
         << what << "; the step of " << last_step << " s was set by " << owner() << "; refine the mesh there, or lower courant ("
         << settings.courant << ")";
    return text.str();
  }

  /// Nodes go back to where the step began; a cell that has turned inside out has kept its stresses of then.
  [[noreturn]] void take_back_and_stop(std::size_t cell, double dt) {
    const std::string what = description_of(cell, "inverted, or holds a value that is not finite");
    for (std::size_t i = 0; i < position.size(); ++i) {
      position[i] -= increment[i];
      velocity[i] -= 0.5 * dt * acceleration[i];
    }
    throw NumericalStop(what);
  }

  double stable_step() const { return settings.courant * elements.critical_step(); }

  /// Velocities [m/s] in the middle of a step of dt [s]: kicked, and met by rigid planes.
  void find_coming_velocity(double dt) {
    const long n = static_cast<long>(position.size());
#pragma omp parallel for schedule(static) if (position.size() > nodes_worth_threads)
    for (long i = 0; i < n; ++i) {
      coming_velocity[i] = velocity[i] + 0.5 * dt * acceleration[i];
      for (const RigidPlane& plane : settings.planes)
        if (depth(plane, position[i] + dt * coming_velocity[i]) > 0.0 && inverse_mass[i][plane.axis] != 0.0)
          coming_velocity[i][plane.axis] = (plane.position - position[i][plane.axis]) / dt;
    }
  }

  /// The stable step; or, where cells are about to close so much faster than they did (an impact, a load that jumps) that it
  /// would not be stable, the one that then is.
  double longest_step() {
    const double stable = stable_step();
    find_coming_velocity(stable);
    const double coming = elements.coming_step(position, coming_velocity);
    return coming < stable ? settings.courant * coming : stable;
  }

  void advance(double t_end, std::span<const Vec3> impulse) {
    const auto timer = timers.measure("structure");
    if (!impulse.empty() && impulse.size() != wet_nodes.size())
      throw std::invalid_argument("structure '" + settings.name + "': " + std::to_string(impulse.size()) + " impulses for " +
                                  std::to_string(wet_nodes.size()) + " wet nodes; give one per node of wet_surface(), or none");
    const double interval = t_end - time;
    if (!(interval > 0.0) || !std::isfinite(interval)) {
      std::ostringstream text;
      text << "structure '" << settings.name << "': cannot advance from " << time << " s to " << t_end << " s; give a later time";
      throw std::invalid_argument(text.str());
    }
    for (std::size_t i = 0; i < wet_nodes.size(); ++i)
      impulse_force[wet_nodes[i]] = impulse.empty() ? Vec3(Vec3::Zero()) : Vec3(impulse[i] / interval);
    find_acceleration();
    for (;;) {
      const double longest = longest_step();
      if (!(longest > 1e-4 * settings.courant * first_critical_step))
        throw NumericalStop(
            description_of(elements.critical_cell(), "is crushed: its stable step has fallen below 1e-4 of the first one"));
      const double left = t_end - time;
      const double count = std::max(1.0, std::ceil(left / longest * (1.0 - 1e-12)));
      step(left / count);
      if (count == 1.0) break;
    }
    time = t_end;
    show_wet_motion();
  }
};

Structure::Structure(const Settings& settings) : self_(std::make_unique<Implementation>(settings)) {}
Structure::~Structure() = default;
Structure::Structure(Structure&&) noexcept = default;
Structure& Structure::operator=(Structure&&) noexcept = default;

std::size_t Structure::cell_count() const { return self_->grid.cells.size(); }
std::size_t Structure::node_count() const { return self_->grid.nodes.size(); }
std::size_t Structure::memory_bytes() const {
  const std::size_t nodes = node_count(), wet = self_->wet_nodes.size();
  std::size_t bytes = self_->elements.memory_bytes() + 10 * nodes * sizeof(Vec3);
  bytes += cell_count() * (sizeof(std::array<int, 8>) + sizeof(std::array<double, 8>));
  return bytes + wet * (4 * sizeof(Vec3) + sizeof(int) + sizeof(double)) + self_->wet.faces.size() * sizeof(std::array<int, 4>);
}
double Structure::time() const { return self_->time; }
long Structure::steps() const { return self_->steps; }

const WetSurface& Structure::wet_surface() const { return self_->wet; }
std::vector<NamedFaces> Structure::wet_faces() const { return self_->wet_faces; }
std::span<const Vec3> Structure::wet_positions() const { return self_->wet_position; }
std::span<const Vec3> Structure::wet_velocities() const { return self_->wet_velocity; }
std::span<const Vec3> Structure::wet_accelerations() const { return self_->wet_acceleration; }
std::span<const double> Structure::wet_masses() const { return self_->wet_mass; }

double Structure::stable_step() const { return self_->stable_step(); }
std::string Structure::stable_step_owner() const { return self_->owner(); }
void Structure::advance(double t_end, std::span<const Vec3> impulse) { self_->advance(t_end, impulse); }

void Structure::visit_state(StateVisitor& state) { self_->visit_state(state); }

BodyLedger Structure::ledger() const {
  BodyLedger ledger;
  const auto& mass = self_->mass;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const Vec3 &x = self_->position[i], &v = self_->velocity[i];
    ledger.mass += mass[i];
    ledger.kinetic += 0.5 * mass[i] * v.squaredNorm();
    ledger.gravity += mass[i] * self_->settings.gravity.dot(x - self_->grid.nodes[i]);
    ledger.momentum += mass[i] * v;
    ledger.angular_momentum += mass[i] * x.cross(v);
  }
  ledger.integrator = self_->integrator_jumps - self_->integrator_held;
  ledger.elastic = self_->elements.elastic_energy();
  ledger.plastic = self_->elements.plastic_work();
  ledger.viscous = self_->elements.viscous_work();
  ledger.received = self_->received_work;
  ledger.external = self_->load_work;
  ledger.impulse = self_->load_impulse + self_->plane_impulse;
  ledger.impact = self_->impact_loss;
  return ledger;
}

Vec3 Structure::plane_impulse() const { return self_->plane_impulse; }
std::span<const Vec3> Structure::positions() const { return self_->position; }
std::span<const double> Structure::masses() const { return self_->mass; }
BodySize Structure::size() const { return {.cells = cell_count(), .nodes = node_count()}; }
const PassTimers& Structure::timers() const { return self_->timers; }

std::string Structure::description() const {
  char counts[200];
  std::snprintf(counts, sizeof counts, "  %zu cells, %zu nodes, %.6g kg, stable step %.4g us\n", cell_count(), node_count(),
                ledger().mass, stable_step() * 1e6);
  return "structure " + self_->settings.name + " of " + self_->elements.materials() + "\n" + counts;
}

namespace {

double von_mises(const Mat3& stress) {
  const Mat3 deviator = stress - stress.trace() / 3.0 * Mat3::Identity();
  return std::sqrt(1.5 * deviator.squaredNorm());
}

std::vector<double> as_numbers(std::span<const Vec3> vectors) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& vector : vectors) numbers.insert(numbers.end(), vector.data(), vector.data() + 3);
  return numbers;
}

}  // namespace

std::vector<LargestOf> Structure::largest() const {
  const auto& position = self_->position;
  const auto& velocity = self_->velocity;
  Largest speed;
  for (std::uint32_t i = 0; i < velocity.size(); ++i) speed.take(velocity[i].squaredNorm(), i, [&] { return position[i]; });
  speed.value = std::sqrt(std::max(0.0, speed.value));
  LargestOf found{"structure", {{"speed", speed}}};
  const auto look = [&](const char* quantity, std::span<const double> (ElementSet::*values_of)() const) {
    Largest most;
    bool any = false;
    self_->elements.for_each_set([&](const ElementSet& set, auto cell_of) {
      const std::span<const double> values = (set.*values_of)();
      if (values.empty()) return;
      any = true;
      const std::size_t cells = set.cell_count(), stride = values.size() / cells;
      const auto points = std::size_t(set.points_per_cell());
      for (std::size_t c = 0; c < cells; ++c)
        for (std::size_t q = 0; q < points; ++q)
          if (const double value = values[c * stride + q]; value > most.value)
            most.take(value, std::uint32_t(cell_of(c)), [] { return Vec3(); });
    });
    if (!any) return;
    most.place.setZero();
    for (const int node : self_->grid.cells[most.owner]) most.place += 0.125 * position[node];
    found.quantities.push_back({quantity, most});
  };
  look("plastic_strain", &ElementSet::plastic_strains);
  look("damage", &ElementSet::damages);
  look("temperature", &ElementSet::temperatures);
  return {found};
}

BodySnapshot Structure::snapshot(std::span<const std::string>) const {
  const ElementParts& elements = self_->elements;
  const auto means = [&](auto of) {
    std::vector<double> values(cell_count(), 0.0);
    for (std::size_t c = 0; c < cell_count(); ++c)
      for (int q = 0; q < elements.points_per_cell(); ++q) values[c] += elements.mean_share(q) * of(c, q);
    return values;
  };
  std::vector<Vec3> displacement(node_count());
  for (std::size_t i = 0; i < node_count(); ++i) displacement[i] = self_->position[i] - self_->grid.nodes[i];
  std::vector<double> pressure(cell_count());
  for (std::size_t c = 0; c < cell_count(); ++c) pressure[c] = elements.pressure(c);
  BodySnapshot snapshot;
  snapshot.position = self_->position;
  snapshot.cells = self_->grid.cells;
  snapshot.of_points = {{"displacement", 3, as_numbers(displacement)}, {"velocity", 3, as_numbers(self_->velocity)}};
  snapshot.of_cells = {{"pressure", 1, std::move(pressure)},
                       {"von_mises", 1, means([&](std::size_t c, int q) { return von_mises(elements.stress(c, q)); })},
                       {"plastic_strain", 1, means([&](std::size_t c, int q) { return elements.plastic_strain(c, q); })},
                       {"temperature", 1, means([&](std::size_t c, int q) { return elements.temperature(c, q); })}};
  return snapshot;
}

BodyPoint Structure::locate(const Vec3& reference_position) const {
  const auto inside = self_->mesher.containing_cell(reference_position);
  const Place place = inside ? *inside : nearest_place(self_->grid, reference_position);
  BodyPoint point;
  point.distance = place.distance;
  const auto shape = shape_values(place.unit);
  for (int i = 0; i < 8; ++i)
    point.motion.push_back({.carrier = std::uint32_t(self_->grid.cells.at(place.cell)[i]), .weight = shape[i]});
  const std::vector<double> shares = self_->elements.shares_at(place.unit);
  const int points = self_->elements.points_per_cell();
  for (int q = 0; q < points; ++q)
    point.state.push_back({.carrier = std::uint32_t(place.cell * points + q), .weight = shares[q]});
  return point;
}

MaterialPoint Structure::read(const BodyPoint& point) const {
  MaterialPoint values;
  for (const auto& [node, weight, image] : point.motion) {
    values.position += weight * self_->position[node];
    values.velocity += weight * self_->velocity[node];
    values.acceleration += weight * self_->acceleration[node];
    values.displacement += weight * (self_->position[node] - self_->grid.nodes[node]);
  }
  const int points = self_->elements.points_per_cell();
  for (const auto& [carrier, weight, image] : point.state) {
    const std::size_t cell = carrier / points;
    const int q = int(carrier % points);
    values.stress += weight * self_->elements.stress(cell, q);
    values.plastic_strain += weight * self_->elements.plastic_strain(cell, q);
    values.temperature += weight * self_->elements.temperature(cell, q);
  }
  return values;
}

}  // namespace undex::fem
