#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/size_rows.hpp"

namespace grainsweep {
namespace {

SizeCurve curve_by(SizeWeight by, const SizeFormula& formula) {
  return curve_of(SizeDistribution{formula, by, {}, {}});
}

const SizeTable two_grades{{0.5, 1.0}, {}, {0.5, 0.5}};

/// Eight grains of half the size and one of the whole: half the volume each. The large one and four
/// small ones lie above z = 2.
SphereBed mixed_bed() {
  std::vector<PlacedSphere> grains = {{5.0, 5.0, 3.0, 0.5}};
  for (int i = 0; i < 8; ++i) grains.push_back({1.0 + i, 1.0, i < 4 ? 1.0 : 3.0, 0.25});
  return make_bed(Box{.length = 10.0, .width = 10.0}, grains);
}

/// Of a bed whose grains have one shape.
std::vector<SizeRow> rows_of(const SphereBed& bed, const SizeCurve& curve, const Slab& slab) {
  return size_rows(bed, curve, slab, std::vector<double>(bed.grains(), 1.0));
}

TEST_CASE(
    "a table has a row for each of its diameters, with what is packed beside what was asked") {
  const auto rows = rows_of(mixed_bed(), curve_by(SizeWeight::volume, two_grades), {2.0, 4.0});
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].diameter == 0.5);
  CHECK(rows[0].asked == 0.5);
  CHECK(rows[0].packed == 0.5);
  CHECK(rows[0].slab == Approx(1.0 / 3.0));
  CHECK(rows[1].diameter == 1.0);
  CHECK(rows[1].asked == 1.0);
  CHECK(rows[1].packed == 1.0);
  CHECK(rows[1].slab == 1.0);
}

TEST_CASE("a grain belongs to the diameter that it was drawn with, to rounding") {
  SphereBed bed = mixed_bed();
  for (Record<double>& grain : bed.position) grain.w = std::nextafter(grain.w, 1.0);
  const auto rows = rows_of(bed, curve_by(SizeWeight::volume, two_grades), {2.0, 4.0});
  CHECK(rows[0].packed == Approx(0.5));
  CHECK(rows[1].packed == Approx(1.0));
}

TEST_CASE("shares of sizes are by number or area where the distribution is") {
  const auto by = [](SizeWeight weight) {
    return rows_of(mixed_bed(), curve_by(weight, two_grades), {2.0, 4.0}).front();
  };
  CHECK(by(SizeWeight::number).packed == Approx(8.0 / 9.0));
  CHECK(by(SizeWeight::number).slab == Approx(4.0 / 5.0));
  CHECK(by(SizeWeight::area).packed == Approx(2.0 / 3.0));
}

TEST_CASE("in a mixture shares go by what grains of each shape weigh") {
  std::vector<double> unit_weights(9, 2.0);  // the small ones are of a shape twice as bulky
  unit_weights[0] = 1.0;
  const auto rows =
      size_rows(mixed_bed(), curve_by(SizeWeight::volume, two_grades), {2.0, 4.0}, unit_weights);
  CHECK(rows[0].packed == Approx(2.0 / 3.0));
  CHECK(rows[0].slab == Approx(0.5));
  CHECK(rows[1].packed == 1.0);
}

TEST_CASE("a formula is told at diameters evenly spaced in their logarithm, from end to end") {
  const SizeCurve curve = curve_by(SizeWeight::number, UniformSizes{0.25, 4.0});
  const auto rows = rows_of(mixed_bed(), curve, {2.0, 4.0});
  REQUIRE(rows.size() == 25);
  CHECK(rows.front().diameter == 0.25);
  CHECK(rows[12].diameter == Approx(1.0));
  CHECK(rows[12].asked == Approx(0.75 / 3.75));
  CHECK(rows.back().diameter == Approx(4.0));
  CHECK(rows.back().asked == Approx(1.0));
  CHECK(rows.back().packed == 1.0);
}

TEST_CASE("a slab without grains has no shares") {
  const auto rows = rows_of(mixed_bed(), curve_by(SizeWeight::volume, two_grades), {8.0, 9.0});
  CHECK(std::isnan(rows.front().slab));
  CHECK(rows.front().packed == 0.5);
}

}  // namespace
}  // namespace grainsweep
