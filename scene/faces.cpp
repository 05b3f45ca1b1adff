#include "scene/faces.hpp"

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

std::vector<std::string> structure_faces(const fem::Mesh& mesh) {
  if (std::holds_alternative<fem::TubeMesh>(mesh)) return {"inner", "outer", "low", "high"};
  if (std::holds_alternative<fem::PlateMesh>(mesh)) return box_faces(3);
  return {};
}

}  // namespace undex::scene
