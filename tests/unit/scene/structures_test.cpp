// Scenes of several structures: how they are named, addressed, checked against each other and written back.
#include <gtest/gtest.h>

#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene::test;

/// Two plates with water between and below.
const std::string two_plates = R"(end_time = 1e-5
[resolution]
spacing = 0.002
[[bodies]]
name = "water"
shape = {type = "box", low = [0, 0, -0.04], high = [0.04, 0.04, 0]}
material = "water-tait"
[[bodies]]
name = "gap"
shape = {type = "box", low = [0, 0, 0.004], high = [0.04, 0.04, 0.024]}
material = "water-tait"
[[structures]]
name = "front"
shape = {type = "plate", low = [0, 0, 0], high = [0.04, 0.04, 0.004]}
cells = {x = 4, y = 4, z = 2}
material = "steel-hy100"
wet = ["z_low", "z_high"]
supports = [{face = "x_high", fixed = ["x"]}]
[[structures]]
name = "back"
shape = {type = "plate", low = [0, 0, 0.024], high = [0.04, 0.04, 0.027]}
element = "shell"
material = "steel-4340"
wet = ["z_low"]
velocity = [0, 0, 1]
courant = 0.5
loads = [{face = "z_high", time = [0, 1e-5], pressure = [1e5, 2e5]}, {face = "x_low", time = [0], pressure = [1]}]
[[probes]]
name = "middle"
kind = "structure"
structure = "back"
point = [0.02, 0.02, 0.025]
)";

/// The same without water.
const std::string dry = R"(end_time = 1e-5
[[structures]]
shape = {type = "plate", low = [0, 0, 0], high = [0.04, 0.04, 0.004]}
material = "steel-hy100"
[[structures]]
shape = {type = "plate", low = [0, 0, 0.01], high = [0.04, 0.04, 0.02]}
material = "steel-4340"
)";

void expect(const std::string& scene, const std::string& expected) {
  const std::string found = mistakes(scene);
  EXPECT_NE(found.find(expected), std::string::npos) << "gave:\n" << found << "expected:\n" << expected;
}

TEST(Structures, EachHasItsOwn) {
  const scene::Scene scene = read_text(two_plates);
  ASSERT_EQ(scene.structures.size(), 2u);
  EXPECT_EQ(scene.structures[0].name, "front");
  EXPECT_EQ(scene.structures[0].material.name, "steel-hy100");
  EXPECT_EQ(scene.structures[0].wet_faces, (std::vector<std::string>{"z_low", "z_high"}));
  EXPECT_EQ(scene.structures[0].supports.size(), 1u);
  EXPECT_TRUE(scene.structures[0].loads.empty());
  EXPECT_EQ(scene.structures[1].material.name, "steel-4340");
  EXPECT_EQ(scene.structures[1].element, fem::ElementKind::shell);
  EXPECT_EQ(scene.structures[1].courant, 0.5);
  EXPECT_EQ(scene.structures[1].initial_velocity, Vec3(0, 0, 1));
  EXPECT_EQ(scene.structures[1].loads.size(), 2u);
  EXPECT_EQ(scene.probes[0].structure, "back");
  EXPECT_EQ(scene.path_of(scene.structures[1]), "structures.back");
  EXPECT_EQ(scene.only_structure(), nullptr);
}

TEST(Structures, AreNumberedWithoutNames) {
  const scene::Scene scene = read_text(dry);
  EXPECT_EQ(scene.structures[0].name, "0");
  EXPECT_EQ(scene.structures[1].name, "1");
  EXPECT_EQ(read_text(dry, {{"structures.1.courant", "0.3"}}).structures[1].courant, 0.3);
}

TEST(Structures, AreReadBackAsWritten) {
  for (const std::string& text : {two_plates, dry}) {
    const scene::Scene scene = read_text(text);
    const std::string written = scene::to_toml(scene);
    EXPECT_NE(written.find("[[structures]]"), std::string::npos);
    EXPECT_EQ(written.find("[structure]"), std::string::npos);
    EXPECT_EQ(scene::to_toml(read_text(written)), written);
    EXPECT_EQ(mistakes(written), "");
  }
}

TEST(Structures, OneByItselfIsWrittenAsItWas) {
  const std::string written = scene::to_toml(read_text(coupled_tube));
  EXPECT_NE(written.find("[structure]\n"), std::string::npos);
  EXPECT_EQ(written.find("[[structures]]"), std::string::npos);
  EXPECT_EQ(written.find("\nstructure = "), std::string::npos);  // of a probe
  const scene::Scene listed = read_text(with(coupled_tube, "[structure]", "[[structures]]"));
  EXPECT_NE(scene::to_toml(listed).find("[[structures]]"), std::string::npos);
  EXPECT_EQ(listed.only_structure(), &listed.structures[0]);
}

TEST(Structures, AreOverriddenByName) {
  const scene::Scene scene = read_text(two_plates, {{"structures.back.material", "steel-s7"}, {"structures.front.cells.z", "3"}});
  EXPECT_EQ(scene.structures[0].material.name, "steel-hy100");
  EXPECT_EQ(scene.structures[1].material.name, "steel-s7");
  EXPECT_EQ(std::get<fem::PlateMesh>(scene.structures[0].mesh).cells[2], 3);
  const std::string found = mistakes(two_plates, {{"structures.bak.courant", "0.3"}});
  EXPECT_NE(found.find("nothing in structures is named 'bak'; did you mean 'back'?"), std::string::npos) << found;
}

TEST(Structures, MistakesNameTheirTable) {
  expect(with(two_plates, "courant = 0.5", "courant = 2"), "structures.back.courant = 2 must be");
  expect(with(two_plates, "courant = 0.5", "curant = 0.5"), "unknown key 'curant' in structures.back; did you mean 'courant'?");
  expect(with(two_plates, "{face = \"x_high\", fixed = [\"x\"]}", "{face = \"left\"}"), "structures.front.supports.0.face");
  expect(with(two_plates, "pressure = [1e5, 2e5]", "pressure = [1e5]"),
         "structures.back.loads.0: time has 2 values and pressure 1");
  expect(with(two_plates, "wet = [\"z_low\"]\n", ""),
         "structures.back.wet is empty, so the water does not see the structure; name the faces that it touches");
  expect(with(with(two_plates, "wet = [\"z_low\"]\n", "wet = [\"z_high\"]\n"), "0.027]", "0.029]"),
         "structures.back.wet: the face 'z_high' touches no water");
  expect(with(two_plates, "wet = [\"z_low\"]\n", "wet = [\"z_high\"]\n"),
         "structures.back.wet: the face 'z_high' looks away from the water");
  expect(with(two_plates, "name = \"back\"", "name = \"front\""),
         "structures: the name 'front' is used twice; choose another one");
  expect("dimension = 2\n" + with(dry, "end_time = 1e-5\n", "end_time = 1e-5\n"),
         "[[structures]] need dimension = 3, but the scene has dimension = 2");
}

TEST(Structures, OneOrSeveral) {
  expect(dry +
             "[structure]\nshape = {type = \"plate\", low = [0, 0, 0.03], high = [0.04, 0.04, 0.04]}\nmaterial = "
             "\"steel-4340\"\n",
         "8:1: [structure] and [[structures]] exclude each other; write this one as one more of [[structures]]");
}

TEST(Structures, DoNotOverlap) {
  EXPECT_EQ(mistakes(dry), "");
  expect(with(dry, "low = [0, 0, 0.01]", "low = [0, 0, 0.0039]"), "structures.1 overlaps structures.0, e.g. at [");
  expect(with(dry, "low = [0, 0, 0.01]", "low = [0.01, 0.01, -0.1]"), "structures.1 overlaps structures.0, e.g. at [");
}

TEST(Structures, ThatTouchAreWarnedOf) {
  EXPECT_TRUE(read_text(dry).warnings.empty());
  const scene::Scene scene = read_text(with(dry, "low = [0, 0, 0.01]", "low = [0, 0, 0.004]"));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("structures.1 touches structures.0, e.g. at ["), std::string::npos) << scene.warnings[0];
}

TEST(Structures, BodiesKeepClearOfEach) {
  expect(with(two_plates, "high = [0.04, 0.04, 0.024]", "high = [0.04, 0.04, 0.025]"),
         "bodies.gap overlaps structures.back, e.g. at [");
  expect(with(two_plates, "low = [0, 0, 0.004], high = [0.04, 0.04, 0.024]", "low = [0, 0, 0.003], high = [0.04, 0.04, 0.024]"),
         "bodies.gap overlaps structures.front, e.g. at [");
}

TEST(Structures, ProbesNameTheirs) {
  expect(with(two_plates, "structure = \"back\"\n", ""),
         "probes.middle: the scene has several structures; name the one that the probe lies on, e.g. structure = \"back\", the "
         "nearest");
  expect(with(two_plates, "structure = \"back\"\n", "structure = \"bakc\"\n"),
         "probes.middle.structure: no structure 'bakc'; did you mean 'back'?");
  expect(with(two_plates, "structure = \"back\"\n", "structure = \"front\"\n"), "m away from structures.front; move it onto it");
  expect(with(two_plates, "kind = \"structure\"\nstructure = \"back\"", "kind = \"fluid\"\nstructure = \"back\""),
         "probes.middle.structure is of probes of kind = \"structure\" on [[structures]]; leave it out");
  const std::string one =
      coupled_tube + "[[probes]]\nname = \"named\"\nkind = \"structure\"\nstructure = \"structure\"\npoint = [0.047, 0, 0]\n";
  EXPECT_EQ(mistakes(one), "");
}

TEST(Structures, AreOfRevolutionEach) {
  const std::string found = mistakes("dimension = \"axisymmetric\"\n" + dry);
  EXPECT_NE(found.find("structures.0.shape: a rectangular plate is no body of revolution"), std::string::npos) << found;
  EXPECT_NE(found.find("structures.1.shape: a rectangular plate is no body of revolution"), std::string::npos) << found;
}

}  // namespace
