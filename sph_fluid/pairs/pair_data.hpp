// Plain data that the pair loops read and write. Nothing here may instantiate library templates: the loops are compiled
// several times, for several instruction sets, and only this header and kernels.hpp are shared with the rest.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sph_fluid/pairs/kernels.hpp"

namespace undex::sph {

/// Particles of a cluster, the unit of work of a pair loop. Every one of them is paired with all candidates of the cluster.
inline constexpr int cluster_size = 8;

// What a pair reads and what it gives lies in rows, one a particle: a list of candidates is made of them by transposing.

/// What a pair reads of a fluid particle beside its place.
struct alignas(64) FluidRow {
  double vx, vy, vz;  ///< velocity predicted for this evaluation [m/s]
  double p;           ///< [Pa]
  double volume;      ///< m/rho [m^3]
  double rho, c;      ///< density [kg/m^3], sound speed [m/s]
  double h;           ///< smoothing length [m]
};

/// Limited reconstruction's raw material: gradients of velocity (its symmetric part, all that the component along a pair
/// needs: xx, yy, zz, xy, yz, zx) [1/s] and of pressure [Pa/m]. Single precision: they only shape a correction.
struct GradientRow {
  float strain[6], pressure[3];
  float filling;  ///< by which the pair rates of gas are divided (riemann_scheme.hpp); 1 in liquids
};

/// Lower bound of GradientRow::filling. Half is what a plane free surface has.
inline constexpr float least_filling = 0.5f;

/// The same with the correction of kernel gradients B (xx, yy, zz, xy, yz, zx) [-]; see corrected_scheme.hpp.
struct CorrectedRow {
  GradientRow gradient;
  float correction[6];
};

/// A particle's own coefficient of viscosity; see switch_scheme.hpp.
struct ViscosityRow {
  double alpha;
};

/// What pairs of solid particles read beside FluidRow [Pa]: sigma B, row by row, B being the correction of kernel gradients
/// (solid_schemes.hpp); sigma itself: xx, yy, zz, yz, zx, xy; the rate of strain, in the same order [1/s]; and
/// the speed of shear waves [m/s].
struct SolidRow {
  double corrected[9], stress[6], strain[6], shear_sound;
};

/// What a solid particle learns from its body's others: velocity gradient d v_a/d x_b at 3a + b [1/s], and the correction B
/// (xx, yy, zz, xy, yz, zx) [-].
struct DeformationRow {
  double gradient[9], correction[6];
};

/// What a pair reads of a wall's dummy particle.
struct alignas(64) WallRow {
  double vx, vy, vz;  ///< [m/s]
  double nx, ny, nz;  ///< unit normal, away from the fluid; behind an edge, the edge's direction
  double volume;      ///< [m^3]
  double slip;        ///< 1: free slip; 0: no slip, or a free-slip corner (nothing slips there); -1: a free-slip edge
};

/// What the pairs add up for a fluid particle.
struct SumRow {
  double fx, fy, fz;   ///< acceleration times density [N/m^3]
  double compression;  ///< (d rho/dt)/rho [1/s]
  double heat;         ///< viscous heating times density [W/m^3]
  double closing;      ///< a maximum: closing speed to a neighbour, as the scheme's step limit wants it [m/s]
};

/// What they add up for a wall's particle.
struct ForceRow {
  double fx, fy, fz;  ///< [N]
};

/// Cells over one range of particles. Rows run along x; a row's cells are a quarter as long as wide, so that the run of
/// candidates within reach is found from `start` alone.
struct CellGrid {
  double low[3];                       ///< lower corner [m]
  double size[3];                      ///< cell edge along x, y, z [m]
  double bound_low[3], bound_high[3];  ///< box of the particles themselves
  int count[3];                        ///< cells along x, y, z
  const std::uint32_t* start;          ///< count[0]*count[1]*count[2] + 1 entries; first particle of each cell, x fastest
};

/// Which pairs a pass takes where bodies have steps of their own (local_steps.cpp).
enum class PairChoice : int {
  all,
  slow,  ///< of two slow particles
  fast,  ///< with at least one fast particle
};

/// Particles that share a material and a policy for the smoothing length; contiguous, sorted by cell.
struct GroupView {
  std::uint32_t begin, end;
  CellGrid grid;
  double h_max;  ///< [m]
  bool variable_h;
  bool gas;                    ///< bubble gas or detonation products, not liquid
  std::uint32_t material = 0;  ///< one number for all groups of one material
  bool fast = false;           ///< see PairChoice
  bool own_pairs = true;       ///< do its particles pair with each other? (A solid that keeps its neighbours does not ask here.)
  int images_of = -1;          ///< a group of images (wall_images.hpp): the group that they show
};

/// Images in slip walls: what pairs read of them, as PairInput's arrays of particles.
struct ImageInput {
  const double *x, *y, *z;
  const FluidRow* fluid;
  const GradientRow* gradient;
  const CorrectedRow* corrected;
  const ViscosityRow* viscosity;
};

/// Up to cluster_size consecutive particles of one row of cells.
struct Cluster {
  std::uint32_t begin;
  std::uint16_t count;
  std::uint16_t group;
};

/// Clusters of neighbouring rows (a column along x) that one thread works on at a time; see blocks.hpp.
struct Block {
  std::uint32_t begin, end;  ///< clusters
  int iy, iz;                ///< its place among the columns
};

/// Buffers of one thread for the candidates of a cluster, grown on demand.
struct Scratch {
  void* blocks = nullptr;  ///< what the pairs read of them
  std::size_t bytes = 0;
  std::uint32_t* index = nullptr;                   ///< which particles they are
  double *x = nullptr, *y = nullptr, *z = nullptr;  ///< where [m]
  std::uint32_t capacity = 0;                       ///< of the last four
};
/// Makes room, keeping what is there.
void grow(Scratch&, std::size_t bytes, std::uint32_t candidates);
void release(Scratch&);

/// A kernel as the loops need it; kernel_choice() makes it (lattice.hpp).
struct KernelChoice {
  KernelName name;
  double support;  ///< in smoothing lengths
  double norm;
};

/// Everything that the loop over pairs reads.
struct PairInput {
  PairChoice choice;  ///< gradients are then of slow or of fast particles only, among all neighbours
  int dimension;
  double kernel_scale;  ///< of the kernel's gradient: 1 over its lattice factor (kernels.hpp), or 1
  const double *x, *y, *z;
  const FluidRow* fluid;
  KernelChoice kernel;    ///< read by the loop that serves any kernel
  GradientRow* gradient;  ///< null where the scheme has no use for them, as the next two
  CorrectedRow* corrected;
  const ViscosityRow* viscosity;
  const SolidRow* solid;  ///< of the solids' passes, as the next
  DeformationRow* deformation;
  double artificial_stress, spacing;  ///< of the solids' forces
  double contact_damping;             ///< share of the acoustic impedance
  const GroupView* groups;            ///< of particles first, then of images
  int group_count;
  ImageInput images;
  const double *wall_x, *wall_y, *wall_z;
  const WallRow* wall;  ///< sorted by cell of wall_grid
  CellGrid wall_grid;
  std::uint32_t wall_count;
  bool mirror[3];      ///< symmetry planes through the origin
  double alpha, beta;  ///< Monaghan's viscosity; with a switch, alpha's upper bound and the beta there
  bool partly;         ///< only clusters within `margin` of the box are worked on
  double disturbed_low[3], disturbed_high[3], margin;  ///< [m]
  const Cluster* clusters;                             ///< sorted by block
  const Block* blocks;                                 ///< in the order of work
  std::uint32_t block_count;
  int columns_y, columns_z;   ///< block columns
  const std::uint32_t* rank;  ///< rank[iz*columns_y + iy]: place in `blocks`, or block_count where there is none
  unsigned char* finished;    ///< one flag per block, for the loops' own use
  Scratch* scratch;           ///< one per thread
};

/// Sums of the loop, zero before it.
struct PairOutput {
  SumRow* fluid;
  ForceRow* wall;           ///< null where nobody asks for it
  SumRow* images;           ///< what they receive, for their owners
  long long* interactions;  ///< true neighbours met (directed), one counter per block
};

}  // namespace undex::sph
