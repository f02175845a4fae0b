#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/sweep/bed_kind.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

/// The kind of the bed that a base describes, by its name; "" for none.
std::string kind_of(const std::string& base) {
  const auto reading = reading_of(R"({"name": "k", "base": )" + base + "}");
  REQUIRE(reading.errors.empty());
  const Job& job = reading.sweep.jobs.at(0);
  const auto kind = bed_kind(name_of(job.spec.shape), job.spec.box, job.spec.sizes.small_share,
                             nlohmann::json::parse(job.parameters));
  return kind ? name_of(*kind) : "";
}

TEST_CASE("beds are of the kind of those that were measured") {
  CHECK(kind_of("{}") == "spheres of one size");
  CHECK(kind_of(R"({"box.y": "periodic", "sizes.spread": 0.01})") == "spheres of one size");
  CHECK(kind_of(R"({"tube.diameter": 5})") == "spheres of one size");
  CHECK(kind_of(R"({"sizes.small_share": 0.3})") == "spheres of two sizes, 1 to 2");
  CHECK(kind_of(R"({"shape": "pinacoid"})") == "pinacoids 1 by 1 by 1");
  CHECK(kind_of(R"({"shape.pinacoid.angle_deg": 60})") == "pinacoids 1 by 1 by 1");
}

TEST_CASE("beds of which nothing alike was measured are of no kind") {
  CHECK(kind_of(R"({"sizes": {"small_share": 0.3, "size_ratio": 0.4}})").empty());
  CHECK(kind_of(R"({"sizes.small_share": 1})").empty());
  CHECK(kind_of(R"({"sizes.spread": 0.1})").empty());
  CHECK(kind_of(R"({"shape.pinacoid.height": 0.9})").empty());
  CHECK(kind_of(R"({"shape.pinacoid.angle_deg": 55})").empty());
  CHECK(kind_of(R"({"shape": "pinacoid", "sizes.small_share": 0.2})").empty());
  CHECK(kind_of(R"({"shape": "cube"})").empty());
  CHECK(kind_of(R"({"tube.diameter": 5, "sizes.small_share": 0.3})").empty());
  CHECK(kind_of(R"({"tube.diameter": 5, "shape": "pinacoid"})").empty());
  CHECK(kind_of(R"({"sizes.distribution.lognormal.sigma": 0.2})").empty());
}

TEST_CASE("beds that start from files are of no kind, however they are listed") {
  const ScratchFolder folder;
  folder.write("a.csv", "x,y,z,r\n2,2,2,0.5\n");
  for (const std::string fill : {R"("file": "a.csv")", R"("files": ["a.csv"])"}) {
    const auto reading =
        read_sweep(folder.write("s.json", R"({"name": "k", "base": {"fill": {)" + fill + "}}}"));
    REQUIRE(reading.errors.empty());
    const Job& job = reading.sweep.jobs.at(0);
    CHECK_FALSE(
        bed_kind("sphere", job.spec.box, 0.0, nlohmann::json::parse(job.parameters)).has_value());
  }
}

}  // namespace
}  // namespace grainsweep
