// Every pair of features that a scene may combine: either the scene is refused with a reason, or a short run closes its
// ledgers. The scene is a small column of water with a deforming plate on it; a feature changes one thing of it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

#include "core/errors.hpp"
#include "run/starts.hpp"
#include "scenes.hpp"

namespace undex::run::test {
namespace {

/// What a scene of the matrix is made of. Lengths in mm; "up" is the last axis.
struct Column {
  int dimension = 3;
  bool line = false;   // on the one-dimensional mesh
  bool round = false;  // a cylinder in place of the box, in its meridian
  enum class Plate { none, hexahedra, shell, total, updated } plate = Plate::hexahedra;
  bool slip = true;  // of the coupling
  enum class Start { plain, plane_wave, spherical, burning } start = Start::plain;
  bool mirrored = true, obstacle = false, gravity = false, around = false, pushed = false, held = false, landing = false;
  bool flying = false;
  bool second = false;  // one more plate, water between
  double half_width = 8, depth = 16;
  std::string walls = "free_slip";  // "none", "no_slip", "open below", "radiating below"
  std::string water = "\"water-tait\"", plate_material = "\"al-5083-h116\"";
  std::map<std::string, std::string> scheme{{"courant", "0.1"}, {"precision", "\"full\""}};

  char up() const { return "xyz"[dimension - 1]; }
  std::string point(double side, double height) const {
    std::ostringstream text;
    const double mm = 1e-3;
    if (dimension == 1) text << height * mm;
    else if (dimension == 2) text << '[' << side * mm << ", " << height * mm << ']';
    else text << '[' << side * mm << ", " << side * mm << ", " << height * mm << ']';
    return text.str();
  }
  std::string box(double low, double high) const {
    if (round)
      return "{type = \"cylinder\", axis = \"z\", radius = " + std::to_string(1e-3 * half_width) +
             ", low = " + std::to_string(1e-3 * low) + ", high = " + std::to_string(1e-3 * high) + "}";
    return "{type = \"box\", low = " + point(-half_width, low) + ", high = " + point(half_width, high) + "}";
  }
  std::string sides(const std::string& after) const {  // of the axes across
    std::string list;
    for (int a = 0; a < dimension - 1; ++a) list += std::string(a ? ", " : "") + '"' + "xyz"[a] + after + '"';
    return '[' + list + ']';
  }
  std::string end(const char* which) const { return round ? which : std::string(1, up()) + '_' + which; }
  bool elements() const { return plate == Plate::hexahedra || plate == Plate::shell; }

  std::string text() const;
  void describe_fluid(std::ostream& out) const;
  void describe_plate(std::ostream& out) const;
};

void Column::describe_fluid(std::ostream& out) const {
  const bool charged = start == Start::spherical || start == Start::burning;
  out << "[[bodies]]\nname = \"water\"\nshape = " << box(-depth, 0) << "\nmaterial = " << water << "\npressure = 1e6\n";
  if (gravity) out << "level = " << point(0, 0) << '\n';
  if (charged) {
    out << "subtract = [\"charge\"]\n[[bodies]]\nname = \"charge\"\nshape = {type = \"sphere\", radius = 0.004, center = "
        << point(0, -0.5 * depth) << "}\n";
    if (start == Start::burning)
      out << "material = \"petn\"\nburn = {model = \"programmed\", initiation = " << point(0, -0.5 * depth) << "}\n";
    else out << "material = {law = \"barotropic_gas\", rho0 = 1400, p0 = 1e8, gamma = 2}\n";
  }
  if (second && elements())
    out << "[[bodies]]\nname = \"gap\"\nshape = " << box(4, 14) << "\nmaterial = " << water << "\npressure = 1e6\n";
  if (obstacle)
    out << "[[obstacles]]\nname = \"ball\"\nshape = {type = \"sphere\", radius = 0.0052, center = " << point(0, -0.5 * depth)
        << "}\nmotion = \"free\"\ndensity = 2700\nvelocity = " << point(0, 1e4) << '\n';  // 10 m/s
  if (walls == "none") return;
  out << "[[walls]]\nname = \"duct\"\nshape = " << box(-depth, 40) << "\ncondition = \""
      << (walls == "no_slip" ? "no_slip" : "free_slip") << "\"\nfaces = {" << end("high") << " = \"open\"";
  if (walls == "open below") out << ", " << end("low") << " = \"open\"";
  if (walls == "radiating below") out << ", " << end("low") << " = \"radiating\"";
  out << "}\n";
}

void Column::describe_plate(std::ostream& out) const {
  const std::string wet = second && elements() ? "[\"" + end("low") + "\", \"" + end("high") + "\"]" : "[\"" + end("low") + "\"]";
  std::string after;
  if (elements()) {
    std::string shape = "{type = \"plate\", low = " + point(-half_width, 0) + ", high = " + point(half_width, 4) + "}";
    std::string cells = std::string("{x = 4, y = 4, z = ") + (plate == Plate::shell ? "1}" : "2}");
    if (round) shape = box(0, 4).replace(9, 8, "rod"), cells = "{radial = 4, along = 2}";
    out << (second ? "[[structures]]" : "[structure]") << "\nshape = " << shape << "\nelement = \""
        << (plate == Plate::shell ? "shell" : "hexahedron") << "\"\ncells = " << cells
        << "\ncourant = 0.25\nmaterial = " << plate_material << "\nwet = " << wet << "\nsupports = [";
    if (round) out << "{face = \"side\", fixed = [\"x\", \"y\"]}";
    else if (mirrored) out << "{face = \"x_high\", fixed = [\"x\"]}, {face = \"y_high\", fixed = [\"y\"]}";
    if (held) out << (mirrored || round ? ", " : "") << "{face = \"" << end("high") << "\", fixed = [\"z\"]}";
    out << "]\n";
    if (pushed) out << "loads = [{face = \"" << end("high") << "\", time = [0, 2e-6, 2.001e-6], pressure = [5e5, 5e5, 5e6]}]\n";
  } else {
    out << "[[solids]]\nname = \"plate\"\nshape = " << box(0, 4) << "\nmaterial = " << plate_material << "\ndescription = \""
        << (plate == Plate::updated ? "updated" : "total") << "_lagrangian\"\nwet = " << wet << '\n';
    after = "[solid_scheme]\ncourant = 0.1\n";
  }
  if (flying) out << "velocity = " << point(0, 1e5) << '\n';  // 100 m/s
  if (second && elements()) {
    std::string shape = "{type = \"plate\", low = " + point(-half_width, 14) + ", high = " + point(half_width, 17) + "}";
    if (round) shape = box(14, 17).replace(9, 8, "rod");
    out << "[[structures]]\nshape = " << shape << "\ncells = " << (round ? "{radial = 3, along = 1}" : "{x = 2, y = 2, z = 1}")
        << "\ncourant = 0.25\nmaterial = \"steel-4340\"\nwet = [\"" << end("low") << "\"]\nsupports = [";
    if (round) out << "{face = \"side\", fixed = [\"x\", \"y\"]}";
    else if (mirrored) out << "{face = \"x_high\", fixed = [\"x\"]}, {face = \"y_high\", fixed = [\"y\"]}";
    out << "]\n";
  }
  if (landing) out << "[[planes]]\naxis = \"" << up() << "\"\nposition = 0.0041\nfree_side = \"below\"\n";
  out << after;
}

std::string Column::text() const {
  std::ostringstream out;
  out << "end_time = 1e-3\nthreads = 1\ndimension = "
      << (line    ? "\"plane\""
          : round ? "\"axisymmetric\""
                  : std::to_string(dimension))
      << '\n';
  if (gravity) out << "gravity = " << point(0, -1e7) << '\n';
  if (around) out << "[surroundings]\npressure = 2e6\n";
  out << "[resolution]\nspacing = 0.002\nfit = \"water\"\n";
  if (plate != Plate::none) out << "[coupling]\nslip = " << (slip ? "true" : "false") << '\n';
  if (mirrored && dimension > 1) out << "[symmetry]\nplanes = " << sides("") << '\n';
  out << "[scheme]\n";
  for (const auto& [key, value] : scheme) out << key << " = " << value << '\n';
  if (start == Start::plane_wave)
    out << "[start]\nkind = \"plane_wave\"\nbody = \"water\"\naxis = \"" << up()
        << "\"\nfront = -0.004\npeak = 5e6\ndecay = 5e-6\n";
  if (start == Start::spherical) out << "[start]\nkind = \"spherical\"\nbody = \"charge\"\n";
  describe_fluid(out);
  if (plate != Plate::none) describe_plate(out);
  return out.str();
}

/// One thing that a scene may have. Two of one group exclude each other. Where the plate is stopped at once the water's step is a
/// third: within a step it sees the plate go on (docs/theory/equations.md, section 14, "Ledger").
struct Feature {
  const char* group;
  const char* name;
  std::function<void(Column&)> apply;
};

Feature scheme(const char* key, const char* value, const char* name) {
  return {key, name, [=](Column& c) { c.scheme[key] = value; }};
}
Feature water(const char* material, const char* name) {
  return {"water", name, [=](Column& c) { c.water = material; }};
}
Feature strength(const char* material, const char* name) {
  return {"strength", name, [=](Column& c) { c.plate_material = material; }};
}
Feature plate(Column::Plate kind, const char* name) {
  return {"plate", name, [=](Column& c) { c.plate = kind; }};
}

const std::vector<Feature>& features() {
  using Plate = Column::Plate;
  using Start = Column::Start;
  static const std::vector<Feature> all = {
      {"dimension", "two_dimensions",
       [](Column& c) {
         c.dimension = 2;
         if (c.elements()) c.plate = Plate::total;
       }},
      {"dimension", "one_dimension",
       [](Column& c) {
         c.dimension = 1;
         c.plate = Plate::none;
       }},
      {"dimension", "one_coordinate",
       [](Column& c) {
         c.dimension = 1;
         c.line = true;
         if (c.elements()) c.plate = Plate::total;
       }},
      {"dimension", "meridian", [](Column& c) { c.round = true; }},
      plate(Plate::none, "water_alone"),
      plate(Plate::shell, "shell"),
      plate(Plate::total, "total_lagrangian"),
      plate(Plate::updated, "updated_lagrangian"),
      {"slip", "lined_wall", [](Column& c) { c.slip = false; }},
      {"start", "plane_wave", [](Column& c) { c.start = Start::plane_wave; }},
      {"start", "spherical",
       [](Column& c) {
         c.start = Start::spherical;
         c.depth = 32;
         c.half_width = 16;
       }},
      {"start", "burning", [](Column& c) { c.start = Start::burning; }},
      {"symmetry", "no_symmetry", [](Column& c) { c.mirrored = false; }},
      {"obstacle", "free_ball", [](Column& c) { c.obstacle = true; }},
      {"gravity", "gravity", [](Column& c) { c.gravity = true; }},
      {"surroundings", "surroundings", [](Column& c) { c.around = true; }},
      {"loads", "loads", [](Column& c) { c.pushed = true; }},
      {"supports", "held", [](Column& c) { c.held = true, c.scheme["courant"] = "0.03"; }},
      {"planes", "rigid_plane", [](Column& c) { c.landing = c.flying = true, c.scheme["courant"] = "0.03"; }},
      {"motion", "flying", [](Column& c) { c.flying = true; }},
      {"structures", "second_plate", [](Column& c) { c.second = true; }},
      {"walls", "no_walls", [](Column& c) { c.walls = "none"; }},
      {"walls", "no_slip_walls", [](Column& c) { c.walls = "no_slip"; }},
      {"walls", "open_below", [](Column& c) { c.walls = "open below"; }},
      {"walls", "radiating_below", [](Column& c) { c.walls = "radiating below"; }},
      water("\"water-tait-cutoff\"", "cutoff"),
      water("\"water-tait-isentropic\"", "isentropic_mixture"),
      water("\"water-steinberg\"", "mie_gruneisen"),
      water("{law = \"stiffened_gas\", rho0 = 1000, gamma = 4.4, p_inf = 6e8}\nenergy = 776764.706", "stiffened_gas"),
      strength("{rho0 = 2700, young_modulus = 7.1e10, poisson_ratio = 0.33, flow = {law = \"elastic\"}}", "elastic"),
      strength("\"al-6061-t6\"", "al_6061"),
      strength("\"armco-iron\"", "johnson_cook"),
      strength("\"armco-iron-za\"", "zerilli_armstrong"),
      strength("\"copper-ofhc-damage\"", "damage"),
      scheme("name", "\"riemann_corrected\"", "riemann_corrected"),
      scheme("name", "\"monaghan\"", "monaghan"),
      scheme("name", "\"monaghan_switch\"", "monaghan_switch"),
      scheme("name", "\"paper\"", "paper"),
      scheme("integrator", "\"ssp_rk3\"", "ssp_rk3"),
      scheme("local_steps", "true", "local_steps"),
      scheme("kernel", "\"wendland_c4\"", "wendland_c4"),
      scheme("kernel", "\"cubic_spline\"", "cubic_spline"),
      scheme("precision", "\"mixed\"", "mixed_precision")};
  return all;
}

/// Reads, starts and runs it for 4 us. Empty: it closes, or is refused with a reason (which `refusal` then is); else what is
/// wrong.
std::string fault_of(const Column& column, std::string& refusal) {
  try {
    scene::Scene scene = read_text(column.text());
    begin(scene);
    Simulation simulation(scene);
    run_to(simulation, simulation.time() + 4e-6);
    std::ostringstream wrong;
    const EnergyBalance balance = simulation.energy();
    double known = 0;  // what central differences hold back, by their own books (core/deformable_body.hpp)
    for (const auto& body : simulation.bodies()) known += body->ledger().integrator;
    const int copies = column.mirrored && !column.round ? 1 << (column.dimension - 1) : 1;
    const double momentum = simulation.momentum_error(), energy = balance.error() + copies * known / balance.scale;
    if (!(simulation.mass_error() < 1e-12)) wrong << " mass " << simulation.mass_error();
    if (momentum > (column.scheme.at("precision") == "\"mixed\"" ? 1e-7 : 1e-11)) wrong << " momentum " << momentum;
    if (!(std::abs(energy) < 0.01)) wrong << " energy " << energy;
    if (const auto given = simulation.interface_impulse_error(); given && !(*given < 1e-10)) wrong << " impulse " << *given;
    return wrong.str();
  } catch (const SceneError& error) {
    refusal = error.what();
    return refusal.size() > 20 ? "" : " refused without a reason";
  } catch (const std::exception& other) {
    return std::string(" ") + other.what();
  }
}

class FeaturePairs : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Each, FeaturePairs, ::testing::Range(std::size_t(0), features().size()),
                         [](const auto& one) { return std::string(features()[one.param].name); });

TEST_P(FeaturePairs, CloseOrAreRefused) {
  const Feature& first = features()[GetParam()];
  Column alone;
  first.apply(alone);
  std::string refusal;
  EXPECT_EQ(fault_of(alone, refusal), "") << first.name << '\n' << alone.text();
  EXPECT_EQ(refusal, "") << first.name;
  for (std::size_t k = GetParam() + 1; k < features().size(); ++k) {
    const Feature& second = features()[k];
    if (std::string(first.group) == second.group) continue;
    Column pair;
    first.apply(pair);
    second.apply(pair);
    refusal.clear();
    EXPECT_EQ(fault_of(pair, refusal), "") << first.name << " and " << second.name;
    if (!refusal.empty()) RecordProperty(second.name, refusal.substr(refusal.find(": ") + 1));
  }
}

}  // namespace
}  // namespace undex::run::test
