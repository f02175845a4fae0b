#include "runner/sweep/expand.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "engine/shape/named_shapes.hpp"
#include "engine/text.hpp"
#include "engine/units.hpp"
#include "runner/hash.hpp"
#include "runner/sweep/asked_accuracy.hpp"
#include "runner/sweep/given_files.hpp"
#include "runner/sweep/identity.hpp"
#include "runner/sweep/job_limit.hpp"
#include "runner/sweep/parameter_row.hpp"
#include "runner/sweep/point_problems.hpp"
#include "runner/sweep/said_once.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/sweep/unused_values.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

/// The random points of a block, drawn.
Axis drawn_points(const Block& block, std::uint64_t seed, std::uint64_t index) {
  Axis random{"random", {}};
  for (std::uint64_t point = 0; point < block.random_count; ++point) {
    Assignments& entry = random.entries.emplace_back();
    for (const RandomPath& path : block.random) {
      const Assignments drawn = draw(path, {seed, index, point});
      entry.insert(entry.end(), drawn.begin(), drawn.end());
    }
  }
  return random;
}

/// The entries that make up the `point`th point of the product, one of each axis.
std::vector<const Assignments*> entries_of(const std::vector<const Axis*>& axes,
                                           std::uint64_t point) {
  std::vector<const Assignments*> entries(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    const std::uint64_t size = axes[i]->entries.size();
    entries[i] = &axes[i]->entries[static_cast<std::size_t>(point % size)];
    point /= size;
  }
  return entries;
}

/// The name of a file as tables show it.
std::string name_in_tables(const std::string& file) {
  return without_controls(begins_a_formula(file) ? "./" + file : file);
}

/// Hash of what is in the files of a list, whatever they are called.
std::string hash_of(const std::vector<GivenStart>& starts) {
  std::string contents;
  for (const GivenStart& start : starts) contents += start.content;
  return hex16(fnv1a(contents));
}

/// Multiplies out the blocks; holds the jobs made so far and what has been said about them.
class Expansion {
 public:
  Expansion(const SweepDefinition& definition, std::string folder, Diagnostics& diagnostics)
      : definition_(definition),
        diagnostics_(diagnostics),
        problems_(definition, diagnostics),
        said_(diagnostics),
        files_(definition, std::move(folder), diagnostics, problems_, said_),
        unused_(diagnostics) {}

  std::vector<Job> run() {
    const bool is_whole = files_.is_whole();
    for (std::size_t i = 0; i < definition_.blocks.size(); ++i) expand_block(i);
    problems_.name_points();
    note_shared_jobs();
    note_repeated_points();
    note_twins();
    if (is_whole) unused_.tell(definition_);
    return std::move(jobs_);
  }

 private:
  void expand_block(std::size_t index) {
    const Block& block = definition_.blocks[index];
    std::vector<const Axis*> axes;
    for (const Axis& axis : block.axes) axes.push_back(&axis);
    const Axis random = drawn_points(block, definition_.seed, index);
    if (!block.random.empty() && !random.entries.empty()) axes.push_back(&random);
    InEffect before(parameters().size(), nullptr);
    overlay({&definition_.base}, before);
    overlay({&block.set}, before);
    const std::uint64_t points = point_count(block);
    make_room(points * static_cast<std::uint64_t>(block.replicates.most));
    for (std::uint64_t point = 0; point < points; ++point) {
      InEffect in_effect = before;
      const std::vector<const Assignments*> entries = entries_of(axes, point);
      overlay(entries, in_effect);
      problems_.begin_point(block, entries, in_effect);
      make_jobs(index, in_effect);
    }
  }

  /// For one large block at once; with many small ones the list grows by itself.
  void make_room(std::uint64_t jobs) {
    if (jobs > jobs_.size()) jobs_.reserve(jobs_.size() + static_cast<std::size_t>(jobs));
  }

  void make_jobs(std::size_t index, const InEffect& in_effect) {
    const Block& block = definition_.blocks[index];
    ResolvedSpec resolved = resolve(in_effect);
    if (in_effect[seed_] == nullptr) resolved.seed = definition_.seed;
    const std::vector<GivenStart> starts = files_.starts(block, in_effect, resolved);
    files_.place(block, in_effect, resolved);
    judge(block, in_effect, starts, resolved);
    if (has_errors(diagnostics_)) return;
    const bool is_listed = !resolved.fill_files.empty();
    const JobHash random_key(canonical_scene(resolved));
    // In a list, the content of its file belongs to each start by itself, so that lists may grow.
    if (is_listed) resolved.fill_content = "one per replicate";
    const std::string identity = canonical_parameters(resolved);
    const JobHash id(identity), bed(canonical_bed(resolved));
    const JobHash settled_bed(canonical_settled_bed(resolved));
    note_twin(index, in_effect, resolved, identity);
    std::string parameters = identity;
    if (is_listed) {
      resolved.fill_content = hash_of(starts);
      parameters = canonical_parameters(resolved);
    }
    Job job{"", block.label, std::move(parameters), 1, resolved.seed, std::move(resolved.spec)};
    name_files(resolved, job);
    job.wish = block.replicates.wish;
    job.fit_wish = block.replicates.fit_wish;
    job.block = index;
    job.asked_accuracy = resolved.asked_accuracy;
    const int replicates =
        is_listed ? static_cast<int>(starts.size()) : most_replicates_of(block, job.spec);
    for (; job.replicate <= replicates; ++job.replicate) {
      const GivenStart& start = starts[is_listed ? static_cast<std::size_t>(job.replicate) - 1 : 0];
      job.spec.fill = start.fill;
      job.spec.random_key = random_key(job.seed, job.replicate);
      if (is_listed) job.files["fill.files"] = name_in_tables(start.file);
      if (!start.content.empty()) refuse_other_seed(identity + start.content, resolved, in_effect);
      const auto hash_with = [&](const JobHash& of_parameters) {
        return is_listed ? of_parameters.followed_by(start.content)(job.seed, 1)
                         : of_parameters(job.seed, job.replicate);
      };
      job.bed = hash_with(bed);
      job.settled_bed = hash_with(settled_bed);
      add(index, job, hash_with(id));
    }
  }

  /// Notes what is wrong with a point, and what its values are good for. Its presets become those
  /// of the accuracy that it asks for.
  void judge(const Block& block, const InEffect& in_effect, const std::vector<GivenStart>& starts,
             ResolvedSpec& resolved) {
    note_few_sides(block, in_effect, resolved.spec);
    resolved.spec.fill = starts.front().fill;  // a bed from a file has no known accuracy
    for (const auto& problem : take_asked_accuracy(in_effect, resolved)) {
      if (!files_.is_whole()) break;
      const std::string& pointer = problem.assignment->pointer;
      problems_.note(pointer + " " + problem.message, pointer, problem.message, problem.assignment);
    }
    for (const GivenStart& start : starts) {
      resolved.spec.fill = start.fill;
      note_broken_rules(block, in_effect, check(resolved.spec), start);
    }
    unused_.note_use(block, in_effect, resolved.spec);
  }

  /// A given start comes out as one bed, whatever the seed: two would be no replicates.
  void refuse_other_seed(const std::string& start, const ResolvedSpec& resolved,
                         const InEffect& in_effect) {
    const auto [known, is_new] = seed_of_start_.try_emplace(start, resolved.seed);
    if (is_new || known->second == resolved.seed) return;
    const Assignment* const seed = in_effect[seed_];
    const Assignment* const file =
        in_effect[fill_file_] != nullptr ? in_effect[fill_file_] : in_effect[fill_files_];
    said_.problem(seed != nullptr ? *seed : *file,
                  "packs a start that is given with another seed, too: it comes out as the same "
                  "bed; list other starts in fill.files");
  }

  /// How many packings of a point there may be. Packings without walls are not on the line of a
  /// requested fit: they only show how packings scatter, and keep the number that all have at
  /// first.
  static int most_replicates_of(const Block& block, const PackingSpec& spec) {
    const int most = block.replicates.most;
    const bool is_walled = spec.box.y == Boundary::walls;
    const bool is_beside_fit = block.replicates.fit_wish.is_given() && !is_walled;
    return is_beside_fit ? std::min(first_replicates, most) : most;
  }

  /// Which files all packings of a point come from.
  static void name_files(const ResolvedSpec& resolved, Job& job) {
    const auto name = [&](const std::string& path, const std::string& file) {
      if (!file.empty()) job.files[path] = name_in_tables(file);
    };
    name("shape.hull.vertices", resolved.hull_file);
    for (std::size_t k = 0; k < resolved.mixture.size(); ++k) {
      name("shape.mixture." + std::to_string(k + 1) + ".hull.vertices",
           resolved.mixture[k].hull_file);
    }
    name("fill.file", resolved.fill_file);
    name("sizes.distribution.table.file", resolved.size_file);
  }

  /// What is there again, and the values of the first point with it.
  struct Again {
    std::uint64_t count = 0;
    std::string first;
  };

  void count_again(Again& again) const {
    if (++again.count == 1) again.first = problems_.values_of_point();
  }

  /// ", the first with box.width 5"; nothing where lists give no values.
  static std::string first_of(const Again& again) {
    if (again.first.empty()) return "";
    return again.count == 1 ? ", with " + again.first : ", the first with " + again.first;
  }

  void add(std::size_t index, Job& job, std::uint64_t hash) {
    const auto [entry, is_new] = first_block_.emplace(hash, index);
    if (!is_new) {
      const bool same = definition_.blocks[entry->second].label == job.label;
      if (!same) count_again(shared_[{entry->second, index}]);
      if (entry->second == index && job.replicate == 1) count_again(repeated_[index]);
      return;
    }
    job.id = hex16(hash);
    jobs_.push_back(job);
  }

  /// Notes a cylinder whose sides are so few that it lacks much of its volume.
  void note_few_sides(const Block& block, const InEffect& in_effect, const PackingSpec& spec) {
    const auto* cylinder = std::get_if<CylinderSize>(&spec.shape);
    if (cylinder == nullptr || !(cylinder->chord_error > 0.0)) return;
    const int sides = sides_of(*cylinder);
    const double share = sides / (2.0 * pi) * std::sin(2.0 * pi / sides);
    constexpr double enough = 0.9;
    if (share >= enough) return;
    const Assignment* given = in_effect[chord_error_];
    said_.remark(
        given != nullptr ? given->pointer : block.pointer, "sides",
        joined("packs a prism of ", sides, " sides with ", number_text(std::round(100.0 * share)),
               " % of the cylinder's volume; a smaller chord_error takes more sides"));
  }

  /// Whether one value is wrong by itself, whatever the others are.
  static bool is_of_one_value(const SpecError& error, const InEffect& in_effect) {
    const auto parameter = find_parameter(error.path);
    const Assignment* const written = parameter ? in_effect[*parameter] : nullptr;
    return written != nullptr && !range_error(parameters()[*parameter], written->value).empty();
  }

  /// Notes what one point breaks. Where something could not be read, rules between several values
  /// are not judged: what stands in its place says nothing about them.
  void note_broken_rules(const Block& block, const InEffect& in_effect,
                         const std::vector<SpecError>& errors, const GivenStart& start) {
    for (const SpecError& error : errors) {
      if (!files_.is_whole() && !is_of_one_value(error, in_effect)) continue;
      const bool is_in_list = error.path == "fill.file" && !start.pointer.empty();
      const Assignment* assignment =
          is_in_list ? in_effect[fill_files_] : assignment_of(error, in_effect);
      const bool has_place = assignment != nullptr;
      const std::string pointer = is_in_list  ? start.pointer
                                  : has_place ? assignment->pointer
                                              : block.pointer;
      const bool is_of_preset =
          has_place && parameters()[assignment->parameter].role == Role::preset;
      const std::string subject = has_place && !is_of_preset ? "" : error.path + " ";
      problems_.note(pointer + " " + error.path, pointer, subject + error.message, assignment,
                     error.asked);
    }
  }

  /// Counts a point that differs from one before only in the ratio of two sizes, of which there is
  /// one.
  void note_twin(std::size_t index, const InEffect& in_effect, const ResolvedSpec& resolved,
                 const std::string& identity) {
    const Parameter& ratio = parameters()[size_ratio_];
    if (in_effect[size_ratio_] == nullptr) return;
    if (idle_reason(ratio, resolved.spec).empty()) {
      with_two_sizes_.insert(index);
      return;
    }
    ResolvedSpec usual = resolved;
    ratio.set(usual, *default_of(ratio));
    const std::string key = definition_.blocks[index].label + "\n" + std::to_string(resolved.seed) +
                            "\n" + canonical_parameters(usual);
    const auto [known, is_new] = first_without_ratio_.try_emplace(key, identity);
    if (!is_new && known->second != identity) count_again(twins_[index]);
  }

  void note_shared_jobs() {
    for (const auto& [pair, again] : shared_) {
      const Block& first = definition_.blocks[pair.first];
      const Block& second = definition_.blocks[pair.second];
      diagnostics_.push_back(
          {second.pointer, "block \"" + second.label + "\" repeats " + in_thousands(again.count) +
                               (again.count == 1 ? " job" : " jobs") + " of block \"" +
                               first.label + "\" (" + first.pointer + ")" + first_of(again) +
                               "; give both the same label, or take the repeated values out"});
    }
  }

  /// Notes points of a block that are drawn or written again: equal ones are one point.
  void note_repeated_points() {
    for (const auto& [index, again] : repeated_) {
      const Block& block = definition_.blocks[index];
      const bool are_drawn = !block.random.empty();
      diagnostics_.push_back(
          {block.pointer + (are_drawn ? "/random/count" : ""),
           in_thousands(again.count) + " of " + in_thousands(point_count(block)) +
               (again.count == 1 ? " points is " : " points are ") +
               (are_drawn ? "drawn" : "there") + " again and packed once" + first_of(again) +
               "; for more packings of a point "
               "raise replicates",
           Anchor::value, "", true});
    }
  }

  /// Notes points of a block that are beds of their own only by a value without effect; of one that
  /// has no effect at any point its own note says it.
  void note_twins() {
    for (const auto& [index, again] : twins_) {
      if (!with_two_sizes_.contains(index)) continue;
      const Block& block = definition_.blocks[index];
      diagnostics_.push_back(
          {block.pointer,
           in_thousands(again.count) + " of " + in_thousands(point_count(block)) +
               (again.count == 1 ? " points differs" : " points differ") +
               " from another one only in sizes.size_ratio, which has no effect where "
               "sizes.small_share is 0" +
               first_of(again) + "; give that share a block of its own to pack it once",
           Anchor::value, "", true});
    }
  }

  const SweepDefinition& definition_;
  Diagnostics& diagnostics_;
  PointProblems problems_;
  SaidOnce said_;
  GivenFiles files_;
  UnusedValues unused_;
  std::map<std::string, std::uint64_t> seed_of_start_;  // by parameters and content of the file
  const std::size_t seed_ = parameter_with(Role::seed);
  const std::size_t fill_file_ = parameter_with(Role::fill_file);
  const std::size_t fill_files_ = parameter_with(Role::fill_files);
  const std::size_t size_ratio_ = *find_parameter("sizes.size_ratio");
  const std::size_t chord_error_ = *find_parameter("shape.cylinder.chord_error");
  std::vector<Job> jobs_;
  std::unordered_map<std::uint64_t, std::size_t> first_block_;   // of every job, by its hash
  std::map<std::pair<std::size_t, std::size_t>, Again> shared_;  // jobs, by two blocks
  std::map<std::size_t, Again> repeated_;  // points that were drawn before, by block
  std::unordered_map<std::string, std::string> first_without_ratio_;  // identities
  std::set<std::size_t> with_two_sizes_;  // blocks where the ratio has an effect
  std::map<std::size_t, Again> twins_;    // points that differ in an idle ratio, by block
};

}  // namespace

std::vector<Job> expand(const SweepDefinition& definition, const std::string& folder,
                        Diagnostics& diagnostics) {
  if (!fits(definition, diagnostics)) return {};
  return Expansion(definition, folder, diagnostics).run();
}

}  // namespace grainsweep
