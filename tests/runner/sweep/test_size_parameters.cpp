#include <catch2/catch.hpp>

#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

using Messages = std::vector<std::string>;

/// The distribution of the one job of a sweep of these parameters.
SizeDistribution distribution_in(const std::string& sizes) {
  const auto jobs = jobs_of(R"({"name": "t", "base": {"sizes": {"distribution": )" + sizes + "}}}");
  REQUIRE(jobs.size() == 1);
  return jobs.front().spec.sizes.distribution.value();
}

Messages errors_in(const std::string& sizes) {
  return errors_of("{\"name\": \"t\", \"base\":\n{\"sizes\": " + sizes + "}}");
}

TEST_CASE("each formula is read, with its usual values where parts are left out") {
  const auto lognormal = distribution_in(R"({"lognormal": {"sigma": 0.2}, "by": "number"})");
  CHECK(std::get<LognormalSizes>(lognormal.formula).median == 1.0);
  CHECK(std::get<LognormalSizes>(lognormal.formula).sigma == 0.2);
  CHECK(lognormal.by == SizeWeight::number);
  const auto uniform = distribution_in(R"({"uniform": {"from": 0.7, "to": 1.1}, "by": "area"})");
  CHECK(std::get<UniformSizes>(uniform.formula).to == 1.1);
  CHECK(uniform.by == SizeWeight::area);
  const auto weibull = distribution_in(R"({"weibull": {"shape": 2}, "smallest": 0.2})");
  CHECK(std::get<WeibullSizes>(weibull.formula).shape == 2.0);
  CHECK(weibull.by == SizeWeight::volume);
  CHECK(weibull.smallest == 0.2);
  CHECK_FALSE(weibull.largest);
  const auto table = distribution_in(R"({"table": {"diameters": [0.5, 2], "passing": [0, 1]}})");
  CHECK(std::get<SizeTable>(table.formula).diameters == std::vector<double>{0.5, 2});
}

TEST_CASE("all diameters are brought to units of d by the length that is d") {
  const auto median = [](const SizeDistribution& d) {
    return std::get<LognormalSizes>(d.formula).median;
  };
  const auto sieves = distribution_in(R"({"lognormal": {"median": 3}, "largest": 8, "size": 4})");
  CHECK(median(sieves) == 0.75);
  CHECK(sieves.largest == 2.0);
  const auto uniform = distribution_in(R"({"uniform": {"from": 2, "to": 6}, "size": 4})");
  CHECK(std::get<UniformSizes>(uniform.formula).from == 0.5);
  CHECK(std::get<UniformSizes>(uniform.formula).to == 1.5);
  const auto weibull = distribution_in(R"({"weibull": {"scale": 2}, "size": 4, "largest": 4})");
  CHECK(std::get<WeibullSizes>(weibull.formula).scale == 0.5);
  const auto table =
      distribution_in(R"({"table": {"diameters": [2, 8], "shares": [0.5, 0.5]}, "size": 4})");
  CHECK(std::get<SizeTable>(table.formula).diameters == std::vector<double>{0.5, 2});
}

TEST_CASE("a table from a file is the same packing as its numbers, and other numbers another one") {
  const ScratchFolder folder;
  folder.write("a.csv", "diameter,passing\n1,0\n4,1\n");
  folder.write("b.csv", "x,diameter,passing\n0,4,1\n0,1,0\n");
  folder.write("c.csv", "diameter,passing\n1,0\n3,1\n");
  const auto job_of = [&](const std::string& table) {
    const auto reading = read_sweep(
        folder.write("s.json", R"({"name": "t", "base": {"sizes.distribution": {"table": )" +
                                   table + R"(, "size": 2}}})"));
    REQUIRE(reading.sweep.jobs.size() == 1);
    return reading.sweep.jobs.front();
  };
  const Job a = job_of(R"({"file": "a.csv"})");
  CHECK(std::get<SizeTable>(a.spec.sizes.distribution->formula).diameters ==
        std::vector<double>{0.5, 2});
  CHECK(a.files.at("sizes.distribution.table.file") == "a.csv");
  CHECK(a.id == job_of(R"({"file": "b.csv"})").id);
  CHECK(a.id != job_of(R"({"file": "c.csv"})").id);
  const Job inline_table = job_of(R"({"diameters": [1, 4], "passing": [0, 1]})");
  CHECK_THAT(inline_table.parameters.text(),
             Catch::Contains(R"("table":{"diameters":[0.5,2],"passing":[0,1]}})"));
}

TEST_CASE("a distribution in another unit is the same job") {
  const auto id = [](const std::string& sizes) {
    return jobs_of(R"({"name": "t", "base": {"sizes": )" + sizes + "}}").at(0).id;
  };
  CHECK(id(R"({"distribution": {"uniform": {"from": 1, "to": 3}, "size": 2}})") ==
        id(R"({"distribution": {"uniform": {"from": 0.5, "to": 1.5}, "by": "volume"}})"));
}

TEST_CASE("another layer replaces a distribution, or the classes, and keeps what holds for both") {
  const auto jobs = jobs_of(sweep_of(
      R"({"label": "w", "set": {"sizes.distribution.weibull.shape": 4}},
         {"label": "c", "set": {"sizes.small_share": 0.5}})",
      R"({"sizes.distribution": {"lognormal": {"sigma": 0.1}, "by": "number"}})"));
  REQUIRE(jobs.size() == 2);
  const auto& weibull = jobs[0].spec.sizes.distribution.value();
  CHECK(std::get<WeibullSizes>(weibull.formula).shape == 4.0);
  CHECK(weibull.by == SizeWeight::number);
  CHECK_FALSE(jobs[1].spec.sizes.distribution);
  CHECK(jobs[1].spec.sizes.small_share == 0.5);
}

TEST_CASE("a curve without parts has its defaults, and those that are written elsewhere") {
  const std::string lognormal = R"({"sizes.distribution": {"lognormal": {}}})";
  const auto jobs = jobs_of(sweep_of(
      R"({}, {"label": "b", "set": {"sizes.distribution.lognormal": {}},
              "grid": {"sizes.distribution.lognormal.median": [2, 1.5]}},
         {"label": "c", "set": {"sizes.distribution": {"weibull": {}}}})",
      lognormal));
  REQUIRE(jobs.size() == 4);
  const auto curve_of = [](const Job& job) { return job.spec.sizes.distribution.value().formula; };
  CHECK(std::get<LognormalSizes>(curve_of(jobs[0])).median == 1.0);
  CHECK(std::get<LognormalSizes>(curve_of(jobs[0])).sigma == 0.3);
  CHECK(std::get<LognormalSizes>(curve_of(jobs[1])).median == 2.0);
  CHECK(std::get<WeibullSizes>(curve_of(jobs[3])).shape == 3.0);
  CHECK(std::get<LognormalSizes>(
            curve_of(jobs_of(sweep_of(R"({"set": {"sizes.distribution.lognormal": {}}})",
                                      R"({"sizes.distribution.lognormal.median": 1.25})"))[0]))
            .median == 1.25);
}

TEST_CASE("what is wrong with a distribution is told where it is written") {
  CHECK(errors_in(R"({"distribution": {"by": "number"}})") ==
        Messages{"s.json:2:35 /base/sizes/distribution/by: belongs to a distribution of sizes, and "
                 "none is set: write lognormal, uniform, weibull or table"});
  CHECK(errors_in(R"({"distribution": {"table": {}}})") ==
        Messages{"s.json:2:38 /base/sizes/distribution/table: describes no sizes; name at "
                 "least one of "
                 "diameters, passing, shares, file"});
  CHECK(errors_in(R"({"distribution": {"lognormal": {"sigma": 3}}})") ==
        Messages{"s.json:2:52 /base/sizes/distribution/lognormal/sigma: lognormal.sigma must lie "
                 "in [0, 2], is 3"});
  CHECK(errors_in(R"({"distribution": {"uniform": {"to": 1}}, "spread": 0})") ==
        Messages{"s.json:2:62 /base/sizes/spread: the sizes are already described at "
                 "/base/sizes/distribution/uniform/to; keep one: two classes, or one distribution, "
                 "lognormal, uniform, weibull, or table by lists or file"});
  CHECK(errors_in(R"({"distribution": {"table": {"file": "none.csv"}}})").size() == 1);
}

TEST_CASE("what is wrong with a table from a file is told at its line, or at the file") {
  const ScratchFolder folder;
  folder.write("sieves.csv", "diameter,passing\n0.9,0\n2,20\n4,100\n");
  const Diagnostics errors =
      read_sweep(folder.write("s.json", R"({"name": "t", "base": {"sizes.distribution":
                                        {"size": 2, "table": {"file": "sieves.csv"}, "by": "area"}}})"))
          .errors;
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].place == folder.path("sieves.csv") + ":4");
  CHECK_THAT(errors[0].message, Catch::Contains("divide percentages by 100"));
  folder.write("sieves.csv", "diameter,share\n0.9,0.5\n2,0.7\n");
  const Diagnostics of_all = read_sweep(folder.path("s.json")).errors;
  REQUIRE(of_all.size() == 1);
  CHECK(of_all[0].place == folder.path("sieves.csv") + ":1");  // where the column is named
  CHECK(of_all[0].message == "the numbers of column share must add up to 1, add up to 1.2");
}

TEST_CASE("sizes of a laboratory beside units, without their unit, are worth a note") {
  const ScratchFolder folder;
  folder.write("sieves.csv", "diameter,passing\n0.9,0\n2,0.2\n4,1\n");
  const auto notes = [&](const std::string& distribution, const std::string& units) {
    const SweepReading reading = read_sweep(folder.write(
        "s.json",
        R"({"name": "t", )" + units + R"("base": {"sizes.distribution": )" + distribution + "}}"));
    CHECK(reading.sweep.jobs.size() == 1);  // with a note or without
    return reading.notes;
  };
  const std::string units = R"("units": {"d": 3.2, "unit": "mm"}, )";
  const Diagnostics said = notes(R"({"table": {"file": "sieves.csv"}})", units);
  REQUIRE(said.size() == 1);
  CHECK(said[0].pointer == "/base/sizes.distribution/table/file");
  CHECK(said[0].message ==
        "diameters count as d, which is 3.2 mm; if they are in mm, set "
        "sizes.distribution.size to 3.2");
  CHECK(notes(R"({"table": {"file": "sieves.csv"}, "size": 3.2})", units).empty());
  CHECK(notes(R"({"table": {"file": "sieves.csv"}})", "").empty());
  CHECK(notes(R"({"table": {"file": "sieves.csv"}})", R"("units": {"d": 1, "unit": "mm"}, )")
            .empty());
  const Diagnostics of_list =
      notes(R"({"table": {"diameters": [0.5, 4], "passing": [0, 1]}})", units);
  REQUIRE(of_list.size() == 1);
  CHECK(of_list[0].pointer == "/base/sizes.distribution/table/diameters");
  CHECK(of_list[0].message == said[0].message);
  CHECK(notes(R"({"lognormal": {"median": 1.2}})", units).size() == 1);
  CHECK(notes(R"({"uniform": {"from": 0.5, "to": 2}})", units).size() == 1);
  CHECK(notes(R"({"weibull": {"scale": 1, "shape": 5}})", units).empty());  // as by default
  CHECK(notes(R"({"lognormal": {"sigma": 0.2}})", units).empty());
}

TEST_CASE("that diameters count as d is said once for all values of a list") {
  const ScratchFolder folder;
  const SweepReading reading =
      read_sweep(folder.write("s.json",
                              R"({"name": "t", "units": {"d": 2, "unit": "mm"}, "sweep": [{"grid": {
          "sizes.distribution.lognormal.median": [0.9, 1.1, 1.2]}}]})"));
  CHECK(reading.sweep.jobs.size() == 3);
  REQUIRE(reading.notes.size() == 1);
  CHECK(reading.notes[0].pointer == "/sweep/0/grid/sizes.distribution.lognormal.median/0");
}

}  // namespace
}  // namespace grainsweep
