// The books of what water and a deforming body exchange.
#pragma once

#include <numeric>
#include <span>

#include "core/state.hpp"
#include "core/vector.hpp"

namespace undex::coupling {

/// What has crossed the interface since the start.
struct InterfaceLedger {
  Vec3 impulse_given = Vec3::Zero();     ///< by the fluid, summed over the wall's points [N s]
  Vec3 impulse_received = Vec3::Zero();  ///< by the body's nodes or particles [N s]
  double impulse_exchanged = 0;          ///< sum of the magnitudes over the wall's points and windows [N s]
  double work_given = 0;                 ///< by the fluid on the wall as it saw it move [J]
  double work_received = 0;              ///< by the body [J]

  void book_given(std::span<const Vec3> impulse) {
    impulse_given = std::accumulate(impulse.begin(), impulse.end(), impulse_given);
    for (const Vec3& one : impulse) impulse_exchanged += one.norm();
  }
  void book_received(std::span<const Vec3> impulse) {
    impulse_received = std::accumulate(impulse.begin(), impulse.end(), impulse_received);
  }

  /// Impulses alone: work is in the ledgers of water and body.
  void visit_state(StateVisitor& state) {
    state("impulse given", impulse_given);
    state("impulse received", impulse_received);
    state("impulse exchanged", impulse_exchanged);
  }
};

}  // namespace undex::coupling
