// Plain data that the pair loops read and write. Nothing here may instantiate library templates: the loops are compiled
// several times, for several instruction sets, and only this header and kernels.hpp are shared with the rest.
#pragma once

#include <cstdint>

namespace undex::sph {

/// What a pair needs to know of a particle, in one piece of memory. Also the form in which a mirrored image is made.
struct alignas(32) PackedParticle {
  double x, y, z;       ///< [m]
  double vx, vy, vz;    ///< velocity predicted for this evaluation [m/s]
  double p, rho, c, V;  ///< pressure [Pa], density, sound speed, volume m/rho [m^3]
  double h;             ///< smoothing length [m]
  double gas;           ///< 1: bubble gas or detonation products, 0: liquid
};

/// Limited reconstruction's raw material: gradients of velocity (its symmetric part, all that the component along a pair
/// needs: xx, yy, zz, xy, yz, zx) [1/s] and of pressure [Pa/m]. Single precision: they only shape a correction.
struct alignas(16) PackedGradient {
  float strain[6];
  float pressure[3];
  float spare[3];
};

/// A dummy particle of a wall.
struct alignas(32) PackedWall {
  double x, y, z;
  double vx, vy, vz;
  double nx, ny, nz;   ///< unit normal, away from the fluid; behind an edge, the edge's direction
  double V;            ///< [m^3]
  double slip;         ///< 1: free slip; 0: no slip, or a free-slip corner (nothing slips there); -1: a free-slip edge
  double spare;
};

/// Cells over one range of particles. Rows run along x; a row's cells are a quarter as long as wide, so that the run of
/// candidates within reach is found from `start` alone.
struct CellGrid {
  double low[3];            ///< lower corner [m]
  double size[3];           ///< cell edge along x, y, z [m]
  double bound_low[3], bound_high[3];  ///< box of the particles themselves
  int count[3];             ///< cells along x, y, z
  const std::uint32_t* start;  ///< count[0]*count[1]*count[2] + 1 entries; first particle of each cell, x fastest
};

/// Particles that share a material and a policy for the smoothing length; contiguous, sorted by cell.
struct GroupView {
  std::uint32_t begin, end;
  CellGrid grid;
  double h_max;             ///< [m]
  bool variable_h;
};

/// Up to `lanes` consecutive particles of one row of cells: the unit of work of a pair loop.
struct Cluster {
  std::uint32_t begin;
  std::uint16_t count;
  std::uint16_t group;
};

/// Buffers of one thread, grown on demand by grow().
struct Scratch {
  PackedParticle* near = nullptr;      ///< candidates with the same constant h
  PackedParticle* variable = nullptr;  ///< candidates of pairs whose h varies
  PackedGradient* near_gradient = nullptr;      ///< theirs, where the scheme wants them; same capacities
  PackedGradient* variable_gradient = nullptr;
  PackedWall* wall = nullptr;
  std::uint32_t* index = nullptr;
  std::uint32_t near_capacity = 0, variable_capacity = 0, wall_capacity = 0, index_capacity = 0;
};
void grow_near(Scratch&, std::uint32_t needed);
void grow_variable(Scratch&, std::uint32_t needed);
void grow_wall(Scratch&, std::uint32_t needed);
void grow_index(Scratch&, std::uint32_t needed);

/// Everything that the loop over pairs reads.
struct PairInput {
  int dimension;
  const double *x, *y, *z;             ///< positions again, for the search
  const PackedParticle* packed;
  const GroupView* groups;
  int group_count;
  const PackedWall* walls;             ///< sorted by cell of wall_grid
  const double *wall_x, *wall_y, *wall_z;
  CellGrid wall_grid;
  std::uint32_t wall_count;
  bool mirror[3];                      ///< symmetry planes through the origin
  double alpha, beta;                  ///< Monaghan's viscosity
  PackedGradient* gradients;           ///< per particle; null where the scheme has no use for them
  const Cluster* clusters;
  std::uint32_t cluster_count;
  Scratch* scratch;                    ///< one per thread
};

/// Rates of the fluid, per particle.
struct FluidRates {
  double *ax, *ay, *az;     ///< acceleration [m/s^2]
  double* compression;      ///< (d rho/dt)/rho [1/s]
  double* heat;             ///< viscous heating [W/kg]
  double* closing;          ///< largest speed of approach to a neighbour, as the scheme's step limit wants it [m/s]
  long long* interactions;  ///< one counter per cluster
};

/// Forces on wall particles, in the order of PairInput::walls.
struct WallForces {
  double *fx, *fy, *fz;     ///< [N]
};

}  // namespace undex::sph
