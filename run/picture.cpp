#include "run/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "core/shapes.hpp"
#include "scene/revolution.hpp"

namespace undex::run {
namespace {

constexpr double widest = 1000, most_places = 200'000;  // [px], squares
constexpr std::array colours{"#4c8fd6", "#e0782f", "#58a55c", "#c04f9a", "#8d6cc9", "#a08a2e", "#3aa6a0", "#d0555a"};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

class Drawing {
 public:
  Drawing(const scene::Scene& scene, const Simulation& simulation)
      : scene_(scene::for_solvers(scene)), given_(scene), simulation_(simulation), dimension_(scene_.fluid.dimension) {
    if (dimension_ == 3) up_ = 2, across_ = 1;
  }

  std::string text() {
    gather();
    if (extent_.empty()) extent_.include(Vec3::Zero());
    const double margin =
        0.03 * std::max({extent_.high[right_] - extent_.low[right_], extent_.high[up_] - extent_.low[up_], 1e-9});
    left_ = extent_.low[right_] - margin, top_ = extent_.high[up_] + margin;
    const double width = extent_.high[right_] + margin - left_, height = top_ - extent_.low[up_] + margin;
    scale_ = std::min(widest / width, widest / height);
    for (std::size_t k = 0; k < clouds_.size(); ++k) draw(clouds_[k], colours[k % colours.size()]);
    outlines();
    for (const Probe& probe : probes_) draw(probe);
    const double legend = 20.0 * double(clouds_.size() + 4);
    char head[400];
    std::snprintf(head, sizeof head,
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" font-family=\"sans-serif\" "
                  "font-size=\"13\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                  std::max(scale_ * width, 360.0), scale_ * height + legend);
    return head + body_ + key(scale_ * height) + "</svg>\n";
  }

 private:
  struct Cloud {
    std::string name;
    std::vector<Vec3> places;
    double spacing;
    std::size_t all = 0;
  };
  struct Probe {
    std::string name;
    Vec3 x;
  };

  void gather() {
    Bounds all;
    if (const sph::Fluid* fluid = simulation_.fluid()) {
      const std::vector<double> place = simulation_.fluid_field("position"), body = simulation_.fluid_field("material");
      clouds_.resize(scene_.fluid.bodies.size());
      for (std::size_t b = 0; b < clouds_.size(); ++b) {
        clouds_[b].name = scene_.fluid.bodies[b].name;
        clouds_[b].spacing = scene_.fluid.bodies[b].spacing.value_or(scene_.fluid.lattice.spacing);
      }
      for (std::size_t i = 0; i < body.size(); ++i)
        clouds_[std::size_t(body[i])].places.push_back({place[3 * i], place[3 * i + 1], place[3 * i + 2]});
      (void)fluid;
    }
    for (std::size_t k = 0; k < simulation_.bodies().size(); ++k) {
      const auto& one = simulation_.bodies()[k];
      const bool particles = one->size().particles > 0;
      Cloud cloud{particles                  ? "solids"
                  : scene_.structures_listed ? scene_.structures[k].name
                                             : "structure",
                  {},
                  scene_.fluid.lattice.spacing};
      for (const Vec3& x : one->positions()) cloud.places.push_back(x);
      if (cloud.spacing <= 0 || particles)
        for (const solid::Body& body : scene_.solids.bodies)
          if (body.spacing) cloud.spacing = std::max(cloud.spacing, *body.spacing);
      clouds_.push_back(std::move(cloud));
    }
    for (const Cloud& cloud : clouds_)
      for (const Vec3& x : cloud.places) all.include(x);
    for (const coupling::RigidObstacle& obstacle : simulation_.obstacles())
      for (const Vec3& x : obstacle.places()) all.include(x);
    if (dimension_ == 3) {
      cut_ = scene_.fluid.symmetry.axis[std::size_t(across_)] ? 0.0 : 0.5 * (all.low[across_] + all.high[across_]);
      for (Cloud& cloud : clouds_)
        std::erase_if(cloud.places, [&](const Vec3& x) { return std::abs(x[across_] - cut_) > 0.75 * cloud.spacing; });
    }
    extent_ = all;
    for (const scene::Probe& probe : given_.probes)
      probes_.push_back({probe.name, simulation_.meridian() ? simulation_.meridian()->place(probe.point) : probe.point});
    for (const Probe& probe : probes_) extent_.include(probe.x);
  }

  double px(const Vec3& x) const { return scale_ * (x[right_] - left_); }
  double py(const Vec3& x) const { return scale_ * (top_ - x[up_]); }

  void draw(Cloud& cloud, const char* colour) {
    const std::size_t every = std::size_t(std::ceil(std::max(1.0, double(cloud.places.size()) / most_places)));
    const double side = std::max(0.8, 0.85 * scale_ * cloud.spacing);
    body_ += std::string("<path fill=\"") + colour + "\" d=\"";
    char one[120];
    for (std::size_t i = 0; i < cloud.places.size(); i += every) {
      std::snprintf(one, sizeof one, "M%.1f %.1fh%.1fv%.1fh-%.1fz", px(cloud.places[i]) - 0.5 * side,
                    py(cloud.places[i]) - 0.5 * side, side, side, side);
      body_ += one;
    }
    body_ += "\"/>\n";
  }

  void draw(const Probe& probe) {
    char one[300];
    std::snprintf(one, sizeof one, "<path stroke=\"black\" d=\"M%.1f %.1fh8m-4 -4v8\"/><text x=\"%.1f\" y=\"%.1f\">",
                  px(probe.x) - 4, py(probe.x), px(probe.x) + 6, py(probe.x) - 4);
    body_ += one + escaped(probe.name) + "</text>\n";
  }

  /// Where a distance changes its sign in the plane: lines through the cells of a lattice of 300.
  void contour(const std::function<double(const Vec3&)>& distance, const char* style) {
    constexpr int n = 300;
    const double low_u = left_, low_v = top_ - (top_ - extent_.low[up_]) * 1.03;
    const double step_u = (extent_.high[right_] + (extent_.low[right_] - left_) - left_) / n, step_v = (top_ - low_v) / n;
    std::vector<double> value(std::size_t(n + 1) * std::size_t(n + 1));
    const auto place = [&](double i, double j) {
      Vec3 x = Vec3::Zero();
      x[right_] = low_u + i * step_u;
      x[up_] = low_v + j * step_v;
      if (dimension_ == 3) x[across_] = cut_;
      return x;
    };
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) value[std::size_t(j * (n + 1) + i)] = distance(place(i, j));
    body_ += std::string("<path fill=\"none\" ") + style + " d=\"";
    char one[120];
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        constexpr int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        std::vector<Vec3> ends;
        for (int c = 0; c < 4; ++c) {
          const auto *a = corner[c], *b = corner[(c + 1) % 4];
          const double va = value[std::size_t((j + a[1]) * (n + 1) + i + a[0])],
                       vb = value[std::size_t((j + b[1]) * (n + 1) + i + b[0])];
          if ((va < 0) == (vb < 0)) continue;
          const double share = va / (va - vb);
          ends.push_back(place(i + a[0] + share * (b[0] - a[0]), j + a[1] + share * (b[1] - a[1])));
        }
        for (std::size_t e = 0; e + 1 < ends.size(); e += 2) {
          std::snprintf(one, sizeof one, "M%.1f %.1fL%.1f %.1f", px(ends[e]), py(ends[e]), px(ends[e + 1]), py(ends[e + 1]));
          body_ += one;
        }
      }
    body_ += "\"/>\n";
  }

  void outlines() {
    for (const sph::Wall& wall : scene_.fluid.walls)
      contour([&](const Vec3& x) { return signed_distance(wall.container, x, dimension_); }, wall_style);
    for (const coupling::RigidObstacle& obstacle : simulation_.obstacles())
      contour([&](const Vec3& x) { return obstacle.signed_distance(x); }, obstacle_style);
  }

  std::string key(double top) const {
    std::string text;
    char one[400];
    double y = top + 16;
    const auto row = [&](const std::string& mark, const std::string& words) {
      std::snprintf(one, sizeof one, "<text x=\"34\" y=\"%.0f\">", y);
      text += mark + one + escaped(words) + "</text>\n";
      y += 20;
    };
    for (std::size_t k = 0; k < clouds_.size(); ++k) {
      std::snprintf(one, sizeof one, "<rect x=\"10\" y=\"%.0f\" width=\"12\" height=\"12\" fill=\"%s\"/>", y - 11,
                    colours[k % colours.size()]);
      row(one, clouds_[k].name);
    }
    const auto line = [&](const char* style) {
      std::snprintf(one, sizeof one, "<path %s d=\"M8 %.0fh18\"/>", style, y - 5);
      return std::string(one);
    };
    if (!scene_.fluid.walls.empty()) row(line(wall_style), "walls");
    if (!simulation_.obstacles().empty()) row(line(obstacle_style), "obstacles");
    std::snprintf(one, sizeof one, "%s %.6g to %.6g m across, %s %.6g to %.6g m up", name(right_), extent_.low[right_],
                  extent_.high[right_], name(up_), extent_.low[up_], extent_.high[up_]);
    std::string words = one;
    if (dimension_ == 3) {
      std::snprintf(one, sizeof one, "; the plane y = %.6g m", cut_);
      words += one;
    }
    row("", words);
    return text;
  }
  const char* name(int axis) const {
    if (scene_.fluid.axisymmetric) return axis == 0 ? "r" : "along the axis";
    return axis == 0 ? "x" : axis == 1 ? "y" : "z";
  }

  static constexpr const char *wall_style = "stroke=\"#222\" stroke-width=\"2\"",
                              *obstacle_style = "stroke=\"#b00020\" stroke-width=\"2\"";

  scene::Scene scene_;  // as the solvers see it
  const scene::Scene& given_;
  const Simulation& simulation_;
  int dimension_;
  int right_ = 0, up_ = 1, across_ = 2;
  double cut_ = 0, left_ = 0, top_ = 0, scale_ = 1;
  Bounds extent_;
  std::vector<Cloud> clouds_;
  std::vector<Probe> probes_;
  std::string body_;
};

}  // namespace

std::string picture(const scene::Scene& scene, const Simulation& simulation) { return Drawing(scene, simulation).text(); }

}  // namespace undex::run
