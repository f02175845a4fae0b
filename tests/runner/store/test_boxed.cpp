#include <string>

#include <catch2/catch.hpp>

#include "runner/store/boxed.hpp"

namespace grainsweep {
namespace {

TEST_CASE("a boxed value is copied with its value, and gone once it is reset") {
  Boxed<std::string> first = std::string("a"), none = std::nullopt;
  Boxed<std::string> second = first;
  *second += "b";
  CHECK(*first == "a");
  CHECK(second->size() == 2);
  first = second;
  second.reset();
  CHECK_FALSE(second);
  CHECK(*first == "ab");
  first = none;
  CHECK_FALSE(first);
}

}  // namespace
}  // namespace grainsweep
