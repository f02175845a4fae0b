#include <catch2/catch.hpp>

#include "runner/tables/named_lines.hpp"

namespace grainsweep {
namespace {

TEST_CASE("short names stand in a column as wide as the longest or its head") {
  CHECK(named_lines("label", {"packings"}, {{"a", {"3"}}, {"b", {"4"}}}) ==
        "  label  packings\n"
        "  a      3\n"
        "  b      4\n");
  CHECK(named_lines("", {"packings"}, {{"seventeen letters", {"3"}}}) ==
        "                     packings\n"
        "  seventeen letters  3\n");
}

TEST_CASE("long names stand once above the lines that they belong to") {
  CHECK(
      named_lines("label", {"packings"},
                  {{"no walls, 70 d high", {"3"}}, {"no walls, 70 d high", {"4"}}, {"b", {"5"}}}) ==
      "  packings\n"
      " no walls, 70 d high\n"
      "  3\n"
      "  4\n"
      " b\n"
      "  5\n");
}

TEST_CASE("lines without names have no column for them") {
  CHECK(named_lines("label", {"packings"}, {{"", {"3"}}, {"", {"4"}}}) ==
        "  packings\n"
        "  3\n"
        "  4\n");
}

TEST_CASE("columns are as wide as what is in them, and their ends are flush") {
  CHECK(named_lines(
            "", {"W/d", "    φ ± error", "n"},
            {{"", {"4", "0.59 ± 0.01", "2"}}, {"", {"12.345 periodic", "0.6 ± 0.000004", "12"}}}) ==
        "  W/d                   φ ± error   n\n"
        "  4                   0.59 ± 0.01   2\n"
        "  12.345 periodic  0.6 ± 0.000004  12\n");
}

TEST_CASE("no line ends in blanks, as of a column that is empty in all of them") {
  CHECK(named_lines("label", {"packings", "", ""}, {{"a", {"3", "", ""}}, {"b", {"", "", ""}}}) ==
        "  label  packings\n"
        "  a      3\n"
        "  b\n");
}

}  // namespace
}  // namespace grainsweep
