#include <cmath>

#include <catch2/catch.hpp>

#include "runner/tables/groups.hpp"
#include "runner/tables/packings.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/tables/table_texts.hpp"

namespace grainsweep {
namespace {

const Units millimetres{3.2, "mm", 2500.0};

TEST_CASE("lengths gain a column in the unit of the sweep, solid fractions porosity and density") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 5.0), settled_row("b", 5, 0.61, 5.2)};
  const auto lines = cells_of_table(packings_csv(rows, groups_of(rows), millimetres));
  const auto plain = cells_of_table(packings_csv(rows, groups_of(rows)));
  const auto cell_of = [&](const std::string& column) {
    const auto at = std::find(lines[0].begin(), lines[0].end(), column);
    REQUIRE(at != lines[0].end());
    return std::stod(lines[1][static_cast<std::size_t>(at - lines[0].begin())]);
  };
  CHECK(std::equal(plain[1].begin(), plain[1].end(), lines[1].begin()));
  CHECK(cell_of("width_mm") == 16.0);
  CHECK(cell_of("porosity") == 1.0 - 0.6);
  CHECK(cell_of("bulk_density") == 0.6 * 2500.0);
}

TEST_CASE("a component of a mixture has a bulk density and no porosity") {
  Columns<double> columns = {{"solid_fraction", "", "", [](double phi) { return cell(phi); }}};
  append_in_units_of_component(columns, Units{2.0, "mm", 2500.0});
  REQUIRE(columns.size() == 2);
  CHECK(columns[1].name == "bulk_density");
  CHECK(columns[1].cell(0.5) == "1250");
}

TEST_CASE("scatter and errors of porosity are those of the solid fraction") {
  const auto of_error = conversions_of("solid_fraction_error", "", millimetres);
  REQUIRE(of_error.size() == 2);
  CHECK(of_error[0].name == "porosity_error");
  CHECK(converted("0.001", of_error[0]) == "0.001");
  CHECK(of_error[1].name == "bulk_density_error");
  CHECK(converted("0.001", of_error[1]) == "2.5");
  CHECK(converted("", of_error[1]).empty());
  CHECK(conversions_of("solid_fraction_large", "", millimetres).empty());
  CHECK(conversions_of("low", "d or 1", millimetres).empty());
  CHECK(conversions_of("tube.diameter", "d", millimetres).empty());  // as the sweep has it
  CHECK(conversions_of("solid_fraction", "", {1.0, "m", {}}).size() == 1);
}

TEST_CASE("a short number is a short one in any unit") {
  const Conversion length{"low_mm", "mm", "", 0.0, 3.2};
  CHECK(3.2 * 0.1 != 0.32);
  CHECK(converted("0.1", length) == "0.32");
  CHECK(converted("6", length) == "19.2");
  CHECK(std::strtod(converted("1e-310", length).c_str(), nullptr) == 3.2 * 1e-310);
  CHECK(converted("0.12345678901234567", length) == cell(3.2 * 0.12345678901234567));
}

TEST_CASE("lengths are printed as finely in any unit as in d") {
  CHECK(length_text(0.198, 0.017, 3, std::nullopt) == "0.198 ± 0.017 d");
  CHECK(length_text(0.198, 0.017, 3, millimetres) == "0.198 ± 0.017 d = 0.634 ± 0.054 mm");
  CHECK(length_text(0.198, 0.017, 3, Units{450, "um", {}}) == "0.198 ± 0.017 d = 89.1 ± 7.7 µm");
  CHECK(length_text(0.198, NAN, 3, Units{0.0032, "m", {}}) == "0.198 d = 0.000634 m");
  CHECK(length_in(millimetres, 5) == "16");
  CHECK(length_in(Units{0.1, "mm", {}}, 3) == "0.3");
}

TEST_CASE("units are told with the density, if it is known") {
  CHECK(units_text(millimetres) == "d = 3.2 mm, grains of 2500 kg/m³");
  CHECK(units_text({450, "um", {}}) == "d = 450 µm");
  CHECK(bulk_density_text(millimetres, 0.6, 0.0011) == "1500 ± 3");
  CHECK(bulk_density_text(millimetres, 0.6, NAN) == "1500");
  CHECK(bulk_density_text({450, "um", {}}, 0.6, NAN) == "-");
}

}  // namespace
}  // namespace grainsweep
