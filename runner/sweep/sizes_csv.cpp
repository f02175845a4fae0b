#include "runner/sweep/sizes_csv.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

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

using SizeRowRead = std::pair<double, double>;

/// What is wrong with a line; otherwise its row is added.
std::string read_row(const LineCells& cells, const SizeColumns& columns, std::size_t width,
                     std::vector<SizeRowRead>& rows) {
  if (cells.size() != width) return wrong_width(cells.size(), width);
  const auto diameter = finite_number(cells[columns.diameter]);
  const auto share = finite_number(cells[columns.share]);
  if (diameter && share) {
    rows.emplace_back(*diameter + 0.0, *share + 0.0);  // -0 and 0 are one value
    return "";
  }
  const std::string_view wrong = cells[diameter ? columns.share : columns.diameter];
  return "must hold finite numbers, holds \"" + shortened(wrong) + "\"";
}

SizeTable table_of(std::vector<SizeRowRead> rows, bool is_passing) {
  std::sort(rows.begin(), rows.end());
  SizeTable table;
  for (const auto& [diameter, share] : rows) {
    table.diameters.push_back(diameter);
    (is_passing ? table.passing : table.shares).push_back(share);
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
             shortened(std::string(lines.front())) + "\"");
    return reading;
  }
  std::vector<SizeRowRead> rows;
  for (std::size_t k = 1; k < lines.size() && reading.errors.size() < most_wrong_lines; ++k) {
    const std::string error = read_row(cells_of(lines[k]), *columns, header.size(), rows);
    if (!error.empty()) note(k + 1, error);
  }
  if (lines.size() == 1) note(1, "no row follows the first line");
  reading.table = table_of(std::move(rows), columns->is_passing);
  return reading;
}

SizesReading read_sizes(const std::string& path) { return read_parsed(path, parse_sizes); }

}  // namespace grainsweep
