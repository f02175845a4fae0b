#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "runner/sweep/identity.hpp"
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
    case ValueKind::texts:
      return Json::array({"a.csv", "b.csv"});
    case ValueKind::points:
      return Json::array({{0, 0, 0}, {0.5, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    case ValueKind::components:
      return Json::parse(R"([{"share": 0.5, "cube": {}}, {"share": 0.5, "prism": {"sides": 5}}])");
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
  [[maybe_unused]] const auto& [shape, box, fill, sizes, accuracy, measure, random_key] =
      PackingSpec{};
  [[maybe_unused]] const auto& [length, width, x, y, is_tube] = box;
  [[maybe_unused]] const auto& [spread, small_share, size_ratio, distribution] = sizes;
  [[maybe_unused]] const auto& [formula, by, smallest, largest, size] = SizeDistribution{};
  [[maybe_unused]] const auto& [protocol, solver, precision, end, step, momentum, fall, path, creep,
                                rest, residual, kinetic, contacts, overlap, imbalance,
                                imbalance_gap, max_steps] = accuracy;
  [[maybe_unused]] const auto& [exclude_floor, exclude_surface, gap_tolerances, bin_width] =
      measure;
  CHECK(known_keys("box").size() == 4);
  CHECK(known_keys("tube").size() == 1);
  CHECK(find_parameter("sizes.spread"));
  CHECK(find_parameter("sizes.small_share"));
  CHECK(find_parameter("sizes.size_ratio"));
  const auto parts = known_keys("sizes.distribution");
  for (const char* part :
       {"lognormal", "uniform", "weibull", "table", "by", "smallest", "largest", "size"}) {
    CHECK(std::count(parts.begin(), parts.end(), part) == 1);
  }
  CHECK(known_keys("accuracy").size() == 17 + 3);  // and what names or chooses a preset
  CHECK(known_keys("measure").size() == 4);
  [[maybe_unused]] const auto& [side, across, height, angle] = PinacoidSize{};
  CHECK(known_keys("shape.pinacoid").size() == 4);
}

TEST_CASE("every parameter that belongs to the identity reads back what was set") {
  for (const Parameter& parameter : parameters()) {
    INFO(parameter.path);
    const ValueReading reading = read_value(parameter, another_value(parameter));
    REQUIRE(reading.value.has_value());
    ResolvedSpec resolved;
    parameter.set(resolved, *reading.value);
    if (parameter.path.starts_with("fill.")) resolved.fill_content = "x.csv";
    if (parameter.path == "fill.diameter") resolved.fill_file = "x.csv";
    if (parameter.path == "shape.mixture_by") resolved.spec.shape = Mixture{};
    const auto value = parameter.get(resolved);
    const std::set<std::string> outside = {
        "accuracy.preset", "accuracy.solid_fraction", "accuracy.coordination",  "seed",
        "shape.hull.file", "shape.hull.size",         "sizes.distribution.size"};
    CHECK(value.has_value() == (outside.count(parameter.path) == 0));
    const bool is_known_by_hash = parameter.role == Role::size_file ||
                                  parameter.kind == ValueKind::points ||
                                  parameter.kind == ValueKind::texts;
    if (is_known_by_hash) continue;
    if (value) CHECK(*value == *reading.value);
  }
}

TEST_CASE("no two parameters write to the same place") {
  for (const Parameter& written : parameters()) {
    if (written.path == "accuracy.preset" || written.path.starts_with("fill.")) continue;
    if (written.path.starts_with("shape")) continue;               // one choice, below
    if (written.path.starts_with("sizes.distribution")) continue;  // likewise
    ResolvedSpec resolved;
    written.set(resolved, *read_value(written, another_value(written)).value);
    for (const Parameter& other : parameters()) {
      INFO(written.path << " and " << other.path);
      const bool is_replaced = written.path == "tube.diameter" && other.path.starts_with("box.");
      if (is_replaced) {
        CHECK_FALSE(other.get(resolved).has_value());
      } else if (other.path != written.path) {
        CHECK(other.get(resolved) == other.get(ResolvedSpec{}));
      }
    }
  }
}

TEST_CASE("no two parts of a shape write to the same place") {
  std::size_t shapes = 0;
  for (const std::string_view name : shape_names) {
    const std::string group = "shape." + std::string(name);
    const bool has_parts = name != "sphere" && name != "hull" && name != "mixture";
    const auto parts = has_parts ? known_keys(group) : std::vector<std::string>{};
    shapes += parts.empty() ? 0 : 1;
    for (const std::string& part : parts) {
      const Parameter& written = parameter_at((group + "." + part).c_str());
      ResolvedSpec resolved;
      const bool is_whole = written.kind == ValueKind::whole;
      written.set(resolved, is_whole ? Value(std::int64_t{9}) : Value(0.25));
      CHECK_FALSE(parameter_at("shape").get(resolved));
      for (const std::string& other : parts) {
        const Parameter& read = parameter_at((group + "." + other).c_str());
        INFO(group << ": " << part << " and " << other);
        CHECK((read.get(resolved) == default_of(read)) == (other != part));
      }
    }
  }
  CHECK(shapes == shape_names.size() - 3);
}

TEST_CASE("the shapes to choose from are those of the engine, in their order") {
  const Parameter& shape = parameter_at("shape");
  CHECK(shape.choices == std::vector<std::string>(shape_names.begin(), shape_names.end() - 2));
  for (std::size_t k = 0; k < shape.choices.size(); ++k) {
    ResolvedSpec resolved;
    shape.set(resolved, static_cast<std::int64_t>(k));
    CHECK(name_of(resolved.spec.shape) == shape.choices[k]);
  }
}

TEST_CASE("the name of a shape stands for its defaults, which are those of the engine") {
  ResolvedSpec resolved;
  parameter_at("shape").set(resolved, *read_value(parameter_at("shape"), "pinacoid").value);
  const auto& [length, width, height, angle] = std::get<PinacoidSize>(resolved.spec.shape);
  CHECK((length == 1 && width == 1 && height == 1));
  parameter_at("shape.pinacoid.angle_deg").set(resolved, 60.0);
  CHECK(std::get<PinacoidSize>(resolved.spec.shape).angle == angle);
  CHECK(default_of(parameter_at("shape.pinacoid.angle_deg")) == Value(60.0));
  parameter_at("shape").set(resolved, *read_value(parameter_at("shape"), "sphere").value);
  CHECK(std::holds_alternative<SphereShape>(resolved.spec.shape));
}

TEST_CASE("angles are degrees in a sweep and radians in the engine") {
  ResolvedSpec resolved;
  parameter_at("shape.pinacoid.angle_deg").set(resolved, 45.0);
  CHECK(std::get<PinacoidSize>(resolved.spec.shape).angle == 0.78539816339744831);  // pi / 4
  CHECK(parameter_at("shape.pinacoid.angle_deg").get(resolved) == Value(45.0));
}

TEST_CASE("a hull is known by its vertices in their order, not by where they came from") {
  const HullVertices hull{{{0, 0, 0}, {0.5, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  ResolvedSpec resolved;
  resolved.spec.shape = hull;
  CHECK(parameter_at("shape.hull.vertices").get(resolved) == Value(hash_of(hull)));
  HullVertices other = hull;
  other.points[3][2] = 1.0000000000000002;
  CHECK(hash_of(other) != hash_of(hull));
  other = hull;
  std::swap(other.points[0], other.points[1]);
  CHECK(hash_of(other) != hash_of(hull));
  CHECK(hash_of(HullVertices{{{1, 2, 3}}}) != hash_of(HullVertices{{{12, 3, 0}}}));
}

TEST_CASE("every name of a choice is read as the value it names") {
  ResolvedSpec resolved;
  const auto set = [&](const char* path, const char* name) {
    parameter_at(path).set(resolved, *read_value(parameter_at(path), name).value);
  };
  set("box.x", "walls");
  set("box.y", "periodic");
  CHECK(resolved.spec.box.x == Boundary::walls);
  CHECK(resolved.spec.box.y == Boundary::periodic);
  set("accuracy.solver", "pgs");
  CHECK(resolved.spec.accuracy.solver == Solver::projected_gauss_seidel);
  set("accuracy.solver", "apgs");
  CHECK(resolved.spec.accuracy.solver == Solver::accelerated_gauss_seidel);
  set("accuracy.precision", "f64");
  CHECK(resolved.spec.accuracy.precision == Precision::f64);
  set("accuracy.precision", "f32");
  CHECK(resolved.spec.accuracy.precision == Precision::f32);
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
  CHECK(error_of("fill.file", 3) == "must be the name of a file in double quotes, is 3");
  CHECK(error_of("fill.file", "") ==
        "must be the name of a file in double quotes, is the text \"\"");
  CHECK(error_of("fill.files", Json::array({"a", ""})) ==
        "must be a list of names of files in double quotes, holds the text \"\"");
  CHECK(error_of("measure.gap_tolerances", 1e-4) == "must be a list of numbers, is 0.0001");
  CHECK(error_of("measure.gap_tolerances", Json::array({"a"})) ==
        "must be a list of numbers, holds the text \"a\"");
  CHECK(error_of("fill.grains", 10.5) == "must be a whole number in [1, 10000000], is 10.5");
  CHECK(error_of("fill.grains", 1e300) == "must be a whole number in [1, 10000000], is 1e+300");
  CHECK(error_of("fill.grains", 18446744073709551615U) ==
        "must be a whole number in [1, 10000000], is 18446744073709551615");
  CHECK(error_of("accuracy.max_steps", 3'000'000'000) ==
        "must be a whole number in [1, 2147483647], is 3000000000");
  CHECK(error_of("shape.prism.sides", 6.5) == "must be a whole number in [3, 200], is 6.5");
  CHECK(error_of("seed", -1) ==
        "must be a whole number in digits from 0 to 18446744073709551615, is -1");
  CHECK(
      error_of("seed", 1.8446744073709552e19) ==
      "must be a whole number in digits from 0 to 18446744073709551615, is 1.8446744073709552e+19");
}

TEST_CASE("a solver of earlier versions is refused with the one that took its place") {
  for (const std::string name : {"symmetric_pgs", "nncg", "apgd"}) {
    CHECK(error_of("accuracy.solver", name) ==
          "must be \"pgs\" or \"apgs\", is the text \"" + name +
              "\", which this version no longer has; take \"apgs\"");
  }
}

TEST_CASE("what is no shape is refused with the shapes there are") {
  const std::string wanted =
      "must be \"sphere\", \"pinacoid\", \"cube\", \"cuboid\", \"tetrahedron\", "
      "\"octahedron\", \"dodecahedron\", \"icosahedron\", \"prism\", \"cylinder\" or an object "
      "with pinacoid, cube, cuboid, tetrahedron, octahedron, dodecahedron, icosahedron, "
      "prism, cylinder, hull, mixture, mixture_by, is ";
  CHECK(error_of("shape", "rock") == wanted + "the text \"rock\"");
  CHECK(error_of("shape", "hull") ==
        R"(a hull needs its vertices: write {"hull": {"file": "stone.stl"}})");
  CHECK(error_of("shape", "pinacoit") ==
        wanted + "the text \"pinacoit\"; did you mean \"pinacoid\"?");
  CHECK(error_of("shape", 3) == wanted + "3");
}

TEST_CASE("a vertex that is no triple of numbers is refused by its number") {
  const auto error = [](const Json& list) { return error_of("shape.hull.vertices", list); };
  const std::string second = "vertex 2 must be three numbers [x, y, z], ";
  CHECK(error(5) == "must be a list of points [x, y, z], is 5");
  CHECK(error({{0, 0, 0}, {0, 1}}) == second + "holds 2 values");
  CHECK(error({{0, 0, 0}, {0, 1, 2, 3}}) == second + "holds 4 values");
  CHECK(error({{0, 0, 0}, {0, "a", 2}}) == second + "holds the text \"a\"");
  CHECK(error({{0, 0, 0}, 7}) == second + "is 7");
  CHECK(error({{0, 0, 0}, nullptr}) == second + "is null");
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
  CHECK(is_group("shape"));
  CHECK(is_group("shape.hull"));
  CHECK_FALSE(is_group("shape.hull.file"));
  CHECK(known_keys("box") == std::vector<std::string>{"length", "width", "x", "y"});
  const std::vector<std::string> shapes = known_keys("shape");
  CHECK(std::vector<std::string>(shapes.begin(), shapes.begin() + 3) ==
        std::vector<std::string>{"pinacoid", "cube", "cuboid"});
  const std::vector<std::string> all = known_keys("");
  CHECK(std::count(all.begin(), all.end(), "shape.hull") == 1);
}

TEST_CASE("counts are written in thousands") {
  CHECK(in_thousands(0) == "0");
  CHECK(in_thousands(999) == "999");
  CHECK(in_thousands(1'000) == "1,000");
  CHECK(in_thousands(1'000'000'000'000) == "1,000,000,000,000");
}

}  // namespace grainsweep
