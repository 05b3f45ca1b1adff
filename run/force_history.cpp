#include "run/force_history.hpp"

#include "sph_fluid/walls/slip_faces.hpp"

namespace undex::run {
namespace {

const char* const names_of_faces[] = {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high", "side"};

/// Which faces of the walls mirror the fluid.
std::array<bool, sph::fixed_face_count> mirroring(const sph::SlipFaces& faces) {
  std::array<bool, sph::fixed_face_count> found{};
  found[sph::round_face] = !faces.round.empty();
  for (const sph::SlipFaces::Pair& pair : faces.plane) {
    if (pair.low > -1e299 && !pair.symmetric) found[std::size_t(2 * pair.axis)] = true;
    if (pair.high < 1e299) found[std::size_t(2 * pair.axis + 1)] = true;
  }
  return found;
}

}  // namespace

ForceHistory::ForceHistory(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder,
                           bool goes_on)
    : path_(folder / "forces.csv") {
  if (!scene.output.wants("forces")) return;
  const int dimension = !scene.structures.empty() ? 3 : scene.fluid.dimension;
  columns_ = {{"time", "s"}};
  // Vectors of the meridian are those of the axis of revolution: what whole rings receive across it is nothing.
  const std::optional<Meridian>& meridian = simulation.meridian();
  const auto add = [&](const std::string& name, int first, int end, std::function<Vec3(const Simulation&)> impulse) {
    receivers_.push_back({std::move(impulse), first, end});
    for (int a = first; a < end; ++a) {
      columns_.push_back({name + ".force_" + "xyz"[a], "N"});
      columns_.push_back({name + ".impulse_" + "xyz"[a], "N s"});
    }
  };
  const int first = meridian ? meridian->axis : 0, end = meridian ? meridian->axis + 1 : dimension;
  const auto in_space = [](const Simulation& of, const Vec3& given) {
    return of.meridian() ? of.meridian()->vector_in_space(given, of.meridian()->outward()) : given;
  };
  const bool several = scene.structures.size() > 1;
  if (simulation.on_structure() && !several)
    add("structure", first, end, [=](const Simulation& of) { return in_space(of, of.on_structure()->impulse_given); });
  if (simulation.on_structure() && several)
    for (std::size_t k = 0; k < scene.structures.size(); ++k)
      if (!scene.structures[k].wet_faces.empty())
        add("structures." + scene.structures[k].name, first, end, [k](const Simulation& of) { return of.accounts()[k].impulse; });
  if (const coupling::FaceImpulses* faces = simulation.on_faces(); faces && faces->faces().size() > 1)
    for (std::size_t k = 0; k < faces->faces().size(); ++k)
      add((several ? "structures." : "structure.") + faces->faces()[k].name, first, end,
          [=](const Simulation& of) { return in_space(of, of.on_faces()->impulse()[k]); });
  if (const sph::Fluid* fluid = simulation.fluid()) {
    const auto found = mirroring(sph::slip_faces(fluid->settings()));
    for (int face = 0; face < sph::fixed_face_count; ++face) {
      if (!found[std::size_t(face)]) continue;
      const auto impulse = [=](const Simulation& of) { return in_space(of, of.fluid()->on_fixed_faces()[std::size_t(face)]); };
      if (!meridian) {
        const bool round = face == sph::round_face;
        add(std::string("walls.") + names_of_faces[face], round ? 0 : face / 2, round ? dimension : face / 2 + 1, impulse);
      } else if (face == 2 || face == 3) {
        add(std::string("walls.") + (face == 2 ? "low" : "high"), meridian->axis, meridian->axis + 1, impulse);
      }
    }
  }
  if (receivers_.empty()) return;
  samples_ = output::Samples(columns_);
  if (!goes_on) history_.emplace(path_, columns_);
}

void ForceHistory::visit_state(StateVisitor& state) {
  bool known = !receivers_.empty();  // by the checkpoint
  state("wanted", known);
  if (known) samples_.visit_state(state);
  if (!state.restores() || receivers_.empty()) return;
  if (!known) samples_ = output::Samples(columns_);
  history_.emplace(output::History::continued(path_, samples_));
}

void ForceHistory::sample(const Simulation& simulation) {
  if (receivers_.empty()) return;
  std::vector<double> row{simulation.time()};
  const std::size_t rows = samples_.rows();
  const double since = rows > 0 ? simulation.time() - samples_.values[0][rows - 1] : 0.0;
  std::size_t column = 1;
  for (const Receiver& receiver : receivers_) {
    const Vec3 impulse = receiver.impulse(simulation);
    for (int a = receiver.first; a < receiver.end; ++a, column += 2) {
      const double before = rows > 0 ? samples_.values[column + 1][rows - 1] : 0.0;
      row.push_back(since > 0 ? (impulse[a] - before) / since : 0.0);
      row.push_back(impulse[a]);
    }
  }
  history_->append(row);
  samples_.append(row);
}

void ForceHistory::flush() {
  if (history_) history_->flush();
}

}  // namespace undex::run
