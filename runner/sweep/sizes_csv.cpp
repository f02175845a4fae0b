#include "runner/sweep/sizes_csv.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/text.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

/// The columns of a file, and what the second one holds.
struct SizeColumns {
  std::size_t diameter = 0, share = 0;
  bool is_passing = false;
};

std::optional<std::size_t> index_of(const LineCells& header, std::string_view name) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.begin());
}

std::optional<SizeColumns> size_columns(const LineCells& header) {
  for (const std::string_view name : {"diameter", "passing", "share"}) {
    if (std::count(header.begin(), header.end(), name) > 1) return std::nullopt;
  }
  const auto diameter = index_of(header, "diameter");
  const auto passing = index_of(header, "passing"), share = index_of(header, "share");
  if (!diameter || passing.has_value() == share.has_value()) return std::nullopt;
  return SizeColumns{*diameter, passing ? *passing : *share, passing.has_value()};
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
  if (!(*diameter > 0.0)) return "the diameter must be positive, is " + bound_text(*diameter);
  if (!(*share >= 0.0)) {
    return std::string(columns.is_passing ? "passing" : "the share") +
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

SizeTable table_of(const std::vector<SizeRowRead>& rows, bool is_passing) {
  SizeTable table;
  for (const SizeRowRead& row : rows) {
    table.diameters.push_back(row.diameter);
    (is_passing ? table.passing : table.shares).push_back(row.share);
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
         "the first line must name the columns diameter and passing, or diameter and share, each "
         "once; is "
         "\"" +
             shortened(std::string(lines.front())) + "\"" + separator_hint(lines.front()));
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
  if (reading.errors.empty() && columns->is_passing) {
    if (auto fault = passing_fault(rows, file)) reading.errors.push_back(std::move(*fault));
  }
  reading.table = table_of(rows, columns->is_passing);
  return reading;
}

SizesReading read_sizes(const std::string& path) { return read_parsed(path, parse_sizes); }

}  // namespace grainsweep
