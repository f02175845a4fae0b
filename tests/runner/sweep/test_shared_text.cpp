#include <string>

#include <catch2/catch.hpp>

#include "runner/sweep/shared_text.hpp"

namespace grainsweep {
namespace {

TEST_CASE("copies of a text share it until one of them is replaced") {
  const SharedText text = std::string("a text longer than a string keeps in itself");
  SharedText copy = text;
  CHECK(copy.text().data() == text.text().data());
  copy = "another";
  CHECK(copy.text() == "another");
  CHECK(text.text() == "a text longer than a string keeps in itself");
  CHECK_FALSE(copy == text);
}

TEST_CASE("texts are equal by what they say, none is an empty one") {
  CHECK(SharedText("one") == SharedText("one"));
  CHECK(SharedText() == SharedText(""));
  CHECK(SharedText().text().empty());
}

}  // namespace
}  // namespace grainsweep
