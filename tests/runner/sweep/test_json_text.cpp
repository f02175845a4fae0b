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

TEST_CASE("NaN and Infinity are refused with a hint, at their first letter") {
  const std::string hint = ": JSON has no NaN and no Infinity; write a finite number";
  CHECK(error_in(R"({"a": NaN})") == "f:1:7" + hint);
  CHECK(error_in("{\"a\": 1,\n \"b\": [1, nan]}") == "f:2:11" + hint);
  CHECK(error_in(R"({"a": -Infinity})") == "f:1:7" + hint);
  CHECK(error_in(R"([inf])") == "f:1:2" + hint);
}

TEST_CASE("words that only begin like NaN or Infinity get the plain message") {
  CHECK(error_in(R"({"a": information})") == "f:1:7: malformed JSON: invalid literal");
  CHECK(error_in(R"({"a": name})") == "f:1:7: malformed JSON: invalid literal");
}

TEST_CASE("malformed JSON is refused with line, column and what to change") {
  CHECK(error_in(R"({"a": 1,})") == "f:1:9: remove the comma before this '}'");
  CHECK(error_in("[1,\n2,\n]") == "f:3:1: remove the comma before this ']'");
  CHECK(error_in("{'a': 1}") == "f:1:2: a string needs double quotes");
  CHECK(error_in("{} // why") == "f:1:4: JSON has no comments; remove it");
  CHECK(error_in("# why\n{}") == "f:1:1: JSON has no comments; remove it");
  CHECK(error_in(R"({"a": 1 "b": 2})") ==
        "f:1:11: malformed JSON: unexpected string literal; expected '}'");
  CHECK(error_in(R"({"a" 5})") == "f:1:6: malformed JSON: unexpected number literal; expected ':'");
  CHECK(error_in("{}}") == "f:1:3: malformed JSON: unexpected '}'; expected end of input");
}

TEST_CASE("a text that ends too early is refused at its end") {
  const std::string message = ": the file ends too early: a bracket or a quote is not closed";
  CHECK(error_in("{\"a\": [1") == "f:1:9" + message);
  CHECK(error_in("{\"a\": \"x") == "f:1:9" + message);
}

TEST_CASE("numbers beyond 64-bit floats are refused at their first digit") {
  CHECK(error_in(R"({"a": 1e999})") == "f:1:7: this number is too large for a 64-bit float");
}

TEST_CASE("text that is not UTF-8 is refused") {
  CHECK(error_in("{\"a\": \"\xFF\"}") == "f:1:8: is not UTF-8 text here; save the file as UTF-8");
  CHECK(error_in("\xFF\xFE{") == "f:1:1: is UTF-16 text; save the file as UTF-8");
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

TEST_CASE("files that hold no text are refused by name") {
  const ScratchFolder folder;
  const auto error = [&](const std::string& path) {
    const FileText file = read_text(path);
    REQUIRE(file.errors.size() == 1);
    CHECK(file.text.empty());
    return folder.without_folder(to_string(file.errors.front()));
  };
  CHECK(error(folder.path("none.json")) == "none.json: cannot be read: No such file or directory");
  CHECK(error(folder.write("empty.json", "")) == "empty.json: is empty");
  CHECK(error(folder.write("blank.json", " \n\t\r\n")) == "blank.json: is empty");
  std::filesystem::create_directory(folder.path("sub"));
  CHECK(error(folder.path("sub")) == "sub: is a folder, not a file");
}

}  // namespace grainsweep
