#include <catch2/catch.hpp>

#include "runner/sweep/sizes_csv.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

using Messages = std::vector<std::string>;

Messages errors_of_table(const std::string& text) {
  Messages errors;
  for (const Diagnostic& diagnostic : parse_sizes(text, "sieves.csv").errors) {
    errors.push_back(to_string(diagnostic));
  }
  return errors;
}

TEST_CASE("a sieve curve is read from its columns in any order of columns and rows") {
  const SizesReading reading = parse_sizes(
      "sieve, passing ,diameter\r\nd,1,4\r\n\"c\",0.5,2\na,0,\"0.5\"\n\n", "sieves.csv");
  REQUIRE(reading.errors.empty());
  CHECK(reading.table.diameters == std::vector<double>{0.5, 2, 4});
  CHECK(reading.table.passing == std::vector<double>{0, 0.5, 1});
  CHECK(reading.table.shares.empty());
}

TEST_CASE("the columns of a sieve curve may be named in capitals") {
  const SizesReading reading = parse_sizes("Diameter, PASSING\n1,0\n2,1\n", "sieves.csv");
  REQUIRE(reading.errors.empty());
  CHECK(reading.table.passing == std::vector<double>{0, 1});
  CHECK(parse_sizes("Diameter,diameter,passing\n1,1,0\n", "sieves.csv").errors.size() == 1);
}

TEST_CASE("shares of single diameters are read as such") {
  const SizesReading reading = parse_sizes("diameter,share\n1,0.3\n2,0.7\n", "sieves.csv");
  REQUIRE(reading.errors.empty());
  CHECK(reading.table.shares == std::vector<double>{0.3, 0.7});
  CHECK(reading.table.passing.empty());
}

TEST_CASE("what sieves retain, in any unit, is what passes the next ones") {
  for (const char* text : {"diameter,retained\n8,0\n4,30\n2,50\n1,20\n",
                           "diameter,retained\n1,0.1\n2,0.25\n4,0.15\n8,0\n"}) {
    const SizesReading reading = parse_sizes(text, "sieves.csv");
    REQUIRE(reading.errors.empty());
    CHECK(reading.table.diameters == std::vector<double>{1, 2, 4, 8});
    CHECK(reading.table.passing == std::vector<double>{0, 0.2, 0.7, 1});
    CHECK(reading.table.shares.empty());
  }
  const auto odd = parse_sizes("diameter,retained\n1,0.1\n2,0.2\n3,0.3\n4,0\n5,0\n", "sieves.csv");
  CHECK(odd.table.passing.at(3) == 1.0);
  CHECK(odd.table.passing.at(4) == 1.0);
  CHECK(errors_of_table("diameter,retained\n1,60\n2,40\n") ==
        Messages{"sieves.csv:3: the largest sieve must retain 0, retains 40: add the next larger "
                 "one, which no grain stays on"});
  CHECK(errors_of_table("diameter,retained\n1,0\n2,0\n") ==
        Messages{"sieves.csv:3: no sieve retains anything"});
  CHECK(errors_of_table("diameter,retained\n1,-3\n2,0\n") ==
        Messages{"sieves.csv:2: retained must not be negative, is -3"});
  CHECK(errors_of_table("diameter,retained\n0,3\n2,0\n") ==
        Messages{"sieves.csv:2: the diameter must be positive, is 0; give the pan the smallest "
                 "size of its grains"});
  CHECK(errors_of_table("diameter,retained\n1,1e308\n2,1e308\n3,0\n") ==
        Messages{"sieves.csv:4: what the sieves retain adds up to too much"});
}

TEST_CASE("what a table of sizes lacks is told with its line") {
  const std::string wanted =
      "sieves.csv:1: the first line must name the columns diameter and one of passing, retained "
      "and share, each once; is ";
  CHECK(errors_of_table("d,passing\n1,0\n") == Messages{wanted + "\"d,passing\""});
  CHECK(errors_of_table("d,passing\r\n1,0\r\n") == Messages{wanted + "\"d,passing\""});
  CHECK(errors_of_table("diameter,passing,share\n") ==
        Messages{wanted + "\"diameter,passing,share\""});
  CHECK(errors_of_table("diameter,passing,passing\n1,0,0\n") ==
        Messages{wanted + "\"diameter,passing,passing\""});
  CHECK(errors_of_table("diameter,passing\n2,0\n4,0,3\n8,1\n") ==  // a decimal comma
        Messages{"sieves.csv:3: must hold 2 values like the first line, holds 3"});
  CHECK(errors_of_table("diameter,share\n") ==
        Messages{"sieves.csv:1: no row follows the first line"});
  CHECK(errors_of_table("diameter,share\n1\n2,x\nnan,1\n3,1\n") ==
        Messages{"sieves.csv:2: must hold 2 values like the first line, holds 1",
                 "sieves.csv:3: must hold finite numbers, holds \"x\"",
                 "sieves.csv:4: must hold finite numbers, holds \"nan\""});
  std::string wrong = "diameter,share\n";
  for (int k = 0; k < 50; ++k) wrong += "x,1\n";
  CHECK(errors_of_table(wrong).size() == 20);
  CHECK(read_sizes("/nowhere/sieves.csv").errors.size() == 1);
}

TEST_CASE("what is no curve of sizes is told with the line that makes it none") {
  CHECK(errors_of_table("diameter,passing\n-1,0\n0,-0.5\n4,-1\n8,1\n") ==
        Messages{"sieves.csv:2: the diameter must be positive, is -1",
                 "sieves.csv:3: the diameter must be positive, is 0",
                 "sieves.csv:4: passing must not be negative, is -1"});
  CHECK(errors_of_table("diameter,share\n1,-0.5\n") ==
        Messages{"sieves.csv:2: the share must not be negative, is -0.5"});
  CHECK(errors_of_table("diameter,passing\n2,0\n4,1\n2,0\n4,1\n") ==
        Messages{"sieves.csv:4: repeats the diameter 2 of line 2",
                 "sieves.csv:5: repeats the diameter 4 of line 3"});
  const std::string rule = " passing must rise from 0 to 1, the share finer than each diameter; ";
  CHECK(errors_of_table("diameter,passing\n8,100\n4,30\n2,0\n") ==
        Messages{"sieves.csv:2:" + rule + "ends at 100: divide percentages by 100"});
  CHECK(errors_of_table("diameter,passing\n2,1\n4,0.3\n8,0\n") ==
        Messages{"sieves.csv:3:" + rule + "falls to 0.3 from 1 in line 2"});
  CHECK(errors_of_table("diameter,passing\n8,1\n4,0.3\n") ==
        Messages{"sieves.csv:3:" + rule +
                 "begins at 0.3: add the largest diameter that nothing is finer than"});
  CHECK(errors_of_table("diameter,passing\n2,0\n4,0.3\n") ==
        Messages{"sieves.csv:3:" + rule + "ends at 0.3: add a diameter that all is finer than"});
  CHECK(errors_of_table("diameter,passing\n2,0\n4,0.5\n6,0.5\n8,1\n").empty());
  CHECK(errors_of_table("diameter,share\n2,30\n4,70\n") ==
        Messages{"sieves.csv:1: the numbers of column share must add up to 1, add up to 100: "
                 "divide percentages by 100"});
}

}  // namespace
}  // namespace grainsweep
