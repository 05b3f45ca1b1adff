// The passes of solids over pairs of the present: stresses and forces of bodies in an updated Lagrangian description, and
// contact between bodies of either. Particles are copied into rows sorted by cell, and what they receive is copied back.
// Particles of updated bodies that touch a rigid plane, and those upon them, have images behind it (plane_contact.hpp), which
// are rows too. In the meridian of a body of revolution rows hold areas and radii (solid_rings.hpp), and each ring has a hoop of
// its own (solid_pairs_rings.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "sph_fluid/pairs/blocks.hpp"
#include "sph_fluid/pairs/pair_memory.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/pairs/pair_data.hpp"
#include "sph_solid/plane_contact.hpp"
#include "sph_solid/solid_loops.hpp"
#include "sph_solid/settings.hpp"
#include "sph_solid/solid_particles.hpp"

namespace undex::solid {

class SolidPairs {
 public:
  /// A body's particles.
  struct Range {
    std::uint32_t begin, end;
    double spacing, h;  ///< [m]
    bool updated;       ///< does it work with the pairs of the present?
    const Body* body;
  };
  SolidPairs(const Settings& settings, const sph::Settings& around, std::vector<Range> ranges);
  SolidPairs(const SolidPairs&) = delete;
  SolidPairs& operator=(const SolidPairs&) = delete;

  /// After a step dt [s] (zero: at the start): stresses of the updated bodies, and the forces on all. `acceleration`
  /// [m/s^2] predicts velocities for the viscosity.
  void add_forces(SolidParticles& particles, const std::vector<Vec3>& acceleration, double dt);

  std::size_t memory_bytes() const;

 private:
  void pack(const SolidParticles& particles);
  void find_images(const SolidParticles& particles);
  /// Images get the rows of their particles; afterwards what they have received goes to them.
  void fill_image_rows();
  void scatter_images();
  sph::PairInput input(const std::vector<sph::GroupView>& views);
  void run(void (*pass)(const sph::PairInput&, const sph::PairOutput&), const sph::PairInput& in);
  void update_stresses(SolidParticles& particles, double dt);
  void fill_rows(const SolidParticles& particles, const std::vector<Vec3>& acceleration, double dt);
  static double width_of_axis(double eta);
  double ring(const SolidParticles& particles, const Range& range, std::uint32_t i) const;
  /// Of rings of updated bodies; rows are those of the passes. Share of the hoop strain that is its own.
  double own_hoop(const SolidParticles& particles, const Range& range, std::uint32_t i) const;
  void add_hoop_strain(const SolidParticles& particles, const Range& range, std::uint32_t row);
  double hoop_stress(const Mat3& sigma, std::uint32_t row) const;
  void add_hoop_forces(SolidParticles& particles, const Range& range, std::uint32_t row) const;
  void find_contact(SolidParticles& particles, bool started);
  void write_back(SolidParticles& particles) const;

  const Settings& settings_;
  const sph::Settings& around_;
  SolidLoops loops_ = solid_loops(around_.axisymmetric);
  std::vector<Range> ranges_;
  std::vector<sph::CellList> cells_;
  std::vector<sph::GroupView> views_;          ///< with the h of the bodies' own pairs
  std::vector<sph::GroupView> contact_views_;  ///< and of contact
  sph::BlockOrder blocks_;
  bool updated_ = false;
  double axis_width_ = 0;                ///< at what radius half of the hoop strain is a ring's own, in spacings
  std::vector<std::uint32_t> particle_;  ///< of each row
  std::vector<double> x_, y_, z_;
  std::vector<sph::FluidRow> rows_;
  std::vector<sph::SolidRow> solid_;
  std::vector<sph::DeformationRow> deformation_;
  std::vector<sph::SumRow> sums_;
  struct Image {
    std::uint32_t row;  ///< of the particle that it shows
    unsigned axes;      ///< mirrored across which, a bit each
    Vec3 place;
  };
  std::vector<Image> images_;  ///< sorted by group and cell
  std::vector<std::vector<double>> image_place_;
  std::vector<sph::CellList> image_cells_;
  std::vector<sph::FluidRow> image_rows_;
  std::vector<sph::SolidRow> image_solid_;
  std::vector<sph::SumRow> image_sums_;
  std::vector<long long> interactions_;
  sph::PairMemory memory_;
};

}  // namespace undex::solid
