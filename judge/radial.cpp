#include "judge/radial.hpp"

#include <algorithm>

namespace undex::judge {

Vec3 Axis::outward(const Vec3& point) const {
  Vec3 radius = point - center;
  radius[direction] = 0;
  const double length = radius.norm();
  return length > 0 ? Vec3(radius / length) : Vec3(Vec3::Zero());
}

output::Series radial(const std::array<output::Series, 3>& components, const Vec3& outward) {
  output::Series sum;
  for (int a = 0; a < 3; ++a) {
    const output::Series& part = components[a];
    if (part.empty()) continue;
    if (sum.empty()) sum = {part.t, std::vector<double>(part.y.size(), 0.0)};
    sum.t.resize(std::min(sum.t.size(), part.t.size()));
    sum.y.resize(sum.t.size());
    for (std::size_t k = 0; k < sum.y.size(); ++k) sum.y[k] += outward[a] * part.y[k];
  }
  return sum;
}

}  // namespace undex::judge
