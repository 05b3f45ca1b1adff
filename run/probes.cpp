#include "run/probes.hpp"

namespace undex::run {
namespace {

const char* const axis_name[3] = {"_x", "_y", "_z"};

/// Columns that one quantity of a probe fills, in the order of read().
std::vector<output::Column> columns_of(const std::string& quantity, int dimension) {
  std::vector<output::Column> columns;
  const auto vector = [&](const std::string& name, const std::string& unit) {
    for (int a = 0; a < dimension; ++a) columns.push_back({name + axis_name[a], unit});
  };
  if (quantity == "pressure") columns.push_back({"pressure", "Pa"});
  if (quantity == "density") columns.push_back({"density", "kg/m3"});
  if (quantity == "void_fraction") columns.push_back({"void_fraction", ""});
  if (quantity == "plastic_strain") columns.push_back({"plastic_strain", ""});
  if (quantity == "temperature") columns.push_back({"temperature", "K"});
  if (quantity == "velocity") vector("velocity", "m/s");
  if (quantity == "displacement") vector("displacement", "m");
  if (quantity == "stress")
    for (const char* part : {"xx", "yy", "zz", "xy", "yz", "zx"}) columns.push_back({std::string("stress_") + part, "Pa"});
  return columns;
}

/// The point of the solids' surfaces nearest to x, if one lies within `reach` [m].
std::optional<Vec3> nearest_surface(const sph::Settings& settings, const Vec3& x, double reach) {
  std::optional<Vec3> nearest;
  double best = reach;
  for (const sph::SolidBody& solid : settings.solids) {
    const auto distance = [&](const Vec3& at) { return signed_distance(solid.shape, at, settings.dimension); };
    const double away = distance(x);
    if (std::abs(away) > best) continue;
    best = std::abs(away);
    Vec3 outward = Vec3::Zero();
    for (int a = 0; a < settings.dimension; ++a) {
      const Vec3 step = 1e-3 * reach * Vec3::Unit(a);
      outward[a] = distance(x + step) - distance(x - step);
    }
    nearest = x - away * outward.stableNormalized();
  }
  return nearest;
}

/// Columns of a material point, whichever solver it belongs to.
template <class Values>
void append_material(const Values& v, const std::vector<std::string>& quantities, int dimension, std::vector<double>& row) {
  const auto vector = [&](const Vec3& value) { row.insert(row.end(), value.data(), value.data() + dimension); };
  for (const std::string& quantity : quantities) {
    if (quantity == "displacement") vector(v.displacement);
    if (quantity == "velocity") vector(v.velocity);
    if (quantity == "plastic_strain") row.push_back(v.plastic_strain);
    if (quantity == "temperature") row.push_back(v.temperature);
    if (quantity == "stress")
      for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}) row.push_back(v.stress(i, j));
  }
}

}  // namespace

Probes::Probes(const scene::Scene& scene, const Simulation& simulation, const std::filesystem::path& folder)
    : dimension_(scene.structure ? 3 : scene.fluid.dimension) {
  if (!scene.probes.empty()) std::filesystem::create_directories(folder / "history");
  for (const scene::Probe& probe : scene.probes) {
    std::vector<output::Column> columns{{"time", "s"}};
    for (const std::string& quantity : probe.quantities)
      for (const output::Column& column : columns_of(quantity, dimension_)) columns.push_back(column);
    std::optional<coupling::WetWall::Foot> foot;
    std::optional<fem::Structure::Probe> material;
    if (probe.kind == scene::Probe::Kind::wall && simulation.coupler()) {
      foot = simulation.coupler()->wall().nearest(probe.point);
      // Nearer to the wet face than to any rigid wall: it moves with the face.
      if (foot->distance > 2.0 * scene.fluid.lattice.spacing) foot.reset();
    }
    std::optional<sph::Solids::Point> solid;
    if (const sph::Solids* solids = simulation.solids()) {
      if (probe.kind == scene::Probe::Kind::structure) solid = solids->locate(probe.point);
      if (probe.kind == scene::Probe::Kind::wall)
        if (const auto at = nearest_surface(scene.fluid, probe.point, 2.0 * scene.fluid.lattice.spacing))
          solid = solids->locate(*at);
    } else if (probe.kind == scene::Probe::Kind::structure) {
      material = simulation.structure()->locate(probe.point);
    }
    output::History history(folder / "history" / (probe.name + ".csv"), columns);
    channels_.push_back({.probe = probe,
                         .foot = foot,
                         .material = material,
                         .solid = solid,
                         .history = std::move(history),
                         .samples = output::Samples(std::move(columns))});
  }
}

std::vector<double> Probes::read(const Channel& channel, const Simulation& simulation) const {
  std::vector<double> row{simulation.time()};
  const auto vector = [&](const Vec3& v) { row.insert(row.end(), v.data(), v.data() + dimension_); };
  if (channel.probe.kind == scene::Probe::Kind::structure) {
    if (channel.solid) append_material(simulation.solids()->read(*channel.solid), channel.probe.quantities, dimension_, row);
    else append_material(simulation.structure()->read(*channel.material), channel.probe.quantities, dimension_, row);
    return row;
  }
  const Vec3 place = channel.foot    ? simulation.coupler()->position_of(*channel.foot)
                     : channel.solid ? simulation.solids()->read(*channel.solid).position
                                     : channel.probe.point;
  const sph::PointValues v = simulation.fluid()->at(place);
  for (const std::string& quantity : channel.probe.quantities) {
    if (quantity == "pressure") row.push_back(v.pressure);
    if (quantity == "density") row.push_back(v.density);
    if (quantity == "void_fraction") row.push_back(v.void_fraction);
    if (quantity == "velocity") vector(v.velocity);
  }
  return row;
}

void Probes::append(Channel& channel, const std::vector<double>& row) {
  channel.history.append(row);
  channel.samples.append(row);
}

void Probes::sample(const Simulation& simulation) {
  for (Channel& channel : channels_) append(channel, read(channel, simulation));
}

void Probes::sample_before(const Simulation& simulation, double time) {
  for (Channel& channel : channels_) {
    if (channel.probe.kind == scene::Probe::Kind::fluid) continue;  // it may lie inside the wave
    std::vector<double> row = read(channel, simulation);
    row[0] = time;
    append(channel, row);
  }
}

void Probes::flush() {
  for (Channel& channel : channels_) channel.history.flush();
}

std::map<std::string, output::Samples> Probes::samples() const {
  std::map<std::string, output::Samples> all;
  for (const Channel& channel : channels_) all[channel.probe.name] = channel.samples;
  return all;
}

}  // namespace undex::run
