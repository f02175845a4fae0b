#include <string>

#include <catch2/catch.hpp>

#include "runner/sweep/bed_kind.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

/// The kind of the bed that a base describes, by its name; "" for none.
std::string kind_of(const std::string& base) {
  const auto reading = reading_of(R"({"name": "k", "base": )" + base + "}");
  REQUIRE(reading.errors.empty());
  const Job& job = reading.sweep.jobs.at(0);
  const auto kind = bed_kind(job.spec);
  if (kind) CHECK(bed_kind_called(name_of(*kind)) == kind);
  return kind ? name_of(*kind) : "";
}

TEST_CASE("beds are of the kind of those that were measured") {
  CHECK(kind_of("{}") == "spheres of one size");
  CHECK(kind_of(R"({"box.y": "periodic", "sizes.spread": 0.01})") == "spheres of one size");
  CHECK(kind_of(R"({"tube.diameter": 5})") == "spheres of one size");
  CHECK(kind_of(R"({"sizes.small_share": 0.3})") == "spheres of two sizes, 1 to 2");
  for (
      const char* sizes :
      {R"("small_share": 0.3, "size_ratio": 0.6)", R"("small_share": 0.3, "size_ratio": 0.9)",
       R"("distribution": {"lognormal": {"median": 0.7, "sigma": 0.5}})",
       R"("distribution": {"uniform": {"from": 0.5, "to": 1.5}})",
       R"("distribution": {"table": {"diameters": [2, 4, 6], "passing": [0, 0.5, 1]}, "size": 4})"}) {
    INFO(sizes);
    CHECK(kind_of(std::string(R"({"sizes": {)") + sizes + "}}") == "spheres of several sizes");
    CHECK(kind_of(std::string(R"({"tube.diameter": 9, "sizes": {)") + sizes + "}}") ==
          "spheres of several sizes");
  }
  CHECK(kind_of(R"({"tube.diameter": 5, "sizes.small_share": 0.3})") == "spheres of several sizes");
  CHECK(kind_of(R"({"shape": "pinacoid"})") == "pinacoids 1 by 1 by 1");
  CHECK(kind_of(R"({"shape.pinacoid.angle_deg": 60})") == "pinacoids 1 by 1 by 1");
}

TEST_CASE("beds of which nothing alike was measured are of no kind") {
  CHECK(kind_of(R"({"box.width": 3.9, "sizes.distribution.uniform": {"to": 1.2}})").empty());
  CHECK(kind_of(R"({"sizes": {"small_share": 0.3, "size_ratio": 0.49}})").empty());
  CHECK(kind_of(R"({"sizes.distribution.lognormal.sigma": 0.51})").empty());
  CHECK(kind_of(R"({"sizes.distribution.uniform": {"from": 0.5, "to": 1.6}})").empty());
  CHECK(kind_of(R"({"sizes.distribution.weibull": {}})").empty());
  CHECK(kind_of(R"({"shape": "pinacoid", "sizes.distribution.lognormal.sigma": 0.2})").empty());
  CHECK(kind_of(R"({"sizes.small_share": 1})").empty());
  CHECK(kind_of(R"({"sizes.spread": 0.1})").empty());
  CHECK(kind_of(R"({"shape.pinacoid.height": 0.9})").empty());
  CHECK(kind_of(R"({"shape.pinacoid.angle_deg": 55})").empty());
  CHECK(kind_of(R"({"shape": "pinacoid", "sizes.small_share": 0.2})").empty());
  CHECK(kind_of(R"({"shape": "cube"})").empty());
  CHECK(kind_of(R"({"tube.diameter": 5, "shape": "pinacoid"})").empty());
}

TEST_CASE("narrow beds of two sizes and of pinacoids have bounds as far as they were measured") {
  const std::string two = "spheres of two sizes, 1 to 2, in narrow gaps, ducts or tubes";
  const auto of_two = [](const std::string& box) {
    return kind_of("{" + box + R"(, "sizes.small_share": 0.3})");
  };
  CHECK(of_two(R"("box.width": 3.9)") == two);
  CHECK(of_two(R"("box.width": 2)") == two);
  CHECK(of_two(R"("box.width": 1.99)").empty());
  CHECK(of_two(R"("box": {"x": "walls", "length": 2, "width": 2})") == two);
  CHECK(of_two(R"("box": {"x": "walls", "length": 9, "width": 4.9})") == two);
  CHECK(of_two(R"("tube.diameter": 4.9)") == two);
  CHECK(of_two(R"("tube.diameter": 3)") == two);
  CHECK(of_two(R"("tube.diameter": 2.99)").empty());
  CHECK(kind_of(R"({"box.width": 3, "sizes": {"small_share": 0.3, "size_ratio": 0.6}})").empty());
  const std::string pinacoids = "pinacoids 1 by 1 by 1 in narrow gaps or ducts";
  const auto of_pinacoids = [](const std::string& box) {
    return kind_of("{" + box + R"(, "shape": "pinacoid"})");
  };
  CHECK(of_pinacoids(R"("box.width": 4)") == "pinacoids 1 by 1 by 1");
  CHECK(of_pinacoids(R"("box.width": 3.9)") == pinacoids);
  CHECK(of_pinacoids(R"("box.width": 2)") == pinacoids);
  CHECK(of_pinacoids(R"("box.width": 1.99)").empty());
  CHECK(of_pinacoids(R"("box": {"x": "walls", "length": 2.5, "width": 3})") == pinacoids);
  CHECK(of_pinacoids(R"("box": {"x": "walls", "length": 2.4, "width": 3})").empty());
}

TEST_CASE("walls nearer than 4 d, and ducts and tubes of less than 5 d, are narrow") {
  const auto is_narrow = [](const Box& box) {
    PackingSpec spec;
    spec.box = box;
    return bed_kind(spec) == BedKind::narrow_spheres;
  };
  CHECK(is_narrow(tube_of(4.99)));
  CHECK_FALSE(is_narrow(tube_of(5)));
  CHECK_FALSE(is_narrow({5, 4, Boundary::periodic, Boundary::walls}));
  CHECK(is_narrow({5, 3.99, Boundary::periodic, Boundary::walls}));
  CHECK_FALSE(is_narrow({5, 3.99, Boundary::periodic, Boundary::periodic}));
  CHECK_FALSE(is_narrow({5, 5, Boundary::walls, Boundary::walls}));
  CHECK(is_narrow({4.99, 8, Boundary::walls, Boundary::walls}));
  CHECK(is_narrow({3.99, 8, Boundary::walls, Boundary::periodic}));
}

TEST_CASE("beds that start from files are of no kind, however they are listed") {
  const ScratchFolder folder;
  folder.write("a.csv", "x,y,z,r\n2,2,2,0.5\n");
  for (const std::string fill : {R"("file": "a.csv")", R"("files": ["a.csv"])"}) {
    const auto reading =
        read_sweep(folder.write("s.json", R"({"name": "k", "base": {"fill": {)" + fill + "}}}"));
    REQUIRE(reading.errors.empty());
    const Job& job = reading.sweep.jobs.at(0);
    CHECK_FALSE(bed_kind(job.spec).has_value());
  }
}

}  // namespace
}  // namespace grainsweep
