// [resolution], [symmetry], [scheme], [[bodies]] and [[walls]].
#include <algorithm>
#include <numbers>

#include "scene/alternatives.hpp"
#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/geometry.hpp"
#include "scene/line.hpp"
#include "scene/numbers.hpp"
#include "scene/plausible.hpp"
#include "scene/record_reader.hpp"
#include "scene/suggestion.hpp"

namespace undex::scene {
namespace {

using namespace materials;
using sph::FaceCondition;

/// Bodies need the scene's spacing, and solids without one of their own; a mesh has a default.
bool needs_spacing(const Draft& draft) {
  const Node& root = draft.root;
  if (on_a_line(draft.scene.geometry)) return false;
  if (root.find("bodies")) return true;
  const Node* solids = root.find("solids");
  return solids &&
         std::any_of(solids->items.begin(), solids->items.end(), [](const Node& solid) { return !solid.find("spacing"); });
}

void read_resolution(const TableReader& top, Draft& draft) {
  sph::Lattice& lattice = draft.scene.fluid.lattice;
  const Node* node = top.table("resolution");
  if (!node) {
    if (needs_spacing(draft) && !top.has("resolution"))
      draft.report.add(draft.root, "resolution.spacing is missing; add [resolution] with spacing = (particle distance in m)");
    return;
  }
  const TableReader table(*node, "resolution", "resolution", top.dimension(), draft.report);
  if (needs_spacing(draft)) table.need("spacing", "give the distance of particles in m, e.g. spacing = 0.002");
  read_fields(table, lattice);
  draft.spacing_good = lattice.spacing > 0;
}

void read_symmetry(const TableReader& top, Draft& draft) {
  const Node* node = top.table("symmetry");
  if (!node) return;
  const TableReader table(*node, "symmetry", "symmetry", top.dimension(), draft.report);
  std::vector<int> axes;
  if (!table.read_axes("planes", axes)) return;
  for (const int axis : axes) {
    if (axis < top.dimension()) draft.scene.fluid.symmetry.axis[axis] = true;
    else
      table.complain("planes", std::string("symmetry.planes names \"") + "xyz"[axis] + "\", but the scene has dimension = " +
                                   std::to_string(top.dimension()) + "; leave it out or raise the dimension");
  }
}

void read_surroundings(const TableReader& top, Draft& draft) {
  if (const Node* node = top.table("surroundings"))
    read_fields(TableReader(*node, "surroundings", "surroundings", top.dimension(), draft.report),
                draft.scene.fluid.surroundings);
}

void read_scheme(const TableReader& top, Draft& draft) {
  sph::Numerics& numerics = draft.scene.fluid.numerics;
  const Node* node = top.table("scheme");
  const Node defaults;
  const TableReader table(node ? *node : defaults, "scheme", "scheme", top.dimension(), draft.report);
  read_fields(table, numerics);
  sph::apply_defaults(numerics, top.dimension(), [&](const char* key) { return table.has(key); });
  if (numerics.scheme == sph::SchemeName::monaghan_switch && !(numerics.alpha > 0.0 && numerics.alpha >= numerics.alpha_min))
    table.complain(table.has("alpha_min") ? "alpha_min" : "alpha",
                   "scheme.alpha = " + shortest(numerics.alpha) +
                       " is the upper bound of a coefficient whose lower one is "
                       "scheme.alpha_min = " +
                       shortest(numerics.alpha_min) +
                       " with scheme.name = \"monaghan_switch\": raise "
                       "alpha or lower alpha_min (without viscosity: scheme.name = \"monaghan\")");
  if (numerics.local_steps && numerics.integrator != sph::Integrator::leapfrog)
    table.complain("local_steps",
                   "scheme.local_steps = true needs scheme.integrator = \"leapfrog\": a Runge-Kutta step is one for all; "
                   "leave one of them out");
}

/// Width of the burn unless the scene says otherwise: six spacings, so that the front is smooth to the particles (a slab's
/// peak then lies within 1 % of Chapman and Jouguet's pressure at 2000 particles; with four it overshoots by 5 %), but at
/// most a twelfth of the way that the detonation runs, and at least one and a half spacings.
double burn_width(double spacing, const Vec3& origin, const Primitive& shape, int dimension) {
  const Bounds box = bounds(shape, dimension);
  double way = 0;
  for (int a = 0; a < dimension; ++a)
    if (box.high[a] < 1e200) way = std::max({way, box.high[a] - origin[a], origin[a] - box.low[a]});
  return std::max(1.5 * spacing, std::min(6.0 * spacing, way / 12.0));
}

/// A level that is given as a number: the coordinate along gravity.
void read_level(const TableReader& table, const Vec3& gravity, sph::Body& body) {
  if (!table.has("level") || table.find("level")->kind == Node::Kind::array) return;
  double height = 0;
  if (!table.read("level", height)) return;
  body.level = Vec3::Zero();
  Eigen::Index axis = 0;
  if (gravity.cwiseAbs().maxCoeff(&axis) == gravity.cwiseAbs().sum()) (*body.level)[axis] = height;
  else
    table.complain("level", table.path_of("level") + " = " + shortest(height) +
                                ": a number is a coordinate along gravity, which is along no axis here; give a point");
}

/// Where the body has its pressure under gravity, can it have the pressures above and below?
void check_level(const TableReader& table, const Draft& draft, bool shape_good, const sph::Body& body) {
  if (!body.level) return;
  const std::string path = table.path_of("level");
  const Vec3& gravity = draft.scene.fluid.gravity;
  if (gravity.isZero()) {
    table.complain("level",
                   path +
                       " means nothing without gravity; add gravity at the top of the file, e.g. gravity = [0, 0, -9.81], or "
                       "leave it out");
  } else if (!table.has("pressure") || body.density) {
    table.complain("level", path + " is where the body has its pressure: give pressure, and leave out density");
  } else if (std::holds_alternative<Jwl>(body.material.law)) {
    table.complain("level",
                   path + ": the law of '" + body.material.name + "' is that of a charge, which starts uniform; leave it out");
  } else if (body.pressure && shape_good &&
             (bounds(body.shape.base, table.dimension()).high.head(table.dimension()).array() < 1e200).all()) {
    try {
      sph::hydrostatic_column(body, gravity, table.dimension());
    } catch (const std::domain_error& error) {
      table.complain("level", path + ": with " + shortest(*body.pressure) +
                                  " Pa there the body has no hydrostatic equilibrium: " + error.what() +
                                  "; raise pressure, or move level");
    }
  }
}

/// A liquid that somebody forgot to put under the surroundings' pressure would be squeezed at its free surfaces.
void expect_surrounded(const TableReader& table, Draft& draft, const sph::Body& body) {
  const double around = draft.scene.fluid.surroundings.pressure;
  if (body.variable_h || around == 0 || body.pressure || body.density || body.energy) return;
  draft.warnings.add(table.node(),
                     table.path() +
                         " has no pressure and begins at the density rho0, under surroundings.pressure = " + rounded(around) +
                         " Pa: its free surfaces close upon it; give it pressure = " + rounded(around) + " where it is at rest");
}

/// A programmed burn as the table `of` (or nothing) says, the rest by rule; nothing where there is no such burn.
std::optional<ProgrammedBurn> programmed(const TableReader& table, const TableReader& of, const Draft& draft, const Jwl& products,
                                         const sph::Body& body) {
  ProgrammedBurn burn;
  burn.origin = middle(body.shape.base, table.dimension());
  read_fields(of, burn);
  const double spacing = body.spacing.value_or(draft.scene.fluid.lattice.spacing);
  if (!of.has("width")) burn.width = burn_width(spacing, burn.origin, body.shape.base, table.dimension());
  try {
    const ProgrammedBurn usual = programmed_burn(products, burn.origin, burn.width);
    if (!of.has("speed")) burn.D = usual.D;
    if (!of.has("cj_compression")) burn.cj_compression = usual.cj_compression;
  } catch (const std::exception& error) {  // no Chapman-Jouguet state
    if (!of.has("cj_compression")) {
      table.complain("material", table.path_of("material") + ": " + error.what() +
                                     "; mend its parameters or give burn.cj_compression (0: off)");
      return std::nullopt;
    }
    if (!of.has("speed")) burn.D = products.parameters().D;
  }
  return burn;
}

/// A charge of law jwl burns from its middle unless told otherwise; burn = "instantaneous" is short for a table.
void read_burn(const TableReader& table, Draft& draft, sph::Body& body) {
  const auto* products = std::get_if<Jwl>(&body.material.law);
  const Node* node = table.find("burn");
  if (!products) {
    if (node)
      table.complain("burn",
                     table.path_of("burn") + ": the material '" + body.material.name + "' does not burn; only law \"jwl\" does");
    return;
  }
  const Choices<bool> models{{"programmed", false}, {"instantaneous", true}};
  bool instantaneous = false;
  const bool is_table = node && node->kind == Node::Kind::table;
  const Node nothing;
  const TableReader burn(is_table ? *node : nothing, table.path_of("burn"), "burn", table.dimension(), table.report());
  if (is_table) {
    burn.read_choice("model", instantaneous, models);
    if (instantaneous)
      for (const Key& key : section("burn").keys)
        if (std::string_view(key.name) != "model" && burn.has(key.name))
          burn.complain(key.name, burn.path_of(key.name) + " means nothing where model = \"instantaneous\"; leave it out");
  } else if (node && node->kind == Node::Kind::text) {
    table.read_choice("burn", instantaneous, models);
  } else if (node) {
    table.complain("burn",
                   table.path_of("burn") + " must be \"programmed\", \"instantaneous\" or a table, not " + node->described());
  }
  if (instantaneous) return;
  body.burn = programmed(table, burn, draft, *products, body);
  if (body.burn) expect_plausible_burn(burn, *products, body.burn->D, draft.warnings);
}

/// Pressure and density make the energy of a law that has one, and must not contradict what is given beside them.
void settle_state(const TableReader& table, sph::Body& body) {
  const double density = *body.density, pressure = *body.pressure;
  const auto at = [&](double energy) {
    return std::visit([&](const auto& law) { return law.evaluate(density, energy); }, body.material.law);
  };
  if (uses_energy(body.material.law) && !body.energy) {
    const double far = 1e8,
                 slope = (at(2 * far).pressure - at(far).pressure) / far;  // all laws are linear in it where they are hot
    if (slope > 0) body.energy = far + (pressure - at(far).pressure) / slope;
  }
  const PressureSound found = at(sph::start_energy(body));
  const double known = 1e-6 * std::abs(pressure) + 1e-9 * density * found.sound_speed * found.sound_speed;
  if (!(std::abs(found.pressure - pressure) <= known))
    table.complain("pressure", table.path_of("pressure") + " = " + shortest(pressure) + " Pa and the density " +
                                   shortest(density) + " kg/m^3 " + (table.has("energy") ? "with this energy " : "") +
                                   "contradict each other: the law has " + rounded(found.pressure) +
                                   " Pa there; leave one of them out");
}

/// Can the body have its pressure?
void check_pressure(const TableReader& table, sph::Body& body, Report& warnings) {
  if (body.pressure && body.burn)
    return table.complain("pressure", table.path_of("pressure") +
                                          ": the pressure of a charge follows from its burn; leave it out, " +
                                          "or let burn be \"instantaneous\" for a gas of its products");
  if (body.pressure && body.density) settle_state(table, body);
  const bool cold = std::holds_alternative<IdealGas>(body.material.law) && find_fluid(body.material.name);
  if (cold && !body.pressure && !body.energy)
    warnings.add(table.node(), table.path() + ": '" + body.material.name +
                                   "' has no pressure without energy; give its pressure (or energy = 0 for a gas so cold)");
  if (!body.pressure || body.density) return;
  try {
    const double density = sph::start_density(body);
    if (!(density > 0)) throw std::domain_error("it would need the density " + rounded(density) + " kg/m^3");
  } catch (const std::exception& error) {
    table.complain("pressure", table.path_of("pressure") + " = " + shortest(*body.pressure) + " Pa: " + error.what());
  }
}

/// The mass [kg] of a ball of the body's start; nothing where it has no density.
std::optional<double> mass_of_ball(const sph::Body& body, double radius) {
  try {
    const double mass = sph::start_density(body) * 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
    if (mass > 0 && std::isfinite(mass)) return mass;
  } catch (const std::domain_error&) {  // its pressure is complained of
  }
  return std::nullopt;
}

/// The shape of a body of that mass [kg]: a sphere without radius is given one. Nothing where it cannot have the mass.
std::optional<Node> shape_of_mass(const TableReader& table, const Node& shape, const sph::Body& body, double mass) {
  const Node* type = shape.find("type");
  const Node* subtract = table.find("subtract");
  const auto refuse = [&](const std::string& why) {
    table.complain("mass", table.path_of("mass") + ' ' + why);
    return std::nullopt;
  };
  if (type && type->kind == Node::Kind::text && type->text != "sphere")
    return refuse("needs a sphere, not a \"" + type->text + "\"; leave it out and give the shape's lengths");
  if (table.dimension() != 3)
    return refuse("needs a sphere in space, and the scene has dimension = " + std::to_string(table.dimension()) +
                  "; give the radius in its place");
  if (subtract && subtract->kind == Node::Kind::array && !subtract->items.empty())
    return refuse("needs a whole sphere, and `subtract` takes some of it; give the radius in its place");
  Node sized = shape;
  if (shape.kind != Node::Kind::table || shape.find("radius")) return sized;
  const auto of_one_metre = mass_of_ball(body, 1);
  if (!of_one_metre) return std::nullopt;
  Node radius;
  radius.where = shape.where;
  radius.origin = shape.origin;
  radius.kind = Node::Kind::number;
  radius.number = std::cbrt(mass / *of_one_metre);
  sized.entries.push_back({"radius", shape.where, radius});
  return sized;
}

/// A radius that is given beside the mass must be the mass's.
void expect_mass(const TableReader& table, const sph::Body& body, double mass) {
  constexpr double agreement = 1e-3;
  const auto* placed = std::get_if<Placed>(&body.shape.base);
  const auto* ball = std::get_if<Sphere>(placed ? &placed->shape[0] : &body.shape.base);
  const auto own = ball ? mass_of_ball(body, ball->radius) : std::nullopt;
  if (own && std::abs(*own / mass - 1) > agreement)
    table.complain("mass", table.path_of("mass") + " = " + shortest(mass) + " [kg] and the radius " + shortest(ball->radius) +
                               " m contradict each other: at " + rounded(sph::start_density(body)) + " kg/m^3 that sphere has " +
                               rounded(*own) + " kg; leave one of them out");
}

void read_body_shape(const TableReader& table, Draft& draft, bool material_good, sph::Body& body, bool& good) {
  const Node* shape = table.find("shape");
  if (!shape) return;
  double mass = 0;
  const bool by_mass = table.read("mass", mass);
  if (table.has("mass") && !(by_mass && material_good)) return;  // complained of
  const std::optional<Node> sized = by_mass ? shape_of_mass(table, *shape, body, mass) : *shape;
  if (!sized) return;
  good = read_shape(*sized, table.path_of("shape"), draft, ShapeUse::any, body.shape.base);
  if (good && by_mass) expect_mass(table, body, mass);
}

sph::Body read_body(const Node& node, const std::string& path, Draft& draft, bool& shape_good, std::size_t index) {
  Report& report = draft.report;
  const TableReader table(node, path, "bodies", draft.scene.fluid.dimension, report);
  sph::Body body;
  body.name = std::to_string(index);
  const Node* material = table.find("material");
  const bool material_good = material && read_fluid_material(*material, table.path_of("material"), draft, body.material);
  body.variable_h = material_good && is_gas(body.material.law);
  read_fields(table, body);
  read_level(table, draft.scene.fluid.gravity, body);
  read_radial(table, body.radial);
  read_body_shape(table, draft, material_good, body, shape_good);
  read_subtractions(table, draft, index, body.shape.removed);
  if (!material_good) return body;
  if (std::holds_alternative<StiffenedGas>(body.material.law) && !(body.pressure && body.density))
    table.need("energy", "law \"stiffened_gas\" has the pressure p at e = (p + gamma p_inf)(1 - b rho)/((gamma - 1) rho) + q");
  read_burn(table, draft, body);
  check_pressure(table, body, draft.warnings);
  check_level(table, draft, shape_good, body);
  expect_surrounded(table, draft, body);
  if (body.energy && !uses_energy(body.material.law))
    table.complain("energy", table.path_of("energy") + ": the law of '" + body.material.name +
                                 "' is barotropic, it has no energy; leave it out");
  return body;
}

void read_bodies(const TableReader& top, Draft& draft) {
  const auto nodes = top.tables("bodies");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    bool shape_good = false;
    draft.scene.fluid.bodies.push_back(read_body(*nodes[i], element_path("bodies", *nodes[i], i), draft, shape_good, i));
    draft.body_nodes.push_back(nodes[i]);
    draft.body_shape_good.push_back(shape_good);
  }
}

/// The conditions of a wall's faces: those named in `faces`, else that of the wall.
void read_faces(const TableReader& table, FaceCondition otherwise, sph::Wall& wall) {
  const std::vector<std::string> names = wall_faces(wall.container, table.dimension());
  for (const std::string& name : names) wall.faces[name] = otherwise;
  const Node* faces = table.table("faces");
  if (!faces) return;
  const std::string kind = std::string("faces.") + name_of(wall.container);
  const TableReader face_table(*faces, table.path_of("faces"), kind, table.dimension(), table.report());
  for (const Key& key : section(kind).keys) {
    if (!face_table.has(key.name)) continue;
    if (wall.faces.contains(key.name)) face_table.read_choice(key.name, wall.faces[key.name], choices<FaceCondition>());
    else
      face_table.complain(key.name, face_table.path_of(key.name) + ": in dimension = " + std::to_string(table.dimension()) +
                                        " the wall has only the faces " + listed(names));
  }
}

/// Is the shape none that walls have faces of: another type, or one that is turned?
bool is_free_form(const Node* shape) {
  if (!shape || shape->kind != Node::Kind::table) return false;
  if (shape->find("rotate") || shape->find("move")) return true;
  const Node* type = shape->find("type");
  bool container = true;
  if (type && type->kind == Node::Kind::text)
    Alternatives<Primitive>::with(type->text, [&]<class Type>(std::type_identity<Type>) { container = Type::is_container; });
  return !container;
}

/// Bodies that reach beyond the box of a wall of any shape would go on behind it.
void expect_within(const TableReader& wall, const Draft& draft, const Bounds& box) {
  const Bounds kept = kept_part(draft.scene.fluid.symmetry.axis);
  for (std::size_t b = 0; b < draft.scene.fluid.bodies.size(); ++b) {
    const sph::Body& body = draft.scene.fluid.bodies[b];
    if (!draft.body_shape_good[b]) continue;
    const Bounds extent = common(kept, bounds(body.shape, wall.dimension()));
    for (int a = 0; a < wall.dimension(); ++a)
      if (extent.low[a] < std::max(box.low[a], kept.low[a]) || extent.high[a] > box.high[a]) {
        wall.complain("shape", wall.path_of("shape") + ": bodies." + body.name + " reaches from " + rounded(extent.low[a]) +
                                   " to " + rounded(extent.high[a]) + " m along " + "xyz"[a] +
                                   ", far outside of the wall; draw it within");
        break;
      }
  }
}

/// A wall of any shape is a rigid obstacle about it: a box with that hole.
void read_free_wall(const TableReader& table, const Node& shape, Draft& draft) {
  const std::size_t before = draft.report.size();
  coupling::Obstacle around;
  around.name = table.path().substr(table.path().find('.') + 1);
  table.read_name("name", around.name);
  FaceCondition condition = FaceCondition::free_slip;
  table.read_choice("condition", condition, choices<FaceCondition>());
  const std::string only = ": only a box, cylinder, cone or sphere along the axes has ";
  if (condition != FaceCondition::free_slip)
    table.complain("condition",
                   table.path_of("condition") + only + "another condition than \"free_slip\"; take that, or such a shape");
  for (const char* key : {"faces", "source"})
    if (table.has(key))
      table.complain(key, table.path_of(key) + only + (key[0] == 'f' ? "faces" : "a source") + "; leave it out");
  Primitive hole;
  if (read_shape(shape, table.path_of("shape"), draft, ShapeUse::bounded, hole)) {
    Bounds box = bounds(hole, table.dimension());
    const double thickness = 0.1 * (box.high - box.low).head(table.dimension()).maxCoeff();
    for (int a = 0; a < 3; ++a) {
      box.low[a] = a < table.dimension() ? box.low[a] - thickness : 0.0;
      box.high[a] = a < table.dimension() ? box.high[a] + thickness : 0.0;
    }
    around.shape = Difference{{Box{box.low, box.high}, hole}};
    expect_within(table, draft, box);
  }
  if (table.dimension() == 1) table.complain("shape", table.path_of("shape") + ": in one dimension a wall is a \"box\"");
  draft.scene.obstacles.push_back(around);
  draft.obstacle_nodes.push_back(&table.node());
  draft.obstacle_good.push_back(draft.report.size() == before);
}

void read_wall(const Node& node, const std::string& path, Draft& draft) {
  const TableReader table(node, path, "walls", draft.scene.fluid.dimension, draft.report);
  if (const Node* shape = node.find("shape"); is_free_form(shape)) return read_free_wall(table, *shape, draft);
  sph::Wall wall;
  wall.name = std::to_string(draft.wall_nodes.size());
  read_fields(table, wall);
  const Node* shape = table.find("shape");
  bool good = shape && read_shape(*shape, table.path_of("shape"), draft, ShapeUse::bounded, wall.container);
  if (good && table.dimension() == 1 && std::holds_alternative<Sphere>(wall.container)) {
    table.complain("shape", table.path_of("shape") + ": in one dimension a wall is a \"box\"");
    good = false;
  }
  FaceCondition otherwise = FaceCondition::free_slip;
  table.read_choice("condition", otherwise, choices<FaceCondition>());
  if (good) read_faces(table, otherwise, wall);
  draft.scene.fluid.walls.push_back(wall);
  draft.wall_nodes.push_back(&node);
  draft.wall_shape_good.push_back(good);
}

/// Where the waves come from that leave through radiating faces, where the scene does not say it.
void find_sources(Draft& draft) {
  const sph::Settings& fluid = draft.scene.fluid;
  std::vector<const sph::Body*> found;
  for (std::size_t i = 0; i < fluid.bodies.size(); ++i) {
    const sph::Body& body = fluid.bodies[i];
    const bool round = std::holds_alternative<Sphere>(body.shape.base) || std::holds_alternative<Cylinder>(body.shape.base);
    if (draft.body_shape_good[i] && round && (std::holds_alternative<Jwl>(body.material.law) || is_gas(body.material.law)))
      found.push_back(&body);
  }
  for (std::size_t w = 0; w < fluid.walls.size(); ++w) {
    sph::Wall& wall = draft.scene.fluid.walls[w];
    if (!wall.source && wall.radiates() && fluid.dimension > 1 && found.size() == 1)
      wall.source = middle(found.front()->shape.base, fluid.dimension);
  }
}

}  // namespace

void complete_line(Draft& draft) {
  Scene& scene = draft.scene;
  if (!on_a_line(scene.geometry)) return;
  sph::Lattice& lattice = scene.fluid.lattice;
  const auto is_bad = [](const std::vector<bool>& good) { return std::find(good.begin(), good.end(), false) != good.end(); };
  if (is_bad(draft.body_shape_good) || is_bad(draft.solid_shape_good)) return;
  const Line line = line_of(scene);
  if (!(lattice.spacing > 0) && !line.layers.empty()) lattice.spacing = default_spacing(line);
  draft.spacing_good = lattice.spacing > 0;
  for (std::size_t i = 0; i < scene.fluid.bodies.size(); ++i) {
    sph::Body& body = scene.fluid.bodies[i];
    const Node* burn = draft.body_nodes[i]->find("burn");
    if (body.burn && !(burn && burn->kind == Node::Kind::table && burn->find("width"))) body.burn->width = 4.0 * lattice.spacing;
  }
}

void read_fluid(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  read_resolution(top, draft);
  read_symmetry(top, draft);
  read_surroundings(top, draft);
  read_scheme(top, draft);
  read_bodies(top, draft);
  const auto walls = top.tables("walls");
  for (std::size_t i = 0; i < walls.size(); ++i) read_wall(*walls[i], element_path("walls", *walls[i], i), draft);
  find_sources(draft);
}

}  // namespace undex::scene
