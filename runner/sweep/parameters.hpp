// The table of everything a sweep can vary: the one source of the reader, its messages, the
// documentation of the file format and the canonical form that identifies a job.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/interval.hpp"
#include "runner/sweep/resolved_spec.hpp"

namespace grainsweep {

/// Points x, y, z.
using Points = std::vector<std::array<double, 3>>;

/// A parameter's value. A choice is the index of its name.
using Value = std::variant<double, std::int64_t, std::uint64_t, std::string, std::vector<double>,
                           std::vector<std::string>, Points, Components>;

enum class ValueKind {
  number,      ///< double
  whole,       ///< int64, at most `largest`
  natural,     ///< uint64
  choice,      ///< int64, index into `choices`
  text,        ///< string
  texts,       ///< list of strings
  numbers,     ///< list of doubles
  points,      ///< list of points
  components,  ///< of a mixture
};

/// What a parameter decides beside its own value. Those of one choice stand together, and their
/// order counts: `choice_of` goes by where they begin and end.
enum class Role {
  plain,
  seed,            ///< master seed: set by blocks, not by "base"
  preset,          ///< gives the other parts of its group their values; its name may stand for them
  asked_accuracy,  ///< chooses the preset, in the place of its name
  shape,           ///< names the shape of the grains
  shape_part,      ///< a part of a shape that has defaults; writing it names that shape
  hull_vertices,   ///< names a hull, and so on
  hull_file,
  hull_size,
  mixture,     ///< names a mixture
  mixture_by,  ///< a part of one
  box,         ///< a part of a box
  tube,        ///< a part of a tube, which stands in the box's place
  fill,        ///< a way to fill the box
  fill_file,   ///< another way
  fill_files,  ///< another
  fill_diameter,
  size_class,    ///< a part of classes of sizes
  size_formula,  ///< a part of a kind of distribution (size_formulas.hpp), in their place
  size_table,    ///< a list of such a part
  size_file,     ///< the file in its place
  distribution,  ///< a part of any distribution
};

/// Parameters that say one thing in several ways: writing one unsets what the others said.
enum class Choice { none, shape, container, fill, sizes, accuracy };

struct Parameter {
  std::string path;     ///< "box.width"
  std::string meaning;  ///< one line, with the unit
  ValueKind kind = ValueKind::number;
  std::int64_t largest = 0;               ///< of a whole number
  std::vector<std::string> choices = {};  ///< names, in the order of their indices
  void (*set)(ResolvedSpec&, const Value&) = nullptr;
  /// The value as it identifies a job; nothing if it does not belong to the job's identity.
  std::optional<Value> (*get)(const ResolvedSpec&) = nullptr;
  Role role = Role::plain;
  /// Where its numbers must lie. Other parameters may narrow it.
  std::optional<Interval> range = {};
  std::vector<std::string> choice_meanings = {};  ///< of each of `choices`, a line
  /// Names of a choice in earlier versions; the last of `choices` took their place.
  std::vector<std::string> former_choices = {};
  std::size_t most_items = most_gap_tolerances;  ///< of a list of numbers
  bool are_distinct = true;                      ///< its numbers
  /// Whether it is written, or read from its file, in the unit of the diameters of a distribution.
  bool is_diameter = false;
  bool is_share = false;  ///< whether people know it in percent, too
  std::string unit = {};  ///< of its numbers in tables and figures: "d"; "" if they have none
};

/// Why a packing does not depend on a parameter that is written; "" if it does.
std::string idle_reason(const Parameter& parameter, const PackingSpec& spec);

/// All parameters. A preset comes before the parts it sets.
const std::vector<Parameter>& parameters();

/// Index of the parameter called `path`.
std::optional<std::size_t> find_parameter(std::string_view path);

/// Whether a path names a number that may have any value of an interval.
bool is_interval(const std::string& path);

/// Index of the first parameter with this role, which one must have.
std::size_t parameter_with(Role role);

/// Which choice a parameter belongs to.
Choice choice_of(const Parameter& parameter);

/// Whether two parameters describe a box and a tube, or the sizes or the accuracy in two ways: only
/// one of them may hold.
bool are_alternatives(const Parameter& a, const Parameter& b);

/// The preset whose name may be written in the place of the group `path`; nothing if none may.
std::optional<std::size_t> preset_of(std::string_view path);

/// The value that a parameter has where it applies and is not written; nothing if it has none.
std::optional<Value> default_of(const Parameter& parameter);

/// Whether parameters lie below `path`: "box", "shape.hull", and "" for all of them.
bool is_group(std::string_view path);

/// What a group of parameters is about, one line: "box", "shape.hull".
std::string meaning_of_group(std::string_view path);

/// Keys known inside the group `path`, those of parameters and groups, dotted ones included: "x",
/// and in "" both "box" and "box.x".
std::vector<std::string> known_keys(std::string_view path);

/// Whether a parameter, by its index, is one of the ways to fill the box.
bool is_fill(std::size_t parameter);

/// Whether it is one of those that read files.
bool is_fill_in_files(std::size_t parameter);

}  // namespace grainsweep
