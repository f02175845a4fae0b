#include <set>

#include <catch2/catch.hpp>

#include "runner/sweep/random_points.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

using Messages = std::vector<std::string>;

Messages errors_in_random(const std::string& random) {
  return errors_of("{\"name\": \"t\", \"sweep\": [{\"random\":\n" + random + "}]}");
}

std::vector<double> widths_of(const std::string& blocks, std::uint64_t seed = 7) {
  std::vector<double> widths;
  const std::string text =
      R"({"name": "t", "seed": )" + std::to_string(seed) + R"(, "sweep": [)" + blocks + "]}";
  for (const Job& job : jobs_of(text)) widths.push_back(job.spec.box.width);
  return widths;
}

const std::string uniform_widths =
    R"({"label": "u", "random": {"count": 5, "box.width": {"uniform": [5, 20]}}})";

}  // namespace

TEST_CASE("draws are the same on every machine") {
  CHECK(uniform_draw({1, 2, 3}, "box.width") == 0x1.5c08dbb711298p-2);
}

TEST_CASE("draws depend on seed, block, point and path, each of them") {
  const double draw_of = uniform_draw({1, 2, 3}, "box.width");
  CHECK(uniform_draw({0, 2, 3}, "box.width") != draw_of);
  CHECK(uniform_draw({1, 0, 3}, "box.width") != draw_of);
  CHECK(uniform_draw({1, 2, 0}, "box.width") != draw_of);
  CHECK(uniform_draw({1, 2, 3}, "box.length") != draw_of);
}

TEST_CASE("points that are drawn again are one, and that is noted") {
  const SweepReading reading = reading_of(
      sweep_of(R"({"random": {"count": 9, "box.width": {"choice": [4, 5]}}, "replicates": 3})"));
  CHECK(reading.sweep.jobs.size() == 6);
  REQUIRE(reading.notes.size() == 1);
  CHECK(reading.notes[0].pointer == "/sweep/0/random/count");
  CHECK(reading.notes[0].message ==
        "7 of 9 points are drawn again and packed once, the first with box.width 4; for more "
        "packings of a point raise "
        "replicates");
  CHECK(reading_of(sweep_of(R"({"random": {"count": 9, "box.width": {"uniform": [4, 5]}}})"))
            .notes.empty());
}

TEST_CASE("uniform draws fill their interval evenly") {
  // Of 10,000 draws, a tenth of the interval holds 1000 +- 30; five standard deviations are
  // allowed.
  std::vector<int> bins(10, 0);
  for (std::uint64_t point = 0; point < 10'000; ++point) {
    const double u = uniform_draw({1, 0, point}, "x");
    REQUIRE((u >= 0.0 && u < 1.0));
    ++bins[static_cast<std::size_t>(u * 10.0)];
  }
  for (const int count : bins) CHECK(std::abs(count - 1000) < 150);
}

TEST_CASE("a random block is reproducible and follows the master seed") {
  const auto widths = widths_of(uniform_widths);
  REQUIRE(widths.size() == 5);
  CHECK(widths == widths_of(uniform_widths));
  CHECK(widths != widths_of(uniform_widths, 8));
  CHECK(std::set<double>(widths.begin(), widths.end()).size() == 5);
  for (const double width : widths) CHECK((width >= 5.0 && width <= 20.0));
}

TEST_CASE("more points leave the first ones as they are, and so does a second path") {
  const auto widths = widths_of(uniform_widths);
  auto more = widths_of(R"({"random": {"box.width": {"uniform": [5, 20]}, "count": 9}})");
  REQUIRE(more.size() == 9);
  more.resize(5);
  CHECK(more == widths);
  CHECK(widths_of(R"({"random": {"sizes.spread": {"uniform": [0, 0.1]}, "count": 5,
                                 "box.width": {"uniform": [5, 20]}}})") == widths);
}

TEST_CASE("editing one block never changes the random points of another") {
  const auto with_first = [](const std::string& first) {
    auto widths = widths_of(first + ", " + uniform_widths);
    widths.erase(widths.begin(), widths.end() - 5);
    return widths;
  };
  const auto widths = with_first(R"({"set": {"box.width": 30}})");
  CHECK(with_first(R"({"label": "x", "grid": {"box.width": [31, 32, 33]}})") == widths);
  CHECK(with_first(R"({"random": {"count": 50, "box.width": {"uniform": [40, 50]}}})") == widths);
}

TEST_CASE("a log-uniform draw spends equal shares on equal ratios") {
  RandomPath random{"accuracy.step",
                    "",
                    Distribution::log_uniform,
                    *find_parameter("accuracy.step"),
                    1e-4,
                    1.0,
                    {}};
  int below = 0;
  for (std::uint64_t point = 0; point < 10'000; ++point) {
    const double value = std::get<double>(draw(random, {1, 0, point}).at(0).value);
    REQUIRE((value >= 1e-4 && value <= 1.0));
    below += value < 1e-2 ? 1 : 0;
  }
  CHECK(std::abs(below - 5000) < 250);  // five standard deviations
}

TEST_CASE("whole numbers are drawn from all of their range, bounds included") {
  RandomPath random{"fill.grains", "", Distribution::uniform, *find_parameter("fill.grains"), 3.0,
                    6.0,           {}};
  std::vector<int> seen(7, 0);
  for (std::uint64_t point = 0; point < 4'000; ++point) {
    ++seen.at(
        static_cast<std::size_t>(std::get<std::int64_t>(draw(random, {1, 0, point}).at(0).value)));
  }
  CHECK(seen[0] + seen[1] + seen[2] == 0);
  for (std::size_t n = 3; n <= 6; ++n) CHECK(std::abs(seen[n] - 1000) < 140);
}

TEST_CASE("a choice draws every one of its values, groups and presets too") {
  const auto jobs = jobs_of(sweep_of(R"({"random": {"count": 60,
    "accuracy": {"choice": ["fast", "accurate"]},
    "box": {"choice": [{"width": 5}, {"width": 6, "y": "periodic"}]}}})"));
  std::set<std::pair<int, double>> seen;
  for (const Job& job : jobs) {
    seen.insert({job.spec.accuracy.rest_iterations, job.spec.box.width});
  }
  CHECK(seen.size() == 4);
}

TEST_CASE("bounds that are equal give that value") {
  CHECK(widths_of(R"({"random": {"count": 1, "box.width": {"uniform": [7.5, 7.5]}}})") ==
        std::vector<double>{7.5});
}

TEST_CASE("a random block needs a count and a path") {
  CHECK(
      errors_in_random(R"({"box.width": {"uniform": [5, 6]}})") ==
      Messages{"s.json:2:1 /sweep/0/random: \"count\", the number of points to draw, is missing"});
  CHECK(
      errors_in_random(R"({"count": 0, "box.width": {"uniform": [5, 6]}})") ==
      Messages{"s.json:2:11 /sweep/0/random/count: must be a whole number in [1, 1000000], is 0"});
  CHECK(errors_in_random(R"({"count": 3})") ==
        Messages{"s.json:2:1 /sweep/0/random: names no path to draw, e.g. \"box.width\": "
                 "{\"uniform\": [5, 20]}"});
  CHECK(errors_in_random("5") ==
        Messages{"s.json:2:1 /sweep/0/random: must be an object of distributions and \"count\", "
                 "is 5"});
}

TEST_CASE("distributions that cannot be drawn from are refused") {
  const auto error = [](const std::string& path, const std::string& distribution) {
    const auto errors = errors_in_random("{\"count\": 1, \"" + path + "\": " + distribution + "}");
    REQUIRE(errors.size() == 1);
    return errors.front().substr(errors.front().find("random/") + 7);
  };
  const std::string wanted =
      "must be {\"uniform\": [a, b]}, {\"log_uniform\": [a, b]} or {\"choice\": [...]}, is ";
  CHECK(error("box.width", "5") == "box.width: " + wanted + "5");
  CHECK(error("box.width", "{}") == "box.width: " + wanted + "an object");
  CHECK(error("box.widht", R"({"uniform": [1, 2]})") ==
        "box.widht: unknown key \"box.widht\"; did you mean \"box.width\"?");
  CHECK(error("box.width", R"({"unifrom": [1, 2]})") ==
        "box.width/unifrom: unknown key \"unifrom\"; did you mean \"uniform\"?");
  CHECK(error("box.width", R"({"uniform": [1]})") ==
        "box.width/uniform: must be a list of two numbers, is a list");
  CHECK(error("box.width", R"({"uniform": [6, 5]})") ==
        "box.width/uniform: the first bound must not exceed the second");
  CHECK(error("box.width", R"({"log_uniform": [0, 5]})") ==
        "box.width/log_uniform: the bounds of log_uniform must be positive, the first is 0");
  CHECK(error("box.y", R"({"uniform": [0, 1]})") ==
        "box.y/uniform: box.y is not drawn from an interval; use {\"choice\": [...]}");
  CHECK(error("fill.grains", R"({"uniform": [1.5, 2]})") ==
        "fill.grains/uniform: must be a whole number in [1, 10000000], is 1.5");
  CHECK(error("box.width", R"({"choice": []})") ==
        "box.width/choice: must be a list of at least one value, is empty");
  CHECK(error("box.width", R"({"choice": [5, "a"]})") ==
        "box.width/choice/1: must be a number, is the text \"a\"");
}

TEST_CASE("a rule that many random points break is named once") {
  const auto errors = errors_in_random(R"({"count": 500, "box.width": {"uniform": [1, 1.1]}})");
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].starts_with("s.json:2:29 /sweep/0/random/box.width: must lie in [1.13334,"));
}

}  // namespace grainsweep
