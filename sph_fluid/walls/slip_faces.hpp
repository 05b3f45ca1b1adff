// The faces of the scene's containers: where particles have images in the slip faces, and where those that have crossed one are
// put back; where dummies stand behind the others; which of them hold the edges of other walls.
#pragma once

#include <optional>
#include <vector>

#include "core/shapes.hpp"
#include "sph_fluid/settings.hpp"

namespace undex::sph {

struct SlipFaces {
  /// Faces across one axis; either may be missing. Between both stand images of images, as in two mirrors.
  struct Pair {
    int axis;
    double low, high;      ///< [m]; -+1e300 where there is none
    bool symmetric;        ///< is `low` a symmetry plane, whose own images are not stored?
    Bounds window;         ///< of the container
    bool of_cone = false;  ///< does a cone that widens end here? Their images are found together
  };
  /// A sphere, or the side of a cone; that of a cylinder does not widen.
  struct Round {
    /// Where a cone's side meets an end that is a slip wall too, in (distance from the axis, along it). The images behind this
    /// edge are parted by the line that halves the angle outside: what lies towards `side` shows the side, the rest the end.
    struct Edge {
      Eigen::Vector2d at, side;
    };

    Vec3 center;
    double radius;                      ///< [m]; of a cone at `origin`
    int axis = -1;                      ///< of a cone
    double low = -1e300, high = 1e300;  ///< along it [m]
    double origin = 0.0;                ///< [m]
    double sine = 0.0, cosine = 1.0;    ///< of the angle between a cone's side and its axis
    std::vector<Edge> edges{};          ///< of a cone that widens
    int ends = -1;                      ///< then its ends in `plane`

    /// From the axis, or the middle, to x [m].
    Vec3 away(const Vec3& x) const;
    /// Is x at most `beyond` [m] past a cone's ends?
    bool is_beside(const Vec3& x, double beyond) const;
    /// Does an image at x show the side, and not an end?
    bool shows(const Vec3& x) const;
  };
  std::vector<Round> round;
  std::vector<Pair> plane;

  bool empty() const { return round.empty() && plane.empty(); }
  /// Is x at most `far` [m] beyond one of the faces?
  bool end_before(const Vec3& x, double far, int dimension) const;
  /// Do both points lie in one of the faces, within `tolerance` [m]?
  bool hold(const Vec3& a, const Vec3& b, double tolerance) const;
};
/// Those that the fluid is mirrored in.
SlipFaces slip_faces(const Settings& settings);
/// Those that dummies stand behind.
SlipFaces lined_faces(const Settings& settings);
/// Both.
SlipFaces fixed_faces(const Settings& settings);
/// Those that radiate, as they are at the start.
SlipFaces radiating_faces(const Settings& settings);

/// Does the scheme mirror the fluid in slip walls? (The published one lines them with dummy particles.)
constexpr bool mirrors_fluid(SchemeName scheme) { return scheme != SchemeName::paper; }

/// A lower bound of the distance [m] between particles within a box and any of the faces.
double clearance(const SlipFaces& faces, const Bounds& box);

/// A particle's image in a face.
struct Reflection {
  Vec3 place = Vec3::Zero();   ///< [m]
  Vec3 normal = Vec3::Zero();  ///< zero: an even number of mirrors
  double stretch = 1.0;        ///< volume over the particle's
};

/// The image of a place in a round wall; none farther from it than `depth` [m].
std::optional<Reflection> image_in(const SlipFaces::Round& wall, const Vec3& x, double depth, int dimension);
/// May a place have images no farther behind a face than `depth` [m]? Most have none, and all are asked.
inline bool may_show(const SlipFaces& faces, const Vec3& x, double depth) {
  for (const SlipFaces::Pair& pair : faces.plane)
    if (x[pair.axis] - pair.low < depth || pair.high - x[pair.axis] < depth) return true;
  return !faces.round.empty();
}
/// Calls visit(Reflection) for all images between and behind the faces of a pair: a series on either side, each image of the last
/// in the other face.
template <class Visit>
void images_in(const SlipFaces::Pair& faces, const Vec3& x, double depth, int dimension, const Visit& visit) {
  const double at = x[faces.axis];
  if (at - faces.low >= depth && faces.high - at >= depth) return;  // most
  if (at < faces.low || at > faces.high) return;
  for (int a = 0; a < dimension; ++a)
    if (a != faces.axis && (x[a] < faces.window.low[a] - depth || x[a] > faces.window.high[a] + depth)) return;
  // False beyond reach.
  const auto offer = [&](double place, bool odd) {
    if (place <= faces.low - depth || place >= faces.high + depth) return false;
    if (faces.symmetric && place < faces.low) return true;
    Reflection image;
    image.place = x;
    image.place[faces.axis] = place;
    if (odd) image.normal[faces.axis] = 1.0;
    visit(image);
    return true;
  };
  const bool both = faces.low > -1e299 && faces.high < 1e299;
  if (!both) {
    offer(2.0 * (faces.low > -1e299 ? faces.low : faces.high) - at, true);
    return;
  }
  for (int side = 0; side < 2; ++side) {
    double place = at;
    bool odd = true;
    for (int k = 0;; ++k, odd = !odd) {
      place = 2.0 * ((k + side) % 2 == 0 ? faces.low : faces.high) - place;
      if (!offer(place, odd)) break;
    }
  }
  return;
}

/// Calls visit(Reflection, place it is an image of, that place's number) for all images in a cone's side and its ends; visit
/// numbers them, x has -1. Edges are no right angles, and the image of an image depends on the order of the faces: images are
/// mirrored on, in side and ends by turns, and stand where they lie on the part of the face that came last.
template <class Visit>
void images_about(const SlipFaces::Round& side, const SlipFaces::Pair& ends, const Vec3& x, double depth, int dimension,
                  Visit visit) {
  constexpr int most = 6;  // mirrors one after the other
  struct Seen {
    Vec3 place;
    int number, mirrors;
    bool in_side;
  };
  std::vector<Seen> seen{{x, -1, 0, false}};
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Seen from = seen[k];
    if (from.mirrors == most) continue;
    const auto offer = [&](const Reflection& image, bool in_side) {
      if (side.shows(image.place) == in_side)
        seen.push_back({image.place, visit(image, from.place, from.number), from.mirrors + 1, in_side});
    };
    if (from.mirrors == 0 || !from.in_side)
      if (const auto image = image_in(side, from.place, depth, dimension)) offer(*image, true);
    if (from.mirrors == 0 || from.in_side)
      images_in(ends, from.place, depth, dimension, [&](const Reflection& image) { offer(image, false); });
  }
}

/// Where a place beyond a face belongs.
struct Crossing {
  Vec3 place, normal, foot;
};

/// Is a place beyond one of the faces? Nearly none is, and all are asked.
inline bool is_beyond(const SlipFaces::Pair& faces, const Vec3& x) {
  const double at = x[faces.axis];
  return (at < faces.low && !faces.symmetric) || at > faces.high;
}

/// Of a place beyond the face by no more than `far` [m]; beyond that it is not this wall's.
std::optional<Crossing> crossing(const SlipFaces::Round& wall, const Vec3& x, double far);
std::optional<Crossing> crossing(const SlipFaces::Pair& faces, const Vec3& x, double far, int dimension);

}  // namespace undex::sph
