// Input that is readable and yet not what was meant: units, sizes, counts, mirror images, thin walls, contradictory sets.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "materials/burn.hpp"
#include "materials/library.hpp"
#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene::test;

void refused(const std::string& scene, const std::string& expected, const std::vector<scene::Override>& overrides = {}) {
  const std::string found = mistakes(scene, overrides);
  EXPECT_NE(found.find(expected), std::string::npos) << "gave:\n" << found << "expected:\n" << expected;
}

std::string warnings(const std::string& scene, const std::vector<scene::Override>& overrides = {}) {
  std::string all;
  for (const std::string& warning : read_text(scene, overrides).warnings) all += warning + '\n';
  return all;
}

void warned(const std::string& scene, const std::string& expected, const std::vector<scene::Override>& overrides = {}) {
  const std::string found = warnings(scene, overrides);
  EXPECT_NE(found.find(expected), std::string::npos) << "gave:\n" << found << "expected:\n" << expected;
}

const std::string tnt =
    R"({law = "jwl", rho0 = 1630, A = 371.2e9, B = 3.231e9, R1 = 4.15, R2 = 0.95, omega = 0.30, E0 = 4.2945e6, D = 6930, p_cj = 21e9})";
const std::string charge = with(coupled_tube, "material = \"petn\"", "material = " + tnt);

TEST(Plausibility, SoundScenesGiveNoWarning) {
  EXPECT_EQ(warnings(coupled_tube), "");
  EXPECT_EQ(warnings(two_gases), "");
  EXPECT_EQ(warnings(bathed_disc), "");
  EXPECT_EQ(warnings(charge), "");
}

TEST(Plausibility, WetFacesDoNotTear) {
  const std::string torn = with(bathed_disc, "\"copper-ofhc\"", "\"copper-ofhc-damage\"");
  EXPECT_EQ(warnings(torn), "");
  warned(with(torn, "wet = ", "description = \"updated_lagrangian\"\nwet = "),
         "solids.disc: it may tear, but its wet faces do not");
}

/// Published sets detonate as published: TNT (Dobratz) at 6930 m/s and 21 GPa, and every charge of the library.
TEST(Plausibility, SetsHaveTheirOwnChapmanJouguetState) {
  const materials::Jwl set(
      {.rho0 = 1630, .A = 371.2e9, .B = 3.231e9, .R1 = 4.15, .R2 = 0.95, .omega = 0.30, .E0 = 4.2945e6, .D = 6930, .p_cj = 21e9});
  EXPECT_NEAR(chapman_jouguet(set).detonation_speed, 6930, 0.01 * 6930);
  EXPECT_NEAR(chapman_jouguet(set).pressure, 21e9, 0.01 * 21e9);
  int charges = 0;
  for (const std::string& name : materials::fluid_names()) {
    const materials::Fluid fluid = *materials::find_fluid(name);
    const auto* jwl = std::get_if<materials::Jwl>(&fluid.law);
    if (!jwl) continue;
    ++charges;
    const materials::ChapmanJouguet own = chapman_jouguet(*jwl);
    std::printf("%s: D = %.1f m/s (published %.1f), p_cj = %.3f GPa (published %.3f)\n", name.c_str(), own.detonation_speed,
                jwl->parameters().D, own.pressure * 1e-9, jwl->parameters().p_cj * 1e-9);
    EXPECT_NEAR(own.detonation_speed, jwl->parameters().D, 0.01 * jwl->parameters().D) << name;
    EXPECT_NEAR(own.pressure, jwl->parameters().p_cj, 0.02 * jwl->parameters().p_cj) << name;
  }
  EXPECT_GT(charges, 0);
}

TEST(Plausibility, ContradictorySetsAreToldTheirOwnState) {
  warned(with(charge, "D = 6930", "D = 6000"), "D = 6000 m/s and p_cj = 21 GPa are not those of the set itself");
  warned(with(charge, "D = 6930", "D = 6000"), "have their Chapman-Jouguet state at D = 69");
  warned(with(charge, "p_cj = 21e9", "p_cj = 18e9"), "p_cj = 18 GPa are not those of the set itself");
  EXPECT_EQ(warnings(with(charge, "D = 6930", "D = 6990")), "");
  refused(with(charge, "D = 6930", "D = 700"), "D = 700 [m/s] and the rest of the set contradict each other");
  refused(with(charge, "D = 6930", "D = 5000"), "D = 5000 [m/s] and the rest of the set contradict each other");
  refused(with(charge, "p_cj = 21e9", "p_cj = 12e9"), "p_cj = 1.2e+10 [Pa] and the rest of the set contradict each other");
}

/// A set that is published by its isentrope, and one without D and p_cj, are completed as the library's are.
TEST(Plausibility, ExplosivesAreCompletedFromTheirOwnState) {
  const auto bulk = [](const std::string& material) {
    return std::get<materials::Jwl>(
               read_text(with(coupled_tube, "material = \"petn\"", "material = " + material)).fluid.bodies.front().material.law)
        .parameters();
  };
  const materials::Jwl::Parameters own = bulk(with(tnt, ", D = 6930, p_cj = 21e9", ""));
  EXPECT_NEAR(own.D, 6929, 2);
  EXPECT_NEAR(own.p_cj, 21e9, 0.02e9);
  EXPECT_EQ(bulk(with(tnt, ", p_cj = 21e9", "")).D, 6930);
  const std::string published =
      R"({law = "jwl", rho0 = 1844, A = 773.037e9, B = 21.629e9, R1 = 4.5, R2 = 1.5, omega = 0.33, C = 1.339e9})";
  const materials::Jwl::Parameters pbx = bulk(published);
  EXPECT_NEAR(pbx.E0 * pbx.rho0, 10.6e9, 0.01e9);  // as listed
  const materials::ChapmanJouguet state = chapman_jouguet(materials::Jwl(pbx));
  const double volume = pbx.rho0 / state.density;  // the isentrope through that state is the published one
  EXPECT_NEAR(state.pressure,
              pbx.A * std::exp(-pbx.R1 * volume) + pbx.B * std::exp(-pbx.R2 * volume) + 1.339e9 * std::pow(volume, -1.33),
              1e-6 * state.pressure);
  refused(with(coupled_tube, "material = \"petn\"", "material = " + with(published, "C = ", "E0 = 5e6, C = ")),
          "C stands in place of E0; leave out one of them");
  refused(with(coupled_tube, "material = \"petn\"", "material = " + with(published, ", C = 1.339e9", "")),
          "needs E0, the detonation energy per mass, or C of its isentrope in its place");
  refused(with(coupled_tube, "material = \"petn\"", "material = " + with(published, "C = 1.339e9", "C = 1.339e13")),
          "which no explosive has; is it in Pa?");
}

/// Two of pressure, density and energy make a state; a third must agree, and a barotropic law takes one.
TEST(Plausibility, StatesAreWholeAndDoNotContradictThemselves) {
  const auto start = [](const std::string& material, const std::string& keys) {
    return "end_time = 1e-6\n[resolution]\nspacing = 0.1\n[[bodies]]\nname = \"gas\"\nmaterial = \"" + material +
           "\"\nshape = {type = \"sphere\", radius = 1}\n" + keys;
  };
  for (const auto& [material, density, pressure] : {std::tuple("air", 1.204, 101325.0),
                                                    {"water-steinberg", 1010.0, 1e5},
                                                    {"water-polynomial", 990.0, 1e6},
                                                    {"water-sg-sussman", 1001.0, 3e5},
                                                    {"petn", 1000.0, 2e9}}) {
    const scene::Scene scene =
        read_text(start(material, "density = " + std::to_string(density) + "\npressure = " + std::to_string(pressure) + "\n" +
                                      (std::string(material) == "petn" ? "burn = \"instantaneous\"\n" : "")));
    const sph::Body& body = scene.fluid.bodies[0];
    const double found =
        std::visit([&](const auto& law) { return law.evaluate(sph::start_density(body), sph::start_energy(body)).pressure; },
                   body.material.law);
    EXPECT_NEAR(found, pressure, 1e-6 * pressure + 10) << material;
    EXPECT_EQ(sph::start_density(body), density) << material;
    if (std::string(material) == "air") {
      EXPECT_NEAR(sph::start_energy(body), 101325 / (0.4 * 1.204), 1);
    }
  }
  refused(start("air", "density = 1.204\npressure = 101325\nenergy = 1\n"), "contradict each other: the law has 0.4816 Pa there");
  refused(start("water-tait", "density = 1010\npressure = 1e5\n"), "and the density 1010 kg/m^3 contradict each other");
  EXPECT_EQ(mistakes(start("water-tait", "density = 1000\npressure = 1e5\n")), "");
  refused(start("petn", "pressure = 1e5\n"), "bodies.gas.pressure: the pressure of a charge follows from its burn; leave it out");
  warned(start("air", ""), "'air' has no pressure without energy; give its pressure");
  EXPECT_EQ(warnings(start("air", "energy = 0\n")), "");
}

TEST(Plausibility, SetsThatAreNotToBeReliedOnAreSaid) {
  warned(with(coupled_tube, "material = \"petn\"", "material = \"c-4\""), "'c-4' is unverified: its source lists another");
  warned(with(coupled_tube, "material = \"water-tait\"", "material = \"water-paper-mg\""), "'water-paper-mg' is of grade D");
  warned(with(coupled_tube, "material = \"al-5083-h116\"", "material = {base = \"al-5086-o\"}"), "'al-5086-o' is of grade D");
}

TEST(Plausibility, FrontsOfAnotherSpeedAreSaid) {
  const auto at = [](const std::string& speed) {
    return with(coupled_tube, "material = \"petn\"\n", "material = \"petn\"\nburn = {speed = " + speed + "}\n");
  };
  EXPECT_EQ(warnings(at("8250")), "");
  warned(at("7850"),
         "burn.speed = 7850 [m/s] is not the detonation speed of the material: A, B, R1, R2, omega, E0 and rho0 have "
         "their Chapman-Jouguet state at D = 8300");
  refused(at("5000"), "burn.speed = 5000 [m/s] is not the detonation speed of the material");
}

/// The library may grow without breaking scenes that have a set of such a name.
TEST(Plausibility, MaterialsThatHideTheLibrarysAreSaid) {
  const std::string scene = coupled_tube + "[materials.petn]\nbase = \"tnt\"\n";
  warned(scene, "materials.petn hides the library's material of that name");
  EXPECT_EQ(read_text(scene).fluid.bodies.front().material.rho0, 1630);
}

/// Snapshots and profiles at times that the run does not come to.
TEST(Plausibility, TimesBeyondTheEndAreSaid) {
  const auto output = [](const std::string& keys) { return coupled_tube + "[output]\n" + keys + "\n"; };
  const auto line = [](const std::string& keys) {
    return coupled_tube + "[[lines]]\nname = \"across\"\nfrom = [0, 0, 0]\nto = [0.04, 0, 0]\n" + keys + "\n";
  };
  for (const std::string& good : {output("field_times = [5e-6, 1e-5]"), output("field_interval = 1e-5"),
                                  line("times = [0, 1e-5]"), line("interval = 1e-5")})
    EXPECT_EQ(warnings(good), "");
  warned(output("field_times = [1e-5, 1e-3, 2e-3]"),
         "output.field_times: 2 of 3 (such as 0.001 s) lie after end_time = 1e-05 s, and no snapshot is written there; take a "
         "later end_time or earlier times");
  warned(line("times = [1e-3]"), "lines.across.times: 0.001 s lies after end_time = 1e-05 s, and no profile is written there");
  warned(line("interval = 0.01"), "lines.across.interval = 0.01 [s] is longer than the run");
  warned(output("field_interval = 0.01"), "output.field_interval = 0.01 [s] is longer than the run");
  warned(line("times = [1e-6]") + "[start]\nkind = \"spherical\"\ntime = 2e-6\n",
         "lines.across.times: 1e-06 s lies outside the run, from start.time = 2e-06 s to end_time");
}

TEST(Plausibility, OtherUnitsAreGuessed) {
  refused(with(charge, "D = 6930", "D = 6.93"),
          "material.D = 6.93 [m/s] is not that of an explosive, 500 to 20000; is it in km/s? In m/s it would be 6930");
  refused(with(charge, "rho0 = 1630", "rho0 = 1.63"), "is it in g/cm^3? In kg/m^3 it would be 1630");
  refused(with(charge, "A = 371.2e9", "A = 371.2"), "is it in GPa? In Pa it would be 3.712e+11");
  refused(with(charge, "E0 = 4.2945e6", "E0 = 7e9"), "is it per volume, in J/m^3? Per mass it would be 4.29448e+06");
  refused(with(charge, "p_cj = 21e9", "p_cj = 21"), "is it in GPa? In Pa it would be 2.1e+10");
  refused(with(charge, "A = 371.2e9", "A = 3.712"), "is it in Mbar? In Pa it would be 3.712e+11");
  refused(with(charge, "rho0 = 1630", "rho0 = 1.63e-9"), "is it in t/mm^3? In kg/m^3 it would be 1630");
  const auto water = [](const std::string& changes) {
    return with(coupled_tube, "material = \"water-tait\"", "material = {base = \"water-tait\", " + changes + "}");
  };
  refused(water("rho0 = 1"),
          "rho0 = 1 [kg/m^3] is not that of a liquid, 20 to 30000; is it in g/cm^3? In kg/m^3 it would be 1000");
  refused(water("B = 331"), "B = 331 [Pa] is not that of a liquid");
  refused(water("B = 331"), "is it in MPa? In Pa it would be 3.31e+08");
}

TEST(Plausibility, OtherUnitsOfSolidsAreGuessed) {
  const auto steel = [](const std::string& of, const std::string& to) {
    const std::string material =
        "material = {rho0 = 7800, young_modulus = 210e9, poisson_ratio = 0.3, heat_capacity = 470, "
        "flow = {law = \"linear_hardening\", Y0 = 350e6, H = 0}, spall = {strength = 2e9}}";
    return with(coupled_tube, "material = \"al-5083-h116\"", with(material, of, to));
  };
  EXPECT_EQ(warnings(steel("Y0", "Y0")), "");
  refused(
      steel("rho0 = 7800", "rho0 = 7.8"),
      "structure.material.rho0 = 7.8 [kg/m^3] is not that of a solid, 20 to 30000; is it in g/cm^3? In kg/m^3 it would be 7800");
  refused(steel("young_modulus = 210e9, poisson_ratio = 0.3",
                "shear_modulus = 80, pressure = {law = \"mie_gruneisen\", C = 4600, "
                "S = 1.3, Gamma = 1.7}"),
          "shear_modulus = 80 [Pa]");
  refused(steel("rho0 = 7800", "rho0 = 7.8e-9"), "is it in t/mm^3? In kg/m^3 it would be 7800");
  refused(steel("210e9", "210"), "young_modulus = 210 [Pa] makes a wave speed of 0.19");
  refused(steel("210e9", "210"), "is it in GPa? In Pa it would be 2.1e+11");
  refused(with(steel("210e9", "210000"), "rho0 = 7800", "rho0 = 7.8e-9"),
          "with rho0 = 7800 kg/m^3; is it in MPa? In Pa it would be");
  refused(steel("210e9", "210000"), "is it in MPa? In Pa it would be 2.1e+11");
  refused(steel("210e9", "2.1"), "is it in Mbar? In Pa it would be 2.1e+11");
  refused(steel("Y0 = 350e6", "Y0 = 350"),
          "flow.Y0 = 350 [Pa] is not that of a solid, 10000 to 2e+10; is it in MPa? In Pa it would be 3.5e+08");
  refused(steel("Y0 = 350e6", "Y0 = 0.0035"), "is it in Mbar? In Pa it would be 3.5e+08");
  refused(steel("strength = 2e9", "strength = 2"), "spall.strength = 2 [Pa] is not that of a solid");
  refused(steel("heat_capacity = 470", "heat_capacity = 0.47"), "is it in J/g/K? In J/kg/K it would be 470");
  warned(with(coupled_tube, "material = \"al-5083-h116\"", "material = {base = \"al-5083-h116\", shear_modulus = 200e9}"),
         "have a Poisson's ratio of -0.");
}

TEST(Plausibility, NumbersThatCannotBeComputedWithHaveATrueMessage) {
  const auto solid = [](const std::string& modulus, const std::string& density) {
    return with(
        coupled_tube, "material = \"al-5083-h116\"",
        "material = {rho0 = " + density + ", young_modulus = " + modulus + ", poisson_ratio = 0.3, flow = {law = \"elastic\"}}");
  };
  refused(solid("1e300", "2700"), "young_modulus = 1e+300 [Pa] is too large to compute with: it must be at most 1e+30 in size");
  refused(solid("71e9", "1e-300"), "rho0 = 1e-300 [kg/m^3] is too small to compute with: it must be at least 1e-09");
  refused(solid("-1", "2700"), "young_modulus = -1 [Pa] must be greater than 0");
  refused(coupled_tube, "spacing = 5e-324 [m] is too small to compute with", {{"resolution.spacing", "5e-324"}});
}

TEST(Plausibility, MoltenSolidsAreRefused) {
  refused(with(coupled_tube, "material = \"al-5083-h116\"", "material = {base = \"al-5083-h116\", T_room = 2000}"),
          "structure.material.T_room = 2000 [K], the temperature at the start, must lie below the melting point, flow.T_melt = "
          "893 [K]");
  EXPECT_EQ(warnings(with(coupled_tube, "material = \"al-5083-h116\"", "material = {base = \"al-5083-h116\", T_room = 800}")),
            "");
}

TEST(Plausibility, CountsBeyondNumberAreRefusedAtOnce) {
  refused(coupled_tube, "bodies.water would get 1.5", {{"resolution.spacing", "1e-6"}}),
      refused(coupled_tube, "take a larger spacing", {{"resolution.spacing", "1e-6"}});
  refused(coupled_tube, "takes 4.", {{"end_time", "900"}});
  refused(coupled_tube, "is it in s? Else take a larger spacing", {{"end_time", "900"}});
  refused(coupled_tube, "scheme.fixed_step = 1e-20 [s] makes 1e+15 steps", {{"scheme.fixed_step", "1e-20"}});
  refused(coupled_tube, "output.field_interval = 1e-12 [s] makes 1e+07 snapshots", {{"output.field_interval", "1e-12"}});
  refused(coupled_tube, "output.history_interval = 1e-20 [s] makes 1e+15 rows", {{"output.history_interval", "1e-20"}});
}

TEST(Plausibility, MillimetresAreRefused) {
  const std::string hundred = "shape = {type = \"tube\", inner_radius = 44, outer_radius = 50, low = -100, high = 100}";
  refused(
      with(coupled_tube, "shape = {type = \"tube\", inner_radius = 0.044, outer_radius = 0.05, low = -0.1, high = 0.1}", hundred),
      "structure.shape is 200 m long, 1000 times as long as all bodies together (0.2 m): is the mesh in millimetres?");
  refused(two_gases + "[[walls]]\nname = \"tank\"\nshape = {type = \"box\", low = 0, high = 600}\n",
          "walls.tank is 600 m long, 600 times as long as all bodies together (1 m): is it in millimetres?");
}

TEST(Plausibility, StartTimesBeyondTheObstacleAreRefused) {
  const std::string spherical = coupled_tube + "[start]\nkind = \"spherical\"\n";
  refused(spherical, "start.time = 4 [s] must come before end_time", {{"start.time", "4"}});
  // The edge is 44 mm from the middle: burned by 7.2 mm/8300 m/s, then at 1543 m/s by 23.9 + 0.9 us at the latest.
  refused(spherical, "alone the wave reaches its edge, 0.044 m from the charge's middle, at 2.4",
          {{"start.time", "30e-6"}, {"end_time", "1e-4"}});
  EXPECT_EQ(mistakes(spherical, {{"start.time", "5e-6"}}), "");
}

TEST(Plausibility, MirrorImagesAreSaid) {
  const std::string sphere = "shape = {type = \"sphere\", radius = 0.0072}";
  refused(with(coupled_tube, sphere, "shape = {type = \"sphere\", radius = 0.0072, center = [0.002, 0, 0]}"),
          "bodies.charge: its middle lies at x = 0.002 m, off the symmetry plane x = 0, which cuts it");
  warned(with(coupled_tube, sphere, "shape = {type = \"sphere\", radius = 0.0072, center = [0.02, 0, 0]}"),
         "bodies.charge lies off the symmetry plane x = 0: the whole scene has 2 of it");
  warned(with(coupled_tube, sphere, "shape = {type = \"sphere\", radius = 0.0072, center = [0.02, 0, 0.03]}"),
         "bodies.charge lies off the symmetry planes x = 0, z = 0: the whole scene has 4 of it");
  warned(with(coupled_tube, "material = \"petn\"\n", "material = \"petn\"\nburn = {initiation = [0.003, 0, 0]}\n"),
         "bodies.charge.burn: the initiation lies at x = 0.003 m, off the symmetry plane x = 0");
  refused(with(coupled_tube, "material = \"petn\"\n", "material = \"petn\"\nvelocity = [1, 0, 0]\n"),
          "bodies.charge: its velocity across the symmetry plane x = 0, which cuts it, is not its own mirror image");
  refused(with(coupled_tube, "wet = [\"inner\"]", "wet = [\"inner\"]\nvelocity = [0, 0, 3]"),
          "structure.velocity has a component across the symmetry plane z = 0, which the structure touches");
}

const std::string plate_in_water = R"(end_time = 1e-5
[resolution]
spacing = 0.01
[[bodies]]
name = "below"
shape = {type = "box", low = [0, 0, -0.2], high = [0.1, 0.1, 0]}
material = "water-tait"
[[bodies]]
name = "above"
shape = {type = "box", low = [0, 0, 0.02], high = [0.1, 0.1, 0.2]}
material = "water-tait"
[structure]
shape = {type = "plate", low = [0, 0, 0], high = [0.1, 0.1, 0.02]}
material = "steel-4340"
wet = ["z_low", "z_high"]
)";

/// h = 1.5 dx and a kernel of radius 2 h: images in both faces meet up to 2 x 0.03 m less a spacing.
TEST(Plausibility, ThinWallsBetweenWaters) {
  EXPECT_EQ(mistakes(plate_in_water), "") << "wet faces hide what is behind them";
  const std::string dry = with(plate_in_water, "[\"z_low\", \"z_high\"]", "[\"z_low\"]");
  refused(
      dry,
      "structure is 0.02 m thick at [0.003125, 0.003125, 0.02] m with water on both sides: the water's kernel reaches 0.03 m, "
      "so pressure passes through it; add its face 'z_high' to structure.wet; else it needs 0.05 m at least, better 0.06 m, or a "
      "spacing of at most 0.004 m");
  EXPECT_EQ(mistakes(dry, {{"resolution.spacing", "0.004"}}), "");
  EXPECT_EQ(warnings(dry, {{"resolution.spacing", "0.0033"}}), "");
  warned(dry, "so pressure may pass through it", {{"resolution.spacing", "0.0038"}});
  // Air or nothing behind it: any thickness will do.
  EXPECT_EQ(mistakes(with(plate_in_water, "[\"z_low\", \"z_high\"]", "[\"z_low\"]"), {{"bodies.above.shape.low", "[0, 0, 0.1]"}}),
            "");
  refused(R"(dimension = 2
end_time = 1e-4
[resolution]
spacing = 0.01
[[bodies]]
name = "left"
shape = {type = "box", low = [0, 0], high = [0.5, 0.5]}
material = "water-tait"
[[bodies]]
name = "right"
shape = {type = "box", low = [0.51, 0], high = [1, 0.5]}
material = "water-tait"
[[walls]]
name = "a"
shape = {type = "box", low = [0, 0], high = [0.5, 0.5]}
[[walls]]
name = "b"
shape = {type = "box", low = [0.51, 0], high = [1, 0.5]}
)",
          "the rigid wall beside walls.a is 0.01 m thick at [0.5, ");
}

/// Two cubes of a metre from a file, beside water.
class GmshScene : public ::testing::Test {
 protected:
  std::string found(const std::string& low_of_water, const std::string& point = "[0.5, 0.5, 0.5]",
                    const std::string& of_shape = "") {
    std::ifstream file(std::string(UNDEX_ROOT) + "/tests/unit/scene/cubes.msh");
    std::ostringstream mesh;
    mesh << file.rdbuf();
    scratch_.write(mesh_.empty() ? mesh.str() : mesh_, "cubes.msh");
    const std::string text = R"(end_time = 1e-5
[resolution]
spacing = 0.1
[[bodies]]
name = "water"
shape = {type = "box", low = [LOW, 0, 0], high = [4, 1, 1]}
material = "water-tait"
[structure]
shape = {type = "gmsh", path = "cubes.msh"MORE}
material = "steel-4340"
wet = ["8"]
[[probes]]
name = "p"
kind = "structure"
point = POINT
)";
    try {
      std::string all;
      for (const std::string& warning :
           read(scratch_.write(with(with(with(text, "LOW", low_of_water), "POINT", point), "MORE", of_shape))).warnings)
        all += "warning: " + warning;
      return all;
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  void expect(const std::string& found, const std::string& expected) {
    EXPECT_NE(found.find(expected), std::string::npos) << "gave:\n" << found << "\nexpected:\n" << expected;
  }
  scene::test::Scratch scratch_;
  std::string mesh_;
};

TEST_F(GmshScene, GetsTheChecksOfBuiltInShapes) {
  EXPECT_EQ(found("2"), "");
  expect(found("2.3"),
         "the face '8' touches no water: no body comes within two spacings (0.2 m) of it, the nearest is 0.3 m away");
  expect(found("2.15"), "warning: ");
  expect(found("2.15"), "the water begins 0.15 m from the face '8', more than a spacing (0.1 m)");
  expect(found("1.8"), "bodies.water overlaps the structure, e.g. at [");
  expect(found("2", "[0.5, 0.5, 1.4]"), "probes.p.point is 0.4 m away from the structure; move it onto it");
}

/// The cubes end at x = 2 m.
TEST_F(GmshScene, LengthsMayBeScaled) {
  EXPECT_EQ(found("1", "[0.25, 0.25, 0.25]", ", scale = 0.5"), "");
  const std::string resolved = to_toml(read(scratch_.folder() / "case.toml"));
  EXPECT_NE(resolved.find("scale = 0.5"), std::string::npos);
  EXPECT_EQ(to_toml(read(scratch_.write(resolved, "resolved.toml"))), resolved);
  expect(found("2", "[0.25, 0.25, 0.25]", ", scale = 0.5"), "touches no water");
  for (const char* wrong : {"0", "-1", "1e7", "\"1 mm\"", "true"})
    expect(found("2", "[0.5, 0.5, 0.5]", std::string(", scale = ") + wrong), "structure.shape.scale");
  expect(found("2", "[0.5, 0.5, 0.5]", ", scale = 1000"),
         "times as long as all bodies together (2 m): is the mesh in millimetres? Lengths are in m");
  std::ifstream file(std::string(UNDEX_ROOT) + "/tests/unit/scene/cubes.msh");
  bool nodes = false;
  for (std::string line; std::getline(file, line);) {
    nodes = line == "12" || (nodes && line != "$EndNodes");
    double number = 0, x = 0, y = 0, z = 0;
    if (std::istringstream words(line); nodes && words >> number >> x >> y >> z)
      line = std::to_string(int(number)) + ' ' + std::to_string(1e3 * x) + ' ' + std::to_string(1e3 * y) + ' ' +
             std::to_string(1e3 * z);
    mesh_ += line + '\n';
  }
  expect(found("2"), "times as long as all bodies together (2 m): is the mesh in millimetres? Then write scale = 1e-3");
  EXPECT_EQ(found("2", "[0.5, 0.5, 0.5]", ", scale = 1e-3"), "");
}

TEST_F(GmshScene, PiecesThatShareNoNodeAreSaid) {
  const auto mesh_with_gap = [](const std::string& x) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n16\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 "
           "1 1\n"
           "9 " +
           x + " 0 0\n10 2 0 0\n11 2 1 0\n12 " + x + " 1 0\n13 " + x + " 0 1\n14 2 0 1\n15 2 1 1\n16 " + x +
           " 1 1\n$EndNodes\n"
           "$Elements\n3\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 1 1 9 10 11 12 13 14 15 16\n3 3 2 8 8 10 11 15 14\n$EndElements\n";
  };
  mesh_ = mesh_with_gap("1.25");
  expect(found("2"), "the mesh is in 2 pieces that share no node; the first and the next are 0.25 m apart at [1.25, ");
  mesh_ = mesh_with_gap("1.0001");
  expect(found("2"), "and touch or overlap, but nothing holds them together");
  mesh_ = "$MeshFormat\n2.2 0 8\n";
  expect(found("2"), "cubes.msh:2: the file ends within $MeshFormat");
}

/// A flange of 0.3 m x 0.2 m with a web under it, of shells.
class GmshShells : public GmshScene {
 protected:
  std::string found(const std::string& structure) {
    const std::string mesh = std::string(UNDEX_ROOT) + "/tests/unit/scene/";
    try {
      std::string all;
      const std::string text =
          with(with("end_time = 1e-5\n[structure]\n" + structure, "TEE", mesh + "tee.msh"), "CUBES", mesh + "cubes.msh");
      for (const std::string& warning : read(scratch_.write(text)).warnings) all += "warning: " + warning;
      return all;
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  static std::string with(std::string text, const std::string& old, const std::string& replacement) {
    const std::size_t at = text.find(old);
    return at == std::string::npos ? text : text.replace(at, old.size(), replacement);
  }
};

TEST_F(GmshShells, GroupsAndThicknessAreChecked) {
  const std::string shell = "element = \"shell\"\nshape = {type = \"gmsh\", path = \"TEE\", thickness = 0.01}\n",
                    steel = "material = \"steel-4340\"\n";
  EXPECT_EQ(found(shell + steel), "");
  EXPECT_EQ(
      found(shell + "parts = [{group = \"web\", material = \"steel-4340\"}, {group = \"1\", material = \"copper-ofhc\"}]\n"), "");
  expect(found(shell), "structure.material is missing");
  expect(found(shell + "parts = [{group = \"web\", material = \"steel-4340\"}]\n"),
         "the group 'flange' of the mesh has no material");
  expect(found(shell + steel + "parts = [{group = \"wep\", thickness = 0.02}]\n"),
         "structure.parts.0.group: the mesh has no group 'wep'; its groups are flange, web");
  expect(found(shell + steel + "parts = [{group = \"web\", thickness = 0.02}, {group = \"2\", thickness = 0.01}]\n"),
         "structure.parts.1.group: the group 'web' has a part already");
  expect(found(shell + steel + "parts = [{group = \"web\", offset = \"middle\"}]\n"), "structure.parts.0.offset");
  expect(found(shell + steel + "parts = [{group = \"web\", thickness = 0}]\n"), "structure.parts.0.thickness");
  expect(found(shell + steel + "supports = [{face = \"rot\"}]\n"),
         "structure.supports.0.face: the mesh has no face 'rot'; its faces are 0, root, flange.bottom");
  expect(found(shell + steel + "wet = [\"flange\"]\n"), "structure.wet: the mesh has no face 'flange'");
  expect(found("element = \"shell\"\nshape = {type = \"gmsh\", path = \"TEE\", thickness = 400}\n" + steel),
         "structure.shape.thickness = 400 [m] is more than the mesh is long");
  const std::string bare = "element = \"shell\"\nshape = {type = \"gmsh\", path = \"TEE\"}\n" + steel;
  expect(found(bare), "the shells of the group 'flange' have no thickness; give shape.thickness, or a part {group = \"flange\"");
  EXPECT_EQ(found(bare + "parts = [{group = \"web\", thickness = 0.01}, {group = \"flange\", thickness = 0.02}]\n"), "");
  expect(found(bare + "parts = [{group = \"web\", thickness = 0.01}, {group = \"flange\", thickness = 0.3}]\n"),
         "too thick for its cells");
  // Hexahedra where quadrangles are, and the other way round.
  expect(found("shape = {type = \"gmsh\", path = \"TEE\"}\n" + steel),
         "or element = \"shell\" with a thickness for its quadrangles");
  expect(found("element = \"shell\"\nshape = {type = \"gmsh\", path = \"CUBES\", thickness = 0.1}\n" + steel),
         "a hexahedron: the mesh of a shell must hold quadrangles only");
  const std::string solid = "shape = {type = \"gmsh\", path = \"CUBES\"}\n" + steel;
  EXPECT_EQ(found(solid), "");
  expect(found(solid + "parts = [{group = \"1\", thickness = 0.1}]\n"), "structure.parts.0.thickness is one of shells");
  expect(found("shape = {type = \"gmsh\", path = \"CUBES\", offset = \"top\"}\n" + steel),
         "structure.shape.offset is one of shells");
  expect(found("shape = {type = \"plate\", low = [0, 0, 0], high = [1, 1, 0.1]}\nparts = [{group = \"1\"}]\n" + steel),
         "structure.parts are groups of a gmsh mesh; a plate is of one material");
}

TEST_F(GmshScene, FacesAreCalledByNameOrNumber) {
  std::ifstream file(std::string(UNDEX_ROOT) + "/tests/unit/scene/cubes.msh");
  std::ostringstream mesh;
  mesh << file.rdbuf();
  scratch_.write(mesh.str(), "cubes.msh");
  const std::string text = R"(end_time = 1e-5
[structure]
shape = {type = "gmsh", path = "cubes.msh"}
material = "steel-4340"
supports = [{face = "7"}, {face = "wet side", fixed = ["x"]}]
)";
  const scene::Scene scene = read(scratch_.write(text));
  for (const Support& support : scene.structures.front().supports) EXPECT_EQ(support.face, "wet side");
}

TEST(Plausibility, PlacesAreKnownAfterReading) {
  const scene::Scene scene = read_text(coupled_tube, {{"structure.courant", "0.5"}});
  EXPECT_EQ(scene.places.finding("bodies.water.shape", "").where.line, 16);
  EXPECT_EQ(scene.places.finding("bodies.water.spacing", "").where.line, 14);
  EXPECT_EQ(scene.places.finding("structure.courant", "no").message, "-P structure.courant: no");
}

}  // namespace
