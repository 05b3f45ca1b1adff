#include "sph_fluid/walls/lattice_warnings.hpp"

#include <cmath>
#include <cstdio>

#include "sph_fluid/lattice_grid.hpp"
#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::sph {
namespace {

void warn_of_planes(const Settings& settings, std::vector<std::string>& warnings) {
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
}

void warn_of_slip_walls(const Settings& settings, std::vector<std::string>& warnings) {
  const SlipFaces faces = slip_faces(settings);
  if (faces.empty()) return;
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
  for (const SlipFaces::Round& wall : faces.round) {
    if (grid.rings && grid.axis == wall.axis && off(wall.radius, grid.ring_width) < 1e-6) continue;
    if (wall.sine != 0.0) {
      std::snprintf(
          text, sizeof text,
          "the lattice meets the slip side of the cone of radius %g m at its low end in steps, and pressure beside it is off",
          wall.radius);
      warnings.push_back(text);
      continue;
    }
    std::snprintf(text, sizeof text,
                  "the lattice meets the round slip wall of radius %g m in steps, and pressure beside it is off%s", wall.radius,
                  wall.axis < 0 ? ""
                                : "; choose resolution.lattice = \"rings\", with the wall or a body that fills it in "
                                  "resolution.fit");
    warnings.push_back(text);
  }
}

}  // namespace

std::vector<std::string> lattice_warnings(const Settings& settings) {
  if (settings.lattice.settle) return {};
  std::vector<std::string> warnings;
  warn_of_planes(settings, warnings);
  warn_of_slip_walls(settings, warnings);
  return warnings;
}

}  // namespace undex::sph
