#include <map>

#include <catch2/catch.hpp>

#include "runner/sweep/json_places.hpp"

namespace grainsweep {
namespace {

struct Offsets {
  std::size_t key, value;
};

std::map<std::string, Offsets> places_in(const std::string& text) {
  std::map<std::string, Offsets> places;
  for_each_value(text, [&](const JsonPlace& place) {
    places[place.pointer] = {place.key, place.value};
  });
  return places;
}

}  // namespace

TEST_CASE("every value of a text is visited with its pointer and offsets") {
  const std::string text = R"( {"a": [10, {"b": "x]}"}, []], "c": {} , "d":null})";
  const auto places = places_in(text);
  REQUIRE(places.size() == 8);
  const auto value_starts_with = [&](const std::string& pointer, const std::string& start) {
    CHECK(text.compare(places.at(pointer).value, start.size(), start) == 0);
  };
  value_starts_with("", "{\"a\"");
  value_starts_with("/a", "[10");
  value_starts_with("/a/0", "10");
  value_starts_with("/a/1", "{\"b\"");
  value_starts_with("/a/1/b", "\"x]}\"");
  value_starts_with("/a/2", "[]");
  value_starts_with("/c", "{}");
  value_starts_with("/d", "null");
  CHECK(text.compare(places.at("/d").key, 3, "\"d\"") == 0);
}

TEST_CASE("keys with slashes, tildes and escapes become proper pointers") {
  const auto places = places_in(R"({"a/b": 1, "c~d": 2, "q\"\u0065": 3})");
  CHECK(places.count("/a~1b") == 1);
  CHECK(places.count("/c~0d") == 1);
  CHECK(places.count("/q\"e") == 1);
}

TEST_CASE("a text that is one scalar has one place") {
  CHECK(places_in("  42 ").at("").value == 2);
  CHECK(places_in("\"x\"").size() == 1);
}

TEST_CASE("lines and columns count from one, columns in characters") {
  const std::string text = "ab\n\xC3\xA4\xE2\x82\xACx\n\n";
  const LineIndex lines(text);
  CHECK(lines.place(0) == ":1:1");
  CHECK(lines.place(2) == ":1:3");
  CHECK(lines.place(3) == ":2:1");
  CHECK(lines.place(5) == ":2:2");
  CHECK(lines.place(8) == ":2:3");
  CHECK(lines.place(10) == ":3:1");
  CHECK(lines.place(text.size()) == ":4:1");
  CHECK(lines.place(1000) == ":4:1");
}

TEST_CASE("a byte order mark takes no column") {
  CHECK(LineIndex("\xEF\xBB\xBF{").place(3) == ":1:1");
  CHECK(LineIndex("\xEF\xBB\xBF{").place(0) == ":1:1");
}

}  // namespace grainsweep
