#include "sph_fluid/lattice.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "sph_fluid/lattice_grid.hpp"
#include "sph_fluid/pairs/kernels.hpp"

namespace undex::sph {
namespace {

Bounds kept_window(const Settings& settings, Bounds box) {
  for (int a = 0; a < 3; ++a)
    if (settings.symmetry.axis[a]) box.low[a] = std::max(box.low[a], 0.0);
  return box;
}

}  // namespace

double lattice_factor(KernelName kernel, double eta, int dimension) {
  return with_kernel(kernel, [&](auto k) { return lattice_factor<decltype(k)>(eta, dimension); });
}

double kernel_value(KernelName kernel, double r, double h, int dimension) {
  return with_kernel(kernel, [&](auto k) { return value<decltype(k)>(r, h, dimension); });
}

double kernel_support(KernelName kernel) {
  return with_kernel(kernel, [](auto k) { return k.support; });
}

double smoothing_length(const Settings& settings, double spacing) { return settings.numerics.eta * spacing; }

namespace {

/// The points of a grid in a box that `inside` holds, with the volumes of their cells (axisymmetric: rings).
BodyParticles points_inside(const Grid& grid, const Settings& settings, const Bounds& box,
                            const std::function<bool(const Vec3&)>& inside, const std::string& who) {
  BodyParticles out;
  walk(grid, settings, box, [&](const Vec3& x, double cell_volume) {
    if (!inside(x)) return;
    out.position.push_back(x);
    out.volume.push_back(settings.axisymmetric ? 2.0 * std::numbers::pi * x[0] * cell_volume : cell_volume);
  });
  if (out.position.empty())
    throw std::invalid_argument(who + " gets no particle: it is smaller than the spacing or lies outside the kept part");
  return out;
}

}  // namespace

BodyParticles fill(const Grid& grid, const Settings& settings, const Shape& shape, const std::string& who) {
  const Bounds box = bounds(shape, settings.dimension);
  const double near = 1e-3 * settings.lattice.spacing;
  const auto inside = [&](const Vec3& x) { return signed_distance(shape, x, settings.dimension, near) < 0.0; };
  BodyParticles out = points_inside(grid, settings, box, inside, who);
  double sum = 0;
  for (const double cell_volume : out.volume) sum += cell_volume;
  const Bounds kept = kept_window(settings, box);
  out.scale = (settings.axisymmetric ? volume_of_revolution(shape, kept) : volume(shape, kept, settings.dimension)) / sum;
  for (double& cell_volume : out.volume) cell_volume *= out.scale;
  return out;
}

std::vector<BodyParticles> fill_bodies(const Settings& settings) {
  std::vector<BodyParticles> result;
  for (const Body& body : settings.bodies) {
    const Grid grid = body_grid(settings, body);
    const std::string who = "body '" + body.name + "'";
    if (body.start && !body.start->laid.position.empty()) {
      const LaidParticles& laid = body.start->laid;
      BodyParticles& out = result.emplace_back(BodyParticles{.position = laid.position, .volume = laid.mass});
      for (std::size_t k = 0; k < laid.density.size(); ++k) out.volume[k] /= laid.density[k];
    } else if (body.start && body.start->covers)
      result.push_back(points_inside(grid, settings, body.start->box, body.start->covers, who));
    else result.push_back(fill(grid, settings, body.shape, who));
  }
  return result;
}

}  // namespace undex::sph
