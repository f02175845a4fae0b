#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/saved_state.hpp"

namespace grainsweep {
namespace {

const std::string payload = "not a single bit may change";
constexpr std::uint64_t kind = 7;

TEST_CASE("values, columns and lists read back as they were written") {
  const std::vector<std::vector<int>> lists = {{1, 2, 3}, {}, {4}};
  StateWriter writer;
  writer.value(2.5);
  writer.column(std::vector<float>{1, 2, 3});
  writer.list(lists, [&](const auto& list) { writer.column(list); });
  StateReader reader(writer.bytes());
  double value = 0;
  std::vector<float> column;
  std::vector<std::vector<int>> read;
  reader.value(value);
  reader.column(column);
  reader.list(read, [&](auto& list) { reader.column(list); });
  CHECK(value == 2.5);
  CHECK(column == std::vector<float>{1, 2, 3});
  CHECK(read == lists);
}

TEST_CASE("bytes that end too early are refused, however many elements they promise") {
  StateWriter writer;
  writer.value(2.5);
  writer.column(std::vector<float>{1, 2, 3});
  const auto read = [](const std::string& bytes) {
    StateReader reader(bytes);
    double value = 0;
    std::vector<float> column;
    reader.value(value);
    reader.column(column);
  };
  CHECK_NOTHROW(read(writer.bytes()));
  for (std::size_t kept = 0; kept < writer.bytes().size(); ++kept) {
    INFO("cut to " << kept);
    CHECK_THROWS_AS(read(writer.bytes().substr(0, kept)), std::length_error);
  }
  const std::string endless(16, '\xff');
  CHECK_THROWS_AS(read(endless), std::length_error);
  std::vector<std::vector<int>> lists;
  const auto each = [](auto&) {};
  CHECK_THROWS_AS(StateReader(endless).list(lists, each), std::length_error);
}

TEST_CASE("sealed bytes open to their payload") {
  CHECK(unsealed(kind, sealed(kind, payload)) == payload);
  CHECK(unsealed(kind, sealed(kind, "")) == "");
}

TEST_CASE("no sealed state opens as one of another kind") {
  CHECK_FALSE(unsealed(kind + 1, sealed(kind, payload)));
}

TEST_CASE("sealed bytes with any byte changed do not open") {
  const std::string whole = sealed(kind, payload);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    for (const int bit : {0, 3, 7}) {
      std::string changed = whole;
      changed[k] = static_cast<char>(changed[k] ^ (1 << bit));
      INFO("byte " << k << ", bit " << bit);
      REQUIRE_FALSE(unsealed(kind, changed));
    }
  }
}

TEST_CASE("sealed bytes cut anywhere, or followed by others, do not open") {
  const std::string whole = sealed(kind, payload);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    INFO("cut to " << k);
    REQUIRE_FALSE(unsealed(kind, whole.substr(0, k)));
  }
  CHECK_FALSE(unsealed(kind, whole + "x"));
}

}  // namespace
}  // namespace grainsweep
