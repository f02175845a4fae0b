#include "runner/tables/named_lines.hpp"

#include <algorithm>
#include <cstddef>

#include "runner/sweep/text_lines.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// As columns that are empty in all lines would leave them.
std::string without_blanks_at_end(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

std::vector<std::size_t> widths_of(const std::vector<std::string>& heads,
                                   const std::vector<NamedLine>& lines) {
  std::vector<std::size_t> widths;
  for (std::size_t k = 0; k < heads.size(); ++k) {
    widths.push_back(characters(heads[k]));
    for (const NamedLine& line : lines) widths[k] = std::max(widths[k], characters(line.cells[k]));
  }
  return widths;
}

/// "4 periodic  0.61    5.5".
std::string joined(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
  std::string text = pad_right(cells[0], widths[0]);
  for (std::size_t k = 1; k < cells.size(); ++k) text += "  " + pad_left(cells[k], widths[k]);
  return text;
}

}  // namespace

std::string named_lines(const std::string& name_head, const std::vector<std::string>& heads,
                        const std::vector<NamedLine>& lines) {
  constexpr std::size_t longest_in_column = 17;
  std::size_t longest = 0;
  for (const NamedLine& line : lines) longest = std::max(longest, line.name.size());
  const bool has_column = longest > 0 && longest <= longest_in_column;
  const std::size_t width = std::max(longest, name_head.size()) + 2;
  const auto indent = [&](const std::string& name) {
    return has_column ? "  " + pad_right(name, width) : std::string("  ");
  };
  const std::vector<std::size_t> widths = widths_of(heads, lines);
  std::string text = without_blanks_at_end(indent(name_head) + joined(heads, widths)) + "\n";
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string& name = lines[k].name;
    const bool is_new = k == 0 || name != lines[k - 1].name;
    if (is_new && longest > longest_in_column) text += " " + name + "\n";
    text += without_blanks_at_end(indent(name) + joined(lines[k].cells, widths)) + "\n";
  }
  return text;
}

}  // namespace grainsweep
