#include "sph_fluid/water/settle.hpp"

#include <algorithm>
#include <cmath>

#include "core/descent.hpp"
#include "core/newton_krylov.hpp"

namespace undex::sph {
namespace {

constexpr double pressure = 1e6;   // [Pa], any
constexpr int patience = 40;       // steps for the next tenth
constexpr double farthest = 0.15;  // that a step takes a particle, in spacings
constexpr int further = 150;       // steps on from where Newton's method ends short of the goal
constexpr int barren = 3;          // rounds of both for the next tenth
constexpr double most_work = 1e8;  // updates of a particle, beyond which descents are all there is

double norm(const std::vector<Vec3>& vectors) {
  double sum = 0;
  for (const Vec3& one : vectors) sum += one.squaredNorm();
  return std::sqrt(sum);
}
double longest(const std::vector<Vec3>& vectors) {
  double most = 0;
  for (const Vec3& one : vectors) most = std::max(most, one.norm());
  return most;
}

/// Places of particles, images and dummies by cells.
class Neighbours {
 public:
  /// Particles of the group `owner`; others have -1.
  void add(const double* x, const double* y, const double* z, std::size_t count, int owner) {
    for (int a = 0; a < 3; ++a) {
      const double* from = a == 0 ? x : a == 1 ? y : z;
      place_[a].insert(place_[a].end(), from, from + count);
    }
    owner_.resize(owner_.size() + count, owner);
  }
  void sort(double width) {
    if (!owner_.empty())
      cells_.build(place_[0].data(), place_[1].data(), place_[2].data(), 0, std::uint32_t(owner_.size()), width);
  }
  /// Is there one within `radius` of x [m] whose owner is wanted?
  template <class Wanted>
  bool any(const Vec3& x, double radius, Wanted wanted) const {
    if (owner_.empty()) return false;
    bool found = false;
    const Vec3 low = x - Vec3::Constant(radius), high = x + Vec3::Constant(radius);
    for_each_in_cells(cells_.view(), low.data(), high.data(), [&](std::uint32_t s) {
      const std::uint32_t k = cells_.order()[s];
      const Vec3 other(place_[0][k], place_[1][k], place_[2][k]);
      found = found || ((other - x).squaredNorm() < radius * radius && wanted(owner_[k]));
    });
    return found;
  }
  bool any(const Vec3& x, double radius) const {
    return any(x, radius, [](int) { return true; });
  }

 private:
  std::vector<double> place_[3];
  std::vector<int> owner_;
  CellList cells_;
};

class Settler {
 public:
  Settler(Water& water, std::vector<BodyParticles>& bodies, double goal, const SettleNews& news)
      : water_(water), set_(water.all), bodies_(bodies), news_(news), aim_(goal) {
    if (water.settings.axisymmetric) aim_finely();
    else goal_ = std::max(goal, descended_residual), rest_ = std::max(goal, rest_residual);
  }

  Settled run() {
    lay();
    evaluate();
    if (const std::vector<std::uint32_t> all = uneasy(); !all.empty()) find_who_stays(all);
    std::vector<std::uint32_t> more = uneasy();
    if (more.empty()) return {};
    for (double margin = set_.reach; !more.empty() && margin < 100.0 * set_.reach; margin *= 2.0) {
      choose_movers(more, margin);
      settle();
      water_.evaluation.signals().expect_everywhere();
      evaluate();
      more = uneasy();  // neighbours of those that have moved, too
      std::erase_if(more, [&](std::uint32_t i) { return moves_[set_.particles.id[i]]; });
    }
    take_places();
    return {.moved = true, .residual = residual()};
  }

 private:
  struct Mover {
    std::uint32_t id;
    int body;
  };

  /// The bodies' particles, of one liquid under one pressure.
  void lay() {
    const bool even = are_under_one_pressure();
    const materials::Fluid liquid = *materials::find_fluid("water-tait");
    density_ = materials::density_at(liquid.law, pressure, 0.0);
    Settings& settings = water_.settings;
    settings.gravity.setZero();
    settings.surroundings = {};
    std::size_t count = 0;
    for (const BodyParticles& body : bodies_) count += body.position.size();
    set_ = ParticleSet{};
    set_.wall_force = water_.walls.unloaded();
    Particles& p = set_.particles;
    p.resize(count, false);
    std::uint32_t at = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      Body& body = settings.bodies[b];
      body.material = liquid;
      body.burn.reset();
      body.variable_h = false;
      Group& group = set_.groups.emplace_back();
      group.body = &body;
      group.begin = group.first_id = at;
      group.spacing = body.spacing.value_or(settings.lattice.spacing);
      group.h0 = group.h_max = smoothing_length(settings, group.spacing);
      group.rest_density = density_;
      // Where bodies drive each other apart anyway their surfaces stay as the lattice has them, with the volumes of its cells.
      const double scale = even ? 1.0 : bodies_[b].scale;
      for (std::size_t k = 0; k < bodies_[b].position.size(); ++k, ++at) {
        const Vec3& x = bodies_[b].position[k];
        p.id[at] = at;
        p.x[at] = x[0], p.y[at] = x[1], p.z[at] = x[2];
        p.mass[at] = density_ * bodies_[b].volume[k] / scale;
        p.rho[at] = density_;
      }
      group.end = at;
    }
    p.make_room(water_.evaluation.loops().second, settings.numerics.alpha, false, settings.axisymmetric);
    water_.evaluation.signals().expect_everywhere();
    water_.radiating.begin_anew();
  }

  bool are_under_one_pressure() const {
    std::vector<double> all;
    for (const Body& body : water_.settings.bodies) {
      if (body.burn || body.start) return false;
      all.push_back(std::visit([&](const auto& law) { return law.evaluate(start_density(body), start_energy(body)).pressure; },
                               body.material.law));
    }
    const auto [low, high] = std::minmax_element(all.begin(), all.end());
    return *high - *low <= 0.01 * std::max(std::abs(*high), std::abs(*low));
  }

  void evaluate() {
    work_ += double(set_.particles.size());
    water_.evaluate(set_, {.at_rest = true});
    const Particles& p = set_.particles;
    index_.resize(p.size());
    for (std::uint32_t i = 0; i < p.size(); ++i) index_[p.id[i]] = i;
    if (news_ && !movers_.empty()) news_(movers_.size(), residual());
  }

  /// -g h^2 of particle i in memory [m].
  Vec3 force(std::uint32_t i) const {
    const SumRow& rate = set_.particles.rate[i];
    const double h = set_.particles.predicted[i].h;
    return density_ * h * h / (2.0 * pressure) * Vec3(rate.fx, rate.fy, water_.settings.dimension < 3 ? 0.0 : rate.fz);
  }
  double residual(std::uint32_t i) const { return force(i).norm() / set_.particles.predicted[i].h; }
  double residual() const {
    double most = 0;
    for (const Mover& mover : movers_) most = std::max(most, residual(index_[mover.id]));
    return most;
  }

  /// Particles that are not at rest and may move.
  std::vector<std::uint32_t> uneasy() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < set_.particles.size(); ++i)
      if (residual(i) > rest_ && (stays_.empty() || !stays_[set_.particles.id[i]])) all.push_back(i);
    return all;
  }

  void find_who_stays(const std::vector<std::uint32_t>& uneasy) {
    const Neighbours all = everything();
    Neighbours open;
    for (const std::uint32_t i : uneasy)
      if (is_at_surface(i, all)) add(i, open);
    sort(open);
    stays_.assign(set_.particles.size(), false);
    moves_ = stays_;
    for (const Group& group : set_.groups) {
      const int g = int(&group - set_.groups.data());
      const auto is_other = [&](int other) { return other >= 0 && set_.groups[other].spacing != group.spacing; };
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const Vec3 x = place_of(set_.particles, i);
        stays_[set_.particles.id[i]] =
            is_laid(g) || open.any(x, set_.reach) || (has_spacings() && all.any(x, set_.reach, is_other));
      }
    }
  }

  /// Those of a list and all within `margin` [m] of them.
  void choose_movers(const std::vector<std::uint32_t>& uneasy, double margin) {
    Neighbours moved;
    for (const std::uint32_t i : uneasy) add(i, moved);
    sort(moved);
    Bounds box;
    for (const Group& group : set_.groups)
      for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const std::uint32_t id = set_.particles.id[i];
        const Vec3 x = place_of(set_.particles, i);
        if (!moves_[id] && !stays_[id] && moved.any(x, margin)) {
          moves_[id] = true;
          movers_.push_back({id, int(&group - set_.groups.data())});
        }
        if (moves_[id]) box.include(x);
      }
    std::sort(movers_.begin(), movers_.end(), [](const Mover& a, const Mover& b) { return a.id < b.id; });
    water_.evaluation.signals().expect_within(box);
  }

  void aim_finely() {
    goal_ = aim_;
    rest_ = std::max(aim_, easy_residual);
  }

  struct Best {
    double residual;
    std::vector<Vec3> places;
  };
  void note(Best& best) const {
    if (const double now = residual(); now < best.residual) best = {now, places()};
  }

  /// To the best of the places along the way.
  void settle() {
    Best best{residual(), places()};
    descend(best);
    if (best.residual <= goal_ || !water_.walls.mirrors.empty()) return put(best.places);
    aim_finely();
    double held = best.residual;
    for (int left = barren; left > 0 && best.residual > goal_ && work_ < most_work; --left) {
      solve(best);
      Descent descent;
      for (int k = 0; k < further && best.residual > goal_ && work_ < most_work; ++k) {
        step(descent);
        note(best);
      }
      if (best.residual < 0.9 * held) held = best.residual, left = barren + 1;
    }
    put(best.places);
  }

  void step(Descent& descent) {
    move(descent.step(places(), forces()));
    evaluate();
  }

  void descend(Best& best) {
    Descent descent;
    double held = best.residual;
    for (int left = patience; left > 0 && best.residual > goal_; --left) {
      step(descent);
      note(best);
      if (best.residual < 0.9 * held) held = best.residual, left = patience + 1;
    }
    put(best.places);
    evaluate();
  }

  /// Newton's method, until it gets no further: forces of rings are no gradient, and where the descent ends in a long valley a
  /// particle or two are left that want a step of all.
  void solve(Best& best) {
    constexpr int products = 40, steps = 30, tries = 10;
    constexpr double share = 0.1, difference = 1e-4, trusted = 0.1;  // spacings
    const double spacing = water_.settings.lattice.spacing;
    std::vector<Vec3> at = places(), force = forces();
    const auto moved = [&](const std::vector<Vec3>& by) {
      std::vector<Vec3> to = at;
      for (std::size_t m = 0; m < to.size(); ++m) to[m] += by[m];
      put(to);
      water_.cross_mirrors(set_);
      evaluate();
      return forces();
    };
    double radius = trusted * spacing * std::sqrt(double(at.size()));
    for (int k = 0, slow = 0; k < steps && slow < 3 && best.residual > goal_ && work_ < most_work; ++k) {
      const KrylovSpace space(force, products, share, difference * spacing, moved);
      const double before = norm(force);
      std::vector<Vec3> by, there;
      int left = tries;
      for (; left > 0; --left) {
        by = space.step(radius);
        const double shorten = std::min(1.0, 2.0 * farthest * spacing / longest(by));
        for (Vec3& one : by) one *= shorten;
        there = moved(by);
        if (norm(there) < before) break;
        radius = 0.4 * norm(by);
      }
      if (left == 0) break;
      if (left == tries) radius = std::max(radius, 2.0 * norm(by));
      at = places();
      force = there;
      slow = norm(force) > 0.97 * before ? slow + 1 : 0;
      note(best);
    }
    put(at);
    evaluate();
  }

  bool is_laid(int body) const {
    const auto& start = water_.settings.bodies[body].start;
    return start && !start->laid.position.empty();
  }
  bool has_spacings() const {
    return std::any_of(set_.groups.begin(), set_.groups.end(),
                       [&](const Group& group) { return group.spacing != set_.groups[0].spacing; });
  }
  const Group& group_of(std::uint32_t i) const {
    return *std::find_if(set_.groups.begin(), set_.groups.end(), [&](const Group& group) { return i < group.end; });
  }
  void add(std::uint32_t i, Neighbours& to) const {
    const Vec3 x = place_of(set_.particles, i);
    to.add(&x[0], &x[1], &x[2], 1, 0);
  }
  void sort(Neighbours& neighbours) const { neighbours.sort(2.0 * water_.settings.lattice.spacing); }

  Neighbours everything() const {
    Neighbours all;
    const Particles& p = set_.particles;
    for (std::size_t g = 0; g < set_.groups.size(); ++g) {
      const Group& group = set_.groups[g];
      all.add(&p.x[group.begin], &p.y[group.begin], &p.z[group.begin], group.end - group.begin, int(g));
    }
    PairInput in{};
    set_.images.describe(in);
    all.add(in.images.x, in.images.y, in.images.z, set_.images.size(), -1);
    if (const WallLining& lining = water_.evaluation.lining(); lining.size() > 0) {
      lining.describe(in);
      all.add(in.wall_x, in.wall_y, in.wall_z, in.wall_count, -1);
    }
    sort(all);
    return all;
  }

  /// A gap that an unfitted lattice leaves is at most a spacing wide before the wall, and the images stand behind it: a ball of
  /// 1.75 spacings has no room there.
  bool is_at_surface(std::uint32_t i, const Neighbours& all) const {
    const double spacing = group_of(i).spacing;
    return !all.any(kept(place_of(set_.particles, i) + 2.0 * spacing * force(i).normalized()), 1.75 * spacing);
  }
  Vec3 kept(Vec3 x) const {
    for (int a = 0; a < 3; ++a)
      if (water_.settings.symmetry.axis[a]) x[a] = std::abs(x[a]);
    return x;
  }

  template <class Value>
  std::vector<Vec3> of_movers(Value value) const {
    std::vector<Vec3> values(movers_.size());
    for (std::size_t m = 0; m < movers_.size(); ++m) values[m] = value(index_[movers_[m].id]);
    return values;
  }
  std::vector<Vec3> places() const {
    return of_movers([&](std::uint32_t i) { return place_of(set_.particles, i); });
  }
  std::vector<Vec3> forces() const {
    return of_movers([&](std::uint32_t i) { return force(i); });
  }

  void move(const std::vector<Vec3>& steps) {
    std::vector<Vec3> to = places();
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      const double most = farthest * set_.groups[movers_[m].body].spacing, length = steps[m].norm();
      to[m] += length > most ? Vec3(most / length * steps[m]) : steps[m];
    }
    put(to);
    water_.cross_mirrors(set_);
  }

  void put(const std::vector<Vec3>& places) {
    Particles& p = set_.particles;
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      const std::uint32_t i = index_[movers_[m].id];
      const Vec3& x = places[m];
      p.x[i] = x[0], p.y[i] = x[1], p.z[i] = x[2];
    }
  }

  void take_places() {
    for (const auto [id, body] : movers_)
      bodies_[body].position[id - set_.groups[body].first_id] = place_of(set_.particles, index_[id]);
  }

  Water& water_;
  ParticleSet& set_;
  std::vector<BodyParticles>& bodies_;
  const SettleNews& news_;
  const double aim_;
  double goal_ = 0, rest_ = 0;        // of |g| h: where settling ends, and from where on it begins
  double density_ = 0;                // [kg/m^3]
  double work_ = 0;                   // updates of a particle so far
  std::vector<Mover> movers_;         // by id
  std::vector<std::uint32_t> index_;  // in memory, by id
  std::vector<bool> stays_, moves_;   // by id
};

}  // namespace

Settled settle(Water& water, std::vector<BodyParticles>& bodies, double goal, const SettleNews& news) {
  // A wall that moves at the start throws back those that are moved across it: no motion of the scene's.
  const WallLoads impulses = water.walls.impulses();
  const Exchange exchange = water.exchange;
  const Settled settled = Settler(water, bodies, goal, news).run();
  water.walls.set_impulses(impulses);
  water.exchange = exchange;
  return settled;
}

}  // namespace undex::sph
