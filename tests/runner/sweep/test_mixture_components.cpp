#include <catch2/catch.hpp>

#include "engine/units.hpp"
#include "runner/sweep/mixture_components.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

const std::string halves = R"([{"share": 0.5, "pinacoid": {"angle_deg": 45}},
                              {"share": 0.5, "prism": {"sides": 5}}])";

Job job_of(const std::string& shape) {
  const auto jobs = jobs_of(R"({"name": "t", "base": {"shape": )" + shape + "}}");
  REQUIRE(jobs.size() == 1);
  return jobs[0];
}

std::string shape_in(const Job& job) {
  const std::size_t at = job.parameters.find("\"shape\":");
  return job.parameters.substr(at, job.parameters.find(",\"sizes\"") - at);
}

std::string error_of(const std::string& components) {
  Diagnostics diagnostics;
  CHECK_FALSE(read_components(Json::parse(components), "/m", diagnostics));
  REQUIRE(diagnostics.size() == 1);
  return diagnostics[0].pointer + " " + diagnostics[0].message;
}

}  // namespace

TEST_CASE("components are read with their shares, parts and defaults") {
  const Job job = job_of(R"({"mixture": )" + halves + "}");
  const auto& mixture = std::get<Mixture>(job.spec.shape);
  REQUIRE(mixture.components.size() == 2);
  CHECK(mixture.by == ShareBy::volume);
  CHECK(mixture.components[0].share == 0.5);
  CHECK(std::get<PinacoidSize>(mixture.components[0].shape).angle == Approx(pi / 4));
  CHECK(std::get<PrismSize>(mixture.components[1].shape).sides == 5);
  CHECK(shape_in(job) ==
        R"("shape":{"mixture":{"1":{"pinacoid":{"angle_deg":45,"height":1,"length":1,"width":1},)"
        R"("share":0.5},"2":{"prism":{"diameter":1,"height":1,"sides":5},"share":0.5}},)"
        R"("mixture_by":"volume"})");
}

TEST_CASE("shares are by number where the sweep says so, in whatever order") {
  const std::string by = R"("mixture_by": "number")";
  const std::string mixture = R"("mixture": )" + halves;
  for (const std::string& text : {by + ", " + mixture, mixture + ", " + by}) {
    const Job job = job_of("{" + text + "}");
    CHECK(std::get<Mixture>(job.spec.shape).by == ShareBy::number);
    CHECK(job.id != job_of("{" + mixture + "}").id);
  }
  CHECK(job_of("{" + mixture + R"(, "mixture_by": "volume"})").id ==
        job_of("{" + mixture + "}").id);
}

TEST_CASE("a mixture of one component is that shape, under its id") {
  for (const std::string shape : {R"({"pinacoid": {"angle_deg": 50}})", R"({"cube": {}})"}) {
    const std::string component = R"({"share": 1, )" + shape.substr(1);
    CHECK(job_of(R"({"mixture": [)" + component + "]}").id == job_of(shape).id);
  }
  CHECK(job_of(R"({"mixture": [{"share": 1, "pinacoid": {"angle_deg": 50}}]})")
            .parameters.find(R"("angle_deg":50)") != std::string::npos);
}

TEST_CASE("shares, parts and the vertices of hulls belong to the id of a mixture") {
  const auto id = [](const std::string& second) {
    return job_of(R"({"mixture": [{"share": 0.5, "cube": {}}, )" + second + "]}").id;
  };
  const std::string hull =
      id(R"({"share": 0.5, "hull": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]}})");
  CHECK(hull != id(R"({"share": 0.5, "hull": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,0.9]]}})"));
  CHECK(id(R"({"share": 0.5, "prism": {}})") == id(R"({"prism": {"sides": 6}, "share": 0.5})"));
  CHECK(id(R"({"share": 0.5, "prism": {}})") != id(R"({"share": 0.5, "prism": {"sides": 7}})"));
  CHECK(id(R"({"share": 0.5, "prism": {}})") != id(R"({"share": 0.4999, "prism": {}})"));
}

TEST_CASE("a mixture may vary, and another shape takes its place with all its parts") {
  const auto jobs = jobs_of(
      sweep_of(R"({"grid": {"shape.mixture": [)" + halves + R"(, [{"share": 1, "cube": {}}]]}},
         {"set": {"shape": "sphere"}})",
               R"({"shape": {"mixture": )" + halves + R"(, "mixture_by": "number"}})"));
  REQUIRE(jobs.size() == 3);
  CHECK(std::holds_alternative<Mixture>(jobs[0].spec.shape));
  CHECK(std::holds_alternative<CubeSize>(jobs[1].spec.shape));
  CHECK(std::holds_alternative<SphereShape>(jobs[2].spec.shape));
}

TEST_CASE("shares that do not add up, and grains placed by hand, are refused at their place") {
  CHECK(errors_of(R"({"name": "m", "base": {"shape": {"mixture": [
  {"share": 0.5, "cube": {}}, {"share": 0.4, "pinacoid": {"height": 0.5}}]}}})") ==
        std::vector<std::string>{
            "s.json:1:45 /base/shape/mixture: shares must add up to 1, add up to 0.9"});
  const ScratchFolder folder;
  folder.write("one.csv", "x,y,z,r,qx,qy,qz,qw\n2,2,2,0.5,0,0.6,0,0.8\n");
  const SweepReading reading = read_sweep(folder.write(
      "s.json",
      R"({"name": "m", "base": {"fill.file": "one.csv", "shape.mixture": )" + halves + "}}"));
  REQUIRE(reading.errors.size() == 1);
  CHECK(reading.errors[0].pointer == "/base/fill.file");
  CHECK(reading.errors[0].message.starts_with("does not say which grain is of which component"));
}

TEST_CASE("what is wrong with a component is told at its place") {
  CHECK(error_of("[]").starts_with("/m must be a list of components"));
  CHECK(error_of("{}").starts_with("/m must be a list of components"));
  CHECK(error_of("[3]") == "/m/0 must be an object with a share and a shape, is 3");
  CHECK(error_of(R"([{"cube": {}}])").starts_with("/m/0 has no share"));
  CHECK(error_of(R"([{"share": 1}])").starts_with("/m/0 names no shape"));
  CHECK(error_of(R"([{"share": 2, "cube": {}}])") == "/m/0/share must be a number in [0, 1], is 2");
  CHECK(error_of(R"([{"share": 1, "cub": {}}])").starts_with("/m/0/cub unknown key"));
  CHECK(error_of(R"([{"share": 1, "cube": 3}])").starts_with("/m/0/cube must be an object"));
  CHECK(error_of(R"([{"share": 1, "cube": {"height": 3}}])").starts_with("/m/0/cube/height"));
  CHECK(error_of(R"([{"share": 1, "cube": {}, "prism": {}}])")
            .starts_with("/m/0 names several shapes"));
  CHECK(error_of(R"([{"share": 0.5, "cube": {}}, {"share": 0.5, "sphere": {"diameter": 2}}])")
            .starts_with("/m/1/sphere a sphere has no parts"));
  CHECK(error_of(R"([{"share": 1, "mixture": []}])").starts_with("/m/0/mixture a component must"));
  CHECK(error_of(R"([{"share": 1, "hull": {"file": "a.obj"}}])")
            .starts_with("/m/0/hull/file a hull in a mixture"));
}

}  // namespace grainsweep
