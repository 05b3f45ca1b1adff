#include "core/gmsh_file.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "core/record.hpp"
#include "core/surface.hpp"

namespace undex {
namespace {

constexpr const char* resave = "save it again as ASCII of version 2.2 or 4.1 (gmsh -format msh22)";

/// What gmsh calls an element's type: its name, dimension and count of nodes; and of the second order the type that its corners,
/// which come first, are one of.
struct ElementType {
  int number;
  const char* name;
  int dimension;
  std::size_t nodes;
  int first_order = 0;
  std::size_t corners = nodes;
};
constexpr ElementType known_types[] = {{15, "point", 0, 1},
                                       {1, "line", 1, 2},
                                       {2, "triangle", 2, 3},
                                       {3, "quadrangle", 2, 4},
                                       {4, "tetrahedron", 3, 4},
                                       {5, "hexahedron", 3, 8},
                                       {6, "prism", 3, 6},
                                       {7, "pyramid", 3, 5},
                                       {8, "line of second order", 1, 3, 1, 2},
                                       {9, "triangle of second order", 2, 6, 2, 3},
                                       {10, "quadrangle of second order", 2, 9, 3, 4},
                                       {16, "quadrangle of second order", 2, 8, 3, 4},
                                       {11, "tetrahedron of second order", 3, 10, 4, 4},
                                       {12, "hexahedron of second order", 3, 27, 5, 8},
                                       {17, "hexahedron of second order", 3, 20, 5, 8},
                                       {13, "prism of second order", 3, 18, 6, 6},
                                       {18, "prism of second order", 3, 15, 6, 6},
                                       {14, "pyramid of second order", 3, 14, 7, 5},
                                       {19, "pyramid of second order", 3, 13, 7, 5}};

/// A text line by line, empty lines passed over, each cut into words.
class Lines {
 public:
  Lines(std::string_view text, const std::string& path) : rest_(text), path_(path) {}

  [[noreturn]] void fail(long line, const std::string& what) const {
    throw std::invalid_argument(path_ + ":" + std::to_string(line) + ": " + what);
  }
  [[noreturn]] void fail(const std::string& what) const { fail(number_, what); }

  bool next() {
    words_.clear();
    while (words_.empty() && !rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      std::string_view line = rest_.substr(0, end);
      line_ = line;
      rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
      ++number_;
      constexpr const char* blank = " \t\r\v\f";
      for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos; at = line.find_first_not_of(blank, at)) {
        const std::size_t stop = std::min(line.find_first_of(blank, at), line.size());
        words_.push_back(line.substr(at, stop - at));
        at = stop;
        if (at == line.size()) break;
      }
    }
    return !words_.empty();
  }
  /// The next line, of a section.
  void need(const std::string& section) {
    if (!next()) fail("the file ends within " + section + "; it is cut off: save it again");
    if (words_[0].starts_with('$') && !words_[0].starts_with("$End"))
      fail(std::string(words_[0]) + " begins within " + section + ", which has no end or too few lines; save it again");
  }
  void need_words(const std::string& section, std::size_t count, const char* what) {
    need(section);
    if (words_.size() != count)
      fail(section + ": " + what + " needs " + std::to_string(count) + " numbers on a line, here are " +
           std::to_string(words_.size()) + (words_[0].starts_with("$End") ? ": the counts do not fit what follows" : ""));
  }

  const std::vector<std::string_view>& words() const { return words_; }
  std::string_view line() const { return line_; }
  long number() const { return number_; }
  std::size_t bytes_left() const { return rest_.size(); }

  long long whole(std::size_t word, const char* what, long long least, long long most) const {
    const std::string_view text = words_[word];
    long long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(std::string(what) + " must be a whole number, not '" + shown(text) + "'");
    if (value < least || value > most)
      fail(std::string(what) + " = " + std::to_string(value) + " is out of range, " + std::to_string(least) + " to " +
           std::to_string(most));
    return value;
  }
  double real(std::size_t word, const char* what) const {
    std::string_view text = words_[word];
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool tiny = error == std::errc::result_out_of_range && text.find_first_of("eE") != std::string_view::npos &&
                      text[std::min(text.find_first_of("eE") + 1, text.size() - 1)] == '-';
    if ((error != std::errc() && !tiny) || end != text.data() + text.size() || !std::isfinite(value))
      fail(std::string(what) + " must be a finite number, not '" + shown(text) + "'");
    return value;
  }
  static std::string shown(std::string_view text) {
    std::string plain(text.substr(0, 40));
    for (char& c : plain)
      if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
    return plain;
  }

 private:
  std::string_view rest_, line_;
  std::string path_;
  std::vector<std::string_view> words_;
  long number_ = 0;
};

/// What cells and faces are called, their elements, and how to get them.
struct Kind {
  int dimension;  ///< of the cells
  const char *cell, *cells, *face, *face_entity;
  int cell_type, face_type;
  const char *wanted, *remedy;
  std::span<const int[4]> sides;  ///< a cell's faces
};
constexpr Kind hexahedra{.dimension = 3,
                         .cell = "hexahedron",
                         .cells = "hexahedra",
                         .face = "quadrangle",
                         .face_entity = "surface",
                         .cell_type = 5,
                         .face_type = 3,
                         .wanted = "the mesh must hold hexahedra only (and the quadrangles of their faces)",
                         .remedy =
                             "mesh with recombined, transfinite volumes in gmsh, or have it divide all into hexahedra "
                             "(Mesh.SubdivisionAlgorithm = 2)",
                         .sides = hexahedron_faces};
constexpr Kind quadrangles{.dimension = 2,
                           .cell = "quadrangle",
                           .cells = "quadrangles",
                           .face = "line",
                           .face_entity = "curve",
                           .cell_type = 3,
                           .face_type = 1,
                           .wanted =
                               "the mesh of an axisymmetric body must hold quadrangles of its meridian only (and the lines "
                               "of their sides)",
                           .remedy = "mesh the meridian with recombined surfaces in gmsh",
                           .sides = std::span(hexahedron_faces).subspan(2)};
constexpr Kind surface = [] {
  Kind kind = quadrangles;
  kind.wanted = "the mesh of a shell must hold quadrangles only (and the lines of their edges)";
  kind.remedy = "mesh the surfaces alone, recombined, in gmsh (Mesh.RecombineAll = 1, Mesh.SubdivisionAlgorithm = 1)";
  return kind;
}();

class Reader {
 public:
  Reader(std::string_view text, const std::string& path, const Kind& kind) : lines_(text, path), kind_(kind) {}

  HexahedralMesh mesh() {
    read_cells();
    if (kind_.dimension == 2) lay_into_meridian();
    check_shapes();
    check_distinct_nodes();
    find_outer_faces();
    name_groups(mesh_.group_names, mesh_.face_names);
    mesh_.groups = std::move(cell_groups_);
    note_second_order(mesh_.remarks);
    return std::move(mesh_);
  }

  QuadrangleSurface quadrangle_surface() {
    read_cells();
    check_quadrangles();
    check_distinct_nodes();
    QuadrangleSurface found;
    for (const auto& cell : mesh_.cells) found.cells.push_back({cell[0], cell[1], cell[2], cell[3]});
    for (const HexahedralMesh::Face& line : faces_)
      if (line.nodes[0] >= 0) found.edges.push_back({{line.nodes[0], line.nodes[1]}, line.id});
    found.nodes = std::move(mesh_.nodes);
    found.groups = std::move(cell_groups_);
    name_groups(found.group_names, found.edge_names);
    note_second_order(found.remarks);
    return found;
  }

 private:
  static constexpr long long any_tag = 1ll << 62;

  /// Cells and faces as they stand, and the nodes that cells have.
  void read_cells() {
    read_format();
    while (lines_.next()) read_section();
    if (!has_nodes_) lines_.fail("the file ends without $Nodes; it is cut off or holds no mesh");
    if (!has_elements_) lines_.fail("the file ends without $Elements; it is cut off or holds no mesh");
    if (cells_.empty())
      lines_.fail(
          std::string("the mesh holds no ") + kind_.cells + "; " + kind_.remedy + ", and save them too" +
          (kind_.dimension == 3 && quadrangles_ > 0 ? "; or element = \"shell\" with a thickness for its quadrangles" : ""));
    keep_used_nodes();
  }

  void read_format() {
    if (!lines_.next() || lines_.words()[0] != "$MeshFormat")
      lines_.fail(std::string("this is not a gmsh mesh of ") + kind_.cells + ": it does not begin with $MeshFormat; " + resave);
    lines_.need_words("$MeshFormat", 3, "the version");
    const double version = lines_.real(0, "the version");
    const long long binary = lines_.whole(1, "the file type", 0, 1);
    if (binary == 1) lines_.fail(std::string("the mesh is binary; ") + resave);
    four_ = version == 4.1;
    if (!four_ && !(version >= 2.0 && version <= 2.2))
      lines_.fail("version " + Lines::shown(lines_.words()[0]) + " of gmsh's format is not read; " + resave);
    if (lines_.whole(2, "the size of a number", 1, 64) != 8)
      lines_.fail(std::string("the size of a number must be 8 bytes; ") + resave);
    end("MeshFormat");
  }

  void end(const std::string& name) {
    lines_.need("$" + name);
    if (lines_.words()[0] != "$End" + name)
      lines_.fail("$" + name + ": here should be $End" + name + ", not '" + Lines::shown(lines_.words()[0]) +
                  "': the counts do not fit what follows");
  }

  void read_section() {
    const std::string name(lines_.words()[0]);
    if (!name.starts_with('$') || name.starts_with("$End") || lines_.words().size() != 1)
      lines_.fail("here should begin a section, such as $Nodes, not '" + Lines::shown(name) + "'");
    const auto once = [&](bool& had) {
      if (had) lines_.fail(name + " is there twice; keep one of them");
      had = true;
    };
    if (name == "$Entities" && four_) {
      once(has_entities_);
      if (has_elements_) lines_.fail("$Entities must come before $Elements");
      read_entities();
    } else if (name == "$Nodes") {
      once(has_nodes_);
      four_ ? read_nodes_4() : read_nodes_2();
    } else if (name == "$Elements") {
      once(has_elements_);
      if (!has_nodes_) lines_.fail("$Elements must come after $Nodes");
      four_ ? read_elements_4() : read_elements_2();
    } else if (name == "$PhysicalNames") {
      once(has_names_);
      read_names();
    } else if (name == "$MeshFormat") {
      lines_.fail("$MeshFormat is there twice: two files in one?");
    } else {
      pass_over(name);
    }
  }

  void pass_over(const std::string& name) {
    const long begin = lines_.number();
    while (lines_.next()) {
      if (lines_.words()[0] == "$End" + name.substr(1)) return;
      if (lines_.words()[0].starts_with('$'))
        lines_.fail(std::string(lines_.words()[0]) + " begins within " + name + ", which has no end");
    }
    lines_.fail(begin, name + " has no end; the file is cut off: save it again");
  }

  /// A count of things of which each takes two bytes of the file at least.
  long long count(std::size_t word, const char* what) {
    return lines_.whole(word, what, 0, std::min<long long>(long(lines_.bytes_left() / 2) + 1, 2000000000));
  }

  /// dimension, number, name in quotes, of each group.
  void read_names() {
    const std::string section = "$PhysicalNames";
    lines_.need_words(section, 1, "the count of names");
    const long long all = count(0, "the count of names");
    std::set<std::string> taken[4];
    for (long long i = 0; i < all; ++i) {
      lines_.need(section);
      if (lines_.words()[0].starts_with("$End")) lines_.fail(section + ": the counts do not fit: it ends too early");
      if (lines_.words().size() < 3) lines_.fail(section + ": a name needs a dimension, a number and a name in quotes");
      const auto dimension = int(lines_.whole(0, "a group's dimension", 0, 3));
      const auto id = int(std::abs(lines_.whole(1, "a group's number", -2000000000, 2000000000)));
      const std::string name = quoted_name();
      if (!names_[dimension].emplace(id, name).second)
        lines_.fail("the group " + std::to_string(id) + " of dimension " + std::to_string(dimension) + " is named twice");
      if (!taken[dimension].insert(name).second)
        lines_.fail("two groups of dimension " + std::to_string(dimension) + " have the name '" + name + "'; rename one of them");
    }
    end("PhysicalNames");
  }

  std::string quoted_name() const {
    const std::string_view line = lines_.line();
    const std::size_t begin = line.find('"'), close = line.rfind('"');
    const std::size_t after = close == std::string_view::npos ? close : line.find_first_not_of(" \t\r\v\f", close + 1);
    if (close == begin || after != std::string_view::npos) lines_.fail("the name of a group must end its line, in quotes");
    const std::string name(line.substr(begin + 1, close - begin - 1));
    const auto odd = [](char c) { return c < 32 || c > 126 || c == '"' || c == '\\'; };
    if (name.empty() || name.size() > 127 || std::any_of(name.begin(), name.end(), odd))
      lines_.fail(
          "a group's name must be 1 to 127 letters, digits, blanks and signs of ASCII, without quotes and backslashes, not '" +
          Lines::shown(name) + "'; rename it");
    return name;
  }

  /// Names of cells' and of faces' groups. One that is a number must not be that of another group.
  void name_groups(GroupNames& cells, GroupNames& faces) const {
    for (const auto& [names, dimension] : {std::pair(&cells, kind_.dimension), std::pair(&faces, kind_.dimension - 1)})
      for (const auto& [id, name] : names_[dimension]) {
        if (name.find_first_not_of("0123456789") == std::string::npos && name != std::to_string(id))
          lines_.fail("the name of the group " + std::to_string(id) + " is the number " + name +
                      ", which another group may have; give it a letter");
        names->given.emplace(id, name);
      }
  }

  void note_second_order(std::vector<std::string>& remarks) const {
    if (!second_order_) return;
    remarks.push_back(
        "the mesh is of the second order; only the corners of its cells are taken, so that edges are straight "
        "between them: set Mesh.ElementOrder = 1 in gmsh, with smaller cells where the shape is curved");
  }

  void read_entities() {
    const std::string section = "$Entities";
    lines_.need_words(section, 4, "its first line");
    long long counts[4];
    for (std::size_t d = 0; d < 4; ++d) counts[d] = count(d, "a count of entities");
    for (std::size_t d = 0; d < 4; ++d)
      for (long long i = 0; i < counts[d]; ++i) {
        lines_.need(section);
        if (lines_.words()[0].starts_with("$End")) lines_.fail(section + ": the counts do not fit: it ends too early");
        read_entity(int(d));
      }
    end("Entities");
  }

  /// tag, box (a point: its place), count of physical groups, these, and but for points count of what bounds it, these.
  void read_entity(int dimension) {
    const std::size_t words = lines_.words().size(), at = dimension == 0 ? 4 : 7;
    const auto need = [&](std::size_t least) {
      if (words < least)
        lines_.fail("an entity of dimension " + std::to_string(dimension) + " has too few numbers: " + std::to_string(words) +
                    ", at least " + std::to_string(least) + " are needed");
    };
    need(at + 1);
    const long long tag = lines_.whole(0, "an entity's tag", -any_tag, any_tag);
    for (std::size_t k = 1; k < at; ++k) lines_.real(k, "an entity's box");
    const long long groups = lines_.whole(at, "the count of physical groups", 0, 1000000);
    need(at + 1 + std::size_t(groups));
    long long id = 0;
    for (long long k = 0; k < groups; ++k)
      id = std::abs(lines_.whole(at + 1 + std::size_t(k), "a physical group", -2000000000, 2000000000));
    if (groups > 1 && dimension == kind_.dimension - 1)
      lines_.fail(std::string("the ") + kind_.face_entity + " " + std::to_string(tag) + " belongs to " + std::to_string(groups) +
                  " physical groups, but a face has one name; leave it in one of them");
    if (groups > 1 && dimension == kind_.dimension)
      lines_.fail(std::string("the ") + (dimension == 3 ? "volume " : "surface ") + std::to_string(tag) + " belongs to " +
                  std::to_string(groups) + " physical groups, but a cell has one material; leave it in one of them");
    std::size_t used = at + 1 + std::size_t(groups);
    if (dimension > 0) {
      need(used + 1);
      used += 1 + std::size_t(lines_.whole(used, "the count of what bounds an entity", 0, 1000000000));
      need(used);
      for (std::size_t k = at + 2 + std::size_t(groups); k < used; ++k)
        lines_.whole(k, "the tag of what bounds an entity", -any_tag, any_tag);
    }
    if (used != words)
      lines_.fail("an entity has " + std::to_string(words) + " numbers where its counts say " + std::to_string(used));
    if (!groups_[dimension].emplace(tag, int(id)).second)
      lines_.fail("the entity " + std::to_string(tag) + " of dimension " + std::to_string(dimension) + " is there twice");
  }

  void add_node(long long tag, std::size_t first_word, long line) {
    Vec3 x;
    for (int a = 0; a < 3; ++a) {
      x[a] = lines_.real(first_word + std::size_t(a), "a coordinate");
      if (std::abs(x[a]) > Range::farthest)
        lines_.fail("a coordinate of " + Lines::shown(lines_.words()[first_word + std::size_t(a)]) +
                    " is out of range, -1e5 to 1e5 m; is the mesh in metres?");
    }
    if (!index_.emplace(tag, int(nodes_.size())).second) lines_.fail("the node " + std::to_string(tag) + " is there twice");
    nodes_.push_back(x);
    node_lines_.push_back(line);
    node_tags_.push_back(tag);
  }

  void read_nodes_2() {
    const std::string section = "$Nodes";
    lines_.need_words(section, 1, "the count of nodes");
    const long long all = count(0, "the count of nodes");
    for (long long i = 0; i < all; ++i) {
      lines_.need_words(section, 4, "a node (tag, x, y, z)");
      add_node(lines_.whole(0, "a node's tag", 1, any_tag), 1, lines_.number());
    }
    end("Nodes");
  }

  struct Header {
    long long blocks, all, least, most;
    long line;
  };
  Header read_header(const std::string& section) {
    lines_.need_words(section, 4, "its first line (blocks, count, least and largest tag)");
    return {count(0, "the count of blocks"), count(1, "the count"), lines_.whole(2, "the least tag", 0, any_tag),
            lines_.whole(3, "the largest tag", 0, any_tag), lines_.number()};
  }
  long long tag_within(const Header& header, const char* what) {
    const long long tag = lines_.whole(0, what, 1, any_tag);
    if (tag < header.least || tag > header.most)
      lines_.fail(std::string(what) + " " + std::to_string(tag) + " lies outside the range " + std::to_string(header.least) +
                  " to " + std::to_string(header.most) + " said in line " + std::to_string(header.line));
    return tag;
  }
  void expect_count(const std::string& section, const Header& header, long long found) {
    if (found != header.all)
      lines_.fail(header.line,
                  section + " says " + std::to_string(header.all) + " in all, but its blocks hold " + std::to_string(found));
  }

  void read_nodes_4() {
    const std::string section = "$Nodes";
    const Header header = read_header(section);
    long long found = 0;
    for (long long b = 0; b < header.blocks; ++b) {
      lines_.need_words(section, 4, "a block (dimension, entity, parametric, count)");
      const auto dimension = std::size_t(lines_.whole(0, "an entity's dimension", 0, 3));
      lines_.whole(1, "an entity's tag", -any_tag, any_tag);
      const bool parametric = lines_.whole(2, "'parametric'", 0, 1) == 1;
      const long long here = count(3, "the count of nodes");
      std::vector<long long> tags;
      for (long long i = 0; i < here; ++i) {
        lines_.need_words(section, 1, "a node's tag");
        tags.push_back(tag_within(header, "a node's tag"));
      }
      for (const long long tag : tags) {
        lines_.need_words(section, parametric ? 3 + dimension : 3, "a node's place (x, y, z)");
        for (std::size_t k = 3; k < lines_.words().size(); ++k) lines_.real(k, "a parametric coordinate");
        add_node(tag, 0, lines_.number());
      }
      found += here;
    }
    end("Nodes");
    expect_count(section, header, found);
  }

  const ElementType& type(long long number) {
    for (const ElementType& each : known_types)
      if (each.number == number) {
        const int first = each.first_order ? each.first_order : each.number;
        const bool below = each.dimension < kind_.dimension - 1 || first == 1;  // points and lines
        if (first == 3) ++quadrangles_;
        if (!below && first != kind_.cell_type && first != kind_.face_type)
          lines_.fail(std::string("a ") + each.name + ": " + kind_.wanted + "; " + kind_.remedy);
        return each;
      }
    lines_.fail("elements of type " + std::to_string(number) + " are not read: " + kind_.wanted + ", of the first order; " +
                kind_.remedy);
  }

  void add_element(const ElementType& of, std::size_t first_word, int id, long long tag) {
    if (!element_tags_.emplace(tag, 0).second) lines_.fail("the element " + std::to_string(tag) + " is there twice");
    std::vector<int> nodes;
    for (std::size_t k = 0; k < of.nodes; ++k) {
      const long long node = lines_.whole(first_word + k, "an element's node", 1, any_tag);
      const auto found = index_.find(node);
      if (found == index_.end())
        lines_.fail("an element names the node " + std::to_string(node) + ", which $Nodes does not have");
      if (std::find(nodes.begin(), nodes.end(), found->second) != nodes.end())
        lines_.fail(std::string("a ") + of.name + " has the node " + std::to_string(node) + " twice; it is collapsed");
      nodes.push_back(found->second);
    }
    const int first = of.first_order ? of.first_order : of.number;
    if (first == kind_.cell_type) {
      second_order_ |= of.first_order != 0;
      std::array<int, 8> cell;
      for (std::size_t k = 0; k < 8; ++k) cell[k] = nodes[k % of.corners];
      cells_.push_back(cell);
      cell_groups_.push_back(id);
      cell_lines_.push_back(lines_.number());
    } else if (first == kind_.face_type) {
      if (kind_.dimension == 2) faces_.push_back({{nodes[0], nodes[1], nodes[1], nodes[0]}, id});
      else faces_.push_back({{nodes[0], nodes[1], nodes[2], nodes[3]}, id});
      face_lines_.push_back(lines_.number());
    }
  }

  void read_elements_2() {
    const std::string section = "$Elements";
    lines_.need_words(section, 1, "the count of elements");
    const long long all = count(0, "the count of elements");
    for (long long i = 0; i < all; ++i) {
      lines_.need(section);
      if (lines_.words()[0].starts_with("$End")) lines_.fail(section + ": the counts do not fit: it ends too early");
      if (lines_.words().size() < 4) lines_.fail("an element has too few numbers: tag, type, count of groups, groups, nodes");
      const long long tag = lines_.whole(0, "an element's tag", 1, any_tag);
      const ElementType& of = type(lines_.whole(1, "an element's type", 1, 1000));
      const auto groups = std::size_t(lines_.whole(2, "the count of an element's groups", 0, 1000000));
      if (lines_.words().size() != 3 + groups + of.nodes)
        lines_.fail(std::string("a ") + of.name + " with " + std::to_string(groups) + " groups needs " +
                    std::to_string(3 + groups + of.nodes) + " numbers, here are " + std::to_string(lines_.words().size()));
      int id = 0;
      for (std::size_t k = 0; k < groups; ++k) {
        const long long group = lines_.whole(3 + k, "an element's group", -2000000000, 2000000000);
        if (k == 0) id = int(std::abs(group));
      }
      add_element(of, 3 + groups, id, tag);
    }
    end("Elements");
  }

  void read_elements_4() {
    const std::string section = "$Elements";
    const Header header = read_header(section);
    long long found = 0;
    for (long long b = 0; b < header.blocks; ++b) {
      lines_.need_words(section, 4, "a block (dimension, entity, type, count)");
      const auto dimension = int(lines_.whole(0, "an entity's dimension", 0, 3));
      const long long entity = lines_.whole(1, "an entity's tag", -any_tag, any_tag);
      const ElementType& of = type(lines_.whole(2, "an element's type", 1, 1000));
      const long long here = count(3, "the count of elements");
      if (of.dimension != dimension)
        lines_.fail(std::string("a ") + of.name + " in an entity of dimension " + std::to_string(dimension));
      int id = 0;
      if (has_entities_) {
        const auto known = groups_[dimension].find(entity);
        if (known == groups_[dimension].end())
          lines_.fail("$Entities has no entity " + std::to_string(entity) + " of dimension " + std::to_string(dimension));
        id = known->second;
      }
      for (long long i = 0; i < here; ++i) {
        lines_.need_words(section, 1 + of.nodes, (std::string("a ") + of.name).c_str());
        add_element(of, 1, id, tag_within(header, "an element's tag"));
      }
      found += here;
    }
    end("Elements");
    expect_count(section, header, found);
  }

  void keep_used_nodes() {
    std::vector<int> kept(nodes_.size(), -1);
    for (const auto& cell : cells_)
      for (const int node : cell) kept[node] = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (kept[i] == 0) {
        kept[i] = int(mesh_.nodes.size());
        mesh_.nodes.push_back(nodes_[i]);
        original_.push_back(i);
      }
    for (auto& cell : cells_)
      for (int& node : cell) node = kept[node];
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (int& node : faces_[f].nodes) {
        node = kept[node];
        if (node < 0 && &kind_ != &surface)
          lines_.fail(face_lines_[f], std::string("the ") + kind_.face + " is a face of no " + kind_.cell +
                                          "; remove it, or mesh what is behind it");
      }
    mesh_.cells = cells_;
  }

  /// Nodes of a meridian lie in the plane z = 0, at or beyond the axis.
  void lay_into_meridian() {
    const Bounds box = bounds(mesh_);
    const double near = 1e-9 * (box.high - box.low).maxCoeff();
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) {
      Vec3& x = mesh_.nodes[i];
      const std::string node = "the node " + std::to_string(node_tags_[original_[i]]) + " at " + place(x);
      if (std::abs(x[2]) > near)
        lines_.fail(node_lines_[original_[i]],
                    node + " lies off the plane z = 0; mesh the meridian, with x the distance from the axis and y along it");
      if (x[0] < -near)
        lines_.fail(node_lines_[original_[i]], node + " lies beyond the axis x = 0; mesh the half of the meridian with x >= 0");
      if (x[0] <= near) x[0] = 0.0;
      x[2] = 0.0;
    }
  }

  std::string place(const Vec3& x) const {
    std::ostringstream text;
    text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ") m";
    return text.str();
  }

  /// A sound cell has eight corner volumes of one sign; mirrored ones are turned when the mesh is built.
  void check_shapes() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const auto volumes = corner_volumes(mesh_.nodes, mesh_.cells[c]);
      double longest = 0;
      Bounds box;
      for (const int node : mesh_.cells[c]) box.include(mesh_.nodes[node]);
      longest = (box.high - box.low).maxCoeff();
      const auto [least, most] = std::minmax_element(volumes.begin(), volumes.end());
      const double flat = 1e-12 * longest * longest * longest;
      if (*least > flat || *most < -flat) continue;
      lines_.fail(cell_lines_[c],
                  std::string("the ") + kind_.cell + " near " + place(mesh_.nodes[mesh_.cells[c][0]]) +
                      " is inverted or flat: its nodes are out of order or at the wrong place; repair the mesh there");
    }
  }

  /// The corners of a quadrangle in space are seen in one order from one side, and no two cells have the same.
  void check_quadrangles() {
    std::map<std::array<int, 4>, std::size_t> seen;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const std::array<int, 8>& cell = mesh_.cells[c];
      const auto at = [&](int v) -> const Vec3& { return mesh_.nodes[cell[v % 4]]; };
      const Vec3 across = (at(2) - at(0)).cross(at(3) - at(1));
      double longest = 0.0, least = 1e300;
      for (int v = 0; v < 4; ++v) {
        longest = std::max(longest, (at(v + 1) - at(v)).norm());
        least = std::min(least, (at(v + 1) - at(v)).cross(at(v + 3) - at(v)).dot(across));
      }
      if (!(least > 1e-12 * longest * longest * across.norm()))
        lines_.fail(cell_lines_[c],
                    "the quadrangle near " + place(at(0)) +
                        " is flat or folded: its nodes are out of order or at the wrong place; repair the mesh there");
      std::array<int, 4> key{cell[0], cell[1], cell[2], cell[3]};
      std::sort(key.begin(), key.end());
      const auto [found, fresh] = seen.emplace(key, c);
      if (!fresh)
        lines_.fail(cell_lines_[c], "this quadrangle has the nodes of that of line " +
                                        std::to_string(cell_lines_[found->second]) + "; remove one of them");
    }
  }

  void check_distinct_nodes() {
    double shortest = 1e300;
    for (const auto& cell : mesh_.cells)
      for (const auto& face : hexahedron_faces)
        for (int v = 0; v < 4; ++v) {
          const int a = cell[face[v]], b = cell[face[(v + 1) % 4]];
          if (a != b) shortest = std::min(shortest, (mesh_.nodes[a] - mesh_.nodes[b]).norm());
        }
    const double unit = std::max(1e-6 * shortest, 1e-13 * Range::farthest);
    std::map<std::array<long long, 3>, int> at;
    const auto key = [&](const Vec3& x) {
      return std::array<long long, 3>{std::llround(x[0] / unit), std::llround(x[1] / unit), std::llround(x[2] / unit)};
    };
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) {
      for (int corner = 0; corner < 8; ++corner) {
        Vec3 x = mesh_.nodes[i];
        for (int a = 0; a < 3; ++a) x[a] += (corner >> a & 1 ? 0.25 : -0.25) * unit;
        const auto found = at.find(key(x));
        if (found == at.end()) continue;
        lines_.fail(node_lines_[original_[i]], "the nodes " + std::to_string(node_tags_[original_[std::size_t(found->second)]]) +
                                                   " and " + std::to_string(node_tags_[original_[i]]) + " lie at one place, " +
                                                   place(mesh_.nodes[i]) +
                                                   ", so that the mesh is torn there; join them (gmsh: Coherence Mesh)");
      }
      at.emplace(key(mesh_.nodes[i]), int(i));
    }
  }

  void find_outer_faces() {
    struct Seen {
      std::array<int, 4> nodes;
      std::array<int, 2> cells{-1, -1};
      int id = 0;
      bool tagged = false;
    };
    std::map<std::array<int, 4>, Seen> seen;
    const auto sorted = [](std::array<int, 4> nodes) {
      std::sort(nodes.begin(), nodes.end());
      return nodes;
    };
    const auto same_round = [](const std::array<int, 4>& a, const std::array<int, 4>& b) {
      const auto at = std::find(b.begin(), b.end(), a[0]) - b.begin();
      return a[2] == b[std::size_t(at + 2) % 4];  // else a diagonal of one is a side of the other
    };
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (const auto& face : kind_.sides) {
        std::array<int, 4> nodes;
        for (int v = 0; v < 4; ++v) nodes[v] = mesh_.cells[c][face[v]];
        Seen& one = seen[sorted(nodes)];
        if (one.cells[1] >= 0)
          lines_.fail(cell_lines_[c],
                      std::string("a face of this ") + kind_.cell + " belongs to three of them; remove the one too many");
        if (one.cells[0] >= 0 && !same_round(one.nodes, nodes))
          lines_.fail(cell_lines_[c], std::string("this ") + kind_.cell + " and that of line " +
                                          std::to_string(cell_lines_[one.cells[0]]) +
                                          " share four nodes, but not the same face; repair the order of its nodes");
        one.cells[one.cells[0] < 0 ? 0 : 1] = int(c);
        if (one.cells[1] < 0) one.nodes = nodes;
        else expect_two_sides(one.nodes, one.cells);
      }
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto& [nodes, id] = faces_[f];
      const auto found = seen.find(sorted(nodes));
      if (found == seen.end() || !same_round(found->second.nodes, nodes))
        lines_.fail(face_lines_[f], std::string("the ") + kind_.face + " is a face of no " + kind_.cell +
                                        "; remove it, or repair the order of its nodes");
      Seen& one = found->second;
      if (one.cells[1] >= 0) {
        if (id == 0) continue;
        lines_.fail(face_lines_[f], std::string("the ") + kind_.face + " of group " + std::to_string(id) +
                                        " lies inside the mesh, between two " + kind_.cells + "; name outer faces only");
      }
      if (one.tagged && one.id != id)
        lines_.fail(face_lines_[f], "the face belongs to the groups " + std::to_string(one.id) + " and " + std::to_string(id) +
                                        ", but has one name; leave it in one of them");
      one.id = id;
      one.tagged = true;
    }
    const auto on_axis = [&](const Seen& one) {
      return kind_.dimension == 2 && mesh_.nodes[one.nodes[0]][0] == 0.0 && mesh_.nodes[one.nodes[1]][0] == 0.0;
    };
    for (const auto& [key, one] : seen)
      if (one.cells[1] < 0 && !on_axis(one)) mesh_.faces.push_back({one.nodes, one.id});
  }

  /// Two cells lie on either side of their common face, not one in the other.
  void expect_two_sides(const std::array<int, 4>& face, const std::array<int, 2>& cells) {
    const auto middle = [&](const auto& of) {
      Vec3 sum = Vec3::Zero();
      for (const int node : of) sum += mesh_.nodes[node];
      return Vec3(sum / double(of.size()));
    };
    const std::array<Vec3, 4> corner = corners_of(face, mesh_.nodes);
    const Vec3 normal = (corner[2] - corner[0]).cross(corner[3] - corner[1]);
    const Vec3 at = middle(face);
    const double a = normal.dot(middle(mesh_.cells[cells[0]]) - at), b = normal.dot(middle(mesh_.cells[cells[1]]) - at);
    if (a * b < 0) return;
    lines_.fail(cell_lines_[cells[1]], std::string("this ") + kind_.cell + " overlaps that of line " +
                                           std::to_string(cell_lines_[cells[0]]) +
                                           ", with which it shares a face; remove one of them, or repair the place of its nodes");
  }

  Lines lines_;
  const Kind& kind_;
  bool four_ = false, has_entities_ = false, has_nodes_ = false, has_elements_ = false, has_names_ = false, second_order_ = false;
  long quadrangles_ = 0;
  std::map<int, std::string> names_[4];  // of physical groups, by dimension
  std::map<long long, int> groups_[4];   // physical group by entity
  std::vector<Vec3> nodes_;
  std::vector<long> node_lines_, cell_lines_, face_lines_;
  std::vector<long long> node_tags_;
  std::vector<std::size_t> original_;  // of the nodes that are kept
  std::unordered_map<long long, int> index_;
  std::unordered_map<long long, int> element_tags_;
  std::vector<std::array<int, 8>> cells_;
  std::vector<int> cell_groups_;
  std::vector<HexahedralMesh::Face> faces_;
  HexahedralMesh mesh_;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file)
    throw std::invalid_argument(path + ": the mesh file cannot be read; give the path of a gmsh .msh file that you may read");
  return text.str();
}

}  // namespace

HexahedralMesh parse_gmsh(std::string_view text, const std::string& path, GmshCells cells) {
  return Reader(text, path, cells == GmshCells::hexahedra ? hexahedra : quadrangles).mesh();
}

QuadrangleSurface parse_gmsh_surface(std::string_view text, const std::string& path) {
  return Reader(text, path, surface).quadrangle_surface();
}

HexahedralMesh read_gmsh(const std::string& path, GmshCells cells, double scale) {
  HexahedralMesh mesh = parse_gmsh(text_of(path), path, cells);
  for (Vec3& node : mesh.nodes) node *= scale;
  return mesh;
}

QuadrangleSurface read_gmsh_surface(const std::string& path, double scale) {
  QuadrangleSurface surface = parse_gmsh_surface(text_of(path), path);
  for (Vec3& node : surface.nodes) node *= scale;
  return surface;
}

}  // namespace undex
