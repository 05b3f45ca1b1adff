#include "app/help.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include "app/data_folder.hpp"
#include "app/shell_words.hpp"
#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/terminal.hpp"
#include "output/text_table.hpp"
#include "scene/key_tables.hpp"
#include "scene/suggestion.hpp"

namespace undex::app {
namespace {

namespace fs = std::filesystem;
using output::Ink;
using output::inked;

/// The pages of the documentation by their names without folder and ending.
std::map<std::string, fs::path> pages() {
  std::map<std::string, fs::path> found;
  std::error_code error;
  const fs::path docs = data_folder() / "docs";
  for (fs::recursive_directory_iterator entry(docs, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".md" && entry->path().stem() != "index")
      found[entry->path().stem().string()] = entry->path();
  return found;
}

/// What follows the first "# " of a page.
std::string title_of(const fs::path& page) {
  std::istringstream lines(output::text_of(page).value_or(""));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("# ")) return line.substr(2);
  return "";
}

/// Lines of at most `width` columns, each with the indent.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string all, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && indent + output::width(line) + 1 + output::width(word) > width) {
      all += std::string(indent, ' ') + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? all : all + std::string(indent, ' ') + line + "\n";
}

/// Markdown's links become their words; code keeps its text.
std::string without_links(const std::string& text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t middle = text[at] == '[' ? text.find("](", at) : std::string::npos;
    const std::size_t close = middle == std::string::npos ? middle : text.find(')', middle);
    if (close == std::string::npos || text.find('[', at + 1) < middle) {
      plain += text[at];
      continue;
    }
    plain += text.substr(at + 1, middle - at - 1);
    at = close;
  }
  return plain;
}

/// The cells of a line of a Markdown table.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t k = 1; k < line.size(); ++k) {
    if (line[k] == '|' && line[k - 1] != '\\') {
      const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
      cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
      cell.clear();
    } else if (line[k] != '\\' || k + 1 == line.size() || line[k + 1] != '|') {
      cell += line[k];
    }
  }
  return cells;
}

std::string without_ticks(std::string text) {
  std::erase(text, '`');
  return text;
}

/// The rows of a table of keys as a list; only that of `key` where it is named.
std::string keys_text(const std::string& table, const std::string& key) {
  std::string text;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> cells = line.starts_with("| `") ? cells_of(line) : std::vector<std::string>{};
    if (cells.size() < 4 || (!key.empty() && without_ticks(cells[0]) != key)) continue;
    text += "  " + inked(without_ticks(cells[0]), Ink::bold) + (cells[1] == "-" ? "" : " [" + without_ticks(cells[1]) + "]") +
            "   " + inked("default " + without_ticks(cells[2]) + "; " + without_ticks(cells[3]), Ink::dim) + "\n";
    if (cells.size() > 4) text += wrapped(without_ticks(without_links(cells[4])), 6, 100);
  }
  return text;
}

/// A page as text: headings stand out, links are words, marks for programs go.
std::string page_text(const fs::path& page) {
  std::string text;
  std::istringstream lines(output::text_of(page).value_or(""));
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      code = !code;
      continue;
    }
    if (code) text += "    " + line + "\n";
    else if (line.starts_with("<!--") || line.starts_with("![")) continue;
    else if (line.starts_with("#")) text += inked(line.substr(line.find_first_not_of("# ")), Ink::bold) + "\n";
    else text += without_links(line) + "\n";
  }
  return text;
}

/// A heading, and a line for each name with its words.
void print_list(const std::string& heading, const std::vector<std::pair<std::string, std::string>>& entries) {
  std::printf("\n%s\n", inked(heading, Ink::bold).c_str());
  for (const auto& [name, words] : entries) std::printf("  %-18s %s\n", name.c_str(), words.c_str());
}

void print_topics(const CLI::App& program) {
  std::printf("undex help TOPIC says more of any of these; undex help TABLE.KEY of one key, such as scheme.kernel.\n");
  std::vector<std::pair<std::string, std::string>> entries;
  for (const CLI::App* command : commands_of(program)) entries.emplace_back(command->get_name(), command->get_description());
  print_list("Commands", entries);
  entries.clear();
  for (const auto& [name, page] : pages()) entries.emplace_back(name, title_of(page));
  print_list("Pages", entries);
  std::string names;
  for (const std::string& table : scene::key_table_names()) names += table + " ";
  std::printf("\n%s\n%s", inked("Tables of a scene's keys", Ink::bold).c_str(), wrapped(names, 2, 100).c_str());
}

}  // namespace

int print_help(const CLI::App& program, const std::string& topic) {
  if (topic.empty()) {
    print_topics(program);
    return exit_done;
  }
  std::vector<std::string> known;
  for (const CLI::App* command : commands_of(program)) {
    known.push_back(command->get_name());
    if (command->get_name() != topic) continue;
    std::printf("%s", command->help().c_str());
    return exit_done;
  }
  const auto all_pages = pages();
  if (const auto page = all_pages.find(topic); page != all_pages.end()) {
    std::printf("%s\n%s\n", page_text(page->second).c_str(), inked(page->second.string(), Ink::dim).c_str());
    return exit_done;
  }
  const std::size_t dot = topic.rfind('.');
  for (const auto& [table, key] : {std::pair(topic, std::string()),
                                   std::pair(topic.substr(0, dot), dot == std::string::npos ? topic : topic.substr(dot + 1)),
                                   std::pair(std::string("top"), topic)}) {
    const std::string text = keys_text(scene::key_table(table), key);
    if (text.empty()) continue;
    std::printf("%s%s", inked("[" + table + "]\n", Ink::bold).c_str(), text.c_str());
    return exit_done;
  }
  for (const auto& [name, page] : all_pages) known.push_back(name);
  for (const std::string& table : scene::key_table_names()) known.push_back(table);
  throw UsageError("no help on '" + topic + "'" + scene::suggestion(topic, known) + "; undex help lists the topics");
}

}  // namespace undex::app
