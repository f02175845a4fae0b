#include <cmath>

#include <catch2/catch.hpp>

#include "runner/text.hpp"

namespace grainsweep {
namespace {

TEST_CASE("padding counts characters, not bytes") {
  CHECK(pad_left("φ", 3) == "  φ");
  CHECK(pad_right("±", 3) == "±  ");
  CHECK(pad_left("long", 2) == "long");
}

TEST_CASE("words are filled into lines that are not too long") {
  CHECK(filled_lines("one two\nthree φφφ", 9) == "one two\nthree φφφ");
  CHECK(filled_lines("one two three", 8) == "one two\nthree");
  CHECK(filled_lines("longer than", 3) == "longer\nthan");
  CHECK(filled_lines("", 3).empty());
}

TEST_CASE("durations read as people say them") {
  CHECK(duration_text(0.723) == "0.72 s");
  CHECK(duration_text(41.23) == "41.2 s");
  CHECK(duration_text(59.7) == "1 min 0 s");
  CHECK(duration_text(725) == "12 min 5 s");
  CHECK(duration_text(12000) == "3 h 20 min");
  CHECK(fixed(std::nan(""), 2) == "-");
}

TEST_CASE("sizes of files are in kB where they would be nothing in MB") {
  CHECK(size_text(12) == "1 kB");
  CHECK(size_text(26'400) == "26 kB");
  CHECK(size_text(999'400) == "999 kB");
  CHECK(size_text(999'600) == "1.0 MB");
  CHECK(size_text(12'340'000) == "12.3 MB");
}

TEST_CASE("an error is printed to the decimals asked for, or as many more as show it") {
  CHECK(with_error(0.639, 0.0012, 4) == "0.6390 ± 0.0012");
  CHECK(with_error(0.92, 0.0046, 2) == "0.920 ± 0.005");
  CHECK(with_error(0.92, 0.005, 2) == "0.92 ± 0.01");
  CHECK(with_error(0.92, 0.0, 2) == "0.92 ± 0.00");
  CHECK(with_error(0.5, 1e-12, 2) == "0.500000 ± 0.000000");
  CHECK(with_error(0.5, 1e-13, 2) == "0.50 ± 0.00");  // of values that are the same to rounding
  CHECK(with_error(0.5, std::nan(""), 2) == "0.50");
  CHECK(with_error(std::nan(""), 0.1, 2).starts_with("-"));
}

TEST_CASE("words of printed commands are quoted where a shell needs it") {
  CHECK(shell_word("configs/quick.json") == "configs/quick.json");
  CHECK(shell_word("a b") == "'a b'");
  CHECK(shell_word("") == "''");
  CHECK(shell_word("d'Or") == "'d'\\''Or'");
  CHECK(shell_word("größe") == "'größe'");
  CHECK(shell_word("$HOME") == "'$HOME'");
}

TEST_CASE("what may be any size is short") {
  CHECK(fixed_or_power(1.5, 2) == "1.50");
  CHECK(fixed_or_power(9999.0, 1) == "9999.0");
  CHECK(fixed_or_power(23730104.55, 2) == "2.4e+07");
}

}  // namespace
}  // namespace grainsweep
