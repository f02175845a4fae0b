#include "runner/sweep/grains_csv.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <string_view>
#include <tuple>

#include "runner/hash.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

constexpr std::array<std::string_view, 8> column_names = {"x",  "y",  "z",  "r",
                                                          "qx", "qy", "qz", "qw"};
constexpr std::size_t needed = 4;  ///< the others are there all or not at all

constexpr std::string_view component_name = "component", size_class_name = "size_class";

/// Where the columns are.
struct Columns {
  std::vector<std::size_t> numbers;  ///< of column_names, or of the needed ones only
  std::optional<std::size_t> component, size_class;  ///< if there is one
};

bool is_orientation(std::string_view name) { return name.front() == 'q'; }

std::string header_error(std::string_view name, const LineCells& header) {
  std::string found;
  for (const std::string_view cell : header) found.append(found.empty() ? "" : ",").append(cell);
  return "the first line must name the columns x,y,z,r" +
         std::string(is_orientation(name) ? " and all of qx,qy,qz,qw" : "") + "; \"" +
         std::string(name) + "\" is missing or there twice in \"" + shortened(found) + "\"" +
         separator_hint(found);
}

bool holds(const LineCells& header, std::string_view name) {
  return std::find(header.begin(), header.end(), name) != header.end();
}

/// Where a column is that files need not have.
std::optional<std::size_t> place_of(std::string_view name, const LineCells& header) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.begin());
}

/// The columns that `header` names, or what is wrong with it.
std::optional<Columns> columns_of(const LineCells& header, std::string& error) {
  Columns columns;
  const bool are_turned = std::any_of(column_names.begin() + needed, column_names.end(),
                                      [&](std::string_view name) { return holds(header, name); });
  for (std::size_t i = 0; i < (are_turned ? column_names.size() : needed); ++i) {
    const auto matches = [&](std::string_view cell) {
      return cell == column_names[i] || (column_names[i] == "r" && cell == "radius");
    };
    if (std::count_if(header.begin(), header.end(), matches) != 1) {
      error = header_error(column_names[i], header);
      return std::nullopt;
    }
    const auto found = std::find_if(header.begin(), header.end(), matches);
    columns.numbers.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  columns.component = place_of(component_name, header);
  columns.size_class = place_of(size_class_name, header);
  return columns;
}

/// The component in a cell, from 1 there and from 0 here. A cell without one is left to those that
/// need it: the file of grains that are no mixture may hold anything there.
std::uint8_t component_in(std::string_view cell) {
  const auto number = finite_number(cell);
  for (std::uint8_t k = 0; number && k < most_components; ++k) {
    if (*number == k + 1.0) return k;
  }
  return no_component;
}

/// What is wrong with a line; otherwise the grain in it is added.
std::string read_grain(const LineCells& cells, const Columns& columns, std::size_t width,
                       GrainsReading& reading) {
  if (cells.size() != width) return wrong_width(cells.size(), width);
  std::array<double, column_names.size()> v{};
  for (std::size_t i = 0; i < columns.numbers.size(); ++i) {
    const std::string_view cell = cells[columns.numbers[i]];
    const auto value = finite_number(cell);
    if (!value) {
      return std::string(column_names[i]) + " must be a finite number, is \"" + shortened(cell) +
             "\"";
    }
    v[i] = *value + 0.0;  // -0 is 0
  }
  if (!(v[3] > 0.0)) return "r must be positive, is " + std::string(cells[columns.numbers[3]]);
  reading.grains.push_back({v[0], v[1], v[2], v[3]});
  if (columns.numbers.size() > needed) reading.orientations.push_back({v[4], v[5], v[6], v[7]});
  if (columns.component) reading.components.push_back(component_in(cells[*columns.component]));
  if (columns.size_class) reading.are_small.push_back(cells[*columns.size_class] == "small");
  return "";
}

/// Notes grains that start at the place of another, and would stay there: no direction parts them.
void note_shared_places(const std::string& file, GrainsReading& reading) {
  std::vector<std::size_t> order(reading.grains.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t grain) {
    const PlacedSphere& at = reading.grains[grain];
    return std::tuple(at.x, at.y, at.z);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  for (std::size_t k = 1; k < order.size() && reading.errors.size() < most_wrong_lines; ++k) {
    if (place(order[k - 1]) != place(order[k])) continue;
    constexpr std::size_t first_line = 2;  // below the names of the columns
    note_wrong_line(reading.errors, file, order[k] + first_line,
                    "has the place of line " + std::to_string(order[k - 1] + first_line) +
                        "; two grains cannot begin in one");
  }
}

}  // namespace

GrainsReading parse_grains(const std::string& text, const std::string& file) {
  GrainsReading reading;
  reading.content = hex16(mixed(fnv1a(text)));
  const auto lines = lines_of(text);
  const LineCells header = cells_of(lines.front());
  std::string error;
  const auto columns = columns_of(header, error);
  if (!columns) {
    reading.errors.push_back(wrong_line(file, 1, error));
    return reading;
  }
  if (lines.size() == 1) {
    reading.errors.push_back(wrong_line(file, 1, "no grain follows the first line"));
  }
  for (std::size_t i = 1; i < lines.size() && reading.errors.size() < most_wrong_lines; ++i) {
    error = read_grain(cells_of(lines[i]), *columns, header.size(), reading);
    if (!error.empty()) note_wrong_line(reading.errors, file, i + 1, error);
  }
  if (reading.errors.empty()) note_shared_places(file, reading);
  return reading;
}

GrainsReading read_grains(const std::string& path) { return read_parsed(path, parse_grains); }

std::vector<PlacedSphere> scaled_grains(std::vector<PlacedSphere> grains, double diameter) {
  for (PlacedSphere& grain : grains) {
    grain = {grain.x / diameter, grain.y / diameter, grain.z / diameter, grain.radius / diameter};
  }
  return grains;
}

}  // namespace grainsweep
