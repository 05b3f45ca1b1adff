// Compatible staggered Lagrangian scheme in one dimension; equations and sources in the header.
#include "exact/lagrangian_1d.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "core/errors.hpp"
#include "materials/stress_update.hpp"

namespace undex::exact {

namespace {

[[noreturn]] void refuse(const std::string& message) { throw std::invalid_argument("Lagrangian1D: " + message); }

using materials::FluidLaw;
using materials::Solid;

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

void check(int dimension, const std::vector<Layer>& layers, const Lagrangian1DOptions& options) {
  if (dimension < 1 || dimension > 3) refuse(text("dimension must be 1, 2 or 3, got ", dimension));
  if (layers.empty()) refuse("needs at least one layer");
  if (!(options.courant > 0 && options.courant < 1))
    refuse(text("the Courant number must lie between 0 and 1, got ", options.courant));
  if (!(options.inner_mass >= 0 && options.outer_mass >= 0))
    refuse(text("the masses of plates must not be negative, got ", options.inner_mass, " and ", options.outer_mass, " kg/m^2"));
  if (dimension > 1 && options.gravity != 0.0) refuse("gravity is not spherical or cylindrical");
  if (dimension > 1 && !(layers.front().inner >= 0)) refuse(text("radii begin at 0, got ", layers.front().inner, " m"));
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Layer& layer = layers[k];
    if (!(layer.outer > layer.inner))
      refuse(text("layer ", k, " must have a positive thickness, got ", layer.inner, " to ", layer.outer, " m"));
    if (layer.cells < 1) refuse(text("layer ", k, " needs at least one cell, got ", layer.cells));
    if (!layer.places.empty() && static_cast<int>(layer.places.size()) != layer.cells - 1)
      refuse(text("layer ", k, " of ", layer.cells, " cells has ", layer.places.size(), " places between them"));
    if (!(layer.ratio > 0)) refuse(text("ratio of layer ", k, " must be positive, got ", layer.ratio));
    if (!layer.start && !(layer.density > 0)) refuse(text("density of layer ", k, " must be positive, got ", layer.density));
    if (k > 0 && std::abs(layer.inner - layers[k - 1].outer) > 1e-12 * std::abs(layer.inner))
      refuse(text("layer ", k, " begins at ", layer.inner, " m, but the one before it ends at ", layers[k - 1].outer, " m"));
    if (std::holds_alternative<Solid>(layer.law) && dimension == 2)
      refuse(text("layer ", k, " is a solid, which cylindrical symmetry does not have"));
    const auto* fluid = std::get_if<FluidLaw>(&layer.law);
    if (layer.burn && !(fluid && std::holds_alternative<materials::Jwl>(*fluid)))
      refuse(text("layer ", k, " burns, so its law must be that of detonation products (Jwl)"));
  }
}

const materials::TaitWater* tait_of(const Layer& layer) {
  const auto* fluid = std::get_if<FluidLaw>(&layer.law);
  return fluid ? std::get_if<materials::TaitWater>(fluid) : nullptr;
}

/// Specific energy [J/kg] of a layer's start.
double start_energy(const Layer& layer, const StartPoint& state) {
  const auto* fluid = std::get_if<FluidLaw>(&layer.law);
  if (!fluid) return state.energy;
  return std::visit(
      [&](const auto& law) {
        if constexpr (std::remove_cvref_t<decltype(law)>::uses_energy) return state.energy;
        else return law.barotropic_energy(state.density);
      },
      *fluid);
}

StartPoint start_of(const Layer& layer, double radius) {
  return layer.start ? layer.start(radius) : StartPoint{layer.density, layer.velocity, layer.energy};
}

double first_width(double length, int cells, double ratio) {
  if (ratio == 1.0) return length / cells;
  return length * std::expm1(std::log(ratio)) / std::expm1(cells * std::log(ratio));
}

}  // namespace

double grading(double length, int cells, double first) {
  if (!(first > 0 && first < length && cells >= 2))
    throw std::invalid_argument(
        text("grading: needs at least two cells and a first one shorter than ", length, " m, got ", cells, " and ", first, " m"));
  double low = 1e-3, high = 1e3;  // the first width falls with the ratio
  for (double middle = 1.0; middle > low && middle < high; middle = std::sqrt(low * high))
    (first_width(length, cells, middle) > first ? low : high) = middle;
  return std::sqrt(low * high);
}

Lagrangian1D::Lagrangian1D(int dimension, std::vector<Layer> layers, Boundary inner, Boundary outer,
                           const Lagrangian1DOptions& options)
    : dimension_(dimension), layers_(std::move(layers)), inner_(inner), outer_(outer), options_(options) {
  check(dimension_, layers_, options_);
  area_factor_ = dimension_ == 1 ? 1.0 : dimension_ * std::numbers::pi * (dimension_ == 2 ? 1.0 : 4.0 / 3.0);

  r_.push_back(layers_.front().inner);
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    const Layer& layer = layers_[k];
    Block block{cells(), 0, 0.0};
    if (const auto* tait = tait_of(layer))
      if (tait->parameters().cavitation == materials::Cavitation::schmidt)
        block.stiffest_sound = tait->parameters().mixture.liquid_sound;
    double width = first_width(layer.outer - layer.inner, layer.cells, layer.ratio);
    for (int i = 0; i < layer.cells; ++i, width *= layer.ratio) {
      const double from = r_.back();
      const double to = i + 1 == layer.cells ? layer.outer : layer.places.empty() ? from + width : layer.places[i];
      const StartPoint state = start_of(layer, 0.5 * (from + to));
      if (!(state.density > 0))
        refuse(text("layer ", k, " starts with the density ", state.density, " kg/m^3 between ", from, " and ", to, " m"));
      r_.push_back(to);
      start_volume_.push_back(volume_to(to) - volume_to(from));
      start_density_.push_back(state.density);
      cell_mass_.push_back(state.density * start_volume_.back());
      cell_layer_.push_back(static_cast<int>(k));
      start_middle_.push_back(0.5 * (from + to));
      e_.push_back(start_energy(layer, state));
    }
    block.end = cells();
    blocks_.push_back(block);
  }

  const int n = cells();
  u_.assign(n + 1, 0.0);
  node_mass_.assign(n + 1, 0.0);
  for (int i = 0; i < n; ++i)
    for (const int node : {i, i + 1}) {
      node_mass_[node] += 0.5 * cell_mass_[i];
      u_[node] += 0.5 * cell_mass_[i] * start_of(layers_[cell_layer_[i]], r_[node]).velocity;
    }
  // A plate is a node's mass.
  const auto area = [&](double radius) { return dimension_ == 1 ? 1.0 : area_factor_ * std::pow(radius, dimension_ - 1); };
  if (inner_ == Boundary::free) node_mass_[0] += options_.inner_mass * area(r_[0]);
  if (outer_ == Boundary::free) node_mass_[n] += options_.outer_mass * area(r_[n]);
  for (int i = 0; i <= n; ++i) {
    const bool held = (i == 0 && inner_ == Boundary::rigid) || (i == n && outer_ == Boundary::rigid);
    u_[i] = held ? 0.0 : u_[i] / node_mass_[i];
  }
  inner_start_velocity_ = u_[0];
  outer_start_velocity_ = u_[n];

  rho_ = start_density_;
  for (auto* field : {&p_, &q_, &c_, &viscous_sound_, &slope_}) field->assign(n, 0.0);
  area_.assign(n + 1, 0.0);
  if (std::any_of(layers_.begin(), layers_.end(), [](const Layer& l) { return std::holds_alternative<Solid>(l.law); })) {
    solids_.for_each([&](const char*, std::vector<double>& values) { values.assign(n, 0.0); });
    for (int i = 0; i < n; ++i)
      if (const auto* solid = std::get_if<Solid>(&layers_[cell_layer_[i]].law)) solids_.temperature[i] = solid->T_room;
    solids_new_ = solids_;
    push_in_.assign(n, 0.0);
    push_out_.assign(n, 0.0);
  }
  pressures(0, n, 0.0, r_, u_, rho_, e_, p_, q_);
  inner_start_pressure_ = p_[0];
  outer_start_pressure_ = p_[n - 1];
  if (inner_ == Boundary::radiating) inner_start_pressure_ -= rho_[0] * options_.gravity * (middle(0) - r_[0]);
  if (outer_ == Boundary::radiating) outer_start_pressure_ += rho_[n - 1] * options_.gravity * (r_[n] - middle(n - 1));
  inner_start_density_ = rho_[0], outer_start_density_ = rho_[n - 1];
  inner_start_sound_ = c_[0], outer_start_sound_ = c_[n - 1];
  if (outer_ == Boundary::radiating && dimension_ > 1) flow_ = u_[n];
  fill_new();
  active_ = n;
  update_active();
}

double Lagrangian1D::volume_to(double radius) const {
  if (dimension_ == 1) return radius;
  const double square = radius * radius;
  return area_factor_ / dimension_ * (dimension_ == 2 ? square : square * radius);
}

double Lagrangian1D::mean_area(double from, double to) const {
  if (dimension_ == 1) return 1.0;
  if (dimension_ == 2) return area_factor_ * 0.5 * (from + to);
  return area_factor_ / 3.0 * (from * from + from * to + to * to);
}

double Lagrangian1D::middle(int cell) const {
  if (dimension_ == 1) return 0.5 * (r_[cell] + r_[cell + 1]);
  const double volume = 0.5 * (volume_to(r_[cell]) + volume_to(r_[cell + 1])) * dimension_ / area_factor_;
  return dimension_ == 2 ? std::sqrt(volume) : std::cbrt(volume);
}

double Lagrangian1D::outside_pressure(bool outer, double u, double rho, double sound, double time, double flow) const {
  if ((outer ? outer_ : inner_) == Boundary::free) {
    if (!outer) return options_.inner_pressure;
    return options_.outer_pressure + (options_.outer_load ? options_.outer_load(time) : 0.0);
  }
  if ((outer ? outer_ : inner_) == Boundary::radiating) {
    const double start = outer ? outer_start_density_ * outer_start_sound_ : inner_start_density_ * inner_start_sound_;
    const double impedance = 0.5 * (rho * sound + start);
    return outer ? outer_start_pressure_ + impedance * (u - flow) : inner_start_pressure_ - impedance * u;
  }
  if (outer) return outer_start_pressure_ + rho * sound * (u - outer_start_velocity_);
  return inner_start_pressure_ - rho * sound * (u - inner_start_velocity_);
}

double Lagrangian1D::flow_rate(double r, double u, double rho, double sound, double flow) const {
  if (outer_ != Boundary::radiating || dimension_ == 1) return 0.0;
  const double over = outside_pressure(true, u, rho, sound, time_, flow) - outer_start_pressure_;
  const double enthalpy = 2.0 * over / (rho + outer_start_density_);
  return (dimension_ == 3 ? 1.0 : 0.5) * (enthalpy + 0.5 * u * u - 2.0 * flow * u) / r;
}

void Lagrangian1D::pressures(int begin, int end, double time, const std::vector<double>& r, const std::vector<double>& u,
                             const std::vector<double>& rho, const std::vector<double>& e, std::vector<double>& p,
                             std::vector<double>& q) {
  for (std::size_t k = 0; k < blocks_.size() && blocks_[k].begin < end; ++k) {
    const Block& block = blocks_[k];
    const int start = std::max(block.begin, begin), stop = std::min(block.end, end);
    if (start >= stop) continue;
    if (const auto* solid = std::get_if<Solid>(&layers_[k].law)) {
      solid_pressures(*solid, start, stop, rho, e, p);
      continue;
    }
    const FluidLaw& fluid = std::get<FluidLaw>(layers_[k].law);
    if (const auto& burn = layers_[k].burn) {
      const auto& products = std::get<materials::Jwl>(fluid);
      for (int i = start; i < stop; ++i) {
        // The part that burns by compression is not kept when the zone expands: kept, every oscillation of
        // the unburned charge, however small, would burn some more of it, until it detonates of itself.
        const double burned = burn->fraction(Vec3(start_middle_[i], 0.0, 0.0), time, rho[i] / start_density_[i]);
        const auto state = materials::burning(products, rho[i], e[i], burned);
        p[i] = state.pressure;
        c_[i] = viscous_sound_[i] = state.sound_speed;
      }
      continue;
    }
    std::visit(
        [&](const auto& law) {
          for (int i = start; i < stop; ++i) {
            const materials::PressureSound state = law.evaluate(rho[i], e[i]);
            p[i] = state.pressure;
            c_[i] = std::max(state.sound_speed, block.stiffest_sound);
            // A void that closes meets no resistance but its inertia.
            viscous_sound_[i] = law.void_fraction(rho[i], e[i]) > 0.0 ? 0.0 : c_[i];
          }
        },
        fluid);
  }

  const int n = cells();
  const int with_neighbour = std::min(end + 1, n);
  for (int i = std::max(begin - 1, 0); i < with_neighbour; ++i) slope_[i] = (u[i + 1] - u[i]) / (r[i + 1] - r[i]);
  for (int i = begin; i < end; ++i) {
    const double closing = u[i] - u[i + 1];
    q[i] = 0.0;
    if (!(closing > 0.0)) continue;
    if (mean_area(r[i + 1], r[i + 1]) * u[i + 1] >= mean_area(r[i], r[i]) * u[i]) continue;  // cell grows
    double psi = 0.0;
    if (options_.limiter) {
      const double below = i > 0 ? slope_[i - 1] / slope_[i] : 1.0;
      const double above = i + 1 < n && i != front_cell_ ? slope_[i + 1] / slope_[i] : 1.0;
      psi = std::max(0.0, std::min({0.5 * (below + above), 2.0 * below, 2.0 * above, 1.0}));
    }
    q[i] =
        (1.0 - psi) * rho[i] * closing * (options_.linear_viscosity * viscous_sound_[i] + options_.quadratic_viscosity * closing);
  }
}

void Lagrangian1D::solid_pressures(const Solid& solid, int begin, int end, const std::vector<double>& rho,
                                   const std::vector<double>& e, std::vector<double>& p) {
  for (int i = begin; i < end; ++i) {
    const auto state = materials::evaluate(solid.pressure, solid.rho0, rho[i], e[i]);
    double& damage = solids_new_.damage[i];
    if (materials::spalls(solid, state.pressure)) damage = materials::failed;
    p[i] = materials::carried_pressure(solid, state.pressure, damage);
    c_[i] = std::sqrt(state.bulk_sound * state.bulk_sound + 4.0 / 3.0 * solid.shear_modulus / rho[i]);
    viscous_sound_[i] = damage >= materials::failed && p[i] <= 0.0 ? 0.0 : c_[i];  // as a void that closes
    p[i] += options_.ambient;
  }
}

void Lagrangian1D::deviator_forces(int end, double share, const std::vector<double>& r) {
  for (int i = 0; i < end; ++i) {
    const double s = (1.0 - share) * solids_.deviator[i] + share * solids_new_.deviator[i];
    const double from = 0.5 * (r_[i] + r[i]), to = 0.5 * (r_[i + 1] + r[i + 1]);
    const double work = (volume_to(to) - volume_to(from)) * s, radial = work / (to - from);
    const double across = dimension_ == 1 ? 0.0 : work / (from + to);
    push_in_[i] = across + radial;
    push_out_[i] = across - radial;
  }
}

void Lagrangian1D::advance_deviators(int end, double dt) {
  constexpr int N = materials::points_at_once;
  for (std::size_t k = 0; k < blocks_.size() && blocks_[k].begin < end; ++k) {
    const auto* solid = std::get_if<Solid>(&layers_[k].law);
    if (!solid) continue;
    const int stop = std::min(blocks_[k].end, end);
    for (int begin = blocks_[k].begin; begin < stop; begin += N) {
      materials::SolidPoints points{};
      materials::SolidStep done;
      materials::EightPoints gradient[3][3] = {}, specific_volume, pressure;
      for (int l = 0; l < N; ++l) {
        const int i = std::min(begin + l, stop - 1);  // idle lanes repeat the last cell
        const double from = 0.5 * (r_[i] + r_new_[i]), to = 0.5 * (r_[i + 1] + r_new_[i + 1]);
        const double moved_in = r_new_[i] - r_[i], moved_out = r_new_[i + 1] - r_[i + 1];
        gradient[0][0][l] = (moved_out - moved_in) / (to - from);
        if (dimension_ == 3) gradient[1][1][l] = gradient[2][2][l] = (moved_out + moved_in) / (to + from);
        points.deviator[0][l] = solids_.deviator[i];
        points.deviator[1][l] = points.deviator[2][l] = -0.5 * solids_.deviator[i];
        points.plastic_strain[l] = solids_.plastic_strain[i];
        points.temperature[l] = solids_.temperature[i];
        points.damage[l] = solids_.damage[i];
        specific_volume[l] = 1.0 / rho_new_[i];
        pressure[l] = p_[i];
      }
      materials::advance_deviator(*solid, gradient, specific_volume, pressure, dt, points, done);
      for (int l = 0; l < N && begin + l < stop; ++l) {
        const int i = begin + l;
        solids_new_.deviator[i] = points.deviator[0][l];
        solids_new_.plastic_strain[i] = points.plastic_strain[l];
        solids_new_.temperature[i] = points.temperature[l];
        solids_new_.damage[i] = points.damage[l];
        solids_new_.plastic_energy[i] =
            solids_.plastic_energy[i] + 0.5 * cell_mass_[i] * (1.0 / rho_[i] + 1.0 / rho_new_[i]) * done.plastic_work[l];
      }
    }
  }
}

void Lagrangian1D::warm(int end) {
  for (std::size_t k = 0; k < blocks_.size() && blocks_[k].begin < end; ++k) {
    const auto* solid = std::get_if<Solid>(&layers_[k].law);
    if (!solid) continue;
    for (int i = blocks_[k].begin; i < std::min(blocks_[k].end, end); ++i) {
      const double opened = 1.0 / rho_new_[i] - 1.0 / rho_[i];
      const bool broken = solids_new_.damage[i] >= materials::failed;
      const double p = p_[i] - options_.ambient, p_new = p_new_[i] - options_.ambient;
      const materials::Warming warming =
          materials::warming(*solid, {.before = 1.0 / rho_[i],
                                      .after = 1.0 / rho_new_[i],
                                      .energy = e_[i],
                                      .pressure_work = -0.5 * (p + p_new) * opened,
                                      .dissipated = -0.5 * (q_[i] + q_new_[i]) * opened,
                                      .parted = materials::is_parted(*solid, std::min(p, p_new), broken)});
      solids_new_.temperature[i] = warming(solids_new_.temperature[i]);
    }
  }
}

double Lagrangian1D::stable_step() const {
  const int end = std::min(active_ + 1, cells());
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < end; ++i) {
    const double width = r_[i + 1] - r_[i], change = std::abs(u_[i + 1] - u_[i]);
    // Speed at which the artificial pressure spreads velocity over a cell, per q = rho b |du|.
    const double b = q_[i] > 0.0 ? 2.0 * q_[i] / (rho_[i] * change) : 0.0;
    const double speed = b + std::sqrt(b * b + c_[i] * c_[i]) + 2.0 * change;
    shortest = std::min(shortest, width / speed);
  }
  // Where the pressure jumps, sound says nothing of the step yet: no node may cross a tenth of a cell from
  // rest.
  double stiffest = 0.0;  // acceleration over width [1/s^2]
  for (int i = 0; i < end; ++i) {
    const double total = p_[i] + q_[i];
    const double below = i > 0 ? p_[i - 1] + q_[i - 1]
                               : (inner_ == Boundary::rigid ? total : outside_pressure(false, u_[0], rho_[0], c_[0], time_));
    double width = r_[i + 1] - r_[i];
    if (i > 0) width = std::min(width, r_[i] - r_[i - 1]);
    stiffest = std::max(stiffest, mean_area(r_[i], r_[i]) * std::abs(total - below) / (node_mass_[i] * width));
  }
  if (end == cells() && outer_ != Boundary::rigid) {
    const double above = outside_pressure(true, u_[end], rho_[end - 1], c_[end - 1], time_);
    stiffest = std::max(stiffest, mean_area(r_[end], r_[end]) * std::abs(p_[end - 1] + q_[end - 1] - above) /
                                      (node_mass_[end] * (r_[end] - r_[end - 1])));
  }
  shortest *= options_.courant;
  if (front_is_fitted()) shortest = std::min(shortest, step_to_layers_end());
  if (stiffest > 0.0) shortest = std::min(shortest, std::sqrt(0.2 / stiffest));
  return last_step_ > 0.0 ? std::min(shortest, 1.2 * last_step_) : shortest;
}

void Lagrangian1D::step(double dt) {
  const int n = cells();
  // News goes two nodes on in a step, but no farther than to the layer in which its front will be followed.
  const int followed = next_followed_layer();
  const int held_back = followed == layers() ? n + 1 : blocks_[followed].begin + (still_waits(followed) ? 0 : 1);
  const int cell_end = front_is_fitted() ? front_cell_ + 1 : std::min({active_ + 2, n, held_back});
  const int node_end = front_is_fitted() ? cell_end + 1 : std::min(cell_end + 1, held_back);
  const bool held_inner = inner_ == Boundary::rigid, held_outer = outer_ == Boundary::rigid;
  const bool solid = !solids_.deviator.empty();

  // Total pressures at the two ends outside of the mesh, at the start of the step.
  double below = held_inner ? 0.0 : outside_pressure(false, u_[0], rho_[0], c_[0], time_);
  double above = held_outer ? 0.0 : outside_pressure(true, u_[n], rho_[n - 1], c_[n - 1], time_);
  const auto accelerate = [&](const auto& total, double front_speed) {
    for (int i = 0; i < node_end; ++i) {
      const double inside = i > 0 ? total(i - 1) : below, outside = i < n ? total(i) : above;
      u_new_[i] = u_[i] + dt / node_mass_[i] * area_[i] * (inside - outside);
    }
    if (solid)
      for (int i = 0; i < node_end; ++i)
        u_new_[i] += dt / node_mass_[i] * ((i > 0 ? push_out_[i - 1] : 0.0) + (i < n ? push_in_[i] : 0.0));
    if (options_.gravity != 0.0)
      for (int i = 0; i < node_end; ++i) u_new_[i] += dt * options_.gravity;
    if (held_inner) u_new_[0] = 0.0;
    if (held_outer && node_end > n) u_new_[n] = 0.0;
    if (front_is_fitted()) move_front(dt, front_speed, total(front_cell_));
    const int moved = front_is_fitted() ? front_cell_ + 1 : node_end;
    for (int i = 0; i < moved; ++i) r_new_[i] = r_[i] + 0.5 * dt * (u_[i] + u_new_[i]);
  };
  const auto compress = [&](const auto& total) {
    double swept = area_[0] * (0.5 * dt * (u_[0] + u_new_[0]));
    const int whole = front_is_fitted() ? front_cell_ : cell_end;
    for (int i = 0; i < whole; ++i) {
      const double next = area_[i + 1] * (0.5 * dt * (u_[i + 1] + u_new_[i + 1]));
      e_new_[i] = e_[i] - total(i) * (next - swept) / cell_mass_[i];
      swept = next;
      // V = V_start and so rho = rho_start, to the bit, where nothing has moved.
      const double volume = volume_to(r_new_[i + 1]) - volume_to(r_new_[i]);
      rho_new_[i] = start_density_[i] * (start_volume_[i] / volume);
    }
    if (front_is_fitted()) fill_front_cell(dt, total(front_cell_));
    if (solid)
      for (int i = 0; i < cell_end; ++i)
        e_new_[i] -= 0.5 * dt / cell_mass_[i] * (push_in_[i] * (u_[i] + u_new_[i]) + push_out_[i] * (u_[i + 1] + u_new_[i + 1]));
  };

  for (int i = 0; i < node_end; ++i) area_[i] = mean_area(r_[i], r_[i]);
  const auto total_old = [&](int i) { return p_[i] + q_[i]; };
  if (solid) deviator_forces(cell_end, 0.0, r_);
  accelerate(total_old, front_.speed);
  compress(total_old);
  const auto healthy = [&] {
    for (int i = 0; i < cell_end; ++i)
      if (!(rho_new_[i] > 0.0 && std::isfinite(rho_new_[i]) && std::isfinite(e_new_[i])))
        throw NumericalStop(text("one-dimensional solver, step ", steps_, ", t = ", time_, " s: cell ", i, " of layer ",
                                 cell_layer_[i], " near r = ", r_[i], " m has density ", rho_new_[i], " kg/m^3 and energy ",
                                 e_new_[i], " J/kg; dt = ", dt, " s"));
  };
  healthy();
  if (solid) advance_deviators(cell_end, dt);
  pressures(0, cell_end, time_ + dt, r_new_, u_new_, rho_new_, e_new_, p_new_, q_new_);

  const double flow_rise = dt * flow_rate(r_[n], u_[n], rho_[n - 1], c_[n - 1], flow_), ahead = flow_ + flow_rise;
  if (!held_inner) below = 0.5 * (below + outside_pressure(false, u_new_[0], rho_new_[0], c_[0], time_ + dt, 0.0));
  if (!held_outer) above = 0.5 * (above + outside_pressure(true, u_new_[n], rho_new_[n - 1], c_[n - 1], time_ + dt, ahead));
  for (int i = 0; i < node_end; ++i) area_[i] = mean_area(r_[i], r_new_[i]);
  const auto total_mean = [&](int i) { return 0.5 * (p_[i] + q_[i] + p_new_[i] + q_new_[i]); };
  if (solid) deviator_forces(cell_end, 0.5, r_new_);
  accelerate(total_mean, front_is_fitted() ? 0.5 * (front_.speed + front_at(u_new_[front_cell_ + 1]).speed) : 0.0);
  compress(total_mean);
  healthy();
  if (outer_ == Boundary::radiating)
    flow_ += 0.5 * (flow_rise + dt * flow_rate(r_new_[n], u_new_[n], rho_new_[n - 1], c_[n - 1], ahead));
  if (!held_inner) boundary_work_ -= below * area_[0] * (0.5 * dt * (u_[0] + u_new_[0]));
  if (!held_outer && node_end > n) boundary_work_ += above * area_[n] * (0.5 * dt * (u_[n] + u_new_[n]));
  if (options_.gravity != 0.0)
    for (int i = 0; i < node_end; ++i) {
      const double work = node_mass_[i] * options_.gravity * (0.5 * dt * (u_[i] + u_new_[i]));
      boundary_work_ -= work;
      gravity_work_ += work;
    }
  if (solid) {
    advance_deviators(cell_end, dt);
    warm(cell_end);
  }
  if (front_is_fitted()) keep_front_cell();
  pressures(0, cell_end, time_ + dt, r_new_, u_new_, rho_new_, e_new_, p_new_, q_new_);

  std::swap(solids_, solids_new_);
  std::swap(r_, r_new_);
  std::swap(u_, u_new_);
  std::swap(rho_, rho_new_);
  std::swap(e_, e_new_);
  std::swap(p_, p_new_);
  std::swap(q_, q_new_);
  time_ += dt;
  ++steps_;
  if (front_is_fitted()) tend_front();
  if (!front_is_fitted()) update_active();
}

std::vector<std::vector<double>*> Lagrangian1D::cell_arrays() {
  std::vector<std::vector<double>*> all{
      &cell_mass_, &start_volume_,  &start_density_, &start_middle_, &e_,     &rho_,   &p_,    &q_,
      &c_,         &viscous_sound_, &slope_,         &rho_new_,      &e_new_, &p_new_, &q_new_};
  if (solids_.deviator.empty()) return all;
  for (auto* of : {&solids_, &solids_new_})
    of->for_each([&](const char*, std::vector<double>& values) { all.push_back(&values); });
  all.insert(all.end(), {&push_in_, &push_out_});
  return all;
}

std::vector<std::vector<double>*> Lagrangian1D::node_arrays() { return {&r_, &u_, &node_mass_, &area_, &r_new_, &u_new_}; }

void Lagrangian1D::fill_new() {
  r_new_ = r_;
  u_new_ = u_;
  rho_new_ = rho_;
  e_new_ = e_;
  p_new_ = p_;
  q_new_ = q_;
  solids_new_ = solids_;
}

void Lagrangian1D::update_active() {
  const int n = cells();
  int least = 0;  // cells that are going to burn may light before anything reaches them
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    if (const auto& burn = layers_[k].burn)
      for (const int cell : {blocks_[k].begin, blocks_[k].end - 1})
        if (burn->fraction(Vec3(start_middle_[cell], 0.0, 0.0), time_, 1.0) < 1.0) least = blocks_[k].end;
  if (options_.gravity != 0.0) least = n;
  // Grown by two nodes a step at most: predictor and corrector each carry the news one node further.
  int node = steps_ == 0 ? n : std::min(active_ + 2, n);
  for (; node > least; --node) {
    if (u_[node] != 0.0) break;
    if (node == n) {
      if (outer_ == Boundary::rigid) continue;
      const double over = p_[n - 1] + q_[n - 1] - outside_pressure(true, u_[n], rho_[n - 1], c_[n - 1], time_);
      if (options_.front_width ? std::abs(over) > options_.held_pressure : over != 0.0) break;
    } else if (node > 0) {
      const double inside = p_[node - 1] + q_[node - 1], outside = p_[node] + q_[node];
      const bool contact = options_.front_width && cell_layer_[node - 1] != cell_layer_[node];
      if (contact ? std::abs(inside - outside) > options_.held_pressure : inside != outside) break;
    }
  }
  // Never smaller again: what lies beyond it has never been stepped, and is the same in state and scratch.
  active_ = steps_ == 0 ? node : std::max(active_, node);
  start_following();
}

void Lagrangian1D::advance(double t_end) {
  while (time_ < t_end) step_towards(t_end);
}

double Lagrangian1D::step_towards(double t_end) {
  double dt = stable_step();
  const double left = t_end - time_;
  // Two even steps rather than a full and a minute one.
  const bool last = left <= dt * (1.0 + 1e-10);
  if (last) {
    dt = left;
  } else {
    if (left < 2.0 * dt) dt = 0.5 * left;
    last_step_ = dt;
  }
  if (!(dt > 0.0) || (!last && time_ + dt == time_))
    throw NumericalStop(
        text("one-dimensional solver, step ", steps_, ", t = ", time_, " s: the stable step has fallen to ", dt, " s"));
  step(dt);
  if (last) time_ = t_end;
  return dt;
}

void Lagrangian1D::visit_state(StateVisitor& state) {
  state("time", time_);
  state("last step", last_step_);
  state("boundary work", boundary_work_);
  state("gravity work", gravity_work_);
  state("flow", flow_);
  state("steps", steps_);
  state("active", active_);
  state("front cell", front_cell_);
  state("front speed", front_.speed);
  state("front pressure", front_.pressure);
  state("front density", front_.density);
  state("front energy", front_.energy);
  state("layer", cell_layer_);
  std::vector<char> burns;
  for (const Layer& layer : layers_) burns.push_back(layer.burn.has_value());
  state("burns", burns);
  for (std::size_t k = 0; k < layers_.size(); ++k)
    if (!burns[k]) layers_[k].burn.reset();
  for (auto& [name, field] : {std::pair{"radius", &r_},
                              {"velocity", &u_},
                              {"energy", &e_},
                              {"mass", &cell_mass_},
                              {"node mass", &node_mass_},
                              {"start volume", &start_volume_},
                              {"start density", &start_density_},
                              {"start middle", &start_middle_},
                              {"density", &rho_},
                              {"pressure", &p_},
                              {"viscous pressure", &q_},
                              {"sound speed", &c_},
                              {"viscous sound speed", &viscous_sound_},
                              {"velocity gradient", &slope_}})
    state(name, *field);
  if (!solids_.deviator.empty()) solids_.for_each([&](const char* name, std::vector<double>& values) { state(name, values); });
  if (!state.restores()) return;
  const auto first_of = [&](int layer) {
    return static_cast<int>(std::lower_bound(cell_layer_.begin(), cell_layer_.end(), layer) - cell_layer_.begin());
  };
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    blocks_[k].begin = first_of(static_cast<int>(k));
    blocks_[k].end = first_of(static_cast<int>(k) + 1);
  }
  area_.assign(r_.size(), 0.0);
  push_in_.resize(solids_.deviator.size());
  push_out_.resize(solids_.deviator.size());
  fill_new();
}

void Lagrangian1D::end_burns() {
  for (int k = 0; k < layers(); ++k)
    if (layers_[k].burn && !still_burns(k)) layers_[k].burn.reset();
}

bool Lagrangian1D::still_burns(int layer) const {
  const auto& burn = layers_[layer].burn;
  if (!burn) return false;
  const Block& block = blocks_[layer];
  return std::min(burn->fraction(Vec3(start_middle_[block.begin], 0.0, 0.0), time_, 1.0),
                  burn->fraction(Vec3(start_middle_[block.end - 1], 0.0, 0.0), time_, 1.0)) < 1.0;
}

double Lagrangian1D::interface_radius(int layer) const { return r_.at(blocks_.at(layer).end); }

double Lagrangian1D::kinetic_energy() const {
  double sum = 0.0;
  for (int i = 0; i <= cells(); ++i) sum += 0.5 * node_mass_[i] * u_[i] * u_[i];
  return sum;
}

double Lagrangian1D::internal_energy() const {
  double sum = 0.0;
  for (int i = 0; i < cells(); ++i) sum += cell_mass_[i] * e_[i];
  return sum;
}

double Lagrangian1D::barotropic_heat() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const auto* fluid = std::get_if<FluidLaw>(&layers_[k].law);
    if (!fluid) continue;
    std::visit(
        [&](const auto& law) {
          if constexpr (!std::remove_cvref_t<decltype(law)>::uses_energy)
            for (int i = blocks_[k].begin; i < std::min(blocks_[k].end, active_ + 2); ++i)  // none beyond
              sum += cell_mass_[i] * (e_[i] - law.barotropic_energy(rho_[i]));
        },
        *fluid);
  }
  return sum;
}

PointState Lagrangian1D::at(double radius) const {
  if (!(radius >= r_.front() && radius <= r_.back()))
    throw std::out_of_range(
        text("Lagrangian1D::at: ", radius, " m lies outside of the mesh, ", r_.front(), " to ", r_.back(), " m"));
  const int above = static_cast<int>(std::upper_bound(r_.begin(), r_.end(), radius) - r_.begin());
  const bool at_front = front_is_fitted() && radius == front_radius();
  const int cell = at_front ? front_cell_ : std::clamp(above - 1, 0, cells() - 1);
  const double share = (radius - r_[cell]) / (r_[cell + 1] - r_[cell]);
  const double centre = 0.5 * (r_[cell] + r_[cell + 1]);
  if (front_is_fitted() && cell == front_cell_ + 1) return {rho_[cell], 0.0, e_[cell], p_[cell], cell_layer_[cell]};
  if (cell == front_cell_ && radius > centre) {
    const double weight = (radius - centre) / (r_[cell + 1] - centre);
    const auto to_front = [&](double value, double front) { return value + weight * (front - value); };
    return {to_front(rho_[cell], front_.density), u_[cell] + share * (u_[cell + 1] - u_[cell]), to_front(e_[cell], front_.energy),
            to_front(p_[cell], front_.pressure), cell_layer_[cell]};
  }
  int other = radius < centre ? cell - 1 : cell + 1;
  if (other < 0 || other >= cells() || cell_layer_[other] != cell_layer_[cell]) other = cell;
  const double other_centre = 0.5 * (r_[other] + r_[other + 1]);
  const double weight = other == cell ? 0.0 : (radius - centre) / (other_centre - centre);
  const auto between = [&](const std::vector<double>& f) { return f[cell] + weight * (f[other] - f[cell]); };
  return {between(rho_), u_[cell] + share * (u_[cell + 1] - u_[cell]), between(e_), between(p_), cell_layer_[cell]};
}

IntervalIntegral Lagrangian1D::integral(double from, double to, int layer) const {
  IntervalIntegral sum;
  if (!(to > from) || to <= r_.front() || from >= r_.back()) return sum;
  const int first = std::clamp(static_cast<int>(std::upper_bound(r_.begin(), r_.end(), from) - r_.begin()) - 1, 0, cells() - 1);
  for (int i = first; i < cells() && r_[i] < to; ++i) {
    if (layer >= 0 && cell_layer_[i] != layer) continue;
    const double cell_volume = volume_to(r_[i + 1]) - volume_to(r_[i]);
    const bool whole = from <= r_[i] && to >= r_[i + 1];
    const double cut = whole ? 0.0 : middle(i);
    for (const int half : {0, 1}) {
      double volume = 0.5 * cell_volume;
      if (!whole) {
        const double begin = std::max(from, half == 0 ? r_[i] : cut);
        const double end = std::min(to, half == 0 ? cut : r_[i + 1]);
        if (!(end > begin)) continue;
        volume = volume_to(end) - volume_to(begin);
      }
      const double mass = cell_mass_[i] * (volume / cell_volume), speed = half == 0 ? inner_velocity(i) : u_[i + 1];
      sum.volume += volume;
      sum.mass += mass;
      sum.momentum += mass * speed;
      sum.kinetic_energy += 0.5 * mass * speed * speed;
      sum.internal_energy += mass * e_[i];
      sum.pressure_volume += volume * p_[i];
    }
  }
  return sum;
}

double Lagrangian1D::front(double share, double limit) const {
  int i = static_cast<int>(std::lower_bound(r_.begin(), r_.begin() + std::min(active_, cells()), limit) - r_.begin()) - 1;
  while (i >= 0 && std::abs(rho_[i] / start_density_[i] - 1.0) <= share) --i;
  return r_[i + 1];
}

double Lagrangian1D::shock_front(double threshold) const {
  const double limit = outer_start_pressure_ + threshold;
  for (int i = cells() - 1; i >= 0; --i) {
    if (!(p_[i] > limit)) continue;
    const double centre = 0.5 * (r_[i] + r_[i + 1]);
    if (i + 1 == cells()) return r_[i + 1];
    const double next = 0.5 * (r_[i + 1] + r_[i + 2]);
    return centre + (next - centre) * (p_[i] - limit) / (p_[i] - p_[i + 1]);
  }
  return r_.front();
}

}  // namespace undex::exact
