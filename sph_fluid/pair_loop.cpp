// The loop over pairs: clusters of particles in SIMD lanes against packed candidates. Every cluster sums over all of its
// own neighbours in an order that depends on the sorting alone, so results do not depend on the number of threads.
// Compiled once per instruction set; see pair_loop.hpp for the choice at start-up.
#include <omp.h>

#include "sph_fluid/candidates.hpp"
#include "sph_fluid/kernels.hpp"
#include "sph_fluid/monaghan_scheme.hpp"
#include "sph_fluid/pair_data.hpp"
#include "sph_fluid/reconstruction.hpp"
#include "sph_fluid/riemann_scheme.hpp"

namespace undex::sph::UNDEX_LEVEL {
namespace {

double power(double a, int n) {
  double result = 1.0;
  for (int k = 0; k < n; ++k) result *= a;
  return result;
}

/// F(r, h) of the kernel in the lanes; h one number for all pairs.
template <class Kernel>
struct ConstantH {
  Vec h;
  double inverse_h, scale, reach2;

  ConstantH(double h_, double norm, int dimension)
      : h(broadcast(h_)),
        inverse_h(1.0 / h_),
        scale(norm / power(h_, dimension + 2)),
        reach2(Kernel::support * Kernel::support * h_ * h_) {}
  UNDEX_INLINE Vec h_of(const PackedParticle&) const { return h; }
  UNDEX_INLINE Mask near(Vec r2, Vec) const { return r2 < reach2; }
  UNDEX_INLINE Vec gradient(Vec r2, Vec, Mask near) const {
    if constexpr (Kernel::needs_root) {
      const Vec s2 = r2 + 1e-30;
      return keep(near, scale * Kernel::gradient_of_root(s2 * reciprocal_sqrt(s2) * inverse_h));
    } else {
      return keep(near, scale * Kernel::gradient(r2 * (inverse_h * inverse_h)));
    }
  }
};

/// The same with h_ij = (h_i + h_j)/2, a number per pair.
template <class Kernel>
struct PairH {
  Vec h_i;
  double norm;
  int dimension;

  UNDEX_INLINE Vec h_of(const PackedParticle& j) const { return 0.5 * (h_i + j.h); }
  UNDEX_INLINE Mask near(Vec r2, Vec h) const { return r2 < Kernel::support * Kernel::support * (h * h); }
  UNDEX_INLINE Vec gradient(Vec r2, Vec h, Mask near) const {
    const Vec inverse_h = reciprocal(h);
    Vec scale = norm * (inverse_h * inverse_h * inverse_h);
    if (dimension > 1) scale *= inverse_h;
    if (dimension > 2) scale *= inverse_h;
    if constexpr (Kernel::needs_root) {
      const Vec s2 = r2 + 1e-30;
      return keep(near, scale * Kernel::gradient_of_root(minimum(s2 * reciprocal_sqrt(s2) * inverse_h,
                                                                 broadcast(Kernel::support))));
    } else {
      return keep(near, scale * Kernel::gradient(minimum(r2 * (inverse_h * inverse_h), broadcast(9.0))));
    }
  }
};

template <class Scheme, class Smoothing>
UNDEX_INLINE void pairs(const Scheme& scheme, const Smoothing& smoothing, const typename Scheme::Lanes& i,
                        const PackedParticle* candidates, const PackedGradient* gradients, std::uint32_t count,
                        typename Scheme::Sums& sums, Mask& seen) {
  for (std::uint32_t k = 0; k < count; ++k) {
    const PackedParticle& j = candidates[k];
    const Vec dx = i.x - j.x, dy = i.y - j.y, dz = i.z - j.z;
    const Vec r2 = dx * dx + dy * dy + dz * dz;
    const Vec h = smoothing.h_of(j);
    const Mask near = smoothing.near(r2, h);
    seen -= near;
    scheme.pair(i, j, gradients + k, dx, dy, dz, r2, h, smoothing.gradient(r2, h, near), near, sums);
  }
}

template <class Scheme, class Smoothing>
UNDEX_INLINE void walls(const Scheme& scheme, const Smoothing& smoothing, const typename Scheme::Lanes& i,
                        const PackedWall* candidates, std::uint32_t count, typename Scheme::Sums& sums, Mask& seen) {
  for (std::uint32_t k = 0; k < count; ++k) {
    const PackedWall& w = candidates[k];
    const Vec dx = i.x - w.x, dy = i.y - w.y, dz = i.z - w.z;
    const Vec r2 = dx * dx + dy * dy + dz * dz;
    const Mask near = smoothing.near(r2, i.h);
    seen -= near;
    scheme.wall(i, w, dx, dy, dz, r2, i.h, smoothing.gradient(r2, i.h, near), near, sums);
  }
}

/// How far a cluster whose largest smoothing length is h_cluster must look in a group.
template <class Kernel>
double reach_of(double h_cluster, const GroupView& own, const GroupView& other) {
  const bool constant = !own.variable_h && !other.variable_h;
  return Kernel::support * (constant && own.h_max == other.h_max ? own.h_max : 0.5 * (h_cluster + other.h_max));
}

/// Fills scratch with the candidates of one cluster. Pairs of constant and equal h go to `near`, others to `variable`.
template <class Kernel, bool with_gradients>
void gather(const PairInput& in, const Cluster& cluster, Scratch& scratch, std::uint32_t& near_count,
            std::uint32_t& variable_count, std::uint32_t& wall_count) {
  const GroupView& own = in.groups[cluster.group];
  const Box3 box = box_of(in.x, in.y, in.z, cluster.begin, cluster.count);
  double h_cluster = own.h_max;
  if (own.variable_h) {
    h_cluster = 0.0;
    for (int l = 0; l < cluster.count; ++l) {
      const double h = in.packed[cluster.begin + l].h;
      h_cluster = h > h_cluster ? h : h_cluster;
    }
  }
  near_count = variable_count = wall_count = 0;
  for (int g = 0; g < in.group_count; ++g) {
    const GroupView& group = in.groups[g];
    const double reach = reach_of<Kernel>(h_cluster, own, group);
    const bool constant = !own.variable_h && !group.variable_h && own.h_max == group.h_max;
    for_each_image(in.mirror, box, reach, [&](double sx, double sy, double sz, const Box3& seen_box) {
      const std::uint32_t found = scan_grid(group.grid, in.x, in.y, in.z, seen_box, reach, scratch);
      if (found == 0) return;
      std::uint32_t& count = constant ? near_count : variable_count;
      if (constant && count + found > scratch.near_capacity) grow_near(scratch, count + found);
      if (!constant && count + found > scratch.variable_capacity) grow_variable(scratch, count + found);
      copy_candidates(in.packed, scratch.index, found, sx, sy, sz,
                      (constant ? scratch.near : scratch.variable) + count);
      if constexpr (with_gradients)
        copy_candidates(in.gradients, scratch.index, found, sx, sy, sz,
                        (constant ? scratch.near_gradient : scratch.variable_gradient) + count);
      count += found;
    });
  }
  if (in.wall_count > 0) {
    const double reach = Kernel::support * h_cluster;
    for_each_image(in.mirror, box, reach, [&](double sx, double sy, double sz, const Box3& seen_box) {
      const std::uint32_t found = scan_grid(in.wall_grid, in.wall_x, in.wall_y, in.wall_z, seen_box, reach, scratch);
      if (found == 0) return;
      if (wall_count + found > scratch.wall_capacity) grow_wall(scratch, wall_count + found);
      copy_candidates(in.walls, scratch.index, found, sx, sy, sz, scratch.wall + wall_count);
      wall_count += found;
    });
  }
}

template <class Kernel, class Scheme>
void cluster_rates(const PairInput& in, const Scheme& scheme, const Cluster& cluster, Scratch& scratch,
                   const FluidRates& out, long long& interactions) {
  std::uint32_t near_count, variable_count, wall_count;
  gather<Kernel, Scheme::needs_gradients>(in, cluster, scratch, near_count, variable_count, wall_count);
  const GroupView& own = in.groups[cluster.group];
  const double norm = Kernel::norm(in.dimension);
  const typename Scheme::Lanes i = Scheme::load(in.packed + cluster.begin, in.gradients + cluster.begin, cluster.count);
  const PairH<Kernel> pair_h{i.h, norm, in.dimension};
  typename Scheme::Sums sums;
  Mask seen{};
  if (near_count > 0)
    pairs(scheme, ConstantH<Kernel>(own.h_max, norm, in.dimension), i, scratch.near, scratch.near_gradient, near_count,
          sums, seen);
  if (variable_count > 0)
    pairs(scheme, pair_h, i, scratch.variable, scratch.variable_gradient, variable_count, sums, seen);
  if (wall_count > 0) walls(scheme, pair_h, i, scratch.wall, wall_count, sums, seen);
  store_fluid(sums, cluster.begin, cluster.count, out);
  interactions = -std::int64_t(cluster.count);  // a particle is not its own neighbour
  for (int l = 0; l < cluster.count; ++l) interactions += seen[l];
}

/// Pass before a reconstructing scheme: gradients of one cluster's particles.
template <class Kernel>
void cluster_gradients(const PairInput& in, const Reconstruction& gradients, const Cluster& cluster, Scratch& scratch) {
  std::uint32_t near_count, variable_count, wall_count;
  gather<Kernel, false>(in, cluster, scratch, near_count, variable_count, wall_count);
  const double norm = Kernel::norm(in.dimension);
  const Reconstruction::Lanes i = Reconstruction::load(in.packed + cluster.begin, nullptr, cluster.count);
  const PairH<Kernel> pair_h{i.h, norm, in.dimension};
  Reconstruction::Sums sums;
  Mask seen{};
  if (near_count > 0)
    pairs(gradients, ConstantH<Kernel>(in.groups[cluster.group].h_max, norm, in.dimension), i, scratch.near, nullptr,
          near_count, sums, seen);
  if (variable_count > 0) pairs(gradients, pair_h, i, scratch.variable, nullptr, variable_count, sums, seen);
  if (wall_count > 0) walls(gradients, pair_h, i, scratch.wall, wall_count, sums, seen);
  gradients.store(sums, in.gradients + cluster.begin, cluster.count);
}

template <class Kernel, class Scheme>
void cluster_wall_forces(const PairInput& in, const Scheme& scheme, const Cluster& cluster, Scratch& scratch,
                         const WallForces& out) {
  const Box3 box = box_of(in.wall_x, in.wall_y, in.wall_z, cluster.begin, cluster.count);
  const double norm = Kernel::norm(in.dimension);
  const WallLanes w = load_walls(in.walls + cluster.begin, cluster.count);
  WallSums sums;
  for (int g = 0; g < in.group_count; ++g) {
    const double reach = Kernel::support * in.groups[g].h_max;
    for_each_image(in.mirror, box, reach, [&](double sx, double sy, double sz, const Box3& seen_box) {
      const std::uint32_t found = scan_grid(in.groups[g].grid, in.x, in.y, in.z, seen_box, reach, scratch);
      if (found > scratch.near_capacity) grow_near(scratch, found);
      copy_candidates(in.packed, scratch.index, found, sx, sy, sz, scratch.near);
      for (std::uint32_t k = 0; k < found; ++k) {
        const PackedParticle& j = scratch.near[k];
        const Vec dx = j.x - w.x, dy = j.y - w.y, dz = j.z - w.z;
        const Vec r2 = dx * dx + dy * dy + dz * dz;
        const PairH<Kernel> smoothing{broadcast(j.h), norm, in.dimension};
        const Vec h = broadcast(j.h);
        const Mask near = smoothing.near(r2, h);
        scheme.force(w, j, dx, dy, dz, r2, smoothing.gradient(r2, h, near), near, sums);
      }
    });
  }
  store_walls(sums, cluster.begin, cluster.count, out);
}

}  // namespace

template <class Kernel, class Scheme>
void fluid_rates(const PairInput& in, const FluidRates& out) {
  if constexpr (Scheme::needs_gradients) {
    const Reconstruction gradients{in.dimension};
#pragma omp parallel for schedule(dynamic, 16)
    for (std::uint32_t k = 0; k < in.cluster_count; ++k)
      cluster_gradients<Kernel>(in, gradients, in.clusters[k], in.scratch[omp_get_thread_num()]);
  }
  const Scheme scheme(in);
#pragma omp parallel for schedule(dynamic, 16)
  for (std::uint32_t k = 0; k < in.cluster_count; ++k)
    cluster_rates<Kernel>(in, scheme, in.clusters[k], in.scratch[omp_get_thread_num()], out, out.interactions[k]);
}

template <class Kernel, class Scheme>
void wall_forces(const PairInput& in, const Cluster* clusters, std::uint32_t count, const WallForces& out) {
  const Scheme scheme(in);
#pragma omp parallel for schedule(dynamic, 16)
  for (std::uint32_t k = 0; k < count; ++k)
    cluster_wall_forces<Kernel>(in, scheme, clusters[k], in.scratch[omp_get_thread_num()], out);
}

#define UNDEX_INSTANTIATE(Kernel, Scheme)                                   \
  template void fluid_rates<Kernel, Scheme>(const PairInput&, const FluidRates&); \
  template void wall_forces<Kernel, Scheme>(const PairInput&, const Cluster*, std::uint32_t, const WallForces&);
UNDEX_INSTANTIATE(Gaussian, Monaghan)
UNDEX_INSTANTIATE(WendlandC2, Monaghan)
UNDEX_INSTANTIATE(Gaussian, Riemann)
UNDEX_INSTANTIATE(WendlandC2, Riemann)

}  // namespace undex::sph::UNDEX_LEVEL
