// A study file: the grid that it spans, what is left out, and every mistake at its place.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/errors.hpp"
#include "scene/schema.hpp"
#include "scene/study.hpp"
#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene;
using namespace undex::scene::test;

const std::string study_text = R"(title = "Gas"
scene = "case.toml"
errors = ["energy_error"]

[[axes]]
name = "spacing"
key = "resolution.spacing"
values = [0.02, 0.01]

[[axes]]
name = "scheme"
[axes.variants.zeta]
[axes.variants."monaghan 1/10"]
scheme.name = "monaghan"
scheme.beta = 10
)";

Study study_of(const std::string& text, const std::string& name = "study.toml") {
  const Scratch scratch;
  scratch.write(two_gases);
  return read_study(scratch.write(text, name));
}

std::string study_mistakes(const std::string& text) {
  try {
    study_of(text);
    return "";
  } catch (const SceneError& error) {
    std::string all;
    for (const Finding& finding : error.findings())
      all += (finding.where.line > 0 ? std::to_string(finding.where.line) + ':' + std::to_string(finding.where.column) + ": "
                                     : std::string()) +
             finding.message + '\n';
    return all;
  }
}

TEST(Study, IsTheGridOfItsAxes) {
  const Study study = study_of(study_text);
  EXPECT_EQ(study.title, "Gas");
  ASSERT_EQ(study.runs.size(), 4u);
  EXPECT_EQ(study.runs[0].name, "spacing_0.02__zeta") << "variants keep the order of the file";
  EXPECT_EQ(study.runs[1].name, "spacing_0.02__monaghan_1_10");
  EXPECT_EQ(study.runs[3].name, "spacing_0.01__monaghan_1_10");
  EXPECT_EQ(study.runs[3].values, (std::vector<std::size_t>{1, 1}));
  EXPECT_EQ(study.resolution, 0u) << "the axis of resolution.spacing without being named";
  EXPECT_EQ(study.axes[0].values[1].number, 0.01);
  EXPECT_TRUE(std::isnan(study.axes[1].values[0].number));
  // What a run would record is known beforehand.
  EXPECT_NE(study.runs[3].resolved.find("spacing = 0.01"), std::string::npos);
  EXPECT_NE(study.runs[3].resolved.find("name = \"monaghan\""), std::string::npos);
  EXPECT_NE(study.runs[3].resolved.find("beta = 10.0"), std::string::npos);
  EXPECT_NE(study.runs[3].resolved.find("threads = 1"), std::string::npos) << "one thread where the study asks for no more";
  EXPECT_EQ(study.runs[3].dimension, 1);
  EXPECT_TRUE(study.output.string().starts_with("out/study_"));
  EXPECT_EQ(study_of(study_text, "my grid.toml").output, "out/study_my_grid");
}

TEST(Study, SettingsOfAllKinds) {
  const Study study = study_of(R"(threads = 2
[settings]
end_time = 0.2
output.field_times = [0.1]
[[axes]]
name = "left"
[axes.variants.law]
"bodies.left.material" = {law = "ideal_gas", rho0 = 2.5, gamma = 1.6}
bodies.left.energy = 1
bodies.left.variable_h = false
[[axes]]
name = "gamma"
key = "bodies.right.material.gamma"
values = [1.4, 2]
labels = ["diatomic", "two"]
)");
  ASSERT_EQ(study.runs.size(), 2u);
  EXPECT_EQ(study.runs[1].name, "law__gamma_two");
  const std::string& resolved = study.runs[1].resolved;
  for (const char* line :
       {"threads = 2", "end_time = 0.2", "field_times = [0.1]", "gamma = 1.6", "rho0 = 2.5", "variable_h = false", "gamma = 2.0"})
    EXPECT_NE(resolved.find(line), std::string::npos) << line << "\n" << resolved;
  EXPECT_FALSE(study.resolution.has_value());
}

TEST(Study, NumbersAreNamedAsPeopleWriteThem) {
  const Study study = study_of("[[axes]]\nname = \"spacing\"\nkey = \"resolution.spacing\"\nvalues = [0.001, 0.0005, 2.5e-5]\n");
  EXPECT_EQ(study.runs[0].name, "spacing_0.001");
  EXPECT_EQ(study.runs[1].name, "spacing_0.0005");
  EXPECT_EQ(study.runs[2].name, "spacing_2.5e-05");
}

TEST(Study, AnAxisMaySetTheThreads) {
  const Study study = study_of("[[axes]]\nname = \"threads\"\nkey = \"threads\"\nvalues = [1, 2]\n");
  EXPECT_NE(study.runs[0].resolved.find("threads = 1"), std::string::npos);
  EXPECT_NE(study.runs[1].resolved.find("threads = 2"), std::string::npos);
}

TEST(Study, SeveralScenesAreAnAxisOfProblems) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch.folder() / "other");
  scratch.write(two_gases, "gas.toml");
  scratch.write(coupled_tube, "other/case.toml");
  const Study study =
      read_study(scratch.write("scenes = [\"gas.toml\", \"other\"]\nexclude = [{scene = \"gas\", spacing = 0.003}]\n"
                               "[[axes]]\nname = \"spacing\"\nkey = \"resolution.spacing\"\nvalues = [0.004, 0.003]\n",
                               "s.toml"));
  ASSERT_EQ(study.runs.size(), 3u);
  EXPECT_EQ(study.axes[0].name, "scene");
  EXPECT_TRUE(study.axes[0].problem);
  EXPECT_EQ(study.runs[0].name, "gas__spacing_0.004");
  EXPECT_EQ(study.runs[2].name, "other__spacing_0.003");
  EXPECT_EQ(study.runs[2].dimension, 3);
  EXPECT_EQ(study.runs[2].scene, (scratch.folder() / "other").lexically_normal());
}

TEST(Study, ExcludesWhatARuleNames) {
  const auto names = [](const std::string& rule) {
    std::string all;
    for (const StudyRun& run : study_of("exclude = " + rule + "\n" + study_text).runs) all += run.name + " ";
    return all;
  };
  EXPECT_EQ(names("[{spacing = 0.01, scheme = \"zeta\"}]"),
            "spacing_0.02__zeta spacing_0.02__monaghan_1_10 spacing_0.01__monaghan_1_10 ");
  EXPECT_EQ(names("[{spacing = 1e-2}]"), "spacing_0.02__zeta spacing_0.02__monaghan_1_10 ") << "numbers are compared as such";
  EXPECT_EQ(names("[{scheme = [\"zeta\"], spacing = [0.01, 0.02]}]"), "spacing_0.02__monaghan_1_10 spacing_0.01__monaghan_1_10 ");
  EXPECT_EQ(names("[{spacing = 0.01}, {scheme = \"zeta\"}]"), "spacing_0.02__monaghan_1_10 ");
}

TEST(Study, ErrorsAndLimits) {
  const Study study =
      study_of("repeats = 3\ncpu_limit = 10\nresolution = \"spacing\"\n" +
               with(study_text, "errors = [\"energy_error\"]",
                    "errors = [\"l1_pressure\", {metric = \"peak_pa\", source = \"exact\"}, {metric = \"a\", label = \"b\"}]"));
  ASSERT_EQ(study.errors.size(), 3u);
  EXPECT_EQ(study.errors[0].label, "l1_pressure");
  EXPECT_EQ(study.errors[1].label, "peak_pa from exact");
  EXPECT_EQ(study.errors[2].label, "b");
  EXPECT_EQ(study.repeats, 3);
  EXPECT_EQ(study.cpu_limit, 10);
  EXPECT_FALSE(study.wall_limit.has_value());
}

TEST(Study, EveryMistakeAtItsPlace) {
  EXPECT_EQ(study_mistakes(R"(titel = "Gas"
scene = "case.toml"
repeats = 0
exclude = [{spcing = 0.01}, {spacing = 0.5}, {}]
resolution = "schem"
errors = [3, "a", "a", {source = "b"}]

[[axes]]
name = "spacing"
key = "resolution.spacing"
vales = [1]
values = [0.01, 0.011, 0.011]

[[axes]]
name = "scheme"
variants = {riemann = 3}

[[axes]]
key = "scheme.kernel"
values = []

[[axes]]
name = "spacing"
key = "end_time"
values = [0.1]
labels = ["a", "b"]
)"),
            "1:1: unknown key 'titel' at the top of the file; did you mean 'title'?\n"
            "3:11: repeats = 0 must be from 1 to 100\n"
            "4:13: exclude: no axis is named 'spcing'; did you mean 'spacing'?\n"
            "4:40: exclude: axis 'spacing' has no value 0.5; known: 0.01, 0.011, 0.011\n"
            "4:46: exclude: an empty rule leaves out every run; name values of axes, e.g. {spacing = 0.001}\n"
            "5:14: resolution: unknown 'schem'; known: spacing\n"
            "6:11: errors: the number 3 is neither the name of a metric nor {metric = ..., source = ...}\n"
            "6:19: errors has 'a' twice; leave one out, or give it another label\n"
            "6:24: errors.3.metric is missing; name a metric of summary.json\n"
            "8:1: axis 'spacing' has '0.011' twice; leave one out, or label them differently\n"
            "11:1: unknown key 'vales' in axes.spacing; did you mean 'values'?\n"
            "16:13: axes.scheme.variants.riemann must be a table of settings, not the number 3; {} is the scene as it is\n"
            "18:1: axes.2.name is missing; name the axis, e.g. name = \"spacing\"\n"
            "20:10: axes.2.values must be a list of at least one value, not an array of 0\n"
            "23:8: two axes are named 'spacing'; name them differently\n"
            "26:10: axes.spacing.labels are 2, the values 1; give one for each, or leave them out\n");
}

TEST(Study, MistakesOfTheScenesAreToldWhereTheStudyMakesThem) {
  EXPECT_EQ(study_mistakes(with(with(study_text, "resolution.spacing", "resolution.spacng"), "scheme.beta = 10",
                                "scheme.beta = -1\nbodies.lefd.energy = 1")),
            "7:7: resolution.spacng: unknown key 'spacng' in resolution; did you mean 'spacing'?\n"
            "15:8: scheme.beta = -1 must be from 0 to 1000 (run spacing_0.02__monaghan_1_10 and 1 more)\n"
            "16:13: bodies.lefd.energy: nothing in bodies is named 'lefd'; did you mean 'left'? (run "
            "spacing_0.02__monaghan_1_10 and 1 more)\n");
  // Of a scene that is itself at fault, once.
  const Scratch scratch;
  const std::string scene = scratch.write(with(two_gases, "end_time = 0.1", "end_tim = 0.1")).string();
  EXPECT_EQ(
      [&]() -> std::string {
        try {
          read_study(scratch.write(study_text, "study.toml"));
        } catch (const SceneError& error) {
          return error.what();
        }
        return "";
      }(),
      scratch.folder().string() + "/study.toml: " + scene + ":1:1: end_time is missing; give it in s, e.g. end_time = 1e-4\n" +
          scratch.folder().string() + "/study.toml: " + scene +
          ":2:1: unknown key 'end_tim' at the top of the file; did you mean 'end_time'?");
}

TEST(Study, WhatCannotBeAGrid) {
  EXPECT_EQ(study_mistakes(study_text + "[[axes]]\nname = \"again\"\nkey = \"resolution.spacing\"\nvalues = [0.04]\n"),
            "17:8: axes 'spacing' and 'again' both set resolution.spacing; vary it in one of them\n");
  EXPECT_EQ(study_mistakes("exclude = [{scheme = [\"zeta\", \"monaghan 1/10\"]}]\n" + study_text),
            "every run of the study is excluded; leave a rule of exclude out\n");
  EXPECT_EQ(study_mistakes(study_text + "\n[axes.variants.\"monaghan 1?10\"]\n"),
            "two runs would have the folder spacing_0.02__monaghan_1_10; label their values more differently\n"
            "two runs would have the folder spacing_0.01__monaghan_1_10; label their values more differently\n");
  EXPECT_EQ(study_mistakes("resolution = \"scheme\"\n" + study_text),
            "1:14: resolution: the values of axis 'scheme' are not positive numbers; orders are observed over lengths\n");
  EXPECT_EQ(study_mistakes(with(study_text, "scene = \"case.toml\"", "scene = \"nowhere\"")).find("2:9: "), 0u);
  EXPECT_EQ(study_mistakes(with(study_text, "values = [0.02, 0.01]", "values = [1979-05-27]"))
                .find("8:11: axes.spacing.values has a date or time"),
            0u);
  std::string many;
  for (const char* name : {"a", "b", "c", "d", "e"})
    many += "[[axes]]\nname = \"" + std::string(name) + "\"\nkey = \"" + name + "\"\nvalues = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]\n";
  EXPECT_EQ(study_mistakes(many), "the study has 100000 runs, more than 10000; split it\n");
  EXPECT_NE(study_mistakes("axes = [").find("not TOML"), std::string::npos);
  const Scratch empty;
  EXPECT_THROW(read_study(empty.folder()), FileError);
  EXPECT_NE(study_mistakes("scenes = []").find("scenes is empty"), std::string::npos);
}

TEST(Study, PageNamesEveryKeyWithItsUnit) {
  std::ifstream file(std::string(UNDEX_ROOT) + "/docs/reference/studies.md");
  std::ostringstream page;
  page << file.rdbuf();
  for (const Section& section : study_schema())
    for (const Key& key : section.keys)
      EXPECT_NE(page.str().find(std::string("| `") + key.name + "` | " + (*key.unit ? key.unit : "-") + " |"), std::string::npos)
          << key.name;
}

TEST(Study, ShippedOnesAreSound) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(UNDEX_ROOT) + "/cases"))
    if (std::filesystem::exists(entry.path() / "study.toml")) {
      ++count;
      EXPECT_NO_THROW({
        const Study study = read_study(entry.path());
        EXPECT_GT(study.runs.size(), 1u);
        EXPECT_TRUE(study.resolution.has_value());
        EXPECT_FALSE(study.errors.empty());
      }) << entry.path();
    }
  EXPECT_GE(count, 4);
}

}  // namespace
