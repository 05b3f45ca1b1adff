// Meshes of the scene's radiating faces: quadrangles of about two spacings; segments in two dimensions and in a meridian.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sph_fluid/settings.hpp"
#include "sph_fluid/walls/moving_walls.hpp"

namespace undex::sph {

/// Layers of one spacing before a face, by whose pressures images behind it know theirs.
inline constexpr int seen_depths = 5;

/// A radiating face of a container as a wall that moves.
struct RadiatingMesh {
  std::string name;  ///< in words
  std::optional<Vec3> source;
  MirrorWall wall;
  std::vector<Vec3> normal;  ///< at the nodes, of unit length, away from the fluid: along them nodes move
};

/// A node that faces share: at an edge two, at a corner three.
struct SharedNode {
  struct Place {
    int face, node;
  };
  std::vector<Place> places;
};

struct RadiatingMeshes {
  std::vector<RadiatingMesh> faces;
  std::vector<SharedNode> shared;
};

/// Throws std::invalid_argument, naming the wall, on a container whose faces have no mesh.
RadiatingMeshes radiating_meshes(const Settings& settings);

/// Why no face of the container can radiate in a scene of that dimension; empty: it can.
std::string why_not_radiating(const Primitive& container, int dimension);

}  // namespace undex::sph
