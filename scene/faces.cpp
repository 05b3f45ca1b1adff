#include "scene/faces.hpp"

#include <algorithm>

namespace undex::scene {
namespace {

std::vector<std::string> box_faces(int dimension) {
  std::vector<std::string> names;
  for (int a = 0; a < dimension; ++a)
    for (const char* end : {"_low", "_high"}) names.push_back(std::string(1, "xyz"[a]) + end);
  return names;
}

}  // namespace

std::vector<std::string> wall_faces(const Primitive& container, int dimension) {
  if (const auto* cylinder = std::get_if<Cylinder>(&container)) {
    std::vector<std::string> names;
    if (dimension > 1 || cylinder->axis != 0) names.push_back("side");
    if (cylinder->axis < dimension) names.insert(names.end(), {"low", "high"});
    return names;
  }
  return box_faces(dimension);
}

std::vector<std::string> structure_faces(const fem::Mesh& mesh, const std::vector<int>& symmetry_axes) {
  const auto is_cut = [&](int axis, double low) {
    return low < 0 && std::find(symmetry_axes.begin(), symmetry_axes.end(), axis) != symmetry_axes.end();
  };
  std::vector<std::string> faces;
  if (const auto* tube = std::get_if<fem::TubeMesh>(&mesh)) {
    faces = {"inner", "outer", "high"};
    if (!is_cut(tube->axis, tube->low)) faces.push_back("low");
  } else if (const auto* rod = std::get_if<fem::RodMesh>(&mesh)) {
    faces = {"side", "high"};
    if (!is_cut(rod->axis, rod->low)) faces.push_back("low");
  } else if (const auto* plate = std::get_if<fem::PlateMesh>(&mesh)) {
    faces = box_faces(3);
    for (int a = 0; a < 3; ++a)
      if (is_cut(a, plate->low[a])) std::erase(faces, std::string(1, "xyz"[a]) + "_low");
  }
  return faces;
}

}  // namespace undex::scene
