#include "sph_fluid/water/split.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sph_fluid/pairs/cell_list.hpp"

namespace undex::sph {
namespace {

/// Particles that a body may become.
std::size_t most_of(const Group& group) { return group.body->variable_h ? std::size_t(group.body->split) * group.laid : 0; }

/// Volume, of a ring its area in the meridian.
double size_of(const ParticleSet& set, const Settings& settings, std::uint32_t i) {
  const FluidRow& q = set.particles.predicted[i];
  return settings.axisymmetric ? q.vz : q.volume;
}

/// Explosive waits until it has burnt, for its halves have no lighting time.
bool has_grown(const ParticleSet& set, const Settings& settings, double time, const Group& group, std::uint32_t i) {
  if (size_of(set, settings, i) <= full_growth * std::pow(group.spacing, settings.dimension)) return false;
  return !group.body->burn || share_burnt(group, set.particles.id[i] - group.first_id, time) >= 1.0;
}

/// Calls visit(place less x) for all that stand within reach of x: particles, their images in walls and across symmetry
/// planes, and walls' dummies.
template <class Visit>
void for_each_beside(const PairInput& in, const Vec3& x, double reach, Visit visit) {
  for (int image = 0; image < 8; ++image) {
    Vec3 at = x;
    bool wanted = true;
    for (int a = 0; a < 3; ++a)
      if (image >> a & 1) {
        wanted = wanted && in.mirror[a] && x[a] < reach;
        at[a] = -at[a];
      }
    if (!wanted) continue;
    const Vec3 low = at.array() - reach, high = at.array() + reach;
    const auto visit_all = [&](const CellGrid& grid, const double* px, const double* py, const double* pz) {
      for_each_in_cells(grid, low.data(), high.data(), [&](std::uint32_t j) {
        Vec3 beside = Vec3(px[j], py[j], pz[j]) - at;
        const double r2 = beside.squaredNorm();
        if (r2 >= reach * reach || r2 == 0.0) return;  // itself
        for (int a = 0; a < 3; ++a)
          if (image >> a & 1) beside[a] = -beside[a];
        visit(beside);
      });
    };
    for (int g = 0; g < in.group_count; ++g)
      if (const GroupView& view = in.groups[g]; view.images_of >= 0) visit_all(view.grid, in.images.x, in.images.y, in.images.z);
      else visit_all(view.grid, in.x, in.y, in.z);
    if (in.wall_count > 0) visit_all(in.wall_grid, in.wall_x, in.wall_y, in.wall_z);
  }
}

/// The direction in which neighbours are fewest and farthest: near ones count by far the most.
Vec3 emptiest(const PairInput& in, const Vec3& x, double reach) {
  Mat3 crowd = Mat3::Zero();
  for_each_beside(in, x, reach, [&](const Vec3& beside) {
    const double r2 = beside.squaredNorm();
    crowd += beside * beside.transpose() / (r2 * r2 * r2);
  });
  const int d = in.dimension;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(crowd.topLeftCorner(d, d));
  Vec3 direction = Vec3::Zero();
  direction.head(d) = axes.eigenvectors().col(0);
  return direction;
}

Split split_of(const ParticleSet& set, const Settings& settings, const PairInput& in, std::uint32_t i) {
  const Vec3 x = place_of(set.particles, i);
  const double reach = in.kernel.support * set.particles.predicted[i].h;
  const Vec3 n = emptiest(in, x, reach);
  // Halfway at most to the planes that halve the ways to its neighbours: no half comes nearer to one of them than to the
  // other half, and none crosses a symmetry plane or a wall, which halve the ways to the particle's own images.
  double far = 0.5 * std::pow(size_of(set, settings, i), 1.0 / in.dimension);
  for_each_beside(in, x, reach, [&](const Vec3& beside) {
    const double along = std::abs(beside.dot(n)), r2 = beside.squaredNorm();
    if (4.0 * far * along > r2) far = 0.25 * r2 / along;
  });
  return {.particle = i, .offset = far * n};
}

}  // namespace

bool any_has_grown(const ParticleSet& set, const Settings& settings, double time) {
  for (const Group& group : set.groups) {
    if (group.end - group.begin >= most_of(group)) continue;
    bool found = false;
#pragma omp parallel for schedule(static) reduction(|| : found)
    for (std::uint32_t i = group.begin; i < group.end; ++i) found = found || has_grown(set, settings, time, group, i);
    if (found) return true;
  }
  return false;
}

std::vector<Split> find_splits(const ParticleSet& set, const Settings& settings, double time, const PairInput& in) {
  std::vector<Split> all;
  for (const Group& group : set.groups) {
    const std::size_t most = most_of(group), count = group.end - group.begin;
    std::vector<std::uint32_t> grown;
    for (std::uint32_t i = group.begin; i < group.end && count + grown.size() < most; ++i)
      if (has_grown(set, settings, time, group, i)) grown.push_back(i);
    const std::size_t before = all.size();
    all.resize(before + grown.size());
#pragma omp parallel for schedule(dynamic, 16)
    for (std::size_t k = 0; k < grown.size(); ++k) all[before + k] = split_of(set, settings, in, grown[k]);
  }
  return all;
}

void split(ParticleSet& set, const std::vector<Split>& splits) {
  Particles& p = set.particles;
  const auto first_new = std::uint32_t(p.size());
  std::vector<std::uint32_t> parents;
  for (const Split& each : splits) parents.push_back(each.particle);
  p.insert_after(parents);
  const auto moved = [&](std::uint32_t place) {
    return place + std::uint32_t(std::lower_bound(parents.begin(), parents.end(), place) - parents.begin());
  };
  for (Group& group : set.groups) {
    group.begin = moved(group.begin);
    group.end = moved(group.end);
  }
  for (std::uint32_t k = 0; k < splits.size(); ++k) {
    const std::uint32_t one = moved(splits[k].particle), other = one + 1;
    p.id[other] = first_new + k;
    for (const std::uint32_t i : {one, other}) {
      p.mass[i] *= 0.5;
      p.half[i] = 1;
      const Vec3 offset = i == one ? splits[k].offset : Vec3(-splits[k].offset);
      for (ParticleState* state : {static_cast<ParticleState*>(&p), &p.start}) {
        if (state->x.empty()) continue;
        state->x[i] += offset[0];
        state->y[i] += offset[1];
        state->z[i] += offset[2];
      }
    }
  }
}

}  // namespace undex::sph
