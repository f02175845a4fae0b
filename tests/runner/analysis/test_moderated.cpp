#include <cmath>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/analysis/moderated.hpp"
#include "runner/analysis/student.hpp"

namespace grainsweep {
namespace {

TEST_CASE("a group without others keeps its variance") {
  const auto all = moderated({{2.0, 3.0}});
  CHECK(all[0].variance == 2.0);
  CHECK(all[0].degrees_of_freedom == 3.0);
  CHECK(moderated({}).empty());
}

TEST_CASE(
    "groups that are as much alike as usual have a weighted mean of the pooled and their own") {
  const auto all = moderated({{1.0, 3.0}, {2.0, 6.0}, {0.0, 0.0}});
  const double pooled = (3 * 1.0 + 6 * 2.0) / 9, k = usual_likeness;
  CHECK(all[0].variance == Approx((k * pooled + 3 * 1.0) / (k + 3)));
  CHECK(all[1].variance == Approx((k * pooled + 6 * 2.0) / (k + 6)));
  CHECK(all[2].variance == Approx(pooled));                                   // of one packing
  for (const KnownVariance& one : all) CHECK(one.degrees_of_freedom == 9.0);  // not more than all
  const auto many = moderated(std::vector<KnownVariance>(20, {3.0, 4.0}));
  for (const KnownVariance& one : many) {
    CHECK(one.variance == Approx(3.0));
    CHECK(one.degrees_of_freedom == k + 4.0);
  }
}

TEST_CASE("a group far beyond the others keeps its own variance, which no other hears of") {
  const std::vector<KnownVariance> usual = {{1.0, 9.0}, {1.5, 9.0}, {2.0, 9.0}};
  const auto without = moderated(usual);
  for (const double far : {1e-6, 1e3}) {
    std::vector<KnownVariance> own = usual;
    own.push_back({far, 9.0});
    const auto all = moderated(own);
    CHECK(all[3].variance == far);
    CHECK(all[3].degrees_of_freedom == 9.0);
    for (std::size_t i = 0; i < usual.size(); ++i) {
      CHECK(all[i].variance == without[i].variance);
      CHECK(all[i].degrees_of_freedom == without[i].degrees_of_freedom);
    }
  }
}

TEST_CASE("values that are all the same tell nothing, and have what others say") {
  const auto all = moderated({{1.0, 4.0}, {1.5, 4.0}, {0.0, 4.0}});
  const auto without = moderated({{1.0, 4.0}, {1.5, 4.0}});
  CHECK(all[0].variance == without[0].variance);
  CHECK(all[2].variance == 1.25);
  const auto copies = moderated({{0.0, 4.0}, {0.0, 0.0}});
  CHECK(copies[0].variance == 0.0);
  CHECK(copies[0].degrees_of_freedom == 4.0);
  CHECK(copies[1].degrees_of_freedom == 0.0);
}

// Beds of which the middle three were within 0.0006 of one Z: the others tell that this is chance.
TEST_CASE("few values that happen to agree have nearly the error of others") {
  for (const double near_nothing : {1e-2, 1e-3, 3e-4}) {
    const auto all = moderated({{1.0, 2.0}, {near_nothing, 2.0}, {1.3, 2.0}});
    const double pooled = (2 * 1.0 + 2 * near_nothing + 2 * 1.3) / 6;
    CHECK(all[1].variance ==
          Approx((usual_likeness * pooled + 2 * near_nothing) / (usual_likeness + 2)));
    CHECK(all[1].degrees_of_freedom == 6.0);
  }
  // Of ten values that is no chance.
  CHECK(moderated({{1.0, 9.0}, {1e-3, 9.0}, {1.3, 9.0}})[1].variance == 1e-3);
}

TEST_CASE("groups that have little in common keep nearly their own variances") {
  std::vector<KnownVariance> own;
  for (int k = 0; k < 20; ++k) own.push_back({std::pow(2.0, k % 7 - 3), 20.0});
  const auto all = moderated(own);
  for (std::size_t i = 0; i < own.size(); ++i) {
    CHECK(std::abs(std::log(all[i].variance / own[i].variance)) < 0.3);
    CHECK(all[i].degrees_of_freedom < 25.0);
  }
}

/// Mean over many families of how often 1.96 errors of the mean of n values hold the truth. The
/// standard deviations of groups are `sigma`, times a factor drawn with so many degrees of freedom
/// (infinite if 0).
double coverage(const std::vector<double>& sigma, int n, double likeness, int families) {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  std::gamma_distribution<double> chi2(likeness > 0 ? likeness / 2 : 1.0, 2.0);
  int held = 0;
  for (int family = 0; family < families; ++family) {
    std::vector<KnownVariance> own;
    std::vector<double> means;
    for (const double usual : sigma) {
      const double of_group = usual * (likeness > 0 ? std::sqrt(likeness / chi2(generator)) : 1.0);
      std::vector<double> values;
      double mean = 0.0, squares = 0.0;
      for (int k = 0; k < n; ++k) mean += values.emplace_back(of_group * normal(generator)) / n;
      for (const double value : values) squares += (value - mean) * (value - mean);
      means.push_back(mean);
      own.push_back({squares / (n - 1), n - 1.0});
    }
    const auto all = moderated(own);
    for (std::size_t i = 0; i < sigma.size(); ++i) {
      const double half =
          student_quantile(all[i].degrees_of_freedom) * std::sqrt(all[i].variance / n);
      held += std::abs(means[i]) <= half ? 1 : 0;
    }
  }
  return held / static_cast<double>(families * static_cast<int>(sigma.size()));
}

// 4000 intervals: the share that holds the truth is known to 0.0035. Of unlike groups with few
// values it is less than 0.95: the pooled variance of five is known less well than its degrees of
// freedom say.
TEST_CASE("95 % of intervals hold the truth, however alike groups are") {
  const std::vector<double> five(5, 1.0);
  for (const int n : {2, 4, 10}) {
    INFO(n << " values a group");
    CHECK(coverage(five, n, 0, 800) == Approx(0.95).margin(0.012));
    CHECK(coverage(five, n, usual_likeness, 800) == Approx(0.95).margin(0.02));
    CHECK(coverage(five, n, 4, 800) == Approx(0.95).margin(0.025));
  }
  // Single files beside wider tubes.
  CHECK(coverage({1e-4, 1e-3, 1e-2, 1, 1, 1, 1, 1}, 10, usual_likeness, 500) ==
        Approx(0.95).margin(0.015));
}

}  // namespace
}  // namespace grainsweep
