// docs/scene-file.md names every key, with its unit, and its examples are good scenes.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "materials/library.hpp"
#include "scene/schema.hpp"
#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene;
using namespace undex::scene::test;

std::string page() {
  std::ifstream file(std::string(UNDEX_ROOT) + "/docs/scene-file.md");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Documentation, NamesEveryKeyWithItsUnit) {
  const std::string text = page();
  for (const Section& section : schema())
    for (const Key& key : section.keys) {
      bool found = false;
      for (auto at = text.find('`' + key.name + '`'); at != std::string::npos && !found; at = text.find('`' + key.name + '`', at + 1)) {
        const auto begin = text.rfind('\n', at) + 1;
        const std::string line = text.substr(begin, text.find('\n', at) - begin);
        found = key.unit.empty() || line.find("| " + key.unit + " |") != std::string::npos;
      }
      EXPECT_TRUE(found) << "[" << section.name << "] " << key.name << " [" << key.unit << "]";
    }
}

TEST(Documentation, ExamplesAreGoodScenes) {
  const std::string text = page();
  int count = 0;
  for (auto at = text.find("```toml\n"); at != std::string::npos; at = text.find("```toml\n", at + 1)) {
    const auto begin = at + 8;
    const std::string example = text.substr(begin, text.find("```", begin) - begin);
    if (example.find("end_time") == std::string::npos) continue;  // a fragment
    ++count;
    EXPECT_EQ(mistakes(example), "") << example;
  }
  EXPECT_GE(count, 4);
}

}  // namespace
