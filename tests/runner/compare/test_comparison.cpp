#include <cmath>

#include <catch2/catch.hpp>

#include "runner/compare/comparison.hpp"
#include "tests/runner/compare/wall_sweep.hpp"

namespace grainsweep {
namespace {

Comparison comparison_of(Published::Range published, Estimate measured) {
  Comparison row;
  row.published.range = published;
  row.measured.estimate = measured;
  return row;
}

/// Published values of spheres of one size, and one of all families.
Reference reference() {
  Reference reference;
  reference.source = "Source";
  reference.families = {
      {{{"shape", "\"sphere\""}, {"sizes.small_share", "0.0"}},
       {{"Z_unconfined", 0, "6.027 ± 0.012", Published::Range{6.027, 6.027, 0.012}, "", {}},
        {"C", 0, "falls with x_S", std::nullopt, "in words", {}},
        {"Z", 10, "3 to 4", Published::Range{3, 4, 0}, "", {}}}},
      {{{"shape", "\"pinacoid\""}}, {}}};
  reference.common = {{"lambda_over_C", 10, "one line through 0", std::nullopt, "", {}}};
  return reference;
}

TEST_CASE("a difference is counted from the nearer end of the published range") {
  Comparison row = comparison_of({3, 4, 0}, {2.5, 0.25});
  CHECK(difference(row) == -0.5);
  CHECK(difference_in_errors(row) == -2.0);
  row.measured.estimate.value = 3.5;
  CHECK(difference(row) == 0.0);
  row.measured.estimate.value = 4.25;
  CHECK(difference_in_errors(row) == 1.0);
  row.measured.not_determined = "why";
  CHECK_FALSE(difference(row));
  CHECK_FALSE(difference({}));
}

TEST_CASE("a difference is relative to a single published value other than 0") {
  Comparison row = comparison_of({4, 4, 0}, {3, 0.25});
  CHECK(relative_difference(row) == -0.25);
  row.published.range = Published::Range{3, 4, 0};
  CHECK_FALSE(relative_difference(row));
  row.published.range = Published::Range{0, 0, 0};
  CHECK_FALSE(relative_difference(row));
  CHECK_FALSE(relative_difference({}));
}

TEST_CASE("published errors and ours are added in quadrature, for the verdict, too") {
  const Comparison row = comparison_of({6, 6, 0.3}, {6.5, 0.4});
  CHECK(*difference_in_errors(row) == Approx(1.0));
  CHECK(verdict(row) == "agrees: +0.50, 1.0 errors");
  CHECK(verdict(comparison_of({6, 6, 0}, {4.5, 0.4})) == "differs: -1.50, 3.8 errors");
  CHECK(verdict(comparison_of({6, 6, 0.3}, {4.5, 0.4})) == "agrees: -1.50, 3.0 errors");
  CHECK(verdict(comparison_of({6, 6, 0.25}, {6.503, 0})) == "agrees: +0.503, 2.0 errors");
  CHECK(verdict(comparison_of({6, 6, 0.25}, {6.76, 0})) == "differs: +0.760, 3.04 errors");
  CHECK(verdict(comparison_of({6, 6, 0.25}, {6.751, 0})) == "differs: +0.751, 3.004 errors");
  CHECK(verdict(comparison_of({6, 6, 0}, {4.5, 0})) == "-");
  CHECK(verdict({}) == "-");
}

TEST_CASE("one value for all families is judged by their scatter") {
  Comparison row;
  row.misfit = Misfit{5.2, 2};
  CHECK(verdict(row) == "one value for all");
  row.misfit = Misfit{5.4, 2};
  CHECK(verdict(row) == "not one value for all");
  row.measured.estimate = {6.5, 0.4};
  row.published.range = comparison_of({6, 6, 0.3}, {}).published.range;
  CHECK(verdict(row) == "not one value for all; agrees: +0.50, 1.0 errors");
  row.measured.not_determined = "has 1";
  CHECK(verdict(row) == "-");
}

TEST_CASE("each family is set beside the values published of it") {
  const std::vector<Row> sweep = wall_sweep_of_three_families();
  const auto rows = compare_with(reference(), analyse(sweep));
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].title == "Z without walls (bi-periodic)");
  CHECK(rows[0].measured.estimate.value == Approx(6.0));
  CHECK(*difference_in_errors(rows[0]) ==
        Approx(-0.027 / std::hypot(rows[0].measured.estimate.error, 0.012)));
  CHECK(rows[2].title == "Z at W = 10 d");
  CHECK(verdict(rows[2]).starts_with("differs: +1.70"));
  CHECK(rows[3].family == "all families");
  CHECK(verdict(rows[3]) == "one value for all");
}

TEST_CASE("the table names both values, the verdict, the definitions and what is left out") {
  const std::vector<Row> sweep = wall_sweep_of_three_families();
  const std::string text = comparison_text(reference(), analyse(sweep));
  CHECK_THAT(text,
             Catch::Contains("  Z without walls (bi-periodic)               6.027 ± 0.012        "
                             "6.000 ± 0.020  agrees: -0.027, 1.2 errors\n"
                             "      here: neighbours per grain from 3 d above the floor"));
  CHECK_THAT(text, Catch::Contains("      published: in words\n"));
  CHECK_THAT(text, !Catch::Contains("Nothing is published"));  // one value is of all families
  Reference of_one = reference();
  of_one.common.clear();
  CHECK_THAT(comparison_text(of_one, analyse(sweep)),
             Catch::Contains("Nothing is published there of\n  MSP small_share=0.25"));
  CHECK_THAT(text, Catch::Contains("Not in the sweep: shape=\"pinacoid\""));
}

TEST_CASE("what a sweep lacks is not determined and never a number") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 5.4), settled_row("b", 6, 0.61, 5.5)};
  const Analysis analysis = analyse(rows);
  for (const Comparison& row : compare_with(reference(), analysis)) {
    INFO(row.title);
    CHECK_FALSE(row.measured.not_determined.empty());
    CHECK_FALSE(difference_in_errors(row));
  }
  CHECK(comparison_text(reference(), analysis).find("nan") == std::string::npos);
}

TEST_CASE("of a family that is not in the sweep the table says what the sweep has instead") {
  Reference other_share;
  other_share.families = {{{{"sizes.small_share", "0.3"}}, {}}};
  const std::vector<Row> sweep = wall_sweep_of_three_families();
  CHECK_THAT(comparison_text(other_share, analyse(sweep)),
             Catch::Contains("\nNot in the sweep: sizes.small_share=0.3\n"
                             "  the sweep has sizes.small_share 0.0, 0.25"));
  Reference of_ratio;
  of_ratio.families = {{{{"sizes.size_ratio", "0.3"}}, {}}};
  CHECK_THAT(comparison_text(of_ratio, analyse(sweep)), !Catch::Contains("the sweep has"));
}

TEST_CASE("of a family that is described by its width the table says what to write instead") {
  Reference by_width;
  by_width.families = {{{{"box.width", "5.0"}}, {}}};
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 5.4)};
  CHECK_THAT(comparison_text(by_width, analyse(rows)),
             Catch::Contains("\nNot in the sweep: box.width=5.0\n"
                             "  a family has packings of any box.width: leave it out of "));
}

TEST_CASE("what tubes have at a width is told to be at a D") {
  std::vector<Row> rows = wall_sweep();
  std::erase_if(rows, [](const Row& row) { return row.job.box.y == Boundary::periodic; });
  for (Row& row : rows) row.job.box = tube_of(row.job.box.width);
  const std::string text = comparison_text(reference(), analyse(rows));
  CHECK_THAT(text, Catch::Contains("  Z at D = 10 d ") && Catch::Contains("line in 1/D over 3"));
  CHECK_THAT(text, !Catch::Contains("W = ") && !Catch::Contains("1/W"));
}

Reference with_formula(const std::string& text, double from = 0.0, double to = 1e9,
                       double error = 0.0, const std::string& quantity = "phi") {
  Reference reference;
  reference.source = "Source";
  const PublishedFormula formula{text, text, from, to, {error}};
  reference.families = {{{}, {{quantity, 0, text, std::nullopt, "by hand", formula}}}};
  return reference;
}

TEST_CASE("a formula is set beside every width where it holds") {
  const std::vector<Row> sweep = wall_sweep();  // on the line 0.64 - 0.2 / W
  const auto rows = compare_with(with_formula("0.63 - 0.2/W", 4, 10), analyse(sweep));
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].title == "φ");
  REQUIRE(rows[0].along.size() == 2);
  CHECK(rows[0].along[0].published.width == 5);
  CHECK(rows[0].along[1].published.width == 10);
  for (const Comparison& at : rows[0].along) CHECK(*difference(at) == Approx(0.01));
}

/// Of packings whose means have no bound of their bias.
std::vector<Row> without_bound(std::vector<Row> rows) {
  for (Row& row : rows) row.job.kind.reset();
  return rows;
}

TEST_CASE("the table says at how many widths a formula agrees, and how far it is off") {
  const std::vector<Row> sweep = without_bound(wall_sweep());
  const auto text_of = [&](const Reference& reference) {
    return comparison_text(reference, analyse(sweep));
  };
  CHECK_THAT(
      text_of(with_formula("0.64 - 0.2/W")),
      Catch::Contains("  0.64 - 0.2/W\n      agrees at 3 of 3 widths; here minus published: "
                      "0.0000 in the mean, ") &&
          Catch::Contains(
              "\n      published: by hand\n      here, at W = 20 d: exact solid volume from "));
  CHECK_THAT(text_of(with_formula("0.64 - 0.3/W")),
             Catch::Contains("agrees at 0 of 3 widths; here minus published: +0.0117 in the mean, "
                             "+0.0050 at W = 20 d to +0.0200 at W = 5 d\n"));
  CHECK_THAT(text_of(with_formula("0.64 - 0.3/W", 0, 1e9, 0.02)),
             Catch::Contains("agrees at 3 of 3 widths"));
  CHECK_THAT(
      text_of(with_formula("0.64 - 0.3/W", 18, 20)),
      Catch::Contains("agrees at 0 of 1 width; here minus published: +0.0050 at W = 20 d\n"));
  CHECK_THAT(
      text_of(with_formula("0.64 - 0.2/W", 30, 40)),
      Catch::Contains("not determined: this family has no packings at a W where it holds\n"));
  CHECK_THAT(
      text_of(with_formula("0.4 + d/D")),
      Catch::Contains("not determined: this family has no packings at a D where it holds\n"));
}

TEST_CASE("widths where a formula has no number, or no share of a volume, are told") {
  const std::vector<Row> sweep = wall_sweep();
  const auto text_of = [&](const std::string& formula, const std::string& quantity) {
    return comparison_text(with_formula(formula, 0, 1e9, 0, quantity), analyse(sweep));
  };
  CHECK_THAT(text_of("0.6 + 0*sqrt(W - 7)", "phi"),
             Catch::Contains("of 2 widths, no value at 1 more; here minus published: "));
  CHECK_THAT(text_of("1.5 - 10/W", "porosity"),  // -0.5, 0.5 and 1
             Catch::Contains("of 2 widths, no value at 1 more; here minus published: "));
  CHECK_THAT(text_of("60 - 1/W", "phi"),
             Catch::Contains("not determined: at no W where it holds are both the formula's value "
                             "and the measured one known\n"));
}

TEST_CASE("single packings are set beside a formula, too, without a verdict") {
  std::vector<Row> rows;
  for (const double width : {5.0, 10.0}) {
    rows.push_back(settled_row(std::to_string(rows.size()), width, 0.6, 5));
  }
  CHECK_THAT(comparison_text(with_formula("0.59 + 0/W"), analyse(rows)),
             Catch::Contains("no error is known at any width; here minus published: +0.0100 in the "
                             "mean, "));
  CHECK_THAT(comparison_text(with_formula("5 + 0/W", 0, 1e9, 0, "reach"), analyse(rows)),
             Catch::Contains("not determined: at no W"));
}

TEST_CASE("a width without a measured value is left out of a formula's row") {
  std::vector<Row> sweep = wall_sweep();
  sweep.push_back(settled_row("alone", 7, 0.6, 5));
  sweep.back().outcome->result.status = PackingStatus::not_settled;
  const auto rows = compare_with(with_formula("0.64 - 0.2/W"), analyse(sweep));
  CHECK(rows[0].along.size() == 3);
  CHECK(rows[0].without_value == 1);
  CHECK(rows[0].measured.not_determined.empty());
}

/// Spheres between walls 10 d apart, whose profile of phi has these points in a file.
Reference with_profile(const std::vector<PublishedProfile::Point>& points, double width = 10.0) {
  Reference reference;
  const PublishedProfile profile{"Curve", "", points, {0.01}};
  reference.families = {{{}, {{"phi", width, "Curve", std::nullopt, "by hand", {}, profile}}}};
  return reference;
}

TEST_CASE("a published profile is set beside the measured one, point by point") {
  const std::vector<Row> sweep = wall_sweep();
  // Bins of 0.1 d with layers of 0.3 exp(-y / 1.4 d) cos(7 y), scattered by 0.001 / 2.
  const auto layers = [](double y) { return 0.6 + 0.3 * std::exp(-y / 1.4) * std::cos(7 * y); };
  const auto rows = compare_with(
      with_profile({{0.25, layers(0.25)}, {1.05, layers(1.05) + 0.2}, {5.5, 0.6}}), analyse(sweep));
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].title == "profile of φ at W = 10 d");
  REQUIRE(rows[0].along.size() == 2);
  CHECK(rows[0].without_value == 1);  // beyond the middle
  CHECK(rows[0].along[1].distance == 1.05);
  constexpr double scatter = 0.003;  // three of a mean of two halves of two packings, and more
  CHECK(*difference(rows[0].along[0]) == Approx(0.0).margin(scatter));
  CHECK(*difference(rows[0].along[1]) == Approx(-0.2).margin(scatter));
  CHECK(rows[0].along[0].published.range->error == 0.01);
  CHECK(rows[0].group == 2);
  const std::string verdict_text = verdict(rows[0]);
  CHECK_THAT(verdict_text, Catch::StartsWith("agrees at 1 of 2 points, no value at 1 more; here "
                                             "minus published: -0.") &&
                               Catch::Contains(" root mean square, -0.") &&
                               Catch::EndsWith(" at 0.25 d from the wall"));
  const std::string text = comparison_text(with_profile({{0.25, 0.5}}), analyse(sweep));
  CHECK_THAT(text, Catch::Contains("  profile of φ at W = 10 d") &&
                       Catch::Contains("here, at 0.25 d from the wall: exact solid volume, in bins "
                                       "0.1 d wide"));
}

TEST_CASE("a published profile of a width that no packing has is not determined") {
  const std::vector<Row> sweep = wall_sweep();
  const auto rows = compare_with(with_profile({{0.25, 0.5}}, 7.0), analyse(sweep));
  CHECK(rows[0].along.empty());
  CHECK(rows[0].group == 0);
  CHECK_THAT(comparison_text(with_profile({{0.25, 0.5}}, 7.0), analyse(sweep)),
             Catch::Contains("not determined: this family has no packings between walls at W = 7 "
                             "d\n"));
}

TEST_CASE("a formula of a profile is set beside those of all widths, unless it has one") {
  const std::vector<Row> sweep = wall_sweep();
  Reference reference = with_profile({}, 0.0);
  Published& value = reference.families[0].values[0];
  value.profile->formula = "0.6 + 0.3*exp(-y/1.4)*cos(7*y)";
  const auto rows = compare_with(reference, analyse(sweep));
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].title == "profile of φ at W = 5 d");
  CHECK(rows[2].title == "profile of φ at W = 20 d");
  CHECK(rows[2].along.size() == 200);
  CHECK(rows[2].published.profile->points.size() == 200);
  // Halfway between the middles of bins 0.1 d wide a line misses a wave of 0.9 d by 0.04 of it.
  for (const Comparison& at : rows[2].along) CHECK(std::abs(*difference(at)) < 0.04 * 0.3 + 0.003);
  value.width = 10.0;
  CHECK(compare_with(reference, analyse(sweep)).size() == 1);
  value.profile->formula = "2 + y";
  CHECK_THAT(comparison_text(reference, analyse(sweep)),
             Catch::Contains("not determined: the formula has no value that phi can be\n"));
}

TEST_CASE("values that differ by no more than the bound of settling agree, which is said") {
  Comparison row = comparison_of({0.6, 0.6, 0}, {0.602, 0.0001});
  CHECK(verdict(row) == "differs: +0.00200, 20.0 errors");
  row.measured.bias_bound = 0.0018;
  CHECK(verdict(row) == "agrees within the bound of settling, 0.0018: +0.00200, 20.0 errors");
  row.measured.bias_bound = 0.0016;
  CHECK(verdict(row) == "differs: +0.00200, 20.0 errors");
  const std::vector<Row> sweep = wall_sweep();  // of spheres at `balanced`: 0.0020
  const std::string bounded = comparison_text(with_formula("0.6452 - 0.2/W"), analyse(sweep));
  CHECK_THAT(bounded, Catch::Contains("agrees at 3 of 3 widths, at ") &&
                          Catch::Contains(" of them within the bound of settling; here minus "
                                          "published: -0.0052 in the mean"));
  const std::vector<Row> unknown = without_bound(sweep);
  CHECK_THAT(comparison_text(with_formula("0.6452 - 0.2/W"), analyse(unknown)),
             !Catch::Contains("agrees at 3 of 3 widths"));
}

}  // namespace
}  // namespace grainsweep
