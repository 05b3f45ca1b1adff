// Reading a study: its file, the grid of runs, and the scene of each of them.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "scene/document.hpp"
#include "scene/draft.hpp"
#include "scene/numbers.hpp"
#include "scene/study.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

constexpr std::size_t most_runs = 10000;

/// A study while it is being read: also where each setting of each value was written.
struct StudyDraft {
  Study study;
  Node root;
  Report report;
  std::vector<std::filesystem::path> scenes;
  const Node* scene_node = nullptr;  ///< where they are named; null: the folder's own
  StudyValue common;                 ///< what every run sets: threads, and `settings`
  std::vector<Where> common_places;
  std::vector<std::vector<std::vector<Where>>> places;                ///< by axis, value, setting
  std::vector<Where> key_places;                                      ///< by axis; line 0 where it has no key
  std::vector<std::map<std::size_t, std::set<std::size_t>>> exclude;  ///< rules: indices of values by axis
};

std::vector<std::string> axis_names(const Study& study) {
  std::vector<std::string> names;
  for (const StudyAxis& axis : study.axes) names.push_back(axis.name);
  return names;
}

std::vector<std::string> labels_of(const StudyAxis& axis) {
  std::vector<std::string> labels;
  for (const StudyValue& value : axis.values) labels.push_back(value.label);
  return labels;
}

std::set<std::string> keys_of(const StudyAxis& axis) {
  std::set<std::string> keys;
  for (const StudyValue& value : axis.values)
    for (const Override& setting : value.settings) keys.insert(setting.key);
  return keys;
}

/// Numbers as people write them: 0.0005, not the shorter 5e-04.
std::string label_of(const Node& node) {
  if (node.kind == Node::Kind::text) return node.text;
  if (node.kind != Node::Kind::number) return toml_value(node);
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, node.number, std::chars_format::general).ptr};
}

/// The leaves of a variant's table are settings; a quoted path sets its value as a whole.
void collect_settings(const Node& table, const std::string& path, StudyValue& value, std::vector<Where>& places, Report& report) {
  for (const Entry* entry : in_file_order(table)) {
    const std::string key = path.empty() ? entry->key : path + '.' + entry->key;
    const bool whole = entry->key.find('.') != std::string::npos;
    if (entry->node.kind == Node::Kind::table && !whole) {
      collect_settings(entry->node, key, value, places, report);
    } else if (entry->node.kind == Node::Kind::other) {
      report.add(*entry, key + " must be a number, true or false, text, a list or a table, not " + entry->node.described());
    } else {
      value.settings.push_back({key, toml_value(entry->node)});
      places.push_back(entry->where);
    }
  }
}

void read_values(const TableReader& table, const std::string& key, StudyAxis& axis, std::vector<std::vector<Where>>& places) {
  const Node* values = table.find("values");
  if (!values || values->kind != Node::Kind::array || values->items.empty()) {
    if (values)
      table.complain("values", table.path_of("values") + " must be a list of at least one value, not " + values->described());
    else table.need("values", "list the values of " + key + ", e.g. values = [0.002, 0.001]");
    return;
  }
  std::vector<std::string> labels;
  table.read("labels", labels);
  if (!labels.empty() && labels.size() != values->items.size()) {
    table.complain("labels", table.path_of("labels") + " are " + std::to_string(labels.size()) + ", the values " +
                                 std::to_string(values->items.size()) + "; give one for each, or leave them out");
    labels.clear();
  }
  for (std::size_t i = 0; i < values->items.size(); ++i) {
    const Node& item = values->items[i];
    if (item.kind == Node::Kind::other) {
      table.report().add(item, table.path_of("values") + " has " + item.described() + ", which no setting of a scene can be");
      continue;
    }
    StudyValue value{labels.empty() ? label_of(item) : labels[i], {{key, toml_value(item)}}, {}};
    if (item.is_number()) value.number = item.number;
    axis.values.push_back(value);
    places.push_back({item.where});
  }
}

void read_variants(const TableReader& table, StudyAxis& axis, std::vector<std::vector<Where>>& places) {
  const Node* variants = table.find("variants");
  if (variants->kind != Node::Kind::table || variants->entries.empty()) {
    table.complain("variants", table.path_of("variants") +
                                   " must be tables of settings by name, such as [axes.variants.riemann], not " +
                                   variants->described());
    return;
  }
  for (const Entry* entry : in_file_order(*variants)) {
    if (entry->node.kind != Node::Kind::table) {
      table.report().add(*entry, table.path_of("variants") + '.' + entry->key + " must be a table of settings, not " +
                                     entry->node.described() + "; {} is the scene as it is");
      continue;
    }
    StudyValue value{entry->key, {}, {}};
    std::vector<Where> settings;
    collect_settings(entry->node, "", value, settings, table.report());
    axis.values.push_back(value);
    places.push_back(settings);
  }
}

/// No two labels of an axis may be alike, nor any be empty.
void check_labels(const StudyAxis& axis, const Node& node, Report& report) {
  std::set<std::string> seen;
  for (const StudyValue& value : axis.values) {
    if (value.label.empty()) report.add(node, "axis '" + axis.name + "' has a value without a label; give it one");
    else if (!seen.insert(value.label).second)
      report.add(node, "axis '" + axis.name + "' has '" + value.label + "' twice; leave one out, or label them differently");
  }
}

void read_axes(const TableReader& top, StudyDraft& draft) {
  Study& study = draft.study;
  const auto nodes = top.tables("axes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const TableReader table(*nodes[i], element_path("axes", *nodes[i], i), "study.axes", 3, draft.report);
    StudyAxis axis;
    if (table.need("name", "name the axis, e.g. name = \"spacing\"")) table.read_name("name", axis.name);
    table.read("problem", axis.problem);
    std::vector<std::vector<Where>> places;
    std::string key;
    if (table.has("variants")) {
      for (const char* other : {"key", "values", "labels"})
        if (table.has(other)) table.complain(other, table.path_of(other) + " and variants exclude each other; give one of them");
      read_variants(table, axis, places);
    } else if (table.need("key",
                          "give the key that varies, e.g. key = \"resolution.spacing\", with values = [...]; or "
                          "[axes.variants.<name>] "
                          "with the settings of each variant") &&
               table.read("key", key)) {
      if (key.empty())
        table.complain("key", table.path_of("key") + " is empty; give a dotted path such as \"resolution.spacing\"");
      else read_values(table, key, axis, places);
    }
    if (axis.name.empty()) continue;
    if (const auto names = axis_names(study); std::find(names.begin(), names.end(), axis.name) != names.end()) {
      table.complain("name", axis.name == "scene" ? "an axis cannot be named 'scene' beside scenes = [...]; name it otherwise"
                                                  : "two axes are named '" + axis.name + "'; name them differently");
      continue;
    }
    check_labels(axis, *nodes[i], draft.report);
    for (const StudyAxis& other : study.axes)
      for (const std::string& mine : keys_of(axis))
        if (keys_of(other).contains(mine))
          table.complain("name",
                         "axes '" + other.name + "' and '" + axis.name + "' both set " + mine + "; vary it in one of them");
    if (axis.values.empty()) continue;
    study.axes.push_back(std::move(axis));
    draft.places.push_back(std::move(places));
    const Node* key_node = table.find("key");
    draft.key_places.push_back(key_node ? key_node->where : Where{});
  }
}

void read_scenes(const TableReader& top, StudyDraft& draft) {
  const std::filesystem::path folder = draft.study.file.parent_path();
  std::vector<std::string> names;
  std::string one;
  if (top.has("scene") && top.has("scenes")) top.complain("scene", "scene and scenes exclude each other; give one of them");
  draft.scene_node = top.find(top.has("scene") ? "scene" : "scenes");
  if (top.read("scene", one)) names = {one};
  else top.read("scenes", names);
  std::error_code ignored;
  if (!draft.scene_node) {
    if (std::filesystem::is_regular_file(folder / "case.toml", ignored)) draft.scenes = {folder.empty() ? "." : folder};
    else
      draft.report.add(Where{},
                       "scene is missing; give the scene's file or folder, relative to the study file, e.g. scene = "
                       "\"../cases/sjogreen\"");
    return;
  }
  if (draft.scene_node->kind == Node::Kind::array && draft.scene_node->items.empty())
    top.complain("scenes", "scenes is empty; give the scenes' files or folders");
  StudyAxis axis{"scene", true, {}};
  for (const std::string& name : names) {
    const std::filesystem::path path = (folder / name).lexically_normal();
    try {
      const std::filesystem::path file = found_file(path, "scene", "case.toml", ", relative to the study file");
      axis.values.push_back({name_of(file, "case.toml"), {}, path});
      draft.scenes.push_back(path);
    } catch (const FileError& error) {
      draft.report.add(*draft.scene_node, error.what());
    }
  }
  if (names.size() < 2 || axis.values.empty()) return;
  check_labels(axis, *draft.scene_node, draft.report);
  draft.places.push_back(std::vector<std::vector<Where>>(axis.values.size()));
  draft.key_places.push_back(Where{});
  draft.study.axes.push_back(std::move(axis));
}

void read_resolution(const TableReader& top, Study& study) {
  std::string name;
  const auto numeric = [](const StudyAxis& axis) {
    return std::all_of(axis.values.begin(), axis.values.end(),
                       [](const StudyValue& v) { return v.number > 0 && std::isfinite(v.number); });
  };
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (!study.axes[a].values[0].settings.empty() && study.axes[a].values[0].settings[0].key == "resolution.spacing" &&
        numeric(study.axes[a]))
      study.resolution = a;
  if (!top.read("resolution", name)) return;
  study.resolution.reset();
  const std::vector<std::string> names = axis_names(study);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    top.unknown_word("resolution", name, names);
  } else if (const auto a = static_cast<std::size_t>(found - names.begin()); !numeric(study.axes[a])) {
    top.complain("resolution",
                 "resolution: the values of axis '" + name + "' are not positive numbers; orders are observed over lengths");
  } else {
    study.resolution = a;
  }
}

void read_errors(const TableReader& top, StudyDraft& draft) {
  const Node* node = top.find("errors");
  if (!node) return;
  if (node->kind != Node::Kind::array) {
    top.complain("errors", "errors must be a list of metrics of summary.json, not " + node->described());
    return;
  }
  std::set<std::string> labels;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    const Node& item = node->items[i];
    StudyError error;
    error.where = item.where;
    if (item.kind == Node::Kind::text) {
      error.metric = item.text;
    } else if (item.kind == Node::Kind::table) {
      const TableReader table(item, "errors." + std::to_string(i), "study.errors", 3, draft.report);
      if (table.need("metric", "name a metric of summary.json")) table.read("metric", error.metric);
      table.read("source", error.source);
      table.read("label", error.label);
    } else {
      draft.report.add(item, "errors: " + item.described() + " is neither the name of a metric nor {metric = ..., source = ...}");
      continue;
    }
    if (error.label.empty()) error.label = error.metric + (error.source.empty() ? "" : " from " + error.source);
    if (error.metric.empty()) continue;
    if (!labels.insert(error.label).second)
      draft.report.add(item, "errors has '" + error.label + "' twice; leave one out, or give it another label");
    draft.study.errors.push_back(error);
  }
}

/// The values that a rule names on one axis.
std::set<std::size_t> excluded_values(const Entry& entry, const StudyAxis& axis, Report& report) {
  std::set<std::size_t> result;
  const bool list = entry.node.kind == Node::Kind::array;
  for (const Node& wanted : list ? entry.node.items : std::vector<Node>{entry.node}) {
    bool found = false;
    for (std::size_t v = 0; v < axis.values.size(); ++v)
      if (axis.values[v].label == label_of(wanted) || (wanted.is_number() && axis.values[v].number == wanted.number)) {
        result.insert(v);
        found = true;
      }
    if (!found)
      report.add(wanted, "exclude: axis '" + axis.name + "' has no value " + label_of(wanted) +
                             suggestion(label_of(wanted), labels_of(axis)));
  }
  return result;
}

void read_exclude(const TableReader& top, StudyDraft& draft) {
  const std::vector<std::string> names = axis_names(draft.study);
  for (const Node* node : top.tables("exclude")) {
    if (node->entries.empty())
      draft.report.add(*node, "exclude: an empty rule leaves out every run; name values of axes, e.g. {spacing = 0.001}");
    std::map<std::size_t, std::set<std::size_t>> rule;
    for (const Entry* entry : in_file_order(*node)) {
      const auto found = std::find(names.begin(), names.end(), entry->key);
      if (found == names.end()) {
        draft.report.add(*entry, "exclude: no axis is named '" + entry->key + "'" + suggestion(entry->key, names));
        rule.clear();
        break;
      }
      const auto a = static_cast<std::size_t>(found - names.begin());
      rule[a] = excluded_values(*entry, draft.study.axes[a], draft.report);
    }
    if (!rule.empty()) draft.exclude.push_back(std::move(rule));
  }
}

/// A label as part of a file name: "monaghan 1/10, slip" is monaghan_1_10_slip.
std::string file_name(const std::string& label) {
  std::string name;
  for (const char c : label)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.' || c == '+') name += c;
    else if (!name.ends_with('_')) name += '_';
  return name;
}

/// "spacing_0.001__monaghan_1_10": numbers with the name of their axis.
std::string run_name(const Study& study, const std::vector<std::size_t>& values) {
  std::string name;
  for (std::size_t a = 0; a < values.size(); ++a) {
    const StudyValue& value = study.axes[a].values[values[a]];
    const bool bare = !std::isnan(value.number) || value.label == "true" || value.label == "false";
    name += (a == 0 ? "" : "__") + (bare ? file_name(study.axes[a].name) + '_' : "") + file_name(value.label);
  }
  return name.empty() ? "run" : name.starts_with('.') ? '_' + name : name;
}

void expand(StudyDraft& draft) {
  Study& study = draft.study;
  double count = 1;
  for (const StudyAxis& axis : study.axes) count *= static_cast<double>(axis.values.size());
  if (count > most_runs) {
    draft.report.add(Where{}, "the study has " + rounded(count) + " runs, more than " + std::to_string(most_runs) + "; split it");
    return;
  }
  const bool sound = draft.report.empty();  // else the names may be the fault of what has been reported
  std::set<std::string> names;
  for (std::size_t number = 0; number < static_cast<std::size_t>(count); ++number) {
    StudyRun run;
    run.values.resize(study.axes.size());
    for (std::size_t a = study.axes.size(), rest = number; a-- > 0; rest /= study.axes[a].values.size())
      run.values[a] = rest % study.axes[a].values.size();
    const bool excluded = std::any_of(draft.exclude.begin(), draft.exclude.end(), [&](const auto& rule) {
      return std::all_of(rule.begin(), rule.end(),
                         [&](const auto& each) { return each.second.contains(run.values[each.first]); });
    });
    if (excluded) continue;
    run.scene = draft.scenes.front();
    run.settings = draft.common.settings;
    for (std::size_t a = 0; a < study.axes.size(); ++a) {
      const StudyValue& value = study.axes[a].values[run.values[a]];
      if (!value.scene.empty()) run.scene = value.scene;
      run.settings.insert(run.settings.end(), value.settings.begin(), value.settings.end());
    }
    run.name = run_name(study, run.values);
    if (sound && run.name.size() > 200)
      draft.report.add(Where{},
                       "the folder's name " + run.name.substr(0, 60) + "... is too long; give the values shorter labels");
    else if (sound && !names.insert(run.name).second)
      draft.report.add(Where{}, "two runs would have the folder " + run.name + "; label their values more differently");
    study.runs.push_back(std::move(run));
  }
  if (study.runs.empty()) draft.report.add(Where{}, "every run of the study is excluded; leave a rule of exclude out");
}

/// A mistake of a scene that the study makes: where it sets the value, and where it names the key (line 0: nowhere).
struct Place {
  Where value, key;
};

/// The place of a finding "-P <key>: ..." of a run, of which `rest` is what follows; nowhere for other findings.
Place place_of(const StudyDraft& draft, const StudyRun& run, const std::string& message, std::string& rest) {
  Place place;
  const auto look = [&](const StudyValue& value, const std::vector<Where>& places, Where key) {
    for (std::size_t s = 0; s < value.settings.size(); ++s)
      if (const std::string head = "-P " + value.settings[s].key + ": "; message.starts_with(head)) {
        rest = message.substr(head.size());
        if (!rest.starts_with(value.settings[s].key)) rest = value.settings[s].key + ": " + rest;
        place = {places[s], key};
      }
  };
  look(draft.common, draft.common_places, {});
  for (std::size_t a = 0; a < run.values.size(); ++a)
    look(draft.study.axes[a].values[run.values[a]], draft.places[a][run.values[a]], draft.key_places[a]);
  return place;
}

/// Reads the scene of every run, to have all their mistakes now.
void read_runs(StudyDraft& draft, const std::vector<ComparisonKind>& kinds) {
  struct Mistake {
    Place place;
    std::string message, first_run;
    std::size_t runs = 0;
  };
  std::vector<Mistake> mistakes;
  Study& study = draft.study;
  for (StudyRun& run : study.runs) {
    const auto note = [&](Place place, const std::string& message) {
      const auto same =
          std::find_if(mistakes.begin(), mistakes.end(), [&](const Mistake& each) { return each.message == message; });
      if (same == mistakes.end()) {
        mistakes.push_back({.place = place, .message = message, .first_run = run.name, .runs = 1});
        return;
      }
      ++same->runs;  // said of several values of an axis it is about the key
      const auto differs = [](Where a, Where b) { return a.line != b.line || a.column != b.column; };
      if (place.key.line > 0 && differs(same->place.value, place.value)) same->place.value = place.key;
    };
    try {
      const Scene scene = read(run.scene, kinds, run.settings);
      run.resolved = to_toml(scene);
      run.dimension = scene.fluid.dimension;
      run.reference = scene.comparison.reference;
    } catch (const SceneError& error) {
      for (const Finding& finding : error.findings()) {
        std::string rest;
        if (const Place place = place_of(draft, run, finding.message, rest); place.value.line > 0) note(place, rest);
        else note({}, SceneError(error.file(), {finding}).what());
      }
    } catch (const FileError& error) {
      note({draft.scene_node ? draft.scene_node->where : Where{}, {}}, error.what());
    }
  }
  for (const Mistake& each : mistakes) {
    const std::string runs =
        each.runs == study.runs.size()
            ? ""
            : " (run " + each.first_run + (each.runs > 1 ? " and " + std::to_string(each.runs - 1) + " more" : "") + ")";
    draft.report.add(each.place.value, each.message + runs);
  }
}

}  // namespace

Study read_study(const std::filesystem::path& path, const std::vector<ComparisonKind>& kinds) {
  StudyDraft draft;
  Study& study = draft.study;
  study.file = found_file(path, "study", "study.toml", "");
  study.name = name_of(study.file, "study.toml");
  draft.root = parse_toml(file_text(study.file), study.file.string());
  const TableReader top(draft.root, "", "study", 3, draft.report);
  study.title = study.name;
  top.read("title", study.title);
  std::string output;
  study.output = top.read("output", output) && !output.empty() ? output : "out/study_" + study.name;
  top.read("repeats", study.repeats);
  int threads = 1;
  top.read("threads", threads);
  draft.common.settings.push_back({"threads", std::to_string(threads)});
  draft.common_places.push_back(Where{});
  if (const Node* settings = top.table("settings"))
    collect_settings(*settings, "", draft.common, draft.common_places, draft.report);
  top.read("cpu_limit", study.cpu_limit);
  top.read("wall_limit", study.wall_limit);
  read_scenes(top, draft);
  read_axes(top, draft);
  read_resolution(top, study);
  read_errors(top, draft);
  read_exclude(top, draft);
  if (!draft.scenes.empty()) {
    expand(draft);
    read_runs(draft, kinds);
  }
  if (!draft.report.empty()) throw SceneError(study.file.string(), draft.report.findings());
  return std::move(draft.study);
}

}  // namespace undex::scene
