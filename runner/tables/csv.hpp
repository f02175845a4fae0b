// Cells and rows of the tables: RFC 4180, numbers in their shortest form that reads back exactly.
#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace grainsweep {

/// The value of a cell without a number.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Shortest text that reads back with the same bits; empty for NaN and infinities: a cell without a
/// number says that there is none.
std::string cell(double value);

/// The number to so many significant digits, without the noise of the last bits: 0.6 of 6 times
/// 0.1.
double without_noise(double value, int digits = 12);

/// The cell of that.
std::string short_cell(double value, int digits = 12);

/// Decimal digits.
std::string cell(std::integral auto value) { return std::to_string(value); }

/// `text`, in quotes if it holds a comma, a quote or a line break.
std::string cell(std::string_view text);
inline std::string cell(const char* text) { return cell(std::string_view(text)); }

/// A cell as people read it, without its quotes.
std::string unquoted(const std::string& cell);

/// A number short enough for figures: at most four significant digits, all before the point.
std::string short_number(double value);

/// A cell as people read it where it is a number or a list of them: those with more digits than
/// people write, as 1/30 of a default or what a length over another comes to, are short.
std::string with_readable_numbers(const std::string& cell);

/// Finished cells joined by commas and ended by a line feed.
std::string csv_line(const std::vector<std::string>& cells);

}  // namespace grainsweep
