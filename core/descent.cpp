#include "core/descent.hpp"

#include <cmath>

#include "core/vector_list.hpp"

namespace undex {
namespace {

constexpr std::size_t remembered = 6;
constexpr double first_step = 0.3;  // of the forces; those of kernels on a lattice bear it

}  // namespace

void Descent::remember(const std::vector<Vec3>& x, const std::vector<Vec3>& force) {
  if (!x_.empty()) {
    Change change{x, force_, 0.0};
    add(change.place, -1.0, x_);
    add(change.force, -1.0, force);
    change.curvature = product(change.place, change.force);
    const double largest = std::sqrt(product(change.place, change.place) * product(change.force, change.force));
    if (change.curvature > 1e-8 * largest) changes_.push_back(std::move(change));
    if (changes_.size() > remembered) changes_.erase(changes_.begin());
  }
  x_ = x;
  force_ = force;
}

std::vector<Vec3> Descent::step(const std::vector<Vec3>& x, const std::vector<Vec3>& force) {
  remember(x, force);
  std::vector<Vec3> step = force;
  std::vector<double> share(changes_.size());
  for (std::size_t k = changes_.size(); k-- > 0;) {
    share[k] = product(changes_[k].place, step) / changes_[k].curvature;
    add(step, -share[k], changes_[k].force);
  }
  double scale = first_step;
  if (!changes_.empty()) scale = changes_.back().curvature / product(changes_.back().force, changes_.back().force);
  for (Vec3& one : step) one *= scale;
  for (std::size_t k = 0; k < changes_.size(); ++k)
    add(step, share[k] - product(changes_[k].force, step) / changes_[k].curvature, changes_[k].place);
  return step;
}

}  // namespace undex
