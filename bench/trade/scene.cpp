#include "bench/trade/scene.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "engine/dynamics/presets.hpp"
#include "runner/commands/results.hpp"
#include "runner/sweep/identity.hpp"
#include "runner/sweep/resolved_spec.hpp"
#include "runner/tables/decays.hpp"

namespace grainsweep::bench {
namespace {

constexpr std::string_view accuracy_prefix = "accuracy.";

Parts parts_of(const JobFacts& job) {
  Parts parts;
  for (const auto& [path, value] : flat_parameters(job)) {
    if (path.starts_with(accuracy_prefix)) parts[path.substr(accuracy_prefix.size())] = value;
  }
  return parts;
}

struct NamedParts {
  std::string_view name;
  Parts parts;
};

/// Parts of all presets, as jobs have them; the cheapest first.
std::vector<NamedParts> parts_of_presets() {
  std::vector<NamedParts> all;
  for (const Preset& preset : presets()) {
    ResolvedSpec resolved;
    resolved.spec.accuracy = preset.accuracy;
    JobFacts job;
    job.parameters = canonical_parameters(resolved);
    all.push_back({preset.name, parts_of(job)});
  }
  return all;
}

/// ", step 0.28": what differs from `preset`.
std::vector<std::string> changes(const Parts& parts, const Parts& preset) {
  std::vector<std::string> texts;
  for (const auto& [part, value] : parts) {
    if (preset.at(part) != value) texts.push_back(", " + part + " " + value);
  }
  return texts;
}

std::string name_beside(const Parts& parts, const std::vector<NamedParts>& presets) {
  std::string name = "custom";
  std::size_t fewest = parts.size();
  for (const NamedParts& preset : presets) {
    const std::vector<std::string> texts = changes(parts, preset.parts);
    if (texts.size() >= fewest) continue;
    fewest = texts.size();
    name = preset.name;
    for (const std::string& text : texts) name += text;
  }
  return name;
}

void add_layers(const Group& group, const PackingResult& result, int start, Setting& setting) {
  const Profile& profile = result.*profile_across(group);
  std::vector<double> values;
  for (const ProfileBin& bin : profile.bins) values.push_back(bin.large + bin.small);
  setting.bin_width = profile.bin_width;
  setting.layers[start].push_back(values);
  if (group.job.box.is_tube) return;
  std::reverse(values.begin(), values.end());
  setting.layers[start].push_back(values);
}

void add_bed(const Group& group, const Outcome& outcome, int start, Setting& setting) {
  const PackingResult& result = outcome.result;
  setting.solid_fraction[start] = result.solid_fraction;
  setting.coordination[start] = result.coordination.front().between_grains;
  setting.contact_ratio[start] = static_cast<double>(result.rest.contacts) /
                                 static_cast<double>(result.rest.isostatic_contacts);
  setting.force_square[start] = result.order.force_square;
  if (group.job.box.is_tube || group.job.box.y == Boundary::walls) {
    add_layers(group, result, start, setting);
  }
}

Setting setting_of(const Group& group, const std::string& folder,
                   const std::map<std::string, int>& start_of) {
  Setting setting;
  setting.parts = parts_of(group.job);
  setting.preset = group.job.accuracy == "custom" ? "" : group.job.accuracy;
  setting.half_gap = group.job.box.width / 2.0;
  setting.bound = group.bias_bound;
  setting.settled = group.counts.settled;
  setting.made = setting.settled + group.counts.not_settled + group.counts.failed;
  setting.planned = setting.made + group.counts.pending;
  const GroupWithCurves with_curves(group, folder);
  for (const Outcome& outcome : with_curves->settled) {
    add_bed(group, outcome, start_of.at(outcome.job), setting);
  }
  return setting;
}

}  // namespace

const Setting* find_setting(const Scene& scene, const Parts& parts) {
  const auto found = std::find_if(scene.settings.begin(), scene.settings.end(),
                                  [&](const Setting& one) { return one.parts == parts; });
  return found == scene.settings.end() ? nullptr : &*found;
}

void name_settings(Scene& scene) {
  const std::vector<NamedParts> presets = parts_of_presets();
  for (Setting& setting : scene.settings) setting.name = name_beside(setting.parts, presets);
}

Scene read_scene(const std::string& folder) {
  const Results results = read_results(folder);
  const std::vector<Group> groups = groups_of(results.rows);
  std::map<std::string, int> start_of;
  Scene scene;
  for (const Row& row : results.rows) {
    start_of[row.job.id] = row.job.replicate;
    scene.seed = row.job.seed;
  }
  for (const Group& group : groups) {
    scene.name = group.job.label;
    scene.settings.push_back(setting_of(group, folder, start_of));
  }
  const std::vector<std::size_t> numbers = group_numbers(results.rows);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Row& row = results.rows[k];
    if (is_measured(row)) {
      scene.settings[numbers[k] - 1].cpu_seconds.push_back(row.outcome->cpu_seconds);
    }
  }
  name_settings(scene);
  return scene;
}

}  // namespace grainsweep::bench
