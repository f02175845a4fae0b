#include <cmath>

#include <catch2/catch.hpp>

#include "engine/scene/random.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

using Words = r123::Philox4x32::ctr_type;

// Known answers published with the generator (Random123, kat_vectors, philox4x32 with 10 rounds).
// They also fix which part of the key and of the counter carries what.
TEST_CASE("random words are the published answers of Philox") {
  CHECK(random_words(0, Purpose{0}, 0, 0) ==
        Words{{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}});
  CHECK(random_words(~0ULL, Purpose{~0U}, ~0ULL, ~0U) ==
        Words{{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}});
  CHECK(random_words(0x299f31d0a4093822ULL, Purpose{0x03707344U}, 0x85a308d3243f6a88ULL,
                     0x13198a2eU) == Words{{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U}});
}

TEST_CASE("a word maps into the open unit interval") {
  CHECK(unit_interval(0) == 0x1p-33);
  CHECK(unit_interval(~0U) == 1.0 - 0x1p-33);
  CHECK(unit_interval(0x80000000U) == 0.5 + 0x1p-33);
}

TEST_CASE("every pair of words gives a finite normal number") {
  CHECK(standard_normal(0, 0) == Approx(std::sqrt(2 * 33 * std::log(2.0))));
  CHECK(std::isfinite(standard_normal(~0U, ~0U)));
  CHECK(std::abs(standard_normal(~0U, 7)) < 1e-4);
}

// 100,000 draws: the moments of a standard normal number scatter by sqrt(1, 2, 96) / sqrt(n) =
// .0032, .0045 and .031; four times that is allowed.
TEST_CASE("normal numbers have mean 0, variance 1 and fourth moment 3") {
  const int draws = 100'000;
  double sum = 0, squares = 0, fourths = 0;
  for (std::uint64_t grain = 0; grain < draws; ++grain) {
    const auto words = random_words(77, Purpose::size, grain, 0);
    const double z = standard_normal(words[0], words[1]);
    sum += z, squares += z * z, fourths += z * z * z * z;
  }
  CHECK(sum / draws == Approx(0).margin(0.013));
  CHECK(squares / draws == about(1, 0.018));
  CHECK(fourths / draws == about(3, 0.124));
}

}  // namespace
}  // namespace grainsweep
