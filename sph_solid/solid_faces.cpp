#include "sph_solid/solid_faces.hpp"

#include <algorithm>
#include <cmath>

namespace undex::solid {
namespace {

struct Named {
  std::string name;
  double depth;  // of the point behind the face [m]
};

std::vector<Named> faces_at(const Primitive& shape, const Vec3& x, int dimension) {
  static const char* const low_name[3] = {"x_low", "y_low", "z_low"};
  static const char* const high_name[3] = {"x_high", "y_high", "z_high"};
  std::vector<Named> faces;
  const auto ends = [&](int axis, double low, double high, const char* low_face, const char* high_face) {
    if (axis >= dimension) return;
    if (low > -1e200) faces.push_back({low_face, x[axis] - low});
    if (high < 1e200) faces.push_back({high_face, high - x[axis]});
  };
  const auto radial = [&](int axis, const Vec3& center) {
    Vec3 r = x - center;
    r[axis] = 0.0;
    if (dimension < 3) r[2] = 0.0;
    return r;
  };
  if (const auto* box = std::get_if<Box>(&shape)) {
    for (int a = 0; a < dimension; ++a) ends(a, box->low[a], box->high[a], low_name[a], high_name[a]);
  } else if (const auto* slab = std::get_if<Slab>(&shape)) {
    ends(slab->axis, slab->low, slab->high, low_name[slab->axis], high_name[slab->axis]);
  } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    Vec3 r = x - sphere->center;
    for (int a = dimension; a < 3; ++a) r[a] = 0.0;
    faces.push_back({"side", sphere->radius - r.norm()});
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    const Vec3 r = radial(cylinder->axis, cylinder->center);
    faces.push_back({"side", cylinder->radius - r.norm()});
    ends(cylinder->axis, cylinder->low, cylinder->high, "low", "high");
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    const Vec3 r = radial(cone->axis, cone->center);
    const double slope = (cone->high_radius - cone->low_radius) / (cone->high - cone->low), cosine = 1.0 / std::hypot(1.0, slope);
    faces.push_back({"side", (cone->radius_at(x[cone->axis]) - r.norm()) * cosine});
    ends(cone->axis, cone->low, cone->high, "low", "high");
  } else if (const auto* tube = std::get_if<TubeShape>(&shape)) {
    const Vec3 r = radial(tube->axis, tube->center);
    faces.push_back({"inner", r.norm() - tube->inner});
    faces.push_back({"outer", tube->outer - r.norm()});
    ends(tube->axis, tube->low, tube->high, "low", "high");
  } else {
    faces.push_back({"side", -signed_distance(shape, x, dimension)});
  }
  return faces;
}

}  // namespace

std::vector<std::string> solid_faces(const Primitive& shape, int dimension) {
  std::vector<std::string> names;
  for (const Named& named : faces_at(shape, Vec3::Ones(), dimension)) names.push_back(named.name);
  return names;
}

bool is_wet(const Body& body, const Vec3& x, int dimension) {
  const std::vector<Named> faces = faces_at(body.shape.base, x, dimension);
  const auto nearest =
      std::min_element(faces.begin(), faces.end(), [](const Named& a, const Named& b) { return a.depth < b.depth; });
  return body.wet.empty() || std::find(body.wet.begin(), body.wet.end(), nearest->name) != body.wet.end();
}

bool is_near_face(const Body& body, const std::string& face, const Vec3& x, double depth, int dimension) {
  const std::vector<Named> faces = faces_at(body.shape.base, x, dimension);
  return std::any_of(faces.begin(), faces.end(), [&](const Named& each) { return each.name == face && each.depth < depth; });
}

}  // namespace undex::solid
