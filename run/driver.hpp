// Who decides on a step, takes it and says what set it: the water alone, a body alone, water and a body coupled by its wet faces,
// or water and particles of solids as one system. The water is that of a Flow: rigid bodies in it move with it, whoever drives.
#pragma once

#include <optional>
#include <string>

#include "coupling/coupler.hpp"
#include "coupling/particle_system.hpp"

namespace undex::run {

/// The last step: its size [s], and what it was and what set it, in one phrase.
struct Step {
  double size = 0;
  std::string words = "-";
};

class Driver {
 public:
  virtual ~Driver() = default;
  /// One step (a coupling window), not beyond `end` [s].
  virtual Step advance(double end) = 0;
  /// What has crossed the wet faces; nothing where nothing is coupled by them.
  virtual std::optional<coupling::InterfaceLedger> interface() const { return std::nullopt; }
  /// The same of each named face; null where nothing is coupled by faces that have names.
  virtual const coupling::FaceImpulses* on_faces() const { return nullptr; }
  virtual PassTimers timers() const { return {}; }  ///< its own
  virtual void visit_state(StateVisitor&) {}        ///< its own, beside that of those whom it advances
};

class WaterAlone : public Driver {
 public:
  explicit WaterAlone(coupling::Flow& flow) : flow_(flow) {}
  Step advance(double end) override;

 private:
  coupling::Flow& flow_;
};

class BodyAlone : public Driver {
 public:
  /// `of_particles`: a particle sets the step, and is named.
  BodyAlone(WetBody& body, bool of_particles) : body_(body), of_particles_(of_particles) {}
  Step advance(double end) override;

 private:
  WetBody& body_;
  bool of_particles_;
};

class Coupled : public Driver {
 public:
  Coupled(coupling::Flow& flow, WetBody& body, const coupling::Settings& settings) : coupler_(flow, body, settings) {}
  Step advance(double end) override;
  std::optional<coupling::InterfaceLedger> interface() const override { return coupler_.ledger(); }
  const coupling::FaceImpulses* on_faces() const override { return &coupler_.on_faces(); }
  PassTimers timers() const override { return coupler_.timers(); }
  void visit_state(StateVisitor& state) override { coupler_.visit_state(state); }

 private:
  coupling::Coupler coupler_;
};

class OneSystem : public Driver {
 public:
  OneSystem(coupling::Flow& flow, solid::Solids& solids, const coupling::Settings& settings) : system_(flow, solids, settings) {}
  Step advance(double end) override;
  std::optional<coupling::InterfaceLedger> interface() const override { return system_.ledger(); }
  void visit_state(StateVisitor& state) override { system_.visit_state(state); }

 private:
  coupling::ParticleSystem system_;
};

}  // namespace undex::run
