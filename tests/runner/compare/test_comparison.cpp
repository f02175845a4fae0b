#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "runner/compare/comparison.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

/// Two packings on the line .64 - .2 / W and 6 - 3 / W with layers at walls that decay over
/// 7 C d, C = .2.
void add_width(std::vector<Row>& rows, double width, double small_share = 0.0, double c = 0.2) {
  for (const double scatter : {-0.001, 0.001}) {
    const std::string id = std::to_string(rows.size());
    Row row = settled_row(id, width, 0.64 - c / width + scatter, 6 - 3 / width + 10 * scatter,
                          Boundary::walls, small_share);
    row.outcome->result.mean_diameter = 0.5;
    row.outcome->result.mean_diameter_by_volume = 0.8;
    std::mt19937_64 generator(rows.size());
    std::normal_distribution<double> normal(0, 0.001);
    Profile& profile = row.outcome->result.profile_y;
    profile.bin_width = 0.1;
    for (double y = 0.05; y < width; y += 0.1) {
      const double from_wall = std::min(y, width - y);
      const double layers = 0.3 * std::exp(-from_wall / (7 * c)) * std::cos(7 * from_wall);
      const std::int64_t neighbours = from_wall < 1 ? 46 : 60;
      profile.bins.push_back({0.6 + layers + normal(generator), 0, 10, 0, neighbours, 0});
    }
    rows.push_back(row);
  }
}

std::vector<Comparison> comparisons_of(const std::vector<Row>& rows) {
  return compare_with_paper(families_of(groups_of(rows)));
}

const Comparison& named(const std::vector<Comparison>& all, const std::string& quantity) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Comparison& row) {
    return row.quantity.starts_with(quantity);
  });
  if (found == all.end()) FAIL("no row " << quantity);
  return *found;
}

std::vector<Row> whole_sweep() {
  std::vector<Row> rows;
  for (const double width : {5.0, 10.0, 20.0}) add_width(rows, width);
  for (const double z : {5.98, 6.02}) {
    rows.push_back(settled_row("p" + std::to_string(z), 20, 0.64, z, Boundary::periodic));
  }
  return rows;
}

TEST_CASE("a difference is counted from the nearer end of the paper's range") {
  Comparison row;
  row.paper = {"3 to 4", PaperValue::Range{3, 4, 0}};
  row.ours = {2.5, 0.25};
  CHECK(difference(row) == -0.5);
  CHECK(difference_in_errors(row) == -2.0);
  row.ours.value = 3.5;
  CHECK(difference(row) == 0.0);
  row.ours.value = 4.25;
  CHECK(difference_in_errors(row) == 1.0);
  row.not_determined = "why";
  CHECK_FALSE(difference(row));
  row = {};
  row.ours = {1, 1};
  CHECK_FALSE(difference(row));
}

TEST_CASE("printed errors and ours are added in quadrature") {
  Comparison row;
  row.paper = {"6.0 ± 0.3", PaperValue::Range{6, 6, 0.3}};
  row.ours = {6.5, 0.4};
  CHECK(*difference_in_errors(row) == Approx(1.0));
}

TEST_CASE("a whole sweep is set beside the paper with value and error") {
  const auto all = comparisons_of(whole_sweep());
  const Comparison& z = named(all, "Z without walls");
  CHECK(z.paper.text == "6.027 ± 0.012");
  CHECK(z.ours.value == Approx(6.0));
  // Four groups of two, .02 or .04 apart: variances 3 x 2e-4 and 8e-4, pooled 3.5e-4.
  CHECK(z.ours.error == Approx(std::sqrt(3.5e-4 / 2)));
  CHECK(*difference_in_errors(z) == Approx(-0.027 / std::hypot(z.ours.error, 0.012)));
  CHECK_THAT(z.definition, Catch::Contains("walls not counted") && Catch::Contains("1.000"));
  CHECK(named(all, "φ_bulk").ours.value == Approx(0.64));
  CHECK(named(all, "C / d").ours.value == Approx(0.2));
  CHECK(named(all, "φ at W = 5").ours.value == Approx(0.6));
  const Comparison& decay = named(all, "λ_L / d_avg");
  CHECK(decay.ours.value == Approx(1.4 / 0.5).epsilon(0.05));
  CHECK(*difference(decay) == Approx(decay.ours.value - 1.4));
  CHECK(named(all, "drop of Z").ours.value == Approx(1.4));
  CHECK(named(all, "reach").paper.text == "3 to 4");
  CHECK(named(all, "ζ_Z - ζ_φ").ours.value == Approx(3 / 6.0 - 0.2 / 0.64));
  CHECK_THAT(named(all, "λ_L / C").not_determined, Catch::Contains("has 1"));
}

TEST_CASE("pinacoids are set beside the paper's pinacoids, other shapes beside nothing") {
  const auto printed_with = [](const std::string& name, const std::string& shape) {
    auto rows = whole_sweep();
    for (Row& row : rows) {
      std::string& parameters = row.job.parameters;
      parameters.replace(parameters.find("\"sphere\""), 8, shape);
      row.job.shape = name;
    }
    const auto all = comparisons_of(rows);
    return std::vector<std::string>{named(all, "Z without walls").paper.text,
                                    named(all, "λ_L / d_avg").paper.text,
                                    named(all, "drop of Z").paper.text};
  };
  using Texts = std::vector<std::string>;
  const Texts none(3, "not printed");
  CHECK(printed_with("pinacoid",
                     R"({"pinacoid":{"angle_deg":60,"height":1,"length":1,"width":1}})") ==
        Texts{"8.581 ± 0.068", "1.2", "1.5"});
  CHECK(printed_with("pinacoid",
                     R"({"pinacoid":{"angle_deg":50,"height":1,"length":1,"width":1}})") == none);
  CHECK(printed_with("hull", R"({"hull":{"vertices":"0123456789abcdef"}})") == none);
}

TEST_CASE("families that share one ratio of decay and slope show one line through zero") {
  auto rows = whole_sweep();
  for (const double share : {0.25, 0.4}) {
    for (const double width : {5.0, 10.0, 20.0}) add_width(rows, width, share, 0.2 - 0.2 * share);
  }
  const auto all = comparisons_of(rows);
  const Comparison& line = named(all, "λ_L / C");
  REQUIRE(line.not_determined.empty());
  CHECK(std::abs(line.ours.value - 7) < 3 * line.ours.error);
  const auto by_volume = std::count_if(all.begin(), all.end(), [](const Comparison& row) {
    return row.quantity == "λ_L / d_avg at W = 10 d, by volume";
  });
  CHECK(by_volume == 2);
}

TEST_CASE("what a sweep lacks is not determined and never a number") {
  std::vector<Row> rows = {settled_row("a", 5, 0.6, 5.4), settled_row("b", 6, 0.61, 5.5)};
  const auto all = comparisons_of(rows);
  for (const Comparison& row : all) {
    INFO(row.quantity);
    CHECK_FALSE(row.not_determined.empty());
    CHECK_FALSE(difference_in_errors(row));
  }
  CHECK(named(all, "φ at W = 5").not_determined ==
        "one settled replicate leaves the error unknown");
  CHECK_THAT(named(all, "C / d").not_determined, Catch::Contains("3 or more widths"));
  CHECK_THAT(named(all, "φ at W = 10").not_determined, Catch::Contains("W = 10 d"));
  const std::string text = comparison_text(all);
  CHECK(text.find("nan") == std::string::npos);
  CHECK(text.find("0.6000") == std::string::npos);
}

TEST_CASE("the table names the paper's value, ours, both differences and the definition") {
  const std::string text = comparison_text(comparisons_of(whole_sweep()));
  CHECK_THAT(text,
             Catch::Contains("MSP\n") && Catch::Contains("paper") && Catch::Contains("in errors"));
  CHECK_THAT(text, Catch::Contains("  Z without walls (bi-periodic)            6.027 ± 0.012       "
                                   "6.000 ± 0.013     -0.027       -1.5\n"
                                   "      neighbours per grain from 3 d above the floor"));
}

}  // namespace
}  // namespace grainsweep
