// Where a scene file says what: for messages of those who meet a scene after it was read.
#pragma once

#include <map>
#include <string>

#include "core/errors.hpp"

namespace undex::scene {

struct Node;

class Places {
 public:
  Places() = default;
  explicit Places(const Node& root);

  /// A finding at the key with this dotted path ("bodies.water.shape"; elements of lists by their names, else by their numbers),
  /// or at the nearest table round it that the file has.
  Finding finding(const std::string& path, const std::string& message) const;

 private:
  struct Place {
    Where where;
    std::string origin;  ///< "-P key" where the command line gave it
  };
  void add(const Node& node, const std::string& path);
  std::map<std::string, Place> places_;
};

}  // namespace undex::scene
