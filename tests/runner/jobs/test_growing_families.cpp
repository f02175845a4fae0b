#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/jobs/growing_families.hpp"
#include "tests/runner/jobs/growing_sweeps.hpp"

namespace grainsweep {
namespace {

std::vector<Job> of_seed(std::uint64_t seed, double width, ErrorWish wish, int most = 4) {
  const std::string name = std::to_string(seed) + "-" + std::to_string(width) + "-";
  std::vector<Job> jobs = growing_group(name, width, most, wish);
  for (Job& job : jobs) job.seed = seed;
  return jobs;
}

void append(const std::vector<Job>& jobs, Sweep& sweep) {
  sweep.jobs.insert(sweep.jobs.end(), jobs.begin(), jobs.end());
}

TEST_CASE("a group is that of one seed, in whichever order seeds and widths come") {
  Sweep seeds_first{"s", 1, 1, {}}, widths_first{"s", 1, 1, {}};
  const ErrorWish wish{0.01, 0.0};
  for (const std::uint64_t seed : {1, 2}) {
    for (const double width : {3.0, 4.0}) append(of_seed(seed, width, wish), seeds_first);
  }
  for (const double width : {3.0, 4.0}) {
    for (const std::uint64_t seed : {1, 2}) append(of_seed(seed, width, wish), widths_first);
  }
  const std::vector<Places> four = {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}, {12, 13, 14, 15}};
  CHECK(groups_in(seeds_first) == four);
  CHECK(groups_in(widths_first) == four);
}

TEST_CASE("a group is found together, wherever its jobs stand") {
  Sweep sweep{"s", 1, 1, {}};
  const std::vector<Job> a = of_seed(1, 3.0, {0.01, 0.0}), b = of_seed(1, 4.0, {0.01, 0.0});
  for (std::size_t i = 0; i < a.size(); ++i) append({a[i], b[i]}, sweep);
  CHECK(groups_in(sweep) == std::vector<Places>{{0, 2, 4, 6}, {1, 3, 5, 7}});
}

TEST_CASE("a parameter set is found together, whatever seed and request its jobs have") {
  std::vector<Job> jobs = of_seed(1, 3.0, {0.01, 0.0}, 2);
  for (const Job& job : of_seed(2, 3.0, {}, 1)) jobs.push_back(job);
  jobs.push_back(jobs.front());
  jobs.back().label = "other";
  CHECK(parameter_sets(jobs) == std::vector<Places>{{0, 1, 2}, {3}});
  std::swap(jobs[0], jobs[3]);
  CHECK(parameter_sets(jobs) == std::vector<Places>{{0}, {1, 2, 3}});
}

TEST_CASE("packings of a point that are there anyway are no part of what grows") {
  Sweep sweep{"s", 1, 1, of_seed(1, 3.0, {})};
  append(of_seed(1, 3.0, {0.01, 0.0}), sweep);
  CHECK(groups_in(sweep).size() == 2);
  CHECK(grows(sweep));
}

TEST_CASE("a family is to be as precise as the strictest of its requests") {
  for (const bool strict_first : {false, true}) {
    Sweep sweep = fit_sweep(10, {0.005, 0.1, 0, 0});
    for (std::size_t i = 0; i < sweep.jobs.size(); ++i) {
      if ((i < 10) == strict_first) sweep.jobs[i].fit_wish = {0.003, 0, 0, 0.2};
    }
    const auto families = growing_families(sweep, groups_in(sweep));
    REQUIRE(families.size() == 1);
    const FitWish& wish = families[0].wish;
    CHECK((wish.phi_bulk == 0.003 && wish.c == 0.1 && wish.z_bulk == 0.0 && wish.c_z == 0.2));
  }
}

}  // namespace
}  // namespace grainsweep
