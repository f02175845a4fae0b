#include <cmath>

#include <catch2/catch.hpp>

#include "runner/jobs/replicate_means.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

TEST_CASE("half of a 95 % interval is that of Student's distribution") {
  const auto quantile = [](int degrees) {  // printed tables have three decimals
    return half_interval(std::sqrt(degrees + 1.0), degrees + 1);
  };
  CHECK(quantile(1) == about(12.706, 1e-3));  // of two that settled
  CHECK(quantile(2) == about(4.303, 1e-3));
  CHECK(quantile(5) == about(2.571, 1e-3));
  CHECK(quantile(10) == about(2.228, 1e-3));
  CHECK(quantile(30) == about(2.042, 1e-3));
  CHECK(quantile(100000) == about(1.960, 1e-3));
  CHECK(std::isinf(half_interval(0.0, 1)));
}

TEST_CASE("means are over the settled ones of the first packings") {
  std::vector<Outcome> outcomes = {sample_outcome("a", 0.5, 5.0), sample_outcome("b", 0.7, 5.5),
                                   sample_outcome("c", 0.1, 1.0), sample_outcome("d", 0.9, 9.0)};
  outcomes[2].result.status = PackingStatus::not_settled;
  const Means means = means_of({&outcomes[0], &outcomes[1], &outcomes[2], &outcomes[3]}, 3);
  CHECK(means.solid_fraction.n == 2);
  CHECK(means.solid_fraction.mean == Approx(0.6));
  CHECK(means.coordination.mean == Approx(5.25));
}

}  // namespace
}  // namespace grainsweep
