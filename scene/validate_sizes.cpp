// Sizes that do not go together: a mesh in millimetres, walls far beyond the water, more particles than can be counted.
#include "scene/revolution.hpp"
#include "scene/validator.hpp"

namespace undex::scene {
namespace {

/// Of extents: what is longer than that by the other is a mistake of units.
constexpr double most_times = 100;
/// Particles are numbered in 32 bits; a lattice of more points than this takes minutes to walk through.
constexpr double most_particles = 2e9, most_walked = 1e10;

double box_volume(const Bounds& box, int dimension) {
  double product = 1;
  for (int a = 0; a < dimension; ++a) product *= std::max(0.0, box.high[a] - box.low[a]);
  return product;
}

}  // namespace

void Validator::sizes() {
  Bounds all;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (usable_[i]) {
      const Bounds extent = bounds(*parts_[i].shape, dimension_);
      all.include(extent.low);
      all.include(extent.high);
    }
  const double of_bodies = parts_.empty() || all.empty() ? 0.0 : longest(all, dimension_);
  if (dimension_ == 3)
    for (const Structure& each : structures_) size_of(each, of_bodies);
  if (of_bodies > 0) size_of_walls(of_bodies);
  counts();
}

void Validator::size_of(const Structure& one, double of_bodies) {
  if (!one.shape) return;
  const Node& node = *one.node;
  const double size = longest(one.shape->extent(), 3);
  const auto* gmsh = std::get_if<fem::GmshMesh>(&one.settings->mesh);
  const std::string remedy = gmsh && gmsh->scale == 1 ? "Then write scale = 1e-3" : "Lengths are in m";
  if (of_bodies > 0 && size > most_times * of_bodies)
    complain(node, "shape",
             one.path + ".shape is " + rounded(size) + " m long, " + rounded(std::round(size / of_bodies)) +
                 " times as long as all bodies together (" + rounded(of_bodies) + " m): is the mesh in millimetres? " + remedy);
  else if (of_bodies > 0 && draft_.spacing_good && size < fluid_.lattice.spacing)
    complain(node, "shape",
             one.path + ".shape is " + rounded(size) + " m long, less than the spacing " + rounded(fluid_.lattice.spacing) +
                 " m of the water: is it in other units than m? Else make the spacing smaller");
  else if (of_bodies == 0 && size > 200)
    warn(node, "shape", one.path + ".shape is " + rounded(size) + " m long: is the mesh in millimetres? " + remedy);
}

void Validator::size_of_walls(double of_bodies) {
  const Scene solved = for_solvers(scene_);
  for (std::size_t w = 0; w < fluid_.walls.size(); ++w) {
    if (!draft_.wall_shape_good[w]) continue;
    const sph::Wall& wall = fluid_.walls[w];
    const Bounds extent = bounds(wall.container, dimension_);
    const double size = longest(extent, dimension_);
    if (size > most_times * of_bodies)
      complain(*draft_.wall_nodes[w], "shape",
               "walls." + wall.name + " is " + rounded(size) + " m long, " + rounded(std::round(size / of_bodies)) +
                   " times as long as all bodies together (" + rounded(of_bodies) +
                   " m): is it in millimetres? Make it end where the water may get to, or open the faces that nothing reaches");
    else if (draft_.spacing_good) {
      const int dimension = solved.fluid.dimension;
      const Bounds walked = common(kept_part(solved.fluid.symmetry.axis), bounds(solved.fluid.walls[w].container, dimension));
      const double points = box_volume(walked, dimension) / std::pow(fluid_.lattice.spacing, dimension);
      if (points > most_walked)
        complain(*draft_.wall_nodes[w], "shape",
                 "walls." + wall.name + " holds " + rounded(points) + " points of the lattice, more than " +
                     rounded(most_walked) + "; take a larger spacing or a smaller wall");
    }
  }
}

void Validator::counts() {
  const Scene solved = for_solvers(scene_);
  const int dimension = solved.fluid.dimension;
  const Bounds kept = kept_part(solved.fluid.symmetry.axis);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& one = parts_[i];
    if (!usable_[i] || !(draft_.spacing_good || one.spacing)) continue;
    const Shape& shape = is_fluid(i) ? solved.fluid.bodies[i].shape : solved.solids.bodies[i - fluid_.bodies.size()].shape;
    const double spacing = one.spacing.value_or(fluid_.lattice.spacing), cell = std::pow(spacing, dimension);
    const Bounds window = common(kept, bounds(shape, dimension));
    if (box_volume(window, dimension) / most_particles < cell) continue;
    const double particles = volume(shape, window, dimension) / cell;
    if (particles < most_particles) continue;
    const Node* resolution = draft_.root.find("resolution");
    complain(one.spacing || !resolution ? *one.node : *resolution, "spacing",
             one.path() + " would get " + rounded(particles) + " particles of spacing " + rounded(spacing) + " m, more than " +
                 rounded(most_particles) + "; take a larger spacing: " +
                 rounded(std::pow(volume(shape, window, dimension) / most_particles, 1.0 / dimension)) + " m at least" +
                 in_millimetres(one.shape->base, 0));
  }
}

}  // namespace undex::scene
