// JSON values to parameter values and back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runner/sweep/json_text.hpp"
#include "runner/sweep/parameters.hpp"

namespace grainsweep {

struct ValueReading {
  std::optional<Value> value;
  std::string error;  ///< what is wrong if there is no value: "must be a number, is true"
};

/// `value` as a value of `parameter`.
ValueReading read_value(const Parameter& parameter, const Json& value);

/// What is wrong with a value that lies outside the parameter's range; "" if it lies inside.
std::string range_error(const Parameter& parameter, const Value& value);

/// A value of `parameter` as the sweep file writes it.
nlohmann::json written_value(const Parameter& parameter, const Value& value);

/// The whole number in [`low`, `high`] that `value`, written at `pointer`, is, 3.0 being 3; for
/// another value nothing, and a diagnostic.
std::optional<std::int64_t> whole_number_in(const Json& value, std::int64_t low, std::int64_t high,
                                            const std::string& pointer, Diagnostics& diagnostics);

/// What a value is, for messages: `the text "abc"`, "4.5", "a list", "an object".
std::string describe(const Json& value);

/// What to write for a share that is given in percent, for the end of a message: of 30
/// "; divide percentages by 100", of the text "3%" "; write 0.03"; else "".
std::string of_percent(const Json& value);

/// Why there is no shape of this name, which people may look for; "" for other names.
std::string why_not_packed(std::string_view shape);

/// How values of a kind are called in documentation: "list of numbers".
const char* name_of(ValueKind kind);

/// What a parameter wants, for messages and documentation: "a number", `"periodic" or "walls"`.
std::string wanted_value(const Parameter& parameter);

/// Whole numbers in thousands: "1,000,000".
std::string in_thousands(std::uint64_t count);

/// The number of nine significant digits that is nearest to it.
double nine_digits(double value);

}  // namespace grainsweep
