#include "runner/tables/named_lines.hpp"

#include <algorithm>
#include <cstddef>

#include "runner/text.hpp"

namespace grainsweep {

std::string named_lines(const std::string& name_head, const std::string& heads,
                        const std::vector<NamedLine>& lines) {
  constexpr std::size_t longest_in_column = 17;
  std::size_t longest = 0;
  for (const NamedLine& line : lines) longest = std::max(longest, line.name.size());
  const bool has_column = longest > 0 && longest <= longest_in_column;
  const std::size_t width = std::max(longest, name_head.size()) + 2;
  const auto indent = [&](const std::string& name) {
    return has_column ? "  " + pad_right(name, width) : std::string("  ");
  };
  std::string text = indent(name_head) + heads + "\n";
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string& name = lines[k].name;
    const bool is_new = k == 0 || name != lines[k - 1].name;
    if (is_new && longest > longest_in_column) text += " " + name + "\n";
    text += indent(name) + lines[k].cells + "\n";
  }
  return text;
}

}  // namespace grainsweep
