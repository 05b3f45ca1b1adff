// The kernel of rings on the lattice that it is made for, by sums over all neighbours that know nothing of columns.
#include "sph_fluid/pairs/ring_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace undex::sph {
namespace {

constexpr double pi = std::numbers::pi;

/// What a ring of column k at z = 0 finds round it, on a lattice of spacing dx scale with the h of dx.
struct Found {
  double volume;  ///< sum V K: 1
  double force;   ///< radial force per volume under unit pressure, times h: 0
  double axial;   ///< rate of volume in v_z = z: 1
  double radial;  ///< in v_r = r: 2
};

template <class Kernel>
Found found(double eta, int k, double scale = 1.0) {
  const double h = 0.003, dx = scale * h / eta, r = (k + 0.5) * dx;
  const RingKernel rings(Kernel::which, eta);
  const double factor = lattice_factor<Kernel>(eta, 2);
  const int reach = int(Kernel::support * h / dx) + 1;
  const Ring i = rings.at(r, h);
  Found sum{};
  for (int column = 0; column <= k + reach; ++column)
    for (int row = -reach; row <= reach; ++row)
      for (const double side : {1.0, -1.0}) {
        const double rj = (column + 0.5) * dx, z = row * dx, x = r - side * rj, distance = std::hypot(x, z);
        const Ring j = rings.at(rj, h);
        const double V = 2.0 * pi * rj * dx * dx, F = gradient_factor<Kernel>(distance, h, 2) / factor;
        const double W = value<Kernel>(distance, h, 2) / rings.lattice_sum(), G = 0.5 * (i.a + j.a) * F;
        sum.volume += V * 0.5 * (i.a + j.a) * W;
        sum.force -= h * V * (2.0 * G * x + W * i.slope);
        sum.axial -= V * G * z * z;
        sum.radial -= V * (G * x * x + 0.5 * W * (i.slope * r + j.slope * rj));
      }
  return sum;
}

template <class Kernel>
void expect_exact(double eta) {
  for (int k = 0; k < 12; ++k) {
    const Found sum = found<Kernel>(eta, k);
    EXPECT_NEAR(sum.volume, 1.0, 1e-4) << Kernel::name << ' ' << eta << ", column " << k;
    EXPECT_NEAR(sum.force, 0.0, 1e-4) << Kernel::name << ' ' << eta << ", column " << k;
    EXPECT_NEAR(sum.axial, 1.0, 0.01) << Kernel::name << ' ' << eta << ", column " << k;
    // The column beside the axis misses a part of its divergence.
    EXPECT_NEAR(sum.radial, 2.0, k == 0 ? 0.2 : 0.02) << Kernel::name << ' ' << eta << ", column " << k;
  }
}

/// The columns of a lattice have its cells. Nearer to the axis than half its width a ring is a disc, whatever its radius.
TEST(RingArea, ARingThatReachesAcrossTheAxisIsADisc) {
  const double dx = 0.003;
  for (int k = 0; k < 3; ++k) {
    const double r = (k + 0.5) * dx;
    EXPECT_NEAR(ring_area(2.0 * pi * r * dx * dx, r), dx * dx, 1e-12 * dx * dx) << k;
  }
  for (const double r : {0.0, 1e-9 * dx, 0.1 * dx, 0.499 * dx})
    EXPECT_NEAR(ring_area(pi * dx * dx * dx, r), dx * dx, 1e-12 * dx * dx) << r;
  const double wide = 8.0 * pi * dx * dx * dx;  // a disc from a radius of dx on
  EXPECT_NEAR(ring_area(wide, 1.001 * dx), 4.0 / 1.001 * dx * dx, 1e-12 * dx * dx);
  EXPECT_NEAR(ring_area(wide, 0.999 * dx), 4.0 * dx * dx, 1e-12 * dx * dx);
}

TEST(RingKernel, IsExactOnItsLatticeForAnyKernel) {
  for (const KernelName name : all_kernels)
    with_kernel(name, [](auto kernel) {
      using Kernel = decltype(kernel);
      for (const double more : {0.9, 1.0, 1.15}) expect_exact<Kernel>(more * Kernel::usual_eta);
    });
}

/// Compressed lattices are beside what the tables are made for: a part of the pressure over rho h is left, outwards or inwards.
TEST(RingKernel, LeavesLittleOnLatticesThatAreCompressedAndStretched) {
  for (const double scale : {0.85, 0.93, 1.08}) {
    for (int k = 0; k < 6; ++k) {
      const Found sum = found<WendlandC2>(1.5, k, scale);
      EXPECT_NEAR(sum.volume, 1.0, 0.05) << scale << ", column " << k;
      EXPECT_NEAR(sum.force, 0.0, 0.1) << scale << ", column " << k;
    }
  }
}

TEST(RingKernel, IsThatOfTheMeridianFarFromTheAxis) {
  const RingKernel rings(KernelName::wendland_c2, 1.5);
  const double h = 0.0015, r = 0.02;
  const Ring ring = rings.at(r, h);
  EXPECT_DOUBLE_EQ(ring.a, 1.0 / (2.0 * pi * r));
  EXPECT_DOUBLE_EQ(ring.slope, -1.0 / (2.0 * pi * r * r));
  // Nothing jumps where the tables end.
  for (const double zeta : {4.999999, 5.000001}) {
    EXPECT_NEAR(2.0 * pi * zeta * h * rings.at(zeta * h, h).a, 1.0, 1e-5);
    EXPECT_NEAR(2.0 * pi * zeta * zeta * h * h * rings.at(zeta * h, h).slope, -1.0, 1e-4);
  }
}

TEST(RingKernel, IsSmoothAndLevelAtTheAxis) {
  for (const KernelName name : all_kernels) {
    const double eta = with_kernel(name, [](auto kernel) { return kernel.usual_eta; });
    const RingKernel rings(name, eta);
    const double h = 1.0;
    Ring before = rings.at(1e-9, h);
    EXPECT_NEAR(before.slope, 0.0, 1e-6);
    for (double r = 0.01; r < 6.0; r += 0.01) {
      const Ring ring = rings.at(r, h);
      EXPECT_GT(ring.a, 0.0) << r;
      EXPECT_LT(std::abs(ring.a - before.a), 0.01) << r;
      EXPECT_LT(ring.slope, 1e-6) << r;
      EXPECT_LT(std::abs(ring.slope - before.slope), 0.05) << r;
      before = ring;
    }
  }
}

/// Beyond the axis, where images of rings may lie, it is mirrored, far off too.
TEST(RingKernel, IsMirroredInTheAxis) {
  const RingKernel rings(KernelName::wendland_c2, 1.5);
  for (const double r : {0.01, 0.5, 2.0, 7.0}) {
    const Ring here = rings.at(r, 1.0), there = rings.at(-r, 1.0);
    EXPECT_EQ(here.a, there.a);
    EXPECT_EQ(here.slope, -there.slope);
  }
}

}  // namespace
}  // namespace undex::sph
