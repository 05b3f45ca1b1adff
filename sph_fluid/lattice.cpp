#include "sph_fluid/lattice.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/walls/wall_images.hpp"

namespace undex::sph {
namespace {

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

namespace {

using Visit = std::function<void(const Vec3& x, double volume)>;

/// A number in [-0.5, 0.5) from a seed: the same wherever and however often a run is repeated.
double noise(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t z = seed * 3 + stream + 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return double((z ^ (z >> 31)) >> 11) * 0x1.0p-53 - 0.5;
}

const Primitive& shape_to_fit(const Settings& settings) {
  for (const Body& body : settings.bodies)
    if (body.name == settings.lattice.fit) return body.shape.base;
  for (const Wall& wall : settings.walls)
    if (wall.name == settings.lattice.fit) return wall.container;
  throw std::invalid_argument("resolution.fit names '" + settings.lattice.fit + "', which is neither a body nor a wall");
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
  }
  return grid;
}

/// That of the scene, or a body's own.
Grid body_grid(const Settings& settings, const Body& body) {
  if (!body.spacing) return scene_grid(settings);
  Grid grid = cartesian(settings.lattice.origin, *body.spacing, settings.dimension);
  fit_grid(grid, body.shape.base, *body.spacing, settings.symmetry);
  return grid;
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

/// Visits every lattice point in `box` (or just outside) on the kept side of the symmetry planes.
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
        x[u] = grid.origin[u] + r * std::cos(angle);
        x[v] = grid.origin[v] + r * std::sin(angle);
        if (grid.dimension == 3) x[grid.axis] = along(grid.axis, k);
        offer(x, volume, cell);
      }
    }
}

Bounds kept_window(const Settings& settings, Bounds box) {
  for (int a = 0; a < 3; ++a)
    if (settings.symmetry.axis[a]) box.low[a] = std::max(box.low[a], 0.0);
  return box;
}

/// Which faces of the container the point lies beyond, and the outward normal there.
struct Beyond {
  std::vector<std::string> faces;
  Vec3 normal = Vec3::Zero();  // behind an edge, the edge's direction
  double distance = 0;
};

Beyond beyond(const Primitive& container, const Vec3& x, int dimension) {
  static const char* const low_name[3] = {"x_low", "y_low", "z_low"};
  static const char* const high_name[3] = {"x_high", "y_high", "z_high"};
  Beyond result;
  Vec3 away = Vec3::Zero();
  if (const auto* box = std::get_if<Box>(&container)) {
    for (int a = 0; a < dimension; ++a) {
      if (x[a] < box->low[a]) {
        result.faces.push_back(low_name[a]);
        away[a] = x[a] - box->low[a];
      }
      if (x[a] > box->high[a]) {
        result.faces.push_back(high_name[a]);
        away[a] = x[a] - box->high[a];
      }
    }
  } else if (const auto* cylinder = std::get_if<Cylinder>(&container)) {
    Vec3 radial = x - cylinder->center;
    radial[cylinder->axis] = 0.0;
    if (dimension < 3) radial[2] = 0.0;
    const double r = radial.norm();
    if (r > cylinder->radius) {
      result.faces.push_back("side");
      away += radial * ((r - cylinder->radius) / r);
    }
    if (dimension == 3) {
      const double z = x[cylinder->axis];
      if (z < cylinder->low) {
        result.faces.push_back("low");
        away[cylinder->axis] = z - cylinder->low;
      }
      if (z > cylinder->high) {
        result.faces.push_back("high");
        away[cylinder->axis] = z - cylinder->high;
      }
    }
  } else {
    throw std::invalid_argument("a wall must be a box or a cylinder");
  }
  result.distance = away.norm();
  const int faces = int(result.faces.size());
  if (faces == 1 && result.distance > 0) result.normal = away / result.distance;
  if (faces == 2 && dimension == 3) {
    Vec3 first = Vec3::Zero(), second = Vec3::Zero();
    if (std::holds_alternative<Box>(container)) {
      for (int a = 0; a < 3; ++a)
        if (away[a] != 0.0) (first.isZero() ? first : second)[a] = 1.0;
    } else {
      const int axis = std::get<Cylinder>(container).axis;
      first[axis] = 1.0;
      second = away - away.dot(first) * first;
    }
    result.normal = first.cross(second).normalized();
  }
  return result;
}

}  // namespace

double lattice_factor(KernelName kernel, double eta, int dimension) {
  return with_kernel(kernel, [&](auto k) { return lattice_factor<decltype(k)>(eta, dimension); });
}

double kernel_support(KernelName kernel) {
  return with_kernel(kernel, [](auto k) { return k.support; });
}

double smoothing_length(const Settings& settings, double spacing) { return settings.numerics.eta * spacing; }

BodyParticles fill(const Grid& grid, const Settings& settings, const Shape& shape, const std::string& who) {
  const Bounds box = bounds(shape, settings.dimension);
  BodyParticles out;
  double sum = 0;
  walk(grid, settings, box, [&](const Vec3& x, double cell_volume) {
    if (signed_distance(shape, x, settings.dimension) >= 0.0) return;
    out.position.push_back(x);
    out.volume.push_back(cell_volume);
    sum += cell_volume;
  });
  if (out.position.empty())
    throw std::invalid_argument(who + " gets no particle: it is smaller than the spacing or lies outside the kept part");
  const double scale = volume(shape, kept_window(settings, box), settings.dimension) / sum;
  for (double& cell_volume : out.volume) cell_volume *= scale;
  return out;
}

std::vector<BodyParticles> fill_bodies(const Settings& settings) {
  std::vector<BodyParticles> result;
  for (const Body& body : settings.bodies)
    result.push_back(fill(body_grid(settings, body), settings, body.shape, "body '" + body.name + "'"));
  return result;
}

std::vector<std::string> lattice_warnings(const Settings& settings) {
  std::vector<std::string> warnings;
  for (const Body& body : settings.bodies) {
    const Grid grid = body_grid(settings, body);
    const Bounds box = bounds(body.shape, settings.dimension);
    for (int a = 0; a < settings.dimension; ++a) {
      if (!settings.symmetry.axis[a] || box.low[a] > 2.0 * grid.step[a]) continue;
      // Rings meet a plane as their images do where it holds their axis or is a face of their layers.
      const bool across = grid.rings && a != grid.axis;
      const double unit = across ? grid.ring_width : grid.step[a], faces = grid.origin[a] / unit;
      const double off = across ? std::abs(faces) : std::abs(faces - std::round(faces));
      const bool turned = (grid.turn.row(a).cwiseAbs().maxCoeff() < 1.0 - 1e-9);
      if (off < 1e-6 && !turned) continue;
      char how[100] = "is turned against";
      if (!turned) std::snprintf(how, sizeof how, "has no cell face on (the nearest is %.2g spacings off)", off);
      warnings.push_back(
          "the lattice of body '" + body.name + "' " + how + " the symmetry plane " + "xyz"[a] +
          " = 0: particles there are not half a spacing from it, and their pressure is off; " +
          (turned ? "leave out resolution.rotation or the plane"
                  : "choose resolution.origin a multiple of the spacing, or resolution.fit something that the plane halves"));
    }
  }
  const SlipFaces faces = slip_faces(settings);
  if (faces.plane.empty() && faces.round.empty()) return warnings;
  const Grid grid = scene_grid(settings);
  const auto off = [](double place, double unit) { return std::abs(place / unit - std::round(place / unit)); };
  char text[300];
  for (const SlipFaces::Pair& pair : faces.plane) {
    const int a = pair.axis;
    const bool across = (grid.rings && a != grid.axis) || grid.turn.row(a).cwiseAbs().maxCoeff() < 1.0 - 1e-9;
    for (const double face : {pair.symmetric ? -1e300 : pair.low, pair.high}) {
      const double miss = across ? 0.5 : off(face - grid.origin[a], grid.step[a]);
      if (std::abs(face) > 1e299 || miss < 1e-6) continue;
      std::snprintf(
          text, sizeof text,
          "the lattice has no cell face on the slip wall %c = %g m (the nearest is %.2g spacings off): particles and their "
          "images leave a gap there or overlap, and pressure is off; name the wall, or a body that it encloses, in "
          "resolution.fit",
          "xyz"[a], face, miss);
      warnings.push_back(text);
    }
  }
  for (const Cylinder& wall : faces.round) {
    if (grid.rings && grid.axis == wall.axis && off(wall.radius, grid.ring_width) < 1e-6) continue;
    std::snprintf(text, sizeof text,
                  "the lattice meets the round slip wall of radius %g m in steps, and pressure beside it is off; choose "
                  "resolution.lattice = \"rings\", with the wall or a body that fills it in resolution.fit",
                  wall.radius);
    warnings.push_back(text);
  }
  return warnings;
}

std::vector<MovingWall> line_walls(const Settings& settings) {
  std::vector<MovingWall> result(2);
  result[0].free_slip = true;
  result[1].free_slip = false;
  if (settings.walls.empty()) return {};
  const Grid grid = scene_grid(settings);
  const double dx = settings.lattice.spacing;
  const double depth = std::max(3.0 * dx, kernel_support(settings.numerics.kernel) * smoothing_length(settings, dx));
  for (const Wall& wall : settings.walls) {
    Bounds box = bounds(wall.container, settings.dimension);
    box.low.array() -= depth;
    box.high.array() += depth;
    walk(grid, settings, box, [&](const Vec3& x, double cell_volume) {
      const Beyond place = beyond(wall.container, x, settings.dimension);
      if (place.faces.empty() || place.distance >= depth) return;
      FaceCondition condition = FaceCondition::free_slip;
      for (const std::string& face : place.faces) {
        const auto found = wall.faces.find(face);
        const FaceCondition here = found == wall.faces.end() ? FaceCondition::free_slip : found->second;
        if (here == FaceCondition::open) return;
        if (here == FaceCondition::no_slip) condition = here;
      }
      if (condition == FaceCondition::free_slip && mirrors_fluid(settings.numerics.scheme)) return;
      MovingWall& out = result[condition == FaceCondition::no_slip ? 1 : 0];
      out.position.push_back(x);
      out.normal.push_back(place.normal);
      // In two dimensions an edge is a corner: nothing slips along it.
      out.faces.push_back(place.faces.size() == 2 && settings.dimension == 2 ? 3 : int(place.faces.size()));
      out.volume.push_back(cell_volume);
    });
  }
  for (MovingWall& wall : result) {
    wall.velocity.assign(wall.position.size(), Vec3::Zero());
    wall.impulse.assign(wall.position.size(), Vec3::Zero());
  }
  std::erase_if(result, [](const MovingWall& wall) { return wall.position.empty(); });
  return result;
}

}  // namespace undex::sph
