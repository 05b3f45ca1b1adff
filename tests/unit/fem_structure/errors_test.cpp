// A user's mistakes are refused with the value and the remedy, several at once.
#include <gtest/gtest.h>

#include <functional>

#include "bodies.hpp"

namespace undex::fem::testing {
namespace {

std::string refusal(const Settings& settings) {
  try {
    Structure structure(settings);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void expect_parts(const std::string& text, std::initializer_list<const char*> parts) {
  EXPECT_FALSE(text.empty()) << "was not refused";
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

Settings good_tube() {
  Settings settings;
  settings.name = "pipe";
  settings.mesh = TubeMesh{.axis = 2,
                           .center = Vec3::Zero(),
                           .inner_radius = 0.04,
                           .outer_radius = 0.05,
                           .low = -0.1,
                           .high = 0.1,
                           .cells_through = 2,
                           .cells_around = 16,
                           .cells_along = 4};
  settings.material = elastic(2700, 71e9, 0.33);
  return settings;
}

std::string refused_tube(const std::function<void(TubeMesh&)>& spoil, std::vector<int> symmetry_axes = {}) {
  Settings settings = good_tube();
  settings.symmetry_axes = std::move(symmetry_axes);
  spoil(std::get<TubeMesh>(settings.mesh));
  return refusal(settings);
}

TEST(Errors, GoodTubeIsAccepted) { EXPECT_EQ(refusal(good_tube()), ""); }

TEST(Errors, TubeGeometry) {
  expect_parts(refused_tube([](TubeMesh& m) { m.outer_radius = 0.03; }), {"pipe", "outer radius = 0.03", "0.04"});
  expect_parts(refused_tube([](TubeMesh& m) { m.inner_radius = 0.0; }), {"inner radius = 0", "rod"});
  expect_parts(refused_tube([](TubeMesh& m) { m.inner_radius = -1.0; }), {"inner radius = -1"});
  expect_parts(refused_tube([](TubeMesh& m) { m.cells_through = -2; }), {"cells_through = -2", "at least 1"});
  expect_parts(refused_tube([](TubeMesh& m) { m.cells_around = 30; }), {"cells_around = 30", "multiple of 4"});
  expect_parts(refused_tube([](TubeMesh& m) { m.high = -0.2; }), {"-0.2", "below the upper"});
  expect_parts(refused_tube([](TubeMesh& m) { m.high = std::nan(""); }), {"nan"});
  expect_parts(refused_tube([](TubeMesh& m) { m.axis = 3; }), {"axis 3", "0, 1 or 2"});
  // All at once.
  expect_parts(refused_tube([](TubeMesh& m) { m.outer_radius = 0.03, m.cells_around = 30, m.cells_along = 0; }),
               {"outer radius", "cells_around", "cells_along", "\n"});
}

TEST(Errors, SymmetryPlanes) {
  expect_parts(refused_tube([](TubeMesh& m) { m.low = -0.08; }, {2}), {"-0.08", "symmetric", "low = -high"});
  expect_parts(refused_tube([](TubeMesh& m) { m.cells_along = 5; }, {2}), {"cells_along = 5", "even"});
  expect_parts(refused_tube([](TubeMesh& m) { m.center[0] = 0.01; }, {0}), {"x = 0.01", "center"});
  expect_parts(refused_tube([](TubeMesh&) {}, {5}), {"symmetry axis 5"});
  expect_parts(refused_tube([](TubeMesh& m) { m.low = -0.4, m.high = -0.1; }, {2}), {"keeps nothing"});
}

TEST(Errors, UnknownFacesListTheKnownOnes) {
  Settings settings = good_tube();
  settings.wet_faces = {"inside"};
  settings.supports = {{"bottom", {true, true, true}}};
  settings.loads = {{"inward", {0.0}, {1.0}}};
  expect_parts(refusal(settings), {"inside", "bottom", "inward", "high, inner, low, outer"});
  settings = good_tube();
  settings.symmetry_axes = {2};
  settings.supports = {{"low", {true, true, true}}};
  expect_parts(refusal(settings), {"'low'", "high, inner, outer"});
}

TEST(Errors, RodAndPlate) {
  Settings settings = good_tube();
  settings.mesh =
      RodMesh{.axis = 2, .center = Vec3::Zero(), .radius = -0.01, .low = 0.0, .high = 1.0, .cells_radial = 1, .cells_along = 4};
  expect_parts(refusal(settings), {"radius = -0.01", "cells_radial = 1"});
  settings.mesh = PlateMesh{Vec3(0, 0, 0), Vec3(1, -1, 1), {1, 1, 0}};
  expect_parts(refusal(settings), {"along y", "-1", "cells along z = 0"});
}

TEST(Errors, OtherSettings) {
  Settings settings = good_tube();
  settings.courant = 1.5;
  expect_parts(refusal(settings), {"courant = 1.5", "(0, 1]"});
  settings = good_tube();
  settings.linear_viscosity = -0.1;
  expect_parts(refusal(settings), {"-0.1"});
  settings = good_tube();
  settings.material.rho0 = 0.0;
  expect_parts(refusal(settings), {"density 0"});
  settings = good_tube();
  settings.loads = {{"inner", {0.0, 1.0, 1.0}, {1.0, 2.0, 3.0}}};
  expect_parts(refusal(settings), {"inner", "increase"});
  settings.loads = {{"inner", {0.0, 1.0}, {1.0}}};
  expect_parts(refusal(settings), {"2 times and 1 pressures"});
}

TEST(Errors, WrongAdvances) {
  Settings settings = good_tube();
  settings.wet_faces = {"inner"};
  Structure structure(settings);
  const std::vector<Vec3> few(3, Vec3::Zero());
  EXPECT_THROW(structure.advance(1e-6, few), std::invalid_argument);
  EXPECT_THROW(structure.advance(0.0, {}), std::invalid_argument);
  EXPECT_THROW(structure.advance(std::nan(""), {}), std::invalid_argument);
  EXPECT_NO_THROW(structure.advance(1e-6, {}));
}

}  // namespace
}  // namespace undex::fem::testing
