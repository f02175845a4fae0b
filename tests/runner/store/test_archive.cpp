#include <bit>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "runner/store/archive.hpp"

namespace grainsweep {

enum class Hand : std::int32_t { left = -1, right = 1 };

struct Inner {
  double number = 0.0;
  std::vector<std::int32_t> list;
};
constexpr auto members_of(const Inner* /*type*/) {
  return std::tuple(&Inner::number, &Inner::list);
}

struct Outer {
  std::uint8_t byte = 0;
  bool flag = false;
  Hand side = Hand::left;
  std::string text;
  std::array<double, 2> pair{};
  std::optional<Inner> some, none;
  std::vector<Inner> inner;
};
constexpr auto members_of(const Outer* /*type*/) {
  return std::tuple(&Outer::byte, &Outer::flag, &Outer::side, &Outer::text, &Outer::pair,
                    &Outer::some, &Outer::none, &Outer::inner);
}

namespace {

Outer sample() {
  Outer value{0xAB, true, Hand::right, std::string("a\0b", 3), {5e-324, -0.0}, {}, {}, {}};
  value.some = Inner{std::numeric_limits<double>::quiet_NaN(), {-1, 2}};
  value.inner = {{1.0 / 3.0, {}}, {-std::numeric_limits<double>::infinity(), {7}}};
  return value;
}

TEST_CASE("a struct reads back bit by bit") {
  const std::string bytes = file_bytes("MARK", sample());
  const auto back = value_in_file<Outer>("MARK", bytes);
  REQUIRE(back);
  CHECK(file_bytes("MARK", *back) == bytes);
  CHECK(back->side == Hand::right);
  CHECK(back->text.size() == 3);
  CHECK(back->pair[0] == 5e-324);
  CHECK(std::signbit(back->pair[1]));
  CHECK_FALSE(back->none);
  REQUIRE(back->some);
  CHECK(std::isnan(back->some->number));
  CHECK(back->some->list == std::vector<std::int32_t>{-1, 2});
  CHECK(back->inner.at(1).list == std::vector<std::int32_t>{7});
}

TEST_CASE("numbers are little-endian, lists begin with their length") {
  ByteWriter writer;
  writer.put(std::uint32_t{0x01020304});
  writer.put(20.0);
  writer.put(std::vector<std::uint8_t>{5, 6});
  writer.put(std::optional<bool>(true));
  CHECK(writer.bytes() == std::string("\4\3\2\1\0\0\0\0\0\0\x34\x40\2\0\0\0\0\0\0\0\5\6\1\1", 24));
}

TEST_CASE("a file that is cut, changed or marked otherwise holds no value") {
  const std::string bytes = file_bytes("MARK", sample());
  for (std::size_t kept = 0; kept < bytes.size(); ++kept) {
    CHECK_FALSE(value_in_file<Outer>("MARK", bytes.substr(0, kept)));
  }
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string changed = bytes;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << (bit % 8)));
    CHECK_FALSE(value_in_file<Outer>("MARK", changed));
  }
  CHECK_FALSE(value_in_file<Outer>("MARK", bytes + '\0'));
  CHECK_FALSE(value_in_file<Outer>("MASK", bytes));
}

TEST_CASE("whole bytes of another form are no value, however long they say they are") {
  CHECK_FALSE(value_in_file<Outer>("MARK", file_bytes("MARK", Inner{})));
  CHECK_FALSE(value_in_file<Inner>("MARK", file_bytes("MARK", sample())));
  const std::string endless(8, '\xff');
  CHECK_THROWS_AS(
      [&] {
        std::vector<Inner> list;
        ByteReader(endless).take(list);
      }(),
      std::length_error);
}

}  // namespace
}  // namespace grainsweep
