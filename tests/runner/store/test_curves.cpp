#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/store/curves.hpp"

namespace grainsweep {
namespace {

TEST_CASE("a profile reads back from its JSON in every member") {
  const Profile profile{0.1, {{0.1 + 0.2, 1.0 / 3.0, 1, 2, 3, 4}, {5e-324, 0, 5, 6, 7, 8}}};
  const Profile back = profile_from_json(nlohmann::json::parse(to_json(profile).dump()));
  CHECK(back.bin_width == profile.bin_width);
  REQUIRE(back.bins.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(back.bins[k].large == profile.bins[k].large);
    CHECK(back.bins[k].small == profile.bins[k].small);
    CHECK(back.bins[k].large_grains == profile.bins[k].large_grains);
    CHECK(back.bins[k].small_grains == profile.bins[k].small_grains);
    CHECK(back.bins[k].neighbours == profile.bins[k].neighbours);
    CHECK(back.bins[k].walls == profile.bins[k].walls);
  }
}

TEST_CASE("a profile with a short column is refused") {
  nlohmann::json json = to_json(Profile{0.1, {{}, {}}});
  json["walls"].erase(0);
  CHECK_THROWS_WITH(profile_from_json(json), "a column of another length: walls");
}

TEST_CASE("order reads back from its JSON in every member, not-a-number too") {
  const Order order{
      0.1, 1.0 / 3.0, 0.2, std::nan(""), 7.5, 1.5, {0.05, {0, 0.1, 3}}, {0.1, {1, std::nan("")}}};
  const Order back = order_from_json(nlohmann::json::parse(to_json(order).dump()));
  CHECK(to_json(back) == to_json(order));
  CHECK(back.q6_local == order.q6_local);
  CHECK(std::isnan(back.segregation));
  CHECK(back.pair_correlation.values == order.pair_correlation.values);
  CHECK(std::isnan(back.force_density.values.at(1)));
}

}  // namespace
}  // namespace grainsweep
