#include "runner/tables/families.hpp"

#include <algorithm>
#include <map>
#include <set>

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

/// What tells families apart; a preset counts as one value.
std::map<std::string, std::string> parameters_of(const Family& family) {
  const JobFacts& job = first_group(family).job;
  std::map<std::string, std::string> flat = flat_parameters(job);
  std::erase_if(flat, [&](const auto& entry) {
    const bool is_in_preset = job.accuracy != "custom" && entry.first.starts_with("accuracy.");
    return is_in_preset || entry.first == "box.width" || entry.first == "box.y";
  });
  if (job.accuracy != "custom") flat["accuracy"] = job.accuracy;
  return flat;
}

/// "small_share=0.25 size_ratio=0.5": the parameters among `paths`, by the last part of their path.
std::string distinction(const Family& family, const std::set<std::string>& paths) {
  std::string text;
  for (const auto& [path, value] : parameters_of(family)) {
    if (!paths.contains(path)) continue;
    text.append(" ").append(path, path.rfind('.') + 1).append("=").append(value);
  }
  return text;
}

/// Paths whose value is not the same in all of `families`.
std::set<std::string> differing_paths(const std::vector<Family*>& families) {
  std::map<std::string, std::map<std::string, std::size_t>> count;
  for (const Family* family : families) {
    for (const auto& [path, value] : parameters_of(*family)) ++count[path][value];
  }
  std::set<std::string> paths;
  for (const auto& [path, values] : count) {
    if (values.begin()->second != families.size()) paths.insert(path);
  }
  return paths;
}

void name_families(std::vector<Family>& families) {
  std::map<std::string, std::vector<Family*>> by_labels;
  for (Family& family : families) by_labels[labels_of(family)].push_back(&family);
  for (const auto& [labels, same] : by_labels) {
    const std::set<std::string> paths = differing_paths(same);
    for (Family* family : same) family->name = labels + distinction(*family, paths);
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
    if (is_new) families.push_back({"", group.family, {}, {}});
    Family& family = families[known->second];
    (group.job.box.y == Boundary::walls ? family.walled : family.periodic).push_back(group);
  }
  for (Family& family : families) sort_by_width(family.walled), sort_by_width(family.periodic);
  name_families(families);
  return families;
}

Analysis analyse(const std::vector<Row>& rows) {
  Analysis analysis;
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
