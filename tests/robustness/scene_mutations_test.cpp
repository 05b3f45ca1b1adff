// Damaged scenes: whatever is done to a scene file, the reader either reads it or throws SceneError.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "core/errors.hpp"
#include "judge/comparisons.hpp"
#include "scene/scene.hpp"
#include "scene/study.hpp"

namespace {

namespace fs = std::filesystem;
using namespace undex;

const std::vector<scene::ComparisonKind>& kinds = judge::comparison_kinds();

int setting(const char* name, int usual) {
  const char* given = std::getenv(name);
  return given ? std::atoi(given) : usual;
}

/// UNDEX_MUTATIONS sets how many damaged scenes are tried per kind of damage, UNDEX_SEED which ones.
int tries() { return setting("UNDEX_MUTATIONS", 400); }

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class SceneMutations : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const auto& entry : fs::directory_iterator(fs::path(UNDEX_ROOT) / "cases"))
      if (fs::exists(entry.path() / "case.toml")) {
        const std::string written = text_of(entry.path() / "case.toml");
        scenes_.push_back(written);
        try {  // also the long form
          scenes_.push_back(scene::to_toml(scene::read(entry.path(), kinds)));
        } catch (const SceneError&) {
        }
      }
    std::sort(scenes_.begin(), scenes_.end());
    ASSERT_FALSE(scenes_.empty());
    const fs::path base = fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path();
    folder_ = base / ("undex_robustness_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    std::printf("%d read, %d refused\n", good_, refused_);
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  /// Reads a damaged scene; anything but success and SceneError fails the test.
  void survives(const std::string& text, const std::vector<scene::Override>& overrides = {}) {
    const fs::path file = folder_ / "case.toml";
    std::ofstream(file, std::ios::binary) << text;
    const std::clock_t since = std::clock();  // CPU time: others may be on the machine
    try {
      const scene::Scene read = scene::read(file, kinds, overrides);
      ++good_;
      EXPECT_EQ(scene::to_toml(
                    scene::read((std::ofstream(folder_ / "again.toml") << scene::to_toml(read), folder_ / "again.toml"), kinds)),
                scene::to_toml(read));
    } catch (const SceneError& error) {
      ++refused_;
      EXPECT_FALSE(error.findings().empty());
    } catch (const std::exception& error) {
      ADD_FAILURE() << "threw " << error.what() << " on\n" << text;
    }
    EXPECT_LT(static_cast<double>(std::clock() - since) / CLOCKS_PER_SEC, 20.0) << text;
  }

  std::string& any_scene() {
    copy_ = scenes_[below(scenes_.size())];
    return copy_;
  }
  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  /// Start and length of a random number in the text; length 0 where there is none.
  std::pair<std::size_t, std::size_t> any_number(const std::string& text) {
    const std::string digits = "0123456789.e-+";
    for (int attempt = 0; attempt < 100; ++attempt) {
      const std::size_t from = below(text.size());
      const std::size_t at = text.find_first_of("0123456789", from);
      if (at == std::string::npos || at == 0 || std::string(" [,-").find(text[at - 1]) == std::string::npos) continue;
      const std::size_t end = text.find_first_not_of(digits, at);
      return {at, (end == std::string::npos ? text.size() : end) - at};
    }
    return {0, 0};
  }

  std::mt19937 random_{static_cast<unsigned>(setting("UNDEX_SEED", 20240229))};
  std::vector<std::string> scenes_;
  std::string copy_;
  fs::path folder_;
  int good_ = 0, refused_ = 0;
};

TEST_F(SceneMutations, Truncated) {
  for (int i = 0; i < tries(); ++i) {
    std::string& text = any_scene();
    survives(text.substr(0, below(text.size())));
  }
}

TEST_F(SceneMutations, BytesReplaced) {
  for (int i = 0; i < tries(); ++i) {
    std::string& text = any_scene();
    for (std::size_t k = 0, count = 1 + below(4); k < count; ++k)
      text[below(text.size())] = static_cast<char>(below(3) ? " \n\"[]{}=.,#-0x"[below(14)] : static_cast<int>(below(256)));
    survives(text);
  }
}

TEST_F(SceneMutations, LinesRemovedAndRepeated) {
  for (int i = 0; i < tries(); ++i) {
    std::string& text = any_scene();
    const std::size_t from = text.rfind('\n', below(text.size()));
    const std::size_t begin = from == std::string::npos ? 0 : from + 1, end = text.find('\n', begin);
    const std::string line = text.substr(begin, end == std::string::npos ? end : end - begin + 1);
    if (below(2)) text.erase(begin, line.size());
    else text.insert(begin, line);
    survives(text);
  }
}

TEST_F(SceneMutations, NumbersReplaced) {
  const std::vector<std::string> values{"0",          "-1",      "1e300", "-1e300", "1e-300", "inf", "nan", "9223372036854775807",
                                        "1e-9",       "1e9",     "\"\"",  "[]",     "{}",     "1",   "2",   "0.5",
                                        "1979-05-27", "[[[1]]]", "1e5",   "-0.0"};
  for (int i = 0; i < 2 * tries(); ++i) {
    std::string& text = any_scene();
    for (std::size_t k = 0, count = 1 + below(2); k < count; ++k)
      if (const auto [at, length] = any_number(text); length > 0) text.replace(at, length, values[below(values.size())]);
    survives(text);
  }
}

TEST_F(SceneMutations, ScenesSpliced) {
  for (int i = 0; i < tries(); ++i) {
    const std::string head = any_scene();
    const std::string tail = any_scene();
    survives(head.substr(0, below(head.size())) + '\n' + tail.substr(below(tail.size())));
  }
}

TEST_F(SceneMutations, WildOverrides) {
  const std::vector<std::string> words{"bodies",   "water",      "0",         "1",          "shape", "low",
                                       "material", "burn",       "structure", "structures", "cells", "symmetry",
                                       "planes",   "resolution", "spacing",   "x",          "",      "99999999999999999999",
                                       "probes"};
  const std::vector<std::string> values{
      "1", "-1", "[]",  "{}", "[1, 2]", "word", "\"", "{a = 1}", "1\n", "[\"x\"]", "inf", "\"petn\"", "{base = \"petn\"}",
      "",  "[[", "true"};
  for (int i = 0; i < tries(); ++i) {
    std::string path = words[below(words.size())];
    for (std::size_t k = 0, count = below(4); k < count; ++k) path += '.' + words[below(words.size())];
    survives(any_scene(), {{path, values[below(values.size())]}});
  }
}

/// Studies are read, or refused with SceneError, whatever is done to them; each read is one of many scenes.
TEST_F(SceneMutations, StudiesDamaged) {
  const std::string sound = text_of(fs::path(UNDEX_ROOT) / "cases/sjogreen/study.toml");
  fs::copy_file(fs::path(UNDEX_ROOT) / "cases/sjogreen/case.toml", folder_ / "case.toml", fs::copy_options::overwrite_existing);
  const auto survives_as_study = [&](const std::string& text) {
    std::ofstream(folder_ / "study.toml", std::ios::binary) << text;
    try {
      EXPECT_FALSE(scene::read_study(folder_, kinds).runs.empty());
      ++good_;
    } catch (const SceneError& error) {
      ++refused_;
      EXPECT_FALSE(error.findings().empty());
    } catch (const std::exception& error) {
      ADD_FAILURE() << "threw " << error.what() << " on\n" << text;
    }
  };
  survives_as_study(sound);
  EXPECT_EQ(good_, 1);
  const std::string marks = "[]{}=\".,#\n x1-";
  for (int i = 0; i < tries() / 4; ++i) {
    std::string text = sound;
    for (std::size_t k = 0, count = 1 + below(4); k < count; ++k) text[below(text.size())] = marks[below(marks.size())];
    survives_as_study(text);
    const std::size_t from = below(sound.size());
    survives_as_study(sound.substr(0, from) + sound.substr(std::min(sound.size(), from + below(60))));
  }
  for (const char* text :
       {"", "axes = 3", "[[axes]]\n[[axes]]", "exclude = 1", "scenes = 7", "[axes]\nname = 1", "settings = []", "errors = {}"})
    survives_as_study(text);
}

/// Pieces of TOML and bytes that are no text, put together at random: much of it goes where no mutation of a sound file leads.
TEST_F(SceneMutations, AnyBytes) {
  const std::vector<std::string> pieces{"\"",
                                        "\"\"\"",
                                        "'''",
                                        "'",
                                        "\\",
                                        "\\u",
                                        "\\U0010FFFF",
                                        "#",
                                        "[",
                                        "]",
                                        "[[",
                                        "]]",
                                        "{",
                                        "}",
                                        "=",
                                        ".",
                                        ",",
                                        "\n",
                                        "\r\n",
                                        "\r",
                                        "\t",
                                        " ",
                                        "a",
                                        "0x",
                                        "1e",
                                        "+",
                                        "-",
                                        "_",
                                        "inf",
                                        "nan",
                                        "true",
                                        ":",
                                        "T",
                                        "Z",
                                        "1979-05-27",
                                        "07:32:00",
                                        "\x7f",
                                        "\xef\xbb\xbf",
                                        "\xc3\xa4",
                                        "\xf4\x90\x80\x80",
                                        "\xed\xa0\x80",
                                        "\xc0\x80",
                                        "\xff",
                                        "\xe2\x80\xa8",
                                        std::string(1, '\0')};
  for (int i = 0; i < 10 * tries(); ++i) {
    std::string text = below(2) ? "end_time = " : "";
    for (std::size_t k = 0, count = 1 + below(12); k < count; ++k) text += pieces[below(pieces.size())];
    survives(text);
    for (std::size_t k = 0, count = below(20); k < count; ++k) text += static_cast<char>(below(256));
    survives(text);
  }
}

TEST_F(SceneMutations, WhatIsNoTextIsNamedWithItsPlace) {
  const auto message = [&](const std::string& text) {
    const fs::path file = folder_ / "case.toml";
    std::ofstream(file, std::ios::binary) << text;
    try {
      scene::read(file, kinds);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto says = [&](const std::string& text, const std::string& wanted) {
    EXPECT_NE(message(text).find("case.toml:" + wanted), std::string::npos) << message(text).substr(0, 300);
  };
  says("\xff\xfe\x01", "1:1: not TOML: the byte 0xff is no UTF-8");
  says("end_time = 1\n# \xc3\xa4 \xe9\n", "2:5: not TOML: the byte 0xe9 is no UTF-8");
  says("title = \"\xed\xa0\x80\"", "1:10: not TOML: the byte 0xed");
  says(std::string("end_time\0= 1", 12), "1:9: not TOML: the control character 0x00");
  // Letters that the parser looks at where white space may be.
  for (const std::string letter : {"\xc3\xa4", "\xe2\x80\xa8", "\xe1\x9a\x81", "\xef\xbb\xbe"}) {
    says("end_time = 1\n" + letter + " = 1", "2:1: not TOML");
    EXPECT_EQ(message("title = \"\"\"\\\n  " + letter + "\"\"\"").find("not TOML"), std::string::npos) << letter;
  }
  std::string deep = "a";
  for (int i = 0; i < 200000; ++i) deep += ".\"#b\"";
  for (const std::string& text : {deep + " = 1", '[' + deep + ']', "a = {" + deep + " = 1}"}) says("end_time = 1\n" + text, "2:");
  EXPECT_NE(message(deep + " = 1").find("a key of more than 32 parts"), std::string::npos);
  // None of it is a key of many parts.
  std::string list = "x = [0.5";
  for (int i = 0; i < 2000; ++i) list += ", 0.5";
  const std::string dots(500, '.');
  for (const std::string& text :
       {list + "]", "# " + dots, "title = \"" + dots + "\"", "title = \"\\\"" + dots + "\"", "title = '" + dots + "'"})
    EXPECT_EQ(message(text).find("not TOML"), std::string::npos) << message(text).substr(0, 200);
}

TEST_F(SceneMutations, DeepAndEmpty) {
  survives("");
  survives("\xff\xfe");
  survives("a = " + std::string(100000, '['));
  survives("a = " + std::string(5000, '{'));
  survives(std::string(100000, '\n') + "end_time = 1");
  std::string dotted = "a";
  for (int i = 0; i < 2000; ++i) dotted += ".a";
  survives(dotted + " = 1");
  survives("end_time = 1\n[[bodies]]\n[[bodies]]\n[[probes]]\n[[walls]]\n[structure]\n");
  survives("end_time = 1\n[[bodies]]\n[[structures]]\n[[structures]]\n[structure]\n");
  survives("end_time = 1\nstructures = 3\n[coupling]\n");
}

}  // namespace
