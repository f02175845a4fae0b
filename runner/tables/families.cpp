#include "runner/tables/families.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "engine/dynamics/presets.hpp"
#include "runner/sweep/identity.hpp"

namespace grainsweep {
namespace {

/// The labels of the walled groups, or of all if none is walled.
std::string labels_of(const Family& family) {
  std::vector<std::string> labels;
  for (const Group& group : family.walled.empty() ? family.periodic : family.walled) {
    const bool is_new = std::find(labels.begin(), labels.end(), group.job.label) == labels.end();
    if (is_new && !group.job.label.empty()) labels.push_back(group.job.label);
  }
  std::string joined;
  for (const std::string& label : labels) joined += (joined.empty() ? "" : " + ") + label;
  return joined.empty() ? "packings" : joined;
}

using Flat = std::map<std::string, std::string>;  // dotted name -> cell

/// The parts of each named accuracy.
const std::map<std::string_view, Flat>& flat_presets() {
  static const auto all = [] {
    std::map<std::string_view, Flat> flat;
    for (const Preset& preset : presets()) {
      ResolvedSpec resolved;
      resolved.spec.accuracy = preset.accuracy;
      JobFacts job;
      job.parameters = canonical_parameters(resolved);
      flat[preset.name] = flat_parameters(job);
      std::erase_if(flat[preset.name],
                    [](const auto& part) { return !part.first.starts_with("accuracy."); });
    }
    return flat;
  }();
  return all;
}

/// Whether a part of an accuracy is as in that preset.
bool is_as_in(const Flat& preset, const Flat::value_type& part) {
  const auto found = preset.find(part.first);
  return found != preset.end() && found->second == part.second;
}

/// The preset that most of the parameters are as in.
std::string_view nearest_preset(const Flat& parameters) {
  std::string_view nearest;
  std::ptrdiff_t most = -1;
  for (const auto& preset : flat_presets()) {
    const auto same = std::count_if(parameters.begin(), parameters.end(), [&](const auto& part) {
      return is_as_in(preset.second, part);
    });
    if (same > most) most = same, nearest = preset.first;
  }
  return nearest;
}

/// The parameters of a family and "accuracy", its preset or the one next to its own.
Flat parameters_of(const Family& family) {
  Flat flat = flat_parameters(first_group(family).job);
  flat.erase("box.width");
  flat.erase("box.y");
  flat.erase("tube.diameter");
  const std::string& accuracy = first_group(family).job.accuracy;
  flat["accuracy"] = accuracy == "custom" ? nearest_preset(flat) : accuracy;
  return flat;
}

/// The same without what that preset stands for.
Flat told_by(const Family& family) {
  Flat flat = parameters_of(family);
  const bool is_custom = first_group(family).job.accuracy == "custom";
  const Flat& preset = flat_presets().at(flat.at("accuracy"));
  std::erase_if(flat, [&](const auto& part) {
    return is_custom ? is_as_in(preset, part) : part.first.starts_with("accuracy.");
  });
  return flat;
}

/// The last part of a path; of a component's share its number, too: "2.share".
std::string_view short_name(std::string_view path) {
  constexpr std::string_view mixture = "shape.mixture.";
  return path.substr(path.starts_with(mixture) ? mixture.size() : path.rfind('.') + 1);
}

/// "small_share=0.25 size_ratio=0.5": the parameters among `paths`, by the last part of their path.
std::string distinction_of(const Family& family, const std::set<std::string>& paths) {
  std::string text;
  for (const auto& [path, value] : parameters_of(family)) {
    if (!paths.contains(path)) continue;
    text.append(text.empty() ? "" : " ").append(short_name(path)).append("=").append(value);
  }
  return text;
}

/// Paths whose value is not the same in all of `families`.
std::set<std::string> differing_paths(const std::vector<Family*>& families) {
  std::map<std::string, std::map<std::string, std::size_t>> count;
  for (const Family* family : families) {
    for (const auto& [path, value] : told_by(*family)) ++count[path][value];
  }
  std::set<std::string> paths;
  for (const auto& [path, values] : count) {
    if (values.begin()->second != families.size()) paths.insert(path);
  }
  return paths;
}

void name_families(std::vector<Family>& families) {
  std::map<std::string, std::vector<Family*>> by_labels;
  for (Family& family : families) {
    family.labels = labels_of(family);
    by_labels[family.labels].push_back(&family);
  }
  for (const auto& [labels, same] : by_labels) {
    const std::set<std::string> paths = differing_paths(same);
    for (Family* family : same) {
      family->distinction = distinction_of(*family, paths);
      family->name = labels + (family->distinction.empty() ? "" : " ") + family->distinction;
    }
  }
}

void sort_by_width(std::vector<Group>& groups) {
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return a.job.box.width < b.job.box.width;
  });
}

}  // namespace

const Group& first_group(const Family& family) {
  return family.walled.empty() ? family.periodic.front() : family.walled.front();
}

std::vector<Family> families_of(const std::vector<Group>& groups) {
  std::vector<Family> families;
  std::map<std::string, std::size_t> index_of;
  for (const Group& group : groups) {
    const auto [known, is_new] = index_of.try_emplace(group.family, families.size());
    if (is_new) families.emplace_back().parameters = group.family;
    Family& family = families[known->second];
    (group.job.box.y == Boundary::walls ? family.walled : family.periodic).push_back(group);
  }
  for (Family& family : families) sort_by_width(family.walled), sort_by_width(family.periodic);
  name_families(families);
  return families;
}

Analysis analyse(const std::vector<Row>& rows, const std::string& folder) {
  Analysis analysis;
  analysis.folder = folder;
  analysis.groups = groups_of(rows);
  analysis.families = families_of(analysis.groups);
  std::map<std::string, std::string> names;
  for (Family& family : analysis.families) {
    names[family.parameters] = family.name;
    for (Group& group : family.walled) group.family_name = family.name;
    for (Group& group : family.periodic) group.family_name = family.name;
  }
  for (Group& group : analysis.groups) group.family_name = names[group.family];
  return analysis;
}

}  // namespace grainsweep
