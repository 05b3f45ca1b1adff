#include "run/profile_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/probes.hpp"

namespace undex::run {
namespace {

std::vector<output::Column> columns_of(const scene::ProfileLine& line, int dimension) {
  std::vector<output::Column> columns{{"time", "s"}, {"distance", "m"}};
  for (int a = 0; a < dimension; ++a) columns.push_back({std::string(1, "xyz"[a]), "m"});
  for (const PointQuantity<FluidPoint>& quantity : chosen(fluid_quantities, line.quantities))
    for (const std::string& name : undex::columns_of(quantity, dimension)) columns.push_back({name, quantity.unit});
  return columns;
}

}  // namespace

ProfileLines::ProfileLines(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder,
                           bool goes_on)
    : dimension_(!scene.structures.empty() ? 3 : scene.fluid.dimension) {
  if (!scene.lines.empty()) std::filesystem::create_directories(folder / "lines");
  for (const scene::ProfileLine& given : scene.lines) {
    Line& line = lines_.emplace_back();
    line.given = &given;
    line.path = folder / "lines" / (given.name + ".csv");
    line.samples = output::Samples(columns_of(given, dimension_));
    line.next = next_after(given, simulation.time() > 0 ? simulation.time() * (1 - 1e-12) : -1.0);
    if (!goes_on) line.history.emplace(line.path, line.samples.columns);
  }
}

double ProfileLines::next_after(const scene::ProfileLine& line, double time) {
  double next = std::numeric_limits<double>::infinity();
  if (line.interval > 0) next = time < 0 ? 0.0 : (std::floor(time / line.interval * (1 + 1e-12)) + 1) * line.interval;
  const auto further = std::upper_bound(line.times.begin(), line.times.end(), time);
  return further == line.times.end() ? next : std::min(next, *further);
}

void ProfileLines::visit_state(StateVisitor& state) {
  std::string known;  // names, each with a line's end
  for (const Line& line : lines_) known += line.given->name + "\n";
  state("names", known);
  for (Line& line : lines_) {
    if (("\n" + known).find("\n" + line.given->name + "\n") != std::string::npos)
      state.part("line " + line.given->name, [&] { line.samples.visit_state(state); });
    if (!state.restores()) continue;
    line.history.emplace(output::History::continued(line.path, line.samples));
    const double last = line.samples.rows() > 0 ? line.samples.values.front().back() : -1.0;
    line.next = next_after(*line.given, last);
  }
}

void ProfileLines::look(const Simulation& simulation) {
  for (Line& line : lines_)
    if (simulation.time() * (1 + 1e-12) >= line.next) {
      write(line, simulation);
      line.next = next_after(*line.given, simulation.time());
    }
}

void ProfileLines::write(Line& line, const Simulation& simulation) {
  const scene::ProfileLine& given = *line.given;
  const auto quantities = chosen(fluid_quantities, given.quantities);
  for (int k = 0; k < given.points; ++k) {
    const double share = double(k) / (given.points - 1);
    const Vec3 x = (1.0 - share) * given.from + share * given.to;
    std::vector<double> row{simulation.time(), share * (given.to - given.from).norm()};
    row.insert(row.end(), x.data(), x.data() + dimension_);
    FluidPoint point = fluid_at(simulation, x);
    if (point.neighbours == 0) {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      point = {.pressure = nan, .density = nan, .void_fraction = nan, .velocity = Vec3::Constant(nan)};
    }
    for (const PointQuantity<FluidPoint>& quantity : quantities) append_values(quantity, point, dimension_, row);
    line.history->append(row);
    line.samples.append(row);
  }
}

void ProfileLines::flush() {
  for (Line& line : lines_) line.history->flush();
}

std::map<std::string, output::Samples> ProfileLines::samples() const {
  std::map<std::string, output::Samples> all;
  for (const Line& line : lines_) all[line.given->name] = line.samples;
  return all;
}

}  // namespace undex::run
