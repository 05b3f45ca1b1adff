// [[obstacles]]: what a scene may say of rigid bodies in the water.
#include <gtest/gtest.h>

#include "scratch.hpp"

namespace undex::scene::test {
namespace {

const std::string start = "end_time = 1e-4\n[resolution]\nspacing = 0.01\n";
const std::string water =
    "[[bodies]]\nname = \"water\"\nshape = {type = \"box\", low = [0, 0, 0], high = [0.4, 0.4, 0.4]}\nmaterial = "
    "\"water-tait\"\n";
const std::string ball = "[[obstacles]]\nname = \"ball\"\nshape = {type = \"sphere\", center = [0.2, 0.2, 0.2], radius = 0.06}\n";

TEST(Obstacles, TheWaterLeavesRoomForThemOnce) {
  const Scene scene = read_text(start + water + ball + "motion = \"free\"\ndensity = 500\nfixed = [\"x\", \"rx\"]\n");
  ASSERT_EQ(scene.obstacles.size(), 1u);
  EXPECT_EQ(scene.obstacles[0].motion, coupling::Motion::free);
  ASSERT_EQ(scene.fluid.bodies[0].shape.removed.size(), 1u);
  const std::string text = to_toml(scene);
  const Scene again = read_text(text);
  EXPECT_EQ(again.fluid.bodies[0].shape.removed.size(), 1u);
  EXPECT_EQ(to_toml(again), text);
  // A piston beside the water takes no room.
  const Scene piston =
      read_text(start + water +
                "[[obstacles]]\nname = \"piston\"\nshape = {type = \"box\", low = [-0.1, 0, 0], high = [0, 0.4, 0.4]}\n"
                "motion = \"prescribed\"\ntime = [0]\nspeed = [10]\ndirection = [1, 0, 0]\n");
  EXPECT_TRUE(piston.fluid.bodies[0].shape.removed.empty());
}

TEST(Obstacles, MistakesHaveRemedies) {
  struct {
    std::string scene, expected;
  } const all[] = {
      {water + ball + "condition = \"no_slip\"\n", "is not built for obstacles"},
      {water + ball + "density = 500\n", "obstacles.ball.density is of a \"free\" body"},
      {water + ball + "speed = [1]\n", "obstacles.ball.speed is of a \"prescribed\" body"},
      {water + ball + "motion = \"free\"\n", "needs its density or its mass"},
      {water + ball + "motion = \"free\"\nmass = 1\ndensity = 500\n", "needs its density or its mass, one of them"},
      {water + ball + "motion = \"free\"\ndensity = 5\n", "less than a hundredth of that of bodies.water"},
      {water + ball + "motion = \"free\"\ndensity = 500\ninertia = [1, 1, 3]\n", "no body has these moments"},
      {water + ball + "motion = \"free\"\ndensity = 500\ninertia = [1, 1]\n", "has 2 values; it needs three"},
      {water + ball + "motion = \"free\"\ndensity = 500\nfixed = [\"w\"]\n", "'w' is none of"},
      {water + ball + "motion = \"free\"\ndensity = 500\nfixed = [\"x\"]\nvelocity = [1, 0, 0]\n", "which `fixed` holds"},
      {water + ball + "motion = \"prescribed\"\n", "needs speed, time and direction"},
      {water + ball + "motion = \"prescribed\"\ntime = [0, 1]\nspeed = [1]\ndirection = [1, 0, 0]\n", "give as many of each"},
      {water + ball + "motion = \"prescribed\"\ntime = [1, 0]\nspeed = [1, 1]\ndirection = [1, 0, 0]\n", "time must increase"},
      {water + ball + "motion = \"prescribed\"\ntime = [0]\nspeed = [1]\n", "direction is needed with speed"},
      {ball, "obstacles without [[bodies]]"},
      {"[scheme]\nname = \"paper\"\n" + water + ball, "seen as mirrors"},
      {water + ball + "[[probes]]\nname = \"ball\"\npoint = [0.1, 0.1, 0.1]\n", "a probe has the same name"},
      {water + ball + ball, "is used twice"},
      {water + with(ball, "[0.2, 0.2, 0.2]", "[0.2, 0.2, 2]"), "touches no water"},
      {water + with(ball, "0.06", "60"),
       "obstacles.ball is 120 m long, 300 times as long as all bodies of fluid together: is it in millimetres?"},
      {water + "[[obstacles]]\nname = \"rod\"\nshape = {type = \"box\", low = [-60, 0, 0], high = [0, 0.4, 0.4]}\n",
       "is it in millimetres?"},
      {water + ball + "[start]\nkind = \"plane_wave\"\naxis = \"z\"\nfront = 0.2\npeak = 1e6\ndecay = 1e-4\n",
       "behind start.front"},
      {water + ball + "motion = \"free\"\ndensity = 500\nvelocity = [1, 0, 0]\n[symmetry]\nplanes = [\"x\"]\n", ""},
      {with(water, "low = [0,", "low = [-0.4,") + with(ball, "[0.2,", "[0,") +
           "motion = \"free\"\ndensity = 500\nvelocity = [1, 0, 0]\n[symmetry]\nplanes = [\"x\"]\n",
       "is not its own mirror image"},
      {water + ball +
           "[[solids]]\nname = \"plate\"\nshape = {type = \"box\", low = [0, 0, 0.1], high = [0.4, 0.4, 0.2]}\n"
           "material = \"al-6061-t6\"\n",
       "overlaps solids.plate"},
  };
  for (const auto& each : all) {
    const std::string found = mistakes(start + each.scene);
    if (each.expected.empty()) EXPECT_EQ(found, "");
    else EXPECT_NE(found.find(each.expected), std::string::npos) << "gave:\n" << found << "expected:\n" << each.expected;
  }
}

TEST(Obstacles, OfRevolutionMoveAlongTheAxis) {
  const std::string round = "dimension = \"axisymmetric\"\naxis = \"z\"\n" + start +
                            "[[bodies]]\nname = \"water\"\nshape = {type = \"cylinder\", radius = 0.3, low = 0, high = 0.4}\n"
                            "material = \"water-tait\"\n" +
                            with(ball, "[0.2, 0.2, 0.2]", "[0, 0, 0.2]") + "motion = \"free\"\ndensity = 500\n";
  EXPECT_EQ(mistakes(round), "");
  EXPECT_NE(mistakes(round + "velocity = [1, 0, 0]\n").find("must be along the axis"), std::string::npos);
  EXPECT_NE(mistakes(round + "spin = [0, 0, 1]\n").find("nothing turns"), std::string::npos);
  EXPECT_NE(mistakes(with(round, "[0, 0, 0.2]", "[0.1, 0, 0.2]")).find("off the axis"), std::string::npos);
}

}  // namespace
}  // namespace undex::scene::test
