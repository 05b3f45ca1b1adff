#include "sph_fluid/walls/sight.hpp"

#include <algorithm>

#include "core/surface.hpp"

namespace undex::sph {

Sight::Code Sight::code_of(int wall, int face) const {
  if (!thin_.contain(wall)) return 0;
  const Code sheet = Code(std::min(thin_.sheet(wall, face), int(many)));
  return thin_.is_plain(wall, face) ? sheet : Code(sheet | edge);
}

void Sight::see(double reach, const std::vector<MirrorWall>& walls, const SlipFaces& faces, const Settings& settings,
                std::span<const WallFoot> feet, std::size_t particles, std::span<const SeenImage> images,
                std::span<const SeenImage::Glass> glasses) {
  forget();
  if (thin_.empty()) return;
  reach_ = reach;
  dimension_ = settings.dimension;
  if (!lined_) lined_ = lined_faces(settings);
  spacing_ = settings.lattice.spacing;
  screens_.build(walls, thin_, faces, settings, reach);
  const auto with = [](Code a, Code b) -> Code {
    if (a == 0 || b == 0) return Code(a | b);
    const Code ends = Code((a | b) & edge);
    return (a & many) == (b & many) ? Code((a & many) | ends) : Code(many | edge);
  };
  particle_.assign(particles, 0);
  for (const WallFoot& foot : feet)
    if (foot.at.distance > 0.0) particle_[foot.particle] = with(particle_[foot.particle], code_of(foot.wall, foot.face));
  images_ = images;
  glasses_ = glasses;
  image_.resize(images.size());
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Code owner = particle_[images[k].owner];
    const SeenImage::Glass* glass = images[k].first < images[k].last ? &glasses[images[k].first] : nullptr;
    const Code mirror = glass ? code_of(glass->wall, glass->face) : Code(0);
    image_[k] = mirror == 0 ? owner : Code(mirror | (owner & edge));
  }
}

void Sight::answer(const PairInput& in, const SightQuestion& question) const {
  static thread_local Screens::Near near, nearer;
  static thread_local Way way;
  const auto place = [&](int l) {
    const std::uint32_t i = question.begin + l;
    return Vec3(in.x[i], in.y[i], in.z[i]);
  };
  bool found = false;
  const auto find_all = [&] {
    Bounds box;
    for (int l = 0; l < question.count; ++l) box.include(place(l));
    box.low -= Vec3::Constant(question.reach), box.high += Vec3::Constant(question.reach);
    screens_.find(box, near);
    found = true;
  };
  for (int l = 0; l < question.count; ++l) {
    const Vec3 from = place(l);
    const Code mine = particle_[question.begin + l];
    float* row = question.share + std::size_t(l) * question.row;
    bool chosen = false;
    const auto about = [&]() -> const Screens::Near& {
      if (!found) find_all();
      if (!chosen) screens_.find(near, from, question.reach, nearer);
      chosen = true;
      return nearer;
    };
    for (std::uint32_t c = question.first; c < question.last; ++c) {
      const Vec3 at = mirrored(Vec3(question.x[c], question.y[c], question.z[c]), unsigned(question.mirror));
      row[c] = share(from, mine, at, question, question.index[c], in, about, way);
    }
  }
}

template <class About>
float Sight::share(const Vec3& from, Code mine, const Vec3& at, const SightQuestion& question, std::uint32_t j,
                   const PairInput& in, About about, Way& way) const {
  const bool images = question.what == SightOf::images, dummies = question.what == SightOf::dummies;
  bool mirror = false;
  if (images)
    for (std::uint32_t g = images_[j].first; g < images_[j].last; ++g) mirror = mirror || is_thin(glasses_[g].wall);
  const Code its = dummies ? Code(many | edge) : images ? image_[j] : particle_[j];
  if (mine == 0 || its == 0) return mirror ? 0.0f : 1.0f;
  const Code a = mine & many, b = its & many;
  if (a != many && b != many) {
    if (a == b && (mine & its & edge) == 0) return 1.0f;
    if (a != b && ((mine | its) & edge) == 0) return 0.0f;
  }
  if ((at - from).squaredNorm() > question.reach * question.reach) return 0.0f;
  const unsigned axes = unsigned(question.mirror);
  if (images && images_[j].first < images_[j].last) return float(mirrored_share(from, at, j, axes, about(), way));
  screens_.follow(from, at, about(), way);
  if (!dummies) return float(way.free_share());
  if (j >= behind_surface_.size() || behind_surface_[j] == 0) return sees_container(at, way) ? 1.0f : 0.0f;
  const WallRow& row = in.wall[j];
  return way.enters(mirrored(Vec3(row.nx, row.ny, row.nz), axes)) ? 1.0f : 0.0f;
}

bool Sight::sees_container(const Vec3& at, const Way& way) const {
  if (way.is_free()) return true;
  const auto first = std::find_if(way.crossings.begin(), way.crossings.end(), [](const Way::Crossing& c) { return c.entering; });
  if (first == way.crossings.end()) return false;
  const Vec3 shown = at - 2.0 * (first->normal.dot(at) - first->offset) * first->normal;
  return lined_->end_before(shown, reach_, dimension_);
}

double Sight::mirrored_share(Vec3 from, Vec3 at, std::uint32_t j, unsigned axes, const Screens::Near& near, Way& way) const {
  struct Mirror {
    int sheet;
    bool thick;
    Vec3 normal, shown;
  };
  std::array<Mirror, longest_chain> mirrors;
  const int count = int(images_[j].last - images_[j].first);
  for (int k = 0; k < count; ++k) {
    const SeenImage::Glass& glass = glasses_[images_[j].first + k];
    mirrors[k] = {thin_.sheet(glass.wall, glass.face), !is_thin(glass.wall), mirrored(glass.normal, axes),
                  mirrored(glass.shown, axes)};
  }
  // Particles have images in all sheets of a plane: the way chooses.
  const auto enters = [&](const Mirror& mirror) {
    return way.first_wall([&](const Way::Crossing& crossing) {
      return crossing.sheet == mirror.sheet && crossing.normal.dot(mirror.normal) > alike;
    });
  };
  // Where walls meet at right angles an image is the same in any order: the mirror that the way enters comes first.
  const auto sort_from = [&](int first) {
    for (int k = first; k < count; ++k) {
      const Mirror entered = mirrors[k];
      if (!entered.thick && enters(entered)) {
        const double plane = 0.5 * (entered.shown + (k > first ? mirrors[k - 1].shown : at)).dot(entered.normal);
        const auto across = [&](const Vec3& x) -> Vec3 { return x - 2.0 * (x.dot(entered.normal) - plane) * entered.normal; };
        for (int m = k; m > first; --m) {
          mirrors[m] = mirrors[m - 1];
          mirrors[m].shown = across(mirrors[m].shown);
        }
        mirrors[first] = entered;
        mirrors[first].shown = across(at);
        return true;
      }
      for (int m = k + 1; m < count; ++m)
        if (std::abs(entered.normal.dot(mirrors[m].normal)) > alike) return false;
    }
    return false;
  };
  double share = 1.0;
  for (int k = 0; k < count; ++k) {
    screens_.follow(from, at, near, way);
    const bool through = sort_from(k);
    const Mirror& mirror = mirrors[k];
    // Beside an edge, and where it is thick, the mirror's plane lies halfway between the image and what it shows.
    const double depth = (at - from).dot(mirror.normal), before = (0.5 * (at + mirror.shown) - from).dot(mirror.normal);
    const double reached = through ? way.crossings[0].at : depth > 0.0 ? std::clamp(before / depth, 0.0, 1.0) : 0.0;
    const Vec3 mirrored_at = from + (reached - 1e-6) * (at - from) - 1e-6 * spacing_ * mirror.normal;
    if (mirror.thick) {
      screens_.follow(from, mirrored_at, near, way);
      share = std::min(share, way.free_share());
    } else {
      const double grazed = way.graze(mirror.sheet);
      share = std::min(share, through ? 1.0 - grazed : std::min(grazed, way.beside(mirror.sheet)));
    }
    if (share <= 0.0) return 0.0;
    from = mirrored_at;
    at = mirror.shown;
  }
  screens_.follow(from, at, near, way);
  return std::min(share, way.free_share());
}

void Sight::weigh(const void* self, const PairInput& in, const SightQuestion& question) {
  static_cast<const Sight*>(self)->answer(in, question);
}

void Sight::describe(PairInput& in) const {
  in.sight = {};
  if (!thin_.empty()) in.sight = {.self = this, .particles = particle_.data(), .answer = &weigh};
}

bool Sight::sees(const Vec3& a, const Vec3& b) const {
  if (thin_.empty()) return true;
  Bounds box;
  box.include(a);
  box.include(b);
  Screens::Near near;
  screens_.find(box, near);
  Way way;
  screens_.follow(a, b, near, way);
  return way.is_free();
}

void Sight::forget() {
  screens_.clear();
  particle_.clear();
  image_.clear();
  images_ = {};
  glasses_ = {};
}

std::size_t Sight::memory_bytes() const {
  return thin_.memory_bytes() + screens_.memory_bytes() + (particle_.capacity() + image_.capacity()) * sizeof(Code);
}

}  // namespace undex::sph
