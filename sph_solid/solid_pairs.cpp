#include "sph_solid/solid_pairs.hpp"

#include <Eigen/LU>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "sph_fluid/pairs/kernels.hpp"

namespace undex::solid {

using namespace sph;  // pairs, cells and kernels
namespace {

/// Bodies feel each other when their outer particles are a spacing and a half apart, half a spacing before they touch.
constexpr double contact_reach = 1.5;
double contact_h(const SolidPairs::Range& range) { return contact_reach / WendlandC2::support * range.spacing; }
/// Share of the acoustic impedance by which contact is damped: enough to take the chatter out of it.
constexpr double contact_damping = 0.3;

}  // namespace

SolidPairs::SolidPairs(const Settings& settings, const sph::Settings& around, std::vector<Range> ranges)
    : settings_(settings),
      around_(around),
      ranges_(std::move(ranges)),
      cells_(ranges_.size()),
      memory_(std::max(omp_get_max_threads(), around.numerics.threads)) {
  const std::uint32_t n = ranges_.back().end;
  for (const Range& range : ranges_) updated_ = updated_ || range.updated;
  particle_.resize(n);
  for (auto* axis : {&x_, &y_, &z_}) axis->resize(n);
  rows_.resize(n);
  solid_.resize(n);
  if (updated_) deformation_.resize(n);
  sums_.resize(n);
  if (updated_ && around.axisymmetric) axis_width_ = width_of_axis(settings.numerics.eta);
}

void SolidPairs::run(void (*pass)(const PairInput&, const PairOutput&), const PairInput& in) {
  pass(in, {sums_.data(), nullptr, image_sums_.data(), interactions_.data()});
}

void SolidPairs::add_forces(SolidParticles& particles, const std::vector<Vec3>& acceleration, double dt) {
  pack(particles);
  find_images(particles);
  fill_image_rows();
  const PairInput in = input(views_);
  const bool contact = ranges_.size() > 1;
  if (updated_) run(loops_.deformation, in);
  std::fill(sums_.begin(), sums_.end(), SumRow{});
  if (contact) {
    run(loops_.contact_overlap, input(contact_views_));
    find_contact(particles, dt > 0.0);
  }
  if (updated_) update_stresses(particles, dt);
  fill_rows(particles, acceleration, dt);
  fill_image_rows();
  std::fill(sums_.begin(), sums_.end(), SumRow{});
  if (updated_) run(loops_.forces, in);
  scatter_images();
  if (contact) run(loops_.contact_forces, input(contact_views_));
  write_back(particles);
}

/// The contact pressure of the present overlap. Bodies that touch at the start do so without pressure.
void SolidPairs::find_contact(SolidParticles& p, bool started) {
  for (const Range& range : ranges_) {
    const double modulus = materials::bulk_modulus(range.body->material) + 4.0 / 3.0 * range.body->material.shear_modulus;
#pragma omp parallel for schedule(static)
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const std::uint32_t i = particle_[k];
      const double overlap = sums_[k].compression;
      p.contact_reference[i] = started ? std::min(p.contact_reference[i], overlap) : overlap;
      p.contact_pressure[i] = modulus * (overlap - p.contact_reference[i]);
    }
  }
}

/// Sorts each body's particles by cell; the velocities of the rows are those of the half step, as the deformation wants.
void SolidPairs::pack(const SolidParticles& p) {
  const std::uint32_t n = std::uint32_t(p.size());
#pragma omp parallel for schedule(static)
  for (std::uint32_t i = 0; i < n; ++i) {
    x_[i] = p.x[i][0];
    y_[i] = p.x[i][1];
    z_[i] = p.x[i][2];
  }
  views_.clear();
  contact_views_.clear();
  double reach = 0;
  for (std::size_t g = 0; g < ranges_.size(); ++g) {
    const Range& range = ranges_[g];
    try {
      cells_[g].build(x_.data(), y_.data(), z_.data(), range.begin, range.end, 2.0 * range.spacing);
    } catch (const std::domain_error&) {
      throw NumericalStop("solid '" + range.body->name +
                          "': a particle's position is not finite; a smaller "
                          "solid_scheme.courant may help");
    }
    const std::vector<std::uint32_t>& order = cells_[g].order();
    std::copy(order.begin(), order.end(), particle_.begin() + range.begin);
    GroupView view{range.begin, range.end, cells_[g].view(), range.h, false, false, 0};
    view.own_pairs = range.updated;
    views_.push_back(view);
    view.h_max = contact_h(range);
    contact_views_.push_back(view);
    reach = std::max(reach, WendlandC2::support * range.h);
  }
#pragma omp parallel for schedule(static)
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t i = particle_[k];
    x_[k] = p.x[i][0];
    y_[k] = p.x[i][1];
    z_[k] = p.x[i][2];
    rows_[k] = {p.v[i][0], p.v[i][1], p.v[i][2], p.pressure[i], p.mass[i] / p.rho[i], p.rho[i], p.sound[i], 0.0};
  }
  for (const Range& range : ranges_)
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      FluidRow& row = rows_[k];
      row.h = contact_h(range);
      if (!around_.axisymmetric) continue;
      row.volume = p.mass[particle_[k]] / (p.rho[particle_[k]] * ring(p, range, particle_[k]));
      row.vz = x_[k];
    }
  blocks_.build(views_, reach, omp_get_max_threads());
  interactions_.assign(blocks_.block_count(), 0);
}

/// The images of the updated bodies' particles in the rigid planes that back them, and where planes meet, images of images.
void SolidPairs::find_images(const SolidParticles& p) {
  images_.clear();
  views_.resize(ranges_.size());  // those of the particles
  if (settings_.planes.empty() || !updated_) return;
  std::vector<PlaneSet> backed = p.touching;
  image_cells_.resize(ranges_.size());
  image_place_.resize(3);
  for (std::size_t g = 0; g < ranges_.size(); ++g) {
    const Range& range = ranges_[g];
    if (!range.updated) continue;
    const double reach = WendlandC2::support * range.h;
    add_upper_layers(settings_.planes, p.x, p.touching, range.begin, range.end, range.spacing, reach, backed);
    std::vector<Image> found;
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const PlaneSet planes = backed[particle_[k]];
      if (planes == 0) continue;
      const std::size_t mark = found.size();
      for (std::size_t plane = 0; plane < settings_.planes.size(); ++plane) {
        const int a = settings_.planes[plane].axis;
        if (!(planes >> plane & 1) || !(height(settings_.planes[plane], p.x[particle_[k]]) < reach)) continue;
        const std::size_t count = found.size();
        const auto mirror = [&](Image image) {
          image.axes |= 1u << a;
          image.place[a] = 2.0 * settings_.planes[plane].position - image.place[a];
          found.push_back(image);
        };
        for (std::size_t m = mark; m < count; ++m)
          if (!(found[m].axes >> a & 1)) mirror(found[m]);
        mirror({k, 0, p.x[particle_[k]]});
      }
    }
    if (found.empty()) continue;
    const std::uint32_t begin = std::uint32_t(images_.size()), end = begin + std::uint32_t(found.size());
    std::vector<double> place[3];
    for (int a = 0; a < 3; ++a) {
      place[a].resize(end);
      image_place_[a].resize(end);
      for (std::uint32_t m = begin; m < end; ++m) place[a][m] = found[m - begin].place[a];
    }
    image_cells_[g].build(place[0].data(), place[1].data(), place[2].data(), begin, end, 2.0 * range.spacing);
    for (std::uint32_t m = begin; m < end; ++m) {
      images_.push_back(found[image_cells_[g].order()[m - begin] - begin]);
      for (int a = 0; a < 3; ++a) image_place_[a][m] = images_[m].place[a];
    }
    GroupView view = views_[g];
    view.begin = begin;
    view.end = end;
    view.grid = image_cells_[g].view();
    view.images_of = int(g);
    views_.push_back(view);
  }
}

void SolidPairs::fill_image_rows() {
  image_rows_.resize(images_.size());
  image_solid_.resize(images_.size());
  image_sums_.assign(images_.size(), SumRow{});
  const auto mirror = []<class Row>(const Row& row, unsigned axes, Row& image) {
    image = row;
    auto* number = reinterpret_cast<double*>(&image);
    for (int k = 0; k < length_of<Row>; ++k)
      if (__builtin_popcount(unsigned(Row::parity(k)) & axes) & 1) number[k] = -number[k];
  };
#pragma omp parallel for schedule(static)
  for (std::uint32_t m = 0; m < images_.size(); ++m) {
    mirror(rows_[images_[m].row], images_[m].axes, image_rows_[m]);
    mirror(solid_[images_[m].row], images_[m].axes, image_solid_[m]);
  }
}

void SolidPairs::scatter_images() {
  for (std::uint32_t m = 0; m < images_.size(); ++m) {
    const SumRow& given = image_sums_[m];
    const auto sign = [&](int axis) { return images_[m].axes >> axis & 1 ? -1.0 : 1.0; };
    SumRow& to = sums_[images_[m].row];
    to.fx += sign(0) * given.fx, to.fy += sign(1) * given.fy, to.fz += sign(2) * given.fz;
    to.heat += given.heat;
    to.closing = std::max(to.closing, given.closing);
  }
}

PairInput SolidPairs::input(const std::vector<GroupView>& views) {
  PairInput in{};
  in.dimension = around_.dimension;
  in.kernel_scale = 1.0;
  in.x = x_.data();
  in.y = y_.data();
  in.z = z_.data();
  in.fluid = rows_.data();
  in.second = solid_.data();
  in.deformation = deformation_.data();
  in.artificial_stress = settings_.numerics.artificial_stress;
  in.spacing = ranges_[0].spacing;
  if (!images_.empty())
    in.images = {image_place_[0].data(), image_place_[1].data(), image_place_[2].data(),
                 image_rows_.data(),     image_solid_.data(),    nullptr};
  in.groups = views.data();
  in.group_count = int(views.size());
  in.contact_damping = contact_damping;
  for (int a = 0; a < 3; ++a) in.mirror[a] = around_.symmetry.axis[a];
  in.alpha = settings_.numerics.alpha;
  in.beta = settings_.numerics.beta;
  blocks_.describe(in);
  memory_.describe(in);
  return in;
}

/// The displacement of the step is dt times the half step's velocity, and its gradient with respect to the new positions is
/// G: then F = (I - G)^-1 is the deformation of the step, exactly, however far it turned.
void SolidPairs::update_stresses(SolidParticles& p, double dt) {
  constexpr std::uint32_t batch = materials::points_at_once;
  for (const Range& range : ranges_) {
    if (!range.updated) continue;
    const BulkViscosity viscosity{settings_.numerics.linear_viscosity, settings_.numerics.quadratic_viscosity, range.spacing};
#pragma omp parallel for schedule(static)
    for (std::uint32_t first = range.begin; first < range.end; first += batch) {
      const std::uint32_t last = std::min(range.end, first + batch);
      Deformation step;
      for (std::uint32_t k = first; k < last; ++k) {
        if (around_.axisymmetric) add_hoop_strain(p, range, k);
        const DeformationRow& row = deformation_[k];
        const std::uint32_t i = particle_[k];
        if (dt <= 0.0) continue;
        Mat3 back;  // I - G
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) back(a, b) = (a == b) - dt * row.gradient[3 * a + b];
        // A step that would compress to nothing is not one that a stable step allows; the stop names it.
        const double shrink = std::max(back.determinant(), 1e-3);
        step.append(i, back, Mat3::Identity(), p.rho[i] * shrink);
      }
      if (dt > 0.0) update_stress(range.body->material, viscosity, step, dt, p);
    }
  }
}

void SolidPairs::fill_rows(const SolidParticles& p, const std::vector<Vec3>& acceleration, double dt) {
  for (const Range& range : ranges_)
#pragma omp parallel for schedule(static)
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const std::uint32_t i = particle_[k];
      FluidRow& row = rows_[k];
      const Vec3 v = p.v[i] + 0.5 * dt * acceleration[i];
      row.vx = v[0], row.vy = v[1];
      if (!around_.axisymmetric) row.vz = v[2];
      Mat3 sigma = p.stress(i);
      sigma.diagonal().array() -= p.viscous_pressure[i];
      SolidRow& solid = solid_[k];
      if (range.updated) {
        // Volumes stay those of the pass that found B: the power of the forces is then exactly that of the stresses.
        const double* B = deformation_[k].correction;
        Mat3 correction, paired = sigma;
        correction << B[0], B[3], B[5], B[3], B[1], B[4], B[5], B[4], B[2];
        double swollen = p.mass[i] / (p.rho[i] * row.volume);
        if (around_.axisymmetric) {
          paired(0, 0) += (1.0 - own_hoop(p, range, i)) * hoop_stress(sigma, k);
          swollen /= 2.0 * std::numbers::pi;  // a ring's length over 2 pi: B comes without it
        }
        const Mat3 corrected = swollen * paired * correction;
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) solid.corrected[3 * a + b] = corrected(a, b);
        const double* g = deformation_[k].gradient;
        for (int a = 0; a < 3; ++a) {
          const int b = (a + 1) % 3, c = (a + 2) % 3;
          solid.strain[a] = g[4 * a];
          solid.strain[3 + a] = 0.5 * (g[3 * b + c] + g[3 * c + b]);
        }
      } else {
        row.volume = p.mass[i] / (p.rho[i] * ring(p, range, i));
      }
      const double length = around_.axisymmetric && range.updated ? p.mass[i] / (p.rho[i] * row.volume) : ring(p, range, i);
      row.p = length * p.contact_pressure[i];
      row.rho = p.rho[i];
      row.c = length * p.sound[i];
      solid.stress[0] = sigma(0, 0), solid.stress[1] = sigma(1, 1), solid.stress[2] = sigma(2, 2);
      solid.shear_sound = std::sqrt(range.body->material.shear_modulus / p.rho[i]);
      solid.stress[3] = sigma(1, 2), solid.stress[4] = sigma(2, 0), solid.stress[5] = sigma(0, 1);
    }
}

void SolidPairs::write_back(SolidParticles& p) const {
  const Numerics& numerics = settings_.numerics;
  for (const Range& range : ranges_)
#pragma omp parallel for schedule(static)
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const std::uint32_t i = particle_[k];
      const SumRow& sum = sums_[k];
      const double shear_sound = solid_[k].shear_sound;
      p.force[i] += rows_[k].volume * Vec3(sum.fx, sum.fy, sum.fz);
      if (around_.axisymmetric && range.updated) add_hoop_forces(p, range, k);
      const double heat = rows_[k].volume * sum.heat / p.mass[i];
      p.heat[i] = range.updated ? heat : p.heat[i] + heat;
      const double rate = (p.sound[i] + 0.6 * (numerics.alpha * shear_sound + numerics.beta * sum.closing)) / range.spacing;
      // The present's pairs take shorter steps than the start's: an impact at 6 km/s breaks at 0.5 of what a bar bears.
      p.rate[i] = range.updated ? 1.4 * rate : std::max(p.rate[i], (p.sound[i] + sum.closing) / range.spacing);
    }
}

std::size_t SolidPairs::memory_bytes() const {
  std::size_t bytes =
      rows_.size() * (sizeof(std::uint32_t) + 3 * sizeof(double) + sizeof(FluidRow) + sizeof(SolidRow) + sizeof(SumRow)) +
      deformation_.size() * sizeof(DeformationRow) + blocks_.memory_bytes() + memory_.memory_bytes();
  for (const CellList& cells : cells_) bytes += cells.memory_bytes();
  return bytes;
}

}  // namespace undex::solid
