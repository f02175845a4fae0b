// The one table of what is known of a finished packing: each value stands in it once, with name,
// unit and meaning. The journal line and its reading, the columns of packings.csv and groups.csv,
// columns.csv and the manual all come from it. A new number needs a member in the engine's result
// and a line here, and is std::optional where journals of before have to be read that do not have
// it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runner/store/outcome.hpp"

namespace grainsweep {

/// A value of an outcome; std::monostate where it has none (spheres have no nematic order).
using FieldValue = std::variant<std::monostate, double, std::int64_t, std::uint64_t, bool,
                                std::string, PackingStatus, std::vector<Coordination>>;

/// Where that value is.
using FieldPlace = std::variant<std::monostate, double*, std::int64_t*, std::uint64_t*, bool*,
                                std::string*, PackingStatus*, std::vector<Coordination>*>;

/// Where a field appears.
struct FieldUse {
  bool journal = true;
  bool summary = false;  ///< among the first members of a journal line, all that `status` reads
  bool packings = true;  ///< a column of packings.csv
  bool groups = false;   ///< mean and standard deviation in groups.csv
  bool measured = true;  ///< means something only if the packing was measured
};

struct Field {
  std::string_view name, unit, meaning;
  FieldUse use;
  FieldValue (*value)(const Outcome&) = nullptr;
  /// Makes the optional part of the outcome that the value is in. Null if nothing is stored: the
  /// value follows from others.
  FieldPlace (*place)(Outcome&) = nullptr;
};

/// All of them, in the order of the columns.
const std::vector<Field>& fields();

/// The field of that name, which must exist.
const Field& field_named(std::string_view name);

/// The value as a number; NaN if there is none.
double number_of(const Field& field, const Outcome& outcome);

}  // namespace grainsweep
