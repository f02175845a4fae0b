#include <catch2/catch.hpp>

#include "runner/jobs/estimates.hpp"

namespace grainsweep {
namespace {

TEST_CASE("the CPU time of all is their sum") {
  CHECK(total_cpu_seconds({{1.5, 10}, {2.0, 30}}) == 3.5);
  CHECK(total_cpu_seconds({}) == 0.0);
}

TEST_CASE("of packings that live at once the largest count") {
  const std::vector<Cost> costs = {{1, 10}, {1, 30}, {1, 20}};
  CHECK(bytes_of_largest(costs, 2) == 50.0);
  CHECK(bytes_of_largest(costs, 9) == 60.0);
  CHECK(bytes_of_largest({}, 2) == 0.0);
}

TEST_CASE("a packing takes the disk that its records take") {
  PackingSpec spec;
  spec.box = {10.0, 5.0, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{1000};
  CHECK(disk_needs(spec).grains == 1000.0 * (44.0 + 3.0 * 16.0));  // as runner/README.md says
  const double curves = disk_needs(spec).curves;
  spec.box.width = 6.0;                             // ten bins more, of six numbers each
  CHECK(disk_needs(spec).curves - curves < 480.0);  // and the bed is lower
  spec.box.y = Boundary::periodic;
  CHECK(disk_needs(spec).curves == Approx(curves - 50.0 * 48.0).epsilon(0.2));
  spec.shape = CubeSize{};
  CHECK(disk_needs(spec).grains == 1000.0 * (44.0 + 32.0 + 32.0 + 3.5 * 44.0));
  spec.shape = Mixture{{{0.5, SphereShape{}}, {0.5, CubeSize{}}}};
  CHECK(disk_needs(spec).curves > 2.0 * curves);
}

TEST_CASE("packings that are made teach those of the same estimate, and all teach the others") {
  const std::vector<double> seconds =
      learned({{1.0, 3.0}, {1.0, 5.0}, {1.0, std::nullopt}, {10.0, 28.0}, {20.0, std::nullopt}});
  CHECK(seconds[2] == Approx(4.0));
  CHECK(seconds[4] == Approx(20.0 * 36.0 / 12.0));
  CHECK(learned({{2.0, std::nullopt}}) == std::vector<double>{2.0});
  CHECK(learned({}).empty());
}

}  // namespace
}  // namespace grainsweep
