#include "run/run_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/errors.hpp"
#include "run/donor.hpp"
#include "run/undisturbed.hpp"
#include "run/particle_state.hpp"
#include "run/rest.hpp"
#include "run/spherical_start.hpp"
#include "run/spherical_state.hpp"
#include "scene/numbers.hpp"
#include "scene/opened.hpp"
#include "scene/revolution.hpp"
#include "scene/suggestion.hpp"
#include "sph_fluid/lattice.hpp"

namespace undex::run {
namespace {

constexpr const char* letters[] = {"x", "y", "z"};

std::string microseconds(double seconds) { return scene::rounded(seconds * 1e6) + " us"; }

/// The constants of a law.
std::vector<double> constants_of(const materials::FluidLaw& law) {
  std::vector<double> constants{double(law.index())};
  std::visit(
      [&](const auto& each) {
        for_each_field(each.parameters(), [&](const auto& member, const Key&) {
          using Type = std::decay_t<decltype(member)>;
          if constexpr (std::is_arithmetic_v<Type> || std::is_enum_v<Type>) constants.push_back(double(member));
        });
      },
      law);
  return constants;
}

/// The two scenes beside each other, before anything is computed: who becomes whom, and why they do not fit.
class Pairing {
 public:
  Pairing(const scene::Scene& scene, const scene::Scene& donor) : scene_(scene), donor_(donor) {}

  /// Of each body of the scene the donor's of the same name. Throws SceneError.
  std::vector<std::optional<std::size_t>> partners() const {
    setting();
    planes();
    std::vector<std::optional<std::size_t>> found;
    for (const sph::Body& body : scene_.fluid.bodies) {
      found.emplace_back();
      for (std::size_t d = 0; d < donor_.fluid.bodies.size(); ++d)
        if (donor_.fluid.bodies[d].name == body.name) found.back() = d;
      if (found.back()) alike(body, donor_.fluid.bodies[*found.back()]);
    }
    if (std::none_of(found.begin(), found.end(), [](const auto& one) { return one.has_value(); })) {
      std::vector<std::string> names;
      for (const sph::Body& body : donor_.fluid.bodies) names.push_back(body.name);
      refuse("start.from", "no body of the donor has the name of one of this scene; those of the donor are " +
                               scene::listed(names) + ": rename bodies");
    }
    return found;
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    throw SceneError(scene_.file.string(), {scene_.places.finding(key, "start.kind = \"run\": " + why)});
  }

 private:
  void setting() const {
    if (donor_.geometry == scene::Geometry::plane)
      refuse("start.from", "the donor is a plane flow, whose momentum is one per area; take an axisymmetric or 3D donor");
    if (donor_.fluid.bodies.empty()) refuse("start.from", "the donor has no fluid");
    const bool round = donor_.geometry == scene::Geometry::spherical;
    if (!round && donor_.fluid.gravity != scene_.fluid.gravity)
      refuse("gravity",
             "the donor has another gravity, and its water is at rest under other pressures; give both scenes one "
             "gravity, and their bodies one level");
    if (!round && donor_.fluid.surroundings.pressure != scene_.fluid.surroundings.pressure)
      refuse("surroundings.pressure", "the donor has other surroundings; give both scenes one pressure");
    if (round && scene_.fluid.dimension != 3)
      refuse("dimension", "a spherical donor is laid over three dimensions, or a meridian of them");
    if (scene_.meridian && !round && !donor_.meridian)
      refuse("start.from",
             "a donor in space is not laid over a meridian, for it need not be of revolution; take an axisymmetric or spherical "
             "donor, or compute this scene in 3D");
    if (!round && donor_.fluid.dimension != scene_.fluid.dimension)
      refuse("dimension", "the donor has dimension = " + std::to_string(donor_.fluid.dimension) +
                              ", which must be this scene's, unless it is \"axisymmetric\" or \"spherical\"");
    if (scene_.meridian && donor_.meridian &&
        (scene_.meridian->axis != donor_.meridian->axis || scene_.meridian->center != donor_.meridian->center))
      refuse("axis", "the donor is of revolution about another axis");
    if (scene_.start.time && *scene_.start.time > donor_.end_time * (1 + 1e-12))
      refuse("start.time", "the donor ends at " + microseconds(donor_.end_time) + ", before start.time = " +
                               microseconds(*scene_.start.time) + "; take an earlier time, or raise the donor's end_time");
    for (const solid::Body& solid : donor_.solids.bodies)
      if (solid.moves() || solid.residual_stress != 0)
        refuse("start.from", "the donor's solid '" + solid.name + "' is not at rest, and only fluids are laid over");
    for (const fem::Settings& structure : donor_.structures)
      if (structure.moves())
        refuse("start.from", "the donor's structure '" + structure.name + "' is not at rest, and only fluids are laid over");
  }

  /// What a symmetry plane of the scene cuts off must be the mirror image of what it keeps.
  void planes() const {
    for (int a = 0; a < 3; ++a) {
      if (!scene_.fluid.symmetry.axis[a]) continue;
      if (donor_.geometry == scene::Geometry::spherical) {
        if (scene::line_of(donor_).center[a] < 0)
          refuse("symmetry.planes",
                 std::string("the donor's middle lies on the side of the plane ") + letters[a] + " = 0 that is cut off");
      } else if (donor_.meridian && donor_.meridian->axis != a) {
        if (donor_.meridian->center[a] != 0.0)
          refuse("symmetry.planes", std::string("the plane ") + letters[a] + " = 0 does not go through the donor's axis");
      } else if (!donor_.fluid.symmetry.axis[a]) {
        refuse("symmetry.planes", std::string("the donor has no plane of symmetry ") + letters[a] +
                                      " = 0, and its halves may differ; leave the plane out, or add it to the donor");
      }
    }
  }

  void alike(const sph::Body& body, const sph::Body& there) const {
    const std::string path = "bodies." + body.name;
    if (body.material.name != there.material.name || constants_of(body.material.law) != constants_of(there.material.law))
      refuse(path + ".material", "'" + body.name + "' is of " + body.material.name + ", and in the donor of " +
                                     there.material.name + ", or of other constants; take one material in both");
    const auto differ = [](double one, double other) { return std::abs(one - other) > 1e-9 * std::abs(other); };
    if (body.level || there.level) return alike_under_gravity(body, there);
    if (differ(start_density(body), start_density(there)) || differ(start_energy(body), start_energy(there)))
      refuse(path, "'" + body.name + "' begins at " + scene::rounded(start_density(body)) + " kg/m^3 and " +
                       scene::rounded(start_energy(body)) + " J/kg, and in the donor at " + scene::rounded(start_density(there)) +
                       " and " + scene::rounded(start_energy(there)) + "; give both scenes the same state at time zero");
  }

  /// A spherical donor has the pressure of its middle, one in particles the same column.
  void alike_under_gravity(const sph::Body& body, const sph::Body& there) const {
    const bool round = donor_.geometry == scene::Geometry::spherical;
    const Vec3 place = round ? scene::line_of(donor_).center : place_of_pressure(body, scene_);
    const double here = rest_of(body, scene_)(place).pressure, in_donor = rest_of(there, donor_)(place).pressure;
    const bool same = std::abs(here - in_donor) <= 1e-6 * std::abs(here) && bool(there.level) != round;
    if (!same)
      refuse("bodies." + body.name + ".level",
             "'" + body.name + "' has " + scene::rounded(here) + " Pa " + (round ? "at the donor's middle" : "at its level") +
                 ", and in the donor " + scene::rounded(in_donor) +
                 (round ? " everywhere; give the donor the pressure of its middle's depth"
                        : (there.level ? "; give both the same level and pressure" : " everywhere; give both the same level")));
  }

  const scene::Scene& scene_;
  const scene::Scene& donor_;
};

/// Pressure [Pa] by which a wave of the donor is known; a weak bubble's would not be seen by that of a charge.
double threshold_of(const scene::Scene& donor) {
  double least = 1e300, most = -1e300;
  for (const sph::Body& body : donor.fluid.bodies) {
    least = std::min(least, start_pressure(body));
    most = std::max(most, start_pressure(body));
  }
  return most > least ? std::min(1e6, 0.01 * (most - least)) : 1e6;
}

/// The time [s] from which on everything that the donor's charges have to burn has burned.
double burned_at(const scene::Scene& donor) {
  double latest = 0;
  for (const sph::Body& body : donor.fluid.bodies) {
    if (!body.burn || body.burn->instantaneous) continue;
    double farthest = 0;
    if (const auto* sphere = std::get_if<Sphere>(&body.shape.base)) {
      farthest = (sphere->center - body.burn->origin).norm() + sphere->radius;
    } else {
      const Bounds box = bounds(body.shape, donor.fluid.dimension);
      Vec3 away = (box.low - body.burn->origin).cwiseAbs().cwiseMax((box.high - body.burn->origin).cwiseAbs());
      for (int a = donor.fluid.dimension; a < 3; ++a) away[a] = 0;
      farthest = away.norm();
    }
    latest = std::max(latest, (farthest + 0.5 * body.burn->width) / body.burn->D);
  }
  return latest;
}

class RunStart {
 public:
  RunStart(scene::Scene& scene, const StartOptions& options, Stages& stages)
      : scene_(scene),
        options_(options),
        stages_(stages),
        donor_(scene, options),
        pairing_(scene_, donor_.scene()),
        partner_(pairing_.partners()),
        undisturbed_(not_shared_by(scene_, donor_.scene())),
        reach_(sph::kernel_support(scene.fluid.numerics.kernel) *
               sph::smoothing_length(scene.fluid, scene.fluid.lattice.spacing)),
        threshold_(threshold_of(donor_.scene())),
        widest_(scene.fluid.lattice.spacing) {
    for (const sph::Body& body : scene.fluid.bodies) widest_ = std::max(widest_, body.spacing.value_or(0.0));
    if (on_a_line()) line_obstacles();
    if (!on_a_line()) first_places_ = ParticleState::places_of(donor_.simulation());
  }

  std::string lay() {
    scene_at_rest();
    advance();
    if (donor_.time() < burned_at(donor_.scene()))
      pairing_.refuse("start.time", "a charge of the donor burns until " + microseconds(burned_at(donor_.scene())) +
                                        ", and the particles take over at " + microseconds(donor_.time()) +
                                        "; take a later time, or a plain start");
    if (on_a_line()) lay_spheres();
    else lay_particles();
    scene_.fluid.start_time = donor_.time();
    for (fem::Settings& structure : scene_.structures) structure.start_time = donor_.time();
    char text[300];
    std::snprintf(text, sizeof text, "from the run of %s", donor_.words().c_str());
    std::string all = text;
    if (const auto [nearest, left] = nearest_obstacle(); nearest)
      all += ", " + scene::rounded(left * 1e3) + " mm before " + nearest->name;
    return all;
  }

 private:
  bool on_a_line() const { return donor_.simulation().line() != nullptr; }
  const exact::Lagrangian1D& mesh() const { return donor_.simulation().line()->mesh(); }

  /// What the donor does not have must rest until the particles take over.
  void scene_at_rest() const {
    std::vector<std::size_t> in_motion;
    double largest = -1;
    const sph::Body* medium = nullptr;
    for (std::size_t b = 0; b < partner_.size(); ++b) {
      if (!partner_[b]) continue;
      in_motion.push_back(b);
      const sph::Body& body = scene_.fluid.bodies[b];
      const double size = scene::kept_volume(body.shape, scene_);
      if (size <= largest) continue;
      largest = size;
      medium = &body;
    }
    require_rest(scene_, in_motion, *medium);
  }

  // ---- Until when -------------------------------------------------------------------------------------------------------

  /// Ends of a mesh are where its flow is no longer spherical; a plane beside its middle mirrors it.
  void line_obstacles() {
    const scene::Line& line = donor_.simulation().line()->line();
    for (const scene::LineLayer& layer : line.layers)
      if (layer.is_solid) return;  // refused below by its obstacle
    undisturbed_.push_back({"the end of the donor",
                            [center = line.center, outer = line.outer()](const Vec3& x) { return outer - (x - center).norm(); }});
    for (int a = 0; a < 3; ++a)
      if (scene_.fluid.symmetry.axis[a] && line.center[a] > 0.0)
        undisturbed_.push_back({std::string("the symmetry plane ") + letters[a] + " = 0", [a](const Vec3& x) { return x[a]; }});
  }

  /// Radius up to which anything of a spherical donor has moved [m]: what is compressed, or has another density. A free outer
  /// end is stirred by the pressure at rest. Where that may have come to, all counts as moved unless it is compressed.
  double front() const {
    const scene::Line& line = donor_.simulation().line()->line();
    const scene::LineLayer& last = line.layers.back();
    const double end = mesh().node_radius().back(), compressed = mesh().shock_front(threshold_);
    double untouched = end;
    if (!line.closed[1] && !last.is_solid) {
      const sph::Body& body = donor_.scene().fluid.bodies[last.index];
      const double rho = start_density(body), energy = start_energy(body);
      untouched -= 1.2 * donor_.time() *
                   std::visit([&](const auto& law) { return law.evaluate(rho, energy).sound_speed; }, body.material.law);
    }
    const double changed = untouched > 0 ? mesh().front(1e-4, untouched) : 0.0;
    const bool mixed = untouched < end && changed > 0.99 * untouched;
    if (mixed) return compressed > 0.98 * untouched ? compressed : end;
    return std::max(compressed, changed);
  }

  ParticleState particles() const { return {donor_.scene(), donor_.simulation(), first_places_, threshold_, widest_}; }

  /// The obstacle that the donor's wave is nearest to, and how far that is [m].
  std::pair<const Undisturbed*, double> nearest_obstacle() const {
    std::pair<const Undisturbed*, double> nearest{nullptr, std::numeric_limits<double>::infinity()};
    if (undisturbed_.empty()) return nearest;
    const std::optional<ParticleState> state = on_a_line() ? std::nullopt : std::optional(particles());
    for (const Undisturbed& obstacle : undisturbed_) {
      const double left =
          state ? state->clearance(obstacle.distance) : obstacle.distance(donor_.simulation().line()->line().center) - front();
      if (left < nearest.second) nearest = {&obstacle, left};
    }
    return nearest;
  }

  void advance() {
    const std::optional<double>& time = scene_.start.time;
    const double end = time.value_or(donor_.scene().end_time), before = 1.5 * scene_.fluid.lattice.spacing;
    if (!time && undisturbed_.empty())
      pairing_.refuse("start.time",
                      "in nothing that the scenes do not share the wave would end, so that no obstacle says when to begin; give "
                      "start.time");
    if (time) donor_.skip_to(*time);
    if (donor_.time() > end)
      pairing_.refuse("start.time", "the donor itself begins at " + microseconds(donor_.time()) + "; take a later time");
    while (donor_.time() < end * (1 - 1e-12)) {
      if (!time && nearest_obstacle().second <= reach_ + before) break;
      if (donor_.time() >= scene_.end_time) pairing_.refuse("end_time", "it comes before the start");
      donor_.step_towards(end);
      stages_.news([&] { return "the run of " + donor_.words(); });
    }
    const auto [nearest, left] = nearest_obstacle();
    if (nearest && left < 0.5 * reach_)
      pairing_.refuse(time ? "start.time" : "start.from",
                      "at " + microseconds(donor_.time()) + " the donor's wave has come to " + nearest->name +
                          ", which is not in both scenes alike or does not take part; take an earlier time" +
                          (time ? ", or leave it out" : ""));
    if (!time && left > reach_ + before)
      pairing_.refuse("start.time", "the donor ends at " + microseconds(donor_.time()) + " before its wave nears " +
                                        nearest->name + "; give start.time, or raise the donor's end_time");
    if (donor_.time() >= scene_.end_time) pairing_.refuse("end_time", "it comes before the start");
  }

  // ---- What is laid -----------------------------------------------------------------------------------------------------

  void lay_spheres() {
    const LineFlow& flow = *donor_.simulation().line();
    const scene::Line& line = flow.line();
    if (line.inner() > 0) pairing_.refuse("start.from", "the middle of the donor is empty; fill it with a body");
    SphericalState state{.flow = {donor_.shared(), &flow.mesh()}, .center = line.center, .front = front(), .bodies = {}};
    for (const scene::LineLayer& layer : line.layers) {
      if (layer.is_solid) pairing_.refuse("start.from", "the donor has solids, and only fluids are laid over");
      const std::size_t b = body_of(layer.index);
      if (b == scene_.fluid.bodies.size()) break;  // no wave has come to it
      if (const auto& spacing = scene_.fluid.bodies[b].spacing; spacing && *spacing > layer.outer)
        pairing_.refuse("bodies." + scene_.fluid.bodies[b].name + ".spacing", "it exceeds the charge");
      state.bodies.push_back(b);
    }
    state.share = kept_share(scene_, line.center).value();
    run::lay({state}, true, scene_);
  }

  /// The scene's body with the name of a donor's; the number of bodies: there is none.
  std::size_t body_of(std::size_t of_donor) const {
    std::size_t b = 0;
    while (b < partner_.size() && partner_[b] != of_donor) ++b;
    return b;
  }

  /// Index of the body of which a place is the shape's at time zero; the number of bodies: of none.
  static std::size_t body_at(const Vec3& x, const scene::Scene& scene) {
    std::size_t b = 0;
    while (b < scene.fluid.bodies.size() && signed_distance(scene.fluid.bodies[b].shape, x, scene.fluid.dimension) >= 0.0) ++b;
    return b;
  }

  void lay_particles() {
    const auto state = std::make_shared<const ParticleState>(particles());
    const auto before = std::make_shared<const scene::Scene>(scene_),
               donor = std::make_shared<const scene::Scene>(donor_.scene());
    require_still(*state);
    const std::size_t none = scene_.fluid.bodies.size();
    const auto in_donor = [donor](const Vec3& x) { return body_at(x, *donor) < donor->fluid.bodies.size(); };
    std::vector<std::size_t> of_donor;  // the scene's bodies, by the donor's
    for (std::size_t d = 0; d < donor->fluid.bodies.size(); ++d) of_donor.push_back(body_of(d));
    const auto owner = [=, partner = partner_](const Vec3& x) {
      const std::size_t own = body_at(x, *before);
      if (own == none || !partner[own] || !in_donor(x)) return own;
      const ParticleState::Owner there = state->owner_at(x);
      if (there.still) return own;
      return there.body ? of_donor[*there.body] : none;
    };
    Bounds box;
    for (const sph::Body& body : before->fluid.bodies) {
      const Bounds one = bounds(body.shape, before->fluid.dimension);
      box.include(one.low);
      box.include(one.high);
    }
    const double share = 1.0 / scene::mirror_copies(scene_);
    for (std::size_t b = 0; b < none; ++b) {
      if (!partner_[b]) continue;
      sph::Body& body = scene_.fluid.bodies[b];
      const std::size_t d = *partner_[b];
      const BodyTotals& totals = state->totals(d);
      auto field = std::make_shared<sph::StartField>();
      field->state = [=, at = rest_of(body, scene_)](const Vec3& x, double spacing) {
        const Rest rest = at(x);
        const sph::StartState at_rest{rest.density, rest.energy, Vec3::Zero()};
        return in_donor(x) ? state->state(d, x, spacing, at_rest) : at_rest;
      };
      field->covers = [=](const Vec3& x) { return owner(x) == b; };
      field->box = box;
      const bool whole = same_shape(body.shape, donor->fluid.bodies[d].shape);
      const MeanRest mean = mean_rest(body, scene_);
      if (!has_left(body, *state)) {
        field->mass = whole ? share * totals.mass : mean.density * scene::kept_volume(body.shape, scene_);
        field->kinetic_energy = share * totals.kinetic;
        field->internal_energy = share * totals.internal + (field->mass - share * totals.mass) * mean.energy;
        field->momentum = share * totals.momentum;
      }
      field->exact = true;
      body.start = field;
      body.burn.reset();  // it has burned
    }
    scene_.fluid.heat_before = share * donor_.simulation().energy().dissipated;
  }

  /// Has a wave passed a radiating face at which the body ends?
  bool has_left(const sph::Body& body, const ParticleState& state) const {
    const Primitive exits = scene::with_radiating_faces_only(body.shape.base, scene_.fluid);
    return state.clearance([&](const Vec3& x) { return -signed_distance(exits, x, scene_.fluid.dimension); }) < 0.0;
  }

  /// Nothing may have moved that is not laid over: bodies that this scene lacks, and surfaces of the whole fluid.
  void require_still(const ParticleState& state) const {
    for (std::size_t d = 0; d < donor_.scene().fluid.bodies.size(); ++d)
      if (state.has_moved(d) && body_of(d) == partner_.size())
        pairing_.refuse("start.from", "the donor's body '" + donor_.scene().fluid.bodies[d].name +
                                          "' has moved, and this scene has no body of that name; add it");
    std::vector<Shape> covered;  // and what lies beyond radiating faces
    for (const sph::Body& body : scene_.fluid.bodies)
      covered.push_back({scene::without_radiating_faces(body.shape.base, scene_.fluid), body.shape.removed});
    const double beyond = -state.clearance([&](const Vec3& x) {
      double away = 1e300;
      for (const Shape& shape : covered) away = std::min(away, signed_distance(shape, x, scene_.fluid.dimension));
      return -away;
    });
    if (beyond > scene_.fluid.lattice.spacing)
      pairing_.refuse("start.time", "fluid of the donor has moved " + scene::rounded(beyond * 1e3) +
                                        " mm out of where this scene's bodies begin; take an earlier time, before a free surface "
                                        "moves");
  }

  scene::Scene& scene_;
  const StartOptions& options_;
  Stages& stages_;
  Donor donor_;
  Pairing pairing_;
  std::vector<std::optional<std::size_t>> partner_;  // the donor's bodies, by this scene's
  std::vector<Undisturbed> undisturbed_;
  double reach_, threshold_, widest_;
  std::vector<Vec3> first_places_;  // of a donor's particles
};

}  // namespace

std::string begin_from_run(scene::Scene& scene, const StartOptions& options, Stages& stages) {
  return RunStart(scene, options, stages).lay();
}

}  // namespace undex::run
