// The mistakes found so far in a scene: they are collected, so that the user gets all of them at once.
#pragma once

#include <string>
#include <vector>

#include "core/errors.hpp"
#include "scene/document.hpp"

namespace undex::scene {

class Report {
 public:
  void add(Where where, std::string message) { findings_.push_back({where, std::move(message)}); }
  void add(Finding finding) { findings_.push_back(std::move(finding)); }
  /// At a value of the scene, or at the command-line override that gave it.
  void add(const Node& node, const std::string& message) { add_at(node.where, node.origin, message); }
  /// At the key.
  void add(const Entry& entry, const std::string& message) { add_at(entry.where, entry.node.origin, message); }

  bool empty() const { return findings_.empty(); }
  std::size_t size() const { return findings_.size(); }
  const std::vector<Finding>& findings() const { return findings_; }

 private:
  void add_at(Where where, const std::string& origin, const std::string& message) {
    if (origin.empty()) add(where, message);
    else add(Where{}, origin + ": " + message);
  }
  std::vector<Finding> findings_;
};

}  // namespace undex::scene
