// Deforming bodies as one: their wet surfaces stand beside each other, each takes steps of its own to the common time. They push
// each other through the water alone, so a run ends where two of them meet.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/deformable_body.hpp"
#include "core/hexahedral_mesh.hpp"

namespace undex::coupling {

class BodyGroup : public WetBody {
 public:
  struct Member {
    std::string name;
    DeformableBody* body;  ///< of cells; must outlive the group
  };
  /// Of at least one member, all at the same time.
  explicit BodyGroup(std::vector<Member> members);

  double time() const override { return members_.front().body->time(); }
  /// Of the one that takes most.
  long steps() const override;
  /// The shortest of theirs.
  double stable_step() const override;
  std::string stable_step_owner() const override;
  /// Throws NumericalStop also where two have met.
  void advance(double t_end, std::span<const Vec3> impulse = {}) override;

  /// Nodes and faces of a member come after those of the member before it.
  const WetSurface& wet_surface() const override { return surface_; }
  /// "MEMBER.FACE".
  std::vector<NamedFaces> wet_faces() const override { return faces_; }
  std::vector<std::size_t> wet_walls() const override { return first_; }
  std::span<const Vec3> wet_positions() const override { return position_; }
  std::span<const Vec3> wet_velocities() const override { return velocity_; }
  std::span<const Vec3> wet_accelerations() const override { return acceleration_; }
  std::span<const double> wet_masses() const override { return mass_; }

  /// The sum of theirs.
  BodyLedger ledger() const override;

  const std::vector<Member>& members() const { return members_; }
  /// The impulse on the wet nodes of a member since the start [N s].
  const Vec3& received_by(std::size_t member) const { return received_[member]; }

  /// What is its own: the members are visited by who holds them.
  void visit_state(StateVisitor& state);

 private:
  struct Pair {
    std::size_t one, other;
    double least;   ///< distance that they may have: at the start, or a share of a cell within each other [m]
    double margin;  ///< way that they may go before it is asked again how near they are [m]
  };
  /// How near two are [m], negative where one is in the other, and where.
  struct Gap {
    double distance = 1e300;
    Vec3 at = Vec3::Zero();
  };
  const Member& shortest() const;
  void show_wet_motion();
  Gap gap_between(const Pair& pair) const;
  void ask_again_after(Pair& pair, double distance) const;
  void expect_room();

  std::vector<Member> members_;
  std::vector<std::shared_ptr<HexahedralMesh>> meshes_;  // of each, the nodes where they were last asked for
  std::vector<double> thinnest_;                         // shortest edge of a cell of each, at the start [m]
  std::vector<Pair> pairs_;
  std::vector<std::vector<Vec3>> before_;  // positions before a step: scratch
  WetSurface surface_;
  std::vector<NamedFaces> faces_;
  std::vector<std::size_t> first_;  // wet node of each, and the count of all
  std::vector<Vec3> position_, velocity_, acceleration_;
  std::vector<double> mass_;
  std::vector<Vec3> received_;  // by each [N s]
};

}  // namespace undex::coupling
