// Times that a run would never come to the end of, or never come to: steps, snapshots and rows without number, what is asked for
// after its end, and a start that comes too late.
#include <iterator>

#include "scene/opened.hpp"
#include "scene/validator.hpp"

namespace undex::scene {
namespace {

constexpr double most_steps = 1e9, most_snapshots = 1e5;

double sound_at_rest(const sph::Body& body) {
  try {
    const double density = sph::start_density(body), energy = sph::start_energy(body);
    return std::visit([&](const auto& law) { return law.evaluate(density, energy).sound_speed; }, body.material.law);
  } catch (const std::exception&) {
    return 0;  // another check says why
  }
}

}  // namespace

void Validator::times() {
  unwritten();
  const double end = scene_.end_time;
  if (!(end > 0)) return;
  const auto expect = [&](const char* table, const char* key, double interval, double most, const char* what,
                          const char* remedy) {
    const Node* node = draft_.root.find(table);
    if (!node || !node->find(key) || !(interval > 0) || end / interval <= most) return;
    complain(*node, key,
             std::string(table) + '.' + key + " = " + shortest(interval) + " [s] makes " + rounded(std::ceil(end / interval)) +
                 ' ' + what + " to end_time = " + shortest(end) + " s, more than " + rounded(most) + "; " + remedy);
  };
  expect("scheme", "fixed_step", fluid_.numerics.fixed_step.value_or(0), most_steps, "steps",
         "take a longer step, or leave it out");
  expect("output", "field_interval", scene_.output.field_interval, most_snapshots, "snapshots", "take a longer interval");
  expect("output", "history_interval", scene_.output.history_interval, most_steps, "rows",
         "take a longer interval, or 0 for every step");
  if (const Node* output = draft_.root.find("output"); output && double(scene_.output.field_times.size()) > most_snapshots)
    complain(*output, "field_times",
             "output.field_times are " + std::to_string(scene_.output.field_times.size()) + " snapshots, more than " +
                 rounded(most_snapshots) + "; take fewer");

  // The Courant step at the sound speeds at rest: others are shorter.
  if (fluid_.numerics.fixed_step) return;
  for (const sph::Body& body : fluid_.bodies) {
    const double spacing = body.spacing.value_or(fluid_.lattice.spacing), sound = sound_at_rest(body);
    if (!(spacing > 0) || !(sound > 0)) continue;
    const double steps = end * sound / (fluid_.numerics.courant * fluid_.numerics.eta * spacing);
    if (steps <= most_steps) continue;
    complain(draft_.root, "end_time",
             "end_time = " + shortest(end) + " s takes " + rounded(steps) + " steps at least, by the sound speed " +
                 rounded(sound) + " m/s of bodies." + body.name + " and the spacing " + rounded(spacing) + " m, more than " +
                 rounded(most_steps) + "; is it in s? Else take a larger spacing");
    return;
  }
}

/// What is asked for at times that the run does not come to is never written.
void Validator::unwritten() {
  const double end = scene_.end_time;
  if (!(end > 0)) return;
  const bool later = scene_.start.kind == Start::Kind::spherical || scene_.start.kind == Start::Kind::run;
  const double begin = later ? scene_.start.time.value_or(0) : 0.0;
  const auto expect = [&](const Node& node, const std::string& path, const std::string& key, const std::vector<double>& times,
                          double interval, const char* what) {
    std::vector<double> missed;
    std::copy_if(times.begin(), times.end(), std::back_inserter(missed),
                 [&](double time) { return time > end * (1 + 1e-12) || time < begin * (1 - 1e-12); });
    if (!missed.empty()) {
      const bool early = missed.front() < begin;
      const std::string which = missed.size() == 1 ? shortest(missed[0]) + " s lies"
                                                   : std::to_string(missed.size()) + " of " + std::to_string(times.size()) +
                                                         " (such as " + shortest(missed[0]) + " s) lie";
      warn(node, (key + "times").c_str(),
           path + '.' + key + "times: " + which +
               (early ? " outside the run, from start.time = " + shortest(begin) + " s to" : " after") +
               " end_time = " + shortest(end) + " s, and " + what + " is written there; take " +
               (early ? "times within it" : "a later end_time or earlier times") + " (is it in s?)");
    }
    if (interval > end)
      warn(node, (key + "interval").c_str(),
           path + '.' + key + "interval = " + shortest(interval) + " [s] is longer than the run, to end_time = " + shortest(end) +
               " s, and " + what + " is written after the start; take a shorter interval or a later end_time");
  };
  if (const Node* output = draft_.root.find("output"))
    expect(*output, "output", "field_", scene_.output.field_times, scene_.output.field_interval, "no snapshot");
  for (std::size_t i = 0; i < scene_.lines.size(); ++i)
    expect(*draft_.line_nodes[i], "lines." + scene_.lines[i].name, "", scene_.lines[i].times, scene_.lines[i].interval,
           "no profile");
}

/// By start.time the wave must not have reached the obstacle, and it runs faster than sound.
void Validator::start_time() {
  const Node* node = draft_.root.find("start");
  const bool spherical = scene_.start.kind == Start::Kind::spherical;
  if (!node || (!spherical && scene_.start.kind != Start::Kind::run) || !scene_.start.time || !all_usable()) return;
  const double time = *scene_.start.time;
  if (time >= scene_.end_time) {
    complain(*node, "time",
             "start.time = " + shortest(time) + " [s] must come before end_time = " + shortest(scene_.end_time) + " [s]");
    return;
  }
  if (!spherical) return;
  for (const sph::Body& charge : fluid_.bodies) {
    const auto* sphere = std::get_if<Sphere>(&charge.shape.base);
    if (!sphere || (scene_.start.body.empty() ? !charge.variable_h : charge.name != scene_.start.body)) continue;
    for (const sph::Body& medium : fluid_.bodies) {
      const bool around = std::any_of(medium.shape.removed.begin(), medium.shape.removed.end(), [&](const Primitive& hole) {
        const auto* other = std::get_if<Sphere>(&hole);
        return other && other->center == sphere->center && other->radius == sphere->radius;
      });
      const double sound = around ? sound_at_rest(medium) : 0.0;
      if (!(sound > 0)) continue;
      const double obstacle = -signed_distance(without_radiating_faces(medium.shape.base, fluid_), sphere->center, dimension_);
      const double burning = charge.burn && !charge.burn->instantaneous ? sphere->radius / charge.burn->D : 0.0;
      const double latest = burning + std::max(0.0, obstacle - sphere->radius) / sound;
      if (time > latest)
        complain(*node, "time",
                 "start.time = " + shortest(time) + " [s]: at the sound speed " + rounded(sound) + " m/s of bodies." +
                     medium.name + " alone the wave reaches its edge, " + rounded(obstacle) + " m from the charge's middle, at " +
                     rounded(latest) + " s; take an earlier time, or leave it out");
      return;
    }
  }
}

}  // namespace undex::scene
