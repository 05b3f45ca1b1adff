#include "app/new_scene.hpp"

#include <cstdio>
#include <map>
#include <sstream>
#include <system_error>
#include <vector>

#include "app/data_folder.hpp"
#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/run_folder.hpp"
#include "scene/suggestion.hpp"

namespace undex::app {
namespace {

namespace fs = std::filesystem;

/// The files of a template, by their names in the new folder.
using Files = std::vector<std::pair<std::string, std::string>>;

/// A page's blocks that have a title are files: ```toml title="plate.toml". The first scene becomes case.toml.
Files files_of_page(const std::string& page) {
  Files files;
  std::istringstream lines(page);
  bool inside = false, has_scene = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      const std::string mark = "title=\"";
      const std::size_t title = inside ? std::string::npos : line.find(mark);
      inside = title != std::string::npos;
      if (!inside) continue;
      std::string name = line.substr(title + mark.size());
      name.erase(std::min(name.size(), name.find('"')));
      if (name.ends_with(".toml") && !has_scene) {
        has_scene = true;
        name = "case.toml";
      }
      files.emplace_back(name, "");
    } else if (inside) {
      files.back().second += line + "\n";
    }
  }
  for (const auto& [name, text] : files)
    if (name == "case.toml" && text.find("[[axes]]") != std::string::npos) return {};  // a study, which names another scene
  return has_scene ? files : Files{};
}

/// Scenes, references and meshes of a shipped case. What they take from other cases is named where it lies.
Files files_of_case(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().filename() == "README.md") continue;
    std::string text = output::text_of(entry.path()).value_or("");
    if (entry.path().extension() == ".toml")
      for (std::size_t at = text.find("\"../"); at != std::string::npos; at = text.find("\"../", at))
        text.replace(at, 4, "\"" + folder.parent_path().string() + "/");
    files.emplace_back(fs::relative(entry.path(), folder).string(), text);
  }
  return files;
}

std::map<std::string, fs::path> templates() {
  std::map<std::string, fs::path> found;
  const fs::path data = data_folder();
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data / "cases", error))
    if (fs::is_regular_file(entry.path() / "case.toml", error)) found[entry.path().filename().string()] = entry.path();
  for (const auto& entry : fs::directory_iterator(data / "docs" / "tasks", error))
    if (entry.path().extension() == ".md" && !files_of_page(output::text_of(entry.path()).value_or("")).empty())
      found[entry.path().stem().string()] = entry.path();
  return found;
}

/// The title of the scene that a template gives.
std::string title_in(const Files& files) {
  for (const auto& [name, text] : files) {
    if (name != "case.toml") continue;
    const std::size_t at = text.find("title = \"");
    if (at != std::string::npos) return text.substr(at + 9, text.find('"', at + 9) - at - 9);
  }
  return "";
}

Files files_of(const fs::path& from) {
  return from.extension() == ".md" ? files_of_page(output::text_of(from).value_or("")) : files_of_case(from);
}

}  // namespace

int new_scene(const std::string& name, const fs::path& folder) {
  const auto known = templates();
  if (name.empty()) {
    for (const bool of_tasks : {true, false}) {
      std::printf("%s\n", of_tasks ? "Small scenes to begin from (docs/tasks):" : "\nShipped scenes (cases):");
      for (const auto& [each, from] : known)
        if ((from.extension() == ".md") == of_tasks) std::printf("  %-22s %s\n", each.c_str(), title_in(files_of(from)).c_str());
    }
    std::printf("\nundex new NAME FOLDER copies one.\n");
    return exit_done;
  }
  const auto found = known.find(name);
  if (found == known.end()) {
    std::vector<std::string> names;
    for (const auto& [each, from] : known) names.push_back(each);
    throw UsageError("no template '" + name + "'" + scene::suggestion(name, names) + "; undex new lists them");
  }
  const fs::path target = folder.empty() ? fs::path(name) : folder;
  output::require_unused_folder(target, /*force=*/false);
  const Files files = files_of(found->second);
  for (const auto& [file, text] : files) {
    output::make_folder((target / file).parent_path());
    output::write_text_atomically(target / file, text);
    std::printf("%s\n", (target / file).c_str());
  }
  std::printf("\nNext:  undex check %s\n       undex run %s\n", target.c_str(), target.c_str());
  return exit_done;
}

}  // namespace undex::app
