#include "core/newton_krylov.hpp"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

#include "core/vector_list.hpp"

namespace undex {
namespace {

using Values = KrylovSpace::Values;

void scale(Values& all, double factor) {
  for (Vec3& one : all) one *= factor;
}

double largest(const Values& all) {
  double most = 0;
  for (const Vec3& one : all) most = std::max(most, one.cwiseAbs().maxCoeff());
  return most;
}

}  // namespace

KrylovSpace::KrylovSpace(const Values& value, int products, double share, double difference,
                         const std::function<Values(const Values&)>& moved)
    : norm_(std::sqrt(product(value, value))) {
  if (!(norm_ > 0)) return;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(products + 1, products);
  basis_.push_back(value);
  scale(basis_[0], 1.0 / norm_);
  int columns = 0;
  // The part of the right side that the columns so far leave, by Givens' rotations.
  double rest = 1.0;
  std::vector<double> cosine, sine;
  while (columns < products && rest > share) {
    const double length = difference / largest(basis_[columns]);
    Values next = basis_[columns];
    scale(next, length);
    next = moved(next);
    add(next, -1.0, value);
    scale(next, 1.0 / length);
    for (int l = 0; l <= columns; ++l) {
      all(l, columns) = product(next, basis_[l]);
      add(next, -all(l, columns), basis_[l]);
    }
    const double after = all(columns + 1, columns) = std::sqrt(product(next, next));
    double above = all(0, columns);
    for (int l = 0; l < columns; ++l) above = cosine[l] * all(l + 1, columns) - sine[l] * above;
    ++columns;
    if (!(after > 0)) break;
    cosine.push_back(above / std::hypot(above, after));
    sine.push_back(after / std::hypot(above, after));
    rest *= sine.back();
    scale(next, 1.0 / after);
    basis_.push_back(std::move(next));
  }
  product_ = all.topLeftCorner(columns + 1, columns);
}

Values KrylovSpace::step(double longest) const {
  Values step(basis_.empty() ? 0 : basis_[0].size(), Vec3::Zero());
  if (basis_.empty()) return step;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(product_, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::ArrayXd sigma = svd.singularValues().array(), right = norm_ * svd.matrixU().row(0).transpose().array();
  // Damped as Levenberg and Marquardt do it: the more damping, the shorter the step.
  const auto weights = [&](double damping) -> Eigen::VectorXd { return (-right * sigma / (sigma.square() + damping)).matrix(); };
  const double hardest = sigma[0] * sigma[0];
  if (!(hardest > 0)) return step;
  double low = 1e-24 * hardest, high = low;
  if (weights(low).norm() > longest) {
    for (high = 1e-12 * hardest; weights(high).norm() > longest; high *= 10.0) low = high;
    for (int k = 0; k < 40; ++k) (weights(std::sqrt(low * high)).norm() > longest ? low : high) = std::sqrt(low * high);
  }
  const Eigen::VectorXd weight = svd.matrixV() * weights(high);
  for (int k = 0; k < weight.size(); ++k) add(step, weight[k], basis_[k]);
  return step;
}

}  // namespace undex
