#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "runner/store/curves.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

std::string bytes_of(const Curves& curves) {
  std::string bytes;
  put_curves(bytes, curves);
  return bytes;
}

TEST_CASE("curves read back in every member, not-a-number too") {
  const Curves curves = sample_curves();
  const std::string bytes = bytes_of(curves) + "behind";
  std::string_view rest = bytes;
  const Curves back = take_curves(rest);
  CHECK(rest == "behind");
  CHECK(back.profile_y.bin_width == curves.profile_y.bin_width);
  REQUIRE(back.profile_y.bins.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const ProfileBin &one = back.profile_y.bins[k], &other = curves.profile_y.bins[k];
    CHECK(one.large == other.large);
    CHECK(one.small == other.small);
    CHECK(one.large_grains == other.large_grains);
    CHECK(one.small_grains == other.small_grains);
    CHECK(one.neighbours == other.neighbours);
    CHECK(one.walls == other.walls);
  }
  CHECK(back.profile_z.bins.size() == 1);
  CHECK(back.pair_correlation.values == curves.pair_correlation.values);
  CHECK(back.force_density.bin_width == 0.1);
  CHECK(std::isnan(back.force_density.values.at(1)));
  CHECK(bytes_of(back) == bytes_of(curves));
}

TEST_CASE("curves have the layout their header states") {
  const std::string bytes = bytes_of(sample_curves());
  CHECK(bytes.size() == 4 * 16 + 3 * 48 + 3 * 8 + 2 * 8);
  CHECK(bytes.substr(8, 8) == std::string("\2\0\0\0\0\0\0\0", 8));
  CHECK(bytes.substr(16 + 16, 8) == std::string("\1\0\0\0\0\0\0\0", 8));
}

TEST_CASE("curves that end too early or claim too much are refused") {
  const std::string bytes = bytes_of(sample_curves());
  for (std::size_t kept = 0; kept < bytes.size(); ++kept) {
    std::string_view rest = std::string_view(bytes).substr(0, kept);
    CHECK_THROWS_AS(take_curves(rest), std::length_error);
  }
  std::string greedy = bytes;
  greedy[15] = '\x7f';  // 2^62 bins: their size would not even be a number
  std::string_view rest = greedy;
  CHECK_THROWS_AS(take_curves(rest), std::length_error);
}

TEST_CASE("the curves of a result are those it is given") {
  PackingResult result;
  set_curves(sample_curves(), result);
  CHECK(result.profile_z.bin_width == 0.25);
  CHECK(result.order.force_density.values.size() == 2);
  CHECK(bytes_of(curves_of(result)) == bytes_of(sample_curves()));
}

}  // namespace
}  // namespace grainsweep
