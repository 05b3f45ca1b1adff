// A step that goes wrong is not taken: what both integrators that go back to the step's start are tested by.
#pragma once

#include "core/errors.hpp"
#include "scenes.hpp"

namespace undex::sph::testing {

/// A moving wall of four particles in one dimension, 0.05 m apart, behind the face at `face` [m]; `side` is its normal, +1 or -1.
inline LinedWall layers_beyond(double face, double side, double velocity) {
  LinedWall wall;
  for (int k = 0; k < 4; ++k) wall.position.push_back(Vec3(face + side * 0.05 * (k + 0.5), 0, 0));
  wall.velocity.assign(4, Vec3(velocity, 0, 0));
  wall.normal.assign(4, Vec3(side, 0, 0));
  wall.volume.assign(4, 0.05);
  return wall;
}

/// Is a step of dt [s] refused? All fields are finite afterwards, and after a refusal everything is as it was, to the last digit.
inline bool refuses(Fluid& fluid, LinedIndex wall, double dt) {
  const std::vector<Vec3> x = by_id(fluid, "position"), v = by_id(fluid, "velocity"), impulse = fluid.wall(wall).impulse;
  const Ledger before = fluid.ledger();
  const double time = fluid.time();
  const long steps = fluid.steps();
  bool refused = false;
  try {
    fluid.step(dt);
  } catch (const NumericalStop& stop) {
    refused = true;
    EXPECT_NE(std::string(stop.what()).find("particle"), std::string::npos) << stop.what();
  }
  for (const char* name : {"position", "velocity", "density", "pressure", "sound_speed", "void_fraction", "smoothing_length"})
    for (const double value : fluid.field(name)) EXPECT_TRUE(std::isfinite(value)) << name << " " << dt;
  if (!refused) return false;
  EXPECT_EQ(by_id(fluid, "position"), x) << dt;
  EXPECT_EQ(by_id(fluid, "velocity"), v) << dt;
  EXPECT_EQ(fluid.wall(wall).impulse, impulse);
  EXPECT_EQ(fluid.time(), time);
  EXPECT_EQ(fluid.steps(), steps);
  EXPECT_EQ(fluid.ledger().dissipated, before.dissipated);
  EXPECT_EQ(fluid.ledger().wall_work, before.wall_work);
  EXPECT_DOUBLE_EQ(fluid.ledger().internal, before.internal);
  return true;
}

}  // namespace undex::sph::testing
