// Sums over lists of vectors, as the iterations towards rest need them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/vector.hpp"

namespace undex {

/// The scalar product of two lists of one length.
inline double product(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
  return sum;
}

/// to += factor * more; lists of one length.
inline void add(std::vector<Vec3>& to, double factor, const std::vector<Vec3>& more) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += factor * more[k];
}

}  // namespace undex
