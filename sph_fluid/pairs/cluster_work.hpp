// The loop over pairs: the particles of a cluster, one after the other, against vectors of candidates. What a pair gives is
// computed once and added to both sides. Blocks of clusters are worked on in an order in which a block waits for those of
// its neighbours that come before it: sums do not depend on the number of threads.
// Included by the files that are compiled once per instruction set; see schemes/loops.hpp for the choice at start-up.
#pragma once

#include <omp.h>

#include "sph_fluid/pairs/candidates.hpp"
#include "sph_fluid/pairs/pair_pass.hpp"
#include "sph_fluid/pairs/pair_smoothing.hpp"

namespace undex::sph::UNDEX_LEVEL {

namespace {

/// What the pairs of one loop have in common.
struct PairKind {
  bool constant_h, gas, alike;
  double least_pressure;
};

/// Do the pairs of a pass read rows in single precision?
template <class Pass, class T>
inline constexpr bool packed = same_type<T, float>&& SingleLayout<typename Pass::State::Second>::serves;

/// One pass over one cluster: its candidates, the pairs with them, and the sums.
template <class Kernel, template <class> class Scheme, class T>
class ClusterWork {
  using Pass = Scheme<T>;
  using V = Vec<T>;
  using State = typename Pass::State;
  using Sums = typename Pass::Sums;
  using Wall = typename Pass::Wall;
  static constexpr int W = lanes<T>;
  using Second = typename State::Second;
  static constexpr bool with_second = !same_type<Second, NoRow>;
  static constexpr bool rings = over_rings<Pass>;
  static constexpr bool single = packed<Pass, T>;
  /// Candidates that are seen across the same symmetry planes.
  struct Piece {
    std::uint32_t begin, real;
    int image;
  };
  using List = CandidateList<T, Second, Pass::symmetric ? Sums::count : 0, rings>;
  /// What gives a candidate its share of a pair: the pair's weight, or where nothing is given back a volume (of a ring its area).
  static constexpr int counted = Pass::symmetric ? List::weight : List::state + (rings ? 2 : 4) * W;

 public:
  ClusterWork(const PairInput& in, const Pass& pass, const Cluster& cluster, Scratch& scratch, const PairOutput& out)
      : in_(in), pass_(pass), cluster_(cluster), own_(in.groups[cluster.group]), list_(scratch), out_(out) {
    box_ = box_of(in.x, in.y, in.z, cluster.begin, cluster.count);
    for (int a = 0; a < 3; ++a) origin_[a] = 0.5 * (box_.low[a] + box_.high[a]);
    if constexpr (single) fixed_ = in.frame->fine && in.sight.self == nullptr;
    for (int a = 0; fixed_ && a < 3; ++a) {
      middle_[a] = std::int32_t(origin_[a] / in.frame->unit[a] - in.frame->low[a]);
      origin_[a] = (in.frame->low[a] + middle_[a]) * in.frame->unit[a];
    }
    h_cluster_ = own_.h_max;
    if (own_.variable_h) {
      h_cluster_ = 0.0;
      for (int l = 0; l < cluster.count; ++l) h_cluster_ = h_of(l) > h_cluster_ ? h_of(l) : h_cluster_;
    }
    if (in.sight.self != nullptr)
      for (int l = 0; l < cluster.count; ++l) beside_thin_wall_ = beside_thin_wall_ || in.sight.particles[cluster.begin + l] != 0;
  }

  /// Returns the number of true neighbours met, directed.
  long long run() {
    if (out_of_reach() || (own_.fast ? in_.choice == PairChoice::slow : !Pass::symmetric && in_.choice == PairChoice::fast))
      return 0;
    for (int g = 0; g < in_.group_count; ++g) with_group(g);
    const bool with_own = takes(own_, own_);
    if (in_.wall_count > 0 && with_own) with_walls();
    store_sums();
    double met = 0;
    for (int l = 0; l < W; ++l) met += 2.0 * double(met_[l]);
    return (long long)(met) - (with_own ? cluster_.count : 0);  // a particle is not its own neighbour
  }

 private:
  bool out_of_reach() const {
    bool out = false;
    for (int a = 0; a < 3; ++a)
      out = out || (in_.partly &&
                    (box_.low[a] - in_.disturbed_high[a] > in_.margin || in_.disturbed_low[a] - box_.high[a] > in_.margin));
    return out;
  }

  /// A wall belongs to the particle that it meets: `one` twice.
  bool takes(const GroupView& one, const GroupView& other) const {
    return in_.choice == PairChoice::all || (one.fast || other.fast) == (in_.choice == PairChoice::fast);
  }

  double h_of(int l) const { return own_.variable_h ? in_.fluid[cluster_.begin + l].h : own_.h_max; }

  void with_group(int g) {
    const GroupView& other = in_.groups[g];
    const bool images = other.images_of >= 0;
    PairKind kind{};
    kind.constant_h = !own_.variable_h && !other.variable_h && own_.h_max == other.h_max;
    kind.gas = own_.gas || other.gas;
    kind.alike = other.material == own_.material;
    kind.least_pressure = own_.least_pressure > other.least_pressure ? own_.least_pressure : other.least_pressure;
    // A pair's h is the mean of two.
    const double reach = kernel_.support * (kind.constant_h ? own_.h_max : 0.5 * (h_cluster_ + other.h_max));
    // Where both sides receive their part, the pairs of two clusters belong to the first, and a cluster meets what comes after
    // it. Of its own pairs it meets each twice: they count one half. A piece is what lies on one side of the mirrors: seen from
    // an image, i is an image too, and what the image receives is mirrored back. Images in walls are met by all, with one half of
    // each pair: the other is that of the image of i.
    if (Pass::symmetric && !images && g < cluster_.group) return;
    if (Pass::symmetric && !takes(own_, other)) return;
    const int body = images ? other.images_of : g;
    if (Pass::partners == Partners::own_body && !(body == cluster_.group && own_.own_pairs)) return;
    if (Pass::partners == Partners::other_bodies && body == cluster_.group) return;
    const double *x = images ? in_.images.x : in_.x, *y = images ? in_.images.y : in_.y, *z = images ? in_.images.z : in_.z;
    const std::uint32_t next = images ? 0 : cluster_.begin + cluster_.count;
    piece_count_ = 0;
    list_.size = 0;
    for_each_image(in_.mirror, box_, reach, [&](int image, const Box3& box) {
      const std::uint32_t begin = list_.size;
      std::uint32_t own = 0;
      if (Pass::symmetric && g == cluster_.group) {
        own = cluster_.count;
        list_.reserve(begin + own);
        if (fixed_) list_.size = scan_run(fixed_view(false, image), cluster_.begin, next, 1e30f, begin, list_.scratch());
        else
          for (std::uint32_t k = cluster_.begin; k < next; ++k) list_.append(k, x[k], y[k], z[k]);
      }
      search(other.grid, {x, y, z}, images, image, box, reach, Pass::symmetric ? next : 0);
      pieces_[piece_count_++] = {begin, list_.size, image};
      fill(begin, images ? list_.size - begin : own, images, image, reach, !kind.constant_h || kind.gas);
    });
    // Images reach beyond the wall that they stand behind.
    looks_ = beside_thin_wall_ || (images && in_.sight.self != nullptr);
    for (int k = 0; looks_ && k < piece_count_; ++k) look(pieces_[k], images ? SightOf::images : SightOf::particles, reach);
    pairs_with<State, Sums, Pass::symmetric>(kind);
    looks_ = false;
    if constexpr (Pass::symmetric)
      for (int k = 0; k < piece_count_; ++k)
        list_.template scatter_sums<Sums>(pieces_[k].begin, pieces_[k].real, images ? out_.images : out_.fluid, pieces_[k].image);
  }

  void with_walls() {
    const PairKind kind{.constant_h = true, .gas = own_.gas, .alike = true, .least_pressure = own_.least_pressure};
    const double reach = kernel_.support * h_cluster_;
    for_each_image(in_.mirror, box_, reach, [&](int image, const Box3& box) {
      list_.size = 0;
      search_exactly(in_.wall_grid, {in_.wall_x, in_.wall_y, in_.wall_z}, box, reach, 0);
      const std::uint32_t real = list_.size;
      if (real == 0) return;
      list_.pad(0);
      list_.fill_places(0, real, origin_, image, T(1e3 * reach));
      list_.template fill_rows<List::state>(0, in_.wall, image);
      looks_ = beside_thin_wall_;
      pieces_[0] = {0, real, image};
      piece_count_ = 1;
      if (looks_) look(pieces_[0], SightOf::dummies, reach);
      if (Pass::symmetric && out_.wall != nullptr) {
        pairs_with<Wall, WallSums<V>, true>(kind);
        list_.template scatter_sums<WallSums<V>>(0, real, out_.wall, image);
      } else {
        pairs_with<Wall, WallSums<V>, false>(kind);
      }
      looks_ = false;
    });
  }

  struct Places {
    const double *x, *y, *z;
  };
  void search_exactly(const CellGrid& grid, const Places& at, const Box3& box, double reach, std::uint32_t from) {
    scan_grid(grid, box, reach, from, list_,
              [&](std::uint32_t begin, std::uint32_t end, std::uint32_t found) UNDEX_LAMBDA_INLINE {
                return scan_run(at.x, at.y, at.z, begin, end, box, reach * reach, found, list_.scratch());
              });
  }
  /// Candidates of a grid: those that stand, mirrored, within reach of the cluster's box, which is mirrored to them.
  void search(const CellGrid& grid, const Places& at, bool images, int image, const Box3& box, double reach, std::uint32_t from) {
    if (!fixed_) return search_exactly(grid, at, box, reach, from);
    const FixedView view = fixed_view(images, image);
    const float reach2 = float(reach * reach) * (1 + 1e-5f);
    scan_grid(grid, box, reach, from, list_,
              [&](std::uint32_t begin, std::uint32_t end, std::uint32_t found)
                  UNDEX_LAMBDA_INLINE { return scan_run(view, begin, end, reach2, found, list_.scratch()); });
  }
  FixedView fixed_view(bool images, int image) const {
    FixedView view;
    for (int a = 0; a < 3; ++a) {
      const bool flip = image >> a & 1;
      view.n[a] = in_.single[images].place[a];
      view.middle[a] = std::int32_t(flip ? -2.0 * in_.frame->low[a] - middle_[a] : double(middle_[a]));
      view.unit[a] = float(flip ? -in_.frame->unit[a] : in_.frame->unit[a]);
      view.half[a] = float(0.5 * (box_.high[a] - box_.low[a]) + in_.frame->unit[a]);
    }
    return view;
  }
  /// Place of one of the cluster's own particles from its middle.
  UNDEX_INLINE T own_place(int axis, std::uint32_t i) const {
    if (fixed_) return T(float(in_.single[0].place[axis][i] - middle_[axis]) * float(in_.frame->unit[axis]));
    const double* const axes[3] = {in_.x, in_.y, in_.z};
    return T(axes[axis][i] - origin_[axis]);
  }

  /// How much the cluster's particles see of the candidates of a piece that are within reach.
  void look(const Piece& piece, SightOf what, double reach) {
    Scratch& s = list_.scratch();
    in_.sight.answer(in_.sight.self, in_,
                     {cluster_.begin, cluster_.count, what, s.index, s.x, s.y, s.z, piece.begin, piece.real, piece.image, reach,
                      s.share, s.capacity});
    for (std::uint32_t c = piece.begin; c < piece.real; ++c) {
      s.kept[2 * c] = double(list_.place(0)[c]);
      s.kept[2 * c + 1] = double(list_.block(c / W)[c % W + counted]);
    }
  }

  /// The candidates as particle l of the cluster sees them: the hidden ones stand far away.
  template <bool wall>
  __attribute__((noinline)) void show(int l) {
    const Scratch& s = list_.scratch();
    const float* share = s.share + std::size_t(l) * s.capacity;
    const double far = 1e3 * kernel_.support * h_cluster_;
    for (int k = 0; k < piece_count_; ++k)
      for (std::uint32_t c = pieces_[k].begin; c < pieces_[k].real; ++c) {
        list_.place(0)[c] = T(share[c] > 0.0f ? s.kept[2 * c] : far);
        if constexpr (!wall) list_.block(c / W)[c % W + counted] = T(share[c] * s.kept[2 * c + 1]);
      }
  }

  const Second* second_rows(bool images) const { return static_cast<const Second*>(images ? in_.images.second : in_.second); }

  /// The candidates from `begin` on get what the pairs read of them; pairs with the first `halves` count one half. `gas`: do
  /// they read what only pairs with gas do?
  void fill(std::uint32_t begin, std::uint32_t halves, bool images, int image, double reach, [[maybe_unused]] bool gas) {
    const std::uint32_t real = list_.size;
    if (real == begin) return;
    list_.pad(begin);
    if (fixed_) list_.set_aside(real, T(1e3 * reach));
    else list_.fill_places(begin, real, origin_, image, T(1e3 * reach));
    if (Pass::symmetric) list_.fill_weights(begin, halves);
    if constexpr (single) {
      list_.fill_single(begin, in_.single[images], gas || length_of<Second> > length_of<GradientRow>, image);
    } else {
      list_.template fill_rows<List::state>(begin, images ? in_.images.fluid : in_.fluid, image);
      if constexpr (with_second) list_.template fill_rows<List::second>(begin, second_rows(images), image);
    }
    if constexpr (rings) list_.template fill_rows<List::ring>(begin, images ? in_.images.rings : in_.rings, image);
  }

  template <class Other, class OtherSums, bool two_sided>
  void pairs_with(const PairKind& kind) {
    if constexpr (two_sided)
      for (std::uint32_t b = 0; b < list_.blocks(); ++b)
        for (int k = 0; k < OtherSums::count; ++k) store(list_.block(b) + List::sum + k * W, V{});
    if (list_.size == 0) return;
    for (int l = 0; l < cluster_.count; ++l) {
      if (looks_) show<same_type<Other, Wall>>(l);
      if (kind.constant_h) pairs_of<Other, OtherSums, two_sided>(l, kind, ConstantH<Kernel, T>(kernel_, h_of(l), in_));
      else pairs_of<Other, OtherSums, two_sided>(l, kind, PairH<Kernel, T>(kernel_, h_of(l), in_));
    }
    begun_ = true;
  }

  /// Particle l of the cluster with all candidates.
  template <class Other, class OtherSums, bool two_sided, class Smoothing>
  void pairs_of(int l, const PairKind& kind, const Smoothing& smoothing) {
    const std::uint32_t me = cluster_.begin + l;
    State i;
    i.read([&](int k) UNDEX_LAMBDA_INLINE { return broadcast(T(numbers(in_.fluid + me)[k])); });
    if constexpr (with_second) i.read_second([&](int k) UNDEX_LAMBDA_INLINE { return broadcast(T(numbers(second_ + me)[k])); });
    if constexpr (rings) i.read_ring([&](int k) UNDEX_LAMBDA_INLINE { return broadcast(T(numbers(in_.rings + me)[k])); });
    const V x = broadcast(own_place(0, me)), y = broadcast(own_place(1, me)), z = broadcast(own_place(2, me));
    const T *xs = list_.place(0), *ys = list_.place(1), *zs = list_.place(2);
    constexpr bool wall = same_type<Other, Wall>;
    Sums si;
    V met{};
    Pair<V> pair;
    pair.gas = kind.gas;
    pair.alike = kind.alike;
    pair.least_pressure = T(kind.least_pressure);
    T* block = list_.block(0);
    T* const end = list_.block(list_.blocks());
    for (; block != end; block += List::stride, xs += W, ys += W, zs += W) {
      Other j;
      j.read([&](int k) UNDEX_LAMBDA_INLINE { return load(block + List::state + k * W); });
      if constexpr (with_second && !wall)
        j.read_second([&](int k) UNDEX_LAMBDA_INLINE { return load(block + List::second + k * W); });
      if constexpr (rings && !wall) j.read_ring([&](int k) UNDEX_LAMBDA_INLINE { return load(block + List::ring + k * W); });
      pair.dx = x - load(xs);
      pair.dy = y - load(ys);
      pair.dz = z - load(zs);
      pair.r2 = pair.dx * pair.dx + pair.dy * pair.dy + pair.dz * pair.dz;
      smoothing.template evaluate<rings>(pair, block + List::state + 7 * W);
      if constexpr (wall || !Pass::symmetric) {
        met += keep(pair.in_reach, broadcast(T(0.5)));
      } else {
        const V weight = load(block + List::weight);
        met += keep(pair.in_reach, weight);
        pair.F *= weight;
        if constexpr (rings) pair.W *= weight;
      }
      OtherSums sj;
      if constexpr (two_sided) sj.each([&](V& sum, int k) UNDEX_LAMBDA_INLINE { sum = load(block + List::sum + k * W); });
      if constexpr (wall) pass_.wall(i, j, pair, si, sj);
      else pass_.pair(i, j, pair, si, sj);
      if constexpr (two_sided) sj.each([&](V& sum, int k) UNDEX_LAMBDA_INLINE { store(block + List::sum + k * W, sum); });
    }
    met_ += met;
    if (begun_)
      si.each([&](V& sum, int k)
                  UNDEX_LAMBDA_INLINE { sum = Sums::is_maximum(k) ? maximum(sums_[l][k], sum) : sums_[l][k] + sum; });
    si.each([&](V& sum, int k) UNDEX_LAMBDA_INLINE { sums_[l][k] = sum; });
  }

  /// The particles' sums over lanes and candidates, D particles at a time.
  void store_sums() {
    constexpr int D = lanes<double>;
    if (!begun_ || cluster_.count < cluster_size)
      for (int l = begun_ ? cluster_.count : 0; l < cluster_size; ++l)
        for (int k = 0; k < Sums::count; ++k) sums_[l][k] = V{};
    for (int first = 0; first < cluster_.count; first += D) {
      Vec<double> total[Sums::count];
#pragma GCC unroll 32
      for (int k = 0; k < Sums::count; ++k) {
        V part[D];
#pragma GCC unroll 8
        for (int l = 0; l < D; ++l) part[l] = sums_[first + l][k];
        total[k] = Sums::is_maximum(k) ? folded<true>(part) : folded<false>(part);
      }
      const int count = cluster_.count - first < D ? cluster_.count - first : D;
      if constexpr (Pass::symmetric) {
        for (int l = 0; l < count; ++l) {
          double row[Sums::count];
          for (int k = 0; k < Sums::count; ++k) row[k] = total[k][l];
          List::template add_row<Sums>(&out_.fluid[cluster_.begin + first + l].fx, row);
        }
      } else {
        pass_.store(total, own_.gas, in_, cluster_.begin + first, count);
      }
    }
  }

  const PairInput& in_;
  const Kernel kernel_ = kernel_of(in_, (const Kernel*)nullptr);
  const Pass& pass_;
  const Cluster& cluster_;
  const GroupView& own_;
  const Second* second_ = second_rows(false);
  List list_;
  const PairOutput& out_;
  Box3 box_;
  double origin_[3];
  double h_cluster_;
  V sums_[cluster_size][Sums::count];
  V met_{};  // half the neighbours met
  bool beside_thin_wall_ = false, looks_ = false, fixed_ = false;
  bool begun_ = false;           // is there anything in the sums?
  std::int32_t middle_[3] = {};  // origin in fixed point
  Piece pieces_[8];
  int piece_count_ = 0;
};

/// The clusters of a block. Returns the number of true neighbours met, directed.
template <class Kernel, template <class> class Scheme, class T>
__attribute__((noinline)) long long work_on(const PairInput& in, const Scheme<T>& scheme, const Block& block, Scratch& scratch,
                                            const PairOutput& out) {
  long long met = 0;
  for (std::uint32_t k = block.begin; k < block.end; ++k)
    met += ClusterWork<Kernel, Scheme, T>(in, scheme, in.clusters[k], scratch, out).run();
  return met;
}

template <LoopKernel Kernel, template <class> class Scheme, class T>
requires PairPass<Scheme<T>>
void pass(const PairInput& in, const PairOutput& out) {
  const Scheme<T> scheme(in);
  if constexpr (packed<Scheme<T>, T>) pack<typename Scheme<T>::State::Second>(in);
  start(*in.queue, Scheme<T>::symmetric ? Turns::in_order : Turns::any);
#pragma omp parallel
  for (std::uint32_t b; (b = take(*in.queue, omp_get_thread_num())) < in.block_count;) {
    out.interactions[b] = work_on<Kernel, Scheme, T>(in, scheme, in.blocks[b], in.scratch[omp_get_thread_num()], out);
    finish(*in.queue, b);
  }
}

/// The loop of a pass: that of the kernel where it is one of `Own`, else the one that serves any.
template <template <class> class Scheme, class... Own>
CompiledLoop loop_of(KernelName kernel, Precision precision) {
  const bool mixed = precision == Precision::mixed;
  PairLoop chosen = mixed ? &pass<AnyKernel, Scheme, float> : &pass<AnyKernel, Scheme, double>;
  [[maybe_unused]] const auto prefer = [&](KernelName name, PairLoop own) {
    if (name == kernel) chosen = own;
  };
  (prefer(Own::which, mixed ? &pass<Own, Scheme, float> : &pass<Own, Scheme, double>), ...);
  return {chosen, Scheme<double>::State::Second::which};
}

}  // namespace
}  // namespace undex::sph::UNDEX_LEVEL
