// Plain data that the pair loops work on, beside the rows (rows.hpp): groups of particles and their cells, the order of work, and
// all that a loop reads and writes. As in rows.hpp, nothing here may instantiate library templates.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sph_fluid/pairs/kernels.hpp"
#include "sph_fluid/pairs/rows.hpp"

namespace undex::sph {

/// Particles of a cluster, the unit of work of a pair loop. Every one of them is paired with all candidates of the cluster.
inline constexpr int cluster_size = 8;

/// Numbers in the loop over pairs. State and its integration are in double precision always.
enum class Precision {
  full,   ///< double
  mixed,  ///< pairs in single precision, on places relative to their cluster
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

/// Which pairs a pass takes where bodies have steps of their own (local_steps.hpp).
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
  double least_pressure = 0;   ///< that a pair may have, 0 or the tension that the law carries [Pa]
  bool fast = false;           ///< see PairChoice
  bool own_pairs = true;       ///< do its particles pair with each other? (A solid that keeps its neighbours does not ask here.)
  int images_of = -1;          ///< a group of images (wall_images.hpp): the group that they show
};

/// Images in slip walls: what pairs read of them, as PairInput's arrays of particles.
struct ImageInput {
  const double *x, *y, *z;
  const FluidRow* fluid;
  const void* second;  ///< as PairInput has them
  const RingRow* rings;
};

/// How much the particles of a cluster see of candidates past thin walls (walls/sight.hpp).
enum class SightOf : int { particles, images, dummies };
struct SightQuestion {
  std::uint32_t begin;  ///< the cluster's particles
  int count;
  SightOf what;                ///< candidates are
  const std::uint32_t* index;  ///< which ones
  const double *x, *y, *z;     ///< where [m]
  std::uint32_t first, last;   ///< first <= c < last
  int mirror;                  ///< bit a: seen across the symmetry plane of axis a
  double reach;                ///< of the pairs: those farther apart do not count [m]
  float* share;                ///< the answer, 0 to 1: share[l * row + c] for particle l of the cluster and candidate c
  std::uint32_t row;
};
struct SightInput {
  const void* self = nullptr;                ///< null: no wall is thin
  const std::uint16_t* particles = nullptr;  ///< zero for one that sees all particles within reach
  void (*answer)(const void* self, const struct PairInput&, const SightQuestion&) = nullptr;
};

/// Up to cluster_size consecutive particles of one row of cells.
struct Cluster {
  std::uint32_t begin;
  std::uint16_t count;
  std::uint16_t group;
};

/// Clusters of neighbouring rows that one thread works on at a time, after the blocks that it waits for; see blocks.hpp.
struct Block {
  std::uint32_t begin, end;             ///< clusters
  std::uint32_t first_wait, last_wait;  ///< in PairInput::waits
};

/// Hands the blocks to threads; see block_queue.hpp.
class BlockQueue;
enum class Turns { in_order, any };
void start(BlockQueue&, Turns);
std::uint32_t take(BlockQueue&, int thread);
void finish(BlockQueue&, std::uint32_t block);

/// Buffers of one thread for the candidates of a cluster, grown on demand.
struct Scratch {
  void* blocks = nullptr;  ///< what the pairs read of them
  std::size_t bytes = 0;
  std::uint32_t* index = nullptr;                   ///< which particles they are
  double *x = nullptr, *y = nullptr, *z = nullptr;  ///< where [m]
  void* place[3] = {};         ///< the same as the pairs see it, from the cluster's middle and mirrored [m]: numbers of the loop
  std::uint32_t capacity = 0;  ///< of the last seven
  float* share = nullptr;      ///< cluster_size times as many: see SightQuestion
  double* kept = nullptr;      ///< twice as many: what candidates are before shares are taken of them
};
/// Makes room, keeping what is there.
void grow(Scratch&, std::size_t bytes, std::uint32_t candidates);
void release(Scratch&);

/// What pairs in single precision read (single_rows.hpp), grown on demand: rows, and places in fixed point.
struct SingleRows {
  float *main = nullptr, *tail = nullptr;
  std::int32_t* place[3] = {};
  std::size_t main_bytes = 0, tail_bytes = 0, place_bytes = 0;
};
/// Makes room for that many particles and numbers of each, and for a vector beyond their places; forgets what is there.
void grow(SingleRows&, std::size_t particles, int main, int tail);
void release(SingleRows&);

/// Places in fixed point: (low + n) unit [m] along each axis.
struct FixedFrame {
  double low[3], unit[3];
  bool fine;  ///< enough for pairs
};

/// A kernel as the loops need it.
struct KernelChoice {
  KernelName name;
  double support;  ///< in smoothing lengths
  double norm;
};
KernelChoice kernel_choice(KernelName kernel, int dimension);

/// Everything that the loop over pairs reads.
struct PairInput {
  PairChoice choice;  ///< gradients are then of slow or of fast particles only, among all neighbours
  int dimension;
  double kernel_scale;  ///< of the kernel's gradient: 1 over its lattice factor (kernels.hpp), or 1
  const double *x, *y, *z;
  const FluidRow* fluid;
  KernelChoice kernel;          ///< read by the loop that serves any kernel
  void* second;                 ///< what the pass reads beside `fluid`, or a pass before it writes: rows of its State's Second
  const RingRow* rings;         ///< read by passes over rings
  double shape_scale;           ///< of the kernel itself for these: 1 over its lattice's sum
  DeformationRow* deformation;  ///< what the solids' gradients write
  double artificial_stress, spacing;  ///< of the solids' forces
  double contact_damping;             ///< share of the acoustic impedance
  const GroupView* groups;            ///< of particles first, then of images
  int group_count;
  ImageInput images;
  SightInput sight;
  const double *wall_x, *wall_y, *wall_z;
  const WallRow* wall;  ///< sorted by cell of wall_grid
  CellGrid wall_grid;
  std::uint32_t wall_count;
  bool mirror[3];      ///< symmetry planes through the origin
  double gravity[3];   ///< by which a wall's dummy particles show the pressure of their own place [m/s^2]
  double alpha, beta;  ///< Monaghan's viscosity; with a switch, alpha's upper bound and the beta there
  bool partly;         ///< only clusters within `margin` of the box are worked on
  double disturbed_low[3], disturbed_high[3], margin;  ///< [m]
  const Cluster* clusters;                             ///< sorted by block
  const Block* blocks;                                 ///< thread by thread, in the order of work
  std::uint32_t block_count;
  const std::uint32_t* waits;  ///< places in `blocks`
  BlockQueue* queue;           ///< of the blocks
  Scratch* scratch;            ///< one per thread
  SingleRows* single;          ///< of particles and of images, for the loops' own use
  FixedFrame* frame;           ///< theirs
};

/// Sums of the loop, zero before it.
struct PairOutput {
  SumRow* fluid;
  ForceRow* wall;           ///< null where nobody asks for it
  SumRow* images;           ///< what they receive, for their owners
  long long* interactions;  ///< true neighbours met (directed), one counter per block
};

/// A compiled loop over pairs, and the rows that it reads beside FluidRow.
using PairLoop = void (*)(const PairInput&, const PairOutput&);
struct CompiledLoop {
  PairLoop run;
  SecondRow second;
};

}  // namespace undex::sph
