#include "run/trust.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "output/terminal.hpp"
#include "output/text_table.hpp"
#include "scene/structure_shape.hpp"

namespace undex::run {
namespace {

using output::print;
using output::Trust;
using output::TrustRecord;
using output::with_unit;

Trust graded(double size, double good, double notice) {
  if (!(std::abs(size) <= notice)) return Trust::bad;  // no number is bad
  return std::abs(size) <= good ? Trust::good : Trust::notice;
}

std::string percent(double share) { return print("%+.2g %%", 100 * share); }

/// What was computed to the end, and what was lost on the way.
std::vector<TrustRecord> ledgers(const output::RunRecord& record) {
  std::vector<TrustRecord> found;
  if (record.status != "done")
    found.push_back({"end", Trust::bad, "the run was not computed to its end (" + record.status + ")"});
  const Trust energy = graded(record.energy_error, 0.01, 0.05);
  found.push_back({"energy", energy,
                   "the balance is off by " + percent(record.energy_error) +
                       (energy == Trust::good ? "" : "; compare with a smaller step (scheme.courant, structure.courant)")});
  found.push_back({"mass", graded(record.mass_error, 1e-9, 1e-6), print("conserved to %.1e", std::abs(record.mass_error))});
  if (std::isfinite(record.momentum_error))
    found.push_back(
        {"momentum", graded(record.momentum_error, 1e-6, 1e-3), print("conserved to %.1e", std::abs(record.momentum_error))});
  if (const auto& error = record.angular_momentum_error; error && std::isfinite(*error))
    found.push_back({"angular momentum", graded(*error, 1e-3, 0.05), print("conserved to %.1e", std::abs(*error))});
  if (const auto& error = record.interface_energy_error)
    found.push_back(
        {"interface", graded(*error, 0.01, 0.05),
         "the work of the water on the structure is off by " + percent(*error) +
             (record.interface_impulse_error ? print(", the impulse by %.0e", std::abs(*record.interface_impulse_error)) : "")});
  return found;
}

/// Bounds that acted (docs/reference/outputs.md, `clamps`).
TrustRecord clamps(const output::RunRecord& record) {
  std::string acted;
  bool often = false;
  for (const auto& [name, count] : record.clamps) {
    if (count == 0) continue;
    const double share = double(count) / std::max(1.0, double(record.particle_updates));
    often = often || share > 0.01;
    acted += (acted.empty() ? "" : ", ") + name + print(" in %.2g %% of all updates", 100 * share);
  }
  if (acted.empty()) return {"clamps", Trust::good, "no bound acted"};
  return {"clamps", often ? Trust::notice : Trust::good, "bounds acted: " + acted + (often ? " (undex help outputs)" : "")};
}

/// Radius of a round body [m]; 0 of others.
double radius_of(const sph::Body& body) {
  if (const auto* sphere = std::get_if<Sphere>(&body.shape.base)) return sphere->radius;
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape.base)) return cylinder->radius;
  return 0;
}

/// Charges and bubbles in spacings of the coarser of them and the water round them.
std::vector<TrustRecord> charges(const scene::Scene& scene) {
  std::vector<TrustRecord> found;
  for (const sph::Body& body : scene.fluid.bodies) {
    const bool gas = materials::is_gas(body.material.law);
    const double radius = radius_of(body), spacing = std::max(scene.fluid.lattice.spacing, body.spacing.value_or(0.0));
    if (!gas || radius == 0) continue;
    const double across = radius / spacing;
    const bool begun = scene.start.kind == scene::Start::Kind::spherical || scene.start.kind == scene::Start::Kind::run;
    std::string text = "'" + body.name + "' has " + print("%.1f spacings in its radius", across) + " (" + with_unit(radius, "m") +
                       " / " + with_unit(spacing, "m") + ")";
    if (begun) text += "; until the particles take over it was computed finer";
    else if (across < 10) text += "; below ten the first peak is smeared: a spherical start, or a smaller spacing, mends it";
    found.push_back({"charge", begun ? graded(1 / across, 1.0 / 4, 1.0 / 1.5) : graded(1 / across, 1.0 / 10, 1.0 / 4), text});
  }
  return found;
}

/// Gas whose particles have split (docs/theory/equations.md, section 6).
std::vector<TrustRecord> splits(const scene::Scene& scene, const output::RunRecord& record) {
  std::vector<TrustRecord> found;
  for (const output::SplitRecord& each : record.splits) {
    const auto body = std::find_if(scene.fluid.bodies.begin(), scene.fluid.bodies.end(),
                                   [&](const sph::Body& one) { return one.name == each.body; });
    const bool all = body != scene.fluid.bodies.end() && each.particles >= body->split * each.particles_at_start;
    found.push_back({"gas", all ? Trust::notice : Trust::good,
                     "'" + each.body + "' has grown: its " + output::grouped(each.particles_at_start) + " particles are " +
                         output::grouped(each.particles) + " by splitting" +
                         (all ? ", which is its limit (split): beyond it the gas may lose its neighbours" : "")});
  }
  return found;
}

/// Walls that deform in spacings of the water.
std::vector<TrustRecord> walls(const scene::Scene& scene) {
  std::vector<TrustRecord> found;
  if (scene.fluid.bodies.empty()) return found;
  for (const fem::Settings& structure : scene.structures) {
    double thickness = 0;
    try {
      thickness = scene::StructureShape(structure.mesh, scene.meridian).thickness();
    } catch (const std::exception&) {
      continue;  // a mesh that can no longer be read
    }
    if (!(thickness > 0)) continue;
    const double through = thickness / scene.fluid.lattice.spacing;
    found.push_back({"wall", graded(1 / through, 1.0 / 5, 1.0 / 0.5),
                     "'" + structure.name + "' is as thick as " + print("%.1f spacings of the water", through) +
                         (through < 5 ? "; compare with a smaller spacing before you rely on its displacement" : "")});
  }
  return found;
}

/// What is known of the scheme, from the ladder of scenes (docs/results/accuracy.md).
std::vector<TrustRecord> known_limits(const scene::Scene& scene) {
  std::vector<TrustRecord> found;
  if (scene.fluid.bodies.empty() || scene::on_a_line(scene.geometry)) return found;
  const auto limit = [&](const std::string& text) { found.push_back({"known limit", Trust::good, text}); };
  const std::string scheme = word_of(scene.fluid.numerics.scheme);
  const bool reconstructs = scheme.starts_with("riemann");
  const bool curved = std::any_of(scene.fluid.walls.begin(), scene.fluid.walls.end(), [](const sph::Wall& wall) {
    const auto side = wall.faces.find("side");
    const bool closed =
        side == wall.faces.end() || (side->second != sph::FaceCondition::open && side->second != sph::FaceCondition::radiating);
    return closed && !std::holds_alternative<Box>(wall.container);
  });
  if (scheme == "riemann" && curved) limit("impulses on curved walls come out 2 to 3 % high (riemann_corrected: within 1 %)");
  if (!reconstructs)
    limit("viscosity of Monaghan's kind smears fronts: first peaks are up to 20 % low; riemann is the scheme to rely on");
  limit("the peak of a wave that decays within a few spacings is cut: halve the spacing to see by how much");
  return found;
}

std::string mark(Trust level) {
  switch (level) {
    case Trust::good: return output::inked("ok  ", output::Ink::good);
    case Trust::notice: return output::inked("note", output::Ink::notice);
    case Trust::bad: return output::inked("BAD ", output::Ink::bad);
  }
  return "";
}

}  // namespace

std::vector<TrustRecord> trust_of(const scene::Scene& given, const output::RunRecord& record) {
  std::vector<TrustRecord> all = ledgers(record);
  const auto add = [&](std::vector<TrustRecord> more) { all.insert(all.end(), more.begin(), more.end()); };
  if (!record.clamps.empty()) add({clamps(record)});
  if (!scene::on_a_line(given.geometry)) {
    add(charges(given));
    add(splits(given, record));
    add(walls(given));
  }
  if (const std::size_t count = record.warnings.size(); count > 0)
    add({{"warnings", Trust::notice,
          count == 1 ? "1 warning was given: it stands in summary.json"
                     : output::grouped(std::int64_t(count)) + " warnings were given: they stand in summary.json"}});
  add(known_limits(given));
  return all;
}

std::string trust_text(const std::vector<TrustRecord>& matters) {
  std::string text = "\n";
  text += output::inked("Can this run be trusted?", output::Ink::bold);
  text += "\n";
  Trust worst = Trust::good;
  for (const TrustRecord& matter : matters) {
    worst = std::max(worst, matter.level);
    text += "  ";
    text += matter.about == "known limit" ? output::inked("-   ", output::Ink::dim) : mark(matter.level);
    text += "  " + output::padded_right(matter.about, 16) + "  " + matter.text + "\n";
  }
  switch (worst) {
    case Trust::good: text += "Yes: everything that the run can check of itself is as it should be. "; break;
    case Trust::notice: text += "With care: look at what is marked \"note\". "; break;
    case Trust::bad: text += "No: what is marked BAD has to be mended first. "; break;
  }
  return text + "A second run at half the spacing says how far it is from converged.\n";
}

}  // namespace undex::run
