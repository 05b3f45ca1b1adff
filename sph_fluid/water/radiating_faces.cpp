#include "sph_fluid/water/radiating_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/surface.hpp"

namespace undex::sph {
namespace {

constexpr double depth = 1.5;                    // of the layer that nodes see, in spacings
constexpr double steepest = 0.9;                 // largest sin^2 of the angle that the motion along a face may show
constexpr double least_cosine = 0.1;             // of the angle to a source
constexpr double still = 1e-10;                  // share of the sound speed below which a wave has no angle
constexpr double dry = 0.1;                      // share of the weight at the start below which a node follows its neighbours
constexpr double memory = 8.0;                   // of the angle, in times that sound takes through a spacing
constexpr double narrowest = 0.4, widest = 4.0;  // of a mesh's edges over their lengths at the start

/// Extrapolates a rate over a step of dt [s] after one of `last` [s]; from the second step on of second order.
template <class T>
T ahead(const T& now, const T& before, double dt, double last) {
  if (!(last > 0.0)) return now;
  return now + 0.5 * std::min(2.0, dt / last) * (now - before);
}

}  // namespace

RadiatingFaces::RadiatingFaces(const Settings& settings, MovingWalls& walls) : settings_(settings), walls_(walls) {
  if (!std::any_of(settings.walls.begin(), settings.walls.end(), [](const Wall& wall) { return wall.radiates(); })) return;
  RadiatingMeshes meshes = radiating_meshes(settings);
  faces_ = std::move(meshes.faces);
  shared_ = std::move(meshes.shared);
  for (const RadiatingMesh& face : faces_) walls.mirrors.push_back(face.wall);  // the face keeps its places of the start
  begin_anew();
}

void RadiatingFaces::begin_anew() {
  rest_.clear();
  body_.clear();
  medium_.clear();
  whole_.clear();
  state_ = {};
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::size_t nodes = faces_[f].wall.position.size();
    state_.velocity_before.emplace_back(nodes, Vec3::Zero());
    for (auto* each :
         {&state_.flow, &state_.rate, &state_.rate_before, &state_.wave, &state_.along, &state_.mean_wave, &state_.mean_along})
      each->emplace_back(nodes, 0.0);
    walls_.mirrors[f] = faces_[f].wall;
    walls_.mirrors[f].impulse.assign(nodes, Vec3::Zero());
  }
}

double RadiatingFaces::Rest::pressure_at(const Vec3& x, const Settings& settings, const Body& body) const {
  const double absolute = column ? column->pressure((x - *body.level).dot(settings.gravity) / settings.gravity.norm()) : pressure;
  return absolute - settings.surroundings.pressure;
}

void RadiatingFaces::see(const ParticleSet& set, std::span<const WallFoot> feet, double time) {
  const bool first = rest_.empty();
  if (first) begin(set, feet);
  const SeenByNodes seen = look(set, feet);
  if (first) {
    state_.reached = time;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t n = 0; n < seen[f].size(); ++n) whole_[f].push_back(seen[f][n].weight);
  }
  watch_strangers(set, seen);
  std::vector<std::vector<double>> speed;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    // A wave that has passed before the start has left its afterflow.
    if (first && faces_[f].source)
      for (std::size_t n = 0; n < seen[f].size(); ++n)
        if (const Seen& here = seen[f][n]; here.weight > 0.0)
          state_.flow[f][n] = here.velocity.dot((wall(f).position[n] - *faces_[f].source).normalized()) - here.wave;
    speed.push_back(answer(f, seen[f], time));
    for (std::size_t n = 0; n < speed[f].size(); ++n) wall(f).velocity[n] = speed[f][n] * faces_[f].normal[n];
  }
  // At an edge a node goes with all of its faces, whose normals are across one another.
  for (const SharedNode& node : shared_) {
    Vec3 velocity = Vec3::Zero();
    for (const auto [f, n] : node.places) velocity += speed[f][n] * faces_[f].normal[n];
    for (const auto [f, n] : node.places) wall(f).velocity[n] = velocity;
  }
}

/// Media at rest, and who stands at which node.
void RadiatingFaces::begin(const ParticleSet& set, std::span<const WallFoot> feet) {
  for (const Group& group : set.groups) {
    const Body& body = *group.body;
    const double energy = start_energy(body);
    const auto state = std::visit([&](const auto& law) { return law.evaluate(group.rest_density, energy); }, body.material.law);
    Rest rest{.pressure = state.pressure, .density = group.rest_density, .sound = state.sound_speed, .column = {}};
    if (body.level) rest.column = hydrostatic_column(body, settings_.gravity, settings_.dimension);
    rest_.push_back(std::move(rest));
  }
  // The medium of a node is that of most of its weight.
  std::vector<std::vector<std::vector<double>>> weight;
  for (const RadiatingMesh& face : faces_)
    weight.emplace_back(face.wall.position.size(), std::vector<double>(set.groups.size(), 0.0));
  for (const WallFoot& foot : feet) {
    if (std::size_t(foot.wall) >= faces_.size()) continue;
    std::size_t g = 0;
    while (foot.particle >= set.groups[g].end) ++g;
    const double w = set.particles.predicted[foot.particle].volume *
                     std::max(0.0, 1.0 - std::max(foot.at.distance, 0.0) / (depth * set.groups[g].spacing));
    const auto corner = bilinear_weights(foot.at.u, foot.at.v);
    const auto& nodes = faces_[foot.wall].wall.faces[foot.face];
    for (int c = 0; c < 4; ++c) weight[foot.wall][nodes[c]][g] += corner[c] * w;
  }
  for (const auto& nodes : weight) {
    body_.emplace_back();
    medium_.emplace_back();
    for (const auto& of : nodes) {
      const auto most = std::max_element(of.begin(), of.end());
      body_.back().push_back(*most > 0.0 ? int(most - of.begin()) : -1);
      medium_.back().push_back(*most > 0.0 ? int(set.groups[most - of.begin()].material) : -1);
    }
  }
  whole_.resize(faces_.size());
}

RadiatingFaces::SeenByNodes RadiatingFaces::look(const ParticleSet& set, std::span<const WallFoot> feet) const {
  SeenByNodes seen;
  for (const RadiatingMesh& face : faces_) seen.emplace_back(face.wall.position.size());
  std::size_t g = 0;
  for (const WallFoot& foot : feet) {  // sorted by particle
    while (foot.particle >= set.groups[g].end) ++g;
    const Group& group = set.groups[g];
    const double share = 1.0 - std::max(foot.at.distance, 0.0) / (depth * group.spacing);
    if (std::size_t(foot.wall) >= faces_.size()) continue;
    const FluidRow& q = set.particles.predicted[foot.particle];
    const Rest& rest = rest_[g];
    const Vec3 velocity(q.vx, q.vy, settings_.axisymmetric ? 0.0 : q.vz);
    const double over = q.p - rest.pressure_at(place_of(set.particles, foot.particle), settings_, *group.body);
    const double impedance = 0.5 * (q.rho * q.c + rest.density * rest.sound), wave = over / impedance;
    const double enthalpy = 2.0 * over / (q.rho + rest.density);
    const auto [layer, upper] = layer_of(foot.at.distance, settings_.lattice.spacing, seen_depths);
    const auto corner = bilinear_weights(foot.at.u, foot.at.v);
    const auto& nodes = faces_[foot.wall].wall.faces[foot.face];
    for (int c = 0; c < 4; ++c) {
      Seen& node = seen[foot.wall][nodes[c]];
      const int medium = medium_[foot.wall][nodes[c]];
      const bool foreign = medium >= 0 && medium != int(group.material);
      if (!foreign)
        for (const int k : {0, 1}) {
          const double part = corner[c] * q.volume * (k == 0 ? 1.0 - upper : upper);
          node.in_layer[layer + k] += part;
          node.over[layer + k] += part * over;
        }
      if (share <= 0.0) continue;
      const double w = corner[c] * share * q.volume;
      if (foreign) {
        node.foreign += w;
        continue;
      }
      node.weight += w;
      node.wave += w * wave;
      node.enthalpy += w * enthalpy;
      node.impedance += w * impedance;
      node.velocity += w * velocity;
    }
  }
  for (auto& nodes : seen)
    for (Seen& node : nodes) {
      if (node.weight > 0.0) {
        const double per = 1.0 / node.weight;
        node.wave *= per, node.enthalpy *= per, node.impedance *= per, node.velocity *= per;
      }
      double before = node.wave * node.impedance;  // an empty layer is as the one before it
      for (int k = 0; k < seen_depths; ++k)
        before = node.over[k] = node.in_layer[k] > 0.0 ? node.over[k] / node.in_layer[k] : before;
    }
  return seen;
}

/// What stood at no face at the start has no medium behind one.
void RadiatingFaces::watch_strangers(const ParticleSet& set, const SeenByNodes& seen) {
  if (!trouble_.empty()) return;
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (std::size_t n = 0; n < seen[f].size(); ++n) {
      if (medium_[f][n] < 0 || seen[f][n].foreign < 0.5 * whole_[f][n]) continue;
      const auto stands = [&](const Group& group) {
        return std::any_of(medium_.begin(), medium_.end(), [&](const auto& nodes) {
          return std::find(nodes.begin(), nodes.end(), int(group.material)) != nodes.end();
        });
      };
      for (const Group& group : set.groups)
        if (group.begin < group.end && !stands(group)) {
          trouble_ = "another body than at the start has come to " + faces_[f].name +
                     ", behind which stands what was there then; take a larger wall, or end the run before";
          return;
        }
    }
}

std::vector<double> RadiatingFaces::answer(std::size_t face, const std::vector<Seen>& seen, double time) {
  const std::vector<Vec3>& normal = faces_[face].normal;
  std::vector<double> speed(seen.size(), 0.0), wave(seen.size(), 0.0);
  const auto wet = [&](std::size_t n) { return seen[n].weight > dry * whole_[face][n]; };
  for (std::size_t n = 0; n < seen.size(); ++n) {
    if (!wet(n)) {
      state_.rate[face][n] = state_.wave[face][n] = state_.along[face][n] = 0.0;
      continue;
    }
    const double u = seen[n].velocity.dot(normal[n]);
    state_.wave[face][n] = seen[n].wave * seen[n].wave;
    state_.along[face][n] = (seen[n].velocity - u * normal[n]).squaredNorm();
    const auto [flow, cosine] = faces_[face].source ? spherical(face, n, seen[n], time) : plane(face, n);
    speed[n] = 0.5 * (u + (seen[n].wave + flow) * cosine);
    wave[n] = seen[n].impedance * 0.5 * (seen[n].wave + u / cosine - flow);
  }
  // Where there is nothing before the face it goes with what is beside.
  std::vector<double> sum(seen.size(), 0.0), waves(seen.size(), 0.0), count(seen.size(), 0.0);
  for (const auto& nodes : faces_[face].wall.faces)
    for (const int n : nodes)
      for (const int m : nodes)
        if (wet(m)) sum[n] += speed[m], waves[n] += wave[m], count[n] += 1.0;
  for (std::size_t n = 0; n < seen.size(); ++n) {
    if (!wet(n) && count[n] > 0.0) speed[n] = sum[n] / count[n], wave[n] = waves[n] / count[n];
    for (int k = 0; k < seen_depths; ++k) wall(face).pressure[n * seen_depths + k] = wave[n] - seen[n].over[k];
  }
  return speed;
}

RadiatingFaces::Outgoing RadiatingFaces::spherical(std::size_t face, std::size_t node, const Seen& seen, double time) {
  const Vec3 away = wall(face).position[node] - *faces_[face].source;
  const double r = away.norm(), outward = seen.velocity.dot(away) / r;
  const double k = settings_.dimension == 1 ? 0.0 : settings_.dimension == 3 || settings_.axisymmetric ? 1.0 : 0.5;
  double& rate = state_.rate[face][node];
  const double flow = state_.flow[face][node] - (state_.reached - time) * rate;
  rate = k * (seen.enthalpy + 0.5 * outward * outward - 2.0 * flow * outward) / r;
  return {flow, std::max(least_cosine, away.dot(faces_[face].normal[node]) / r)};
}

RadiatingFaces::Outgoing RadiatingFaces::plane(std::size_t face, std::size_t node) const {
  double wave = state_.mean_wave[face][node], along = state_.mean_along[face][node];
  if (wave == 0.0) wave = state_.wave[face][node], along = state_.along[face][node];
  const double least = still * rest_[body_of(face, node)].sound;
  return {0.0, std::sqrt(1.0 - std::min(steepest, along / (wave + least * least)))};
}

void RadiatingFaces::advance(double dt) {
  if (faces_.empty()) return;
  if (!trouble_.empty()) throw NumericalStop(trouble_, /*resumable=*/true);
  const double last = state_.last_step;
  PointLoads place(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    place[f] = wall(f).position;
    for (std::size_t n = 0; n < place[f].size(); ++n)
      place[f][n] += dt * ahead(wall(f).velocity[n], state_.velocity_before[f][n], dt, last);
    require_mesh(f, place[f]);
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    wall(f).position = std::move(place[f]);
    state_.velocity_before[f] = wall(f).velocity;
    for (std::size_t n = 0; n < wall(f).position.size(); ++n) {
      state_.flow[f][n] += dt * ahead(state_.rate[f][n], state_.rate_before[f][n], dt, last);
      state_.rate_before[f][n] = state_.rate[f][n];
      const double share = 1.0 - std::exp(-dt * rest_[body_of(f, n)].sound / (memory * settings_.lattice.spacing));
      state_.mean_wave[f][n] += share * (state_.wave[f][n] - state_.mean_wave[f][n]);
      state_.mean_along[f][n] += share * (state_.along[f][n] - state_.mean_along[f][n]);
    }
  }
  state_.last_step = dt;
  state_.reached += dt;
}

/// Edges that nodes at rest or of another face squeeze or draw out too far show no more what stands before them.
void RadiatingFaces::require_mesh(std::size_t face, const std::vector<Vec3>& moved) const {
  const MirrorWall& start = faces_[face].wall;
  for (const auto& nodes : start.faces)
    for (int c = 0; c < 4; ++c) {
      const int a = nodes[c], b = nodes[(c + 1) % 4];
      if (a == b) continue;
      const double ratio = (moved[b] - moved[a]).norm() / (start.position[b] - start.position[a]).norm();
      if (ratio > narrowest && ratio < widest) continue;
      throw NumericalStop(faces_[face].name +
                              " has moved so far with the fluid that its mesh no longer shows what stands before it; take a "
                              "larger wall, or end the run before",
                          /*resumable=*/true);
    }
}

Vec3 RadiatingFaces::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (const Vec3& impulse : wall(f).impulse) sum += impulse;
  return sum;
}

void RadiatingFaces::visit_state(StateVisitor& state) {
  if (faces_.empty()) return;
  for (std::size_t f = 0; f < faces_.size(); ++f) state("pressure " + std::to_string(f), wall(f).pressure);
  state("velocity before", state_.velocity_before);
  state("flow", state_.flow);
  state("rate", state_.rate);
  state("rate before", state_.rate_before);
  state("wave", state_.wave);
  state("along", state_.along);
  state("mean wave", state_.mean_wave);
  state("mean along", state_.mean_along);
  state("last step", state_.last_step);
  state("reached", state_.reached);
  state("trouble", trouble_);
}

}  // namespace undex::sph
