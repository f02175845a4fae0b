#include <catch2/catch.hpp>

#include "runner/tables/shape_columns.hpp"

namespace grainsweep {
namespace {

TEST_CASE("every column of shapes holds the value that it names") {
  const ShapeOrder order{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  CHECK(shape_values(order) == std::array<double, 9>{1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(shape_columns[2] == std::string("contacts_triple"));
  CHECK(shape_columns[3] == std::string("force_simple"));
  CHECK(shape_columns[8] == std::string("nematic_z"));
}

TEST_CASE("columns of means have their standard deviation beside them") {
  CHECK(shape_header(false).size() == 9);
  const auto names = shape_header(true);
  REQUIRE(names.size() == 18);
  CHECK(names[16] == "nematic_z");
  CHECK(names[17] == "nematic_z_sd");
}

}  // namespace
}  // namespace grainsweep
