#include <catch2/catch.hpp>

#include "runner/sweep/json_text.hpp"

namespace grainsweep {
namespace {

/// The one error that strict reading finds in `text`.
std::string message_about(const std::string& text) {
  const JsonReading reading = parse_strictly(text, "f");
  REQUIRE(reading.errors.size() == 1);
  return to_string(reading.errors.front());
}

}  // namespace

TEST_CASE("NaN and Infinity are refused with a hint, at their first letter") {
  const std::string hint = ": JSON has no NaN and no Infinity; write a finite number";
  CHECK(message_about(R"({"a": NaN})") == "f:1:7" + hint);
  CHECK(message_about("{\"a\": 1,\n \"b\": [1, nan]}") == "f:2:11" + hint);
  CHECK(message_about(R"({"a": -Infinity})") == "f:1:7" + hint);
  CHECK(message_about(R"([inf])") == "f:1:2" + hint);
}

TEST_CASE("words without quotes are told to need them, also those that begin like NaN") {
  const std::string need = "names and texts need double quotes: ";
  CHECK(message_about(R"({"a": information})") == "f:1:7: " + need + "\"information\"");
  CHECK(message_about(R"({"a": name})") == "f:1:7: " + need + "\"name\"");
  CHECK(message_about(R"({"a": True})") == "f:1:7: " + need + "\"True\"");
  CHECK(message_about(R"({"base": {box.width: 5}})") == "f:1:11: " + need + "\"box.width\"");
}

TEST_CASE("what people and word processors write is told with what JSON wants") {
  const std::string quotes = "a text needs straight double quotes: \"";
  CHECK(message_about("{\u201cname\u201d: 1}") == "f:1:2: " + quotes);
  CHECK(message_about("{\"a\": \u00abb\u00bb}") == "f:1:7: " + quotes);
  const std::string unit = "a number has no unit here: see \"units\" in the manual of sweeps";
  CHECK(message_about(R"({"a": 5 mm})") == "f:1:9: " + unit);
  CHECK(message_about(R"({"a": 5mm})") == "f:1:7: " + unit);
  CHECK(message_about(R"({"a": 1/2})") == "f:1:8: JSON has no fractions: write 1/2 as 0.5");
  CHECK(message_about(R"({"a": 5%})") == "f:1:8: JSON has no %: write 5 % as 0.05");
  CHECK(message_about(R"({"a": 5; "b": 1})") == "f:1:8: write a comma in place of ;");
  CHECK(message_about(R"({"a": "C:\data"})") ==
        "f:1:11: a backslash is written as two; names of files may have / in its place");
}

TEST_CASE("malformed JSON is refused with line, column and what to change") {
  CHECK(message_about(R"({"a": 1,})") == "f:1:9: remove the comma before this '}'");
  CHECK(message_about("[1,\n2,\n]") == "f:3:1: remove the comma before this ']'");
  CHECK(message_about("{'a': 1}") == "f:1:2: a string needs double quotes");
  CHECK(message_about("{} // why") == "f:1:4: JSON has no comments; remove it");
  CHECK(message_about("# why\n{}") == "f:1:1: JSON has no comments; remove it");
  CHECK(message_about(R"({"a" 5})") ==
        "f:1:6: malformed JSON: unexpected number literal; expected ':'");
  CHECK(message_about("{}}") == "f:1:3: the sweep has ended before this; remove it");
  CHECK(message_about(R"({"a": "}"} more)") ==
        "f:1:12: the sweep has ended before this; remove it");
}

TEST_CASE("a text that ends too early is refused at its end") {
  const std::string message = ": the file ends too early: a bracket or a quote is not closed";
  CHECK(message_about("{\"a\": [1") == "f:1:9" + message);
  CHECK(message_about("{\"a\": \"x") == "f:1:9" + message);
}

TEST_CASE("numbers beyond 64-bit floats are refused at their first digit") {
  CHECK(message_about(R"({"a": 1e999})") == "f:1:7: this number is too large for a 64-bit float");
}

TEST_CASE("text that is not UTF-8 is refused") {
  CHECK(message_about("{\"a\": \"\xFF\"}") ==
        "f:1:8: is not UTF-8 text here; save the file as UTF-8");
  CHECK(message_about("\xFF\xFE{") == "f:1:1: is UTF-16 text; save the file as UTF-8");
}

TEST_CASE("a missing comma is named where it is missing") {
  CHECK(message_about(R"({"a": 1 "b": 2})") == "f:1:8: a comma is missing after 1");
  CHECK(message_about("{\"a\": \"x\"\n \"b\": 2}") == "f:1:10: a comma is missing after \"x\"");
  CHECK(message_about("[[1] [2]]") == "f:1:5: a comma is missing after ]");
  CHECK(message_about("[1.5\n-2]") == "f:1:5: a comma is missing after 1.5");
  CHECK(message_about("{\"a\": {} \"b\": 1}") == "f:1:9: a comma is missing after }");
  CHECK(message_about("[true false]") == "f:1:6: a comma is missing after true");
}

TEST_CASE("numbers as other languages write them are shown as JSON writes them") {
  CHECK(message_about(R"({"a": 9,95})") ==
        "f:1:9: a number has a decimal point, not a comma: write 9.95");
  CHECK(message_about(R"({"a": .95})") == "f:1:7: write this number as 0.95");
  CHECK(message_about(R"({"a": -.5})") == "f:1:7: write this number as -0.5");
  CHECK(message_about(R"({"a": +3})") == "f:1:7: write this number as 3");
  CHECK(message_about(R"({"a": 5.})") == "f:1:7: write this number as 5.0");
  CHECK(message_about(R"({"a": 007})") == "f:1:7: a number must not begin with 0");
}

}  // namespace grainsweep
