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
  if (const auto* cone = std::get_if<Cone>(&container); cone && cone->axis < dimension) return {"side", "low", "high"};
  if (std::holds_alternative<Sphere>(container)) return {"side"};
  return box_faces(dimension);
}

bool is_round(const Primitive& shape, int dimension) {
  const auto* cylinder = std::get_if<Cylinder>(&shape);
  const auto* tube = std::get_if<TubeShape>(&shape);
  return (cylinder || tube) && (dimension == 3 || (dimension == 2 && (cylinder ? cylinder->axis : tube->axis) == 2));
}

std::vector<std::string> shape_faces(const Primitive& shape, int dimension, const std::array<bool, 3>& symmetric) {
  if (std::holds_alternative<Sphere>(shape) || has_one_face(shape)) return {"side"};
  const auto is_cut = [&](int axis, double low) { return low < 0 && symmetric[axis]; };
  std::vector<std::string> faces;
  const auto ends = [&](int axis, double low) {
    if (axis >= dimension) return;
    faces.push_back("high");
    if (!is_cut(axis, low)) faces.push_back("low");
  };
  if (const auto* tube = std::get_if<TubeShape>(&shape)) {
    faces = {"inner", "outer"};
    ends(tube->axis, tube->low);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    faces = {"side"};
    ends(cylinder->axis, cylinder->low);
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    faces = {"side"};
    ends(cone->axis, cone->low);
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    faces = box_faces(dimension);
    for (int a = 0; a < dimension; ++a)
      if (is_cut(a, box->low[a])) std::erase(faces, std::string(1, "xyz"[a]) + "_low");
  }
  return faces;
}

}  // namespace undex::scene
