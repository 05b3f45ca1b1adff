#include "matrices.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace undex::fem::testing {

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

Matrices::Matrices(const ElementSet& elements, const Grid& grid, int components, const Held& held) {
  const int n = static_cast<int>(grid.nodes.size());
  for (int i = 0; i < n; ++i)
    for (int d = 0; d < components; ++d)
      if (!(held && held(grid.nodes[i], d))) of.push_back({i, d});
  const int free = static_cast<int>(of.size());
  stiffness.resize(free, free);
  mass.resize(free);
  std::vector<Vec3> u(n, Vec3::Zero()), f(n, Vec3::Zero());
  for (int a = 0; a < free; ++a) {
    const auto [i, d] = of[a];
    u[i][d] = 1.0;
    elements.linear_force(grid.nodes, u, f);
    u[i][d] = 0.0;
    for (int b = 0; b < free; ++b) stiffness(b, a) = f[of[b][0]][of[b][1]];
    mass[a] = elements.nodal_mass()[i];
  }
}

Eigen::VectorXd Matrices::squares() const {
  const Eigen::VectorXd root = mass.cwiseSqrt().cwiseInverse();
  return eigenvalues(root.asDiagonal() * stiffness * root.asDiagonal());
}

double Matrices::highest_frequency() const { return std::sqrt(squares().maxCoeff()); }

Eigen::VectorXd Matrices::solve(const Eigen::VectorXd& load) const { return stiffness.ldlt().solve(load); }

}  // namespace undex::fem::testing
