// Shapes of a scene: turned, composed of others, read from STL; round trips and mistakes.
#include <gtest/gtest.h>

#include "scratch.hpp"

namespace undex::scene::test {
namespace {

const std::string head = "end_time = 1e-4\n[resolution]\nspacing = 0.01\n";
std::string body(const std::string& shape) {
  return head + "[[bodies]]\nname = \"water\"\nshape = " + shape + "\nmaterial = \"water-tait\"\n";
}
const std::string tetrahedron =
    "solid t\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 300 0\nvertex 300 0 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 300 0 0\nvertex 0 0 300\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 300\nvertex 0 300 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 300 0 0\nvertex 0 300 0\nvertex 0 0 300\nendloop\nendfacet\nendsolid t\n";

TEST(Shapes, AllComeBackFromTheResolvedScene) {
  const Scratch scratch;
  const std::string file = scratch.write(tetrahedron, "whole.stl").string();
  for (const std::string& shape : {
           std::string("{type = \"ellipsoid\", center = [0.1, 0, 0], semi_axes = [0.1, 0.2, 0.3]}"),
           std::string("{type = \"revolution\", axis = \"x\", center = [0, 0.1, 0], points = [[0, 0], [0.1, 0], [0, 0.2]]}"),
           std::string("{type = \"box\", low = [0, 0, 0], high = [0.2, 0.1, 0.1], rotate = [0, 0, 30]}"),
           std::string("{type = \"sphere\", radius = 0.1, move = [0.1, 0, 0]}"),
           std::string(
               "{type = \"union\", shapes = [{type = \"sphere\", radius = 0.1}, {type = \"cone\", low_radius = 0, high_radius = "
               "0.1, low = 0, high = 0.2, rotate = [90, 0, 0], about = [0, 0, 0]}], rotate = [0, 10, 0]}"),
           std::string(
               "{type = \"intersection\", shapes = [{type = \"sphere\", radius = 0.1}, {type = \"half_space\", point = [0, 0, "
               "0.01], normal = [0, 0, 1]}]}"),
           std::string(
               "{type = \"difference\", shapes = [{type = \"sphere\", radius = 0.1}, {type = \"union\", shapes = [{type = "
               "\"slab\", axis = \"z\", low = 0, high = 0.01}]}]}"),
           "{type = \"stl\", file = \"" + file + "\", scale = 1e-3, rotate = [0, 0, 5]}",
       }) {
    SCOPED_TRACE(shape);
    const Scene scene = read_text(body(shape));
    const std::string text = to_toml(scene);
    const Scene again = read_text(text);
    EXPECT_EQ(to_toml(again), text);
    EXPECT_TRUE(same_shape(scene.fluid.bodies[0].shape.base, again.fluid.bodies[0].shape.base));
  }
}

TEST(Shapes, MayBeObstaclesAndSubtractions) {
  const std::string water = body("{type = \"box\", low = [-0.3, -0.3, -0.3], high = [0.3, 0.3, 0.3]}");
  const Scene scene = read_text(
      water +
      "subtract = [{type = \"half_space\", point = [0.2, 0, 0], normal = [-1, 0, 0]}]\n[[obstacles]]\nname = \"pair\"\n"
      "shape = {type = \"union\", shapes = [{type = \"sphere\", center = [-0.05, 0, 0], radius = 0.1}, {type = \"sphere\", "
      "center = [0.05, 0, 0], radius = 0.1}]}\nmotion = \"free\"\ndensity = 2000\n");
  EXPECT_EQ(scene.fluid.bodies[0].shape.removed.size(), 2u);
}

TEST(Shapes, MistakesHaveRemedies) {
  const std::string obstacle =
      body("{type = \"box\", low = [0, 0, 0], high = [0.4, 0.4, 0.4]}") + "[[obstacles]]\nname = \"o\"\nshape = ";
  const std::string wall =
      body("{type = \"box\", low = [0, 0, 0], high = [0.4, 0.4, 0.4]}") + "[[walls]]\nname = \"w\"\nshape = ";
  const std::string sphere = "{type = \"sphere\", radius = 0.1}";
  const Scratch scratch;
  const std::string open =
      scratch.write(tetrahedron.substr(0, tetrahedron.rfind("facet normal")) + "endsolid t\n", "open.stl").string();
  struct {
    std::string scene, expected;
  } const all[] = {
      {body("{type = \"ellipsoid\", semi_axes = [0.1, 0, 0.1]}"), "shape.semi_axes"},
      {body("{type = \"intersection\", shapes = [{type = \"half_space\", normal = [0, 0, 0]}]}"),
       "bodies.water.shape.shapes.0.normal is zero"},
      {body("{type = \"revolution\", points = [[0, 0], [0.1, 0]]}"), "points must have three corners or more"},
      {body("{type = \"revolution\", points = [[0, 0], [0.1, 0], 7]}"), "points.2 must be a pair [r, z]"},
      {body("{type = \"revolution\", points = 7}"), "points must be a list of up to 10000 pairs [r, z]"},
      {body("{type = \"revolution\", points = [[0, 0], [-0.1, 0], [0, 1]]}"), "points.1: r = -0.1 m is negative"},
      {body("{type = \"revolution\", points = [[0, 0], [0.1, 0.1], [0.1, 0], [0, 0.2]]}"), "cross; give the corners in turn"},
      {body("{type = \"revolution\", points = [[0, 0], [0.1, 0], [0.2, 0]]}"), "the polygon has no area"},
      {body("{type = \"union\", shapes = []}"), "shapes must be a list of 1 to 1000 shapes, not 0 of them"},
      {body("{type = \"union\", shapes = 3}"), "shapes must be a list of 1 to 1000 shapes, not the number 3"},
      {body("{type = \"union\"}"), "shapes"},
      {body("{type = \"union\", shapes = [{type = \"sphere\", radius = -1}]}"), "bodies.water.shape.shapes.0.radius"},
      {body("{type = \"union\", shapes = [{type = \"slab\", axis = \"x\", low = 0, high = 1}]}"), "has no end along"},
      {body("{type = \"sphere\", radius = 0.1, about = [0, 0, 0]}"), "about is of a shape that is turned; add rotate"},
      {body("{type = \"sphere\", radius = 0.1, rotate = 3}"), "shape.rotate"},
      {body("{type = \"stl\", file = \"/nowhere.stl\"}"), "shape.file: no file '/nowhere.stl'"},
      {body("{type = \"stl\", file = \"" + open + "\"}"), "the surface is open: 3 edges have one triangle only"},
      {body("{type = \"stl\", file = \"" + open + "\", scale = 0}"), "shape.scale"},
      {"dimension = 2\n" + body("{type = \"stl\", file = \"" + open + "\"}"), "a surface of triangles needs dimension = 3"},
      {"dimension = 2\n" + body("{type = \"revolution\", points = [[0, 0], [0.1, 0], [0, 1]]}"),
       "in two dimensions a revolution lies"},
      {"dimension = 1\n" + body("{type = \"union\", shapes = [{type = \"box\", low = 0, high = 1}]}"),
       "in one dimension bodies are intervals"},
      {"dimension = 1\n" + body("{type = \"box\", low = 0, high = 1, rotate = 3}"), "nothing turns in one dimension"},
      {obstacle + "{type = \"half_space\", normal = [1, 0, 0]}\n", "obstacles.o.shape.type must be one of box, sphere"},
      {obstacle + "{type = \"difference\", shapes = [{type = \"half_space\", normal = [1, 0, 0]}, " + sphere + "]}\n",
       "obstacles.o.shape has no end"},
      {wall + "{type = \"union\", shapes = [" + sphere + "]}\n",
       "bodies.water reaches from 0 to 0.4 m along x, far outside of the wall"},
      {wall + "{type = \"half_space\", normal = [1, 0, 0]}\n", "walls.w.shape.type must be one of box, sphere"},
      {wall + "{type = \"box\", low = [0, 0, 0], high = [0.4, 0.4, 0.4], rotate = [0, 0, 45]}\ncondition = \"no_slip\"\n",
       "walls.w.condition: only a box, cylinder, cone or sphere along the axes has another condition"},
      {wall + "{type = \"union\", shapes = [" + sphere + "]}\nfaces = {side = \"open\"}\n",
       "walls.w.faces: only a box, cylinder, cone or sphere along the axes has faces; leave it out"},
  };
  for (const auto& [text, expected] : all) {
    SCOPED_TRACE(text);
    EXPECT_NE(mistakes(text).find(expected), std::string::npos) << mistakes(text) << "\nshould say: " << expected;
  }
}

/// 300 units long, in water of 0.4 m: a file in millimetres that is taken for metres, wherever it stands.
TEST(Shapes, FilesInMillimetresAreTold) {
  const Scratch scratch;
  const std::string stl = "{type = \"stl\", file = \"" + scratch.write(tetrahedron, "hull.stl").string() + "\"", bare = stl + "}",
                    scaled = stl + ", scale = 1e-3}", away = stl + ", move = [0, 0, 1000]}";
  const std::string water = body("{type = \"box\", low = [0, 0, 0], high = [0.4, 0.4, 0.4]}");
  const auto in = [](const std::string& list, const std::string& name, const std::string& shape) {
    return "[[" + list + "]]\nname = \"" + name + "\"\nshape = " + shape + "\n";
  };
  const std::string asked = "'hull.stl' is 300 m long: is it in millimetres? Then write scale = 1e-3";
  for (const std::string& scene :
       {water + in("obstacles", "hull", bare), water + in("obstacles", "hull", away), water + in("walls", "hull", bare),
        water + "subtract = [" + bare + "]\n", water + "subtract = [" + away + "]\n",
        water + "subtract = [{type = \"union\", shapes = [" + bare + "]}]\n", body(bare),
        water + "subtract = [\"hull\"]\n" + in("solids", "hull", bare) + "material = \"al-6061-t6\"\n"}) {
    const std::string found = mistakes(scene);
    EXPECT_NE(found.find(asked), std::string::npos) << scene << "gave:\n" << found;
  }
  EXPECT_EQ(mistakes(water + in("obstacles", "hull", scaled)), "");
  EXPECT_EQ(mistakes(body(scaled)), "");
  const std::string drawn = stl + ", scale = 2}";  // who gives a scale has thought of it
  EXPECT_EQ(mistakes(water + "subtract = [" + drawn + "]\n").find("millimetres"), std::string::npos);
}

}  // namespace
}  // namespace undex::scene::test
