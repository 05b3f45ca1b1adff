#include "study/run_settings.hpp"

#include <algorithm>

#include "scene/dimension.hpp"
#include "scene/document.hpp"
#include "scene/numbers.hpp"

namespace undex::study {
namespace {

using scene::Entry;
using scene::in_file_order;
using scene::Node;

void append(std::string& text, const char* separator, const std::string& part) {
  if (!text.empty()) text += separator;
  text += part;
}

std::string value_text(const Node& node) {
  switch (node.kind) {
    case Node::Kind::boolean: return node.boolean ? "true" : "false";
    case Node::Kind::integer: return std::to_string(node.integer);
    case Node::Kind::number: return scene::shortest(node.number);
    case Node::Kind::text: return node.text;
    default: break;
  }
  std::string text;
  for (const Node& item : node.items) append(text, " ", value_text(item));
  for (const Entry& entry : node.entries) append(text, " ", value_text(entry.node));
  return text;
}

std::string text_at(const Node& table, const char* key) {
  const Node* found = table.find(key);
  return found ? value_text(*found) : "";
}

void flatten(const Node& node, const std::string& path, RunSettings& settings) {
  for (const Entry* entry : in_file_order(node)) {
    const std::string key = path.empty() ? entry->key : path + "." + entry->key;
    if (is_silent(key)) continue;
    const Node& value = entry->node;
    if (entry->key == "cells" && value.kind == Node::Kind::table) {
      std::string cells;
      for (const Entry* part : in_file_order(value)) append(cells, "x", value_text(part->node));
      settings.emplace_back(key, cells);
    } else if (value.kind == Node::Kind::table) {
      flatten(value, key, settings);
    } else if (value.kind == Node::Kind::array && !value.items.empty() && value.items[0].kind == Node::Kind::table) {
      for (std::size_t i = 0; i < value.items.size(); ++i) {
        const std::string name = text_at(value.items[i], "name");
        flatten(value.items[i], key + "." + (name.empty() ? std::to_string(i) : name), settings);
      }
    } else {
      settings.emplace_back(key, value_text(value));
    }
  }
}

Vec3 vector_at(const Node& table, const char* key) {
  Vec3 result = Vec3::Zero();
  const Node* found = table.find(key);
  for (std::size_t a = 0; found && a < std::min<std::size_t>(3, found->items.size()); ++a)
    result[static_cast<int>(a)] = found->items[a].number;
  return result;
}

/// What a body is round about; nothing where it is not round.
std::optional<judge::Axis> axis_of(const Node& body) {
  const Node* shape = body.find("shape");
  if (!shape) return std::nullopt;
  const std::string type = text_at(*shape, "type"), axis = text_at(*shape, "axis");
  if (type != "tube" && type != "rod" && type != "cylinder") return std::nullopt;
  return judge::Axis{axis == "x" ? 0 : axis == "y" ? 1 : 2, vector_at(*shape, "center")};
}

/// That of which energies are counted: whole rings and spheres are of space.
int dimension_of(const Node& node) {
  if (node.kind != Node::Kind::text) return static_cast<int>(node.integer);
  for (const auto& [word, geometry] : words(scene::Geometry{}))
    if (node.text == word) return scene::coordinates_of(geometry);
  return 3;
}

}  // namespace

ResolvedScene read_resolved(const std::string& text, const std::string& file) {
  const Node root = scene::parse_toml(text, file);
  ResolvedScene result;
  if (const Node* dimension = root.find("dimension")) result.dimension = dimension_of(*dimension);
  flatten(root, "", result.settings);
  if (const Node* probes = root.find("probes"))
    for (const Node& probe : probes->items) {
      const std::string name = text_at(probe, "name");
      result.probes[name] = {text_at(probe, "kind"), vector_at(probe, "point")};
      result.probe_order.push_back(name);
    }
  if (const Node* comparison = root.find("comparison")) result.compared_probe = text_at(*comparison, "probe");
  // What all structures or, in particles, the first solid are round about.
  const Node *body = root.find("structure"), *structures = root.find("structures"), *solids = root.find("solids");
  if (structures && !structures->items.empty()) {
    result.axis = axis_of(structures->items[0]);
    for (const Node& each : structures->items)
      if (axis_of(each) != result.axis) {
        result.axis.reset();
        break;
      }
  } else if (body || (solids && !solids->items.empty())) {
    result.axis = axis_of(body ? *body : solids->items[0]);
  }
  return result;
}

}  // namespace undex::study
