#include <set>

#include <catch2/catch.hpp>

#include "runner/sweep/parameters.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

/// A value of the parameter's kind that differs from its default.
Json another_value(const Parameter& parameter) {
  switch (parameter.kind) {
    case ValueKind::number:
      return 0.3141;
    case ValueKind::whole:
      return 7;
    case ValueKind::natural:
      return 18446744073709551615U;
    case ValueKind::choice:
      return parameter.choices.front();
    case ValueKind::text:
      return "x.csv";
    case ValueKind::numbers:
      break;
  }
  return Json::array({0.01, 0.02});
}

const Parameter& parameter_at(const char* path) { return parameters()[*find_parameter(path)]; }

std::string error_of(const char* path, const Json& value) {
  const ValueReading reading = read_value(parameter_at(path), value);
  CHECK_FALSE(reading.value.has_value());
  return reading.error;
}

}  // namespace

TEST_CASE("no path is there twice and every parameter has a meaning") {
  std::set<std::string> paths;
  for (const Parameter& parameter : parameters()) {
    CHECK(paths.insert(parameter.path).second);
    CHECK_FALSE(parameter.meaning.empty());
  }
}

TEST_CASE("the table knows every member of a specification") {
  // A new member makes the number of names wrong, and this test no longer compiles.
  [[maybe_unused]] const auto& [box, fill, sizes, accuracy, measure, random_key] = PackingSpec{};
  [[maybe_unused]] const auto& [length, width, x, y] = box;
  [[maybe_unused]] const auto& [spread, small_share, size_ratio] = sizes;
  [[maybe_unused]] const auto& [protocol, solver, precision, step, momentum, fall, creep, rest,
                                residual, kinetic, contacts, overlap, max_steps, force_balance] =
      accuracy;
  [[maybe_unused]] const auto& [exclude_floor, exclude_surface, gap_tolerances, bin_width] =
      measure;
  CHECK(known_keys("box").size() == 4);
  CHECK(known_keys("sizes").size() == 3);
  CHECK(known_keys("accuracy").size() == 14 + 1);  // and "preset"
  CHECK(known_keys("measure").size() == 4);
}

TEST_CASE("every parameter that belongs to the identity reads back what was set") {
  for (const Parameter& parameter : parameters()) {
    INFO(parameter.path);
    const ValueReading reading = read_value(parameter, another_value(parameter));
    REQUIRE(reading.value.has_value());
    Draft draft;
    parameter.set(draft, *reading.value);
    if (parameter.path.starts_with("fill.")) draft.fill_content = "x.csv";
    if (parameter.path == "fill.diameter") draft.fill_file = "x.csv";
    const auto value = parameter.get(draft);
    const bool outside = parameter.path == "accuracy.preset" || parameter.path == "seed";
    CHECK(value.has_value() == !outside);
    if (value) CHECK(*value == *reading.value);
  }
}

TEST_CASE("no two parameters write to the same place") {
  for (const Parameter& written : parameters()) {
    if (written.path == "accuracy.preset" || written.path.starts_with("fill.")) continue;
    Draft draft;
    written.set(draft, *read_value(written, another_value(written)).value);
    for (const Parameter& other : parameters()) {
      INFO(written.path << " and " << other.path);
      if (other.path != written.path) CHECK(other.get(draft) == other.get(Draft{}));
    }
  }
}

TEST_CASE("every name of a choice is read as the value it names") {
  Draft draft;
  const auto set = [&](const char* path, const char* name) {
    parameter_at(path).set(draft, *read_value(parameter_at(path), name).value);
  };
  set("box.x", "walls");
  set("box.y", "periodic");
  CHECK(draft.spec.box.x == Boundary::walls);
  CHECK(draft.spec.box.y == Boundary::periodic);
  set("accuracy.solver", "pgs");
  CHECK(draft.spec.accuracy.solver == Solver::projected_gauss_seidel);
  set("accuracy.solver", "symmetric_pgs");
  CHECK(draft.spec.accuracy.solver == Solver::symmetric_gauss_seidel);
  set("accuracy.solver", "nncg");
  CHECK(draft.spec.accuracy.solver == Solver::nonsmooth_nonlinear_conjugate);
  set("accuracy.solver", "apgd");
  CHECK(draft.spec.accuracy.solver == Solver::accelerated_projected_gradient);
  set("accuracy.precision", "f64");
  CHECK(draft.spec.accuracy.precision == Precision::f64);
  set("accuracy.precision", "f32");
  CHECK(draft.spec.accuracy.precision == Precision::f32);
}

TEST_CASE("a value of the wrong type is refused with what was wanted and what was found") {
  CHECK(error_of("box.width", "5") == "must be a number, is the text \"5\"");
  CHECK(error_of("box.width", true) == "must be a number, is true");
  CHECK(error_of("box.width", nullptr) == "must be a number, is null");
  CHECK(error_of("box.width", Json::array({5})) == "must be a number, is a list");
  CHECK(error_of("box.width", Json::object()) == "must be a number, is an object");
  CHECK(error_of("box.y", 3) == "must be \"periodic\" or \"walls\", is 3");
  CHECK(error_of("box.y", "wall") ==
        "must be \"periodic\" or \"walls\", is the text \"wall\"; did you mean \"walls\"?");
  CHECK(error_of("fill.file", 3) == "must be a text in double quotes, is 3");
  CHECK(error_of("measure.gap_tolerances", 1e-4) == "must be a list of numbers, is 0.0001");
  CHECK(error_of("measure.gap_tolerances", Json::array({"a"})) ==
        "must be a list of numbers, is a list");
  CHECK(error_of("fill.grains", 10.5) == "must be a whole number, is 10.5");
  CHECK(error_of("fill.grains", 1e300) == "must be a whole number, is 1e+300");
  CHECK(error_of("fill.grains", 18446744073709551615U) ==
        "must be a whole number, is 18446744073709551615");
  CHECK(error_of("accuracy.max_steps", 3'000'000'000) ==
        "must be a whole number up to 2147483647, is 3000000000");
  CHECK(error_of("seed", -1) == "must be a whole number from 0 to 18446744073709551615, is -1");
  CHECK(error_of("seed", 1.8446744073709552e19) ==
        "must be a whole number from 0 to 18446744073709551615, is 1.8446744073709552e+19");
}

TEST_CASE("shapes other than spheres are refused with the reason") {
  CHECK(error_of("shape", Json{{"pinacoid", Json::object()}}) ==
        "must be \"sphere\": this version packs spheres only");
  CHECK(error_of("shape", "cube") == "must be \"sphere\", is the text \"cube\"");
}

TEST_CASE("whole numbers may be written with an exponent") {
  CHECK(read_value(parameter_at("fill.grains"), 1e4).value == Value(std::int64_t{10'000}));
  CHECK(read_value(parameter_at("seed"), 1e3).value == Value(std::uint64_t{1'000}));
}

TEST_CASE("minus zero is zero") {
  const auto value = read_value(parameter_at("measure.exclude_floor"), -0.0).value;
  REQUIRE(value.has_value());
  CHECK_FALSE(std::signbit(std::get<double>(*value)));
}

TEST_CASE("groups are what parameters lie below") {
  CHECK(is_group(""));
  CHECK(is_group("box"));
  CHECK_FALSE(is_group("bo"));
  CHECK_FALSE(is_group("box.width"));
  CHECK_FALSE(is_group("shape"));
  CHECK(known_keys("box") == std::vector<std::string>{"length", "width", "x", "y"});
}

TEST_CASE("the documentation names every parameter with its default") {
  const std::string text = document_parameters();
  for (const Parameter& parameter : parameters()) {
    CHECK(text.find(parameter.path + "  [") != std::string::npos);
    CHECK(text.find(parameter.meaning) != std::string::npos);
  }
  CHECK(text.find("accuracy.preset  [balanced]") != std::string::npos);
  CHECK(text.find("box.y  [\"walls\"]") != std::string::npos);
}

TEST_CASE("counts are written in thousands") {
  CHECK(in_thousands(0) == "0");
  CHECK(in_thousands(999) == "999");
  CHECK(in_thousands(1'000) == "1,000");
  CHECK(in_thousands(1'000'000'000'000) == "1,000,000,000,000");
}

}  // namespace grainsweep
