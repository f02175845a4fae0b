#include <catch2/catch.hpp>

#include "runner/sweep/suggest.hpp"

namespace grainsweep {

TEST_CASE("edit distance counts insertions, deletions, replacements and swaps") {
  CHECK(edit_distance("width", "width") == 0);
  CHECK(edit_distance("width", "widht") == 1);
  CHECK(edit_distance("width", "wdth") == 1);
  CHECK(edit_distance("width", "widthh") == 1);
  CHECK(edit_distance("width", "wodth") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("sitting", "kitten") == 3);
}

TEST_CASE("the nearest word is suggested only if most of it is right") {
  CHECK(nearest("spred", {"small_share", "spread", "size_ratio"}) == "spread");
  CHECK(nearest("colour", {"small_share", "spread", "size_ratio"}).empty());
  CHECK(nearest(std::string(1'000'000, 'a'), {"a"}).empty());
}

TEST_CASE("the beginning of only one word suggests that") {
  CHECK(nearest("err", {"value", "error", "relative_error"}) == "error");
  CHECK(nearest("replic", {"name", "replicates"}) == "replicates");
  CHECK(nearest("size", {"size_ratio", "size_table"}).empty());
  CHECK(nearest("re", {"replicates"}).empty());
}

TEST_CASE("long words are cut between characters") {
  CHECK(shortened("short") == "short");
  CHECK(shortened(std::string(59, 'a') + "\xC3\xA4\xC3\xA4") == std::string(59, 'a') + "...");
}

TEST_CASE("an unknown key without a near one lists the keys known there, dotted ones left out") {
  CHECK(unknown_key("foo", {"box", "box.width"}) == "unknown key \"foo\"; known here: box");
}

}  // namespace grainsweep
