#include "sph_fluid/walls/face_copies.hpp"

#include <algorithm>
#include <cmath>

namespace undex::sph {

std::vector<FaceCopy> copies_of(const std::array<Vec3, 4>& corner, const SlipFaces& faces, const Settings& settings,
                                double reach) {
  std::vector<FaceCopy> copies{{corner, false}};
  const auto mirror_all = [&](auto image) {
    for (std::size_t k = 0, count = copies.size(); k < count; ++k)
      if (std::array<Vec3, 4> x = copies[k].corner; image(x)) {
        std::swap(x[1], x[3]);
        copies.push_back({x, !copies[k].turned});
      }
  };
  const double flat = 1e-9 * settings.lattice.spacing;
  const auto in_plane = [&](int axis, double at) {
    mirror_all([&](std::array<Vec3, 4>& x) {
      double nearest = 1e300, farthest = 0;
      for (Vec3& c : x) {
        nearest = std::min(nearest, std::abs(c[axis] - at));
        farthest = std::max(farthest, std::abs(c[axis] - at));
        c[axis] = 2.0 * at - c[axis];
      }
      return nearest <= reach && farthest >= flat;
    });
  };
  for (const SlipFaces::Round& wall : faces.round)
    mirror_all([&](std::array<Vec3, 4>& x) {
      for (Vec3& c : x) {
        const auto image = image_in(wall, c, 2.0 * reach, settings.dimension);
        if (!image) return false;
        c = image->place;
      }
      return true;
    });
  for (const SlipFaces::Pair& pair : faces.plane) {
    if (pair.low > -1e299 && !pair.symmetric) in_plane(pair.axis, pair.low);
    if (pair.high < 1e299) in_plane(pair.axis, pair.high);
  }
  for (int a = 0; a < 3; ++a)
    if (settings.symmetry.axis[a]) in_plane(a, 0.0);
  return copies;
}

}  // namespace undex::sph
