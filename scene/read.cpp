// Reading a scene: document, overrides, tables, checks; all that was found is thrown together.
#include <algorithm>
#include <fstream>
#include <set>
#include <tuple>

#include "scene/document.hpp"
#include "scene/draft.hpp"
#include "scene/overrides.hpp"
#include "scene/record_reader.hpp"

namespace undex::scene {
namespace {

/// In how many coordinates the file gives its places; nothing where its dimension is none.
std::optional<int> written_in(const Node& root) {
  const Node* node = root.find("dimension");
  if (!node) return 3;
  if (node->kind == Node::Kind::integer) return static_cast<int>(node->integer);
  for (const auto& each : words(Geometry{}))
    if (node->text == each.word) return coordinates_of(each.value);
  return std::nullopt;
}

/// A word that overrides the dimension does not give places more coordinates, or fewer. False, and a complaint, where it should.
bool can_be_taken(std::optional<int> written, Draft& draft) {
  const int wanted = draft.scene.fluid.dimension;
  const Node* node = draft.root.find("dimension");
  if (!draft.dimension_good || !node || node->kind != Node::Kind::text || !written || *written == wanted) return true;
  draft.report.add(*node, "dimension = " + toml_value(*node) + " is written with " + std::to_string(wanted) +
                              " coordinates a place, and this scene with " + std::to_string(*written) +
                              "; write its places, shapes and velocities with " + std::to_string(wanted));
  return false;
}

void read_top(Draft& draft) {
  Scene& scene = draft.scene;
  {
    Report aside;  // the dimension decides how the rest is read, so it comes first
    const TableReader table(draft.root, "", "", 3, aside);
    Dimension dimension{scene.fluid.dimension, scene.geometry};
    if (table.has("dimension")) draft.dimension_good = by_form::read(table, {.name = "dimension"}, dimension);
  }
  const TableReader table(draft.root, "", "", scene.fluid.dimension, draft.report);
  read_fields(table, scene);
  if (!table.has("title")) scene.title = scene.name;
}

/// Each mistake once: a material that two bodies use is read twice.
std::vector<Finding> without_repetitions(const std::vector<Finding>& findings) {
  std::set<std::tuple<int, int, std::string>> seen;
  std::vector<Finding> once;
  for (const Finding& finding : findings)
    if (seen.emplace(finding.where.line, finding.where.column, finding.message).second) once.push_back(finding);
  return once;
}

}  // namespace

std::filesystem::path found_file(const std::filesystem::path& path, const char* kind, const char* usual_name,
                                 const std::string& hint) {
  const std::string a_kind = std::string("a ") + kind, in_folder = std::string("a folder with ") + usual_name;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    if (!std::filesystem::is_regular_file(path / usual_name, ignored))
      throw FileError(path.string() + ": the folder holds no " + usual_name + "; name " + a_kind + " file or a folder with one");
    return path / usual_name;
  }
  if (!std::filesystem::exists(path, ignored))
    throw FileError(path.string() + ": no such " + kind + "; name a .toml file or " + in_folder + hint);
  return path;
}

std::string file_text(const std::filesystem::path& file) {
  constexpr std::size_t most = 16 << 20;  // [byte] more than anybody writes; a device never ends
  std::ifstream stream(file, std::ios::binary);
  std::string text(most + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || (stream.gcount() == 0 && !stream.eof()))
    throw FileError(file.string() + ": cannot be read; check that it exists and that you may read it");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most) throw FileError(file.string() + ": larger than 16 MB; name a scene or study file");
  return text;
}

std::string name_of(const std::filesystem::path& file, const char* usual_name) {
  const std::filesystem::path full = std::filesystem::absolute(file).lexically_normal();
  std::string name = full.filename() == usual_name ? full.parent_path().filename().string() : full.stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') c = '_';
  return name.empty() ? "scene" : name.substr(0, 100);
}

std::string element_path(const char* list, const Node& element, std::size_t index) {
  const Node* name = element.find("name");
  const bool named = name && name->kind == Node::Kind::text && !name->text.empty() && name->text.size() <= 100;
  return std::string(list) + '.' + (named ? name->text : std::to_string(index));
}

Scene read(const std::filesystem::path& path, const std::vector<ComparisonKind>& kinds, const std::vector<Override>& overrides) {
  const std::filesystem::path file = found_file(path, "scene", "case.toml", " ('undex list' shows the scenes shipped)");
  Draft draft;
  draft.root = parse_toml(file_text(file), file.string());
  draft.scene.file = file;
  draft.scene.name = name_of(file, "case.toml");
  const std::optional<int> written = written_in(draft.root);
  apply(overrides, draft.root, draft.report);
  read_top(draft);
  if (!can_be_taken(written, draft)) throw SceneError(file.string(), without_repetitions(draft.report.findings()));
  read_own_materials(draft);
  read_fluid(draft);
  read_solids(draft);
  resolve_subtractions(draft);
  read_obstacles(draft);
  complete_line(draft);
  read_structures(draft);
  read_output(draft);
  read_comparison(draft, kinds);
  settle_revolution(draft);
  validate(draft);
  if (!draft.report.empty()) throw SceneError(file.string(), without_repetitions(draft.report.findings()));
  draft.scene.places = Places(draft.root);
  for (const Finding& finding : without_repetitions(draft.warnings.findings()))
    draft.scene.warnings.push_back(SceneError(file.string(), {finding}).what());
  return std::move(draft.scene);
}

}  // namespace undex::scene
