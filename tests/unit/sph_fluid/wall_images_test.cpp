// Slip walls as mirrors: what an exact mirror does, conservation whatever the wall's shape and motion, and who is put back.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scenes.hpp"
#include "sph_fluid/walls/wall_images.hpp"

namespace undex::sph::testing {
namespace {

constexpr SchemeName mirroring[] = {SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan,
                                    SchemeName::monaghan_switch};

void run(Fluid& fluid, int steps) {
  for (int k = 0; k < steps; ++k) fluid.step(0.5 * fluid.step_limit().step);
}

/// A wall's faces in the planes of symmetry do what the symmetry does, corners included.
TEST(WallImages, AreSymmetry) {
  for (const SchemeName scheme : mirroring) {
    const Vec3 high(0.35, 0.4, 0.45), hot(0.1, 0.1, 0.1);
    const auto fluid = [&](bool walled) {
      Settings settings;
      settings.numerics.scheme = scheme;
      settings.lattice.spacing = 0.05;
      settings.numerics.threads = 1;
      const double part = walled ? 0.0 : -1.0;
      const Box bubble{part * hot, hot};
      settings.bodies = {body("water", Shape{Box{part * high, high}, {bubble}}, "water-tait"),
                         body("bubble", Shape{bubble, {}}, "bubble-gas")};
      settings.bodies[1].variable_h = true;
      settings.symmetry.axis = {!walled, !walled, !walled};
      if (walled) settings.walls = {box_wall(Vec3::Zero(), high)};
      if (walled)
        for (const char* face : {"x_high", "y_high", "z_high"}) settings.walls[0].faces[face] = FaceCondition::open;
      return Fluid(settings);
    };
    Fluid mirrored = fluid(false), walled = fluid(true);
    ASSERT_EQ(mirrored.particle_count(), walled.particle_count());
    run(mirrored, 30);
    run(walled, 30);
    EXPECT_NEAR(mirrored.time(), walled.time(), 1e-9 * walled.time());
    const std::vector<Vec3> a = by_id(mirrored, "velocity"), b = by_id(walled, "velocity");
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      largest = std::max(largest, a[i].norm());
      apart = std::max(apart, (a[i] - b[i]).norm());
    }
    EXPECT_GT(largest, 100.0);
    // Gradients are in single precision, summed in another order.
    EXPECT_LT(apart, 1e-5 * largest) << int(scheme);
  }
}

/// A plane wave along slip walls is a wave in one dimension: nothing moves across, whatever the width of the column.
TEST(WallImages, LetAPlaneWavePass) {
  for (const double width : {0.05, 0.1, 0.4})
    for (const SchemeName scheme : mirroring) {
      Settings settings;
      settings.lattice.spacing = 0.05;
      settings.numerics.scheme = scheme;
      settings.numerics.threads = 1;
      const Vec3 high(2, width, width);
      settings.bodies = {body("left", box(Vec3::Zero(), Vec3(1, width, width)), "water-tait"),
                         body("right", box(Vec3(1, 0, 0), high), "water-tait")};
      settings.bodies[0].pressure = 1e9;
      settings.walls = {box_wall(Vec3::Zero(), high)};
      settings.symmetry.axis = {false, true, false};  // nearer to the wall than the kernel reaches
      Fluid column(settings);
      run(column, 60);
      double across = 0, along = 0;
      for (const Vec3& v : by_id(column, "velocity")) {
        across = std::max(across, std::hypot(v[1], v[2]));
        along = std::max(along, std::abs(v[0]));
      }
      EXPECT_GT(along, 100.0);
      EXPECT_LT(across, 1e-6 * along) << width << " " << int(scheme);
    }
}

/// A quarter of a tube's inside as a mesh, bulged, moving, with waves in it.
MirrorWall quarter_tube(double radius, double length, int around, int along) {
  MirrorWall wall;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i <= around; ++i) {
      const double angle = 0.5 * std::numbers::pi * i / around;
      wall.position.push_back(
          {i == around ? 0.0 : radius * std::cos(angle), i == 0 ? 0.0 : radius * std::sin(angle), length * j / along});
    }
  const auto node = [&](int i, int j) { return j * (around + 1) + i; };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) wall.faces.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  wall.velocity.assign(wall.position.size(), Vec3::Zero());
  return wall;
}

Settings tube_water(double dx, SchemeName scheme) {
  Settings settings;
  settings.numerics.scheme = scheme;
  settings.numerics.threads = 1;
  settings.lattice.spacing = dx;
  settings.lattice.jitter = 0.2;
  settings.lattice.type = LatticeType::rings;
  settings.lattice.fit = "water";
  settings.symmetry.axis = {true, true, false};
  settings.bodies = {body("water", Shape{Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = 0.5, .low = 0.0, .high = 0.4}, {}},
                          "water-tait")};
  settings.bodies[0].pressure = 2e8;
  return settings;
}

Vec3 sum(const std::vector<Vec3>& all) {
  Vec3 total = Vec3::Zero();
  for (const Vec3& one : all) total += one;
  return total;
}

/// A curved wall that moves unevenly: along z, where no symmetry plane takes momentum, what the fluid loses the wall has, and the
/// ledger's balance closes with the order of the step.
TEST(WallImages, MovingWallReceivesWhatTheFluidLoses) {
  for (const SchemeName scheme : mirroring) {
    double error[2];
    for (const int finer : {0, 1}) {
      Fluid fluid(tube_water(0.05, scheme));
      MirrorWall tube = quarter_tube(0.5, 0.4, 8, 6);
      const auto radial = [](const Vec3& x) { return Vec3(x[0], x[1], 0).normalized(); };
      for (std::size_t n = 0; n < tube.position.size(); ++n) {
        const Vec3 x = tube.position[n];
        tube.position[n] += (0.02 * std::cos(9 * x[2])) * radial(x);  // waves: normals with a part along z
        tube.velocity[n] = (20 + 30 * std::sin(7 * x[2])) * radial(x) + Vec3(0, 0, 5);
      }
      const auto index = fluid.add_wall(tube);
      const double dt = (finer ? 0.15 : 0.3) * fluid.step_limit().step;
      const Ledger start = fluid.ledger();
      const int steps = finer ? 20 : 10;
      for (int k = 0; k < steps; ++k) {
        MirrorWall& wall = fluid.wall(index);
        for (std::size_t n = 0; n < wall.position.size(); ++n) wall.position[n] += dt * wall.velocity[n];
        fluid.step(dt);
      }
      const Ledger end = fluid.ledger();
      const Vec3 received = sum(fluid.wall(index).impulse), gained = end.momentum - start.momentum;
      EXPECT_GT(std::abs(gained[2]), 1e-3 * received.norm());
      EXPECT_NEAR(received[2], -gained[2], 1e-11 * received.norm()) << int(scheme);
      EXPECT_NE(end.wall_work, 0.0);
      error[finer] = std::abs(total(end) - total(start)) / std::abs(end.wall_work - start.wall_work);
    }
    RecordProperty("error " + std::to_string(int(scheme)), std::to_string(error[0]) + " " + std::to_string(error[1]));
    EXPECT_LT(error[0], 2e-2);
    EXPECT_LT(error[1], 0.6 * error[0]);
  }
}

/// Images in a fine mesh are those in the cylinder: at 2 R - r, their volume by 3/4 of the power of the ratio of space, (2 R -
/// r)/r.
TEST(WallImages, InAMeshAreThoseInTheCylinder) {
  double previous = 0;
  for (const int around : {8, 16, 32}) {
    const Settings settings = tube_water(0.05, SchemeName::riemann);
    const MirrorWall tube = quarter_tube(0.5, 0.4, around, 6);
    const double r = 0.43;
    const int count = 60;
    Particles particles;
    particles.resize(count, false);
    particles.make_room(SecondRow::none, 1.0, false);
    for (int i = 0; i < count; ++i) {
      const double angle = 0.5 * std::numbers::pi * (i + 0.5) / count;
      particles.x[i] = r * std::cos(angle);
      particles.y[i] = r * std::sin(angle);
      particles.z[i] = 0.17;
    }
    CellList cells;
    cells.build(particles.x.data(), particles.y.data(), particles.z.data(), 0, count, 0.1);
    particles.permute(0, cells.order());
    for (FluidRow& row : particles.predicted)
      row = FluidRow{.vx = 3, .vy = 4, .vz = 5, .p = 7, .volume = 2, .rho = 1000, .c = 1500, .h = 0.06};
    const ParticleRange range{.first = 0, .last = std::uint32_t(count), .cells = &cells, .width = 0.1, .depth = 0.12};
    WallImages images;
    images.build(settings, {}, {tube}, particles, {&range, 1}, 0.12);
    images.reflect_rows(particles, Vec3::Zero());
    ASSERT_EQ(images.size(), std::size_t(count)) << "one each, on the edges of faces too";
    PairInput in{};
    images.describe(in);
    double place = 0, stretch = 0;
    for (int i = 0; i < count; ++i) {
      const FluidRow& row = in.images.fluid[i];
      place = std::max(place, std::abs(std::hypot(in.images.x[i], in.images.y[i]) - (1.0 - r)));
      stretch = std::max(stretch, std::abs(0.5 * row.volume / std::pow((1.0 - r) / r, 0.75) - 1.0));
      EXPECT_NEAR(in.images.z[i], 0.17, 1e-9);
      EXPECT_NEAR(std::hypot(row.vx, row.vy), 5.0, 1e-9);
      EXPECT_NEAR(row.vz, 5.0, 1e-9);
      EXPECT_EQ(row.p, 7.0);
    }
    // Chords of a circle: second order.
    if (previous > 0) {
      EXPECT_NEAR(previous / place, 4.0, 0.5);
    }
    previous = place;
    EXPECT_LT(place, 1.5 * 2.0 * 0.5 * (1.0 - std::cos(0.25 * std::numbers::pi / around)));
    EXPECT_LT(stretch, 0.02 * 8 / around);
  }
}

/// Uniform pressure presses a round wall with pressure times area: to 0.1 dx/R (stretched as space is, volumes give 0.25 dx/R).
TEST(WallImages, RoundWallFeelsThePressure) {
  for (const double dx : {0.05, 0.025}) {
    Settings settings = tube_water(dx, SchemeName::riemann);
    settings.lattice.jitter = 0;
    Wall ends;
    ends.name = "ends";
    ends.container = Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = 0.5, .low = 0.0, .high = 0.4};
    ends.faces = {{"side", FaceCondition::open}, {"low", FaceCondition::free_slip}, {"high", FaceCondition::free_slip}};
    settings.walls = {ends};
    Fluid fluid(settings);
    const MirrorWall tube = quarter_tube(0.5, 0.4, 64, 16);
    const auto index = fluid.add_wall(tube);
    fluid.step_limit();
    fluid.step(1e-12);
    double pressed = 0;
    for (std::size_t n = 0; n < tube.position.size(); ++n) {
      const Vec3& x = tube.position[n];
      pressed += fluid.wall_force(index)[n].dot(Vec3(x[0], x[1], 0).normalized());
    }
    const double area = 0.5 * std::numbers::pi * 0.5 * 0.4, excess = pressed / (area * 2e8) - 1.0;
    RecordProperty("excess", std::to_string(excess));
    EXPECT_LT(std::abs(excess), 0.12 * dx / 0.5) << dx;
  }
}

/// The images in a cone's side and end fill the space behind their edge once, whatever the angle: about an edge of theta each
/// place has 360/theta - 1 images in the mean, as far from the edge as itself, and none where the fluid is.
TEST(WallImages, FillTheSpaceBehindTheEdgesOfACone) {
  for (const double widening : {-0.8, -0.3, 0.4, 1.0}) {
    const Cone cone{.axis = 1, .center = Vec3::Zero(), .low_radius = 2.0, .high_radius = 2.0 + widening, .low = 0, .high = 1};
    Settings settings;
    settings.dimension = 2;
    Wall wall;
    wall.name = "cone";
    wall.container = cone;
    settings.walls = {wall};
    const SlipFaces faces = slip_faces(settings);
    ASSERT_EQ(faces.round.size(), 1u);
    ASSERT_EQ(faces.round[0].ends, 0);
    for (const bool high : {false, true}) {
      const Vec3 edge(high ? cone.high_radius : cone.low_radius, high ? 1.0 : 0.0, 0.0);
      const double theta = 0.5 * std::numbers::pi + (high ? -1 : 1) * std::atan(widening);
      int images = 0;
      constexpr int places = 4000;
      for (int k = 0; k < places; ++k) {
        const double turn = theta * (k + 0.5) / places, r = 0.3 * (1 + k % 7) / 7.0;  // from the end to the side
        const Vec3 x = edge + r * Vec3(-std::cos(turn), (high ? -1 : 1) * std::sin(turn), 0.0);
        ASSERT_LT(signed_distance(Primitive(cone), x, 2), 0.0);
        int number = 0;
        images_about(faces.round[0], faces.plane[0], x, 0.5, 2, [&](const Reflection& image, const Vec3&, int) {
          EXPECT_NEAR((image.place - edge).norm(), r, 1e-12);
          EXPECT_GT(signed_distance(Primitive(cone), image.place, 2), -1e-12);
          EXPECT_EQ(image.stretch, 1.0);
          ++images;
          return number++;
        });
      }
      EXPECT_NEAR(double(images) / places, 2 * std::numbers::pi / theta - 1.0, 2e-3) << widening << (high ? " high" : " low");
    }
  }
}

/// In space the image lies as far behind the side of a cone, and its volume is that of the wider ring to the power 3/4.
TEST(WallImages, InTheSideOfACone) {
  Settings settings;
  Wall wall;
  wall.name = "cone";
  wall.container = Cone{.axis = 2, .center = Vec3(1, 0, 0), .low_radius = 1, .high_radius = 4, .low = 0, .high = 4};  // 3, 4, 5
  settings.walls = {wall};
  const SlipFaces faces = slip_faces(settings);
  const Vec3 foot = Vec3(1, 2.5, 2.0), normal(0, 0.8, -0.6);
  const auto image = image_in(faces.round[0], foot - 0.25 * normal, 0.5, 3);
  ASSERT_TRUE(image);
  EXPECT_LT((image->place - (foot + 0.25 * normal)).norm(), 1e-14);
  EXPECT_LT((image->normal - normal).norm(), 1e-14);
  EXPECT_NEAR(image->stretch, std::pow(2.7 / 2.3, 0.75), 1e-14);
  const auto crossed = crossing(faces.round[0], foot + 0.25 * normal, 0.5);
  ASSERT_TRUE(crossed);
  EXPECT_LT((crossed->place - (foot - 0.25 * normal)).norm(), 1e-14);
  EXPECT_LT((crossed->foot - foot).norm(), 1e-14);
  EXPECT_FALSE(crossing(faces.round[0], foot - 0.01 * normal, 0.5));
  Bounds box;
  box.include(foot - 0.25 * normal);
  EXPECT_LE(clearance(faces, box), 0.25 + 1e-14);
}

/// A particle that is thrown through a moving wall comes back, and nothing is lost.
TEST(WallImages, PutBackWhoCrossed) {
  Settings settings = tube_water(0.05, SchemeName::riemann);
  settings.bodies[0].velocity = Vec3(0, 0, 3);
  Fluid fluid(settings);
  MirrorWall tube = quarter_tube(0.5, 0.4, 8, 6);
  const auto index = fluid.add_wall(tube);
  fluid.step_limit();
  // The wall jumps inwards over the outermost particles.
  const Ledger start = fluid.ledger();
  for (Vec3& x : fluid.wall(index).position) x -= 0.03 * Vec3(x[0], x[1], 0).normalized();
  for (Vec3& v : fluid.wall(index).velocity) v = Vec3(0, 0, 0);
  fluid.step(1e-7);
  for (const Vec3& x : by_id(fluid, "position")) EXPECT_LT(std::hypot(x[0], x[1]), 0.4701);
  const Ledger end = fluid.ledger();
  const Vec3 received = sum(fluid.wall(index).impulse);
  EXPECT_NEAR(end.momentum[2] - start.momentum[2], -received[2], 1e-11 * received.norm());
}

/// Rigid round walls too, and no image is made in open or sticking faces.
TEST(WallImages, OfRigidContainers) {
  Settings settings = tube_water(0.05, SchemeName::riemann);
  Wall wall;
  wall.name = "tank";
  wall.container = Cylinder{.axis = 2, .center = Vec3::Zero(), .radius = 0.5, .low = 0.0, .high = 0.4};
  wall.faces = {{"side", FaceCondition::free_slip}, {"low", FaceCondition::open}, {"high", FaceCondition::no_slip}};
  settings.walls = {wall};
  const SlipFaces faces = slip_faces(settings);
  EXPECT_EQ(faces.round.size(), 1u);
  EXPECT_TRUE(faces.plane.empty());
  settings.walls[0].faces["high"] = FaceCondition::free_slip;
  ASSERT_EQ(slip_faces(settings).plane.size(), 1u);
  EXPECT_LT(slip_faces(settings).plane[0].low, -1e299);
  settings.symmetry.axis[2] = true;
  EXPECT_TRUE(slip_faces(settings).plane[0].symmetric);
  EXPECT_EQ(slip_faces(settings).plane[0].low, 0.0);
  settings.symmetry.axis[2] = false;
  EXPECT_EQ(slip_faces(settings).plane[0].high, 0.4);
  settings.numerics.scheme = SchemeName::paper;
  EXPECT_TRUE(slip_faces(settings).round.empty());

  settings.numerics.scheme = SchemeName::riemann;
  settings.walls[0].faces["low"] = FaceCondition::free_slip;
  settings.bodies[0].velocity = Vec3(0, 0, 50);
  Fluid fluid(settings);
  const Ledger start = fluid.ledger();
  for (int k = 0; k < 100; ++k) fluid.step(fluid.step_limit().step);
  for (const Vec3& x : by_id(fluid, "position")) {
    EXPECT_LT(std::hypot(x[0], x[1]), 0.5);
    EXPECT_TRUE(x[2] > 0.0 && x[2] < 0.4);
  }
  const Ledger end = fluid.ledger();
  EXPECT_NEAR(total(end), total(start), 5e-3 * (total(start) - start.internal));
}

}  // namespace
}  // namespace undex::sph::testing
