// Good scenes are read as they are meant, with the documented defaults.
#include <gtest/gtest.h>

#include <fstream>

#include "core/errors.hpp"
#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene;
using namespace undex::scene::test;

TEST(Read, CoupledTubeWithItsDefaults) {
  const Scene scene = read_text(coupled_tube);
  EXPECT_EQ(scene.fluid.dimension, 3);
  EXPECT_EQ(scene.end_time, 1e-5);
  EXPECT_EQ(scene.fluid.lattice.spacing, 0.002);
  EXPECT_EQ(scene.fluid.lattice.type, sph::LatticeType::cartesian);
  EXPECT_EQ(scene.fluid.numerics.kernel, sph::KernelName::wendland_c2);
  EXPECT_EQ(scene.fluid.numerics.eta, 1.5);
  EXPECT_EQ(scene.fluid.symmetry.axis, (std::array<bool, 3>{true, true, true}));

  ASSERT_EQ(scene.fluid.bodies.size(), 2u);
  const sph::Body& charge = scene.fluid.bodies[0];
  ASSERT_TRUE(charge.burn.has_value()) << "a charge burns from its middle unless told otherwise";
  EXPECT_EQ(charge.burn->origin, Vec3(0, 0, 0));
  EXPECT_EQ(charge.burn->D, 8300);
  EXPECT_DOUBLE_EQ(charge.burn->width, 0.003);
  EXPECT_TRUE(charge.variable_h);
  const sph::Body& water = scene.fluid.bodies[1];
  EXPECT_FALSE(water.variable_h);
  EXPECT_EQ(water.pressure, 1e5);
  ASSERT_EQ(water.shape.removed.size(), 1u) << "a body named in subtract is resolved to its shape";
  EXPECT_EQ(std::get<Sphere>(water.shape.removed[0]).radius, 0.0072);
  EXPECT_EQ(std::get<Cylinder>(water.shape.base).axis, 2);

  ASSERT_EQ(scene.structures.size(), 1u);
  const auto& tube = std::get<fem::TubeMesh>(scene.structures.at(0).mesh);
  EXPECT_EQ(tube.cells_around, 32);
  EXPECT_EQ(scene.structures.at(0).symmetry_axes, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(scene.structures.at(0).material.name, "al-5083-h116");
  ASSERT_EQ(scene.probes.size(), 2u);
  EXPECT_EQ(scene.probes[1].quantities.size(), 5u) << "without quantities, all of them";
}

TEST(Read, OneDimensionTakesBareNumbers) {
  const Scene scene = read_text(with(two_gases, "energy = 2\n", "energy = 2\nvelocity = -3\n"));
  EXPECT_EQ(scene.fluid.bodies[1].velocity, Vec3(-3, 0, 0));
  EXPECT_EQ(std::get<Box>(scene.fluid.bodies[0].shape.base).high, Vec3(0.5, 0, 0));
  EXPECT_EQ(scene.fluid.bodies[1].density, 0.125);
}

TEST(Read, TwoDimensionsTakeTwoOrThreeComponents) {
  const Scene scene = read_text(R"(dimension = 2
end_time = 1
[resolution]
spacing = 0.1
[[bodies]]
name = "disc"
shape = {type = "cylinder", center = [1, 2, 3], radius = 1}
material = "air"
energy = 1e5
velocity = [4, 5]
[[walls]]
name = "tank"
shape = {type = "box", low = [-9, -9], high = [9, 9]}
condition = "no_slip"
faces = {y_high = "open"}
)");
  EXPECT_EQ(scene.fluid.bodies[0].velocity, Vec3(4, 5, 0));
  EXPECT_EQ(std::get<Cylinder>(scene.fluid.bodies[0].shape.base).center, Vec3(1, 2, 0));
  const auto& faces = scene.fluid.walls[0].faces;
  ASSERT_EQ(faces.size(), 4u);
  EXPECT_EQ(faces.at("y_high"), sph::FaceCondition::open);
  EXPECT_EQ(faces.at("x_low"), sph::FaceCondition::no_slip);
}

TEST(Read, MaterialsOfTheScene) {
  const Scene scene = read_text(with(coupled_tube, "[symmetry]", R"([materials.my-water]
base = "water-tait"
B = 3e8

[materials.weak]
base = "al-5083-h116"
flow = {A = 1e8}

[materials.steel]
rho0 = 7800
young_modulus = 200e9
poisson_ratio = 0.3
flow = {law = "linear_hardening", Y0 = 3e8, H = 1e9}

[symmetry]
)"),
                                {{"bodies.water.material", "my-water"}, {"structure.material", "weak"}});
  const auto& water = std::get<materials::TaitWater>(scene.fluid.bodies[1].material.law);
  EXPECT_EQ(water.parameters().B, 3e8);
  EXPECT_EQ(water.parameters().N, 7.15);
  EXPECT_EQ(scene.fluid.bodies[1].material.name, "my-water");
  const auto& flow = std::get<materials::JohnsonCook>(scene.structures.at(0).material.flow);
  EXPECT_EQ(flow.A, 1e8);
  EXPECT_EQ(flow.B, 596e6);
  EXPECT_EQ(scene.structures.at(0).material.name, "weak");
}

TEST(Read, ElasticConstants) {
  const Scene scene = read_text(with(coupled_tube, "material = \"al-5083-h116\"",
                                     "material = {rho0 = 7800, young_modulus = 200e9, poisson_ratio = 0.25, "
                                     "flow = {law = \"elastic\"}}"));
  EXPECT_DOUBLE_EQ(scene.structures.at(0).material.shear_modulus, 80e9);
  EXPECT_DOUBLE_EQ(std::get<materials::LinearPressure>(scene.structures.at(0).material.pressure).bulk_modulus, 400e9 / 3);
}

TEST(Read, DamageTakesTheTemperaturesOfItsFlowStress) {
  const Scene scene = read_text(with(coupled_tube, "material = \"al-5083-h116\"",
                                     "material = {base = \"al-5083-h116\", flow = {T_room = 300, rate0 = 0.1}, "
                                     "damage = {D1 = 0.1, D2 = 0.2, D3 = -1.5, D4 = 0, D5 = 0, rate0 = 2}}"));
  const auto& damage = scene.structures.at(0).material.damage.value();
  EXPECT_EQ(damage.T_melt, 893);
  EXPECT_EQ(damage.T_room, 300);
  EXPECT_EQ(damage.rate0, 2);
  EXPECT_FALSE(scene.structures.at(0).material.spall.has_value());
}

TEST(Read, InstantaneousBurnHasTwoSpellings) {
  for (const char* burn : {"burn = \"instantaneous\"", "burn = {model = \"instantaneous\"}"}) {
    const Scene scene = read_text(with(coupled_tube, "material = \"petn\"", std::string("material = \"petn\"\n") + burn));
    EXPECT_FALSE(scene.fluid.bodies[0].burn.has_value());
  }
}

TEST(Read, EachKernelHasItsOwnSmoothingLength) {
  EXPECT_EQ(read_text(two_gases + "[scheme]\nkernel = \"gaussian\"\n").fluid.numerics.eta, 1.2);
  EXPECT_EQ(read_text(two_gases + "[scheme]\nkernel = \"gaussian\"\neta = 1.3\n").fluid.numerics.eta, 1.3);
  for (const sph::KernelName name : sph::all_kernels) {
    const std::string word = sph::with_kernel(name, [](auto kernel) { return kernel.name; });
    const sph::Numerics numerics = read_text(two_gases + "[scheme]\nkernel = \"" + word + "\"\n").fluid.numerics;
    EXPECT_EQ(numerics.kernel, name);
    EXPECT_EQ(numerics.courant, name == sph::KernelName::wendland_c6 ? 0.27 : 0.35);
    EXPECT_EQ(numerics.eta, sph::with_kernel(name, [](auto kernel) { return kernel.usual_eta; })) << word;
  }
  EXPECT_EQ(read_text(two_gases + "[scheme]\nintegrator = \"ssp_rk3\"\n").fluid.numerics.courant, 0.7);
  EXPECT_EQ(read_text(two_gases + "[scheme]\nintegrator = \"ssp_rk3\"\nkernel = \"wendland_c6\"\n").fluid.numerics.courant, 0.54);
}

TEST(Read, TheCorrectedSchemeHasAKernelOfItsOwn) {
  const auto numerics = [](const std::string& keys) {
    return read_text(two_gases + "[scheme]\nname = \"riemann_corrected\"\n" + keys).fluid.numerics;
  };
  EXPECT_EQ(numerics("").kernel, sph::KernelName::wendland_c4);
  EXPECT_EQ(numerics("").eta, 1.3);
  EXPECT_EQ(numerics("eta = 1.4\n").eta, 1.4);
  EXPECT_EQ(numerics("kernel = \"wendland_c2\"\n").eta, 1.5);
}

/// Each scheme brings what it is published with, where the scene does not say otherwise.
TEST(Read, SchemesBringTheirDefaults) {
  const auto numerics = [](const std::string& keys) { return read_text(two_gases + "[scheme]\n" + keys + "\n").fluid.numerics; };
  for (const auto& [word, scheme] : sph::scheme_names) EXPECT_EQ(numerics("name = \"" + std::string(word) + "\"").scheme, scheme);
  const sph::Numerics paper = numerics("name = \"paper\"");
  EXPECT_EQ(paper.kernel, sph::KernelName::gaussian);
  EXPECT_EQ(paper.eta, 1.2);
  EXPECT_EQ(paper.alpha, 1.0);
  EXPECT_EQ(paper.beta, 10.0);
  EXPECT_EQ(numerics("name = \"paper\"\nkernel = \"wendland_c2\"").eta, 1.5);
  EXPECT_EQ(numerics("name = \"monaghan\"").beta, 10.0);
  const sph::Numerics switched = numerics("name = \"monaghan_switch\"");
  EXPECT_EQ(switched.alpha, 1.0);
  EXPECT_EQ(switched.alpha_min, 0.1);
  EXPECT_EQ(switched.beta, 2.0);
}

TEST(Read, CellSizeGivesTheCountsOfTheWholeTube) {
  const Scene scene = read_text(with(coupled_tube, "cells = {through = 2, around = 32, along = 20}", "cell_size = 0.003"));
  const auto& tube = std::get<fem::TubeMesh>(scene.structures.at(0).mesh);
  EXPECT_EQ(tube.cells_through, 2);
  EXPECT_EQ(tube.cells_around, 100) << "2 pi 47 mm / 3 mm = 98.4, rounded up to quarters";
  EXPECT_EQ(tube.cells_along, 68) << "200 mm / 3 mm = 66.7, rounded up to halves";
}

TEST(Read, OtherStructures) {
  const std::string frame = "end_time = 1e-5\n[structure]\nmaterial = \"copper-ofhc\"\nvelocity = [0, 0, -227]\n";
  const Scene rod = read_text(frame +
                              "shape = {type = \"rod\", radius = 0.0032, low = 0, high = 0.0324}\n"
                              "supports = [{face = \"low\", fixed = [\"z\"]}]\n");
  EXPECT_EQ(std::get<fem::RodMesh>(rod.structures.at(0).mesh).cells_radial, 6);
  EXPECT_EQ(rod.structures.at(0).supports[0].fixed, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(rod.structures.at(0).initial_velocity, Vec3(0, 0, -227));
  const Scene plate = read_text(frame +
                                "shape = {type = \"plate\", low = [0, 0, 0], high = [1, 2, 0.1]}\n"
                                "cells = {z = 4}\n[[structure.loads]]\nface = \"z_high\"\ntime = [0]\npressure = [1e6]\n");
  EXPECT_EQ(std::get<fem::PlateMesh>(plate.structures.at(0).mesh).cells, (std::array<int, 3>{20, 40, 4}));
  EXPECT_EQ(plate.structures.at(0).loads[0].pressure[0], 1e6);
  const Scratch scratch;
  std::filesystem::copy_file(std::string(UNDEX_ROOT) + "/tests/unit/scene/cubes.msh", scratch.folder() / "mesh.msh");
  const Scene gmsh = read(scratch.write(frame + "shape = {type = \"gmsh\", path = \"mesh.msh\"}\n"));
  EXPECT_EQ(std::get<fem::GmshMesh>(gmsh.structures.at(0).mesh).path, scratch.folder() / "mesh.msh");
  EXPECT_EQ(std::get<fem::GmshMesh>(gmsh.structures.at(0).mesh).read->cells.size(), 2u);
}

TEST(Read, ShellsAreOneCellThick) {
  const std::string frame = "end_time = 1e-5\n[structure]\nmaterial = \"copper-ofhc\"\nelement = \"shell\"\n";
  const Scene ring =
      read_text(frame + "shape = {type = \"ring\", inner_radius = 0.1, outer_radius = 0.105, low = 0, high = 0.02}\n");
  EXPECT_EQ(ring.structures.at(0).element, fem::ElementKind::shell);
  EXPECT_EQ(std::get<fem::TubeMesh>(ring.structures.at(0).mesh).cells_through, 1);
  EXPECT_EQ(std::get<fem::TubeMesh>(ring.structures.at(0).mesh).cells_along, 4);
  const Scene plate = read_text(frame +
                                "shape = {type = \"plate\", low = [0, 0, 0], high = [0.1, 0.01, 0.2]}\npoints_through = 7\n"
                                "[[planes]]\naxis = \"y\"\nposition = 1\nfree_side = \"below\"\n");
  EXPECT_EQ(std::get<fem::PlateMesh>(plate.structures.at(0).mesh).cells, (std::array<int, 3>{10, 1, 20}));
  EXPECT_EQ(plate.structures.at(0).points_through, 7);
  EXPECT_EQ(plate.structures.at(0).planes[0].axis, 1);
  EXPECT_EQ(plate.structures.at(0).planes[0].position, 1.0);
  EXPECT_FALSE(plate.structures.at(0).planes[0].body_above);
}

TEST(Read, FolderOrFileAndItsName) {
  const Scratch scratch;
  std::filesystem::create_directories(scratch.folder() / "my_scene");
  std::ofstream(scratch.folder() / "my_scene" / "case.toml") << two_gases;
  EXPECT_EQ(read(scratch.folder() / "my_scene").name, "my_scene");
  EXPECT_EQ(read(scratch.folder() / "my_scene" / "").name, "my_scene");
  EXPECT_EQ(read(scratch.write(two_gases, "other.toml")).name, "other");
  EXPECT_EQ(read(scratch.write("name = \"mine\"\n" + two_gases)).name, "mine");
}

TEST(Read, MissingFilesAreNotTheScenesMistake) {
  const Scratch scratch;
  EXPECT_THROW(read(scratch.folder()), FileError);
  EXPECT_THROW(read(scratch.folder() / "none.toml"), FileError);
}

TEST(Read, EveryShippedScene) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(UNDEX_ROOT) / "cases")) {
    if (!std::filesystem::exists(entry.path() / "case.toml")) continue;
    ++count;
    try {
      const Scene scene = read(entry.path());
      EXPECT_EQ(scene.name, entry.path().filename().string());
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GE(count, 7);
}

}  // namespace
