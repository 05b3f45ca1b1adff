#include "sph_fluid/lattice_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace undex::sph {
namespace {

/// A number in [-0.5, 0.5) from a seed: the same wherever and however often a run is repeated.
double noise(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t z = seed * 3 + stream + 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return double((z ^ (z >> 31)) >> 11) * 0x1.0p-53 - 0.5;
}

/// Cuts low..high into whole steps of about dx. Symmetric bounds get a cell face at zero, and so does a symmetry plane that cuts
/// them.
void fit_axis(double low, double high, double dx, bool mirrored, double& origin, double& step) {
  if (std::abs(low + high) <= 1e-12 * (high - low) || (mirrored && low < 0.0 && high > 0.0)) {
    origin = 0.0;
    step = high / std::max(1.0, std::round(high / dx));
  } else {
    origin = low;
    step = (high - low) / std::max(1.0, std::round((high - low) / dx));
  }
}

const Primitive& shape_to_fit(const Settings& settings) {
  for (const Body& body : settings.bodies)
    if (body.name == settings.lattice.fit) return body.shape.base;
  for (const Wall& wall : settings.walls)
    if (wall.name == settings.lattice.fit) return wall.container;
  throw std::invalid_argument("resolution.fit names '" + settings.lattice.fit + "', which is neither a body nor a wall");
}

/// A box, in the axes of a turned lattice, that holds the given one.
Bounds turned_back(const Grid& grid, const Bounds& box) {
  if (grid.turn.isIdentity(0.0)) return box;
  Vec3 middle = Vec3::Zero(), half = Vec3::Zero();
  for (int a = 0; a < grid.dimension; ++a) {
    middle[a] = 0.5 * (box.low[a] + box.high[a]) - grid.origin[a];
    half[a] = 0.5 * (box.high[a] - box.low[a]);
  }
  middle = grid.origin + grid.turn.transpose() * middle;
  half = grid.turn.transpose().cwiseAbs() * half;
  return {middle - half, middle + half};
}

}  // namespace

long ring_count(double radius, double width) { return 4 * std::max(1l, std::lround(0.5 * std::numbers::pi * radius / width)); }

Grid cartesian(const Vec3& origin, double dx, int dimension) {
  Grid grid;
  grid.dimension = dimension;
  grid.origin = origin;
  grid.step = Vec3::Constant(dx);
  return grid;
}

void fit_grid(Grid& grid, const Primitive& shape, double dx, const Symmetry& symmetry) {
  const Bounds box = bounds(shape, grid.dimension);
  for (int a = 0; a < grid.dimension; ++a)
    if (box.low[a] > -1e299 && box.high[a] < 1e299)
      fit_axis(box.low[a], box.high[a], dx, symmetry.axis[a], grid.origin[a], grid.step[a]);
}

Grid scene_grid(const Settings& settings) {
  const Lattice& lattice = settings.lattice;
  Grid grid = cartesian(lattice.origin, lattice.spacing, settings.dimension);
  if (const double angle = lattice.rotation.norm(); angle > 0.0)
    grid.turn = Eigen::AngleAxisd(angle * std::numbers::pi / 180.0, lattice.rotation / angle).toRotationMatrix();
  if (!lattice.fit.empty()) fit_grid(grid, shape_to_fit(settings), lattice.spacing, settings.symmetry);
  if (lattice.type == LatticeType::rings) {
    double radius = 0;
    const Primitive& shape = lattice.fit.empty() ? settings.bodies.at(0).shape.base : shape_to_fit(settings);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
      radius = cylinder->radius;
      grid.axis = cylinder->axis;
      for (int a = 0; a < 3; ++a)
        if (a != grid.axis) grid.origin[a] = cylinder->center[a];
    } else if (const auto* tube = std::get_if<TubeShape>(&shape)) {
      radius = tube->outer;
      grid.axis = tube->axis;
      for (int a = 0; a < 3; ++a)
        if (a != grid.axis) grid.origin[a] = tube->center[a];
    } else {
      throw std::invalid_argument(
          "resolution.lattice = \"rings\" needs resolution.fit to name a body or wall that is a cylinder or a tube");
    }
    if (settings.dimension < 2 || (settings.dimension == 2 && grid.axis != 2))
      throw std::invalid_argument("resolution.lattice = \"rings\" needs three dimensions, or two with the axis along z");
    grid.rings = true;
    grid.ring_width = radius / std::max(1.0, std::round(radius / lattice.spacing));
    if (lattice.settle) grid.section = std::make_shared<RingSection>(settings, radius, grid.ring_width, grid.step[grid.axis]);
  }
  return grid;
}

Grid body_grid(const Settings& settings, const Body& body) {
  if (!body.spacing) return scene_grid(settings);
  Grid grid = cartesian(settings.lattice.origin, *body.spacing, settings.dimension);
  fit_grid(grid, body.shape.base, *body.spacing, settings.symmetry);
  return grid;
}

void walk(const Grid& grid, const Settings& settings, Bounds box, const Visit& visit) {
  for (int a = 0; a < 3; ++a)
    if (settings.symmetry.axis[a]) box.low[a] = std::max(box.low[a], 0.0);
  const auto kept = [&](const Vec3& x) {
    for (int a = 0; a < 3; ++a)
      if (settings.symmetry.axis[a] && x[a] <= 0.0) return false;
    return true;
  };
  const double jitter = settings.lattice.jitter;
  const auto offer = [&](Vec3 x, double volume, const Vec3& cell) {
    if (!kept(x)) return;
    if (jitter > 0) {
      // The lattice point itself seeds its jitter: every body that asks for the point moves it alike.
      std::uint64_t seed = 0;
      for (int a = 0; a < grid.dimension; ++a)
        seed = seed * 1000003u + std::uint64_t(std::llround(x[a] / grid.step[a] * 64.0) + (1ll << 40));
      for (int a = 0; a < grid.dimension; ++a) x[a] += jitter * cell[a] * noise(seed, a);
    }
    visit(x, volume);
  };
  box = turned_back(grid, box);
  long first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
  for (int a = 0; a < grid.dimension; ++a) {
    first[a] = long(std::floor((box.low[a] - grid.origin[a]) / grid.step[a]));
    last[a] = long(std::ceil((box.high[a] - grid.origin[a]) / grid.step[a]));
  }
  const auto along = [&](int a, long k) { return a < grid.dimension ? grid.origin[a] + (k + 0.5) * grid.step[a] : 0.0; };
  if (!grid.rings) {
    const bool turned = !grid.turn.isIdentity(0.0);
    double volume = 1.0;
    for (int a = 0; a < grid.dimension; ++a) volume *= grid.step[a];
    for (long k = first[2]; k <= last[2]; ++k)
      for (long j = first[1]; j <= last[1]; ++j)
        for (long i = first[0]; i <= last[0]; ++i) {
          const Vec3 x(along(0, i), along(1, j), along(2, k));
          offer(turned ? Vec3(grid.origin + grid.turn * (x - grid.origin)) : x, volume, grid.step);
        }
    return;
  }
  const int u = (grid.axis + 1) % 3, v = (grid.axis + 2) % 3;
  double reach = 0;
  for (const double a : {box.low[u] - grid.origin[u], box.high[u] - grid.origin[u]})
    for (const double b : {box.low[v] - grid.origin[v], box.high[v] - grid.origin[v]}) reach = std::max(reach, std::hypot(a, b));
  const double width = grid.ring_width;
  const double length = grid.dimension == 3 ? grid.step[grid.axis] : 1.0;
  const Vec3 cell = Vec3::Constant(width);
  for (long k = first[grid.axis]; k <= last[grid.axis]; ++k)
    for (long ring = 0; grid.ring_start + (ring - 1) * width <= reach; ++ring) {
      const double r = grid.ring_start + (ring + 0.5) * width;
      const long around = grid.around > 0 ? grid.around : ring_count(r, width);
      const double volume = 2.0 * std::numbers::pi * r * width * length / around;
      for (long q = 0; q < around; ++q) {
        const double angle = 2.0 * std::numbers::pi * (q + 0.5) / around;
        Vec3 x = Vec3::Zero();
        const Eigen::Vector2d in_section =
            grid.section ? grid.section->point(ring, q) : Eigen::Vector2d(r * std::cos(angle), r * std::sin(angle));
        x[u] = grid.origin[u] + in_section[0];
        x[v] = grid.origin[v] + in_section[1];
        if (grid.dimension == 3) x[grid.axis] = along(grid.axis, k);
        offer(x, volume, cell);
      }
    }
}

}  // namespace undex::sph
