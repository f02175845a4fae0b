#include "runner/sweep/sizes_csv.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/text.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

/// What stands beside the diameters, by the names of these columns.
constexpr std::array<std::string_view, 3> kinds = {"passing", "retained", "share"};

/// The columns of a file, and what the second one holds: one of `kinds`.
struct SizeColumns {
  std::size_t diameter = 0, share = 0;
  std::string_view kind;
};

/// Whether a cell of the header is this name, which is in lower case; spreadsheets write capitals.
bool is_called(std::string_view cell, std::string_view name) {
  return std::equal(cell.begin(), cell.end(), name.begin(), name.end(),
                    [](unsigned char a, char b) { return std::tolower(a) == b; });
}

std::ptrdiff_t count_of(const LineCells& header, std::string_view name) {
  return std::count_if(header.begin(), header.end(),
                       [&](std::string_view cell) { return is_called(cell, name); });
}

std::optional<std::size_t> index_of(const LineCells& header, std::string_view name) {
  const auto found = std::find_if(header.begin(), header.end(),
                                  [&](std::string_view cell) { return is_called(cell, name); });
  if (found == header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.begin());
}

std::optional<SizeColumns> size_columns(const LineCells& header) {
  const auto diameter = index_of(header, "diameter");
  if (!diameter || count_of(header, "diameter") > 1) return std::nullopt;
  std::optional<SizeColumns> columns;
  for (const std::string_view kind : kinds) {
    const auto many = count_of(header, kind);
    if (many == 0) continue;
    if (many > 1 || columns) return std::nullopt;
    columns = SizeColumns{*diameter, *index_of(header, kind), kind};
  }
  return columns;
}

struct SizeRowRead {
  double diameter = 0.0, share = 0.0;
  std::size_t line = 0;
};

/// What is wrong with a line; otherwise its row is added.
std::string read_row(const LineCells& cells, const SizeColumns& columns, std::size_t width,
                     std::size_t line, std::vector<SizeRowRead>& rows) {
  if (cells.size() != width) return wrong_width(cells.size(), width);
  const auto diameter = finite_number(cells[columns.diameter]);
  const auto share = finite_number(cells[columns.share]);
  if (!diameter || !share) {
    const std::string_view wrong = cells[diameter ? columns.share : columns.diameter];
    return "must hold finite numbers, holds \"" + shortened(wrong) + "\"";
  }
  if (!(*diameter > 0.0)) {
    return "the diameter must be positive, is " + bound_text(*diameter) +
           (columns.kind == "retained" ? "; give the pan the smallest size of its grains" : "");
  }
  if (!(*share >= 0.0)) {
    return std::string(columns.kind == "share" ? "the share" : columns.kind) +
           " must not be negative, is " + bound_text(*share);
  }
  rows.push_back({*diameter, *share + 0.0, line});  // -0 and 0 are one value
  return "";
}

/// Notes rows that have the diameter of one before them, which stands just before in `rows`.
void refuse_repeats(const std::vector<SizeRowRead>& rows, const std::string& file,
                    Diagnostics& errors) {
  for (std::size_t k = 1; k < rows.size() && errors.size() < most_wrong_lines; ++k) {
    if (rows[k - 1].diameter != rows[k].diameter) continue;
    note_wrong_line(errors, file, rows[k].line,
                    "repeats the diameter " + bound_text(rows[k].diameter) + " of line " +
                        std::to_string(rows[k - 1].line));
  }
}

/// What is wrong with a curve whose rows ascend.
std::optional<Diagnostic> passing_fault(const std::vector<SizeRowRead>& rows,
                                        const std::string& file) {
  const std::string rule = "passing must rise from 0 to 1, the share finer than each diameter; ";
  const auto wrong = [&](const SizeRowRead& row, const std::string& what) {
    return wrong_line(file, row.line, rule + what);
  };
  const SizeRowRead &first = rows.front(), &last = rows.back();
  const std::string begin = "begins at " + bound_text(first.share);
  const std::string end = "ends at " + bound_text(last.share);
  if (last.share > 1.0) return wrong(last, end + ": divide percentages by 100");
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (rows[k - 1].share <= rows[k].share) continue;
    return wrong(rows[k], "falls to " + bound_text(rows[k].share) + " from " +
                              bound_text(rows[k - 1].share) + " in line " +
                              std::to_string(rows[k - 1].line));
  }
  if (first.share > 0.0) {
    return wrong(first, begin + ": add the largest diameter that nothing is finer than");
  }
  if (last.share < 1.0) return wrong(last, end + ": add a diameter that all is finer than");
  return std::nullopt;
}

/// What is wrong with shares of single diameters.
std::optional<Diagnostic> share_fault(const std::vector<SizeRowRead>& rows,
                                      const std::string& file) {
  std::vector<double> shares;
  shares.reserve(rows.size());
  for (const SizeRowRead& row : rows) shares.push_back(row.share);
  const std::string fault = sum_fault(shares);
  if (fault.empty()) return std::nullopt;
  return wrong_line(file, 1, "the numbers of column share " + fault);
}

/// What is wrong with ascending sieves and what they retain.
std::optional<Diagnostic> retained_fault(const std::vector<SizeRowRead>& rows,
                                         const std::string& file) {
  const SizeRowRead& last = rows.back();
  if (last.share > 0.0) {
    return wrong_line(file, last.line,
                      "the largest sieve must retain 0, retains " + bound_text(last.share) +
                          ": add the next larger one, which no grain stays on");
  }
  double all = 0.0;
  for (const SizeRowRead& row : rows) all += row.share;
  if (all > 0.0 && std::isfinite(all)) return std::nullopt;
  const char* const what =
      all > 0.0 ? "what the sieves retain adds up to too much" : "no sieve retains anything";
  return wrong_line(file, last.line, what);
}

/// Makes of what each sieve retains what is finer than it.
void turn_into_passing(std::vector<SizeRowRead>& rows) {
  double all = 0.0, finer = 0.0;
  for (const SizeRowRead& row : rows) all += row.share;
  for (SizeRowRead& row : rows) {
    const double retained = row.share;
    row.share = finer < all ? finer / all : 1.0;  // the sum of all, added up in the same order
    finer += retained;
  }
}

SizeTable table_of(const std::vector<SizeRowRead>& rows, std::string_view kind) {
  SizeTable table;
  for (const SizeRowRead& row : rows) {
    table.diameters.push_back(row.diameter);
    (kind == "share" ? table.shares : table.passing).push_back(row.share);
  }
  return table;
}

}  // namespace

SizesReading parse_sizes(const std::string& text, const std::string& file) {
  SizesReading reading;
  const auto note = [&](std::size_t line, std::string message) {
    note_wrong_line(reading.errors, file, line, std::move(message));
  };
  const auto lines = lines_of(text);
  const LineCells header = cells_of(lines.front());
  const auto columns = size_columns(header);
  if (!columns) {
    note(1,
         "the first line must name the columns diameter and one of passing, retained and share, "
         "each once; is "
         "\"" +
             shortened(std::string(trimmed(lines.front()))) + "\"" + separator_hint(lines.front()));
    return reading;
  }
  std::vector<SizeRowRead> rows;
  for (std::size_t k = 1; k < lines.size() && reading.errors.size() < most_wrong_lines; ++k) {
    const std::string error = read_row(cells_of(lines[k]), *columns, header.size(), k + 1, rows);
    if (!error.empty()) note(k + 1, error);
  }
  if (lines.size() == 1) note(1, "no row follows the first line");
  if (!reading.errors.empty()) return reading;
  const auto order = [](const SizeRowRead& row) { return std::pair(row.diameter, row.line); };
  std::sort(rows.begin(), rows.end(),
            [&](const SizeRowRead& a, const SizeRowRead& b) { return order(a) < order(b); });
  refuse_repeats(rows, file, reading.errors);
  if (!reading.errors.empty()) return reading;
  auto fault = columns->kind == "passing"    ? passing_fault(rows, file)
               : columns->kind == "retained" ? retained_fault(rows, file)
                                             : share_fault(rows, file);
  if (fault) reading.errors.push_back(std::move(*fault));
  if (columns->kind == "retained") turn_into_passing(rows);
  reading.table = table_of(rows, columns->kind);
  return reading;
}

SizesReading read_sizes(const std::string& path) { return read_parsed(path, parse_sizes); }

}  // namespace grainsweep
