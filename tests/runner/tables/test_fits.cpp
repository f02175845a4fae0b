#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <random>
#include <string>

#include <catch2/catch.hpp>

#include "runner/analysis/moderated.hpp"
#include "runner/tables/fits.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

/// Two replicates at W on the line .64 - .2 / W and 6.1 - 3 / W, `scatter` above and below it.
void add_width(std::vector<Row>& rows, double width, double scatter) {
  const double phi = 0.64 - 0.2 / width, z = 6.1 - 3.0 / width;
  const std::string id = std::to_string(rows.size());
  rows.push_back(settled_row("a" + id, width, phi - scatter, z - 10 * scatter));
  rows.push_back(settled_row("b" + id, width, phi + scatter, z + 10 * scatter));
}

Family family_of(const std::vector<Row>& rows) { return families_of(groups_of(rows)).at(0); }

TEST_CASE("the planted wall effect is recovered with the errors of its replicates") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0, 20.0}) add_width(rows, width, 0.001);
  const WallFit fit = fit_walls(family_of(rows), Quantity::solid_fraction);
  REQUIRE(fit.not_determined.empty());
  CHECK(fit.bulk.value == Approx(0.64));
  CHECK(fit.slope.value == Approx(0.2));
  CHECK(fit.zeta.value == Approx(0.2 / 0.64));
  CHECK(fit.widths == 4);
  CHECK(fit.packings == 8);
  CHECK(
      fit.weights ==
      "variance times volume of the slab of the replicates and of others of the family (4 degrees "
      "of freedom)");
  // Each mean has sd sqrt(2) .001 and error .001; x = .25, .2, .1, .05: S_xx = .025, x_m = .15.
  CHECK(fit.slope.error == Approx(widened(0.001, 4) / std::sqrt(0.025)));
  CHECK(fit.bulk.error == Approx(widened(0.001, 4) * std::sqrt(0.25 + 0.0225 / 0.025)));
  CHECK(fit.chi2_per_dof == Approx(0.0).margin(1e-20));
  const WallFit z = fit_walls(family_of(rows), Quantity::coordination);
  CHECK(z.bulk.value == Approx(6.1));
  CHECK(z.slope.value == Approx(3.0));
}

// zeta = C / b is a function of two correlated parameters; its error must be what a small shift of
// all points along the parameters' error ellipse does to it. With C = r b, var(zeta) follows from
// s^2 / b^2 + C^2 e^2 / b^4 + 2 C cov(s, b) / b^3, where C = -s.
TEST_CASE("the error of zeta takes the correlation of slope and bulk into account") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0, 20.0}) add_width(rows, width, 0.001);
  const WallFit fit = fit_walls(family_of(rows), Quantity::solid_fraction);
  const double covariance =
      -0.15 / 0.025 * std::pow(widened(0.001, 4), 2);  // of slope and intercept
  const double variance = std::pow(fit.slope.error / 0.64, 2) +
                          std::pow(0.2 * fit.bulk.error / (0.64 * 0.64), 2) +
                          2 * 0.2 / std::pow(0.64, 3) * covariance;
  CHECK(fit.zeta.error == Approx(std::sqrt(variance)));
  const double naive = std::hypot(fit.slope.error / 0.64, 0.2 * fit.bulk.error / (0.64 * 0.64));
  CHECK(fit.zeta.error < naive);
}

TEST_CASE("a width with one packing takes its error from the others' replicates") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0}) add_width(rows, width, 0.001);
  rows.push_back(settled_row("single", 20, 0.630, 5.95));
  const WallFit fit = fit_walls(family_of(rows), Quantity::solid_fraction);
  REQUIRE(fit.not_determined.empty());
  CHECK(
      fit.weights ==
      "variance times volume of the slab of the replicates and of others of the family (3 degrees "
      "of freedom)");
  REQUIRE(fit.points.size() == 4);
  CHECK(fit.points[0].error == Approx(widened(0.001, 3)));  // sd sqrt(2) .001 of two
  CHECK(fit.points[3].error == Approx(widened(0.001 * std::sqrt(2.0), 3)));
  CHECK(fit.points[3].n == 1);
}

/// The variance of a width with `degrees` of its own, beside what others say of it.
double beside(double pooled, double own, int degrees) {
  return (usual_likeness * pooled + degrees * own) / (usual_likeness + degrees);
}

TEST_CASE("the variance of a width is its own and that of the others, by degrees of freedom") {
  std::vector<Row> rows;
  add_width(rows, 4, 0.001);                             // two packings, variance 2e-6
  add_width(rows, 5, 0.003), add_width(rows, 5, 0.003);  // four, variance 4 * 9e-6 / 3 = 12e-6
  add_width(rows, 10, 0.001);
  const WallFit fit = fit_walls(family_of(rows), Quantity::solid_fraction);
  const double pooled = (1 * 2e-6 + 3 * 12e-6 + 1 * 2e-6) / 5;
  CHECK(fit.points[0].error == Approx(widened(std::sqrt(beside(pooled, 2e-6, 1) / 2), 5)));
  CHECK(fit.points[1].error == Approx(widened(std::sqrt(beside(pooled, 12e-6, 3) / 4), 5)));
}

TEST_CASE("packings scatter as the root of one over the volume of their slabs") {
  std::vector<Row> rows;
  add_width(rows, 4, 0.002);  // two packings, variance 8e-6
  add_width(rows, 5, 0.001);
  add_width(rows, 10, 0.001);
  add_width(rows, 10, 0.001);                                    // four, variance 4 * 1e-6 / 3
  const double usual = rows[0].job.box.floor_area() * 47.5 / 4;  // d^3
  const auto stretch = [](Row& row, double times) {
    PackingResult& result = row.outcome->result;
    result.slab_top = result.slab_bottom + times * (result.slab_top - result.slab_bottom);
  };
  for (Row& row : rows) {
    if (row.job.box.width == 4) stretch(row, 0.25);
  }
  stretch(rows[2], 0.5), stretch(rows[3], 1.5);  // the mean counts
  const WallFit fit = fit_walls(family_of(rows), Quantity::solid_fraction);
  const double pooled = (1 * 8e-6 * 0.25 + 1 * 2e-6 + 3 * 4e-6 / 3) / 5;  // times usual
  const double narrow = beside(pooled, 2e-6, 1), wide = beside(pooled, 4e-6 / 3, 3);
  CHECK(fit.points[0].error == Approx(widened(std::sqrt(narrow / 0.25 / 2), 5)));
  CHECK(fit.points[1].error == Approx(widened(std::sqrt(narrow / 2), 5)));
  CHECK(fit.points[2].error == Approx(widened(std::sqrt(wide / 4), 5)));
  CHECK(groups_of(rows).at(0).slab_volume == Approx(usual / 4));
  CHECK(groups_of(rows).at(1).slab_volume == Approx(usual));
}

TEST_CASE("copies of one packing are no replicates: they determine nothing") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0}) add_width(rows, width, 0.0);
  CHECK(fit_walls(family_of(rows), Quantity::solid_fraction).not_determined ==
        "the replicates do not scatter, as copies or packings of one possible state: they tell no "
        "error");
}

TEST_CASE("a line that misses its points says so and is known no better than it misses them") {
  std::vector<Row> rows, straight;
  for (const double width : {4.0, 5.0, 10.0, 20.0}) {
    add_width(straight, width, 0.001);
    add_width(rows, width, 0.001);
    for (std::size_t k = rows.size() - 2; k < rows.size(); ++k) {
      rows[k].outcome->result.solid_fraction += width == 10.0 ? 0.01 : 0.0;
    }
  }
  const WallFit fit = fit_walls(family_of(rows), Quantity::solid_fraction);
  const WallFit before = fit_walls(family_of(straight), Quantity::solid_fraction);
  CHECK(before.doubt.empty());
  CHECK(fit.chi2_per_dof > 13.2);  // of two degrees of freedom, with errors known from four
  CHECK(fit.doubt == "the straight line does not hold");
  std::vector<Row> near = straight;  // chi^2 goes as the square of the miss
  for (Row& row : near) {
    const double miss = 0.01 * std::sqrt(13.0 / fit.chi2_per_dof);
    row.outcome->result.solid_fraction += row.job.box.width == 10.0 ? miss : 0.0;
  }
  const WallFit hardly = fit_walls(family_of(near), Quantity::solid_fraction);
  CHECK(hardly.chi2_per_dof == Approx(13.0));
  CHECK(hardly.doubt.empty());
  CHECK(fit.bulk.error == Approx(before.bulk.error * std::sqrt(fit.chi2_per_dof)));
  CHECK(fit.slope.error == Approx(before.slope.error * std::sqrt(fit.chi2_per_dof)));
  // That of zeta follows from theirs, whose covariance is x_m / S_xx of the points' variance.
  const double bulk = fit.bulk.value, slope = fit.slope.value;
  const double covariance = -0.15 * fit.slope.error * fit.slope.error;
  CHECK(fit.zeta.error == Approx(std::sqrt(std::pow(fit.slope.error / bulk, 2) +
                                           std::pow(slope * fit.bulk.error / (bulk * bulk), 2) +
                                           2 * slope / std::pow(bulk, 3) * covariance)));
  CHECK_THAT(fits_csv(families_of(groups_of(rows))),
             Catch::Contains("MSP,solid_fraction,determined,the straight line does not hold,4,8,"));
}

// One width with two packings that agree to 1e-8, by chance or as single files do, knows its error
// from one degree of freedom: of the line's misfit nearly anything could be chance.
TEST_CASE("a width whose error is hardly known does not excuse a line that misses the others") {
  std::vector<Row> rows;
  for (const double width : {5.0, 6.0, 8.0, 12.0, 20.0}) {
    for (int k = 0; k < 3; ++k) add_width(rows, width, 0.001);
    for (std::size_t k = rows.size() - 6; k < rows.size(); ++k) {
      rows[k].outcome->result.solid_fraction += width == 12.0 ? 0.003 : 0.0;
    }
  }
  add_width(rows, 16, 1e-8);
  const WallFit fit = fit_walls(family_of(rows), Quantity::solid_fraction);
  CHECK_THAT(fit.weights, Catch::Contains("(1 to "));
  CHECK(fit.chi2_per_dof < 500.0);  // F(4, 1) exceeds 535 once in 200 times
  CHECK(fit.doubt == "the straight line does not hold");
  CHECK(fit.scatter > 0.001);
  CHECK(fit.bulk.value == about(0.64, 0.003));
}

TEST_CASE("a line through narrow containers is in doubt even where it meets its points") {
  const auto doubt = [](std::initializer_list<double> widths, Boundary x) {
    std::vector<Row> rows;
    for (const double width : widths) add_width(rows, width, 0.001);
    for (Row& row : rows) row.job.box.x = x;
    return fit_walls(family_of(rows), Quantity::solid_fraction).doubt;
  };
  CHECK(doubt({4, 5, 6}, Boundary::periodic).empty());
  CHECK_THAT(doubt({3.9, 5, 6}, Boundary::periodic), Catch::Contains("narrow containers"));
  CHECK(doubt({5, 6, 8}, Boundary::walls).empty());
  CHECK_THAT(doubt({4.9, 6, 8}, Boundary::walls), Catch::Contains("narrow containers"));
}

TEST_CASE("the line leaves out narrow containers where three others are left") {
  std::vector<Row> rows, wide;
  for (const double width : {4.0, 5.0, 8.0}) add_width(wide, width, 0.001);
  for (const double width : {2.0, 3.0}) add_width(rows, width, 0.05);
  rows.insert(rows.end(), wide.begin(), wide.end());
  const Family family = family_of(rows);
  const WallFit fit = fit_walls(family, Quantity::solid_fraction);
  const WallFit of_wide = fit_walls(family_of(wide), Quantity::solid_fraction);
  CHECK(fit.widths == 3);
  CHECK(fit.narrow_widths == 2);
  CHECK(of_wide.narrow_widths == 0);
  CHECK(fit.points.size() == 3);
  CHECK(fit.packings == of_wide.packings);
  CHECK(fit.bulk.value == Approx(of_wide.bulk.value));
  CHECK(fit.doubt.empty());
  CHECK(left_out_text(fit) == "2 narrow widths left out (W < 4 d, ducts and tubes < 5 d)");
  rows.pop_back();  // of two, the other of which may settle
  rows.pop_back();
  const WallFit of_two_others = fit_walls(family_of(rows), Quantity::solid_fraction);
  CHECK(of_two_others.narrow_widths == 0);
  CHECK(of_two_others.widths == 4);
  CHECK_THAT(of_two_others.doubt, Catch::Contains("narrow") || Catch::Contains("does not hold"));
}

/// A sweep as users make it: five widths and one without walls, three replicates of each, on known
/// lines with normal noise.
std::vector<Row> noisy_sweep(std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  std::vector<Row> rows;
  const auto add = [&](double width, double phi, double z, Boundary y) {
    for (int k = 0; k < 3; ++k) {
      rows.push_back(settled_row(std::to_string(rows.size()), width,
                                 phi + 0.001 * normal(generator), z + 0.02 * normal(generator), y));
    }
  };
  for (const double width : {4.0, 5.0, 6.0, 8.0, 12.0}) {
    add(width, 0.64 - 0.2 / width, 6.1 - 3.0 / width, Boundary::walls);
  }
  add(12.0, 0.64, 6.1, Boundary::periodic);
  return rows;
}

// Values within two printed errors of the truth: 95 % of them, were errors known exactly. Those of
// means come from 12 degrees of freedom, for which Student's t has 93.1 %; widening keeps fits at
// 95 to 97 %. Shares of 1000 sweeps are known to 0.7 %.
TEST_CASE("planted walls and means lie within two printed errors as often as they must") {
  std::mt19937_64 generator(41);
  const int sweeps = 1000;
  std::map<std::string, int> hits;
  const auto judge = [&](const std::string& name, double value, double error, double truth) {
    hits[name] += std::abs(value - truth) < 2.0 * error ? 1 : 0;
  };
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Row> rows = noisy_sweep(generator);
    const Family family = family_of(rows);
    const WallFit phi = fit_walls(family, Quantity::solid_fraction);
    const WallFit z = fit_walls(family, Quantity::coordination);
    judge("phi_bulk", phi.bulk.value, phi.bulk.error, 0.64);
    judge("C", phi.slope.value, phi.slope.error, 0.2);
    judge("zeta", phi.zeta.value, phi.zeta.error, 0.2 / 0.64);
    judge("Z_bulk", z.bulk.value, z.bulk.error, 6.1);
    judge("C_Z", z.slope.value, z.slope.error, 3.0);
    judge("zeta_Z", z.zeta.value, z.zeta.error, 3.0 / 6.1);
    const Spread& widest = mean_of(family.walled.back(), "solid_fraction");
    judge("phi at W = 12", widest.mean, widest.error, 0.64 - 0.2 / 12.0);
    const Spread& periodic = mean_of(family.periodic.front(), "coordination");
    judge("Z without walls", periodic.mean, periodic.error, 6.1);
  }
  for (const auto& [name, count] : hits) {
    INFO(name);
    CHECK(count / double(sweeps) == about(0.95, 0.03));
  }
}

TEST_CASE("the points of a fit have their residuals in both units") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0, 20.0}) add_width(rows, width, 0.001);
  rows.push_back(settled_row("p", 20, 0.6390, 6.05, Boundary::periodic));
  const auto families = analyse(rows).families;
  const std::string text = fit_points_csv(families);
  CHECK(std::count(text.begin(), text.end(), '\n') == 1 + 8);
  CHECK(text.starts_with(
      "group,family,job,label,boundary_y,small_share,box.width,box.y,quantity,width,n,mean,error,"
      "fitted,residual,residual_in_errors\n1,MSP,a0,MSP,walls,0,4,walls,solid_fraction,4,2,"));
  CHECK(cell_in(text, 1, "error") ==
        cell_in(groups_csv(groups_of(rows)), 1, "solid_fraction_error"));
  const FitPoint point = fit_walls(families.at(0), Quantity::solid_fraction).points.at(2);
  CHECK(point.width == 10);
  CHECK(point.fitted == Approx(0.62));
  CHECK(point.mean == Approx(0.62));
}

TEST_CASE("fewer than three widths determine nothing") {
  std::vector<Row> rows;
  for (const double width : {4.0, 10.0}) add_width(rows, width, 0.001);
  rows.push_back(row_with_status("u", 20, PackingStatus::not_settled, "moves"));
  CHECK(fit_walls(family_of(rows), Quantity::solid_fraction).not_determined ==
        "needs settled packings at 3 or more widths with otherwise equal parameters, has 2");
}

TEST_CASE("one replicate at every width determines nothing") {
  std::vector<Row> rows;
  for (const double width : {4.0, 10.0, 20.0}) {
    rows.push_back(settled_row(std::to_string(width), width, 0.6, 6));
  }
  CHECK(fit_walls(family_of(rows), Quantity::solid_fraction).not_determined ==
        "needs 2 or more settled replicates to know the error");
}

TEST_CASE("an unsettled packing never moves the line") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0}) add_width(rows, width, 0.001);
  const double before = fit_walls(family_of(rows), Quantity::solid_fraction).bulk.value;
  rows.push_back(row_with_status("u", 10, PackingStatus::not_settled, "moves"));
  CHECK(fit_walls(family_of(rows), Quantity::solid_fraction).bulk.value == before);
}

TEST_CASE("the table of a family that determines no fit has a reason and no numbers") {
  Row row = settled_row("a", 5, 0.6, 6);
  row.job.parameters = R"({"box":{"width":5}})";
  const std::vector<Row> rows = {row};
  CHECK(fits_csv(families_of(groups_of(rows))) ==
        "family,quantity,status,reason,widths,packings,weights,bulk,bulk_error,C,C_error,zeta,"
        "zeta_error,bulk_bias_bound,chi2_per_dof,scatter,degrees_of_freedom,r_squared,"
        "biperiodic_width,biperiodic_mean,biperiodic_sd,biperiodic_n,narrow_widths,parameters\n"
        "MSP,solid_fraction,not determined,\"needs settled packings at 3 or more widths with "
        "otherwise equal parameters, has 1\",1,1,,,,,,,,,,,,,,,,,0,\"{\"\"box\"\":{}}\"\n"
        "MSP,coordination,not determined,\"needs settled packings at 3 or more widths with "
        "otherwise equal parameters, has 1\",1,1,,,,,,,,,,,,,,,,,0,\"{\"\"box\"\":{}}\"\n");
}

TEST_CASE("the table of a fit has the periodic value beside it") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0, 20.0}) add_width(rows, width, 0.001);
  rows.push_back(settled_row("p", 20, 0.6390, 6.05, Boundary::periodic));
  const std::string text = fits_csv(families_of(groups_of(rows)));
  CHECK_THAT(
      text,
      Catch::Contains("MSP,solid_fraction,determined,,4,8,variance times volume of the slab of the "
                      "replicates and of others of the family (4 degrees of freedom),0.64"));
  CHECK_THAT(text, Catch::Contains(",20,0.639,,1,"));
  CHECK_THAT(text, Catch::Contains(",20,6.05,,1,"));
  CHECK(cell_in(text, 1, "bulk_bias_bound") == cell(bias_bound(rows[0].job)->solid_fraction));
  CHECK(cell_in(text, 2, "bulk_bias_bound") == cell(bias_bound(rows[0].job)->coordination));
  for (std::size_t k = 0; k < 2; ++k) rows[k].job.settles_as = "custom";  // those of one width
  const std::string unbounded = fits_csv(families_of(groups_of(rows)));
  CHECK(cell_in(unbounded, 1, "bulk_bias_bound").empty());
}

TEST_CASE("a bulk value that contradicts the measured one is in doubt") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0}) add_width(rows, width, 0.001);
  const Estimate bulk = fit_walls(family_of(rows), Quantity::solid_fraction).bulk;
  const auto doubt_beside = [&](double periodic) {
    std::vector<Row> all = rows;
    for (const char* const id : {"p", "q"}) {
      const double miss = *id == 'p' ? 0.0005 : -0.0005;
      all.push_back(settled_row(id, 20, periodic + miss, 6.05, Boundary::periodic));
    }
    return fit_walls(family_of(all), Quantity::solid_fraction).doubt;
  };
  CHECK(doubt_beside(bulk.value).empty());
  CHECK(doubt_beside(bulk.value - 2.0 * bulk.error).empty());
  CHECK(doubt_beside(bulk.value - 5.0 * bulk.error) ==
        "bulk and periodic value differ by more than their errors: too few or too narrow widths");
}

TEST_CASE("a line of ducts that keep walls along x does not lead to the value without walls") {
  std::vector<Row> rows;
  for (const double width : {6.0, 8.0, 16.0}) add_width(rows, width, 0.001);
  for (const char* const id : {"p", "q"}) {
    rows.push_back(settled_row(id, 20, *id == 'p' ? 0.5995 : 0.6005, 6.05, Boundary::periodic));
  }
  CHECK(!fit_walls(family_of(rows), Quantity::solid_fraction).doubt.empty());
  Family ducts = family_of(rows);
  for (Group& group : ducts.walled) group.job.box.x = Boundary::walls;
  CHECK(ducts.unconfined);
  CHECK(fit_walls(ducts, Quantity::solid_fraction).doubt.empty());
  for (Group& group : ducts.walled) group.job.box.length = group.job.box.width;
  CHECK(!fit_walls(ducts, Quantity::solid_fraction).doubt.empty());
}

TEST_CASE("what has walls along x only is no value without walls") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0, 10.0, 20.0}) add_width(rows, width, 0.001);
  rows.push_back(settled_row("p", 20, 0.5890, 5.31, Boundary::periodic));
  for (Row& row : rows) row.job.box.x = Boundary::walls;
  const std::string text = fits_csv(families_of(groups_of(rows)));
  CHECK_THAT(cell_in(text, 1, "bulk"), Catch::StartsWith("0.64"));
  CHECK(cell_in(text, 1, "biperiodic_mean").empty());
}

}  // namespace
}  // namespace grainsweep
