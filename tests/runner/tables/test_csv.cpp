#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <catch2/catch.hpp>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

TEST_CASE("numbers are written in the shortest form that reads back exactly") {
  CHECK(cell(0.1) == "0.1");
  CHECK(cell(20.0) == "20");
  CHECK(cell(1.0 / 3.0) == "0.3333333333333333");
  CHECK(cell(1e-4) == "1e-04");
  CHECK(cell(0.1 + 0.2) == "0.30000000000000004");
  CHECK(cell(std::numeric_limits<std::uint64_t>::max()) == "18446744073709551615");
  CHECK(cell(-3) == "-3");
  for (const double value : {std::nextafter(0.64, 1.0), 5e-324, 1.7976931348623157e308}) {
    CHECK(std::strtod(cell(value).c_str(), nullptr) == value);
  }
}

TEST_CASE("edges of bins have no noise of rounding") {
  CHECK(cell(6 * 0.1) == "0.6000000000000001");
  CHECK(short_cell(6 * 0.1) == "0.6");
  CHECK(short_cell(12.5 - (12.4 + 12.5) / 2) == "0.05");
  CHECK(short_cell(1.0 / 3.0) == "0.333333333333");
  CHECK(short_cell(0.0) == "0");
  CHECK(short_cell(-20.0) == "-20");
  CHECK(short_cell(std::nan("")).empty());
}

TEST_CASE("what is no number leaves its cell empty") {
  CHECK(cell(std::nan("")).empty());
  CHECK(cell(std::numeric_limits<double>::infinity()).empty());
}

TEST_CASE("text is quoted only where it must be") {
  CHECK(cell("MSP bulk") == "MSP bulk");
  CHECK(cell("a,b") == "\"a,b\"");
  CHECK(cell("say \"no\"") == "\"say \"\"no\"\"\"");
  CHECK(cell("two\nlines") == "\"two\nlines\"");
}

TEST_CASE("a line joins its cells by commas") {
  CHECK(csv_line({"a", "", "c"}) == "a,,c\n");
  CHECK(csv_line({"a"}) == "a\n");
}

TEST_CASE("numbers with more digits than people write are short where people read them") {
  CHECK(with_readable_numbers("0.03333333333333333") == "0.03333");
  CHECK(with_readable_numbers("0.160044") == "0.160044");
  CHECK(with_readable_numbers("[0.6666666666666666,1,1.3333333333333333]") == "[0.6667,1,1.333]");
  CHECK(with_readable_numbers("[\"0.123456789.csv\"]") == "[\"0.123456789.csv\"]");
  CHECK(with_readable_numbers("0.123456789.csv") == "0.123456789.csv");
  CHECK(with_readable_numbers("1e-12") == "1e-12");
  CHECK(with_readable_numbers("").empty());
}

}  // namespace
}  // namespace grainsweep
