// The command `plan`: what a sweep stands for and will cost, without running it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/results.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/jobs/estimates.hpp"
#include "runner/jobs/growing_groups.hpp"
#include "runner/jobs/known_beds.hpp"
#include "runner/jobs/schedule.hpp"
#include "runner/jobs/sweep_parts.hpp"
#include "runner/machine.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/shard.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/tables/chosen_presets.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/named_lines.hpp"
#include "runner/tables/packing_names.hpp"
#include "runner/tables/units.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// Lines of the plan that a person wants to see; --json lists everything.
constexpr std::size_t groups_shown = 40;

/// Jobs with one label and one parameter set.
struct PlannedGroup {
  const Job* first = nullptr;
  std::size_t packings = 0;
  Cost cost;  ///< of one packing
};

std::vector<PlannedGroup> planned_groups(const Sweep& sweep, const std::vector<Cost>& costs) {
  std::vector<PlannedGroup> groups;
  for (const Places& set : parameter_sets(sweep.jobs)) {
    groups.push_back({&sweep.jobs[set.front()], set.size(), costs[set.front()]});
  }
  return groups;
}

/// What is made in a folder, if one is given, in as much detail as the sweep needs. Warns of
/// damaged packings, which a run makes anew, as it does those that broke off.
Outcomes made_in(const std::string& folder, const Sweep& whole) {
  if (folder.empty()) return {};
  JournalReading stored = read_journals(folder, grows(whole) ? Detail::whole : Detail::summary);
  std::cerr << damage_warnings(stored.damage)
            << damage_warnings(expect_beds(folder, stored.outcomes));
  std::erase_if(stored.outcomes, [](const auto& one) { return one.second->exception; });
  return std::move(stored.outcomes);
}

/// Estimates, corrected by what finished packings took.
std::vector<Cost> costs_with(const Outcomes& outcomes, const std::vector<Job>& jobs) {
  std::vector<Cost> costs = costs_of(jobs);
  if (outcomes.empty()) return costs;
  std::vector<Known> packings;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    packings.push_back({costs[i].cpu_seconds, std::nullopt});
    const auto known = outcomes.find(jobs[i].id);
    if (known == outcomes.end()) continue;
    packings.back().measured = known->second->cpu_seconds;
  }
  const std::vector<double> seconds = learned(packings);
  for (std::size_t i = 0; i < jobs.size(); ++i) costs[i].cpu_seconds = seconds[i];
  return costs;
}

/// The packings of a sweep that are not made yet.
struct Left {
  std::vector<Cost> costs;        ///< of each of them; a bed that several share is packed once
  std::size_t of_known_beds = 0;  ///< to be measured again only
};

Left left_of(const std::string& folder, const Outcomes& made, const std::vector<Job>& jobs,
             const std::vector<Cost>& costs) {
  std::vector<const Job*> pending;
  Left left;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (made.contains(jobs[k].id)) continue;
    pending.push_back(&jobs[k]);
    left.costs.push_back(costs[k]);
  }
  const KnownBeds beds = made.empty() ? KnownBeds() : known_beds(folder, made, pending);
  std::set<std::uint64_t> packed;
  for (std::size_t k = 0; k < pending.size(); ++k) {
    const bool is_known = beds.contains(pending[k]->id);
    const bool is_packed = !packed.insert(pending[k]->settled_bed).second;
    if (is_known || is_packed) left.costs[k].cpu_seconds *= share_of_measuring;
    left.of_known_beds += is_known ? 1 : 0;
  }
  return left;
}

/// How estimates were corrected by the packings made in a folder.
std::string learned_text(const std::string& folder, const std::vector<Job>& jobs,
                         const std::vector<Cost>& costs, const Left& left) {
  if (!std::filesystem::exists(folder)) {
    return "No packing is made in " + folder + ": there is no such folder\n";
  }
  const std::string again = std::to_string(left.of_known_beds);
  return counted(jobs.size() - left.costs.size(), "packing") + " made in " + folder +
         ": estimates times " +
         fixed(total_cpu_seconds(costs) / total_cpu_seconds(costs_of(jobs)), 2) + "; " +
         counted(left.costs.size(), "packing") + " left" +
         (left.of_known_beds > 0 ? ", " + again + " of stored beds, to be measured again" : "") +
         ", about " + duration_text(total_cpu_seconds(left.costs)) + " CPU\n";
}

/// CPU time of each of so many shards, as the uncorrected estimates divide them, s; 0 for those
/// with nothing to make.
std::vector<double> seconds_of_shards(const Sweep& sweep, const std::vector<Cost>& costs,
                                      int shards) {
  std::vector<double> seconds(static_cast<std::size_t>(shards));
  const std::vector<int> shard_of = shards_of(sweep, shards);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    seconds[static_cast<std::size_t>(shard_of[i] - 1)] += costs[i].cpu_seconds;
  }
  return seconds;
}

/// How evenly the work is divided among so many shards.
std::string shards_text(const Sweep& sweep, const std::vector<Cost>& costs, int shards) {
  const std::vector<double> seconds = seconds_of_shards(sweep, costs, shards);
  const auto idle = static_cast<std::size_t>(std::count(seconds.begin(), seconds.end(), 0.0));
  const double longest = *std::max_element(seconds.begin(), seconds.end());
  const double mean = total_cpu_seconds(costs) / shards;
  std::string text = "In " + counted(seconds.size(), "shard") + ": about " + duration_text(mean) +
                     " CPU each, the longest " + duration_text(longest);
  if (idle > 0) {
    text += "; " + std::to_string(idle) + " have nothing to make";
    if (grows(sweep)) text += ", since growing groups and families remain whole";
  }
  return text + "\n";
}

/// Which packings come next, of growing groups and others, after those that are made; if there are
/// none, which requested errors were reached.
std::string next_text(const GrowingSweep& growing, const Outcomes& made,
                      const PackingNames& names) {
  const Sweep& sweep = growing.now();
  constexpr std::size_t most_shown = 8;
  std::vector<Places> next = parameter_sets(sweep.jobs);
  std::size_t all = 0;
  for (Places& set : next) {
    std::erase_if(set, [&](std::size_t i) { return made.contains(sweep.jobs[i].id); });
    all += set.size();
  }
  std::erase_if(next, [](const Places& set) { return set.empty(); });
  std::sort(next.begin(), next.end());  // by the first packing of each
  if (all == 0) return "Nothing comes next. " + growing.wishes(made);
  std::string text = "Next: " + counted(all, "packing") + ": ";
  for (std::size_t i = 0; i < std::min(next.size(), most_shown); ++i) {
    text += (i == 0 ? "" : "; ") + std::to_string(next[i].size()) + " of " +
            names.set_of(facts_of(sweep.jobs[next[i].front()]));
  }
  if (next.size() > most_shown) {
    text += "; and of " + counted(next.size() - most_shown, "other group");
  }
  return text + "\n";
}

/// Whether one machine makes it in a night: at first, and if all that may grow has grown.
std::string cluster_text(double wall_seconds, double grown_wall_seconds) {
  constexpr double night = 12.0 * 3600.0;
  if (grown_wall_seconds < night) return "No cluster is needed.\n";
  return wall_seconds < night ? "" : "On a cluster: " + called_as() + " slurm FILE --out DIR\n";
}

/// What all packings of a sweep take on the disk, bytes.
DiskNeeds disk_needs_of(const std::vector<PlannedGroup>& groups) {
  DiskNeeds all;
  for (const PlannedGroup& group : groups) {
    const DiskNeeds one = disk_needs(group.first->spec);
    all.grains += static_cast<double>(group.packings) * one.grains;
    all.curves += static_cast<double>(group.packings) * one.curves;
  }
  return all;
}

std::string disk_text(const DiskNeeds& needs) {
  const auto text = [](double bytes) { return size_text(static_cast<std::size_t>(bytes)); };
  return "On the disk: about " + text(needs.grains + needs.curves) + ", " + text(needs.curves) +
         " of it with --no-grains\n";
}

std::string memory_text(double bytes) { return fixed(bytes / 1e6, 1) + " MB"; }

/// Height to which beds probably settle, d; nothing for placed grains, which may be a few.
std::optional<double> planned_height(const PackingSpec& spec) {
  if (std::holds_alternative<PlacedGrains>(spec.fill)) return std::nullopt;
  return probable_height(spec);
}

/// The extent of the container, the height of the bed in d and, if they are given, in the units of
/// the sweep, and what the packings cost.
std::vector<std::string> cells_of(const PlannedGroup& group, const GivenUnits& units) {
  const PackingSpec& spec = group.first->spec;
  const std::string width = width_text(cell(spec.box.width), spec.box.y);
  const std::string extent = width + (spec.box.is_tube ? " tube" : "");
  const double height = planned_height(spec).value_or(no_number);
  std::vector<std::string> cells = {extent, fixed(height, 1)};
  if (units) cells.push_back(fixed(height * units->d, decimals_in(*units, 1)));
  cells.insert(cells.end(), {std::to_string(group.packings), std::to_string(grain_count(spec)),
                             duration_text(group.cost.cpu_seconds), memory_text(group.cost.bytes)});
  return cells;
}

/// The groups with their names, those of one name together: in the order in which names first
/// appear.
std::vector<std::pair<std::string, const PlannedGroup*>> by_name(
    const std::vector<PlannedGroup>& groups, const PackingNames& names) {
  std::map<std::string, std::size_t> place_of;
  std::vector<std::pair<std::string, const PlannedGroup*>> named;
  named.reserve(groups.size());
  for (const PlannedGroup& group : groups) {
    named.emplace_back(names.family_of(facts_of(*group.first)), &group);
    place_of.try_emplace(named.back().first, place_of.size());
  }
  std::stable_sort(named.begin(), named.end(), [&](const auto& a, const auto& b) {
    return place_of.at(a.first) < place_of.at(b.first);
  });
  return named;
}

std::string groups_text(const std::vector<PlannedGroup>& groups, const PackingNames& names,
                        const GivenUnits& units) {
  std::vector<NamedLine> lines;
  for (const auto& [name, group] : by_name(groups, names)) {
    if (lines.size() == groups_shown) break;
    lines.push_back({name, cells_of(*group, units)});
  }
  const auto has_extent = [&](bool is_tube) {
    return std::any_of(groups.begin(), groups.end(), [&](const PlannedGroup& group) {
      return group.first->spec.box.is_tube == is_tube;
    });
  };
  const std::string extent = !has_extent(true) ? "W/d" : has_extent(false) ? "W/d, D/d" : "D/d";
  std::vector<std::string> heads = {pad_right(extent, 13), "height/d"};
  if (units) heads.push_back("height/" + printed_unit(*units));
  heads.insert(heads.end(),
               {"packings", pad_left("grains", 8), pad_left("CPU each", 12), "memory each"});
  std::string text = named_lines("label", heads, lines);
  if (groups.size() > groups_shown) {
    text += "  and " + std::to_string(groups.size() - groups_shown) + " more; --json lists all\n";
  }
  return text;
}

/// What packings need together.
struct Needs {
  double cpu_seconds = 0.0;
  double wall_seconds = 0.0;
  double bytes = 0.0;   ///< of the largest packings that live at once
  double memory = 0.0;  ///< what they may take, bytes
  int live = 1;
};

Needs needs_of(const std::vector<Cost>& costs, int threads) {
  Needs needs;
  needs.memory = memory_for_packings();
  needs.live = live_limit(costs, {threads, needs.memory});
  needs.wall_seconds = estimate_wall(costs, needs.live);
  needs.cpu_seconds = total_cpu_seconds(costs);
  needs.bytes = bytes_of_largest(costs, needs.live);
  return needs;
}

std::string limit_text(double memory) {
  return std::isfinite(memory) ? " of the " + memory_text(memory) + " that can be had" : "";
}

/// `left`: packings that are not made, which `needs` is about.
void print_text(const Sweep& sweep, const std::vector<Cost>& costs, std::size_t left,
                const Needs& needs, double grown_wall_seconds, int threads,
                const PackingNames& names) {
  const std::vector<PlannedGroup> groups = planned_groups(sweep, costs);
  std::cout << sweep.name << ": " << counted(sweep.jobs.size(), "packing") << ", "
            << counted(groups.size(), "parameter set") << "\n"
            << groups_text(groups, names, sweep.units) << chosen_presets_text(sweep)
            << disk_text(disk_needs_of(groups));
  if (left == 0) {
    std::cout << "Left: nothing, all of them are made\n"
              << cluster_text(needs.wall_seconds, grown_wall_seconds);
    return;
  }
  const std::string of_all = std::to_string(left) + " of " + counted(costs.size(), "packing");
  std::cout << (left == costs.size() ? "Estimated: " : "Left: " + of_all + ", ")
            << duration_text(needs.cpu_seconds) << " CPU, about "
            << duration_text(needs.wall_seconds) << " on "
            << counted(static_cast<std::size_t>(threads), "thread") << " ("
            << counted(static_cast<std::size_t>(needs.live), "packing") << " at once), up to "
            << memory_text(needs.bytes) << limit_text(needs.memory) << "\n"
            << (needs.bytes > needs.memory ? "A machine with more memory is needed.\n"
                                           : cluster_text(needs.wall_seconds, grown_wall_seconds));
}

/// One line; the parameters are JSON already. `height`: as planned_height.
std::string job_json(const Job& job, const Cost& cost, std::optional<double> height,
                     const GivenUnits& units) {
  nlohmann::ordered_json facts = {{"job", job.id},
                                  {"label", job.label},
                                  {"replicate", job.replicate},
                                  {"seed", job.seed},
                                  {"grains", grain_count(job.spec)},
                                  {"estimated_cpu_seconds", cost.cpu_seconds},
                                  {"estimated_bytes", cost.bytes}};
  if (height) facts["expected_height"] = *height;
  if (height && units) facts["expected_height_" + units->unit] = *height * units->d;
  std::string text = facts.dump();
  text.pop_back();
  return text + ",\"parameters\":" + job.parameters.text() + "}";
}

/// Written job by job: as one value a large sweep would take ten times the memory. `most`: the
/// costs of all that a sweep may grow to; empty if it does not grow.
void print_json(const Sweep& sweep, const std::vector<Cost>& costs, const Left& left,
                const std::vector<Cost>& most, int shards, int threads) {
  const Needs needs = needs_of(costs, threads);
  const DiskNeeds disk = disk_needs_of(planned_groups(sweep, costs));
  nlohmann::ordered_json plan = {
      {"name", sweep.name},
      {"packings", costs.size()},
      {"threads", threads},
      {"packings_at_once", needs.live},
      {"estimated_cpu_seconds", needs.cpu_seconds},
      {"estimated_wall_seconds", needs.wall_seconds},
      {"estimated_bytes", needs.bytes},
      {"available_bytes", needs.memory},
      {"estimated_disk_bytes", disk.grains + disk.curves},
      {"estimated_disk_bytes_without_grains", disk.curves},
      {"left_packings", left.costs.size()},
      {"left_estimated_cpu_seconds", total_cpu_seconds(left.costs)},
      {"left_estimated_wall_seconds", needs_of(left.costs, threads).wall_seconds}};
  if (!most.empty()) {
    plan["most_packings"] = most.size();
    plan["most_estimated_cpu_seconds"] = total_cpu_seconds(most);
  }
  if (shards > 0) {
    plan["estimated_cpu_seconds_of_shards"] = seconds_of_shards(sweep, costs, shards);
  }
  std::string text = plan.dump(2);
  text.resize(text.rfind('\n'));
  std::cout << text << ",\n  \"jobs\": [";
  std::vector<std::optional<double>> heights(costs.size());
  for (const Places& set : parameter_sets(sweep.jobs)) {
    const auto height = planned_height(sweep.jobs[set.front()].spec);
    for (const std::size_t i : set) heights[i] = height;
  }
  for (std::size_t i = 0; i < costs.size(); ++i) {
    std::cout << (i == 0 ? "\n    " : ",\n    ")
              << job_json(sweep.jobs[i], costs[i], heights[i], sweep.units);
  }
  std::cout << "\n  ]\n}\n";
}

}  // namespace

void add_command(CLI::App& app, PlanOptions& options) {
  CLI::App& plan =
      *app.add_subcommand("plan", "List the packings of a sweep with estimated time and memory");
  add_file(plan, options.file);
  plan.add_option("--out", options.out, "output folder: packings made in it teach the estimates")
      ->check(not_empty())
      ->type_name("DIR");
  add_threads(plan, options.threads);
  plan.add_option("--shards", options.shards, "how evenly so many shards divide it")
      ->check(CLI::Range(1, most_shards))
      ->type_name("N");
  plan.add_flag("--json", options.json, "every packing, as JSON");
  plan.footer("Example: grainsweep plan configs/confined-spheres.json --threads 8");
}

int perform(const PlanOptions& options) {
  const Sweep whole = sweep_with_notes(options.file);
  const Outcomes made = made_in(options.out, whole);
  const GrowingSweep growing(whole, made);
  const Sweep& sweep = growing.now();
  const int threads = options.threads > 0 ? options.threads : usable_cores();
  const std::vector<Cost> costs = costs_with(made, sweep.jobs);
  const Left left = left_of(options.out, made, sweep.jobs, costs);
  if (!options.out.empty()) std::cerr << learned_text(options.out, sweep.jobs, costs, left);
  std::cerr << memory_warning(left.costs, memory_for_packings());
  const std::vector<Cost> grown = grows(whole) ? costs_with(made, whole.jobs) : std::vector<Cost>();
  if (options.json) {
    print_json(sweep, costs, left, grown, options.shards, threads);
  } else {
    const PackingNames names = names_in(sweep);
    const std::vector<Cost>& most = grows(whole) ? grown : costs;
    const Needs needs = needs_of(left.costs, threads);
    const double grown_seconds =
        grows(whole)
            ? needs_of(left_of(options.out, made, whole.jobs, grown).costs, threads).wall_seconds
            : needs.wall_seconds;
    print_text(sweep, costs, left.costs.size(), needs, grown_seconds, threads, names);
    if (grows(whole)) {
      std::cout << next_text(growing, made, names) << growth_text(most)
                << (options.out.empty()
                        ? "; with --out the packings made so far tell how many come next\n"
                        : "\n");
    }
    if (options.shards > 0) std::cout << shards_text(sweep, costs, options.shards);
  }
  return exit_done;
}

}  // namespace grainsweep
