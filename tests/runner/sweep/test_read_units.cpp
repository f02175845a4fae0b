#include <catch2/catch.hpp>

#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

GivenUnits units_in(const std::string& units) {
  const SweepReading reading = reading_of(R"({"name": "t", "units": )" + units + "}");
  CHECK(reading.errors.empty());
  return reading.sweep.units;
}

TEST_CASE("a sweep says what d is, and of what density its grains are") {
  CHECK_FALSE(reading_of(R"({"name": "t"})").sweep.units);
  CHECK(units_in(R"({"d": 3.2, "unit": "mm"})") == Units{3.2, "mm", std::nullopt});
  CHECK(units_in(R"({"d": 450, "unit": "um", "density": 2500})") == Units{450, "um", 2500.0});
}

TEST_CASE("wrong units are told with what they must be") {
  const auto error = [](const std::string& units) {
    const auto errors = errors_of(R"({"name": "t", "units": )" + units + "}");
    REQUIRE(errors.size() == 1);
    return errors[0].substr(errors[0].find('/'));
  };
  CHECK(error("3.2") ==
        R"(/units: must say how long d is, e.g. { "d": 3.2, "unit": "mm" }, is 3.2)");
  CHECK(error(R"({"d": 3})") ==
        R"(/units: must say how long d is, e.g. { "d": 3.2, "unit": "mm" }, has no "unit")");
  CHECK(error(R"({"d": 0, "unit": "mm"})") == "/units/d: must be a number in (0, 1000000], is 0");
  CHECK(error(R"({"d": "3", "unit": "mm"})") ==
        R"(/units/d: must be a number in (0, 1000000], is the text "3")");
  CHECK(error(R"({"d": 3, "unit": "inch"})") ==
        R"(/units/unit: must be "um", "mm", "cm" or "m", is the text "inch")");
  CHECK(error(R"({"d": 3, "unit": "mm", "density": 2.5})") ==
        "/units/density: must be a number of kg/m3 in [10, 25000], is 2.5");
  CHECK(error(R"({"d": 3, "unit": "mm", "densty": 2500})") ==
        R"(/units/densty: unknown key "densty"; did you mean "density"?)");
}

}  // namespace
}  // namespace grainsweep
