// The particles of a simulation's fluid at one moment, read as fields in space: which body is at a place, and its mean state over
// a width. Sums over Wendland's kernel (C2), at h = 1.2 spacings of the particles (as probes read them) or, where the width is
// larger, at that whose variance is that of a cell so wide. States are moving least squares of first order
// (docs/theory/equations.md, section 15), within the range of the neighbours: uniform fields and linear ones come back as they
// are.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/meridian.hpp"
#include "run/simulation.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// What a body has [kg], [kg m/s], [J]: of all of it, mirror images included. Internal: compression energy where the law is
/// barotropic.
struct BodyTotals {
  double mass = 0, kinetic = 0, internal = 0;
  Vec3 momentum = Vec3::Zero();
};

/// Distance of a place in space [m] to something; it changes by at most the way between two places.
using Distance = std::function<double(const Vec3&)>;

class ParticleState {
 public:
  /// Of the simulation as it is now, to be read over widths up to `widest` [m]. `start` has the particles' places at its start,
  /// as `places_of` gives them. Particles count as moved where pressure has changed by more than `threshold` [Pa] or the signal
  /// of that has passed.
  ParticleState(const scene::Scene& scene, const Simulation& simulation, const std::vector<Vec3>& start, double threshold,
                double widest);

  /// Where the fluid's particles are, in the solver's frame, in the order of their numbers.
  static std::vector<Vec3> places_of(const Simulation& simulation);

  const BodyTotals& totals(std::size_t body) const { return totals_[body]; }
  /// Has anything of the body moved?
  bool has_moved(std::size_t body) const { return bodies_[body].moved; }

  /// The body with the largest share of the volume at a place in space; nothing where there is hardly any of them. `still`:
  /// nobody within reach has moved.
  struct Owner {
    std::optional<std::size_t> body;
    bool still = true;
  };
  Owner owner_at(const Vec3& x) const;

  /// The mean state of a body about a place in space, over a width [m]; `at_rest` where it has no particle near.
  sph::StartState state(std::size_t body, const Vec3& x, double width, const sph::StartState& at_rest) const;

  /// The least distance [m] of what has moved to something.
  double clearance(const Distance& distance) const;

 private:
  struct Particle {
    Vec3 x, v;                   // in the solver's frame
    double volume, rho, energy;  // [m^d], [kg/m^3], [J/kg]
    double h;                    // [m]
    bool moved, image;
  };
  /// Those of a body, images in planes of symmetry included, sorted by cells.
  struct Body {
    std::vector<Particle> particles;
    std::vector<std::size_t> first;  // of each cell, and the end
    Vec3 low = Vec3::Zero();
    double cell = 1;
    int count[3] = {1, 1, 1};
    double reach = 0;
    bool moved = false;

    void sort();
    template <class Visit>
    void around(const Vec3& x, double width, Visit visit) const;
  };
  /// A place in space as one of the solver's frame, on the kept side of its planes.
  struct Place {
    Vec3 x;
    Vec3 outward;  // of a meridian
    bool mirrored[3] = {false, false, false};
  };
  Place place_of(const Vec3& x) const;

  int dimension_;
  std::optional<Meridian> meridian_;
  std::array<bool, 3> planes_{};  // of the solver's frame
  double spacing_;
  std::vector<Body> bodies_;
  std::vector<BodyTotals> totals_;
};

}  // namespace undex::run
