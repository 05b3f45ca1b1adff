#include "run/describe.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "output/terminal.hpp"
#include "output/text_table.hpp"
#include "run/picture.hpp"
#include "run/simulation.hpp"
#include "run/room.hpp"
#include "run/stages.hpp"
#include "run/starts.hpp"
#include "scene/revolution.hpp"
#include "core/shapes.hpp"

namespace undex::run {
namespace {

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, arguments);
  va_end(arguments);
  return buffer;
}

std::string duration(double seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 100) return format("about %.0f s", seconds);
  if (seconds < 6000) return format("about %.0f min", seconds / 60);
  return format("about %.1f h", seconds / 3600);
}

const char* const unit[3] = {"m", "m^2", "m^3"};  // of a volume, by dimension

std::string bodies(const scene::Scene& scene, const sph::Fluid& fluid) {
  const int dimension = scene.fluid.dimension;
  const std::vector<std::size_t> count = fluid.particles_by_body();
  std::string text;
  for (std::size_t i = 0; i < count.size(); ++i) {
    const sph::Body& body = scene.fluid.bodies[i];
    text += format("  %-16s %10zu particles  %.6g %s of %s\n", body.name.c_str(), count[i], scene::kept_volume(body.shape, scene),
                   unit[dimension - 1], body.material.name.c_str());
  }
  return text + format("  %-16s %10zu particles\n", "walls", fluid.wall_particle_count());
}

std::string layers(const scene::Scene& scene, const LineFlow& flow) {
  std::string text;
  const std::vector<std::size_t> count = flow.cells_by_layer();
  for (std::size_t k = 0; k < count.size(); ++k) {
    const scene::LineLayer& layer = flow.line().layers[k];
    const std::string& name = layer.is_solid ? scene.solids.bodies[layer.index].name : scene.fluid.bodies[layer.index].name;
    const std::string& material =
        layer.is_solid ? scene.solids.bodies[layer.index].material.name : scene.fluid.bodies[layer.index].material.name;
    text += format("  %-16s %10zu cells      %.6g to %.6g m of %s\n", name.c_str(), count[k], layer.inner, layer.outer,
                   material.c_str());
  }
  const auto end = [&](int which) {
    if (flow.line().radiating[which]) return "radiating, waves leave through it";
    return flow.line().closed[which] ? (which == 0 && flow.line().inner() == 0 ? "the middle or a plane of symmetry" : "rigid")
                                     : "free, nothing beyond it";
  };
  return text + format("  inner end: %s; outer end: %s\n", end(0), end(1));
}

/// What the temperature of solids does not know.
std::string temperature_notes(const scene::Scene& scene) {
  std::string text;
  const auto note = [&](const std::string& name, const materials::Solid& solid) {
    if (!materials::gruneisen(solid.pressure))
      text += format(
          "note: '%s': the pressure law of %s has no energy; its temperature is that of plastic work, without the heat of "
          "shocks and compression\n",
          name.c_str(), solid.name.c_str());
  };
  for (const fem::Settings& structure : scene.structures) {
    note(structure.name, structure.material);
    for (const fem::Part& part : structure.parts)
      if (part.material) note(structure.name + "', part '" + part.group, *part.material);
  }
  for (const solid::Body& body : scene.solids.bodies) note(body.name, body.material);
  return text;
}

/// A scene in space may be one of revolution.
std::string revolution_note(const scene::Scene& scene) {
  if (scene.meridian || on_a_line(scene.geometry) || scene.fluid.dimension != 3) return "";
  const int axis = scene::likeliest_axis(scene);
  if (!scene::objections(scene, scene::line_along(scene, axis)).empty()) return "";
  return format(
      "note: all of it is of revolution about an axis along %c: -P dimension=axisymmetric computes it in its meridian, at "
      "a fraction of the cost\n",
      "xyz"[axis]);
}

}  // namespace

std::string describe(const scene::Scene& given, std::string* drawing) {
  scene::Scene scene = given;
  using Clock = std::chrono::steady_clock;
  std::string planes;
  for (int a = 0; a < 3; ++a)
    if (scene.fluid.symmetry.axis[a]) planes += std::string(planes.empty() ? "" : ", ") + "xyz"[a];
  const std::string space = on_a_line(scene.geometry) ? word_of(scene.geometry)
                            : scene.meridian
                                ? format("axisymmetric about an axis along %c", "xyz"[scene.axis])
                                : format("%d dimension%s", scene.fluid.dimension, scene.fluid.dimension == 1 ? "" : "s");
  std::string text = format("%s: %s\n%s, symmetry planes: %s, to %.6g us\n", scene.name.c_str(), scene.title.c_str(),
                            space.c_str(), planes.empty() ? "none" : planes.c_str(), scene.end_time * 1e6);
  const Vec3& g = scene.fluid.gravity;
  if (!g.isZero()) text += format("gravity: (%.6g, %.6g, %.6g) m/s^2\n", g[0], g[1], g[2]);
  if (const double p = scene.fluid.surroundings.pressure; p > 0) text += format("surroundings: %.6g Pa\n", p);

  text += expect_room(scene) + "\n";
  const auto before = Clock::now();
  if (const std::string report = begin(scene); !report.empty()) text += start_words(scene.start.kind) + ": " + report + "\n";
  Simulation simulation(scene);
  const double for_start = std::chrono::duration<double>(Clock::now() - before).count();
  if (drawing) *drawing = picture(scene, simulation);
  double memory = 0;
  if (const sph::Fluid* fluid = simulation.fluid()) {
    text += format("fluid, spacing %.6g m\n", scene.fluid.lattice.spacing) + bodies(scene, *fluid);
    memory += double(fluid->memory_bytes());
  }
  if (const LineFlow* line = simulation.line()) {
    text += format("one-dimensional mesh, cells of %.6g m in the core\n", scene.fluid.lattice.spacing) + layers(scene, *line);
    memory += double(line->memory_bytes());
  }
  for (const auto& body : simulation.bodies()) {
    text += body->description();
    memory += double(body->memory_bytes());
  }

  for (const coupling::RigidObstacle& obstacle : simulation.obstacles()) text += obstacle.description();

  text += temperature_notes(scene);
  text += revolution_note(scene);
  for (const std::string& warning : warnings_of(scene, std::filesystem::path("out") / scene.name))
    text += "warning: " + warning + "\n";

  // A few steps, for a second at most; the quickest counts, as other programs may be running too.
  const auto begin = Clock::now();
  double pace = 0;  // simulated seconds per second
  for (int taken = 0; taken < 10 && simulation.time() < scene.end_time * (1 - 1e-12); ++taken) {
    const auto start = Clock::now();
    const double from = simulation.time();
    if (taken > 1 && start - begin > std::chrono::seconds(1)) break;
    simulation.advance(scene.end_time);
    pace = std::max(pace, (simulation.time() - from) / std::chrono::duration<double>(Clock::now() - start).count());
  }
  const double step = simulation.last_step_size();
  const double left = scene.end_time - scene.fluid.start_time;
  const double steps = std::ceil(left / step);
  text += format("expected step %.4g us (%s), %.0f steps\n", step * 1e6, simulation.last_step().c_str(), steps);
  text += format("memory about %.0f MB\n", std::ceil(memory / 1e6));
  text += format("run time %s with %d threads, by the first steps%s; fields and histories not counted\n",
                 duration(left / pace + for_start).c_str(), omp_get_max_threads(),
                 for_start > 0.1 ? format(" and %.2g s for the start", for_start).c_str() : "");
  return text;
}

std::string cost_text(const output::RunRecord& record) {
  std::string text = "\n";
  text += output::inked(record.scene + ": " + record.status, output::Ink::bold);
  text += format(" at %s after %s steps, in %s (%s of CPU time, %.0f MB of memory)\n",
                 output::with_unit(record.time_s, "s").c_str(), output::grouped(record.steps).c_str(),
                 short_time(record.wall_time_s).c_str(), short_time(record.cpu_time_s).c_str(), record.peak_memory_bytes / 1e6);
  if (record.particles > 0)
    text += format("%s particles, %.3g million particle updates, %.3g million a second and core\n",
                   output::grouped(record.particles).c_str(), record.particle_updates * 1e-6,
                   record.particle_updates / std::max(record.cpu_time_s, 1e-9) * 1e-6);
  text += "\n";
  return text;
}

std::string largest_text(const output::RunRecord& record) {
  if (record.largest.empty()) return "";
  std::vector<std::vector<std::string>> lines;
  for (const output::LargestRecord& each : record.largest) {
    const char* unit = each.quantity == "pressure" ? "Pa" : each.quantity == "speed" ? "m/s" : "";
    std::string value = *unit ? output::with_unit(each.value, unit) : format("%.4g", each.value);
    if (each.quantity == "temperature") value += " K";
    std::string place;
    for (const double x : each.place) place += (place.empty() ? "at (" : ", ") + format("%.4g", 1e3 * x);
    std::string quantity = each.quantity;
    std::replace(quantity.begin(), quantity.end(), '_', ' ');
    lines.push_back({"  " + quantity, each.part, value, "after " + output::with_unit(each.time_s, "s"), place + ") mm"});
  }
  std::string text = "\n";
  text += output::inked("Largest values", output::Ink::bold);
  return text + "\n" + output::aligned(lines, 5);
}

}  // namespace undex::run
