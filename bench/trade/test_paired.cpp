#include <algorithm>
#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "bench/trade/paired.hpp"

namespace grainsweep::bench {
namespace {

TEST_CASE("a paired difference has the mean and the standard error of the differences") {
  const ByStart reference = {{1, 10.0}, {2, 20.0}, {3, 30.0}, {4, 40.0}};
  const ByStart changed = {{1, 11.0}, {2, 22.0}, {3, 33.0}, {4, 44.0}};
  const MeanError difference = paired_difference(changed, reference);
  CHECK(difference.n == 4);
  CHECK(difference.mean == 2.5);  // of 1, 2, 3, 4, whose variance is 5 / 3
  CHECK(difference.error == Approx(std::sqrt(5.0 / 3.0 / 4.0)).epsilon(1e-14));
}

TEST_CASE("starts that only one of both has do not enter a paired difference") {
  const ByStart reference = {{1, 1.0}, {2, 5.0}, {9, 100.0}};
  const ByStart changed = {{1, 2.0}, {2, 6.0}, {7, -100.0}};
  const MeanError difference = paired_difference(changed, reference);
  CHECK(difference.n == 2);
  CHECK(difference.mean == 1.0);
  CHECK(difference.error == 0.0);
}

TEST_CASE("one pair has no error, and none has no mean") {
  CHECK(std::isnan(paired_difference({{1, 2.0}}, {{1, 1.0}}).error));
  CHECK(paired_difference({{1, 2.0}}, {{1, 1.0}}).mean == 1.0);
  CHECK(std::isnan(paired_difference({{1, 2.0}}, {{2, 1.0}}).mean));
  CHECK(std::isnan(mean({})));
}

TEST_CASE("a median lies in the middle") {
  CHECK(median({3.0, 1.0, 2.0}) == 2.0);
  CHECK(median({4.0, 1.0, 3.0, 2.0}) == 2.5);
  CHECK(std::isnan(median({})));
}

TEST_CASE("the jackknife of a mean is its standard error where a start is left out at a time") {
  const std::vector<double> values = {0.3, 1.7, -0.4, 2.2, 0.9, 0.1, 1.1, -1.3};
  std::vector<int> starts(values.size());
  std::iota(starts.begin(), starts.end(), 0);
  ByStart by_start, zero;
  for (const int start : starts) {
    by_start[start] = values[static_cast<std::size_t>(start)];
    zero[start] = 0.0;
  }
  const auto mean_over = [&](const std::vector<int>& kept) {
    double sum = 0.0;
    for (const int start : kept) sum += by_start.at(start);
    return sum / static_cast<double>(kept.size());
  };
  const MeanError same = paired_difference(by_start, zero);
  const MeanError found = jackknife(starts, static_cast<int>(starts.size()), mean_over);
  CHECK(found.n == 8);
  CHECK(found.mean == Approx(same.mean).epsilon(1e-14));
  CHECK(found.error == Approx(same.error).epsilon(1e-13));
}

TEST_CASE("of fewer starts than groups the jackknife leaves each out once") {
  const auto sum_over = [](const std::vector<int>& kept) {
    return static_cast<double>(std::accumulate(kept.begin(), kept.end(), 0));
  };
  const MeanError two = jackknife({1, 2}, 16, sum_over);
  CHECK(two.mean == 3.0);
  CHECK(two.error == Approx(std::sqrt(0.5 * 0.5)).epsilon(1e-14));  // of 2 and 1
  CHECK(std::isnan(jackknife({5}, 1, sum_over).error));
}

TEST_CASE("where there is no estimate without a group the jackknife has no error") {
  const auto needs_third = [](const std::vector<int>& kept) {
    return std::find(kept.begin(), kept.end(), 3) == kept.end() ? std::nan("")
                                                                : static_cast<double>(kept.size());
  };
  const MeanError found = jackknife({1, 2, 3, 4}, 4, needs_third);
  CHECK(found.mean == 4.0);
  CHECK(std::isnan(found.error));
}

}  // namespace
}  // namespace grainsweep::bench
