#include "runner/tables/component_names.hpp"

#include <algorithm>
#include <map>

namespace grainsweep {
namespace {

constexpr std::string_view components_path = "shape.mixture.", share_end = ".share";

std::string path_of(std::size_t number) {
  return std::string(components_path) + std::to_string(number);
}

struct Component {
  std::string shape = "sphere";  // which has no parts
  std::map<std::string, std::string> parts;
};

std::vector<Component> components_in(const JobFacts& job) {
  const std::map<std::string, std::string> flat = flat_parameters(job);
  std::vector<Component> components;
  while (flat.contains(path_of(components.size() + 1) + std::string(share_end))) {
    Component& one = components.emplace_back();
    const std::string begin = path_of(components.size()) + ".";
    for (auto part = flat.lower_bound(begin); part != flat.end() && part->first.starts_with(begin);
         ++part) {
      const std::string path = part->first.substr(begin.size());
      const std::size_t dot = path.find('.');
      if (dot == std::string::npos) continue;  // the share
      one.shape = path.substr(0, dot);
      const bool is_hash = path.ends_with(".vertices") && !job.files.contains(part->first);
      if (!is_hash) one.parts[path.substr(dot + 1)] = unquoted(part->second);
    }
  }
  return components;
}

/// " (height 2)": in which parts a component differs from others of its shape; "" if in none.
std::string distinction_of(const Component& one, const std::vector<Component>& all) {
  std::string text;
  for (const auto& part : one.parts) {
    const auto differs = [&](const Component& other) {
      const auto same = other.parts.find(part.first);
      return other.shape == one.shape && same != other.parts.end() && same->second != part.second;
    };
    if (std::none_of(all.begin(), all.end(), differs)) continue;
    text.append(text.empty() ? " (" : ", ").append(part.first).append(" ").append(part.second);
  }
  return text.empty() ? "" : text + ")";
}

}  // namespace

std::vector<std::string> component_names(const JobFacts& job) {
  if (!is_mixture(job)) return {};
  const std::vector<Component> all = components_in(job);
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const Component& one : all) names.push_back(one.shape + distinction_of(one, all));
  const std::vector<std::string> before = names;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool is_alone = std::count(before.begin(), before.end(), before[k]) == 1;
    if (!is_alone) names[k] = all[k].shape + " (" + std::to_string(k + 1) + ")";
  }
  return names;
}

std::size_t component_of_share(std::string_view path) {
  if (!path.starts_with(components_path) || !path.ends_with(share_end)) return 0;
  return std::stoul(std::string(path.substr(components_path.size())));
}

}  // namespace grainsweep
