#include <catch2/catch.hpp>

#include "runner/sweep/json_text.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

/// The one error that strict reading finds in `text`.
std::string error_in(const std::string& text) {
  const JsonReading reading = parse_strictly(text, "f");
  REQUIRE(reading.errors.size() == 1);
  return to_string(reading.errors.front());
}

/// Offset of the value at `pointer` in a text of one line, or of its key.
std::size_t offset_of(const std::string& text, const std::string& pointer,
                      Anchor anchor = Anchor::value) {
  Diagnostics diagnostics = {{pointer, "", anchor}};
  locate(parse_strictly(text, "f"), text, "f", diagnostics);
  return std::stoul(diagnostics.at(0).place.substr(std::string("f:1:").size())) - 1;
}

}  // namespace

TEST_CASE("valid JSON is read with its keys in the order of the file") {
  const JsonReading reading = parse_strictly(R"({"b": 1, "a": [true, null, "x"]})", "f");
  REQUIRE(reading.errors.empty());
  CHECK(reading.value.dump() == R"({"b":1,"a":[true,null,"x"]})");
}

TEST_CASE("a byte order mark is skipped") {
  const JsonReading reading = parse_strictly("\xEF\xBB\xBF{\"a\": 1}", "f");
  REQUIRE(reading.errors.empty());
  CHECK(reading.value.at("a") == 1);
}

TEST_CASE("a zero byte is refused where it stands: parsers take it for the end") {
  using namespace std::string_literals;
  CHECK(error_in("{}\n\0 }}"s) == "f:2:1: a byte is zero: this is no text, or the file is damaged");
}

TEST_CASE("the deepest allowed nesting is read and one level more is refused at its bracket") {
  const std::string open(deepest_json, '['), close(deepest_json, ']');
  CHECK(parse_strictly(open + close, "f").errors.empty());
  CHECK(error_in(open + "[" + "]" + close) == "f:1:33: is nested deeper than 32 levels");
}

TEST_CASE("a million brackets are refused cleanly, closed or not, lists or objects") {
  const std::string message = "is nested deeper than 32 levels";
  CHECK(error_in(std::string(1'000'000, '[')) == "f:1:33: " + message);
  CHECK(error_in(std::string(1'000'000, '[') + std::string(1'000'000, ']')) ==
        "f:1:33: " + message);
  std::string objects;
  for (int i = 0; i < 1'000'000; ++i) objects += "{\"a\":";
  CHECK(error_in(objects) == "f:1:161: " + message);
}

TEST_CASE("brackets and quotes inside strings are no nesting") {
  const std::string text = "[\"" + std::string(100, '[') + "\\\"" + std::string(100, '{') + "\"]";
  CHECK(parse_strictly(text, "f").errors.empty());
}

TEST_CASE("equal keys in one object are refused, each with the place of the first") {
  const JsonReading reading =
      parse_strictly("{\"a\": 1,\n \"b\": {\"c\": 1, \"c\": 2},\n \"a\": 3}", "f");
  REQUIRE(reading.errors.size() == 2);
  CHECK(to_string(reading.errors[0]) ==
        "f:2:16 /b/c: the same key is already written at 2:8; keep one of them");
  CHECK(to_string(reading.errors[1]) ==
        "f:3:2 /a: the same key is already written at 1:2; keep one of them");
}

TEST_CASE("keys that are equal only after unescaping are equal") {
  CHECK(error_in(R"({"ab": 1, "\u0061b": 2})") ==
        "f:1:11 /ab: the same key is already written at 1:2; keep one of them");
}

TEST_CASE("equal keys in different objects are fine") {
  CHECK(parse_strictly(R"({"a": {"x": 1}, "b": {"x": 1}, "c": [{"x": 1}, {"x": 1}]})", "f")
            .errors.empty());
}

TEST_CASE("the place of every value of a text is known") {
  const std::string text = R"( {"a": [10, {"b": "x]}"}, []], "c": {} , "d":null, "e": -1.5e3})";
  CHECK(parse_strictly(text, "f").places.size() == 9);
  const auto starts_with = [&](const std::string& pointer, const std::string& start) {
    INFO(pointer);
    CHECK(text.compare(offset_of(text, pointer), start.size(), start) == 0);
  };
  starts_with("", "{\"a\"");
  starts_with("/a", "[10");
  starts_with("/a/0", "10");
  starts_with("/a/1", "{\"b\"");
  starts_with("/a/1/b", "\"x]}\"");
  starts_with("/a/2", "[]");
  starts_with("/c", "{}");
  starts_with("/d", "null");
  starts_with("/e", "-1.5e3");
  CHECK(text.compare(offset_of(text, "/d", Anchor::key), 3, "\"d\"") == 0);
  CHECK(offset_of(text, "/a/0", Anchor::key) == offset_of(text, "/a/0"));
}

TEST_CASE("keys with slashes, tildes and escapes are found by their pointers") {
  const std::string text = R"({"a/b": 1, "c~d": 2, "q\"\u0065": 3})";
  CHECK(text[offset_of(text, "/a~1b")] == '1');
  CHECK(text[offset_of(text, "/c~0d")] == '2');
  CHECK(text[offset_of(text, "/q\"e")] == '3');
}

TEST_CASE("a pointer that is not there has the place of the nearest part that is") {
  const std::string text = R"({"a": [1, 2], "b": 3})";
  for (const std::string pointer : {"/a/2", "/a/x", "/a/0/y", "/b/c", "/none"}) {
    INFO(pointer);
    CHECK(offset_of(text, pointer) == offset_of(text, pointer.substr(0, pointer.rfind('/'))));
  }
}

TEST_CASE("a text that is one scalar has one place") {
  CHECK(offset_of("  42 ", "") == 2);
  CHECK(parse_strictly("\"x\"", "f").places.size() == 1);
}

TEST_CASE("diagnostics come in the order of the text, each once") {
  const std::string text = "{\"a\": 1,\n \"b\": [2]}";
  const JsonReading reading = parse_strictly(text, "f");
  Diagnostics diagnostics = {{"/b/0", "late"},
                             {"/b", "at its key", Anchor::key},
                             {"/a", "elsewhere", Anchor::value, "bed.csv:3"},
                             {"/b/0", "late"},
                             {"", "missing"}};
  locate(reading, text, "f", diagnostics);
  std::vector<std::string> texts;
  for (const Diagnostic& diagnostic : diagnostics) texts.push_back(to_string(diagnostic));
  CHECK(texts == std::vector<std::string>{"f:1:1: missing", "bed.csv:3: elsewhere",
                                          "f:2:2 /b: at its key", "f:2:8 /b/0: late"});
}

}  // namespace grainsweep
