#include <array>
#include <string>
#include <vector>

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
  const std::string& parameters = job.parameters.text();
  const std::size_t at = parameters.find("\"shape\":");
  return parameters.substr(at, parameters.find(",\"sizes\"") - at);
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
            .parameters.text()
            .find(R"("angle_deg":50)") != std::string::npos);
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

TEST_CASE("shares that do not add up are refused at their place") {
  CHECK(errors_of(R"({"name": "m", "base": {"shape": {"mixture": [
  {"share": 0.5, "cube": {}}, {"share": 0.4, "pinacoid": {"height": 0.5}}]}}})") ==
        std::vector<std::string>{
            "s.json:1:45 /base/shape/mixture: shares must add up to 1, add up to 0.9"});
  CHECK(errors_of(R"({"name": "m", "sweep": [{"grid": {"shape.mixture": [
  [{"share": 0.5, "hull": {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}},
   {"share": 0.4, "sphere": {}}], [{"share": 1, "sphere": {}}]]}}]})") ==
        std::vector<std::string>{
            "s.json:2:3 /sweep/0/grid/shape.mixture/0: shares must add up to 1, add up to 0.9"});
}

/// The vertices of a mixture's component.
const std::vector<std::array<double, 3>>& hull_of(const Job& job, std::size_t component) {
  const auto& mixture = std::get<Mixture>(job.spec.shape);
  return std::get<HullVertices>(mixture.components.at(component).shape).points;
}

TEST_CASE("hulls of a mixture are those of files beside the sweep, in units of their sizes") {
  const ScratchFolder folder;
  folder.write("rock.obj", "v 0 0 -0\nv 2 0 0\nv 0 2 0\nv 0 0 2\n");
  folder.write("rock.stl",
               "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
               "endfacet\nfacet\nouter loop\nvertex 0 0 1\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
               "endfacet\nendsolid\n");
  const auto job_with = [&](const std::string& hull, const std::string& share = "0.5") {
    const SweepReading reading = read_sweep(folder.write(
        "s.json", R"({"name": "t", "base": {"shape.mixture": [{"share": )" + share +
                      R"(, "hull": )" + hull + "}" +
                      (share == "1" ? "" : R"(, {"share": 0.5, "cube": {}})") + "]}}"));
    for (const Diagnostic& diagnostic : reading.errors) FAIL(to_string(diagnostic));
    return reading.sweep.jobs.at(0);
  };
  const Job from_file = job_with(R"({"file": "rock.obj", "size": 4})");
  REQUIRE(hull_of(from_file, 0).size() == 4);
  CHECK(hull_of(from_file, 0)[1] == std::array{0.5, 0.0, 0.0});
  CHECK(from_file.files.at("shape.mixture.1.hull.vertices") == "rock.obj");
  const std::string written = R"({"vertices": [[0,0,0],[0.5,0,0],[0,0.5,0],[0,0,0.5]]})";
  CHECK(from_file.id == job_with(written).id);
  CHECK(from_file.id ==
        job_with(R"({"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "size": 2})").id);
  CHECK(hull_of(job_with(R"({"file": "rock.stl", "size": 2})"), 0).size() == 4);
  CHECK(from_file.id != job_with(R"({"file": "rock.obj", "size": 3})").id);
  CHECK(job_with(R"({"file": "rock.obj", "size": 4})", "1").id ==
        job_of(R"({"hull": )" + written + "}").id);
}

TEST_CASE("two mixtures that differ in the file of a hull alone are two") {
  const ScratchFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  folder.write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.8\n");
  const auto with = [](const std::string& file) {
    return R"([{"share": 0.5, "cube": {}}, {"share": 0.5, "hull": {"file": ")" + file + R"("}}])";
  };
  const SweepReading reading =
      read_sweep(folder.write("s.json", sweep_of(R"({"grid": {"shape.mixture": [)" + with("a.obj") +
                                                 ", " + with("b.obj") + "]}}")));
  REQUIRE(reading.errors.empty());
  REQUIRE(reading.sweep.jobs.size() == 2);
  CHECK(hull_of(reading.sweep.jobs[1], 1)[3][2] == 0.8);
}

TEST_CASE("errors of the file of a component name its lines, or the component without them") {
  const ScratchFolder folder;
  folder.write("bad.obj", "v 0 0 0\nv 0 zero 0\n");
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n");
  folder.write("large.obj", "v 0 0 0\nv 90 0 0\nv 0 90 0\nv 0 0 90\n");
  const auto errors_with = [&](const std::string& file) {
    std::vector<std::string> errors;
    const SweepReading reading =
        read_sweep(folder.write("s.json",
                                R"({"name": "t", "replicates": 2, "base": {"shape.mixture": [
{"share": 0.5, "cube": {}}, {"share": 0.5, "hull": {"file": ")" +
                                    file + R"("}}]},
"sweep": [{"grid": {"box.length": [7, 8]}}]})"));
    for (const Diagnostic& diagnostic : reading.errors) {
      errors.push_back(folder.without_folder(to_string(diagnostic)));
    }
    return errors;
  };
  CHECK(errors_with("bad.obj") ==
        std::vector<std::string>{"bad.obj:2: y must be a finite number, is \"zero\""});
  CHECK(errors_with("none.obj") ==
        std::vector<std::string>{"s.json:2:61 /base/shape.mixture/1/hull/file: none.obj cannot be "
                                 "read: No such file or directory"});
  const auto flat = errors_with("flat.obj"), large = errors_with("large.obj");
  REQUIRE(flat.size() == 1);
  CHECK_THAT(flat[0], Catch::Contains("/base/shape.mixture: component 2") &&
                          Catch::Contains("lie on a plane"));
  REQUIRE_FALSE(large.empty());
  CHECK_THAT(large[0],
             Catch::Contains("component 2 of the mixture is 149 d across: its hull.size"));
}

TEST_CASE("files of hulls without faces that may not be convex are noted once and packed") {
  const ScratchFolder folder;
  folder.write("hole.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
               "v 0.5 0.5 0\nv 0.5 0.5 1\n");
  const SweepReading reading = read_sweep(folder.write("s.json", R"({"name": "t", "sweep": [
    {"set": {"shape": {"hull": {"file": "hole.obj"}}}, "grid": {"box.width": [6, 7]}},
    {"set": {"shape": {"mixture": [{"share": 0.5, "cube": {}},
                                   {"share": 0.5, "hull": {"file": "hole.obj"}}]}}}]})"));
  CHECK(reading.errors.empty());
  REQUIRE(reading.notes.size() == 2);
  CHECK(reading.notes[0].pointer == "/sweep/0/set/shape/hull/file");
  CHECK(reading.notes[1].pointer == "/sweep/1/set/shape/mixture/1/hull/file");
  CHECK_THAT(reading.notes[1].message, Catch::StartsWith("2 of its 10 vertices lie on edges"));
  CHECK(reading.sweep.jobs.size() == 3);
}

TEST_CASE("grains of a mixture that a file places are of the components that it names") {
  const ScratchFolder folder;
  const std::string turned = ",0.5,0,0,0,1";
  const auto read = [&](const std::string& column, const std::string& one, const std::string& two) {
    const auto cell = [](const std::string& text) { return text.empty() ? "" : "," + text; };
    folder.write("bed.csv", "x,y,z,r,qx,qy,qz,qw" + cell(column) + "\n2,2,2" + turned + cell(one) +
                                "\n3.5,2,2" + turned + cell(two) + "\n");
    return read_sweep(folder.write(
        "s.json",
        R"({"name": "m", "base": {"fill.file": "bed.csv", "shape.mixture": )" + halves + "}}"));
  };
  const auto error = [&](const std::string& column, const std::string& one,
                         const std::string& two) {
    const SweepReading reading = read(column, one, two);
    REQUIRE(reading.errors.size() == 1);
    return reading.errors[0].pointer + " " + reading.errors[0].message;
  };
  const SweepReading reading = read("component", "2", "1");
  REQUIRE(reading.errors.empty());
  const auto& fill = std::get<PlacedGrains>(reading.sweep.jobs.at(0).spec.fill);
  CHECK(fill.components == std::vector<std::uint8_t>{1, 0});
  const std::string wanted =
      "the column component must hold the number of each grain's component in shape.mixture, 1 to "
      "2";
  CHECK(error("", "", "") ==
        "/base/fill.file does not say which grain is of which component: " + wanted);
  for (const std::string wrong : {"3", "0", "1.5", "cube", "-1"}) {
    CHECK(error("component", "2", wrong) ==
          "/base/fill.file grain 2 is of no component: " + wanted);
  }
}

TEST_CASE("a column component is of no meaning to grains that are no mixture") {
  const ScratchFolder folder;
  folder.write("bed.csv", "x,y,z,r,component\n2,2,2,0.5,glass\n");
  CHECK(read_sweep(folder.write("s.json", R"({"name": "m", "base": {"fill.file": "bed.csv"}})"))
            .errors.empty());
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
  CHECK(error_of(R"([{"share": 1, "hull": {"size": 2}}])").starts_with("/m/0/hull a hull needs"));
  CHECK(error_of(R"([{"share": 1, "hull": {"file": "a.obj", "size": 0}}])") ==
        "/m/0/hull/size must be positive");
  CHECK(error_of(R"([{"share": 1, "hull": {"file": "a.obj", "vertices": [[0, 0, 0]]}}])")
            .starts_with("/m/0/hull/"));
}

}  // namespace grainsweep
