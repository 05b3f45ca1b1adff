// Mesh files of gmsh: what is read, and that everything else is refused with its place.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "core/gmsh_file.hpp"

namespace undex {
namespace {

/// Two unit cubes side by side along x; faces at x = 0 and x = 2 are of the groups 7 and 8.
const std::string cubes_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 7 "wet side"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 0 1 0
3 0 1 1
4 0 0 1
5 1 0 0
6 1 1 0
7 1 1 1
8 1 0 1
9 2 0 0
10 2 1 0
11 2 1 1
12 2 0 1
$EndNodes
$Elements
4
1 3 2 7 7 1 2 3 4
2 3 2 8 8 9 10 11 12
3 5 2 1 1 1 5 6 2 4 8 7 3
4 5 2 1 1 5 9 10 6 8 12 11 7
$EndElements
)";
const std::string cubes_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
1 1 2 1
1 0 0 0 0
3 0 0 0 1 0 0 0 2 1 -1
7 0 0 0 0 1 1 1 7 0
8 2 0 0 2 1 1 1 -8 0
1 0 0 0 2 1 1 1 1 2 7 8
$EndEntities
$Nodes
2 12 1 40
2 7 1 4
1
2
3
40
0 0 0 0 0
0 1 0 1 0
0 1 1 1 1
0 0 1 0 1
3 1 0 8
5
6
7
8
9
10
11
12
1 0 0
1 1 0
1 1 1
1 0 1
2 0 0
2 1 0
2 1 1
2 0 1
$EndNodes
$Elements
5 6 1 6
0 1 15 1
1 1
1 3 1 1
2 1 5
2 7 3 1
3 1 2 3 40
2 8 3 1
4 9 10 11 12
3 1 5 2
5 1 5 6 2 40 8 7 3
6 5 9 10 6 8 12 11 7
$EndElements
)";

/// The mistake found, or nothing.
std::string mistake(const std::string& text) {
  try {
    parse_gmsh(text, "m.msh");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), replacement);
}

void expect(const std::string& text, const std::string& expected) {
  const std::string found = mistake(text);
  EXPECT_NE(found.find(expected), std::string::npos) << "gave:\n" << found << "\nexpected:\n" << expected;
}

double volume(const HexahedralMesh& mesh) {  // of cells with plane faces at right angles
  double sum = 0;
  for (const auto& cell : mesh.cells) sum += std::abs(corner_volumes(mesh.nodes, cell)[0]);
  return sum;
}

TEST(GmshFile, BothFormatsGiveTheSameMesh) {
  const HexahedralMesh two = parse_gmsh(cubes_2, "m.msh"), four = parse_gmsh(cubes_4, "m.msh");
  for (const HexahedralMesh& mesh : {two, four}) {
    ASSERT_EQ(mesh.nodes.size(), 12u);
    ASSERT_EQ(mesh.cells.size(), 2u);
    EXPECT_EQ(mesh.nodes[4], Vec3(1, 0, 0));
    EXPECT_EQ(mesh.cells[1], (std::array<int, 8>{4, 8, 9, 5, 7, 11, 10, 6}));
    EXPECT_DOUBLE_EQ(volume(mesh), 2.0);
    EXPECT_EQ(mesh.faces.size(), 10u);
    int named = 0;
    for (const auto& face : mesh.faces) {
      const double x = mesh.nodes[face.nodes[0]][0];
      if (face.id != 0) ++named;
      EXPECT_EQ(x, face.id == 7 ? 0.0 : face.id == 8 ? 2.0 : x);
    }
    EXPECT_EQ(named, 2);
  }
  EXPECT_EQ(two.cells, four.cells);
  EXPECT_EQ(two.nodes, four.nodes);
}

TEST(GmshFile, EndingsOfWindowsUnusedNodesAndMirroredCellsAreRead) {
  std::string windows;
  for (const char c : cubes_2) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(mistake(windows), "");
  const HexahedralMesh loose = parse_gmsh(with(with(cubes_2, "\n12\n", "\n13\n"), "\n5 1 0 0", "\n99 9 9 9\n5 1 0 0"), "m.msh");
  EXPECT_EQ(loose.nodes.size(), 12u);
  const HexahedralMesh mirrored = parse_gmsh(with(cubes_2, "1 5 6 2 4 8 7 3", "4 8 7 3 1 5 6 2"), "m.msh");
  EXPECT_DOUBLE_EQ(volume(mirrored), 2.0);
}

TEST(GmshFile, MistakesNameFileAndLine) {
  expect("", "m.msh:0: this is not a gmsh mesh of hexahedra");
  expect("this is no mesh\n", "m.msh:1: this is not a gmsh mesh of hexahedra");
  expect(with(cubes_2, "2.2 0 8", "2.2 1 8"), "m.msh:2: the mesh is binary; save it again as ASCII");
  expect(with(cubes_2, "2.2 0 8", "4.0 0 8"), "m.msh:2: version 4.0 of gmsh's format is not read");
  expect(with(cubes_2, "2.2 0 8", "4.1 0 8"), "m.msh:9: $Nodes: its first line");  // a header of 4.1 over 2.2
  expect(with(cubes_4, "4.1 0 8", "2.2 0 8"), "m.msh:13: $Nodes: the count of nodes needs 1 numbers");
  expect(with(cubes_2, "\n12\n", "\n13\n"), "m.msh:22: $Nodes: a node (tag, x, y, z) needs 4 numbers on a line, here are 1");
  expect(with(cubes_2, "\n12\n", "\n11\n"), "m.msh:21: $Nodes: here should be $EndNodes, not '12'");
  expect(with(cubes_2, "\n12\n", "\n999999999999\n"), "the count of nodes = 999999999999 is out of range");
  expect(with(cubes_2, "\n3 0 1 1", "\n2 0 1 1"), "m.msh:12: the node 2 is there twice");
  expect(with(cubes_2, "\n3 0 1 1", "\n3 0 nan 1"), "m.msh:12: a coordinate must be a finite number, not 'nan'");
  expect(with(cubes_2, "\n3 0 1 1", "\n3 0 1e999 1"), "m.msh:12: a coordinate must be a finite number");
  expect(with(cubes_2, "\n3 0 1 1", "\n3 0 1e7 1"),
         "m.msh:12: a coordinate of 1e7 is out of range, -1e5 to 1e5 m; is the mesh in");
  expect(with(cubes_2, "\n3 0 1 1", "\n3 0 1"), "m.msh:12: $Nodes: a node (tag, x, y, z) needs 4 numbers on a line, here are 3");
  expect(with(cubes_2, "8 9 10 11 12", "8 9 10 11 13"), "m.msh:26: an element names the node 13, which $Nodes does not have");
  expect(with(cubes_2, "1 5 6 2 4 8 7 3", "1 5 6 2 4 8 7 7"), "m.msh:27: a hexahedron has the node 7 twice; it is collapsed");
  expect(with(cubes_2, "1 5 6 2 4 8 7 3", "1 5 2 6 4 8 7 3"), "m.msh:27: the hexahedron near (0, 0, 0) m is inverted or flat");
  expect(with(cubes_2, "\n3 0 1 1", "\n3 2 1 1"), "m.msh:27: the hexahedron near");
  expect(with(cubes_2, "3 5 2 1 1 1 5 6 2 4 8 7 3", "3 4 2 1 1 1 5 6 2"),
         "m.msh:27: a tetrahedron: the mesh must hold hexahedra only");
  expect(with(cubes_2, "3 5 2 1 1 1", "3 17 2 1 1 1"),
         "m.msh:27: a hexahedron of second order with 2 groups needs 25 numbers, here are 13");
  expect(with(cubes_2, "3 5 2 1 1 1", "3 92 2 1 1 1"), "m.msh:27: elements of type 92 are not read");
  expect(with(cubes_2, "\n4\n1 3 2", "\n2\n1 3 2"), "m.msh:27: $Elements: here should be $EndElements, not '3'");
  expect(with(cubes_2, "\n4 5 2 1 1 5", "\n3 5 2 1 1 5"), "m.msh:28: the element 3 is there twice");
  expect(with(cubes_2, "2 3 2 8 8 9 10 11 12", "2 3 2 8 8 5 6 7 8"), "m.msh:26: the quadrangle of group 8 lies inside the mesh");
  expect(with(cubes_2, "2 3 2 8 8 9 10 11 12", "2 3 2 8 8 9 11 10 12"), "m.msh:26: the quadrangle is a face of no hexahedron");
  expect(with(cubes_2, "2 3 2 8 8 9 10 11 12", "2 3 2 8 8 1 2 3 4"), "m.msh:26: the face belongs to the groups 7 and 8");
  expect(with(cubes_2, "\n$EndNodes", "\n13 1 0 0\n$EndNodes"), "m.msh:22: $Nodes: here should be $EndNodes, not '13'");
  expect(with(cubes_4, "2 12 1 40", "2 13 1 40"), "m.msh:13: $Nodes says 13 in all, but its blocks hold 12");
  expect(with(cubes_4, "2 12 1 40", "2 12 1 12"), "m.msh:18: a node's tag 40 lies outside the range 1 to 12 said in line 13");
  expect(with(cubes_4, "2 8 3 1", "2 9 3 1"), "$Entities has no entity 9 of dimension 2");
  expect(with(cubes_4, "3 1 5 2\n", "2 7 5 2\n"), "a hexahedron in an entity of dimension 2");
  expect(with(cubes_4, "1 1 1 7 0", "1 1 2 7 8 0"), "m.msh:8: the surface 7 belongs to 2 physical groups");
  expect(with(cubes_4, "1 2 7 8\n", "1 3 7 8\n"), "m.msh:10: an entity of dimension 3 has too few numbers");
}

/// A second cube's own nodes at x = 1: the mesh is torn there.
TEST(GmshFile, TornAndOverlappingMeshesAreRefused) {
  std::string torn = with(cubes_2, "\n12\n", "\n16\n");
  torn = with(torn, "\n$EndNodes", "\n15 1 0 0\n16 1 1 0\n17 1 1 1\n18 1 0 1\n$EndNodes");
  torn = with(torn, "4 5 2 1 1 5 9 10 6 8 12 11 7", "4 5 2 1 1 15 9 10 16 18 12 11 17");
  expect(torn, "m.msh:22: the nodes 5 and 15 lie at one place, (1, 0, 0) m, so that the mesh is torn there");
  std::string folded = cubes_2;  // the second cube folds back over the first
  for (const char* node : {"\n9 2 0 0", "\n10 2 1 0", "\n11 2 1 1", "\n12 2 0 1"})
    folded = with(folded, node, with(node, " 2 ", " 0.5 "));
  expect(folded, "m.msh:28: this hexahedron overlaps that of line 27");
}

/// Distances by hand: beside a face, an edge, a corner, and inside.
TEST(GmshFile, DistanceToTheMesh) {
  const MeshDistance mesh(std::make_shared<const HexahedralMesh>(parse_gmsh(cubes_2, "m.msh")));
  EXPECT_NEAR(mesh.signed_distance({1.0, 0.5, 1.25}), 0.25, 1e-15);
  EXPECT_NEAR(mesh.signed_distance({2.3, 1.4, 0.3}), 0.5, 1e-15);
  EXPECT_NEAR(mesh.signed_distance({-1, -2, -2}), 3.0, 1e-15);
  EXPECT_NEAR(mesh.signed_distance({1.0, 0.5, 0.5}), -0.5, 1e-15);  // the face between the cubes is none
  EXPECT_NEAR(mesh.signed_distance({1.9, 0.5, 0.6}), -0.1, 1e-15);
}

/// Two squares of a meridian side by side, the first on the axis; the outer side is of the group 8, the lower one of 7.
const std::string squares = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
7
1 15 2 0 1 1
2 1 2 7 7 1 2
3 1 2 7 7 2 3
4 1 2 8 8 3 6
5 1 2 9 9 4 1
6 3 2 1 1 1 2 5 4
7 3 2 1 1 2 5 6 3
$EndElements
)";

TEST(GmshFile, MeridiansAreRead) {
  const auto mesh = std::make_shared<const HexahedralMesh>(parse_gmsh(squares, "m.msh", GmshCells::quadrangles));
  ASSERT_EQ(mesh->cells.size(), 2u);
  EXPECT_EQ(mesh->cells[0], (std::array<int, 8>{0, 1, 4, 3, 0, 1, 4, 3}));
  EXPECT_EQ(pieces(*mesh, JoinedBy::faces), (std::vector<int>{0, 0}));
  std::map<int, int> sides;
  for (const auto& [nodes, id] : mesh->faces) {
    EXPECT_EQ(nodes[0], nodes[3]);
    EXPECT_EQ(nodes[1], nodes[2]);
    ++sides[id];
  }
  EXPECT_EQ(sides, (std::map<int, int>{{0, 2}, {7, 2}, {8, 1}})) << "a side on the axis is no face, named or not";
  const MeshDistance distance(mesh);
  EXPECT_DOUBLE_EQ(distance.signed_distance(Vec3(0.25, 0.5, 0)), -0.5) << "the axis is no boundary";
  EXPECT_DOUBLE_EQ(distance.signed_distance(Vec3(3.5, 0.5, 0)), 1.5);
  EXPECT_DOUBLE_EQ(distance.signed_distance(Vec3(1.9, 0.6, 0)), 1.9 - 2.0);
}

TEST(GmshFile, MistakesOfMeridiansAreRefused) {
  const auto refused = [](const std::string& text, const char* part) {
    try {
      parse_gmsh(text, "m.msh", GmshCells::quadrangles);
      ADD_FAILURE() << part;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused(cubes_2, "m.msh:27: a hexahedron: the mesh of an axisymmetric body must hold quadrangles");
  refused(with(squares, "6 3 2 1 1 1 2 5 4", "6 2 2 1 1 1 2 5"), "m.msh:20: a triangle: the mesh of an axisymmetric body");
  refused(with(squares, "6 3 2 1 1 1 2 5 4", "6 20 2 1 1 1 2 5 4"), "elements of type 20");
  refused(with(squares, "6 2 1 0", "6 2 1 0.1"), "m.msh:11: the node 6 at (2, 1, 0.1) m lies off the plane z = 0");
  refused(with(squares, "4 0 1 0", "4 -0.1 1 0"), "m.msh:9: the node 4 at (-0.1, 1, 0) m lies beyond the axis");
  refused(with(squares, "1 2 5 4", "1 2 4 5"), "m.msh:20: the quadrangle near (0, 0, 0) m is inverted or flat");
  refused(with(squares, "5 1 1 0", "5 1.5 0.2 0"), "inverted or flat");
  refused(with(squares, "8 8 3 6", "8 8 3 5"), "m.msh:18: the line is a face of no quadrangle");
  refused(with(squares, "8 8 3 6", "8 8 2 5"), "m.msh:18: the line of group 8 lies inside the mesh, between two quadrangles");
  refused(with(squares, "7 7 2 3", "7 7 3 6"), "but has one name");
  refused(with(with(squares, "3 2 0 0", "3 0.5 0 0"), "6 2 1 0", "6 0.5 1 0"), "overlaps");
  for (std::size_t length = 0; length + 1 < squares.size(); ++length)
    EXPECT_THROW(parse_gmsh(squares.substr(0, length), "m.msh", GmshCells::quadrangles), std::invalid_argument) << length;
  expect(squares, "the mesh holds no hexahedra");
}

TEST(GmshFile, PiecesAreCounted) {
  HexahedralMesh mesh = parse_gmsh(cubes_2, "m.msh");
  EXPECT_EQ(pieces(mesh, JoinedBy::faces), (std::vector<int>{0, 0}));
  const int own = int(mesh.nodes.size());
  for (int k = 0; k < 8; ++k) {  // a third cube that shares the edge at x = 2, y = 1
    const Vec3 x(2 + (k & 1), 1 + (k >> 1 & 1), k >> 2);
    mesh.nodes.push_back(x);
  }
  mesh.cells.push_back({9, own + 1, own + 3, own + 2, 10, own + 5, own + 7, own + 6});
  EXPECT_EQ(pieces(mesh, JoinedBy::faces), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(pieces(mesh, JoinedBy::nodes), (std::vector<int>{0, 0, 0}));
}

/// Every cut of the file is refused with its place, unless nothing but the last end of line is missing.
TEST(GmshFile, EveryCutIsRefused) {
  for (const std::string& whole : {cubes_2, cubes_4})
    for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
      const std::string found = mistake(whole.substr(0, length));
      EXPECT_TRUE(found.starts_with("m.msh:")) << "cut at " << length << ": " << found;
    }
}

/// What is read in spite of a changed number is a mesh of sound cells.
TEST(GmshFile, ChangedNumbersAreRefusedOrGiveSoundCells) {
  std::mt19937 random(7);
  const std::vector<std::string> values{"0",
                                        "1",
                                        "2",
                                        "3",
                                        "5",
                                        "8",
                                        "-1",
                                        "13",
                                        "4",
                                        "1e300",
                                        "nan",
                                        "-0.5",
                                        "0.999",
                                        "1.5",
                                        "99999999999",
                                        "9223372036854775807",
                                        "18446744073709551616",
                                        "x",
                                        "",
                                        "$Nodes",
                                        "2147483648",
                                        "1 1"};
  int sound = 0, refused = 0;
  for (const std::string& whole : {cubes_2, cubes_4})
    for (int i = 0; i < 4000; ++i) {
      std::string text = whole;
      for (int k = 0; k < 1 + i % 2; ++k) {
        const std::size_t at = text.find_first_of(" \n", random() % text.size());
        if (at == std::string::npos || at + 1 >= text.size()) continue;
        const std::size_t end = text.find_first_of(" \n", at + 1);
        text.replace(at + 1, end - at - 1, values[random() % values.size()]);
      }
      try {
        const HexahedralMesh mesh = parse_gmsh(text, "m.msh");
        ++sound;
        for (const auto& cell : mesh.cells) {
          double least = 1e300, most = -1e300;
          for (const double corner : corner_volumes(mesh.nodes, cell)) {
            least = std::min(least, corner);
            most = std::max(most, corner);
          }
          EXPECT_GT(least * most, 0.0) << text;
        }
      } catch (const std::invalid_argument& error) {
        ++refused;
        EXPECT_TRUE(std::string(error.what()).starts_with("m.msh:")) << error.what();
      }
    }
  EXPECT_GT(sound, 100);
  EXPECT_GT(refused, 4000);
}

TEST(GmshFile, GroupsHaveNamesAndNumbers) {
  for (const std::string& text : {cubes_2, cubes_4}) {
    std::string named = text;
    if (text == cubes_4)
      named = with(named, "$EndMeshFormat\n",
                   "$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"all of it\"\n2 7 \"wet side\"\n$EndPhysicalNames\n");
    else named = with(named, "1\n2 7", "2\n3 1 \"all of it\"\n2 7");
    const HexahedralMesh mesh = parse_gmsh(named, "m.msh");
    EXPECT_EQ(mesh.face_names.of(7), "wet side");
    EXPECT_EQ(mesh.face_names.of(8), "8");
    EXPECT_EQ(mesh.face_names.meant_by("7"), "wet side");
    EXPECT_EQ(mesh.face_names.meant_by("8"), "8");
    ASSERT_EQ(mesh.groups.size(), 2u);
    EXPECT_EQ(mesh.group_names.of(mesh.groups[0]), "all of it");
  }
  expect(with(cubes_2, "2 7 \"wet side\"", "2 7 wet"), "m.msh:6: the name of a group must end its line, in quotes");
  expect(with(cubes_2, "2 7 \"wet side\"", "2 7 \"a\\b\""), "m.msh:6: a group's name must be 1 to 127 letters");
  expect(with(cubes_2, "2 7 \"wet side\"", "2 7 \"8\""), "the name of the group 7 is the number 8");
  expect(with(cubes_2, "1\n2 7 \"wet side\"", "2\n2 7 \"a\"\n2 8 \"a\""), "m.msh:7: two groups of dimension 2 have the name 'a'");
  expect(with(cubes_2, "1\n2 7 \"wet side\"", "2\n2 7 \"a\"\n2 7 \"b\""), "m.msh:7: the group 7 of dimension 2 is named twice");
  expect(with(cubes_2, "1\n2 7 \"wet side\"", "3\n2 7 \"a\""), "$PhysicalNames: the counts do not fit");
  expect(with(cubes_4, "1 0 0 0 2 1 1 1 1 2 7 8", "1 0 0 0 2 1 1 2 1 2 2 7 8"),
         "the volume 1 belongs to 2 physical groups, but a cell has one material");
}

TEST(GmshFile, OfTheSecondOrderTheCornersAreTaken) {
  // One cube of 20 nodes, whose middles need not be those of its edges.
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n20\n";
  const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int i = 0; i < 8; ++i)
    text += std::to_string(i + 1) + " " + std::to_string(corner[i][0]) + " " + std::to_string(corner[i][1]) + " " +
            std::to_string(corner[i][2]) + "\n";
  for (int i = 8; i < 20; ++i) text += std::to_string(i + 1) + " 0.5 " + std::to_string(0.01 * i) + " 0.5\n";
  text +=
      "$EndNodes\n$Elements\n2\n1 16 2 3 3 1 2 3 4 9 12 14 10\n2 17 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 "
      "20\n$EndElements\n";
  const HexahedralMesh mesh = parse_gmsh(text, "m.msh");
  EXPECT_EQ(mesh.nodes.size(), 8u);
  EXPECT_DOUBLE_EQ(volume(mesh), 1.0);
  ASSERT_EQ(mesh.remarks.size(), 1u);
  EXPECT_NE(mesh.remarks[0].find("of the second order"), std::string::npos);
  expect(with(cubes_2, "3 5 2 1 1 1 5 6 2 4 8 7 3", "3 11 2 1 1 1 5 6 2 4 8 7 3 9 10"),
         "a tetrahedron of second order: the mesh must hold hexahedra only");
  expect(with(cubes_2, "3 5 2 1 1 1 5 6 2 4 8 7 3", "3 6 2 1 1 1 5 6 2 4 8"), "Mesh.SubdivisionAlgorithm = 2");
}

TEST(GmshFile, QuadranglesInSpaceAreASurface) {
  const std::string text = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 5 "edge"
2 7 "plate"
$EndPhysicalNames
$Nodes
7
1 0 0 0
2 1 0 0
3 2 0 0.5
4 0 1 0
5 1 1 0
6 2 1 0.5
9 9 9 9
$EndNodes
$Elements
4
1 1 2 5 1 1 4
2 3 2 7 1 1 2 5 4
3 3 2 8 1 2 3 6 5
4 15 2 0 1 9
$EndElements
)";
  const QuadrangleSurface surface = parse_gmsh_surface(text, "m.msh");
  EXPECT_EQ(surface.nodes.size(), 6u);
  EXPECT_EQ(surface.cells.size(), 2u);
  EXPECT_EQ(surface.group_names.of(surface.groups[0]), "plate");
  EXPECT_EQ(surface.group_names.of(surface.groups[1]), "8");
  ASSERT_EQ(surface.edges.size(), 1u);
  EXPECT_EQ(surface.edge_names.of(surface.edges[0].id), "edge");
  const auto refused = [&](const std::string& old, const std::string& replacement, const std::string& expected) {
    try {
      parse_gmsh_surface(with(text, old, replacement), "m.msh");
      ADD_FAILURE() << "read: " << replacement;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  };
  refused("1 1 2 5 4", "1 1 5 2 4", "m.msh:22: the quadrangle near (0, 0, 0) m is flat or folded");
  refused("3 3 2 8 1 2 3 6 5", "3 3 2 8 1 1 2 5 4", "m.msh:23: this quadrangle has the nodes of that of line 22");
  refused("3 3 2 8 1 2 3 6 5", "3 2 2 8 1 2 3 6", "a triangle: the mesh of a shell must hold quadrangles only");
  refused("3 3 2 8 1 2 3 6 5", "3 5 2 8 1 1 2 3 4 5 6 7 9", "a hexahedron: the mesh of a shell must hold quadrangles only");
}

/// A skew cell: what is inside is where all three unit coordinates are.
TEST(GmshFile, DistanceKnowsTheInsideOfSkewCells) {
  Mat3 edges;
  edges << 1, 0.6, -0.2, 0.3, 1, 0.4, -0.5, 0.2, 0.3;
  auto mesh = std::make_shared<HexahedralMesh>();
  const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (const auto& c : corner) mesh->nodes.push_back(edges * Vec3(c[0], c[1], c[2]));
  mesh->cells = {{0, 1, 2, 3, 4, 5, 6, 7}};
  for (const auto& face : hexahedron_faces) mesh->faces.push_back({{face[0], face[1], face[2], face[3]}, 0});
  const MeshDistance distance(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.5, 1.5);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 u(unit(random), unit(random), unit(random));
    double nearest = 1e300;  // to a side, from within
    for (int d = 0; d < 3; ++d) {
      const Vec3 normal = edges.col((d + 1) % 3).cross(edges.col((d + 2) % 3)).normalized();
      nearest = std::min(nearest, std::min(u[d], 1 - u[d]) * std::abs(normal.dot(edges.col(d))));
    }
    const double found = distance.signed_distance(edges * u);
    EXPECT_EQ(found<0, nearest> 0) << u.transpose();
    if (nearest <= 0) continue;
    EXPECT_NEAR(found, -nearest, 1e-12);
    ++inside;
  }
  EXPECT_GT(inside, 100);
}

}  // namespace
}  // namespace undex
