// Each kind of mistake in a key: place, words and remedy; all of them at once.
#include <gtest/gtest.h>

#include <algorithm>

#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene::test;

TEST(Mistakes, SyntaxHasItsPlace) {
  const std::string found = mistakes("end_time = 1\ndimension = = 2\n");
  EXPECT_TRUE(found.starts_with("2:13: not TOML: ")) << found;
  EXPECT_NE(mistakes("end_time = 1\nend_time = 2\n").find("not TOML"), std::string::npos);
}

TEST(Mistakes, AllAtOnceInOrderOfTheFile) {
  EXPECT_EQ(mistakes(R"(dimension = 1
end_tme = 0.1
[resolution]
spacing = -0.01
[[bodies]]
name = "left"
shape = {type = "box", low = 0, high = 0.5}
material = "aer"
density = "1"
)"),
            "1:1: end_time is missing; give it in s, e.g. end_time = 1e-4\n"
            "2:1: unknown key 'end_tme' at the top of the file; did you mean 'end_time'?\n"
            "4:11: resolution.spacing = -0.01 [m] must be greater than 0 and at most 1e+05\n"
            "8:12: bodies.left.material: unknown material 'aer'; did you mean 'air'? ('undex materials' lists them)\n"
            "9:11: bodies.left.density = \"1\" has no unit: write the number without quotes, or name its unit\n");
}

struct Mistake {
  const char* what;
  std::string scene;
  std::string expected;
};

TEST(Mistakes, EachHasPlaceAndRemedy) {
  const std::vector<Mistake> all{
      {"unknown key", with(two_gases, "density = 0.125", "densty = 0.125"),
       "17:1: unknown key 'densty' in bodies.right; did you mean 'density'?\n"},
      {"unknown key of another table", with(two_gases, "spacing = 0.01", "spacing = 0.01\ncourant = 0.3"),
       "6:1: unknown key 'courant' in resolution; it belongs to [scheme]\n"},
      {"unknown key like nothing", with(two_gases, "density = 0.125", "colour = 0.125"),
       "17:1: unknown key 'colour' in bodies.right; known: name, shape, mass, subtract, material, spacing, velocity, "
       "radial_velocity, "
       "spin, "
       "radial, "
       "pressure, "
       "level, density, energy, burn, variable_h, split\n"},
      {"unknown key of a shape", with(two_gases, "low = 0.5, high = 1", "low = 0.5, high = 1, radius = 2"),
       "15:45: unknown key 'radius' in bodies.right.shape; known: type, low, high, rotate, about, move\n"},
      {"unknown key of a material", with(two_gases, "gamma = 1.4}\nenergy", "gama = 1.4}\nenergy"),
       "10:12: bodies.left.material.gamma is missing; a law without 'base' needs all its parameters\n"
       "10:42: unknown key 'gama' in bodies.left.material; did you mean 'gamma'?\n"},
      {"missing key", with(two_gases, "spacing = 0.01", ""),
       "4:1: resolution.spacing is missing; give the distance of particles in m, e.g. spacing = 0.002\n"},
      {"missing table", with(two_gases, "[resolution]\nspacing = 0.01", ""),
       "1:1: resolution.spacing is missing; add [resolution] with spacing = (particle distance in m)\n"},
      {"wrong type", with(two_gases, "density = 0.125", "density = 0.125\nvariable_h = \"yes\""),
       "18:14: bodies.right.variable_h must be true or false, not the text \"yes\"\n"},
      {"local steps of a Runge-Kutta method",
       with(two_gases, "spacing = 0.01", "spacing = 0.01\n[scheme]\nintegrator = \"ssp_rk3\"\nlocal_steps = true"),
       "8:15: scheme.local_steps = true needs scheme.integrator = \"leapfrog\": a Runge-Kutta step is one for all; leave one of "
       "them out\n"},
      {"particle shifting, which is no more", with(two_gases, "spacing = 0.01", "spacing = 0.01\n[scheme]\nshifting = 0.5"),
       "7:1: unknown key 'shifting' in scheme; known: name, kernel, "},
      {"too small for single precision", with(two_gases, "spacing = 0.01", "spacing = 1e-5\n[scheme]\nprecision = \"mixed\""),
       "7:13: scheme.precision = \"mixed\" needs a resolution.spacing of at least 2e-05 m: finer lengths leave the range of "
       "single precision; take \"full\"\n"},
      {"not a whole number", with(two_gases, "dimension = 1", "dimension = 1\nthreads = 1.5"),
       "2:11: threads must be a whole number, not the number 1.5\n"},
      {"not a table", with(two_gases, "dimension = 1", "dimension = 1\noutput = 3"),
       "2:10: output must be a table, [output], not the number 3\n"},
      {"not an array of tables", with(two_gases, "dimension = 1", "dimension = 1\nwalls = {name = \"a\"}"),
       "2:9: walls must be written as [[walls]], not a table\n"},
      {"range", with(two_gases, "end_time = 0.1", "end_time = 0"),
       "2:12: end_time = 0 [s] must be greater than 0 and at most 1000\n"},
      {"not finite", with(two_gases, "energy = 2\n", "energy = nan\n"),
       "18:10: bodies.right.energy = nan [J/kg] must be a finite number\n"},
      {"negative density", with(two_gases, "density = 0.125", "density = -1"),
       "17:11: bodies.right.density = -1 [kg/m^3] must be greater than 0\n"},
      {"dimension", with(two_gases, "dimension = 1", "dimension = 4"), "1:13: dimension = 4 must be from 1 to 3\n"},
      {"geometry", with(two_gases, "dimension = 1", "dimension = \"sperical\""),
       "1:13: dimension: unknown 'sperical'; did you mean 'spherical'?\n"},
      {"components", with(coupled_tube, "point = [0.044, 0, 0]", "point = [0.044, 0]"),
       "30:9: probes.wall.point must be an array of 3 numbers, not an array of 2\n"},
      {"choice", with(coupled_tube, "kind = \"wall\"", "kind = \"wal\""),
       "29:8: probes.wall.kind: unknown 'wal'; did you mean 'wall'?\n"},
      {"quantity", with(coupled_tube, "point = [0.05, 0, 0]", "point = [0.05, 0, 0]\nquantities = [\"presure\", \"velocity\"]"),
       "36:14: probes.outer.quantities: unknown 'presure'; known: displacement, velocity, stress, plastic_strain, temperature\n"},
      {"field", two_gases + "[output]\nparticle_fields = [\"densty\"]\n",
       "20:19: output.particle_fields: unknown 'densty'; did you mean 'density'?\n"},
      {"shape type", with(coupled_tube, "type = \"sphere\"", "type = \"shpere\""),
       "11:17: bodies.charge.shape.type must be one of box, slab, sphere, cylinder, tube, cone, ellipsoid, half_space, "
       "revolution, stl, union, intersection, difference, not the text \"shpere\"; did you "
       "mean 'sphere'?\n"},
      {"upside down", with(two_gases, "low = 0, high = 0.5", "low = 0.5, high = 0.5"),
       "9:42: bodies.left.shape.high: along x, high = 0.5 must be greater than low = 0.5\n"},
      {"inside out", with(coupled_tube, "inner_radius = 0.044", "inner_radius = 0.06"),
       "22:61: structure.shape.outer_radius = 0.05 must be greater than inner_radius = 0.06\n"},
      {"solid as a fluid", with(coupled_tube, "\"water-tait\"", "\"al-6061-t6\""),
       "18:12: bodies.water.material: 'al-6061-t6' is a solid, not a fluid; take one that is"},
      {"unattainable pressure", with(coupled_tube, "pressure = 1e5", "pressure = -1e9"),
       "19:12: bodies.water.pressure = -1e+09 Pa: "},
      {"energy of a barotropic law", with(coupled_tube, "pressure = 1e5", "energy = 1e5"),
       "19:10: bodies.water.energy: the law of 'water-tait' is barotropic, it has no energy; leave it out\n"},
      {"burn of water", with(coupled_tube, "pressure = 1e5", "burn = {}"),
       "19:8: bodies.water.burn: the material 'water-tait' does not burn; only law \"jwl\" does\n"},
      {"symmetry beyond the dimension", two_gases + "[symmetry]\nplanes = [\"x\", \"z\"]\n",
       "20:10: symmetry.planes names \"z\", but the scene has dimension = 1; leave it out or raise the dimension\n"},
      {"support", with(coupled_tube, "wet = [\"inner\"]", "wet = [\"inner\"]\nsupports = [{face = \"hihg\"}]"),
       "26:21: structure.supports.0.face: unknown 'hihg'; did you mean 'high'?\n"},
      {"face that symmetry cuts away",
       with(coupled_tube, "wet = [\"inner\"]", "wet = [\"inner\"]\nsupports = [{face = \"low\"}]"),
       "26:21: structure.supports.0.face: the face 'low' lies beyond a symmetry plane, which stands for it: name the face on the "
       "kept side, which holds for both; it is one of inner, outer, high\n"},
      {"shell of a rod",
       "end_time = 1e-5\n[structure]\nmaterial = \"copper-ofhc\"\nelement = \"shell\"\nshape = {type = \"rod\", radius = 1, low "
       "= 0, high = 9}\n",
       "4:11: structure.element = \"shell\" needs a wall whose thickness direction is known, that of a tube, ring or plate (or "
       "of a rod "
       "with dimension = \"axisymmetric\", a disc); "
       "use \"hexahedron\" for a rod\n"},
      {"wet face", with(coupled_tube, "wet = [\"inner\"]", "wet = [\"inside\"]"), "25:7: structure.wet: unknown 'inside'"},
      {"cells that symmetry cannot halve", with(coupled_tube, "along = 20", "along = 21"),
       "23:44: structure.cells.along = 21 must be a multiple of 2: it counts the whole body, which a symmetry plane halves; "
       "e.g. 22\n"},
      {"load",
       with(coupled_tube, "wet = [\"inner\"]",
            "wet = [\"inner\"]\nloads = [{face = \"outer\", time = [0, 1, 1], pressure = [1, 2]}]"),
       "26:34: structure.loads.0.time must increase: 1 follows 1\n"
       "26:56: structure.loads.0: time has 3 values and pressure 2; give as many of each, at least one\n"},
      {"structure below three dimensions",
       two_gases + "[structure]\nmaterial = \"copper-ofhc\"\n"
                   "shape = {type = \"plate\", low = [0, 0, 0], high = [1, 1, 1]}\n",
       "19:1: [structure] needs dimension = 3, but the scene has dimension = 1\n"},
      {"coupling of nothing", two_gases + "[coupling]\nslip = false\n",
       "19:1: [coupling] has nothing to couple: the scene has no [structure] and no [[solids]]; remove it or add one\n"},
      {"circle of materials",
       with(two_gases, "dimension = 1", "dimension = 1\nmaterials = {a = {base = \"b\"}, b = {base = \"a\"}}"),
       "the materials are based on each other in a circle; base one of them on the library\n"},
      {"Taylor bar without a bar", two_gases + "[comparison]\nkind = \"taylor_bar\"\n",
       "20:8: comparison.kind = \"taylor_bar\" compares the shape of a [structure] of type \"rod\", or of the first of "
       "[[solids]], a cylinder; there is none\n"},
      {"profile without a solution", two_gases + "[comparison]\nkind = \"profile\"\n",
       "19:1: comparison.solution is missing; name the exact solution, e.g. solution = \"riemann\"\n"},
      {"profile with an unknown solution", two_gases + "[comparison]\nkind = \"profile\"\nsolution = \"rieman\"\n",
       "21:12: comparison.solution: unknown 'rieman'; did you mean 'riemann'?\n"},
      {"profile of bodies apart",
       with(two_gases, "low = 0.5, high = 1", "low = 0.6, high = 1") +
           "[comparison]\nkind = \"profile\"\nsolution = \"riemann\"\n",
       "21:12: comparison.solution: \"riemann\" needs bodies that meet in one plane across x; 'left' ends at x = 0.500000 m, "
       "'right' begins at 0.600000 m\n"},
      {"profile of another problem", two_gases + "[comparison]\nkind = \"profile\"\nsolution = \"noh\"\n",
       "21:12: comparison.solution: \"noh\" needs one body alone, of law \"ideal_gas\", without energy and with a negative "
       "radial_velocity\n"},
      {"profile of two unlike gases", two_gases + "[comparison]\nkind = \"profile\"\nsolution = \"sedov\"\n",
       "21:12: comparison.solution: \"sedov\" needs two bodies at rest of one ideal gas"},
      {"profile without a charge", two_gases + "[comparison]\nkind = \"profile\"\nsolution = \"taylor_wave\"\n",
       "21:12: comparison.solution: \"taylor_wave\" needs one body alone, a charge at rest with a programmed burn\n"},
      {"profile of a metal that is torn apart",
       "dimension = 1\nend_time = 1e-6\n[resolution]\nspacing = 1e-3\n"
       "[materials]\nmetal = {law = \"mie_gruneisen\", rho0 = 2710, C0 = 5300, S1 = 1.5, S2 = 0, S3 = 0, gamma0 = 1.7, alpha = "
       "0, "
       "cavitation = \"none\"}\n"
       "[[bodies]]\nname = \"left\"\nmaterial = \"metal\"\nshape = {type = \"box\", low = 0, high = 0.5}\nvelocity = -6180\n"
       "[[bodies]]\nname = \"right\"\nmaterial = \"metal\"\nshape = {type = \"box\", low = 0.5, high = 1}\n"
       "[comparison]\nkind = \"profile\"\nsolution = \"riemann\"\n",
       "18:12: comparison.solution: these bodies have no such solution: the fluids are pulled apart by more than their laws can "
       "carry, -1.65659e+10 Pa; a law that cavitates has a solution, e.g. with cavitation = \"cutoff\"; change their states or "
       "laws, or leave out [comparison]\n"},
      {"window the wrong way round", two_gases + "[comparison]\nkind = \"profile\"\nsolution = \"riemann\"\nwindow = [1, 0]\n",
       "22:10: comparison.window must be [least, largest] coordinate in m, the first below the second\n"},
      {"window without a profile", two_gases + "[comparison]\nkind = \"none\"\nwindow = [0, 1]\n",
       "21:10: comparison.window belongs to kind = \"profile\"; leave it out\n"},
      {"stiffened gas without energy",
       with(two_gases, "{law = \"ideal_gas\", rho0 = 1, gamma = 1.4}\ndensity = 0.125\nenergy = 2",
            "{law = \"stiffened_gas\", rho0 = 1, gamma = 4.4, p_inf = 6}\ndensity = 0.125"),
       "13:1: bodies.right.energy is missing; law \"stiffened_gas\" has the pressure p at e = (p + gamma p_inf)(1 - b "
       "rho)/((gamma - 1) rho) + q\n"},
      {"plane wave without its keys", two_gases + "[start]\nkind = \"plane_wave\"\nbody = \"left\"\n",
       "19:1: start.axis is missing; name the axis along which the wave runs\n"
       "19:1: start.front is missing; give the position of the wave's front along its axis in m\n"
       "19:1: start.peak is missing; give the wave's largest pressure above that at rest in Pa\n"
       "19:1: start.decay is missing; give the time in s over which the wave falls by e\n"},
      {"plane wave in which body",
       two_gases + "[start]\nkind = \"plane_wave\"\naxis = \"x\"\nfront = 0.2\npeak = 1\ndecay = 1e-3\n",
       "19:1: start.kind = \"plane_wave\": the scene has several bodies; name the one that carries the wave by start.body\n"},
      {"plane wave along no axis",
       two_gases + "[start]\nkind = \"plane_wave\"\nbody = \"left\"\naxis = \"z\"\nfront = 0.2\npeak = 1\ndecay = 1e-3\n",
       "22:8: start.axis: the scene has dimension = 1 and no such axis\n"},
      {"plane wave through a symmetry plane",
       two_gases + "[symmetry]\nplanes = [\"x\"]\n[start]\nkind = \"plane_wave\"\nbody = \"left\"\naxis = \"x\"\nfront = "
                   "0.2\npeak = 1\ndecay = 1e-3\n",
       "24:8: start.axis: the wave would run through a symmetry plane, where its mirror image comes to meet it; leave the plane "
       "out, or let "
       "the wave run along another axis\n"},
      {"key of a plane wave alone", two_gases + "[start]\npeak = 1e6\n",
       "20:8: start.peak is of start.kind = \"plane_wave\"; leave it out or set the kind\n"},
      {"plate comparison without wave",
       two_gases + "[[probes]]\nname = \"a\"\npoint = 0.2\n[comparison]\nkind = \"taylor_plate\"\nprobe = \"a\"\n",
       "23:8: comparison.kind = \"taylor_plate\" needs start.kind = \"plane_wave\" and a [structure] of type \"plate\", or of "
       "type "
       "\"rod\" along the wave: a disc\n"
       "24:9: comparison.probe must be a structure probe: the plate's velocity is compared\n"},
      {"free field of no charge", two_gases + "[comparison]\nkind = \"free_field\"\n",
       "20:8: comparison.kind = \"free_field\" needs dimension = 3 and two bodies: a \"sphere\" of gas or of a charge, and the "
       "medium from "
       "which it is subtracted\n20:8: comparison.kind = \"free_field\" compares the pressures of fluid probes; add [[probes]]\n"},
      {"comparison", two_gases + "[comparison]\nkind = \"tube\"\nprobe = \"outer\"\nreference = \"none.csv\"\n",
       "21:9: comparison.probe: no probe 'outer'\n22:13: comparison.reference: no file '"},
      {"unknown key of a solid", with(impact, "velocity =", "veloctiy ="),
       "13:1: unknown key 'veloctiy' in solids.ball; did you mean 'velocity'?\n"},
      {"description", with(impact, "velocity = [0, 0, -1000]", "description = \"lagrangian\""),
       "13:15: solids.ball.description: unknown 'lagrangian'"},
      {"rings of a box", with(impact, "velocity = [0, 0, -1000]", "lattice = \"rings\""),
       "13:11: solids.ball.lattice = \"rings\" needs a cylinder or tube, round in the scene; take \"cartesian\"\n"},
      {"face of a solid", with(bathed_disc, "wet = [\"side\"]", "wet = [\"sides\"]"),
       "17:7: solids.disc.wet: unknown 'sides'; did you mean 'side'?\n"},
      {"residual stress of no disc", with(impact, "velocity = [0, 0, -1000]", "residual_stress = 1e8"),
       "13:19: solids.ball.residual_stress needs a whole cylinder or disc"},
      {"spin out of the plane", with(bathed_disc, "wet = [\"side\"]", "spin = [1, 0, 0]"),
       "17:8: solids.disc.spin must be a number in rad/s in two dimensions: only z is left to turn about\n"},
      {"solid without spacing", with(impact, "spacing = 0.001", ""),
       "3:1: resolution.spacing is missing; give the distance of particles in m, e.g. spacing = 0.002\n"},
      {"solid of water", with(bathed_disc, "\"copper-ofhc\"", "\"water-tait\""),
       "16:12: solids.disc.material: 'water-tait' is a fluid"},
      {"solids in one dimension",
       two_gases + "[[solids]]\nname = \"s\"\nshape = {type = \"box\", low = 2, high = 3}\n"
                   "material = \"copper-ofhc\"\n",
       "19:1: [[solids]] need dimension = 2 (plane strain) or 3, but the scene has dimension = 1\n"},
      {"solids and structure",
       coupled_tube + "[[solids]]\nname = \"s\"\nshape = {type = \"sphere\", center = [1, 0, 0], radius = 0.1}\n"
                      "material = \"copper-ofhc\"\n",
       "21:1: [structure] and [[solids]] in one scene are not built"},
      {"unknown history", two_gases + "[output]\nhistories = [\"body\"]\n",
       "20:13: output.histories: unknown 'body'; known: bodies, largest, forces, one_dimensional\n"},
      {"history twice", two_gases + "[output]\nhistories = [\"forces\", \"forces\"]\n",
       "20:13: output.histories names 'forces' twice; name it once\n"},
      {"one-dimensional flow of no charge", two_gases + "[output]\nhistories = [\"one_dimensional\"]\n",
       "20:13: output.histories with \"one_dimensional\" needs space and one spherical body of gas or products; leave the word "
       "out, or "
       "name the charge by start.body\n"},
      {"line of one point", two_gases + "[[lines]]\nname = \"a\"\nfrom = 0.1\nto = 0.1\npoints = 1\ntimes = [0.1]\n",
       "22:6: lines.a.to is the point `from` as well; give the line another end\n"
       "23:10: lines.a.points = 1 must be from 2 to 1e+05\n"},
      {"line that is never written", two_gases + "[[lines]]\nname = \"a\"\nfrom = 0.1\nto = 0.2\n",
       "19:1: lines.a has neither an interval nor times, and no profile would be written; give one of the two [s]\n"},
      {"line of what fluid has not",
       two_gases + "[[lines]]\nname = \"a\"\nfrom = 0.1\nto = 0.2\ntimes = [0.1]\nquantities = [\"stress\"]\n",
       "24:14: lines.a.quantities: unknown 'stress'; known: pressure, velocity, density, void_fraction\n"},
      {"plane across no axis", with(bathed_disc, "[[probes]]", "[[planes]]\naxis = \"z\"\n[[probes]]"),
       "20:8: planes.0.axis: the scene has dimension = 2, so no such axis\n"},
      {"planes without solids", two_gases + "[[planes]]\naxis = \"x\"\n",
       "19:1: [[planes]] stop solids only, and the scene has neither [[solids]] nor a [structure]; for fluid take [[walls]]\n"},
      {"side of a plane", with(impact, "position = -0.01", "free_side = \"left\""),
       "22:13: planes.0.free_side: unknown 'left'; known: above, below\n"},
      {"field of solids", impact + "[output]\nsolid_fields = [\"mises\"]\n", "28:16: output.solid_fields: unknown 'mises'"},
      {"switch without room", two_gases + "[scheme]\nname = \"monaghan_switch\"\nalpha = 0.05\n",
       "21:9: scheme.alpha = 0.05 is the upper bound of a coefficient whose lower one is scheme.alpha_min = 0.1 with scheme.name "
       "= "
       "\"monaghan_switch\": raise alpha or lower alpha_min (without viscosity: scheme.name = \"monaghan\")\n"},
      {"scheme without solids", two_gases + "[solid_scheme]\neta = 1.2\n",
       "19:1: [solid_scheme] without [[solids]]: add one, or remove it\n"},
      {"nothing", "end_time = 1\n",
       "1:1: the scene has neither [[bodies]] nor [[solids]] nor a [structure]: there is nothing to compute; add one\n"},
  };
  for (const Mistake& each : all) {
    const std::string found = mistakes(each.scene);
    EXPECT_NE(found.find(each.expected), std::string::npos) << each.what << " gave:\n" << found << "expected:\n" << each.expected;
  }
}

TEST(Mistakes, OfSolids) {
  const std::string alone =
      "end_time = 1\n[structure]\nshape = {type = \"plate\", low = [0, 0, 0], high = [1, 1, 1]}\nmaterial = ";
  const std::string steel = "{rho0 = 7800, young_modulus = 2e11, poisson_ratio = 0.3, ";
  const std::string za = "{law = \"zerilli_armstrong\", ", damage = "{D1 = 0.1, D2 = 0.2, D3 = -1, D4 = 0, D5 = 0";
  const std::string at = "structure.material.", needs = "; a law without 'base' needs all its parameters\n";
  const std::vector<Mistake> all{
      {"law unknown", steel + "flow = {law = \"cowper\"}}",
       at + "flow.law must be one of elastic, linear_hardening, johnson_cook, power_hardening, cowper_symonds, "
            "zerilli_armstrong, not the text \"cowper\""},
      {"law missing", steel + "flow = {Y0 = 1e8}}",
       at + "flow.law is missing; one of elastic, linear_hardening, johnson_cook, power_hardening, cowper_symonds, "
            "zerilli_armstrong\n"},
      {"Cowper-Symonds without D", steel + "flow = {law = \"cowper_symonds\", Y0 = 1e8, H = 0, q = 5}}",
       at + "flow.D is missing" + needs},
      {"negative D", steel + "flow = {law = \"cowper_symonds\", Y0 = 1e8, H = 0, D = -40, q = 5}}",
       "4:122: " + at + "flow.D = -40 [1/s] must be greater than 0\n"},
      {"q", steel + "flow = {law = \"cowper_symonds\", Y0 = 1e8, H = 0, D = 40, q = 0}}",
       at + "flow.q = 0 must be greater than 0 and at most 100\n"},
      {"n too large", steel + "flow = {law = \"power_hardening\", A = 1e8, B = 1e8, n = 20}}",
       at + "flow.n = 20 must be greater than 0 and at most 10\n"},
      {"softening", steel + "flow = {law = \"power_hardening\", A = 1e8, B = -1e8, n = 1}}",
       at + "flow.B = -1e+08 [Pa] must be at least 0\n"},
      {"Zerilli-Armstrong without C3", steel + "flow = " + za + "C0 = 1e8, C4 = 1e-4}}", at + "flow.C3 is missing" + needs},
      {"Zerilli-Armstrong without strength", steel + "flow = " + za + "C0 = 0, C2 = 1e9, C3 = 1e-3, C4 = 1e-4}}",
       "4:76: " + at + "flow.C0 and C1 are both 0: nothing would resist the first strain; one of them must be greater than 0\n"},
      {"molten at home", "{base = \"al-6061-t6\", flow = {T_melt = 200}}",
       at + "flow.T_melt = 200 [K] must be greater than its T_room = 293 [K]\n"},
      {"spall without strength", "{base = \"al-6061-t6\", spall = {mode = \"fail\"}}",
       at + "spall.strength is missing; give the tension in Pa at which the material parts, e.g. strength = 1e9\n"},
      {"pressure for tension", "{base = \"al-6061-t6\", spall = {strength = -1e9}}",
       at + "spall.strength = -1e+09 [Pa] must be greater than 0\n"},
      {"spall mode", "{base = \"al-6061-t6\", spall = {strength = 1e9, mode = \"fails\"}}",
       at + "spall.mode: unknown 'fails'; did you mean 'fail'?\n"},
      {"spall as a number", "{base = \"al-6061-t6\", spall = 1e9}", at + "spall must be a table"},
      {"damage constant missing", "{base = \"al-6061-t6\", damage = {D1 = 0.1, D2 = 0.2, D3 = -1, D4 = 0}}",
       at +
           "damage.D5 is missing; Johnson and Cook's fracture strain needs D1 to D5; write 0 for a term that it does not have\n"},
      {"sign of D3", "{base = \"al-6061-t6\", damage = {D1 = 0.1, D2 = 0.2, D3 = 1, D4 = 0, D5 = 0}}",
       at + "damage.D3 = 1 must be from -100 to 0\n"},
      {"damage without a melting point", "{base = \"al-5086-za\", damage = " + damage + "}}",
       at + "damage.T_melt is missing; give the melting temperature in K: only a flow stress of law \"johnson_cook\" brings "
            "one\n"},
      {"broken from the start", "{base = \"al-6061-t6\", damage = {D1 = -0.5, D2 = 0.25, D3 = 0, D4 = 0, D5 = 0}}",
       at + "damage: D1 + D2 exp(1.5 D3) = -0.25 must be greater than 0: it is the fracture strain in the highest tension that "
            "counts\n"},
      {"unknown key of damage", "{base = \"al-6061-t6\", damage = " + damage + ", D6 = 1}}",
       "unknown key 'D6' in " + at + "damage"},
  };
  for (const Mistake& each : all) {
    const std::string found = mistakes(alone + each.scene + "\n");
    EXPECT_NE(found.find(each.expected), std::string::npos) << each.what << " gave:\n" << found << "expected:\n" << each.expected;
  }
  EXPECT_EQ(mistakes(alone + "{base = \"al-5086-za\", damage = " + damage + ", T_melt = 893}, spall = {strength = 1e9}}\n"), "");
}

TEST(Mistakes, SuggestionsArePlausible) {
  const auto of = [](const std::string& scene) { return mistakes(scene); };
  const std::string unknown = of(with(coupled_tube, "\"petn\"", "\"semtex-plastic\""));
  EXPECT_NE(unknown.find("unknown material 'semtex-plastic'; the names most like it: "), std::string::npos) << unknown;
  EXPECT_LT(std::count(unknown.begin(), unknown.end(), ','), 6) << unknown;
  const std::string steel = of(with(coupled_tube, "\"al-5083-h116\"", "\"steel\""));
  EXPECT_NE(steel.find("did you mean"), std::string::npos) << steel;
  EXPECT_EQ(of(with(two_gases, "energy = 2.5", "w = 2.5")).find("did you mean"), std::string::npos);
  const std::string half = of(with(two_gases, "{type = \"box\", low = 0, high = 0.5}", "{type = \"half_space\", normal = 1}"));
  EXPECT_EQ(half.find("slab"), std::string::npos) << half;
  EXPECT_NE(half.find("has no end along x; take a box, or cut one with it by \"intersection\""), std::string::npos) << half;
  const std::string coarse = of(with(two_gases, "spacing = 0.01", "spacing = 10"));
  EXPECT_NE(coarse.find("is the spacing in mm?"), std::string::npos) << coarse;
}

TEST(Mistakes, OfAMass) {
  const auto expect = [](const std::string& scene, const std::string& expected) {
    const std::string found = mistakes(scene);
    EXPECT_NE(found.find(expected), std::string::npos) << "gave:\n" << found << "expected:\n" << expected;
  };
  const auto charge = [](const std::string& shape, const std::string& more, const std::string& dimension = "") {
    return dimension + "end_time = 1e-5\n[resolution]\nspacing = 0.002\n[[bodies]]\nname = \"charge\"\nshape = " + shape +
           "\nmaterial = \"tnt\"\n" + more;
  };
  const std::string ball = "{type = \"sphere\"}";
  expect(charge(ball, ""), "bodies.charge.shape.radius is missing");
  expect(charge(ball, "mass = 0"), "8:8: bodies.charge.mass = 0 [kg] must be greater than 0");
  expect(charge(ball, "mass = \"5 cm\""), "bodies.charge.mass = \"5 cm\" is none in units of kg");
  expect(charge(ball, "mass = true"), "bodies.charge.mass must be a number in kg, not true");
  expect(charge("{type = \"cylinder\", radius = 0.02, low = 0, high = 0.1}", "mass = 0.1"),
         "bodies.charge.mass needs a sphere, not a \"cylinder\"; leave it out and give the shape's lengths");
  expect(charge("{type = \"sphere\", radius = 0.02}", "mass = 0.05"),
         "bodies.charge.mass = 0.05 [kg] and the radius 0.02 m contradict each other: at 1630 kg/m^3 that sphere has 0.0546");
  expect(charge(ball, "mass = 0.05", "dimension = 2\n"), "needs a sphere in space, and the scene has dimension = 2");
  expect(charge(ball, "mass = 0.05\nsubtract = [{type = \"sphere\", radius = 0.01}]"),
         "bodies.charge.mass needs a whole sphere, and `subtract` takes some of it");
  expect(charge(ball, "mass = 0.05\n[materials.tnt]\nrho0 = -1"), "materials.tnt");
}

TEST(Mistakes, GoodScenesHaveNone) {
  EXPECT_EQ(mistakes(coupled_tube), "");
  EXPECT_EQ(mistakes(two_gases), "");
  EXPECT_EQ(mistakes(impact), "");
  EXPECT_EQ(mistakes(bathed_disc), "");
}

TEST(Mistakes, OfAMaterialUsedTwiceAreReportedOnce) {
  std::string scene = two_gases;
  for (const char* name : {"left", "right"})
    scene = with(scene, std::string("name = \"") + name + "\"", std::string("name = \"") + name + "_\"");
  const std::string found = mistakes("materials.gas = {law = \"ideal_gas\", rho0 = 1, gamma = 0.5}\n" + scene,
                                     {{"bodies.0.material", "gas"}, {"bodies.1.material", "gas"}});
  EXPECT_EQ(found, "1:55: materials.gas.gamma = 0.5 must be greater than 1 and at most 100\n");
}

}  // namespace
