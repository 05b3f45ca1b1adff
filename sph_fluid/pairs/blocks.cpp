#include "sph_fluid/pairs/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace undex::sph {
namespace {

constexpr std::uint32_t none = ~std::uint32_t(0);
/// Length of a box along x, in the largest cell's widths: long enough that few clusters end before they are full.
constexpr double long_box = 16.0;

/// The boxes of which the blocks are made; they lie in layers across x.
struct Boxes {
  double low[3], size[3];
  int count[3];

  int along(int axis, double place) const { return std::clamp(int((place - low[axis]) / size[axis]), 0, count[axis] - 1); }
  std::size_t layer() const { return std::size_t(count[1]) * count[2]; }
  std::size_t index(int ix, int iy, int iz) const { return ix * layer() + std::size_t(iz) * count[1] + iy; }
};

Boxes boxes_over(const std::vector<GroupView>& groups, double reach) {
  Boxes boxes{.low = {1e300, 1e300, 1e300}, .size = {}, .count = {1, 1, 1}};
  double high[3] = {-1e300, -1e300, -1e300}, cell[3] = {}, particles = 0;
  for (const GroupView& group : groups) {
    if (group.begin == group.end) continue;
    particles += group.end - group.begin;
    for (int a = 0; a < 3; ++a) {
      boxes.low[a] = std::min(boxes.low[a], group.grid.low[a]);
      high[a] = std::max(high[a], group.grid.low[a] + group.grid.count[a] * group.grid.size[a]);
      cell[a] = std::max(cell[a], group.grid.size[a]);
    }
  }
  if (particles == 0) return boxes;
  for (int a = 0; a < 3; ++a) boxes.size[a] = (2.0 * reach + cell[a]) * (1.0 + 1e-9);
  boxes.size[0] = std::max(boxes.size[0], long_box * cell[1]);
  // Bodies far apart: then wider boxes, not more memory.
  for (double number = 1e300; number > 4.0 * particles + 4096.0;) {
    number = 1.0;
    for (int a = 0; a < 3; ++a) {
      const double along = std::floor((high[a] - boxes.low[a]) / boxes.size[a]) + 1.0;
      boxes.count[a] = int(std::min(along, 1e9));
      number *= along;
    }
    if (number > 4.0 * particles + 4096.0)
      for (double& size : boxes.size) size *= 1.25;
  }
  return boxes;
}

/// Calls visit(box, begin, end, group) for every row of cells with particles in a box. A cell belongs to the box of its middle.
template <class Visit>
void for_each_run(const std::vector<GroupView>& groups, const Boxes& boxes, Visit visit) {
  std::vector<int> first;  // cell of each layer
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const CellGrid& grid = groups[g].grid;
    if (groups[g].begin == groups[g].end) continue;
    const auto box_of = [&](int axis, int cell) { return boxes.along(axis, grid.low[axis] + (cell + 0.5) * grid.size[axis]); };
    first.assign(boxes.count[0] + 1, grid.count[0]);
    for (int cell = grid.count[0]; cell-- > 0;) first[box_of(0, cell)] = cell;
    for (int layer = boxes.count[0]; layer-- > 0;) first[layer] = std::min(first[layer], first[layer + 1]);
    for (int iz = 0; iz < grid.count[2]; ++iz)
      for (int iy = 0; iy < grid.count[1]; ++iy) {
        const std::uint32_t* row = grid.start + (std::size_t(iz) * grid.count[1] + iy) * grid.count[0];
        if (row[0] == row[grid.count[0]]) continue;
        const std::size_t box = boxes.index(0, box_of(1, iy), box_of(2, iz));
        for (int layer = 0; layer < boxes.count[0]; ++layer) {
          const std::uint32_t begin = row[first[layer]], end = row[first[layer + 1]];
          if (begin < end) visit(box + layer * boxes.layer(), begin, end, std::uint16_t(g));
        }
      }
  }
}

int colour(int iy, int iz) { return 2 * (iz & 1) + (iy & 1); }

/// A layer's boxes, shared out among threads and put into a sequence. Four boxes, two along y and two along z, are a square,
/// which has all colours. A share is a run of squares, row by row: threads meet at few boxes.
class Layer {
 public:
  explicit Layer(const Boxes& boxes) : boxes_(boxes), row_((boxes.count[1] + 1) / 2), taken_(boxes.layer()) {}

  /// Cuts the layer into shares of about equal weight; `weight` is that of each of its boxes.
  void share_out(const std::uint32_t* weight, int shares) {
    std::vector<std::uint64_t> before(std::size_t(row_) * ((boxes_.count[2] + 1) / 2) + 1, 0);
    for (int iz = 0; iz < boxes_.count[2]; ++iz)
      for (int iy = 0; iy < boxes_.count[1]; ++iy) before[square(iy, iz) + 1] += weight[boxes_.index(0, iy, iz)];
    for (std::size_t k = 1; k < before.size(); ++k) before[k] += before[k - 1];
    first_.assign(shares + 1, int(before.size() - 1));
    for (int t = 0, k = 0; t < shares; ++t) {
      while (before[k] * shares < before.back() * t) ++k;
      first_[t] = k;
    }
    std::fill(taken_.begin(), taken_.end(), 0);
  }

  /// Calls take(iy, iz) once for every box of a share, those of lower colour beside a box before it.
  template <class Take>
  void walk(int share, Take take) {
    const int first = first_[share], last = first_[share + 1];
    if (first == last) return;
    for (int iz = 2 * (first / row_); iz < std::min(2 * ((last - 1) / row_) + 2, boxes_.count[2]); ++iz)
      for (int iy = 0; iy < boxes_.count[1]; ++iy) reach(iy, iz, first, last, take);
  }

 private:
  int square(int iy, int iz) const { return iz / 2 * row_ + iy / 2; }

  template <class Take>
  void reach(int iy, int iz, int first, int last, Take& take) {
    if (square(iy, iz) < first || square(iy, iz) >= last) return;
    unsigned char& taken = taken_[boxes_.index(0, iy, iz)];
    if (taken) return;
    taken = 1;
    for (int z = std::max(iz - 1, 0); z <= std::min(iz + 1, boxes_.count[2] - 1); ++z)
      for (int y = std::max(iy - 1, 0); y <= std::min(iy + 1, boxes_.count[1] - 1); ++y)
        if (colour(y, z) < colour(iy, iz)) reach(y, z, first, last, take);
    take(iy, iz);
  }

  const Boxes& boxes_;
  int row_;                 // squares along y
  std::vector<int> first_;  // square of each share
  std::vector<unsigned char> taken_;
};

}  // namespace

void BlockOrder::build(const std::vector<GroupView>& groups, double reach, int threads) {
  const Boxes boxes = boxes_over(groups, reach);
  next_.assign(boxes.count[0] * boxes.layer(), 0);
  for_each_run(groups, boxes, [&](std::size_t box, std::uint32_t begin, std::uint32_t end, std::uint16_t) {
    next_[box] += (end - begin + cluster_size - 1) / cluster_size;
  });

  // The sequence of each thread, layer after layer.
  struct Place {
    int ix, iy, iz;
  };
  std::vector<std::vector<Place>> sequences(threads);
  Layer layer(boxes);
  for (int ix = 0; ix < boxes.count[0]; ++ix) {
    layer.share_out(&next_[boxes.index(ix, 0, 0)], threads);
    for (int t = 0; t < threads; ++t)
      layer.walk(t, [&](int iy, int iz) {
        if (next_[boxes.index(ix, iy, iz)] > 0) sequences[t].push_back({ix, iy, iz});
      });
  }

  blocks_.clear();
  std::vector<std::uint32_t> shares = {0}, block_of(next_.size(), none);
  std::uint32_t clusters = 0;
  for (const std::vector<Place>& sequence : sequences) {
    for (const auto& [ix, iy, iz] : sequence) {
      const std::size_t box = boxes.index(ix, iy, iz);
      block_of[box] = std::uint32_t(blocks_.size());
      blocks_.push_back({.begin = clusters, .end = clusters + next_[box], .first_wait = 0, .last_wait = 0});
      next_[box] = clusters;
      clusters = blocks_.back().end;
    }
    shares.push_back(std::uint32_t(blocks_.size()));
  }

  waits_.clear();
  Block* block = blocks_.data();
  for (const std::vector<Place>& sequence : sequences)
    for (const auto& [ix, iy, iz] : sequence) {
      block->first_wait = std::uint32_t(waits_.size());
      for (int z = std::max(iz - 1, 0); z <= std::min(iz + 1, boxes.count[2] - 1); ++z)
        for (int y = std::max(iy - 1, 0); y <= std::min(iy + 1, boxes.count[1] - 1); ++y) {
          const std::uint32_t before = ix > 0 ? block_of[boxes.index(ix - 1, y, z)] : none;
          const std::uint32_t beside = colour(y, z) < colour(iy, iz) ? block_of[boxes.index(ix, y, z)] : none;
          if (before != none) waits_.push_back(before);
          if (beside != none) waits_.push_back(beside);
        }
      (block++)->last_wait = std::uint32_t(waits_.size());
    }
  if (!queue_) queue_ = std::make_unique<BlockQueue>();
  queue_->fill(blocks_, waits_, shares);

  clusters_.resize(clusters);
  for_each_run(groups, boxes, [&](std::size_t box, std::uint32_t begin, std::uint32_t end, std::uint16_t group) {
    for (std::uint32_t i = begin; i < end; i += cluster_size)
      clusters_[next_[box]++] = {i, std::uint16_t(std::min<std::uint32_t>(cluster_size, end - i)), group};
  });
}

void BlockOrder::describe(PairInput& in) {
  in.clusters = clusters_.data();
  in.blocks = blocks_.data();
  in.block_count = std::uint32_t(blocks_.size());
  in.waits = waits_.data();
  in.queue = queue_.get();
}

std::size_t BlockOrder::memory_bytes() const {
  return clusters_.capacity() * sizeof(Cluster) + blocks_.capacity() * sizeof(Block) +
         4 * (waits_.capacity() + next_.capacity()) + (queue_ ? queue_->memory_bytes() : 0);
}

}  // namespace undex::sph
