// What the points of a sweep take from files, and what the sweep gives in units of its own: where
// grains start, vertices of hulls, tables of sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/scene/spec.hpp"
#include "runner/sweep/assignments.hpp"
#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/grains_csv.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/sweep/point_problems.hpp"
#include "runner/sweep/resolved_spec.hpp"
#include "runner/sweep/said_once.hpp"
#include "runner/sweep/sizes_csv.hpp"
#include "runner/sweep/stl.hpp"
#include "runner/sweep/sweep_definition.hpp"

namespace grainsweep {

/// Where the grains of a packing start.
struct GivenStart {
  Fill fill;
  std::string file = {};     ///< as written; "" if they start at random
  std::string content = {};  ///< hash of its bytes
  std::string pointer = {};  ///< its place in a list
};

/// Reads every file once for all jobs. What is wrong with a file, or with where its name is
/// written, becomes a diagnostic.
class GivenFiles {
 public:
  /// Names of files are relative to `folder`. What it refers to must outlive it.
  GivenFiles(const SweepDefinition& definition, std::string folder, Diagnostics& diagnostics,
             PointProblems& problems, SaidOnce& said)
      : definition_(definition),
        folder_(std::move(folder)),
        diagnostics_(diagnostics),
        problems_(problems),
        said_(said),
        is_whole_(!has_errors(diagnostics)) {}

  /// Whether no value or file was left out as unreadable.
  bool is_whole() const { return is_whole_; }

  /// Where the grains of a point start: in one way for all replicates, or in a file for each. A
  /// file that cannot be read is reported and the default fill kept, so that the other rules can be
  /// checked.
  std::vector<GivenStart> starts(const Block& block, const InEffect& in_effect,
                                 ResolvedSpec& resolved);

  /// Fills in what shapes and sizes of a point need besides their own parts. What cannot be read is
  /// reported; what `check` would say of the shape or the sizes without it counts as said then.
  void place(const Block& block, const InEffect& in_effect, ResolvedSpec& resolved);

 private:
  std::vector<GivenStart> starts_in_list(const Block& block, const Assignment& files,
                                         const ResolvedSpec& resolved);
  GivenStart start_in(const std::string& file, const Assignment& assignment,
                      const ResolvedSpec& resolved);

  /// The vertices of a hull.
  void place_vertices(const Block& block, const InEffect& in_effect, ResolvedSpec& resolved);
  /// Those of hulls among the components of a mixture.
  void place_components(const Block& block, const InEffect& in_effect, ResolvedSpec& resolved);
  /// The same for one of them, written at `source`; false if it cannot be used.
  bool place_component(const Block& block, const Assignment& source, WrittenComponent& component);
  /// Reads a table of sizes and converts the distribution to units of d. One that cannot be used is
  /// reported and removed, so that the other rules can be checked.
  void place_sizes(const InEffect& in_effect, ResolvedSpec& resolved);

  /// Notes classes of a file that get lost, as the sweep says nothing of small grains.
  void note_classes(const Assignment& assignment, const GrainsReading& reading,
                    const ResolvedSpec& resolved);
  void note_hull(const Assignment& file, const VerticesReading& reading);
  /// Notes once that diameters are in d: curves of sieves are in the unit that a laboratory uses.
  void note_unit_of(const InEffect& in_effect);
  /// Notes a length of d in a file or in vertices that is not the one of the units. With 1, which
  /// is the default, they are in d.
  void note_other_length(const std::string& pointer, double length, const std::string& what_is);
  /// The same, whatever the length, of `what_is`, "the file is"; tables will give `others`.
  void note_other_d(const std::string& pointer, double d, const std::string& what_is,
                    const std::string& others);
  /// Notes a part, if it is set, of something that is not.
  void note_stray(const Assignment* part, const std::string& message);
  /// Whether the hulls do not hold too many vertices; otherwise a problem is noted.
  bool has_room(std::size_t count, const Block& block, const Assignment& source);

  /// What is in `file`, read once for all jobs.
  template <class Reading>
  const Reading& reading_of(const std::string& file, const Assignment& assignment,
                            Reading (*read)(const std::string&),
                            std::map<std::string, Reading>& files);

  const SweepDefinition& definition_;
  const std::string folder_;
  Diagnostics& diagnostics_;
  PointProblems& problems_;
  SaidOnce& said_;
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
  std::map<std::string, GrainsReading> grains_;   // by file
  std::map<std::string, VerticesReading> hulls_;  // by file
  std::map<std::string, SizesReading> sizes_;     // by file
  std::uint64_t placed_ = 0, vertices_ = 0;
  bool has_noted_unit_ = false;
  bool is_whole_;
};

}  // namespace grainsweep
