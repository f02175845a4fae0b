#include "runner/tables/families.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include "engine/clusters.hpp"
#include "engine/dynamics/presets.hpp"
#include "runner/sweep/identity.hpp"
#include "runner/tables/component_names.hpp"

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

bool is_of_accuracy(std::string_view path) { return path.starts_with("accuracy."); }

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
                    [](const auto& part) { return !is_of_accuracy(part.first); });
    }
    return flat;
  }();
  return all;
}

/// Whether a part of an accuracy is the same as in that preset.
bool is_as_in(const Flat& preset, const Flat::value_type& part) {
  const auto found = preset.find(part.first);
  return found != preset.end() && found->second == part.second;
}

/// The preset that has most of the parameters.
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

/// The parameters of a family; "shape", what its grains are; and "accuracy", its preset or the one
/// nearest to its own.
Flat parameters_of(const Family& family) {
  Flat flat = flat_parameters(first_group(family).job);
  flat.erase("box.width");
  if (first_group(family).is_of_squares) flat.erase("box.length");
  flat.erase("box.y");
  flat.erase("tube.diameter");
  flat["shape"] = first_group(family).job.shape;
  const std::string& accuracy = first_group(family).job.accuracy;
  flat["accuracy"] = has_preset(first_group(family).job) ? accuracy : nearest_preset(flat);
  return flat;
}

/// The same without the parts that the preset stands for.
Flat told_by(const Family& family) {
  Flat flat = parameters_of(family);
  const bool is_custom = !has_preset(first_group(family).job);
  const Flat& preset = flat_presets().at(flat.at("accuracy"));
  std::erase_if(flat, [&](const auto& part) {
    return is_custom ? is_as_in(preset, part) : is_of_accuracy(part.first);
  });
  return flat;
}

/// The last part of a path; of one in a mixture all that tells its components: the name of that
/// whose share it is, or its number and what follows, "2.prism.sides".
std::string short_name(const std::string& path, const std::vector<std::string>& components) {
  constexpr std::string_view mixture = "shape.mixture.";
  const std::size_t component = component_of_share(path);
  if (component > 0) return components.at(component - 1);
  return path.substr(path.starts_with(mixture) ? mixture.size() : path.rfind('.') + 1);
}

enum class Numbers { readable, exact };

/// "small_share=0.25 size_ratio=0.5": the parameters among `paths`, by their short names.
/// Parts of accuracies that are the same as in the preset are left out, and what has no effect.
std::string distinction_of(const Family& family, const std::set<std::string>& paths,
                           Numbers numbers) {
  std::string text;
  const bool tells_presets = std::count_if(paths.begin(), paths.end(), is_of_accuracy) > 1;
  const Flat own = told_by(family);
  const std::vector<std::string> components = component_names(first_group(family).job);
  for (const auto& [path, value] : parameters_of(family)) {
    const bool is_implied = tells_presets && is_of_accuracy(path) && !own.contains(path);
    const bool is_idle = first_group(family).idle.contains(path);
    if (!paths.contains(path) || is_implied || is_idle) continue;
    text.append(text.empty() ? "" : " ")
        .append(short_name(path, components))
        .append("=")
        .append(numbers == Numbers::exact ? unquoted(value)
                                          : with_readable_numbers(unquoted(value)));
  }
  return text;
}

using Counts =
    std::map<std::string, std::map<std::string, std::size_t>>;  // path, value -> families

/// How many families have the shape that a parameter belongs to; all if it belongs to none.
std::size_t families_with(const std::string& path, const Counts& counts, std::size_t all) {
  constexpr std::string_view of_shape = "shape.";
  if (!path.starts_with(of_shape)) return all;
  const std::map<std::string, std::size_t>& shapes = counts.at("shape");
  const auto found =
      shapes.find(path.substr(of_shape.size(), path.find('.', of_shape.size()) - of_shape.size()));
  return found == shapes.end() ? all : found->second;
}

/// Paths whose value is not the same in all of `families`, or in all of one shape. Where several
/// parts of accuracies differ, their presets are given.
std::set<std::string> differing_paths(const std::vector<Family*>& families) {
  Counts counts;
  for (const Family* family : families) {
    for (const auto& [path, value] : told_by(*family)) ++counts[path][value];
  }
  std::set<std::string> paths;
  std::size_t parts = 0;
  for (const auto& [path, values] : counts) {
    if (values.begin()->second == families_with(path, counts, families.size())) continue;
    paths.insert(path);
    parts += is_of_accuracy(path) ? 1 : 0;
  }
  if (parts > 1) paths.insert("accuracy");
  return paths;
}

/// Families that labels do not tell apart: those that share one, with each other or with a third.
std::map<std::size_t, std::vector<Family*>> alike_by_labels(std::vector<Family>& families) {
  Clusters clusters(families.size());
  std::map<std::string_view, std::size_t> first_with;  // a label
  for (std::size_t k = 0; k < families.size(); ++k) {
    for (const auto* groups : {&families[k].walled, &families[k].periodic}) {
      for (const Group& group : *groups) {
        clusters.join(k, first_with.try_emplace(group.job.label, k).first->second);
      }
    }
  }
  std::map<std::size_t, std::vector<Family*>> alike;
  for (std::size_t k = 0; k < families.size(); ++k) {
    alike[clusters.root(k)].push_back(&families[k]);
  }
  return alike;
}

void name_families(std::vector<Family>& families) {
  for (Family& family : families) family.labels = labels_of(family);
  for (const auto& [root, alike] : alike_by_labels(families)) {
    const std::set<std::string> paths = differing_paths(alike);
    std::set<std::string> readable, exact;
    for (const Family* family : alike) {
      readable.insert(distinction_of(*family, paths, Numbers::readable));
      exact.insert(distinction_of(*family, paths, Numbers::exact));
    }
    const bool stay_apart = readable.size() == exact.size();
    for (Family* family : alike) {
      family->distinction =
          distinction_of(*family, paths, stay_apart ? Numbers::readable : Numbers::exact);
      family->name =
          family->labels + (family->distinction.empty() ? "" : " ") + family->distinction;
    }
  }
}

void sort_by_width(std::vector<Group>& groups) {
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return a.job.box.width < b.job.box.width;
  });
}

/// The widest group of a family without any walls that has a settled packing.
const Group* unconfined_of(const Family& family) {
  const Group* widest = nullptr;
  for (const Group& group : family.periodic) {
    const bool is_unconfined = group.job.box.x == Boundary::periodic;
    if (is_unconfined && group.counts.settled > 0) widest = &group;
  }
  return widest;
}

/// The parameters of a family that are not about its container or how much is filled in.
std::string other_parameters(const Family& family) {
  nlohmann::json parameters = nlohmann::json::parse(family.parameters);
  for (const char* path : {"box", "tube", "fill"}) parameters.erase(path);
  return parameters.dump();
}

double narrower_side(const Group& group) {
  return std::min(group.job.box.length, group.job.box.width);
}

void find_unconfined(std::vector<Family>& families) {
  std::map<std::string, const Group*> widest;  // by other_parameters
  for (Family& family : families) {
    const Group* own = unconfined_of(family);
    if (own == nullptr) continue;
    family.unconfined = *own;
    const Group*& known = widest[other_parameters(family)];
    if (known == nullptr || narrower_side(*own) > narrower_side(*known)) known = own;
  }
  if (widest.empty()) return;
  for (Family& family : families) {
    if (family.unconfined) continue;
    const auto other = widest.find(other_parameters(family));
    if (other != widest.end()) family.unconfined = *other->second;
  }
}

}  // namespace

const Group& first_group(const Family& family) {
  return family.walled.empty() ? family.periodic.front() : family.walled.front();
}

std::string extent_symbol(const std::vector<Group>& groups) {
  return extent_symbol(groups, std::identity());
}
std::string extent_symbol(const std::vector<Family>& families) {
  return extent_symbol(families, first_group);
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
  find_unconfined(families);
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
