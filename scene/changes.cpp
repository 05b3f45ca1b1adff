#include "scene/changes.hpp"

#include <algorithm>

#include "scene/document.hpp"

namespace undex::scene {
namespace {

/// Nothing that a step computes depends on them.
constexpr const char* free_keys[] = {"end_time", "threads", "title", "output", "comparison"};

std::string shown(const Node* node) { return node ? toml_value(*node) : "nothing"; }

bool is_list_of_tables(const Node* node) {
  return node && node->kind == Node::Kind::array && !node->items.empty() && node->items.front().kind == Node::Kind::table;
}

/// The elements under their names, or their numbers where they have none.
Node as_table(const Node& list) {
  Node table;
  for (const Node& item : list.items) {
    const Node* name = item.find("name");
    table.entries.push_back({name ? name->text : std::to_string(table.entries.size()), item.where, item});
  }
  return table;
}

/// Of tables and lists of tables: by keys; of anything else: by what it would be as text.
void compare(const Node* before, const Node* after, const std::string& path, std::vector<std::string>& changes) {
  if (is_list_of_tables(before) && is_list_of_tables(after)) {
    const Node one = as_table(*before), other = as_table(*after);
    return compare(&one, &other, path, changes);
  }
  const auto is_table = [](const Node* node) { return node && node->kind == Node::Kind::table; };
  if (!is_table(before) || !is_table(after)) {
    if (shown(before) != shown(after)) changes.push_back(path + " (was " + shown(before) + ", is " + shown(after) + ")");
    return;
  }
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  for (const Entry& entry : before->entries) compare(&entry.node, after->find(entry.key), below(entry.key), changes);
  for (const Entry& entry : after->entries)
    if (!before->find(entry.key)) compare(nullptr, &entry.node, below(entry.key), changes);
}

/// Each element of the list `key` of before is there as it was.
void compare_named(const std::string& key, const Node* before, const Node* after, std::vector<std::string>& changes) {
  const auto named = [](const Node& node) {
    const Node* name = node.find("name");
    return name ? name->text : std::string();
  };
  if (!before) return;
  for (const Node& each : before->items) {
    const Node* now = nullptr;
    if (after)
      for (const Node& other : after->items)
        if (named(other) == named(each)) now = &other;
    compare(&each, now, key + '.' + named(each), changes);
  }
}

Node without_free_keys(Node root) {
  std::erase_if(root.entries, [](const Entry& entry) {
    return entry.key == "probes" || entry.key == "lines" ||
           std::any_of(std::begin(free_keys), std::end(free_keys), [&](const char* key) { return entry.key == key; });
  });
  return root;
}

}  // namespace

std::vector<std::string> changes_of_state(const std::string& before, const std::string& after) {
  const Node then = parse_toml(before, "the checkpoint's scene"), now = parse_toml(after, "resolved.toml");
  std::vector<std::string> changes;
  const Node then_state = without_free_keys(then), now_state = without_free_keys(now);
  compare(&then_state, &now_state, "", changes);
  for (const char* list : {"probes", "lines"}) compare_named(list, then.find(list), now.find(list), changes);
  return changes;
}

}  // namespace undex::scene
