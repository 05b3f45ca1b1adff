#include "sph_solid/first_column.hpp"

#include <cmath>

#include "sph_fluid/pairs/kernels.hpp"

namespace undex::solid {

FirstColumn first_column(double eta) {
  using Kernel = sph::WendlandC2;
  const int reach = int(Kernel::support * eta);
  const auto slope = [&](int m) {  // of all pairs of two columns, m apart
    double sum = 0;
    for (int z = -reach; z <= reach; ++z) sum -= sph::gradient_factor<Kernel>(std::hypot(m, z), eta, 2);
    return sum;
  };
  const auto ring = [](double R, int m) { return std::abs(R + 0.5 * m); };
  const auto over_columns = [&](auto of) {
    double sum = 0;
    for (int m = -reach; m <= reach; ++m)
      if (m != 0) sum += of(m);
    return sum;
  };
  const auto moment = [&](double R) { return over_columns([&](int m) { return ring(R, m) / R * slope(m) * m * m; }); };
  const double own = moment(0.5);
  return {
      .inward = over_columns([&](int m) { return (1.0 / own + 1.0 / moment(std::abs(0.5 + m))) * ring(0.5, m) * slope(m) * m; }),
      .own = over_columns([&](int m) { return 1.0 / own * ring(0.5, m) * slope(m) * m; })};
}

}  // namespace undex::solid
