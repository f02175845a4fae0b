#include <string>

#include <catch2/catch.hpp>

#include "runner/sweep/read_replicates.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

/// The first job of a sweep whose file says this of its replicates.
Job job_with(const std::string& replicates) {
  const auto reading = reading_of(R"({"name": "r", "replicates": )" + replicates + "}");
  REQUIRE(reading.errors.empty());
  return reading.sweep.jobs.at(0);
}

TEST_CASE("a fit is asked for by the names of the line's parts, in place of means") {
  const FitWish wish = job_with(R"({"until": {"fit":
      {"phi_bulk": 0.25, "C": 0.5, "Z_bulk": 0.125, "C_Z": 1}}})")
                           .fit_wish;
  CHECK(wish.phi_bulk == 0.25);
  CHECK(wish.c == 0.5);
  CHECK(wish.z_bulk == 0.125);
  CHECK(wish.c_z == 1.0);
  CHECK_FALSE(job_with(R"({"until": {"fit": {"C": 0.5}}})").wish.is_given());
  CHECK_FALSE(job_with(R"({"until": {"coordination": 0.5}})").fit_wish.is_given());
}

TEST_CASE("points that grow have so many packings at most, others just as many") {
  const auto count = [](const std::string& replicates) {
    return reading_of(R"({"name": "r", "replicates": )" + replicates + "}").sweep.jobs.size();
  };
  CHECK(count(R"({"until": {"fit": {"C": 0.5}}})") == usual_most_replicates);
  CHECK(count(R"({"until": {"coordination": 0.5}, "most": 17})") == 17);
  CHECK(count("5") == 5);
}

TEST_CASE("points without walls have as many packings beside a fit as all have at first") {
  const auto count = [](const std::string& replicates) {
    return reading_of(R"({"name": "r", "base": {"box": {"y": "periodic"}}, "replicates": )" +
                      replicates + "}")
        .sweep.jobs.size();
  };
  CHECK(count(R"({"until": {"fit": {"C": 0.5}}})") == first_replicates);
  CHECK(count(R"({"until": {"fit": {"C": 0.5}}, "most": 3})") == 3);
  CHECK(count(R"({"until": {"coordination": 0.5}})") == usual_most_replicates);
}

TEST_CASE("a block asks for its own errors, or for those of the sweep") {
  const auto reading = reading_of(R"({"name": "r", "replicates": {"until": {"fit": {"C": 0.5}}},
      "sweep": [{"set": {"box.width": 5}},
                {"set": {"box.width": 6}, "replicates": {"until": {"fit": {"C": 0.25}}}},
                {"set": {"box.width": 7}, "replicates": 2}]})");
  REQUIRE(reading.errors.empty());
  const auto& jobs = reading.sweep.jobs;
  REQUIRE(jobs.size() == 2 * usual_most_replicates + 2);
  CHECK(jobs.front().fit_wish.c == 0.5);
  CHECK(jobs.at(usual_most_replicates).fit_wish.c == 0.25);
  CHECK_FALSE(jobs.back().fit_wish.is_given());
}

}  // namespace
}  // namespace grainsweep
