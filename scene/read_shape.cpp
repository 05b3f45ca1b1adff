// Shapes: {type = "box", ...}, those made of other shapes, and their placements.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "core/triangle_surface.hpp"
#include "scene/draft.hpp"
#include "scene/numbers.hpp"
#include "scene/record_reader.hpp"
#include "scene/suggestion.hpp"

namespace undex::scene {
namespace {

/// Of a cone in fewer than three dimensions the section through its axis is meant, and one radius is more than nothing.
void check_cone(const TableReader& table, const Cone& cone) {
  if (table.dimension() == 1)
    table.complain("type", table.path() + ": a cone needs dimension = 2 or 3; in one dimension take a \"box\"");
  else if (cone.axis >= table.dimension())
    table.complain("axis", table.path_of("axis") +
                               ": in two dimensions a cone lies along \"x\" or \"y\"; for a disc take a "
                               "\"cylinder\"");
  if (table.has("low_radius") && cone.low_radius == 0 && cone.high_radius == 0)
    table.complain("low_radius", table.path() + ": both radii are 0, which leaves nothing of the cone; enlarge one");
}

/// Points off the axis or on it, none in between crossing.
void check_revolution(const TableReader& table, const Revolution& of) {
  const std::string path = table.path_of("points");
  if (table.dimension() == 1)
    return table.complain("type", table.path() + ": a revolution needs dimension = 2 or 3; in one dimension take a \"box\"");
  if (of.axis >= table.dimension())
    return table.complain("axis", table.path_of("axis") +
                                      ": in two dimensions a revolution lies along \"x\" or \"y\"; for discs "
                                      "and rings take \"cylinder\" and \"tube\"");
  const Polygon& p = of.points;
  if (p.size() < 3) return table.complain("points", path + " must have three corners or more");
  double area = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const auto& from = p[k];
    const auto& to = p[(k + 1) % p.size()];
    if (from[0] < 0)
      return table.complain("points", path + '.' + std::to_string(k) + ": r = " + shortest(from[0]) +
                                          " m is negative; give distances from the axis, of one side of the meridian");
    if (from == to)
      return table.complain("points", path + '.' + std::to_string(k) + ": this corner is the next one too; leave one out");
    area += 0.5 * (from[0] * to[1] - to[0] * from[1]);
  }
  if (area == 0) return table.complain("points", path + ": the polygon has no area; give its corners in turn");
  const auto turn = [](const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 2; j < p.size(); ++j) {
      if (i == 0 && j + 1 == p.size()) continue;
      const auto &a = p[i], &b = p[i + 1], &c = p[j], &d = p[(j + 1) % p.size()];
      if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0)
        return table.complain("points", path + ": the sides from corners " + std::to_string(i) + " and " + std::to_string(j) +
                                            " (from 0) cross; give the corners in turn");
    }
}

void read_surface(const TableReader& table, const Draft& draft, Stl& stl) {
  if (table.dimension() != 3)
    return table.complain("type", table.path() +
                                      ": a surface of triangles needs dimension = 3; in two dimensions take \"revolution\" or "
                                      "a \"union\" of plain shapes");
  const std::filesystem::path full = draft.scene.file.parent_path() / stl.file;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(full, ignored))
    return table.complain("file",
                          table.path_of("file") + ": no file '" + full.string() + "'; give it relative to the scene file");
  stl.file = std::filesystem::absolute(full).lexically_normal().string();
  try {
    stl.read = TriangleSurface::read(stl.file, stl.scale);
  } catch (const std::invalid_argument& mistake) {
    table.complain("file", table.path_of("file") + ": " + mistake.what());
  }
}

constexpr std::size_t most_parts = 1000, deepest = 20;

std::vector<std::string> names_for(ShapeUse use) {
  return Alternatives<Primitive>::names([use]<class Type>(std::type_identity<Type>) {
    const bool fits = use == ShapeUse::any || Type::is_bounded;
    return fits && !requires { Type::is_modifier; };
  });
}

/// The parts of a union, intersection or difference.
bool read_parts(const TableReader& table, Draft& draft, std::vector<Primitive>& into) {
  const Node* list = table.find("shapes");
  const std::string path = table.path_of("shapes");
  if (!list) return false;  // reported
  if (list->kind != Node::Kind::array || list->items.empty() || list->items.size() > most_parts) {
    table.complain("shapes",
                   path + " must be a list of 1 to " + std::to_string(most_parts) + " shapes, not " +
                       (list->kind == Node::Kind::array ? std::to_string(list->items.size()) + " of them" : list->described()));
    return false;
  }
  if (std::size_t(std::count(path.begin(), path.end(), '.')) > 2 * deepest) {
    table.complain("shapes", path + ": shapes lie more than " + std::to_string(deepest) + " deep in each other; join some");
    return false;
  }
  if (table.dimension() == 1) {
    table.complain("type", table.path() + ": in one dimension bodies are intervals; write a \"box\" for each, or subtract");
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    Primitive part;
    good = read_shape(list->items[i], path + '.' + std::to_string(i), draft, ShapeUse::any, part) && good;
    into.push_back(part);
  }
  return good;
}

/// Turns and moves the shape where the table says so.
void read_placement(const TableReader& table, Primitive& into) {
  if (!table.has("rotate") && !table.has("move")) {
    if (table.has("about"))
      table.complain("about", table.path_of("about") + " is of a shape that is turned; add rotate, or leave it out");
    return;
  }
  if (table.has("rotate") && table.dimension() == 1)
    return table.complain("rotate", table.path_of("rotate") + ": nothing turns in one dimension; leave it out");
  const std::size_t before = table.report().size();
  Placement placement;
  read_fields(table, placement);
  if (table.report().size() != before || (placement.rotate.isZero(0) && placement.move.isZero(0))) return;
  into = placed(into, placement, table.dimension());
}

}  // namespace

bool read_shape(const Node& node, const std::string& path, Draft& draft, ShapeUse use, Primitive& into) {
  Report& report = draft.report;
  const int dimension = draft.scene.fluid.dimension;
  const std::vector<std::string> allowed = names_for(use);
  const std::string example = "{type = \"" + allowed.front() + "\", ...}";
  if (node.kind != Node::Kind::table) {
    report.add(node, path + " must be a table, " + example + ", not " + node.described());
    return false;
  }
  const Node* type = node.find("type");
  if (!type) {
    report.add(node, path + ".type is missing; one of " + listed(allowed));
    return false;
  }
  if (!is_alternative(*type, path + ".type", allowed, report)) return false;
  const std::size_t before = report.size();
  const TableReader table(node, path, "shape." + type->text, dimension, report);
  Alternatives<Primitive>::with(type->text, [&]<class Type>(std::type_identity<Type>) {
    Type shape;
    read_fields(table, shape);
    if constexpr (requires { shape.shapes; }) {
      if (!read_parts(table, draft, shape.shapes)) return;
    }
    if (report.size() != before) return;
    if constexpr (std::is_same_v<Type, Cone>) check_cone(table, shape);
    if constexpr (std::is_same_v<Type, Revolution>) check_revolution(table, shape);
    if constexpr (std::is_same_v<Type, Stl>) read_surface(table, draft, shape);
    if constexpr (std::is_same_v<Type, HalfSpace>) {
      if (!(shape.normal.head(dimension).norm() > 0))
        table.complain("normal", table.path_of("normal") + " is zero; say which way is out of the half-space, e.g. [1, 0, 0]");
    }
    if (report.size() != before) return;
    into = shape;
    read_placement(table, into);
    if constexpr (requires { shape.shapes; }) {
      if (report.size() == before && use == ShapeUse::bounded && !is_bounded(into, dimension))
        report.add(node,
                   path + " has no end; take " + listed(names_for(use)) + ", or meet it with one of them (\"intersection\")");
    }
  });
  return report.size() == before;
}

}  // namespace undex::scene
