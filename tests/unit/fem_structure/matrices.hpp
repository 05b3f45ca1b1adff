// Stiffness and masses of a set of elements as matrices, and what linear algebra makes of them. (Decompositions are compiled
// once, in matrices.cpp: they are slow to compile.)
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fem_structure/element_set.hpp"
#include "fem_structure/grid.hpp"

namespace undex::fem::testing {

/// Eigenvalues of a symmetric matrix, increasing.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

struct Matrices {
  std::vector<std::array<int, 2>> of;  ///< node and component of each row
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd mass;

  using Held = std::function<bool(const Vec3& node, int component)>;
  /// Of the first `components` components of all nodes, but for those held.
  Matrices(const ElementSet& elements, const Grid& grid, int components = 3, const Held& held = {});

  /// Squares of the frequencies, increasing.
  Eigen::VectorXd squares() const;
  double highest_frequency() const;
  /// Displacements under a load, both by rows.
  Eigen::VectorXd solve(const Eigen::VectorXd& load) const;
};

}  // namespace undex::fem::testing
