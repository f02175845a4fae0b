#include <catch2/catch.hpp>

#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

using Lines = std::vector<std::string_view>;

TEST_CASE("a text has the lines between its line feeds, without blank ones at the end") {
  CHECK(lines_of("a\nb\n\nc\n\n \n") == Lines{"a", "b", "", "c"});
  CHECK(lines_of("\xEF\xBB\xBFx,y") == Lines{"x,y"});
  CHECK(lines_of("") == Lines{""});
}

TEST_CASE("blanks around words are dropped") {
  CHECK(trimmed(" \ta b\r") == "a b");
  CHECK(trimmed(" \t").empty());
}

TEST_CASE("only whole finite numbers with a decimal point are numbers") {
  CHECK(finite_number("-1.5e3") == -1500.0);
  CHECK(finite_number(".5") == 0.5);
  for (const char* text : {"", "1,5", "1.5x", "nan", "inf", "1e999", " 1"}) {
    INFO(text);
    CHECK_FALSE(finite_number(text));
  }
}

}  // namespace
}  // namespace grainsweep
