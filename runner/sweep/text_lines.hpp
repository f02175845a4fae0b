// Text files: sweeps, and what they name, beds as CSV and shapes as OBJ or STL.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runner/sweep/diagnostic.hpp"

namespace grainsweep {

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// A file's bytes, or why it cannot be read.
struct FileText {
  std::string text;
  Diagnostics errors;  ///< at most one
};

/// Reads a whole file of at most 256 MiB. Refuses what is missing, unreadable, a folder, empty or
/// text in UTF-16.
FileText read_text(const std::string& path);

/// What `parse(text, path)` makes of the file at `path`; if that cannot be read, its `errors`
/// alone.
template <class Parse>
auto read_parsed(const std::string& path, Parse parse) {
  FileText file = read_text(path);
  if (file.errors.empty()) return parse(file.text, path);
  decltype(parse(file.text, path)) reading;
  reading.errors = std::move(file.errors);
  return reading;
}

/// At most so many lines of one file are listed as wrong.
inline constexpr std::size_t most_wrong_lines = 20;

/// What is wrong with a line of `file`; lines count from 1.
Diagnostic wrong_line(const std::string& file, std::size_t line, std::string message);

/// Notes a wrong line, and with the last line that is listed that no more are.
void note_wrong_line(Diagnostics& errors, const std::string& file, std::size_t line,
                     std::string message);

/// UTF-8 text with a question mark for each character that a terminal would obey: control
/// characters, other ends of lines, and those that turn the direction of writing.
std::string without_controls(std::string_view text);

/// The same for a message of several lines, whose ends stay.
std::string lines_without_controls(std::string_view text);

/// Whether a character begins with this byte of a text in UTF-8: other bytes continue one.
bool begins_character(char byte);

/// How many characters a text has in UTF-8.
std::size_t characters(std::string_view text);

/// Whether a spreadsheet would take the text for a formula.
bool begins_a_formula(std::string_view text);

/// `text` without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// What stands before, between and behind the separators of a text; at least one piece.
std::vector<std::string_view> pieces_of(std::string_view text, char separator);

/// The lines of a text, without a byte order mark at its start and blank lines at its end; at least
/// one. They end with a line feed, or all with a carriage return.
std::vector<std::string_view> lines_of(std::string_view text);

/// The cells of a line of a CSV file, without blanks and quotation marks at their ends.
using LineCells = std::vector<std::string_view>;
LineCells cells_of(std::string_view line);

/// "", or a hint that a first line is not of cells with commas between them, as of a table that was
/// saved with a decimal comma: "; cells are separated by commas, and numbers have a decimal point".
std::string separator_hint(std::string_view first_line);

/// What is wrong with a line of so many cells where the first one has `width`. A decimal comma
/// makes one more.
std::string wrong_width(std::size_t cells, std::size_t width);

/// The number that all of `text` spells, with a decimal point and any sign; nothing for other text,
/// NaN and infinity.
std::optional<double> finite_number(std::string_view text);

/// Line and column of byte offsets in a text. Lines and columns count from 1, columns in characters
/// (not bytes) of UTF-8, as editors do.
class LineIndex {
 public:
  explicit LineIndex(const std::string& text);

  /// ":line:column" of the byte at `offset`; the end of the text is allowed.
  std::string place(std::size_t offset) const;

 private:
  std::size_t size_;
  std::vector<std::size_t> starts_;         // offset of every line's first byte
  std::vector<std::size_t> continuations_;  // offsets of bytes that continue a character
};

}  // namespace grainsweep
