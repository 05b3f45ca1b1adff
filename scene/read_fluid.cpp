// [resolution], [symmetry], [scheme], [[bodies]] and [[walls]].
#include <algorithm>

#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/numbers.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

using namespace materials;
using sph::FaceCondition;

const Choices<FaceCondition> conditions{
    {"no_slip", FaceCondition::no_slip}, {"free_slip", FaceCondition::free_slip}, {"open", FaceCondition::open}};

/// Bodies need the scene's spacing, and solids without one of their own.
bool needs_spacing(const Node& root) {
  if (root.find("bodies")) return true;
  const Node* solids = root.find("solids");
  return solids &&
         std::any_of(solids->items.begin(), solids->items.end(), [](const Node& solid) { return !solid.find("spacing"); });
}

void read_resolution(const TableReader& top, Draft& draft) {
  sph::Lattice& lattice = draft.scene.fluid.lattice;
  const Node* node = top.table("resolution");
  if (!node) {
    if (needs_spacing(draft.root) && !top.has("resolution"))
      draft.report.add(draft.root, "resolution.spacing is missing; add [resolution] with spacing = (particle distance in m)");
    return;
  }
  const TableReader table(*node, "resolution", "resolution", top.dimension(), draft.report);
  if (needs_spacing(draft.root)) table.need("spacing", "give the distance of particles in m, e.g. spacing = 0.002");
  draft.spacing_good = table.read("spacing", lattice.spacing);
  table.read_choice<sph::LatticeType>("lattice", lattice.type,
                                      {{"cartesian", sph::LatticeType::cartesian}, {"rings", sph::LatticeType::rings}});
  table.read("fit", lattice.fit);
  table.read("origin", lattice.origin);
  if (const Node* turn = table.find("rotation")) {
    if (top.dimension() == 3) table.read("rotation", lattice.rotation);
    else if (turn->kind == Node::Kind::array)
      table.complain("rotation",
                     "resolution.rotation must be a number in degrees in two dimensions: only z is left to turn about");
    else table.read("rotation", lattice.rotation[2]);
  }
  table.read("jitter", lattice.jitter);
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

void read_scheme(const TableReader& top, Draft& draft) {
  sph::Numerics& numerics = draft.scene.fluid.numerics;
  // In three dimensions no figure of any scene moves by more than 2e-6 in mixed precision (docs/performance.md); in one and
  // two there is little to save.
  numerics.precision = top.dimension() == 3 ? sph::Precision::mixed : sph::Precision::full;
  const Node* node = top.table("scheme");
  if (!node) return;
  const TableReader table(*node, "scheme", "scheme", top.dimension(), draft.report);
  table.read_choice<sph::SchemeName>("name", numerics.scheme, {std::begin(sph::scheme_names), std::end(sph::scheme_names)});
  if (numerics.scheme == sph::SchemeName::paper) numerics.kernel = sph::KernelName::gaussian;
  Choices<sph::KernelName> kernels;
  for (const sph::KernelName name : sph::all_kernels)
    kernels.push_back({sph::with_kernel(name, [](auto kernel) { return kernel.name; }), name});
  table.read_choice("kernel", numerics.kernel, kernels);
  table.read_choice<sph::Precision>("precision", numerics.precision,
                                    {{"full", sph::Precision::full}, {"mixed", sph::Precision::mixed}});
  // each kernel's own usual smoothing length
  numerics.eta = sph::with_kernel(numerics.kernel, [](auto kernel) { return kernel.usual_eta; });
  if (numerics.scheme == sph::SchemeName::monaghan_switch) numerics.beta = 2.0;
  table.read("eta", numerics.eta);
  table.read("alpha", numerics.alpha);
  table.read("beta", numerics.beta);
  table.read("alpha_min", numerics.alpha_min);
  if (numerics.scheme == sph::SchemeName::monaghan_switch && !(numerics.alpha > 0.0 && numerics.alpha >= numerics.alpha_min))
    table.complain(table.has("alpha_min") ? "alpha_min" : "alpha",
                   "scheme.alpha = " + shortest(numerics.alpha) +
                       " is the upper bound of a coefficient whose lower one is "
                       "scheme.alpha_min = " +
                       shortest(numerics.alpha_min) +
                       " with scheme.name = \"monaghan_switch\": raise "
                       "alpha or lower alpha_min (without viscosity: scheme.name = \"monaghan\")");
  table.read_choice<sph::Integrator>("integrator", numerics.integrator,
                                     {{"leapfrog", sph::Integrator::leapfrog}, {"ssp_rk3", sph::Integrator::ssp_rk3}});
  numerics.courant = sph::default_courant(numerics.integrator, numerics.kernel);
  table.read("courant", numerics.courant);
  table.read("fixed_step", numerics.fixed_step);
  if (table.read("local_steps", numerics.local_steps) && numerics.local_steps && numerics.integrator != sph::Integrator::leapfrog)
    table.complain("local_steps",
                   "scheme.local_steps = true needs scheme.integrator = \"leapfrog\": a Runge-Kutta step is one for all; "
                   "leave one of them out");
  table.read("signal", numerics.signal);
  table.read("h_low", numerics.h_low);
  table.read("h_high", numerics.h_high);
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

bool is_gas(const FluidLaw& law) {
  return std::holds_alternative<BarotropicGas>(law) || std::holds_alternative<IdealGas>(law) || std::holds_alternative<Jwl>(law);
}

/// Where the body has its pressure under gravity, and whether it can have the pressures above and below.
void read_level(const TableReader& table, const Draft& draft, bool shape_good, bool pressure_good, sph::Body& body) {
  Vec3 level = Vec3::Zero();
  if (!table.read("level", level)) return;
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
  } else if (pressure_good && shape_good &&
             (bounds(body.shape.base, table.dimension()).high.head(table.dimension()).array() < 1e200).all()) {
    body.level = level;
    try {
      sph::hydrostatic_column(body, gravity, table.dimension());
    } catch (const std::domain_error& error) {
      table.complain("level", path + ": with " + shortest(*body.pressure) +
                                  " Pa there the body has no hydrostatic equilibrium: " + error.what() +
                                  "; raise pressure, or move level");
    }
  }
}

/// A charge of law jwl burns from its middle unless told otherwise; burn = "instantaneous" is short for a table.
void read_burn(const TableReader& table, const Draft& draft, sph::Body& body) {
  const auto* products = std::get_if<Jwl>(&body.material.law);
  if (!products) {
    if (table.has("burn"))
      table.complain("burn",
                     table.path_of("burn") + ": the material '" + body.material.name + "' does not burn; only law \"jwl\" does");
    return;
  }
  const Choices<bool> models{{"programmed", false}, {"instantaneous", true}};
  const double spacing = body.spacing.value_or(draft.scene.fluid.lattice.spacing);
  bool instantaneous = false;
  Vec3 origin = middle(body.shape.base, table.dimension());  // lit there unless the scene says otherwise
  std::optional<double> width;
  std::optional<double> speed, compression;
  if (const Node* node = table.find("burn"); node && node->kind == Node::Kind::text) {
    table.read_choice("burn", instantaneous, models);
  } else if (node && node->kind != Node::Kind::table) {
    table.complain("burn",
                   table.path_of("burn") + " must be \"programmed\", \"instantaneous\" or a table, not " + node->described());
  } else if (node) {
    const TableReader burn(*node, table.path_of("burn"), "burn", table.dimension(), table.report());
    burn.read_choice("model", instantaneous, models);
    if (instantaneous)
      for (const char* key : {"initiation", "speed", "width", "cj_compression"})
        if (burn.has(key)) burn.complain(key, burn.path_of(key) + " means nothing where model = \"instantaneous\"; leave it out");
    burn.read("initiation", origin);
    burn.read("width", width);
    burn.read("speed", speed);
    burn.read("cj_compression", compression);
  }
  if (instantaneous) return;
  ProgrammedBurn programmed;
  if (!width) width = burn_width(spacing, origin, body.shape.base, table.dimension());
  try {
    programmed = programmed_burn(*products, origin, *width);
  } catch (const std::exception& error) {  // no Chapman-Jouguet state
    if (!compression) {
      table.complain("material", table.path_of("material") + ": " + error.what() +
                                     "; mend its parameters or give burn.cj_compression (0: off)");
      return;
    }
    programmed.origin = origin;
    programmed.width = *width;
    programmed.D = products->parameters().D;
  }
  if (speed) programmed.D = *speed;
  if (compression) programmed.cj_compression = *compression;
  body.burn = programmed;
}

sph::Body read_body(const Node& node, const std::string& path, Draft& draft, bool& shape_good, std::size_t index) {
  Report& report = draft.report;
  const TableReader table(node, path, "bodies", draft.scene.fluid.dimension, report);
  sph::Body body{std::to_string(index),
                 {Sphere{Vec3::Zero(), 0}, {}},
                 {"", "", TaitWater({}), 1000.0},
                 {},
                 Vec3::Zero(),
                 {},
                 {},
                 {},
                 {},
                 false,
                 {}};
  table.need("name", "every body has a name");
  table.read_name("name", body.name);
  if (table.need("shape", "e.g. shape = {type = \"box\", low = [0, 0, 0], high = [1, 1, 1]}"))
    shape_good = read_shape(*table.find("shape"), table.path_of("shape"), table.dimension(),
                            {"box", "slab", "sphere", "cylinder", "tube"}, report, body.shape.base);
  read_subtractions(table, draft, index, body.shape.removed);
  bool material_good = table.need("material", "e.g. material = \"water-tait\" ('undex materials' lists them)");
  if (material_good) {
    std::string material_path = table.path_of("material");
    material_good = read_fluid_material(*table.find("material"), material_path, draft, body.material);
  }
  table.read("spacing", body.spacing);
  table.read("velocity", body.velocity);
  table.read("radial_velocity", body.radial_velocity);
  const bool pressure_good = table.read("pressure", body.pressure);
  table.read("density", body.density);
  table.read("energy", body.energy);
  body.variable_h = material_good && is_gas(body.material.law);
  table.read("variable_h", body.variable_h);
  if (!material_good) return body;
  if (std::holds_alternative<StiffenedGas>(body.material.law))
    table.need("energy", "law \"stiffened_gas\" has the pressure p at e = (p + gamma p_inf)/((gamma - 1) rho)");
  read_burn(table, draft, body);
  if (pressure_good && !body.density) {
    const auto* products = std::get_if<Jwl>(&body.material.law);
    try {
      const double density =
          density_at(body.material.law, *body.pressure, body.energy.value_or(products ? products->parameters().E0 : 0.0));
      if (!(density > 0)) throw std::domain_error("it would need the density " + rounded(density) + " kg/m^3");
    } catch (const std::exception& error) {
      table.complain("pressure", table.path_of("pressure") + " = " + shortest(*body.pressure) + " Pa: " + error.what());
    }
  }
  read_level(table, draft, shape_good, pressure_good, body);
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

void read_wall(const Node& node, const std::string& path, Draft& draft) {
  const TableReader table(node, path, "walls", draft.scene.fluid.dimension, draft.report);
  sph::Wall wall{.name = std::to_string(draft.wall_nodes.size()), .container = Box{Vec3::Zero(), Vec3::Zero()}, .faces = {}};
  table.need("name", "every wall has a name");
  table.read_name("name", wall.name);
  const bool good = table.need("shape", "a box or cylinder round the fluid") &&
                    read_shape(*table.find("shape"), table.path_of("shape"), table.dimension(), {"box", "cylinder"}, draft.report,
                               wall.container);
  FaceCondition otherwise = FaceCondition::free_slip;
  table.read_choice("condition", otherwise, conditions);
  if (good) {
    const std::vector<std::string> names = wall_faces(wall.container, table.dimension());
    for (const std::string& name : names) wall.faces[name] = otherwise;
    if (const Node* faces = table.table("faces")) {
      const char* kind = std::holds_alternative<Cylinder>(wall.container) ? "faces.cylinder" : "faces.box";
      const TableReader face_table(*faces, table.path_of("faces"), kind, table.dimension(), draft.report);
      for (const Key& key : section(kind).keys) {
        if (!face_table.has(key.name.c_str())) continue;
        if (!wall.faces.contains(key.name))
          face_table.complain(key.name.c_str(), face_table.path_of(key.name.c_str()) +
                                                    ": in dimension = " + std::to_string(table.dimension()) +
                                                    " the wall has only the faces " + listed(names));
        else face_table.read_choice(key.name.c_str(), wall.faces[key.name], conditions);
      }
    }
  }
  draft.scene.fluid.walls.push_back(wall);
  draft.wall_nodes.push_back(&node);
  draft.wall_shape_good.push_back(good);
}

}  // namespace

void read_fluid(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  read_resolution(top, draft);
  read_symmetry(top, draft);
  read_scheme(top, draft);
  read_bodies(top, draft);
  const auto walls = top.tables("walls");
  for (std::size_t i = 0; i < walls.size(); ++i) read_wall(*walls[i], element_path("walls", *walls[i], i), draft);
}

}  // namespace undex::scene
