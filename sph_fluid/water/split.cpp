#include "sph_fluid/water/split.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

#include "sph_fluid/pairs/cell_list.hpp"

namespace undex::sph {
namespace {

/// Volume, of a ring its area in the meridian.
double size_of(const ParticleSet& set, const Settings& settings, std::uint32_t i) {
  const FluidRow& q = set.particles.predicted[i];
  return settings.axisymmetric ? q.vz : q.volume;
}

Vec3 velocity_of(const FluidRow& row, bool rings) { return {row.vx, row.vy, rings ? 0.0 : row.vz}; }

/// At which a particle splits.
double full_size(const Settings& settings, const Group& group) {
  return full_growth(settings.dimension) * std::pow(group.spacing, settings.dimension);
}

/// Explosive waits until it has burnt, for its halves have no lighting time.
bool has_grown(const ParticleSet& set, const Settings& settings, double time, const Group& group, std::uint32_t i) {
  if (2 << set.particles.halvings[i] > group.body->split) return false;
  if (size_of(set, settings, i) <= full_size(settings, group)) return false;
  return !group.body->burn || share_burnt(group, set.particles.id[i] - group.first_id, time) >= 1.0;
}

/// What stands beside a particle.
struct Neighbour {
  Vec3 x, v;    ///< from the particle, and relative to it [m], [m/s]
  double size;  ///< see size_of
  bool flows;   ///< not a wall's dummy, which has no velocity of the fluid
};

/// Calls visit(Neighbour) for all that stand within reach of a particle: particles, their images in walls and across symmetry
/// planes, and walls' dummies.
template <class Visit>
void for_each_beside(const PairInput& in, std::uint32_t i, double reach, Visit visit) {
  const bool rings = in.rings != nullptr;
  const Vec3 x(in.x[i], in.y[i], in.z[i]), v = velocity_of(in.fluid[i], rings);
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
    const auto visit_all = [&](const CellGrid& grid, const double* px, const double* py, const double* pz, auto state_of) {
      for_each_in_cells(grid, low.data(), high.data(), [&](std::uint32_t j) {
        Vec3 from = Vec3(px[j], py[j], pz[j]) - at;
        const double r2 = from.squaredNorm();
        if (r2 >= reach * reach || r2 == 0.0) return;  // itself
        auto [velocity, size, flows] = state_of(j);
        for (int a = 0; a < 3; ++a)
          if (image >> a & 1) from[a] = -from[a], velocity[a] = -velocity[a];
        visit(Neighbour{from, velocity - v, size, flows});
      });
    };
    const auto fluid = [&](const FluidRow* rows) {
      return [=](std::uint32_t j) { return std::tuple(velocity_of(rows[j], rings), rings ? rows[j].vz : rows[j].volume, true); };
    };
    for (int g = 0; g < in.group_count; ++g)
      if (const GroupView& view = in.groups[g]; view.images_of >= 0)
        visit_all(view.grid, in.images.x, in.images.y, in.images.z, fluid(in.images.fluid));
      else visit_all(view.grid, in.x, in.y, in.z, fluid(in.fluid));
    if (in.wall_count > 0)
      visit_all(in.wall_grid, in.wall_x, in.wall_y, in.wall_z,
                [&](std::uint32_t j) { return std::tuple(Vec3(Vec3::Zero()), in.wall[j].volume, false); });
  }
}

/// How often the volumes about a particle, its own among them, claim the space that they are in, with the weight (1 - q^2)^2 for
/// q = r/reach: 1 on a lattice, less at a free surface.
double claimed(const PairInput& in, std::uint32_t i, double reach, double own) {
  double sum = own;
  for_each_beside(in, i, reach, [&](const Neighbour& other) {
    const double w = 1.0 - other.x.squaredNorm() / (reach * reach);
    sum += other.size * w * w;
  });
  constexpr double pi = std::numbers::pi, integral[] = {16.0 / 15.0, pi / 3.0, 32.0 * pi / 105.0};
  return sum / (integral[in.dimension - 1] * std::pow(reach, in.dimension));
}

/// Where neighbours are fewest and farthest (near ones count by far the most).
Vec3 emptiest(const PairInput& in, std::uint32_t i, double reach) {
  Mat3 crowd = Mat3::Zero();
  for_each_beside(in, i, reach, [&](const Neighbour& other) {
    const double r2 = other.x.squaredNorm();
    crowd += other.x * other.x.transpose() / (r2 * r2 * r2);
  });
  const int d = in.dimension;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(crowd.topLeftCorner(d, d));
  Vec3 direction = Vec3::Zero();
  direction.head(d) = axes.eigenvectors().col(0);
  return direction;
}

/// By how much the velocity along that direction rises along it [1/s]: least squares with the same weights, in which an
/// eigenvector's slope has no part of the others'. Of the slopes towards either side the lesser counts, none where they disagree
/// or nobody stands on one of them.
double opening_rate(const PairInput& in, std::uint32_t i, double reach, const Vec3& direction) {
  double rise[2] = {}, run[2] = {};
  for_each_beside(in, i, reach, [&](const Neighbour& other) {
    if (!other.flows) return;
    const double r2 = other.x.squaredNorm(), along = other.x.dot(direction), weight = along / (r2 * r2 * r2);
    rise[along > 0.0] += weight * other.v.dot(direction);
    run[along > 0.0] += weight * along;
  });
  if (run[0] <= 0.0 || run[1] <= 0.0 || rise[0] * rise[1] <= 0.0) return 0.0;
  const double behind = rise[0] / run[0], before = rise[1] / run[1];
  return std::abs(behind) < std::abs(before) ? behind : before;
}

/// Nothing where the particle has not the space that it claims.
std::optional<Split> split_of(const ParticleSet& set, const Settings& settings, const PairInput& in, const Group& group,
                              std::uint32_t i) {
  const double reach = in.kernel.support * in.fluid[i].h, size = size_of(set, settings, i);
  if (size <= std::max(1.0, claimed(in, i, reach, size)) * full_size(settings, group)) return {};
  const Vec3 n = emptiest(in, i, reach);
  // Halfway at most to the planes that halve the ways to its neighbours: no half comes nearer to one of them than to the
  // other half, and none crosses a symmetry plane or a wall, which halve the ways to the particle's own images.
  double far = 0.5 * std::pow(size, 1.0 / in.dimension);
  for_each_beside(in, i, reach, [&](const Neighbour& other) {
    const double along = std::abs(other.x.dot(n)), r2 = other.x.squaredNorm();
    if (4.0 * far * along > r2) far = 0.25 * r2 / along;
  });
  const double most = 0.5 * in.fluid[i].c;                          // they part no faster than sound
  const double outward = settings.axisymmetric ? far * n[0] : 0.0;  // at most half of the radius, by the ring's own image
  return Split{.particle = i,
               .offset = far * n,
               .parting = std::clamp(far * opening_rate(in, i, reach, n), -most, most) * n,
               .share = outward == 0.0 ? 0.5 : 0.5 + 0.5 * outward / std::max(in.x[i], 2.0 * std::abs(outward))};
}

bool may_split(const Group& group) { return group.body->variable_h && group.body->split > 1; }

}  // namespace

bool any_has_grown(const ParticleSet& set, const Settings& settings, double time) {
  for (const Group& group : set.groups) {
    if (!may_split(group)) continue;
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
    if (!may_split(group)) continue;
    std::vector<std::uint32_t> grown;
    for (std::uint32_t i = group.begin; i < group.end; ++i)
      if (has_grown(set, settings, time, group, i)) grown.push_back(i);
    std::vector<std::optional<Split>> found(grown.size());
#pragma omp parallel for schedule(dynamic, 16)
    for (std::size_t k = 0; k < grown.size(); ++k) found[k] = split_of(set, settings, in, group, grown[k]);
    for (const std::optional<Split>& each : found)
      if (each) all.push_back(*each);
  }
  return all;
}

double split(ParticleSet& set, const std::vector<Split>& splits) {
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
  double owed = 0;
  for (std::uint32_t k = 0; k < splits.size(); ++k) {
    const std::uint32_t one = moved(splits[k].particle), other = one + 1;
    p.id[other] = first_new + k;
    const auto& [particle, offset, parting, share] = splits[k];
    const double kinetic = 2.0 * share * (1.0 - share) * parting.squaredNorm();
    const bool pays = materials::uses_energy(body_of(set, one).material.law);
    if (!pays) owed += p.mass[one] * kinetic;
    for (const std::uint32_t i : {one, other}) {
      p.mass[i] *= i == one ? share : 1.0 - share;
      if (pays) p.energy[i] -= kinetic;
      ++p.halvings[i];
      const double side = i == one ? 1.0 : -1.0, far = i == one ? 2.0 * (1.0 - share) : -2.0 * share;
      p.vx[i] += far * parting[0];
      p.vy[i] += far * parting[1];
      p.vz[i] += far * parting[2];
      for (ParticleState* state : {static_cast<ParticleState*>(&p), &p.start}) {
        if (state->x.empty()) continue;
        state->x[i] += side * offset[0];  // of a ring: its radius
        state->y[i] += far * offset[1];
        state->z[i] += far * offset[2];
      }
    }
  }
  return owed;
}

}  // namespace undex::sph
