// Shapes: {type = "box" | "slab" | "sphere" | "cylinder" | "tube", ...}.
#include <algorithm>

#include "scene/draft.hpp"
#include "scene/numbers.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

const char* const size_remedy = "say where it is, in m";

bool ordered(const TableReader& table, const char* low_key, double low, const char* high_key, double high) {
  if (low < high) return true;
  table.complain(high_key,
                 table.path_of(high_key) + " = " + shortest(high) + " must be greater than " + low_key + " = " + shortest(low));
  return false;
}

bool read_box(const TableReader& table, Box& box) {
  bool good = table.need("low", "give the lowest corner, e.g. low = [0, 0, 0]");
  good &= table.need("high", "give the highest corner, e.g. high = [1, 1, 1]");
  good = good && table.read("low", box.low) & table.read("high", box.high);
  for (int a = 0; good && a < table.dimension(); ++a)
    if (!(box.low[a] < box.high[a])) {
      table.complain("high", table.path_of("high") + ": along " + "xyz"[a] + ", high = " + shortest(box.high[a]) +
                                 " must be greater than low = " + shortest(box.low[a]));
      good = false;
    }
  return good;
}

/// low..high along the axis of a round body; unit depth where the scene has no such axis.
bool read_extent(const TableReader& table, int axis, double& low, double& high) {
  low = 0;
  high = 1;
  if (axis >= table.dimension()) {
    double ignored = 0;
    return table.read("low", ignored) | table.read("high", ignored) | true;
  }
  bool good = table.need("low", size_remedy);
  good &= table.need("high", size_remedy);
  good = good && table.read("low", low) & table.read("high", high);
  return good && ordered(table, "low", low, "high", high);
}

/// Where it is present it must be good.
bool read_if_there(const TableReader& table, const char* key, Vec3& into) { return !table.has(key) || table.read(key, into); }

bool read_axis_if_there(const TableReader& table, int& axis) {
  axis = 2;
  return !table.has("axis") || table.read_axis("axis", axis);
}

bool read_one(const TableReader& table, const std::string& type, Primitive& into) {
  if (type == "box") {
    Box box{Vec3::Zero(), Vec3::Zero()};
    if (!read_box(table, box)) return false;
    into = box;
  } else if (type == "slab") {
    Slab slab{0, 0, 0};
    bool good = table.need("axis", "say across which axis it lies, e.g. axis = \"x\"") && table.read_axis("axis", slab.axis);
    if (good && slab.axis >= table.dimension()) {
      table.complain("axis", table.path_of("axis") + ": the scene has dimension = " + std::to_string(table.dimension()) +
                                 ", so no such axis");
      good = false;
    }
    double low = 0, high = 0;
    if (!(read_extent(table, good ? slab.axis : 0, low, high) & good)) return false;
    into = Slab{slab.axis, low, high};
  } else if (type == "sphere") {
    Sphere sphere{Vec3::Zero(), 0};
    if (!(read_if_there(table, "center", sphere.center) & table.need("radius", "give it in m"))) return false;
    if (!table.read("radius", sphere.radius)) return false;
    into = sphere;
  } else if (type == "cylinder") {
    Cylinder c{2, Vec3::Zero(), 0, 0, 1};
    bool good = read_axis_if_there(table, c.axis);
    good &= read_if_there(table, "center", c.center);
    good &= table.need("radius", "give it in m") && table.read("radius", c.radius);
    good &= read_extent(table, c.axis, c.low, c.high);
    if (!good) return false;
    c.center[c.axis] = 0;
    into = c;
  } else {
    TubeShape t{2, Vec3::Zero(), 0, 0, 0, 1};
    bool good = read_axis_if_there(table, t.axis);
    good &= read_if_there(table, "center", t.center);
    good &= table.need("inner_radius", "give it in m") && table.read("inner_radius", t.inner);
    good &= table.need("outer_radius", "give it in m") && table.read("outer_radius", t.outer);
    good &= read_extent(table, t.axis, t.low, t.high);
    if (!good || !ordered(table, "inner_radius", t.inner, "outer_radius", t.outer)) return false;
    t.center[t.axis] = 0;
    into = t;
  }
  return true;
}

}  // namespace

bool read_shape(const Node& node, const std::string& path, int dimension, const std::vector<std::string>& allowed, Report& report,
                Primitive& into) {
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
  if (type->kind != Node::Kind::text || std::find(allowed.begin(), allowed.end(), type->text) == allowed.end()) {
    report.add(*type, path + ".type must be one of " + listed(allowed) + ", not " + type->described() +
                          (nearest(type->text, allowed).empty() ? "" : suggestion(type->text, allowed)));
    return false;
  }
  const std::size_t before = report.size();
  const TableReader table(node, path, "shape." + type->text, dimension, report);
  return read_one(table, type->text, into) && report.size() == before;
}

}  // namespace undex::scene
