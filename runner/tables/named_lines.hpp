// Tables for people whose lines have names.
#pragma once

#include <string>
#include <vector>

namespace grainsweep {

/// A line of a table and what it is called.
struct NamedLine {
  std::string name;
  std::vector<std::string> cells;
};

/// The lines below the heads of their columns; `name_head` heads the names. Names stand in a column
/// of their own or, where they are long, above the lines that they belong to. Columns are as wide
/// as the longest of their cells and their head with its blanks; but for the first they end
/// flush.
std::string named_lines(const std::string& name_head, const std::vector<std::string>& heads,
                        const std::vector<NamedLine>& lines);

}  // namespace grainsweep
