#include "runner/sweep/expand.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "engine/shape/named_shapes.hpp"
#include "engine/text.hpp"
#include "engine/units.hpp"
#include "runner/hash.hpp"
#include "runner/sweep/asked_accuracy.hpp"
#include "runner/sweep/grains_csv.hpp"
#include "runner/sweep/identity.hpp"
#include "runner/sweep/job_limit.hpp"
#include "runner/sweep/mixture_components.hpp"
#include "runner/sweep/parameter_row.hpp"
#include "runner/sweep/point_problems.hpp"
#include "runner/sweep/size_formulas.hpp"
#include "runner/sweep/sizes_csv.hpp"
#include "runner/sweep/stl.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

/// Grains from fill files over all jobs, each of which keeps its own copy: 1.6 GB.
constexpr std::uint64_t most_placed_grains = 50'000'000;

/// Vertices of hulls over all jobs, likewise, 1.2 GB.
constexpr std::uint64_t most_vertices = 50'000'000;

Points points_of(const VerticesReading& reading) {
  Points points;
  points.reserve(reading.vertices.size());
  for (const Vector& vertex : reading.vertices) {
    points.push_back({vertex.x(), vertex.y(), vertex.z()});
  }
  return points;
}

/// The points in units of `size`, a length in their present unit.
Points scaled_points(Points points, double size) {
  for (auto& point : points) {
    for (double& coordinate : point) coordinate = coordinate / size + 0.0;  // -0 and 0 are one
  }
  return points;
}

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

/// Where the grains of a packing start.
struct Start {
  Fill fill;
  std::string file = {};     ///< as written; "" if they start at random
  std::string content = {};  ///< hash of its bytes
  std::string pointer = {};  ///< its place in a list
};

/// Hash of what is in the files of a list, whatever they are called.
std::string hash_of(const std::vector<Start>& starts) {
  std::string contents;
  for (const Start& start : starts) contents += start.content;
  return hex16(fnv1a(contents));
}

/// Hash of the grains themselves, however a file writes them: of q and -q, which are one
/// orientation, it takes that whose first number that is not zero is positive.
std::uint64_t hash_of(PlacedGrains placed) {
  for (auto& q : placed.orientations) {
    const auto first = std::find_if(q.begin(), q.end(), [](double part) { return part != 0.0; });
    if (first == q.end() || *first > 0.0) continue;
    for (double& part : q) part = 0.0 - part;
  }
  const auto bytes_of = [](const auto& list) {
    return std::string_view(reinterpret_cast<const char*>(list.data()),
                            list.size() * sizeof list.front());
  };
  return mixed(fnv1a(bytes_of(placed.grains)) + mixed(fnv1a(bytes_of(placed.orientations)))) ^
         fnv1a(bytes_of(placed.components));
}

/// Multiplies out the blocks; holds the jobs made so far and what has been said about them.
class Expansion {
 public:
  Expansion(const SweepDefinition& definition, std::string folder, Diagnostics& diagnostics)
      : definition_(definition),
        folder_(std::move(folder)),
        diagnostics_(diagnostics),
        problems_(definition, diagnostics),
        is_whole_(!has_errors(diagnostics)) {}

  std::vector<Job> run() {
    const bool is_whole = is_whole_;
    for (std::size_t i = 0; i < definition_.blocks.size(); ++i) expand_block(i);
    problems_.name_points();
    note_shared_jobs();
    note_repeated_points();
    if (is_whole) note_unused();
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
    const std::vector<Start> starts = starts_of(block, in_effect, resolved);
    place_vertices(block, in_effect, resolved);
    place_components(block, in_effect, resolved);
    place_sizes(in_effect, resolved);
    note_few_sides(block, in_effect, resolved.spec);
    resolved.spec.fill = starts.front().fill;  // a bed from a file has no known accuracy
    for (const auto& problem : take_asked_accuracy(in_effect, resolved)) {
      if (!is_whole_) break;
      const std::string& pointer = problem.assignment->pointer;
      problems_.note(pointer + " " + problem.message, pointer, problem.message, problem.assignment);
    }
    for (const Start& start : starts) {
      resolved.spec.fill = start.fill;
      note_broken_rules(block, in_effect, check(resolved.spec), start);
    }
    note_use(block, in_effect, resolved.spec);
    if (has_errors(diagnostics_)) return;
    const bool is_listed = !resolved.fill_files.empty();
    const JobHash random_key(canonical_scene(resolved));
    // In a list, the content of its file belongs to each start by itself, so that lists may grow.
    if (is_listed) resolved.fill_content = "one per replicate";
    const std::string identity = canonical_parameters(resolved);
    const JobHash id(identity), bed(canonical_bed(resolved));
    std::string parameters = identity;
    if (is_listed) {
      resolved.fill_content = hash_of(starts);
      parameters = canonical_parameters(resolved);
    }
    Job job{"", block.label, std::move(parameters), 1, resolved.seed, std::move(resolved.spec)};
    if (!resolved.hull_file.empty())
      job.files["shape.hull.vertices"] = name_in_tables(resolved.hull_file);
    note_hull_files(resolved.mixture, job);
    if (!resolved.fill_file.empty()) job.files["fill.file"] = name_in_tables(resolved.fill_file);
    job.wish = block.replicates.wish;
    job.fit_wish = block.replicates.fit_wish;
    job.block = index;
    job.asked_accuracy = resolved.asked_accuracy;
    if (!resolved.size_file.empty()) {
      job.files["sizes.distribution.table.file"] = name_in_tables(resolved.size_file);
    }
    const int replicates =
        is_listed ? static_cast<int>(starts.size()) : most_replicates_of(block, job.spec);
    for (; job.replicate <= replicates; ++job.replicate) {
      const Start& start = starts[is_listed ? static_cast<std::size_t>(job.replicate) - 1 : 0];
      job.spec.fill = start.fill;
      job.spec.random_key = random_key(job.seed, job.replicate);
      if (is_listed) job.files["fill.files"] = name_in_tables(start.file);
      if (!start.content.empty()) refuse_other_seed(identity + start.content, resolved, in_effect);
      const auto hash_with = [&](const JobHash& of_parameters) {
        return is_listed ? of_parameters.followed_by(start.content)(job.seed, 1)
                         : of_parameters(job.seed, job.replicate);
      };
      job.bed = hash_with(bed);
      add(index, job, hash_with(id));
    }
  }

  /// A given start comes out as one bed, whatever the seed: two would be no replicates.
  void refuse_other_seed(const std::string& start, const ResolvedSpec& resolved,
                         const InEffect& in_effect) {
    const auto [known, is_new] = seed_of_start_.try_emplace(start, resolved.seed);
    if (is_new || known->second == resolved.seed) return;
    const Assignment* const seed = in_effect[seed_];
    const Assignment* const file =
        in_effect[file_] != nullptr ? in_effect[file_] : in_effect[files_];
    note(seed != nullptr ? *seed : *file,
         "packs a start that is given with another seed, too: it comes out as the same bed; list "
         "other starts in fill.files");
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

  /// Notes which files the components of a mixture come from.
  static void note_hull_files(const Components& mixture, Job& job) {
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      if (mixture[k].hull_file.empty()) continue;
      job.files["shape.mixture." + std::to_string(k + 1) + ".hull.vertices"] =
          name_in_tables(mixture[k].hull_file);
    }
  }

  void add(std::size_t index, Job& job, std::uint64_t hash) {
    const auto [entry, is_new] = first_block_.emplace(hash, index);
    if (!is_new) {
      const bool same = definition_.blocks[entry->second].label == job.label;
      if (!same) ++shared_[{entry->second, index}];
      if (entry->second == index && job.replicate == 1) ++repeated_[index];
      return;
    }
    job.id = hex16(hash);
    jobs_.push_back(job);
  }

  /// Where the grains of a point start: in one way for all replicates, or in a file for each. A
  /// file that cannot be read is reported and the default fill kept, so that the other rules can be
  /// checked.
  std::vector<Start> starts_of(const Block& block, const InEffect& in_effect,
                               ResolvedSpec& resolved) {
    const Assignment *diameter = in_effect[diameter_], *file = in_effect[file_];
    const Assignment* const files = in_effect[files_];
    if (file == nullptr && files == nullptr) {
      note_stray(diameter, "belongs to fill.file or fill.files; neither is set");
      return {{resolved.spec.fill}};
    }
    if (!(resolved.fill_diameter > 0.0)) {
      note(*diameter, "must be positive");
      return {{SolidHeight{}}};
    }
    if (files != nullptr) return starts_in_list(block, *files, resolved);
    Start start = start_in(resolved.fill_file, *file, resolved.fill_diameter);
    resolved.fill_content = start.content;
    if (block.replicates.most > 1 && !start.content.empty()) {
      note(*file, "would give all " + std::to_string(block.replicates.most) +
                      " replicates the same start; write \"replicates\": 1, or list a start for "
                      "each in fill.files");
    }
    return {std::move(start)};
  }

  std::vector<Start> starts_in_list(const Block& block, const Assignment& files,
                                    const ResolvedSpec& resolved) {
    std::vector<Start> starts;
    std::map<std::uint64_t, std::string> file_of;  // by what it says, however it is written
    for (const std::string& file : resolved.fill_files) {
      const Assignment entry{files.parameter, file,
                             files.pointer + "/" + std::to_string(starts.size())};
      starts.push_back(start_in(file, entry, resolved.fill_diameter));
      starts.back().pointer = entry.pointer;
      const auto* placed = std::get_if<PlacedGrains>(&starts.back().fill);
      if (placed == nullptr) continue;
      const auto [same, is_new] = file_of.try_emplace(hash_of(*placed), file);
      if (!is_new) {
        note(entry, "is the same start as " + same->second + "; replicates must differ");
      }
    }
    if (block.replicates.most > 1 &&
        static_cast<std::size_t>(block.replicates.most) != starts.size()) {
      note(files, "lists " + std::to_string(starts.size()) + " starts for " +
                      std::to_string(block.replicates.most) +
                      " replicates; write \"replicates\": " + std::to_string(starts.size()));
    }
    return starts;
  }

  Start start_in(const std::string& file, const Assignment& assignment, double diameter) {
    Start start{SolidHeight{}, file, "", ""};
    const GrainsReading& reading = reading_of(file, assignment, read_grains, grains_);
    if (!reading.errors.empty()) return start;
    placed_ += reading.grains.size();
    if (placed_ > most_placed_grains) {
      note(assignment, "the jobs hold more than " + in_thousands(most_placed_grains) +
                           " grains from files together; split the sweep");
      return start;
    }
    start.fill = PlacedGrains{scaled_grains(reading.grains, diameter), reading.orientations,
                              reading.components};
    start.content = reading.content;
    return start;
  }

  /// Fills in what a shape needs besides its own parts: the vertices of a hull. If they cannot be
  /// read, says so; what `check` would say of a hull without vertices counts as said then.
  void place_vertices(const Block& block, const InEffect& in_effect, ResolvedSpec& resolved) {
    const Assignment* size = in_effect[hull_size_];
    const Assignment* file = in_effect[hull_file_];
    const Assignment* vertices = in_effect[hull_vertices_];
    const Assignment* source = file != nullptr ? file : vertices;
    if (file != nullptr && vertices != nullptr) {  // reported already
      for (const Assignment* one : {file, vertices}) problems_.skip(one->pointer + " shape.hull");
      return;
    }
    if (source == nullptr) {
      return note_stray(size, "belongs to shape.hull.vertices or shape.hull.file; neither is set");
    }
    if (!std::holds_alternative<HullVertices>(resolved.spec.shape)) return;  // reported already
    auto& hull = std::get<HullVertices>(resolved.spec.shape);
    bool is_sound = true;
    if (file != nullptr) {
      const VerticesReading& reading = reading_of(resolved.hull_file, *file, read_vertices, hulls_);
      is_sound = reading.errors.empty();
      hull.points = points_of(reading);
      note_hull(*file, reading);
    }
    if (!(resolved.hull_size > 0.0)) {
      note(*size, "must be positive");
      is_sound = false;
    }
    is_sound = has_room(hull.points.size(), block, *source) && is_sound;
    hull.points = is_sound ? scaled_points(std::move(hull.points), resolved.hull_size) : Points{};
    if (!is_sound) problems_.skip(source->pointer + " shape.hull");
  }

  /// The same for the hulls among the components of a mixture.
  void place_components(const Block& block, const InEffect& in_effect, ResolvedSpec& resolved) {
    const Assignment* mixture = in_effect[mixture_];
    if (mixture == nullptr) {
      return note_stray(in_effect[mixture_by_], "belongs to shape.mixture, and that is not set");
    }
    auto components = std::get<Components>(mixture->value);
    bool is_sound = true, has_hulls = false;
    for (std::size_t k = 0; k < components.size(); ++k) {
      if (!std::holds_alternative<HullVertices>(components[k].shape)) continue;
      has_hulls = true;
      const std::string place = mixture->pointer + "/" + std::to_string(k) + "/hull/";
      const bool in_file = !components[k].hull_file.empty();
      const Assignment source{mixture->parameter, components[k].hull_file,
                              place + (in_file ? "file" : "vertices")};
      is_sound = place_component(block, source, components[k]) && is_sound;
    }
    if (!has_hulls) return;
    parameters()[mixture_].set(resolved, components);
    if (is_sound) return;
    problems_.skip(mixture->pointer + " shape.mixture");
    problems_.skip(block.pointer + " shape.hull");
  }

  /// The same for one of them, written at `source`; false if it cannot be used.
  bool place_component(const Block& block, const Assignment& source, WrittenComponent& component) {
    Points points = std::get<HullVertices>(component.shape).points;
    bool is_sound = true;
    if (!component.hull_file.empty()) {
      const VerticesReading& reading =
          reading_of(component.hull_file, source, read_vertices, hulls_);
      is_sound = reading.errors.empty();
      points = points_of(reading);
      note_hull(source, reading);
    }
    is_sound = has_room(points.size(), block, source) && is_sound;
    place_hull(is_sound ? scaled_points(std::move(points), component.hull_size) : Points{},
               component);
    return is_sound;
  }

  /// Reads a table of sizes and converts the distribution to units of d. One that cannot be used is
  /// reported and removed, so that the other rules can be checked.
  void place_sizes(const InEffect& in_effect, ResolvedSpec& resolved) {
    auto& distribution = resolved.spec.sizes.distribution;
    const Assignment *file = in_effect[size_file_], *size = in_effect[size_unit_];
    if (!resolved.has_size_formula) {
      for (const Assignment* part : in_effect) {
        if (part == nullptr || parameters()[part->parameter].role != Role::distribution) continue;
        note_stray(part, "belongs to a distribution of sizes, and none is set: write " +
                             size_formula_names(", ", " or "));
      }
      return distribution.reset();
    }
    if (file != nullptr) {
      const SizesReading& reading = reading_of(resolved.size_file, *file, read_sizes, sizes_);
      if (!reading.errors.empty()) return distribution.reset();
      distribution->formula = reading.table;
      if (size == nullptr) note_unit_of(*file);
    }
    if (!(resolved.size_unit > 0.0)) {
      note(*size, "must be positive");
      return distribution.reset();
    }
    if (size != nullptr) note_other_d(*size, resolved.size_unit);
    to_units_of(resolved.size_unit, *distribution);
  }

  void note_hull(const Assignment& file, const VerticesReading& reading) {
    if (reading.note.empty() || !said_.insert(file.pointer + " hull").second) return;
    diagnostics_.push_back({file.pointer, reading.note, Anchor::value, "", true});
  }

  /// Notes the unit: tables of sieves are in the unit that a laboratory uses.
  void note_unit_of(const Assignment& file) {
    const GivenUnits& units = definition_.units;
    if (!units || !said_.insert(file.pointer + " unit").second) return;  // hides no error there
    const std::string d = bound_text(units->d);
    diagnostics_.push_back({file.pointer,
                            "its diameters count as d, which is " + d + " " + units->unit +
                                "; if they are in " + units->unit +
                                ", set sizes.distribution.size to " + d,
                            Anchor::value, "", true});
  }

  /// Notes a length of d that is not the one of the units.
  void note_other_d(const Assignment& size, double d) {
    const GivenUnits& units = definition_.units;
    constexpr double rounding = 1e-6;
    if (!units || std::abs(d - units->d) <= rounding * units->d) return;
    if (!said_.insert(size.pointer + " unit").second) return;  // hides no error there
    const std::string given = bound_text(units->d) + " " + units->unit;
    diagnostics_.push_back({size.pointer,
                            "is not the d of units, " + given + ": if the diameters are in " +
                                units->unit + ", tables will give others in " + units->unit +
                                "; set both to one length",
                            Anchor::value, "", true});
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
    const std::string& pointer = given != nullptr ? given->pointer : block.pointer;
    if (!said_.insert(pointer + " sides").second) return;
    diagnostics_.push_back(
        {pointer,
         joined("packs a prism of ", sides, " sides with ", number_text(std::round(100.0 * share)),
                " % of the cylinder's volume; a smaller chord_error takes more "
                "sides"),
         Anchor::value, "", true});
  }

  /// Whether the hulls do not hold too many vertices; otherwise a problem is noted.
  bool has_room(std::size_t count, const Block& block, const Assignment& source) {
    if (count > most_vertices_of_a_grain) {
      note(source, "holds " + in_thousands(count) + " vertices, more than the " +
                       in_thousands(most_vertices_of_a_grain) +
                       " that a grain may have; simplify the shape");
      return false;
    }
    vertices_ += count * static_cast<std::uint64_t>(block.replicates.most);
    if (vertices_ <= most_vertices) return true;
    note(source, "the jobs hold more than " + in_thousands(most_vertices) +
                     " vertices together; split the sweep");
    return false;
  }

  /// What is in `file`, read once for all jobs.
  template <class Reading>
  const Reading& reading_of(const std::string& file, const Assignment& assignment,
                            Reading (*read)(const std::string&),
                            std::map<std::string, Reading>& files) {
    const std::string path = (std::filesystem::path(folder_) / file).string();
    const auto known = files.find(path);
    if (known != files.end()) return known->second;
    const Reading& reading = files.emplace(path, read(path)).first->second;
    if (!reading.errors.empty()) is_whole_ = false;
    for (const Diagnostic& error : reading.errors) {
      const bool has_no_line = error.place == path;  // then the name in the sweep is the place
      diagnostics_.push_back({assignment.pointer,
                              has_no_line ? path + " " + error.message : error.message,
                              Anchor::value, has_no_line ? "" : error.place});
    }
    return reading;
  }

  void note(const Assignment& assignment, const std::string& message) {
    if (said_.insert(assignment.pointer).second)
      diagnostics_.push_back({assignment.pointer, message});
  }

  /// Notes a part, if it is set, of something that is not.
  void note_stray(const Assignment* part, const std::string& message) {
    if (part != nullptr && is_whole_) note(*part, message);
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
                         const std::vector<SpecError>& errors, const Start& start) {
    for (const SpecError& error : errors) {
      if (!is_whole_ && !is_of_one_value(error, in_effect)) continue;
      const bool is_in_list = error.path == "fill.file" && !start.pointer.empty();
      const Assignment* assignment =
          is_in_list ? in_effect[files_] : assignment_of(error, in_effect);
      const bool has_place = assignment != nullptr;
      const std::string pointer = is_in_list  ? start.pointer
                                  : has_place ? assignment->pointer
                                              : block.pointer;
      const bool is_of_preset =
          has_place && parameters()[assignment->parameter].role == Role::preset;
      const std::string subject = has_place && !is_of_preset ? "" : error.path + " ";
      problems_.note(pointer + " " + error.path, pointer, subject + error.message, assignment);
    }
  }

  /// Remembers what the values in effect at one point are good for.
  void note_use(const Block& block, const InEffect& in_effect, const PackingSpec& spec) {
    const auto note_in = [&](auto& uses, const auto& key, std::size_t parameter) {
      const auto [use, is_new] = uses.try_emplace(key);
      if (is_new || !use->second.empty()) use->second = idle_reason(parameters()[parameter], spec);
    };
    const std::string drawn = block.random.empty() ? "" : block.pointer + "/random/";
    for (const Assignment* assignment : in_effect) {
      if (assignment == nullptr) continue;
      if (!drawn.empty() && assignment->pointer.starts_with(drawn)) {
        note_in(idle_drawn_, assignment->pointer, assignment->parameter);
      } else {
        note_in(idle_, assignment, assignment->parameter);
      }
    }
  }

  void note_unused() {
    note_unused(definition_.base, "every block sets it itself", nullptr);
    for (const Block& block : definition_.blocks) {
      note_unused(block.set, "", &block);
      for (const Axis& axis : block.axes) {
        for (const Assignments& entry : axis.entries) note_unused(entry, "", &block);
      }
      for (const RandomPath& path : block.random) {
        note_choices_out_of_range(path);
        note_idle(path.pointer, idle_drawn_[path.pointer]);
      }
    }
  }

  void note_idle(const std::string& pointer, const std::string& reason) {
    if (reason.empty()) return;
    diagnostics_.push_back({pointer, "has no effect: " + reason, Anchor::value, "", true});
  }

  /// Checks also the choices that no point has drawn.
  void note_choices_out_of_range(const RandomPath& path) {
    const auto is_told = [&](const std::string& pointer) {
      return std::any_of(diagnostics_.begin(), diagnostics_.end(),
                         [&](const Diagnostic& told) { return told.pointer == pointer; });
    };
    for (const Assignments& choice : path.choices) {
      for (const Assignment& assignment : choice) {
        const std::string error = range_error(parameters()[assignment.parameter], assignment.value);
        if (error.empty() || is_told(assignment.pointer)) continue;
        diagnostics_.push_back({assignment.pointer, error});
      }
    }
  }

  /// What a block varies instead of a value that it sets.
  static std::string varied_instead(const Assignment& value, const Block& block) {
    std::vector<std::size_t> varied;
    for (const Axis& axis : block.axes) {
      for (const Assignments& entry : axis.entries) {
        for (const Assignment& assignment : entry) varied.push_back(assignment.parameter);
      }
    }
    for (const RandomPath& path : block.random) {
      if (path.choices.empty()) varied.push_back(path.parameter);
      for (const Assignments& choice : path.choices) {
        for (const Assignment& assignment : choice) varied.push_back(assignment.parameter);
      }
    }
    const Parameter& set = parameters()[value.parameter];
    if (std::find(varied.begin(), varied.end(), value.parameter) != varied.end()) return set.path;
    const auto other = std::find_if(varied.begin(), varied.end(), [&](std::size_t parameter) {
      return choice_of(set) != Choice::none && choice_of(parameters()[parameter]) == choice_of(set);
    });
    return other != varied.end() ? parameters()[*other].path : set.path;
  }

  /// Says which of `assignments` no packing depends on. That is an error where `overridden` is no
  /// excuse for a value that never holds, or where the value could never be right.
  void note_unused(const Assignments& assignments, const std::string& overridden,
                   const Block* block) {
    for (const Assignment& assignment : assignments) {
      if (assignment.is_usual) continue;
      const auto use = idle_.find(&assignment);
      const Parameter& parameter = parameters()[assignment.parameter];
      if (use != idle_.end()) {
        note_idle(assignment.pointer, use->second);
        continue;
      }
      const std::string error = range_error(parameter, assignment.value);
      if (!error.empty()) {
        diagnostics_.push_back({assignment.pointer, error});
      } else if (overridden.empty()) {
        diagnostics_.push_back(
            {assignment.pointer, "the block varies " + varied_instead(assignment, *block) +
                                     ", so that this value is never used; take one of them out"});
      } else {
        diagnostics_.push_back(
            {assignment.pointer, "is never used: " + overridden, Anchor::value, "", true});
      }
    }
  }

  void note_shared_jobs() {
    for (const auto& [pair, count] : shared_) {
      const Block& first = definition_.blocks[pair.first];
      const Block& second = definition_.blocks[pair.second];
      diagnostics_.push_back(
          {second.pointer, "block \"" + second.label + "\" repeats " + in_thousands(count) +
                               (count == 1 ? " job" : " jobs") + " of block \"" + first.label +
                               "\" (" + first.pointer +
                               "); give both the same label, or take the repeated values out"});
    }
  }

  /// Notes points of a block that are drawn or written again: equal ones are one point.
  void note_repeated_points() {
    for (const auto& [index, count] : repeated_) {
      const Block& block = definition_.blocks[index];
      const bool are_drawn = !block.random.empty();
      diagnostics_.push_back({block.pointer + (are_drawn ? "/random/count" : ""),
                              in_thousands(count) + " of " + in_thousands(point_count(block)) +
                                  (count == 1 ? " points is " : " points are ") +
                                  (are_drawn ? "drawn" : "there") +
                                  " again and packed once; for more packings of a point "
                                  "raise replicates",
                              Anchor::value, "", true});
    }
  }

  const SweepDefinition& definition_;
  const std::string folder_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::uint64_t> seed_of_start_;  // by parameters and content of the file
  const std::size_t seed_ = parameter_with(Role::seed);
  const std::size_t file_ = parameter_with(Role::fill_file);
  const std::size_t files_ = parameter_with(Role::fill_files);
  const std::size_t diameter_ = parameter_with(Role::fill_diameter);
  const std::size_t mixture_ = parameter_with(Role::mixture);
  const std::size_t mixture_by_ = parameter_with(Role::mixture_by);
  const std::size_t hull_vertices_ = parameter_with(Role::hull_vertices);
  const std::size_t hull_file_ = parameter_with(Role::hull_file);
  const std::size_t hull_size_ = parameter_with(Role::hull_size);
  const std::size_t size_file_ = parameter_with(Role::size_file);
  const std::size_t size_unit_ = *find_parameter("sizes.distribution.size");
  const std::size_t chord_error_ = *find_parameter("shape.cylinder.chord_error");
  std::vector<Job> jobs_;
  std::unordered_map<std::uint64_t, std::size_t> first_block_;  // of every job, by its hash
  std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> shared_;  // jobs, by two blocks
  std::map<std::size_t, std::uint64_t> repeated_;  // points that were drawn before, by block
  std::map<std::string, GrainsReading> grains_;    // by file
  std::map<std::string, VerticesReading> hulls_;   // by file
  std::map<std::string, SizesReading> sizes_;      // by file
  PointProblems problems_;
  std::set<std::string> said_;
  /// For every value that was in effect: why no packing depended on it so far; "" if one did.
  std::unordered_map<const Assignment*, std::string> idle_;
  std::map<std::string, std::string> idle_drawn_;  ///< by pointer
  std::uint64_t placed_ = 0, vertices_ = 0;
  bool is_whole_;  ///< whether no value or file was left out as unreadable
};

}  // namespace

std::vector<Job> expand(const SweepDefinition& definition, const std::string& folder,
                        Diagnostics& diagnostics) {
  if (!fits(definition, diagnostics)) return {};
  return Expansion(definition, folder, diagnostics).run();
}

}  // namespace grainsweep
