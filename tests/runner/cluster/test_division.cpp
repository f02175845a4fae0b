#include <catch2/catch.hpp>

#include "runner/cluster/division.hpp"

namespace grainsweep {
namespace {

using Catch::Contains;

/// So many packings of a minute and 10 MB each.
std::vector<Cost> minutes_of_work(int packings) {
  return std::vector<Cost>(static_cast<std::size_t>(packings), Cost{60.0, 1e7});
}

/// Divides packings each of which is a part.
Division divide(const std::vector<Cost>& costs, const ClusterLimits& limits, int shards = 0) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < costs.size(); ++i) parts.push_back({{i}, {}, costs[i]});
  return divide(parts, costs, limits, shards);
}

const ClusterLimits twelve_nodes{12, 10, 64e9, 86400.0, 1000};

TEST_CASE("a sweep is spread over all nodes where each then has 10 to 60 minutes of work") {
  const Division division = divide(minutes_of_work(12 * 10 * 30), twelve_nodes);
  CHECK(division.shards == 12);
  CHECK(division.threads == 10);
  CHECK(division.estimated == Approx(30 * 60));
  CHECK(division.seconds == 4200.0);  // twice as much and two minutes, in whole ten minutes
  CHECK(division.reason == "the partition has so many nodes");
}

TEST_CASE("little work has fewer shards than there are nodes, and much work more") {
  const Division little = divide(minutes_of_work(310), twelve_nodes);
  CHECK(little.shards == 3);
  CHECK_THAT(little.reason, Contains("10 min 0 s at least"));
  CHECK(divide(minutes_of_work(5), twelve_nodes).shards == 1);
  const Division much = divide(minutes_of_work(12 * 10 * 600), twelve_nodes);
  CHECK(much.shards == 120);
  CHECK(much.estimated == Approx(3600));
  CHECK_THAT(much.reason, Contains("1 h 0 min at most"));
  CHECK(divide(minutes_of_work(12 * 10 * 600 + 300), twelve_nodes).shards == 121);
}

TEST_CASE("a short time limit and an array of few elements decide") {
  ClusterLimits limits = twelve_nodes;
  limits.seconds = 900.0;
  limits.elements = 5000;
  const Division brief = divide(minutes_of_work(12 * 10 * 600), limits);
  CHECK(brief.shards == 1440);
  CHECK_THAT(brief.reason, Contains("third of the time limit"));
  CHECK(brief.seconds == 900.0);
  limits.elements = 100;
  const Division few = divide(minutes_of_work(12 * 10 * 600), limits);
  CHECK(few.shards == 100);
  CHECK_THAT(few.reason, Contains("MaxArraySize"));
  CHECK(divide(minutes_of_work(50), limits, 7).shards == 7);
  CHECK(divide(minutes_of_work(700), limits, 700).shards == 100);
}

TEST_CASE("no shard is without a packing") {
  const std::vector<Cost> two_long(2, Cost{36000.0, 1e9});
  const Division division = divide(two_long, twelve_nodes);
  CHECK(division.shards == 2);
  CHECK(division.threads == 10);
  CHECK_THAT(division.reason, Contains("one packing at least"));
  CHECK(divide(two_long, twelve_nodes, 7).shards == 2);
}

/// Parts of so many packings of a minute, which grow from six.
std::vector<Part> growing_parts(int count, std::size_t packings) {
  std::vector<Part> parts;
  for (int k = 0; k < count; ++k) {
    Part& part = parts.emplace_back();
    for (std::size_t i = 0; i < packings; ++i) {
      (i < 6 ? part.first : part.later).push_back(parts.size() * packings - packings + i);
    }
    part.cost = {360.0, 1e7};
  }
  return parts;
}

TEST_CASE("what grows as a whole is not divided, and has time to grow") {
  const Division one = divide(growing_parts(1, 600), minutes_of_work(600), twelve_nodes, 20);
  CHECK(one.shards == 1);
  CHECK_THAT(one.reason, Contains("growing groups and families whole"));
  CHECK(one.estimated == Approx(60.0));  // six on ten threads
  CHECK(one.grown == Approx(3600.0));
  CHECK(one.seconds == 4200.0);
  ClusterLimits brief = twelve_nodes;
  brief.seconds = 1800.0;
  CHECK(divide(growing_parts(1, 600), minutes_of_work(600), brief).seconds == 1800.0);
  const Division many = divide(growing_parts(300, 10), minutes_of_work(3000), twelve_nodes);
  CHECK(many.shards == 12);
  CHECK(many.estimated == Approx(15 * 60.0));  // of 25 groups each
  CHECK(many.seconds == 2400.0);               // twice as much: more than they may grow to
}

TEST_CASE("a shard has no more threads than there is memory for") {
  const std::vector<Cost> large(1000, Cost{60.0, 10e9});
  const Division division = divide(large, twelve_nodes);
  CHECK(division.threads == 5);  // of four fifths of 64 GB
  CHECK(division.bytes <= 64e9);
  CHECK(division.bytes >= 5 * 10e9 / 0.8);
  ClusterLimits tight = twelve_nodes;
  tight.memory = 62.66e9;  // of which 62.653 GB are needed: 62.7 in whole 100 MB
  CHECK(divide(large, tight).threads == 5);
  CHECK(divide(large, tight).bytes == 62.66e9);
  ClusterLimits untold = twelve_nodes;
  untold.memory = ClusterLimits{}.memory;
  CHECK(divide(large, untold).threads == 10);
  CHECK(divide(large, untold).bytes == 0.0);
}

}  // namespace
}  // namespace grainsweep
