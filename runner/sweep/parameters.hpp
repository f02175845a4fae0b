// The table of everything a sweep can vary: the one source of the reader, its messages, the
// documentation of the file format and the canonical form that identifies a job.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runner/sweep/draft.hpp"

namespace grainsweep {

/// A parameter's value. A choice is the index of its name.
using Value = std::variant<double, std::int64_t, std::uint64_t, std::string, std::vector<double>>;

enum class ValueKind {
  number,   ///< double
  whole,    ///< int64, at most `largest`
  natural,  ///< uint64
  choice,   ///< int64, index into `choices`
  text,     ///< string
  numbers,  ///< list of doubles
};

struct Parameter {
  std::string path;     ///< "box.width"
  std::string meaning;  ///< one line, with the unit
  ValueKind kind = ValueKind::number;
  std::int64_t largest = 0;          ///< of a whole number
  std::vector<std::string> choices;  ///< names, in the order of their indices
  void (*set)(Draft&, const Value&) = nullptr;
  /// The value as it identifies a job; nothing if it does not belong to the job's identity.
  std::optional<Value> (*get)(const Draft&) = nullptr;
};

/// All parameters. A preset comes before the parts it sets.
const std::vector<Parameter>& parameters();

/// Index of the parameter called `path`.
std::optional<std::size_t> find_parameter(std::string_view path);

/// Whether parameters lie below `path`: "box", "accuracy", and "" for all of them.
bool is_group(std::string_view path);

/// Keys known inside the group `path`, dotted ones included: "x", and in "" both "box" and "box.x".
std::vector<std::string> known_keys(std::string_view path);

/// The three ways to fill a box are one choice: setting one of them unsets the others.
bool is_fill(std::size_t parameter);

}  // namespace grainsweep
