// The solids' passes over pairs, compiled once per instruction set; see solid_loops.hpp for the choice at start-up.
#include "sph_fluid/pairs/cluster_work.hpp"
#include "sph_solid/solid_rings.hpp"

namespace undex::solid::UNDEX_LEVEL {

void solid_deformation(const PairInput& in, const PairOutput& out) { pass<WendlandC2, VelocityGradient, double>(in, out); }
void solid_forces(const PairInput& in, const PairOutput& out) { pass<WendlandC2, SolidForces, double>(in, out); }
void ring_deformation(const PairInput& in, const PairOutput& out) { pass<WendlandC2, GradientOfRings, double>(in, out); }
void ring_forces(const PairInput& in, const PairOutput& out) { pass<WendlandC2, ForcesOfRings, double>(in, out); }
void contact_overlap(const PairInput& in, const PairOutput& out) { pass<WendlandC2, ContactOverlap, double>(in, out); }
void contact_forces(const PairInput& in, const PairOutput& out) { pass<WendlandC2, ContactForces, double>(in, out); }

}  // namespace undex::solid::UNDEX_LEVEL
