// Lines and numbers of the text files that sweeps name: beds as CSV, shapes as OBJ.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace grainsweep {

/// So many lines of one file are listed as wrong.
inline constexpr std::size_t most_wrong_lines = 20;

/// `text` without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// The lines of a text, without a byte order mark at its start and blank lines at its end; at least
/// one.
std::vector<std::string_view> lines_of(std::string_view text);

/// The number that all of `text` spells, with a decimal point; nothing if it is none or not finite.
std::optional<double> finite_number(std::string_view text);

}  // namespace grainsweep
