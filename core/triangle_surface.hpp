// A closed surface of triangles, as STL files have it: the one place that knows the library behind it.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "core/vector.hpp"

namespace undex {

/// Triangles that enclose a body, each with its corners counterclockwise seen from outside. Immutable; threads may share it.
class TriangleSurface {
 public:
  /// Of the text of an STL file, ASCII or binary, lengths times `scale` giving metres; `path` is for messages. Corners at one
  /// place are one. Throws std::invalid_argument with a message "path: what is wrong, where [m]; remedy" for a file that is cut
  /// off, empty, of more than 5 million triangles or with a coordinate that is no number, and for a surface with flat
  /// triangles, edges of one triangle or of more than two, triangles turned against their neighbours, parts that cross or meet
  /// in a corner only, or that is turned inside out.
  static std::shared_ptr<const TriangleSurface> parse(std::string_view text, const std::string& path, double scale);
  /// The same of a file. Throws std::invalid_argument too where it cannot be read or has more than 2 GB.
  static std::shared_ptr<const TriangleSurface> read(const std::string& path, double scale);

  TriangleSurface(TriangleSurface&&) = delete;
  ~TriangleSurface();

  /// From x to the nearest triangle, negative inside [m]; exact up to rounding, but `beyond` (negative inside) where it is no
  /// less. In the middle of a ball all triangles are as near, and the nearest takes long to find; `beyond` does not.
  double signed_distance(const Vec3& x, double beyond = std::numeric_limits<double>::infinity()) const;
  const Bounds& bounds() const;
  /// The largest x.d of its points [m] for a direction d.
  double reach(const Vec3& direction) const;
  double volume() const;  ///< [m^3]
  /// Of the part within a window [m^3], exact.
  double volume(const Bounds& window) const;
  const Vec3& centroid() const;       ///< of the body of uniform density [m]
  const Mat3& second_moment() const;  ///< integral of (x - centroid) (x - centroid)^T [m^5]
  std::size_t triangle_count() const;

 private:
  struct Implementation;
  explicit TriangleSurface(std::unique_ptr<Implementation> self);
  std::unique_ptr<Implementation> self_;
};

}  // namespace undex
