#include "scene/places.hpp"

#include "scene/draft.hpp"

namespace undex::scene {

Places::Places(const Node& root) { add(root, ""); }

void Places::add(const Node& node, const std::string& path) {
  places_.emplace(path, Place{node.where, node.origin});
  const std::string before = path.empty() ? path : path + '.';
  for (const Entry& entry : node.entries) add(entry.node, before + entry.key);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    if (node.items[i].kind == Node::Kind::table) add(node.items[i], element_path(path.c_str(), node.items[i], i));
}

Finding Places::finding(const std::string& path, const std::string& message) const {
  std::string at = path;
  auto found = places_.find(at);
  while (found == places_.end() && !at.empty()) {
    const std::size_t dot = at.rfind('.');
    at = dot == std::string::npos ? "" : at.substr(0, dot);
    found = places_.find(at);
  }
  if (found == places_.end()) return {{}, message};
  if (found->second.origin.empty()) return {found->second.where, message};
  return {{}, found->second.origin + ": " + message};
}

}  // namespace undex::scene
