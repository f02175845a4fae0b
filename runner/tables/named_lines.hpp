// Tables for people whose lines have names.
#pragma once

#include <string>
#include <vector>

namespace grainsweep {

/// A line of a table, without its end, and what it is called.
struct NamedLine {
  std::string name;
  std::string cells;
};

/// The lines below the heads of their columns; `name_head` heads the names. Names stand in a column
/// of their own or, where they are long, above the lines that they belong to.
std::string named_lines(const std::string& name_head, const std::string& heads,
                        const std::vector<NamedLine>& lines);

}  // namespace grainsweep
