#include <cmath>

#include <catch2/catch.hpp>

#include "runner/tables/families.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

// Student's quantiles 0.975 of 2 degrees of freedom and of 1: 4.30265, 12.7062.
TEST_CASE("mean, standard deviation and error of known values") {
  const Spread spread = spread_of(std::vector<double>{1, 2, 4});
  CHECK(spread.mean == Approx(7.0 / 3.0));
  CHECK(spread.sd == Approx(std::sqrt(7.0 / 3.0)));
  CHECK(spread.n == 3);
  CHECK(spread.error == Approx(std::sqrt(7.0) / 3.0 * 4.30265 / 1.959964));
}

TEST_CASE("one value has a mean but no scatter, none has neither") {
  CHECK(spread_of(std::vector<double>{5}).mean == 5.0);
  CHECK(std::isnan(spread_of(std::vector<double>{5}).sd));
  CHECK(std::isnan(spread_of(std::vector<double>{}).mean));
  CHECK(std::isnan(spread_of(std::vector<double>{5}).error));
}

TEST_CASE("packings that do not know a value leave its mean to the others") {
  const Spread spread = spread_of({1, std::nan(""), 3});
  CHECK(spread.mean == 2.0);
  CHECK(spread.n == 2);
  CHECK(spread.error == Approx(12.7062 / 1.959964));
}

TEST_CASE("replicates form a group, only the settled ones enter its means") {
  Row pending = settled_row("d", 5, 0.9, 9);
  pending.outcome.reset();
  const std::vector<Row> rows = {settled_row("a", 5, 0.60, 5.8),
                                 settled_row("x", 6, 0.7, 7),
                                 settled_row("b", 5, 0.62, 6.0),
                                 row_with_status("c", 5, PackingStatus::not_settled, "moves"),
                                 row_with_status("e", 5, PackingStatus::failed, "no room"),
                                 pending};
  const auto groups = groups_of(rows);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].job.box.width == 5);
  CHECK(mean_of(groups[0], "solid_fraction").mean == Approx(0.61));
  CHECK(mean_of(groups[0], "solid_fraction").sd == Approx(0.02 / std::sqrt(2.0)));
  CHECK(mean_of(groups[0], "coordination").mean == Approx(5.9));
  CHECK(mean_of(groups[0], "coordination_with_walls").mean == Approx(6.15));
  CHECK(mean_of(groups[0], "contact_ratio").mean == Approx(5990.0 / 5991.0));
  CHECK(groups[0].counts.settled == 2);
  CHECK(groups[0].counts.not_settled == 1);
  CHECK(groups[0].counts.failed == 1);
  CHECK(groups[0].counts.pending == 1);
}

TEST_CASE("a group without a settled packing takes no error from the others of its family") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.60, 5.8), settled_row("b", 5, 0.62, 6.0),
                                 row_with_status("c", 6, PackingStatus::not_settled, "moves")};
  const auto groups = groups_of(rows);
  REQUIRE(groups.size() == 2);
  CHECK(mean_of(groups[0], "solid_fraction").degrees_of_freedom == 1);
  CHECK(std::isnan(mean_of(groups[1], "solid_fraction").error));
  CHECK(mean_of(groups[1], "solid_fraction").degrees_of_freedom == 0);
}

TEST_CASE("how shapes touch and point is averaged over the replicates, spheres have nothing") {
  Row first = polyhedra_row("a", 5), second = polyhedra_row("b", 5);
  second.outcome->result.shape_order->nematic[2] = 0.25;
  const std::vector<Row> rows = {first, second}, spheres = {settled_row("a", 5, 0.6, 6)};
  const auto groups = groups_of(rows);
  REQUIRE(groups.size() == 1);
  CHECK(mean_of(groups[0], "contacts_simple").mean == 0.5);
  CHECK(mean_of(groups[0], "contacts_simple").sd == 0.0);
  CHECK(mean_of(groups[0], "nematic_z").mean == 0.5);
  CHECK(mean_of(groups[0], "nematic_z").sd == Approx(0.5 / std::sqrt(2.0)));
  CHECK(cell_in(groups_csv(groups), 1, "nematic_z_sd") == "0.3535533905932738");
  CHECK(std::isnan(mean_of(groups_of(spheres)[0], "contacts_simple").mean));
}

TEST_CASE("packings of different labels are different groups") {
  Row other = settled_row("b", 5, 0.62, 6.0);
  other.job.label = "again";
  const std::vector<Row> rows = {settled_row("a", 5, 0.60, 5.8), other};
  CHECK(groups_of(rows).size() == 2);
}

TEST_CASE("groups have the mean coordination at every gap tolerance, with its error") {
  Row first = settled_row("a", 5, 0.6, 5.75), second = settled_row("b", 5, 0.6, 6.25);
  Row other = settled_row("c", 6, 0.6, 6.0);
  other.job.parameters = R"({"a":6})";
  for (Row* row : {&first, &second}) {
    row->job.measure.gap_tolerances = {1e-4, 1e-3};
    std::vector<Coordination>& list = row->outcome->result.coordination;
    list.push_back(list.front());
    list.back().gap_tolerance = 1e-3;
    list.back().between_grains += 0.5;
  }
  const std::vector<Row> rows = {first, second, other};
  const std::string text = groups_csv(analyse(rows).groups);
  CHECK(cell_in(text, 1, "coordination_at_0.001") == "6.5");
  CHECK(cell_in(text, 1, "coordination_at_0.001_sd") == "0.3535533905932738");
  CHECK(std::stod(cell_in(text, 1, "coordination_at_0.001_error")) ==
        Approx(spread_of({6.25, 6.75}).error));
  CHECK(cell_in(text, 2, "coordination_at_0.001").empty());
  CHECK(further_tolerances(analyse(rows).groups) == std::vector<double>{1e-5, 1e-3, 6e-3});
}

TEST_CASE("the groups table as a whole") {
  Row first = settled_row("a", 5, 0.5, 5.75), second = settled_row("b", 5, 0.75, 6.25);
  Row third = row_with_status("c", 6, PackingStatus::not_settled, "moves");
  for (Row* row : {&first, &second, &third}) {
    row->job.parameters = row->job.box.width == 5 ? R"({"a":5})" : R"({"a":6,"b":1})";
    row->outcome->result.rest.contacts = row->outcome->result.rest.isostatic_contacts;
  }
  const std::vector<Row> rows = {first, second, third};
  const std::string text = groups_csv(analyse(rows).groups);
  CHECK_THAT(text,
             Catch::StartsWith("group,family,job,label,shape,length,width,boundary_x,"
                               "boundary_y,small_share,accuracy,n,not_settled,failed,pending,"
                               "solid_fraction,solid_fraction_sd,solid_fraction_error,") &&
                 Catch::Contains("\n1,MSP a=5,a,MSP,sphere,20,5,periodic,walls,0,balanced,2,0,"
                                 "0,0,0.625,0.1767766952966369,0.8103595803545127,6,") &&
                 Catch::Contains("\n2,MSP a=6 b=1,c,MSP,sphere,20,6,periodic,walls,0,balanced,"
                                 "0,1,0,0,,,,"));
  CHECK(cells_of_table(text).size() == 3);
  CHECK(cell_in(text, 1, "contact_ratio") == "1");
  CHECK(cell_in(text, 1, "parameters") == R"("{""a"":5}")");
  CHECK(cell_in(text, 1, "solid_fraction_bias_bound") ==
        cell(bias_bound(first.job)->solid_fraction));
  CHECK(cell_in(text, 1, "coordination_bias_bound") == cell(bias_bound(first.job)->coordination));
  CHECK((cell_in(text, 1, "b").empty() && cell_in(text, 2, "b") == "1"));
}

TEST_CASE("groups have means of the number of grains and the height of the surface") {
  Row first = settled_row("a", 5, 0.5, 5.75), second = settled_row("b", 5, 0.75, 6.25);
  second.outcome->result.grains = 2002;
  second.outcome->result.surface_height = 16.5;
  const std::vector<Row> rows = {first, second};
  const std::string text = groups_csv(analyse(rows).groups);
  CHECK(cell_in(text, 1, "grains") == "2001");
  CHECK(cell_in(text, 1, "grains_sd") == cell(std::sqrt(2.0)));
  CHECK(cell_in(text, 1, "surface_height") == "16");
  CHECK(cell_in(text, 1, "surface_height_sd") == cell(std::sqrt(0.5)));
}

TEST_CASE("numbers of a family's parameters are written as those of its packings") {
  JobFacts job;
  job.parameters = std::string(
      R"({"accuracy":{"gap":1e-04,"list":[0.5,1e-06,3]},"box":{"length":20,"width":5,"y":"walls"}})");
  CHECK(parameters_of_family(job) ==
        R"({"accuracy":{"gap":1e-04,"list":[0.5,1e-06,3]},"box":{"length":20}})");
}

TEST_CASE("what a sweep varies has its unit, and no column in another one") {
  std::vector<Row> rows = {settled_row("a", 5, 0.6, 6), settled_row("b", 5, 0.61, 6)};
  rows[0].job.parameters = R"({"sizes":{"distribution":{"table":{"diameters":[0.5,1,1.4]}}}})";
  rows[1].job.parameters = R"({"sizes":{"distribution":{"lognormal":{"median":1.1}}}})";
  const std::vector<Group> groups = groups_of(rows);
  const Units millimetres = {10.0, "mm", {}};
  const std::string text = groups_csv(groups, millimetres);
  CHECK(cell_in(text, 2, "sizes.distribution.lognormal.median") == "1.1");
  CHECK_THAT(text, !Catch::Contains("median_mm") && !Catch::Contains("diameters_mm"));
  for (const auto& column : groups_columns({}, varied_of(groups), millimetres)) {
    if (column.name == "sizes.distribution.lognormal.median") CHECK(column.unit == "d");
  }
}

TEST_CASE("values without effect are known as such, unless only they tell groups apart") {
  const auto row = [](const std::string& id, const char* ratio, const char* share) {
    Row one = settled_row(id, 5, 0.6, 5.5);
    one.job.parameters = std::string(R"({"sizes":{"size_ratio":)") + ratio + R"(,"small_share":)" +
                         share + R"(,"spread":0.03}})";
    return one;
  };
  std::vector<Row> rows = {row("a", "0.5", "0.0"), row("b", "0.7", "0.25")};
  std::vector<Group> groups = groups_of(rows);
  CHECK(groups[0].idle == std::set<std::string>{"sizes.size_ratio"});
  CHECK(groups[1].idle.empty());
  rows.push_back(row("c", "0.7", "0.0"));
  groups = groups_of(rows);
  CHECK(groups[0].idle.empty());
  CHECK(groups[2].idle.empty());
  for (Row& one : rows) one.job.parameters = R"({"fill":{"file":"0a"},"sizes":{"spread":0.03}})";
  CHECK(idle_parameters(rows[0].job) == std::set<std::string>{"sizes.spread"});
}

TEST_CASE("coordination numbers that are the same are exact only in ordered packings") {
  std::vector<Row> rows;
  const auto add = [&](double width, double phi, double scatter, double z, double scatter_of_z) {
    for (const int sign : {-1, 1}) {
      const std::string id = std::to_string(rows.size());
      rows.push_back(settled_row(id, width, phi + sign * scatter, z + sign * scatter_of_z));
    }
  };
  add(3, 0.47, 1e-9, 2.0, 0.0);  // a single file
  add(4, 0.55, 1e-3, 5.0, 0.0);  // by chance
  add(5, 0.56, 2e-3, 5.2, 0.05);
  add(6, 0.57, 1e-3, 5.4, 0.04);
  add(7, 0.58, 2e-3, 5.5, 0.06);
  const std::vector<Group> groups = groups_of(rows);
  CHECK(mean_of(groups[0], "coordination").error < 1e-9);
  CHECK(why_no_error(mean_of(groups[0], "coordination")).empty());
  CHECK(mean_of(groups[1], "coordination").error > 0.01);
}

TEST_CASE("packings of one state have the error of where the slab cuts their layers") {
  const auto error_of = [](double scatter, double scatter_of_z) {
    std::vector<Row> rows;
    for (const int sign : {-1, 1}) {
      rows.push_back(
          settled_row(std::to_string(sign), 1.3, 0.45 + sign * scatter, 2.0 + sign * scatter_of_z));
      PackingResult& result = rows.back().outcome->result;
      result.grains = 100;
      result.slab_bottom = 3.0, result.slab_top = 8.0;
    }
    return mean_of(groups_of(rows).at(0), "solid_fraction").error;
  };
  CHECK(error_of(1e-6, 0.0) == Approx(0.45 / (9.0 * 5.0)).epsilon(1e-6));
  const double disordered = error_of(2e-5, 0.01);
  CHECK(disordered < 1e-3);
  CHECK(error_of(2e-5, 0.0) == Approx(std::hypot(disordered, 0.01)));
  CHECK(error_of(0.0, 0.0) == 0.0);  // copies
}

TEST_CASE("jobs of square ducts and of others are of the same families as their groups") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0}) {
    rows.push_back(settled_row(std::to_string(width), width, 0.6, 6));
    rows.back().job.box.x = Boundary::walls;
    rows.back().job.box.length = width;
    rows.back().job.parameters = R"({"box":{"length":)" + std::to_string(width) + R"(,"width":)" +
                                 std::to_string(width) + R"(,"x":"walls"}})";
  }
  rows.push_back(settled_row("c", 5, 0.6, 6));
  const std::vector<Group> groups = groups_of(rows);
  const auto families = parameters_of_families({rows[0].job, rows[1].job, rows[2].job});
  CHECK(families[0] == families[1]);
  CHECK(families[2] == parameters_of_family(rows[2].job));
  for (std::size_t k = 0; k < groups.size(); ++k) CHECK(groups[k].family == families[k]);
  CHECK(groups[1].is_of_squares);
  CHECK_FALSE(groups[2].is_of_squares);
}

TEST_CASE("a mean is asked for by the name of its field") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 6)};
  const auto groups = groups_of(rows);
  CHECK(mean_of(groups[0], "solid_fraction").mean == 0.6);
  CHECK_THROWS_AS(mean_of(groups[0], "steps"), std::out_of_range);
}

}  // namespace
}  // namespace grainsweep
