// Values of a scene as TOML text.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/record.hpp"
#include "core/shapes.hpp"
#include "scene/alternatives.hpp"
#include "scene/dimension.hpp"
#include "scene/document.hpp"
#include "scene/numbers.hpp"

namespace undex::scene {

/// A number that TOML takes for one that is not whole.
inline std::string number(double value) {
  std::string text = shortest(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

template <class Values, class Write>
std::string array(const Values& values, Write write) {
  std::string text = "[";
  for (const auto& value : values) text += (text.size() > 1 ? ", " : "") + write(value);
  return text + "]";
}

inline std::string axis_name(int axis) { return std::string(1, "xyz"[axis]); }

/// A value as TOML, as the form of its key says. Empty: it is not written.
class TomlValues {
 public:
  explicit TomlValues(int dimension, std::string (*of_number)(double) = number) : dimension_(dimension), number_(of_number) {}

  std::string text(double value) const { return number_(value); }
  std::string text(bool value) const { return value ? "true" : "false"; }
  std::string text(int value) const { return std::to_string(value); }
  std::string text(const char* value) const { return quoted(value); }
  std::string text(const std::string& value) const { return quoted(value); }
  std::string text(const Vec3& value) const {
    return array(std::vector<double>(value.data(), value.data() + dimension_), number_);
  }
  std::string text(const std::vector<double>& values) const { return array(values, number_); }
  std::string text(const std::vector<std::string>& values) const { return array(values, quoted); }
  std::string text(const std::array<bool, 3>& marked) const {
    std::vector<std::string> names;
    for (int a = 0; a < 3; ++a)
      if (marked[a]) names.push_back(axis_name(a));
    return text(names);
  }
  template <Worded Enum>
  std::string text(Enum value) const {
    return quoted(word_of(value));
  }
  template <class Value>
  std::string text(const std::optional<Value>& value) const {
    return value ? text(*value) : "";
  }
  std::string text(const std::vector<Primitive>& shapes) const {
    return shapes.empty() ? "" : array(shapes, [&](const Primitive& shape) { return inline_table(shape); });
  }
  std::string text(const Polygon& points) const {
    return array(points, [&](const auto& point) { return array(point, number_); });
  }
  std::string text(const Dimension& value) const {
    return value.geometry == Geometry::cartesian ? text(value.coordinates) : text(value.geometry);
  }
  std::string text(const ByHand&) const { return ""; }

  template <class Member>
  std::string text(const Key&, const Member& member) const {
    return text(member);
  }
  std::string text(const Key& key, const int& value) const {
    return key.form == Form::plain ? text(value) : quoted(axis_name(value));
  }
  std::string text(const Key& key, const bool& value) const { return *key.no ? quoted(value ? key.yes : key.no) : text(value); }
  std::string text(const Key& key, const Vec3& value) const {
    if (key.form != Form::turn || dimension_ == 3) return text(value);
    return dimension_ == 2 ? text(value[2]) : "";  // nothing is left to turn about in one dimension
  }

  /// {type = "box", low = [0, 0], ...}
  std::string inline_table(const Primitive& shape) const {
    std::string line;
    for_each_shape_key(shape, [&](const char* key, const std::string& value) {
      if (!value.empty()) line += (line.empty() ? "{" : ", ") + std::string(key) + " = " + value;
    });
    return line + "}";
  }
  /// visit(key, text) for the type of a shape, its keys and those of its placements.
  void for_each_shape_key(const Primitive& shape, auto&& visit) const {
    const auto keys_of = [&](const auto& each) {
      for_each_field(each, [&](const auto& member, const Key& key) { visit(key.name, text(key, member)); });
    };
    if (const auto* placed = std::get_if<Placed>(&shape)) {
      for_each_shape_key(placed->shape[0], visit);
      return keys_of(*placed);
    }
    visit("type", quoted(name_of(shape)));
    std::visit(keys_of, shape);
  }
  int dimension() const { return dimension_; }

 private:
  int dimension_;
  std::string (*number_)(double);
};

}  // namespace undex::scene
