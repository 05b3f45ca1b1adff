// A resolved scene reads back as the same scene, and holds every key.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/schema.hpp"
#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene;
using namespace undex::scene::test;

const std::string profile = R"(dimension = 2
end_time = 1
[resolution]
spacing = 0.1
[[bodies]]
name = "left"
shape = {type = "box", low = [0, 0], high = [1, 1]}
material = {law = "stiffened_gas", rho0 = 1, gamma = 4.4, p_inf = 6}
energy = 10
[[bodies]]
name = "right"
shape = {type = "box", low = [1, 0], high = [2, 1]}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.4}
energy = 1
[comparison]
kind = "profile"
solution = "riemann"
window = [0.5, 1.5]
core = 0.3
)";

const std::string imploding = R"(dimension = 2
end_time = 0.6
[resolution]
spacing = 0.1
[[bodies]]
name = "gas"
shape = {type = "sphere", radius = 1}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.4}
radial_velocity = -1
radial = {speed = 2, radius = 0.5, power = 0.25, about = "z", center = [0.125, 0.25]}
[comparison]
kind = "profile"
solution = "noh"
)";

const std::string pool = R"(dimension = 2
end_time = 1
gravity = [1, -9.81]
[resolution]
spacing = 0.1
rotation = 17
[[bodies]]
name = "water"
shape = {type = "box", low = [0, 0], high = [1, 1]}
material = "water-tait"
pressure = 1e6
level = [0, 1.5]
)";

const std::string radiating_sea = R"(end_time = 1e-4
gravity = [0, 0, -9.81]
[resolution]
spacing = 0.01
[symmetry]
planes = ["x"]
[surroundings]
pressure = 9e4
[[bodies]]
name = "gas"
shape = {type = "sphere", center = [0, 0.02, -0.2], radius = 0.03}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.4}
energy = 5e5
[[bodies]]
name = "water"
shape = {type = "box", low = [-0.2, -0.2, -0.4], high = [0.2, 0.2, 0]}
subtract = ["gas"]
material = "water-tait"
pressure = 9e4
level = [0, 0, 0]
[[walls]]
name = "sea"
shape = {type = "box", low = [-0.2, -0.2, -0.4], high = [0.2, 0.2, 0]}
condition = "radiating"
source = [0, 0.01, -0.3]
faces = {z_high = "open", z_low = "free_slip"}
[[obstacles]]
name = "rudder"
shape = {type = "cone", axis = "z", center = [0, 0.14, 0], low_radius = 0.03, high_radius = 0.02, low = -0.3, high = -0.2}
[[obstacles]]
name = "ring"
shape = {type = "tube", axis = "z", center = [0, -0.12, 0], inner_radius = 0.03, outer_radius = 0.06, low = -0.3, high = -0.2}
motion = "free"
mass = 2.5
inertia = [1, 2, 2.5, 0, 0, 0.3]
fixed = ["rx"]
velocity = [0, 1, 0]
)";

/// Scenes that between them use every kind of table, with no value at its default.
const std::string charge_in_a_funnel = R"(end_time = 1e-4
[resolution]
spacing = 0.001
[start]
kind = "run"
from = "charge.toml"
time = 1e-5
[[bodies]]
name = "charge"
shape = {type = "sphere", radius = 0.005}
material = "petn"
[[bodies]]
name = "water"
shape = {type = "cone", axis = "z", low_radius = 0.02, high_radius = 0.03, low = -0.02, high = 0.04}
subtract = ["charge"]
material = "water-tait"
[[probes]]
name = "near"
point = [0.01, 0, 0]
[comparison]
kind = "similitude"
explosive = "tnt"
charge_mass = 0.001
impulse = [6e3, 0.9]
energy_flux = [9e4, 2]
)";
const std::vector<std::string> rich{R"(title = "all \"sorts\" of \\ things\t"
name = "rich"
end_time = 2e-5
threads = 2
[resolution]
spacing = 0.004
lattice = "rings"
fit = "tank"
origin = [0.1, 0.2, 0.3]
jitter = 0.01
[symmetry]
planes = ["y"]
[start]
kind = "spherical"
body = "charge"
time = 1e-6
[scheme]
name = "monaghan"
kernel = "gaussian"
precision = "mixed"
eta = 1.25
alpha = 0.5
beta = 2
alpha_min = 0.2
courant = 0.2
fixed_step = 1e-8
signal = 1e-6
h_low = 0.8
h_high = 3
[[bodies]]
name = "charge"
shape = {type = "sphere", center = [0, 0, 0.001], radius = 0.01}
subtract = [{type = "slab", axis = "z", low = 0.009, high = 1}, {type = "tube", axis = "y", inner_radius = 0.001, outer_radius = 0.002, low = 0, high = 1}, {type = "box", low = [0.005, 0, 0], high = [1, 1, 1]}, {type = "cone", axis = "x", low_radius = 0, high_radius = 0.002, low = -0.004, high = 0.001}]
material = {base = "petn", A = 6e11}
spacing = 0.002
velocity = [1, 0, 3]
spin = [0, 7, 0]
density = 1700
energy = 5e6
variable_h = false
burn = {initiation = [0.001, 0, 0], speed = 8000, width = 0.005, cj_compression = 1.3}
[[bodies]]
name = "second"
shape = {type = "sphere", center = [0, 0, 0.05], radius = 0.01}
material = "petn"
burn = "instantaneous"
[[bodies]]
name = "water"
shape = {type = "cylinder", axis = "z", radius = 0.04, low = -0.1, high = 0.1}
subtract = [{type = "sphere", center = [0, 0, 0.001], radius = 0.01}, "second"]
material = {base = "water-tait", cavitation = "cutoff", p_floor = 1, p_sat = 3000, density_ratio = 2e-5, vapour_sound = 200, liquid_sound = 1500, N = 7, A = 2e5, B = 3e8, rho0 = 999, name = "my water", source = "made up"}
pressure = 3e5
[[bodies]]
name = "block"
shape = {type = "box", low = [0.1, 0, 0], high = [0.2, 0.1, 0.1]}
material = {base = "water-steinberg", cavitation = "none", S3 = 0.1}
[[bodies]]
name = "jacket"
shape = {type = "tube", axis = "z", inner_radius = 0.045, outer_radius = 0.07, low = -0.1, high = 0.1}
material = {law = "barotropic_gas", rho0 = 1, p0 = 1e5, gamma = 1.4}
[[bodies]]
name = "air"
shape = {type = "cylinder", axis = "x", center = [0, 0.5, 0.5], radius = 0.1, low = 0, high = 0.3}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.3}
pressure = 1e5
energy = 2e5
[[walls]]
name = "tank"
shape = {type = "cylinder", axis = "z", radius = 2, low = -1, high = 1}
condition = "no_slip"
faces = {low = "open", side = "free_slip"}
[[walls]]
name = "outer"
shape = {type = "box", low = [-3, -3, -3], high = [3, 3, 3]}
faces = {x_low = "open"}
[structure]
name = "pipe"
shape = {type = "tube", axis = "z", inner_radius = 0.04, outer_radius = 0.045, low = -0.1, high = 0.1}
cells = {through = 3, around = 40, along = 30}
material = {base = "al-6061-t6", T_room = 300, taylor_quinney = 0.8, pressure = {C = 5000}, flow = {rate0 = 2, T_room = 301}}
element = "shell"
points_through = 4
supports = [{face = "low", fixed = ["x", "z"]}, {face = "high"}]
wet = ["inner", "outer"]
loads = [{face = "outer", time = [0, 1e-6], pressure = [1e5, 2e5]}]
velocity = [0, 0, 4]
spin = [0, 2, 0]
courant = 0.7
linear_viscosity = 0.05
quadratic_viscosity = 1.1
[[planes]]
axis = "x"
position = -0.5
[[planes]]
axis = "z"
position = 2
free_side = "below"
[coupling]
slip = false
window = 2
[[probes]]
name = "a"
kind = "fluid"
point = [0.02, 0, 0]
quantities = ["pressure"]
[[probes]]
name = "b"
kind = "wall"
point = [0.04, 0, 0]
quantities = ["density", "velocity"]
[[probes]]
name = "c"
kind = "structure"
point = [0.045, 0, 0]
quantities = ["stress"]
[[lines]]
name = "out"
from = [0.01, 0, 0]
to = [0.03, 0, 0.01]
points = 17
quantities = ["density"]
interval = 1e-6
times = [5e-6, 3e-6]
[output]
histories = ["forces", "bodies"]
history_interval = 1e-7
field_interval = 1e-6
field_times = [2e-6, 1e-6]
particle_fields = ["mass", "energy"]
structure_fields = false
[comparison]
kind = "tube"
probe = "c"
reference = "case.toml"
)",
                                    R"(end_time = 1e-4
[structure]
shape = {type = "plate", low = [0, 0, 0], high = [1, 1, 0.01]}
material = {rho0 = 1e3, shear_modulus = 1e9, heat_capacity = 500, pressure = {law = "linear", bulk_modulus = 2e9}, flow = {law = "linear_hardening", Y0 = 1e6, H = 0}}
)",
                                    R"(end_time = 1e-4
[structure]
shape = {type = "rod", axis = "y", center = [1, 0, 2], radius = 0.1, low = 0, high = 1}
material = {rho0 = 1e3, young_modulus = 1e9, poisson_ratio = 0.1, flow = {law = "elastic"}}
)",
                                    R"(end_time = 1e-4
[structure]
shape = {type = "gmsh", path = ")" UNDEX_ROOT R"(/tests/unit/scene/cubes.msh"}
material = "copper-ofhc"
)",
                                    R"(end_time = 1e-4
[structure]
shape = {type = "plate", low = [0, 0, 0], high = [1, 1, 0.01]}
material = {base = "al-5086-za", flow = {n = 0.7, rate0 = 1e-2}, spall = {strength = 1.2e9, mode = "fail"}}
)",
                                    R"(end_time = 1e-4
[structure]
shape = {type = "plate", low = [0, 0, 0], high = [1, 1, 0.01]}
material = {base = "steel-4340-damage", damage = {D2 = 3, rate0 = 2, T_room = 300}, spall = {strength = 3e9}, flow = {law = "cowper_symonds", Y0 = 3e8, H = 0, D = 40, q = 5}}
)",
                                    R"(end_time = 1e-4
[structure]
shape = {type = "plate", low = [0, 0, 0], high = [1, 1, 0.01]}
material = {base = "al-6061-t6", flow = {law = "power_hardening", A = 1e8, B = 2e8, n = 0.3}}
)",
                                    R"(dimension = 2
end_time = 1e-4
[[solids]]
name = "disc"
shape = {type = "cylinder", center = [0, 0.25], radius = 0.1}
material = {rho0 = 1e3, young_modulus = 1e9, poisson_ratio = 0.1, flow = {law = "elastic"}}
description = "updated_lagrangian"
spacing = 0.01
lattice = "cartesian"
velocity = [1, 2]
spin = 3
supports = [{face = "side", fixed = ["y"]}]
residual_stress = 1e5
[[solids]]
name = "ring"
shape = {type = "tube", inner_radius = 0.2, outer_radius = 0.3}
subtract = [{type = "box", low = [0.2, 0], high = [1, 1]}, "disc"]
material = "copper-ofhc"
spacing = 0.01
[solid_scheme]
eta = 1.2
courant = 0.4
linear_viscosity = 0.05
quadratic_viscosity = 1.1
hourglass = 0.2
alpha = 0.5
beta = 1
artificial_stress = 0.3
[[planes]]
axis = "y"
position = 1
free_side = "below"
[output]
solid_fields = ["mass", "damage"]
)",
                                    R"(end_time = 1e-5
[resolution]
spacing = 0.001
[start]
kind = "plane_wave"
body = "water"
axis = "y"
towards = "low"
front = 0.01
peak = 1e6
decay = 2e-5
[[bodies]]
name = "water"
shape = {type = "box", low = [0, 0, 0], high = [0.01, 0.02, 0.01]}
material = "water-tait-cutoff"
[structure]
shape = {type = "plate", low = [0, -0.005, 0], high = [0.01, 0, 0.01]}
material = "copper-ofhc"
wet = ["y_high"]
[[probes]]
name = "wall"
kind = "wall"
point = [0.005, 0, 0.005]
[[probes]]
name = "plate"
kind = "structure"
point = [0.005, -0.002, 0.005]
[comparison]
kind = "taylor_plate"
probe = "plate"
)",
                                    coupled_tube,
                                    two_gases,
                                    impact,
                                    bathed_disc,
                                    profile,
                                    imploding,
                                    charge_in_a_funnel,
                                    pool,
                                    radiating_sea,
                                    R"(title = "rigid bodies"
end_time = 1e-4
[resolution]
spacing = 0.01
[[bodies]]
name = "water"
shape = {type = "box", low = [0, 0, 0], high = [0.4, 0.4, 0.4]}
material = "water-tait"
[[obstacles]]
name = "ball"
shape = {type = "sphere", center = [0.1, 0.1, 0.1], radius = 0.05}
motion = "free"
condition = "free_slip"
density = 500
inertia = [1, 2, 2.5, 0.1, 0.2, 0.3]
fixed = ["x", "rz"]
velocity = [0, 1, 2]
spin = [1, 2, 0]
direction = [0, 1, 1]
time = [0, 1e-4]
force = [1e3, 2e3]
[[obstacles]]
name = "drum"
shape = {type = "cylinder", axis = "y", center = [0.3, 0, 0.3], radius = 0.05, low = 0.1, high = 0.3}
motion = "free"
mass = 3
[[obstacles]]
name = "piston"
shape = {type = "box", low = [-0.1, 0, 0], high = [0, 0.4, 0.4]}
motion = "prescribed"
direction = [1, 0, 0]
time = [0, 1e-4]
speed = [1, 2]
)",
                                    R"(end_time = 1e-4
[[structures]]
name = "plate"
shape = {type = "plate", low = [0, 0, 0], high = [1, 1, 0.01]}
material = "steel-4340"
supports = [{face = "x_low"}]
[[structures]]
shape = {type = "rod", axis = "y", center = [1, 0, 2], radius = 0.1, low = 0, high = 1}
material = "copper-ofhc"
radial = {speed = 3, radius = 0.1, about = "y", center = [1, 0, 2], power = 1}
loads = [{face = "low", time = [0], pressure = [1e5]}, {face = "high", time = [0], pressure = [2e5]}]
[[probes]]
name = "in_rod"
structure = "1"
point = [1, 0.5, 2]
)",
                                    R"(end_time = 1e-4
[structure]
shape = {type = "gmsh", path = ")" UNDEX_ROOT R"(/tests/unit/scene/cubes.msh"}
parts = [{group = "1", material = {base = "al-6061-t6", spall = {strength = 1e9}}}]
loads = [{face = "wet side", time = [0], pressure = [1e5]}]
)",
                                    R"(end_time = 1e-4
[structure]
element = "shell"
shape = {type = "gmsh", path = ")" UNDEX_ROOT R"(/tests/unit/scene/tee.msh", thickness = 0.02, offset = "bottom"}
material = "copper-ofhc"
parts = [{group = "web", thickness = 0.01, offset = "mid"}, {group = "flange", material = "steel-4340"}]
supports = [{face = "root"}]
loads = [{face = "flange.top", time = [0], pressure = [1e5]}]
)"};

TEST(RoundTrip, ReadsBackAsTheSameScene) {
  for (const std::string& text : rich) {
    const Scratch scratch;
    const Scene scene = read(scratch.write(text));
    const std::string resolved = to_toml(scene);
    Scene again;
    try {
      again = read(scratch.write(resolved, "resolved.toml"));
    } catch (const std::exception& error) {
      FAIL() << error.what() << '\n' << resolved;
    }
    EXPECT_EQ(to_toml(again), resolved);
    EXPECT_EQ(again.name, scene.name);
  }
}

/// A mass is another spelling of a sphere's radius.
TEST(RoundTrip, KeepsTheRadiusOfAMass) {
  const auto charge = [](const std::string& dimension, const std::string& shape, const std::string& more) {
    return dimension +
           "end_time = 1e-5\n[resolution]\nspacing = 0.002\n[[bodies]]\nname = \"charge\"\nshape = {type = \"sphere\"" + shape +
           "}\nmaterial = \"tnt\"\n" + more;
  };
  const auto radius_of = [](const std::string& text) {
    const Scratch scratch;
    const Scene scene = read(scratch.write(text));
    const std::string resolved = to_toml(scene);
    EXPECT_EQ(resolved.find("mass = 0.05"), std::string::npos) << resolved;
    EXPECT_EQ(to_toml(read(scratch.write(resolved, "resolved.toml"))), resolved);
    const Primitive& shape = scene.fluid.bodies[0].shape.base;
    const auto* placed = std::get_if<Placed>(&shape);
    return std::get<Sphere>(placed ? placed->shape[0] : shape).radius;
  };
  const double radius = std::cbrt(0.05 / (4.0 / 3.0 * std::numbers::pi * 1630)), half = std::cbrt(2.0) * radius;
  for (const char* dimension : {"", "dimension = \"spherical\"\n", "dimension = \"axisymmetric\"\naxis = \"z\"\n"}) {
    EXPECT_NEAR(radius_of(charge(dimension, "", "mass = \"50 g\"\n")), radius, 1e-12) << dimension;
    EXPECT_NEAR(radius_of(charge(dimension, "", "mass = 0.05\ndensity = 815\n")), half, 1e-12) << dimension;
  }
  EXPECT_NEAR(radius_of(charge("", ", move = [0, 0, 0.1]", "mass = 0.05\n")), radius, 1e-12);
  EXPECT_NEAR(radius_of(charge("", "", "mass = 0.05\n[symmetry]\nplanes = [\"x\", \"y\", \"z\"]\n")), radius, 1e-12);
  EXPECT_EQ(radius_of(charge("", ", radius = 0.01942", "mass = 0.05\n")), 0.01942);  // of 50.005 g
}

TEST(RoundTrip, KeepsTheIntegrator) {
  const Scratch scratch;
  const std::string text = with(two_gases, "spacing = 0.01", "spacing = 0.01\n[scheme]\nintegrator = \"ssp_rk3\"");
  const Scene scene = read(scratch.write(to_toml(read(scratch.write(text))), "resolved.toml"));
  EXPECT_EQ(scene.fluid.numerics.integrator, sph::Integrator::ssp_rk3);
  EXPECT_EQ(scene.fluid.numerics.courant, sph::default_courant(sph::Integrator::ssp_rk3, scene.fluid.numerics.kernel));
}

TEST(RoundTrip, KeepsLocalSteps) {
  const Scratch scratch;
  const std::string text = with(two_gases, "spacing = 0.01", "spacing = 0.01\n[scheme]\nlocal_steps = true");
  EXPECT_TRUE(read(scratch.write(to_toml(read(scratch.write(text))), "resolved.toml")).fluid.numerics.local_steps);
}

TEST(RoundTrip, KeepsGravityLevelsAndRotation) {
  const Scratch scratch;
  const Scene scene = read(scratch.write(to_toml(read(scratch.write(pool))), "resolved.toml"));
  EXPECT_EQ(scene.fluid.gravity, Vec3(1, -9.81, 0));
  EXPECT_EQ(scene.fluid.lattice.rotation, Vec3(0, 0, 17));
  EXPECT_EQ(scene.fluid.bodies[0].level, Vec3(0, 1.5, 0));
}

TEST(RoundTrip, KeepsSurroundingsRadiatingFacesAndObstacles) {
  const Scratch scratch;
  const Scene scene = read(scratch.write(to_toml(read(scratch.write(radiating_sea))), "resolved.toml"));
  EXPECT_EQ(scene.fluid.surroundings.pressure, 9e4);
  ASSERT_EQ(scene.fluid.walls.size(), 1u);
  const sph::Wall& sea = scene.fluid.walls[0];
  EXPECT_EQ(sea.source, Vec3(0, 0.01, -0.3));
  EXPECT_EQ(sea.faces.size(), 6u);
  for (const auto& [face, condition] : sea.faces)
    EXPECT_EQ(condition, face == "z_high"  ? sph::FaceCondition::open
                         : face == "z_low" ? sph::FaceCondition::free_slip
                                           : sph::FaceCondition::radiating)
        << face;
  ASSERT_EQ(scene.obstacles.size(), 2u);
  const coupling::Obstacle &rudder = scene.obstacles[0], &ring = scene.obstacles[1];
  EXPECT_EQ(rudder.motion, coupling::Motion::fixed);
  EXPECT_EQ(std::get<Cone>(rudder.shape).center[1], 0.14);
  EXPECT_EQ(std::get<Cone>(rudder.shape).high_radius, 0.02);
  EXPECT_EQ(ring.motion, coupling::Motion::free);
  EXPECT_EQ(std::get<TubeShape>(ring.shape).inner, 0.03);
  EXPECT_EQ(ring.mass, 2.5);
  EXPECT_EQ(ring.velocity, Vec3(0, 1, 0));
  EXPECT_EQ(ring.inertia, (std::vector<double>{1, 2, 2.5, 0, 0, 0.3}));
}

/// The source that a wall has by itself, of the only charge, is written, and stays when it is read.
TEST(RoundTrip, KeepsTheSourceThatWasFound) {
  const Scratch scratch;
  const Scene scene = read(scratch.write(with(radiating_sea, "source = [0, 0.01, -0.3]\n", ""))),
              again = read(scratch.write(to_toml(scene), "resolved.toml"));
  EXPECT_LT((scene.fluid.walls[0].source.value() - Vec3(0, 0.02, -0.2)).norm(), 1e-15);
  EXPECT_EQ(again.fluid.walls[0].source, scene.fluid.walls[0].source);
}

TEST(RoundTrip, KeepsTheValuesThatAreNotDefaults) {
  const Scratch scratch;
  const Scene scene = read(scratch.write(to_toml(read(scratch.write(rich[0]))), "resolved.toml"));
  EXPECT_EQ(scene.title, "all \"sorts\" of \\ things\t");
  EXPECT_EQ(scene.end_time, 2e-5);
  EXPECT_EQ(scene.fluid.numerics.threads, 2);
  EXPECT_EQ(scene.fluid.lattice.type, sph::LatticeType::rings);
  EXPECT_EQ(scene.fluid.lattice.fit, "tank");
  EXPECT_EQ(scene.fluid.lattice.origin, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.fluid.lattice.jitter, 0.01);
  EXPECT_EQ(scene.fluid.numerics.kernel, sph::KernelName::gaussian);
  EXPECT_EQ(scene.fluid.numerics.precision, sph::Precision::mixed);
  EXPECT_EQ(scene.fluid.numerics.scheme, sph::SchemeName::monaghan);
  EXPECT_EQ(scene.fluid.numerics.eta, 1.25);
  EXPECT_EQ(scene.fluid.numerics.alpha_min, 0.2);
  EXPECT_EQ(scene.fluid.numerics.fixed_step, 1e-8);
  EXPECT_EQ(scene.fluid.numerics.h_high, 3);
  const sph::Body& charge = scene.fluid.bodies[0];
  EXPECT_EQ(charge.shape.removed.size(), 4u);
  EXPECT_EQ(std::get<TubeShape>(charge.shape.removed[1]).outer, 0.002);
  EXPECT_EQ(charge.spacing, 0.002);
  EXPECT_EQ(charge.velocity, Vec3(1, 0, 3));
  EXPECT_EQ(charge.spin, Vec3(0, 7, 0));
  EXPECT_EQ(charge.density, 1700);
  EXPECT_EQ(charge.energy, 5e6);
  EXPECT_FALSE(charge.variable_h);
  ASSERT_TRUE(charge.burn.has_value());
  EXPECT_EQ(charge.burn->origin, Vec3(0.001, 0, 0));
  EXPECT_EQ(charge.burn->D, 8000);
  EXPECT_EQ(charge.burn->width, 0.005);
  EXPECT_EQ(charge.burn->cj_compression, 1.3);
  EXPECT_FALSE(scene.fluid.bodies[1].burn.has_value());
  EXPECT_EQ(scene.fluid.bodies[2].material.name, "my water");
  const auto& tait = std::get<materials::TaitWater>(scene.fluid.bodies[2].material.law).parameters();
  EXPECT_EQ(tait.cavitation, materials::Cavitation::cutoff);
  EXPECT_EQ(tait.mixture.p_sat, 3000);
  EXPECT_EQ(scene.fluid.bodies[2].material.rho0, 999);
  EXPECT_EQ(scene.fluid.walls[0].faces.at("low"), sph::FaceCondition::open);
  EXPECT_EQ(scene.fluid.walls[0].faces.at("high"), sph::FaceCondition::no_slip);
  EXPECT_EQ(scene.structures.at(0).supports[0].fixed, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(scene.structures.at(0).material.T_room, 300);
  EXPECT_EQ(std::get<materials::MieGruneisenPressure>(scene.structures.at(0).material.pressure).C, 5000);
  EXPECT_EQ(std::get<materials::JohnsonCook>(scene.structures.at(0).material.flow).rate0, 2);
  EXPECT_EQ(scene.structures.at(0).loads[0].pressure[1], 2e5);
  EXPECT_EQ(scene.structures.at(0).courant, 0.7);
  EXPECT_FALSE(scene.coupling.free_slip);
  EXPECT_EQ(scene.coupling.window, 2);
  EXPECT_EQ(scene.output.field_times, (std::vector<double>{1e-6, 2e-6}));
  EXPECT_FALSE(scene.output.structure_fields);
  EXPECT_EQ(scene.comparison.probe, "c");
}

TEST(RoundTrip, ProfileHoldsTheValuesGiven) {
  const Scene scene = read(Scratch().write(profile));
  EXPECT_EQ(scene.comparison.solution, Solution::riemann);
  EXPECT_EQ(scene.comparison.window_low, 0.5);
  EXPECT_EQ(scene.comparison.window_high, 1.5);
  EXPECT_EQ(scene.comparison.core, 0.3);
  EXPECT_EQ(std::get<materials::StiffenedGas>(scene.fluid.bodies[0].material.law).parameters().p_inf, 6);
  EXPECT_FALSE(scene.fluid.bodies[0].variable_h);
}

TEST(RoundTrip, RadialVelocityIsKept) {
  const Scene scene = read(Scratch().write(imploding));
  EXPECT_EQ(scene.fluid.bodies[0].radial_velocity, -1);
  EXPECT_EQ(scene.comparison.solution, Solution::noh);
  EXPECT_FALSE(scene.comparison.core);
}

TEST(RoundTrip, SolidsHoldTheValuesGiven) {
  const Scene scene = read(Scratch().write(rich[7]));
  ASSERT_EQ(scene.solids.bodies.size(), 2u);
  const solid::Body& disc = scene.solids.bodies[0];
  EXPECT_EQ(disc.description, solid::Description::updated_lagrangian);
  EXPECT_EQ(disc.lattice, sph::LatticeType::cartesian);
  EXPECT_EQ(disc.velocity, Vec3(1, 2, 0));
  EXPECT_EQ(disc.spin, Vec3(0, 0, 3));
  ASSERT_EQ(disc.supports.size(), 1u);
  EXPECT_EQ(disc.supports[0].face, "side");
  EXPECT_EQ(disc.supports[0].fixed, (std::array{false, true, false}));
  EXPECT_EQ(disc.residual_stress, 1e5);
  const solid::Body& ring = scene.solids.bodies[1];
  EXPECT_EQ(ring.description, solid::Description::total_lagrangian);
  EXPECT_EQ(ring.lattice, sph::LatticeType::rings);
  EXPECT_EQ(ring.shape.removed.size(), 2u);
  EXPECT_EQ(scene.solids.numerics.artificial_stress, 0.3);
  ASSERT_EQ(scene.solids.planes.size(), 1u);
  EXPECT_EQ(scene.solids.planes[0].axis, 1);
  EXPECT_EQ(scene.solids.planes[0].position, 1);
  EXPECT_FALSE(scene.solids.planes[0].body_above);
  EXPECT_EQ(scene.output.solid_fields, (std::vector<std::string>{"mass", "damage"}));
}

TEST(RoundTrip, KeepsFlowStressAndFailure) {
  const auto solid = [](std::size_t which) {
    const Scratch scratch;
    return read(scratch.write(to_toml(read(scratch.write(rich[which]))), "resolved.toml")).structures.at(0).material;
  };
  const materials::Solid tube = solid(4);
  const auto& flow = std::get<materials::ZerilliArmstrong>(tube.flow);
  EXPECT_EQ(flow.C2, 1283e6);
  EXPECT_EQ(flow.n, 0.7);
  EXPECT_EQ(flow.rate0, 1e-2);
  ASSERT_TRUE(tube.spall.has_value());
  EXPECT_EQ(tube.spall->strength, 1.2e9);
  EXPECT_EQ(tube.spall->mode, materials::Spall::Mode::fail);
  EXPECT_FALSE(tube.damage.has_value());

  const materials::Solid steel = solid(5);
  EXPECT_EQ(std::get<materials::CowperSymonds>(steel.flow).D, 40);
  EXPECT_EQ(steel.spall->mode, materials::Spall::Mode::cutoff);
  ASSERT_TRUE(steel.damage.has_value());
  EXPECT_EQ(steel.damage->D1, 0.05);
  EXPECT_EQ(steel.damage->D2, 3);
  EXPECT_EQ(steel.damage->T_melt, 1793);
  EXPECT_EQ(steel.damage->rate0, 2);
  EXPECT_EQ(steel.damage->T_room, 300);

  EXPECT_EQ(std::get<materials::PowerHardening>(solid(6).flow).n, 0.3);
}

// Keys that a resolved scene does not need: other spellings of what it holds.
TEST(RoundTrip, ResolvedScenesHoldEveryKey) {
  const std::vector<std::string> spellings{".materials",
                                           "bodies.mass",
                                           "structure.cell_size",
                                           "walls.condition",
                                           "material.solid.base",
                                           "material.solid.young_modulus",
                                           "material.solid.poisson_ratio"};
  std::string all;
  for (const std::string& text : rich) all += '\n' + to_toml(read_text(text));
  const Scratch scratch;
  scratch.write(
      "solid t\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid t\n",
      "t.stl");
  all +=
      '\n' + to_toml(read(scratch.write(
                 "end_time = 1\n[resolution]\nspacing = 0.1\n[[bodies]]\nname = \"water\"\nmaterial = \"water-tait\"\n"
                 "shape = {type = \"stl\", file = \"t.stl\", scale = 2, rotate = [0, 0, 9], move = [0.1, 0, 0]}\n"
                 "subtract = [{type = \"union\", shapes = [{type = \"half_space\", point = [0.3, 0, 0], normal = [-1, 0, 0]}, "
                 "{type = \"ellipsoid\", semi_axes = [0.1, 0.2, 0.2]}, {type = \"revolution\", points = [[0, 0], [0.2, 0], [0, "
                 "0.2]]}]}]\n")));
  for (const Section& section : schema())
    for (const Key& key : section.keys) {
      const std::string name = key.name, full = section.name + '.' + name;
      if (std::find(spellings.begin(), spellings.end(), full) != spellings.end() || name == "base") continue;
      const bool there = all.find('\n' + name + " = ") != std::string::npos ||
                         all.find(", " + name + " = ") != std::string::npos || all.find('[' + name + ']') != std::string::npos ||
                         all.find('.' + name + ']') != std::string::npos;
      EXPECT_TRUE(there) << full;
    }
}

}  // namespace
