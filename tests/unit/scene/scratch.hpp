// Scenes written by a test, and what the reader says of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/study.hpp"

namespace undex::scene::test {

/// A folder of its own that goes with the object.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path write(const std::string& text, const std::string& name = "case.toml") const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// The readers, with all comparisons that there are.
Scene read(const std::filesystem::path& path, const std::vector<Override>& overrides = {});
Study read_study(const std::filesystem::path& path);

Scene read_text(const std::string& text, const std::vector<Override>& overrides = {});

/// The reader's findings, one line each, "line:column: message"; empty where the scene is good.
std::string mistakes(const std::string& text, const std::vector<Override>& overrides = {});

/// `text` with its one occurrence of `old` replaced.
std::string with(std::string text, const std::string& old, const std::string& replacement);

/// Small, good scenes: a coupled tube, a gas in one dimension, and of solids in particles an impact and a disc in water.
extern const std::string coupled_tube, two_gases, impact, bathed_disc;

}  // namespace undex::scene::test
