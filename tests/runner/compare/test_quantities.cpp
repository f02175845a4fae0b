#include <cmath>
#include <tuple>

#include <catch2/catch.hpp>

#include "runner/analysis/moderated.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/tables/closing_report.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/fits.hpp"
#include "runner/text.hpp"
#include "tests/runner/compare/wall_sweep.hpp"

namespace grainsweep {
namespace {

/// They refer to the rows.
std::vector<Family> families_in(const std::vector<Row>& rows) {
  return families_of(groups_of(rows));
}

TEST_CASE("every quantity of a whole sweep has the value that was planted") {
  const std::vector<Row> rows = wall_sweep();
  const Family family = families_in(rows).at(0);
  const auto value = [&](const std::string& quantity, double width = 0) {
    const Measured measured = measure_quantity(quantity, width, family);
    INFO(quantity << measured.not_determined);
    CHECK(measured.not_determined.empty());
    CHECK(std::isfinite(measured.estimate.error));
    CHECK_FALSE(measured.definition.empty());
    return measured.estimate.value;
  };
  CHECK(value("phi_unconfined") == Approx(0.64));
  CHECK(value("Z_unconfined") == Approx(6.0));
  CHECK(value("phi_bulk") == Approx(0.64));
  CHECK(value("C") == Approx(0.2));
  CHECK(value("Z_bulk") == Approx(6.0));
  CHECK(value("C_Z") == Approx(3.0));
  CHECK(value("zeta_difference") == Approx(3 / 6.0 - 0.2 / 0.64));
  CHECK(value("phi", 5) == Approx(0.6));
  CHECK(value("Z", 10) == Approx(5.7));
  // The layers have a noise of .001, which moves their length by far less than 5 %.
  CHECK(value("lambda_by_number", 10) == Approx(1.4 / 0.5).epsilon(0.05));
  CHECK(value("lambda_by_volume", 10) == Approx(1.4 / 0.8).epsilon(0.05));
  CHECK(value("lambda_over_C", 10) == Approx(7.0).epsilon(0.05));
  CHECK(value("reach", 10) == Approx(1.4 * std::log(0.3 / (0.05 * 0.6))).epsilon(0.05));
  for (const char* quantity : {"reach", "lambda_by_number", "lambda_over_C"}) {
    CHECK_THAT(measure_quantity(quantity, 10, family).definition, Catch::Contains(", misfit "));
  }
  CHECK(value("Z_drop", 10) == Approx(1.4));
  CHECK(value("Z_drop_width", 10) == Approx(1.0));
}

TEST_CASE("a porosity is what its solid fraction leaves, with the same error") {
  const std::vector<Row> rows = wall_sweep();
  const Family family = families_in(rows).at(0);
  for (const auto& [of_pores, of_solid, width] :
       {std::tuple{"porosity_unconfined", "phi_unconfined", 0.0},
        std::tuple{"porosity_bulk", "phi_bulk", 0.0}, std::tuple{"porosity", "phi", 5.0}}) {
    INFO(of_pores);
    const Measured porosity = measure_quantity(of_pores, width, family);
    const Measured phi = measure_quantity(of_solid, width, family);
    CHECK(porosity.estimate.value == 1.0 - phi.estimate.value);
    CHECK(porosity.estimate.error == phi.estimate.error);
    CHECK(porosity.definition == "1 - φ; " + phi.definition);
  }
  CHECK(measure_quantity("porosity", 99, family).not_determined ==
        measure_quantity("phi", 99, family).not_determined);
  CHECK(title_of_quantity("porosity", 5, "D") == "porosity at D = 5 d");
}

TEST_CASE("the error of a mean is that of its variance, moderated by the others of the family") {
  const std::vector<Row> rows = wall_sweep();
  const Family family = families_in(rows).at(0);
  const Measured z = measure_quantity("Z_unconfined", 0, family);
  // Four groups of two, .02 or .04 apart: variances 3 x 2e-4 and its own 8e-4, pooled 3.5e-4.
  const double variance = (usual_likeness * 3.5e-4 + 8e-4) / (usual_likeness + 1);
  CHECK(z.estimate.error == Approx(widened(std::sqrt(variance / 2), 4)));
  CHECK_THAT(z.definition, Catch::Contains("walls not counted") && Catch::Contains("1.000"));
}

TEST_CASE("groups of one width that differ in their label have one mean over all packings") {
  std::vector<Row> rows = wall_sweep();
  const double usual = measure_quantity("phi", 5, families_in(rows).at(0)).estimate.value;
  for (int k = 0; k < 4; ++k) {
    rows.push_back(settled_row("more" + std::to_string(k), 5, usual + 0.03 + 1e-3 * (k % 2), 5.4));
    rows.back().job.label = "again";
  }
  const Measured phi = measure_quantity("phi", 5, families_in(rows).at(0));
  CHECK(phi.estimate.value == Approx(usual + 4.0 / 6.0 * 0.0305));  // of two packings and four
  CHECK_THAT(phi.definition, Catch::EndsWith("; mean over the packings of 2 groups"));
  const Family family = families_in(rows).at(0);
  double squares = 0.0;
  for (const Group& group : family.walled) {
    if (group.job.box.width != 5) continue;
    const double error = mean_of(group, "solid_fraction").error;
    squares += std::pow(static_cast<double>(group.counts.settled) * error, 2);
  }
  CHECK(phi.estimate.error == Approx(std::sqrt(squares) / 6.0));
}

TEST_CASE("the bin in the middle of a gap tells no more for being in both of its halves") {
  std::vector<Row> rows;
  for (const double shift : {-0.01, 0.01}) {
    rows.push_back(settled_row(std::to_string(rows.size()), 3, 0.6, 5));
    rows.back().outcome->result.profile_y = {
        1.0,
        {{0.5 + shift, 0, 1, 0, 2, 3}, {0.6 + shift, 0, 1, 0, 2, 3}, {0.4 + shift, 0, 1, 0, 2, 3}}};
  }
  const auto phi = measure_profile("phi", 3, {0.5, 1.0, 1.5}, families_in(rows).at(0)).values;
  const double error = spread_of({0.49, 0.51}).error;
  CHECK(phi[0].estimate.error == Approx(error / std::sqrt(2.0)));
  CHECK(phi[1].estimate.value == Approx((0.45 + 0.6) / 2.0));
  CHECK(phi[1].estimate.error == Approx(error / 2.0 / std::sqrt(2.0) + error / 2.0));
  CHECK(phi[2].estimate.value == Approx(0.6));
  CHECK(phi[2].estimate.error == Approx(error));
}

TEST_CASE("a profile is linear between the middles of bins, the mean of both halves of a gap") {
  std::vector<Row> rows;
  for (const double shift : {-0.01, 0.01}) {
    rows.push_back(settled_row(std::to_string(rows.size()), 2, 0.6, 5));
    // Middles at 0.25, 0.75, 1.25 and 1.75 d; no grain has its centre in the second bin.
    rows.back().outcome->result.profile_y = {0.5,
                                             {{0.2 + shift, 0, 1, 0, 2, 3},
                                              {0.6 + shift, 0, 0, 0, 0, 0},
                                              {0.5 + shift, 0, 2, 0, 8, 8},
                                              {0.4 + shift, 0, 1, 0, 4, 4}}};
  }
  const auto values_of = [&](const std::string& quantity, const std::vector<double>& distances) {
    return measure_profile(quantity, 2, distances, families_in(rows).at(0)).values;
  };
  const auto phi = values_of("phi", {0.1, 0.25, 0.5, 0.75, 1.0, 1.1});
  const std::vector<double> expected = {0.3, 0.425, 0.55, 0.55};  // of 0.2 .. 0.6, 0.5 .. 0.4
  for (std::size_t k = 1; k <= expected.size(); ++k) {
    INFO(k);
    CHECK(phi[k].not_determined.empty());
    CHECK(phi[k].estimate.value == Approx(expected[k - 1]));
    CHECK(phi[k].estimate.error == Approx(spread_of({0.19, 0.21}).error / std::sqrt(2.0)));
  }
  CHECK(phi[0].not_determined ==
        "it lies nearer to the wall than the middle of the first bin, 0.25 d; measure.bin_width "
        "sets their width");
  CHECK(phi[5].not_determined == "it lies beyond the middle");
  CHECK(values_of("porosity", {0.5})[0].estimate.value == Approx(1 - 0.425));
  CHECK(values_of("Z", {0.25})[0].estimate.value == Approx(3));  // 2 and 4
  CHECK(values_of("Z", {0.5})[0].not_determined == "no grain has its centre there");
  for (Row& row : rows) {
    row.job.box = tube_of(2);
    row.outcome->result.profile_from_walls = row.outcome->result.profile_y;
  }
  CHECK(values_of("phi", {0.5})[0].estimate.value == Approx(0.4));  // from the only wall
  const auto nowhere = measure_profile("phi", 3, {0.5}, families_in(rows).at(0));
  CHECK(nowhere.group == nullptr);
  CHECK(nowhere.values[0].not_determined == "this family has no packings in tubes at D = 3 d");
}

TEST_CASE("a line that misses its points says that it does not hold") {
  const auto definition = [](const std::vector<Row>& rows) {
    return measure_quantity("C", 0, families_in(rows).at(0)).definition;
  };
  auto rows = wall_sweep();
  CHECK_THAT(definition(rows), !Catch::Contains("does not hold"));
  for (Row& row : rows) {
    if (row.job.box.width == 10) row.outcome->result.solid_fraction += 0.05;
  }
  CHECK_THAT(definition(rows), Catch::Contains("the straight line does not hold"));
}

TEST_CASE("the closing table, fits.csv and compare tell one value and one error of a fit") {
  auto rows = wall_sweep();
  for (const double miss : {0.0, 0.05}) {  // on the line, and far off it
    for (Row& row : rows) {
      if (row.job.box.width == 10) row.outcome->result.solid_fraction += miss;
    }
    const auto families = families_in(rows);
    const std::string fits = fits_csv(families);
    const std::string report = closing_report({}, rows, families, {"./run.sh", "out"});
    const auto expect = [&](const char* name, std::size_t line, const std::string& column,
                            const std::string& symbol, int decimals) {
      INFO(name << ", off the line by " << miss);
      const Estimate compared = measure_quantity(name, 0, families.at(0)).estimate;
      CHECK(cell_in(fits, line, column) == cell(compared.value));
      CHECK(cell_in(fits, line, column + "_error") == cell(compared.error));
      CHECK_THAT(report, Catch::Contains(symbol + " = " +
                                         with_error(compared.value, compared.error, decimals)));
    };
    expect("phi_bulk", 1, "bulk", "φ_bulk", 4);
    expect("C", 1, "C", "C", 3);
    expect("Z_bulk", 2, "bulk", "Z_bulk", 3);
    expect("C_Z", 2, "C", "C_Z", 2);
  }
}

TEST_CASE("families that share one value show it, and others that they do not") {
  auto rows = wall_sweep_of_three_families();
  const Shared shared = share_quantity("lambda_over_C", 10, families_in(rows));
  REQUIRE(shared.measured.not_determined.empty());
  CHECK(std::abs(shared.measured.estimate.value - 7) < 3 * shared.measured.estimate.error);
  CHECK(may_hold(shared.misfit));
  double chi2 = 0.0;
  for (const Family& family : families_in(rows)) {
    const Estimate ratio = measure_quantity("lambda_over_C", 10, family).estimate;
    chi2 += std::pow((ratio.value - shared.measured.estimate.value) / ratio.error, 2);
    const Estimate lambda = measure_quantity("lambda_by_number", 10, family).estimate;
    const Estimate c = measure_quantity("C", 0, family).estimate;
    CHECK(ratio.error / ratio.value ==
          Approx(std::hypot(lambda.error / lambda.value, c.error / c.value)));
  }
  CHECK(shared.misfit.degrees_of_freedom == 2);
  CHECK(shared.misfit.chi2_per_dof == Approx(chi2 / 2));
  CHECK_FALSE(may_hold(share_quantity("C", 0, families_in(rows)).misfit));
  CHECK(share_quantity("C", 0, families_in(wall_sweep())).measured.not_determined ==
        "needs it of 3 or more families, has 1");
}

TEST_CASE("what a sweep lacks is not determined, with the reason") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 5.4), settled_row("b", 6, 0.61, 5.5)};
  const Family family = families_in(rows).at(0);
  const auto reason = [&](const std::string& quantity, double width = 0) {
    return measure_quantity(quantity, width, family).not_determined;
  };
  CHECK(reason("phi", 5) == "needs 2 or more settled replicates to know the error");
  CHECK(reason("phi", 10) == "this family has no packings between walls at W = 10 d");
  CHECK(reason("phi", 5.5) == "this family has no packings between walls at W = 5.5 d");
  CHECK(reason("Z_unconfined") == "the sweep has no settled packing of these grains without walls");
  CHECK_THAT(reason("C"), Catch::Contains("3 or more widths"));
  CHECK_THAT(reason("zeta_difference"), Catch::Contains("3 or more widths"));
  CHECK_THAT(reason("lambda_by_number", 5), Catch::Contains("2 or more settled replicates"));
  CHECK_THAT(reason("Z_drop", 5), Catch::Contains("9 d or more"));
}

// 3.2 d: where layers of two walls 5 d apart overlap.
TEST_CASE("a reach beyond the middle is not determined, although its decay length is") {
  const std::vector<Row> rows = wall_sweep();
  const Family family = families_in(rows).at(0);
  CHECK(measure_quantity("lambda_by_number", 5, family).not_determined.empty());
  CHECK_THAT(measure_quantity("reach", 5, family).not_determined,
             Catch::Contains("only beyond the middle, 2.5 d from the wall"));
}

TEST_CASE("unknown quantities and widths that do not belong are told") {
  CHECK(fault_of_quantity("Z", 10).empty());
  CHECK_THAT(fault_of_quantity("zeta", 0),
             Catch::Contains("unknown quantity \"zeta\"") && Catch::Contains("zeta_difference"));
  CHECK(fault_of_quantity("Phi", 5) == "unknown quantity \"Phi\"; did you mean \"phi\"?");
  CHECK(fault_of_quantity("Z", 0) == "Z needs a \"width\"");
  CHECK(fault_of_quantity("C", 5) == "C belongs to no \"width\"");
  CHECK(title_of_quantity("Z", 10, "W") == "Z at W = 10 d");
}

}  // namespace
}  // namespace grainsweep
