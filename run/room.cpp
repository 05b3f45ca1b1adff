#include "run/room.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "core/errors.hpp"
#include "core/shapes.hpp"
#include "scene/line.hpp"
#include "scene/revolution.hpp"
#include "sph_fluid/lattice.hpp"
#include "sph_fluid/walls/lattice_warnings.hpp"

namespace undex::run {
namespace {

constexpr double bytes_of_line_cell = 400;
// As `undex check` finds them once all is laid out (docs/results/performance.md), neighbours and transient copies counted.
constexpr double bytes_of_particle = 260, bytes_of_wall_particle = 110, bytes_of_cell = 3000;
constexpr double bytes_of_lagrangian[4] = {0, 700, 1800, 2800}, bytes_of_updated = 700;  // of a solid's particle, by dimension

std::string gigabytes(double bytes) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g GB", bytes * 1e-9);
  return text;
}

Bounds kept_part(const sph::Settings& fluid, Bounds box) {
  for (int a = 0; a < 3; ++a)
    if (fluid.symmetry.axis[a]) box.low[a] = std::max(box.low[a], 0.0);
  return box;
}

double particles_in(const Shape& shape, double spacing, const sph::Settings& fluid) {
  const Bounds window = kept_part(fluid, bounds(shape, fluid.dimension));
  return volume(shape, window, fluid.dimension) / std::pow(spacing, fluid.dimension);
}

/// Layers behind the faces that line a container; but for the paper's scheme free-slip faces are mirrored and need none.
double particles_lining(const sph::Wall& wall, const sph::Settings& fluid) {
  const bool lined = std::any_of(wall.faces.begin(), wall.faces.end(), [&](const auto& face) {
    return face.second == sph::FaceCondition::no_slip ||
           (face.second == sph::FaceCondition::free_slip && fluid.numerics.scheme == sph::SchemeName::paper);
  });
  if (!lined) return 0;
  const double dx = fluid.lattice.spacing;
  const double depth = std::max(3.0 * dx, sph::kernel_support(fluid.numerics.kernel) * sph::smoothing_length(fluid, dx));
  const auto size = [&](double beyond) {
    Bounds box = bounds(wall.container, fluid.dimension);
    box.low.array() -= beyond;
    box.high.array() += beyond;
    box = kept_part(fluid, box);
    double product = 1;
    for (int a = 0; a < fluid.dimension; ++a) product *= box.high[a] - box.low[a];
    return product;
  };
  return (size(depth) - size(0)) / std::pow(dx, fluid.dimension);
}

double cells_of(const fem::Settings& structure) {
  double share = 1;
  const auto cut = [&](int axis, double low) {
    if (low < 0 &&
        std::find(structure.symmetry_axes.begin(), structure.symmetry_axes.end(), axis) != structure.symmetry_axes.end())
      share *= 0.5;
  };
  if (structure.axisymmetric) {
    const auto cells = [&](const auto& mesh, double across) {
      cut(1, mesh.low);
      return share * across * mesh.cells_along;
    };
    if (const auto* tube = std::get_if<fem::TubeMesh>(&structure.mesh)) return cells(*tube, tube->cells_through);
    if (const auto* rod = std::get_if<fem::RodMesh>(&structure.mesh)) return cells(*rod, rod->cells_radial);
  }
  if (const auto* gmsh = std::get_if<fem::GmshMesh>(&structure.mesh)) return gmsh->read ? double(gmsh->read->cells.size()) : 0.0;
  std::visit(
      [&](const auto& mesh) {
        if constexpr (requires { shape_of(mesh); }) {
          const Bounds box = bounds(Primitive(shape_of(mesh)), 3);
          for (int a = 0; a < 3; ++a) cut(a, box.low[a]);
        }
      },
      structure.mesh);
  if (const auto* tube = std::get_if<fem::TubeMesh>(&structure.mesh))
    return share * tube->cells_through * double(tube->cells_around) * tube->cells_along;
  if (const auto* plate = std::get_if<fem::PlateMesh>(&structure.mesh))
    return share * plate->cells[0] * double(plate->cells[1]) * plate->cells[2];
  if (const auto* rod = std::get_if<fem::RodMesh>(&structure.mesh)) {
    const double core = (rod->cells_radial + 1) / 2, ring = rod->cells_radial - core;
    return share * 4 * (core * core + 2 * core * ring) * rod->cells_along;
  }
  return 0;
}

/// A number of bytes in a file, or nothing ("max", no file).
double number_in(const char* file, const std::string& after = "") {
  std::ifstream stream(file);
  std::string word;
  if (!after.empty())
    while (stream >> word && word != after) {
    }
  double value = 0;
  return stream >> value ? value : std::numeric_limits<double>::infinity();
}

double available_memory() { return 1024 * number_in("/proc/meminfo", "MemAvailable:"); }

double count_of(const std::vector<std::string>& fields) {
  double numbers = 0;
  for (const std::string& field : fields) numbers += field == "velocity" || field == "displacement" ? 3 : 1;
  return numbers;
}

}  // namespace

Room room_of(const scene::Scene& given) {
  const scene::Scene scene = scene::for_solvers(given);
  Room room;
  const sph::Settings& fluid = scene.fluid;
  if (on_a_line(scene.geometry)) {
    const scene::Line line = scene::line_of(scene);
    const double first = line.cell_width(line.inner(), fluid.lattice.spacing);
    room.line_cells = (line.outer() - line.inner()) / first;  // more than there are, where they grow
    room.bytes = bytes_of_line_cell * room.line_cells;
    return room;
  }
  for (const sph::Body& body : fluid.bodies)
    room.particles += particles_in(body.shape, body.spacing.value_or(fluid.lattice.spacing), fluid);
  for (const sph::Wall& wall : fluid.walls) room.wall_particles += particles_lining(wall, fluid);
  for (const solid::Body& body : scene.solids.bodies) {
    const double particles = particles_in(body.shape, body.spacing.value_or(fluid.lattice.spacing), fluid);
    room.solid_particles += particles;
    room.bytes += particles * (body.description == solid::Description::total_lagrangian ? bytes_of_lagrangian[fluid.dimension]
                                                                                        : bytes_of_updated);
  }
  for (const fem::Settings& structure : scene.structures) room.cells += cells_of(structure);
  room.bytes += bytes_of_particle * room.particles + bytes_of_wall_particle * room.wall_particles + bytes_of_cell * room.cells;
  return room;
}

double memory_limit() {
  double limit = 1024 * number_in("/proc/meminfo", "MemTotal:");
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
    limit = std::min(limit, number_in(file));
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit of{};
    if (getrlimit(resource, &of) == 0 && of.rlim_cur != RLIM_INFINITY) limit = std::min(limit, double(of.rlim_cur));
  }
  return limit;
}

std::string expect_room(const scene::Scene& scene) {
  const Room room = room_of(scene);
  const double limit = memory_limit();
  char text[400];
  if (room.line_cells > 0)
    std::snprintf(text, sizeof text, "at most %.4g cells on a line need about %s of memory", room.line_cells,
                  gigabytes(room.bytes).c_str());
  else
    std::snprintf(text, sizeof text,
                  "%.4g particles of fluid, %.4g of solids, %.4g of walls and %.4g cells need about %s of memory", room.particles,
                  room.solid_particles, room.wall_particles, room.cells, gigabytes(room.bytes).c_str());
  const std::string words = text + std::string("; this machine has ") + gigabytes(limit);
  if (room.bytes <= limit) return words;
  if (bytes_of_cell * room.cells > 0.5 * room.bytes) {
    const std::vector<fem::Settings> all = scene::for_solvers(scene).structures;
    const auto largest =
        std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return cells_of(a) < cells_of(b); });
    throw SceneError(scene.file.string(),
                     {scene.places.finding(scene.path_of(*largest) + ".cells", words + "; take fewer or larger cells")});
  }
  const double larger =
      scene.fluid.lattice.spacing * std::pow(room.bytes / limit, 1.0 / (scene.meridian ? 2 : scene.fluid.dimension));
  std::snprintf(text, sizeof text, "; take a spacing of %.2g m or more, symmetry planes, or smaller bodies", larger);
  throw SceneError(scene.file.string(), {scene.places.finding("resolution.spacing", words + text)});
}

double bytes_on_disk(const scene::Scene& scene) {
  const scene::Output& output = scene.output;
  const Room room = room_of(scene);
  double snapshots = double(output.field_times.size());
  if (output.field_interval > 0) snapshots += scene.end_time / output.field_interval;
  double each = (room.particles + room.line_cells) * (8 * count_of(output.particle_fields) + 32);
  each += room.solid_particles * (8 * count_of(output.solid_fields) + 32);
  if (output.structure_fields) each += room.cells * 250;
  double columns = 14;  // of energy.csv
  for (const scene::Probe& probe : scene.probes) columns += 1 + 2 * double(probe.quantities.size());
  if (output.wants("bodies")) columns += 9 * double(scene.fluid.bodies.size());
  const double rows = output.history_interval > 0 ? scene.end_time / output.history_interval : 0.0;  // every step: not known yet
  double numbers = rows * columns;
  for (const scene::ProfileLine& line : scene.lines) {
    const double profiles = double(line.times.size()) + (line.interval > 0 ? scene.end_time / line.interval : 0.0);
    numbers += profiles * line.points * (5.0 + 2.0 * double(line.quantities.size()));
  }
  return snapshots * each + numbers * 13;
}

std::vector<std::string> warnings_of(const scene::Scene& scene, const std::filesystem::path& output) {
  std::vector<std::string> warnings = scene.warnings;
  const double memory = room_of(scene).bytes, available = available_memory();
  if (memory > available)
    warnings.push_back("the run needs about " + gigabytes(memory) + " of memory, and " + gigabytes(available) +
                       " are free now: it will be slow or end for want of it");
  std::error_code error;
  std::filesystem::path folder = std::filesystem::absolute(output, error);
  while (!std::filesystem::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  const double written = bytes_on_disk(scene), free = double(std::filesystem::space(folder, error).available);
  if (!error && written > free)
    warnings.push_back("snapshots and histories take about " + gigabytes(written) + ", and " + gigabytes(free) + " are free at " +
                       folder.string() + "; take longer intervals (output.field_interval, output.history_interval)");
  if (on_a_line(scene.geometry)) return warnings;
  const std::vector<std::string> lattice = sph::lattice_warnings(scene::for_solvers(scene).fluid);
  warnings.insert(warnings.end(), lattice.begin(), lattice.end());
  return warnings;
}

}  // namespace undex::run
