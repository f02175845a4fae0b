#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/export/grain_files.hpp"
#include "runner/sweep/grains_csv.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

ExportedBed exported_bed() {
  StoredBed bed;
  bed.box = {20.0, 5.5, Boundary::periodic, Boundary::walls};
  bed.grains = {{0.1, 1.0 / 3.0, 0.5, 0.5, 2.75, 6}, {19.25, 5.0, 1.5, 0.25, 1e-300, 0}};
  return {bed, 0.3};
}

/// One tetrahedron at twice its size, a quarter turn about z: x becomes y.
ExportedBed exported_turned_bed() {
  StoredBed bed;
  bed.box = {20.0, 5.5, Boundary::periodic, Boundary::walls};
  bed.grains = {{5, 2, 1, 1.0, 2.75, 6}, {6, 2, 1, 0.5, 0.5, 0}};
  bed.turned = Turned{{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                        {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}},
                      {},
                      {{0, 0, std::sqrt(0.5), std::sqrt(0.5)}, {0, 0, 0, 1}}};
  return {bed};
}

/// The numbers in the array called `name` of a VTP file.
std::vector<double> array_of(const std::string& text, const std::string& name) {
  const std::regex pattern("Name=\"" + name + "\"[^>]*format=\"ascii\">([^<]*)</DataArray>");
  std::smatch match;
  REQUIRE(std::regex_search(text, match, pattern));
  std::istringstream numbers(match[1].str());
  std::vector<double> values;
  for (std::string number; numbers >> number;) values.push_back(std::stod(number));
  return values;
}

TEST_CASE("CSV holds a row per grain that reads back exactly") {
  CHECK(grains_csv(exported_bed()) ==
        "id,size_class,x,y,z,radius,force,coordination\n"
        "1,large,0.1,0.3333333333333333,0.5,0.5,2.75,6\n"
        "2,small,19.25,5,1.5,0.25,1e-300,0\n");
}

TEST_CASE("lengths of grains are in the unit that is asked for, and forces stay") {
  ExportedBed exported = exported_bed();
  exported.settings.lengths = {2.0, "mm", {}};
  CHECK(grains_csv(exported) ==
        "id,size_class,x,y,z,radius,force,coordination\n"
        "1,large,0.2,0.6666666666666666,1,1,2.75,6\n"
        "2,small,38.5,10,3,0.5,1e-300,0\n");
  CHECK_THAT(grains_xyz(exported), Catch::Contains("Lattice=\"40 0 0 0 11 0 0 0 3.5\"") &&
                                       Catch::Contains(" length_unit=mm\n") &&
                                       Catch::Contains("\nX 38.5 10 3 2 2 0.5 0 1e-300\n"));
  CHECK(array_of(grains_vtp(exported), "radius") == std::vector<double>{1.0, 0.5});
  const std::string head = "<?xml version=\"1.0\"?>\n<!-- grainsweep, lengths in ";
  CHECK_THAT(grains_vtp(exported), Catch::StartsWith(head + "mm -->\n<VTKFile "));
  CHECK_THAT(grains_vtp(exported_bed()), Catch::StartsWith(head + "d -->\n<VTKFile "));
  ExportedBed turned = exported_turned_bed();
  const std::vector<double> in_d = array_of(grains_vtp(turned), "Points");
  turned.settings.lengths = exported.settings.lengths;
  CHECK_THAT(grains_vtp(turned), Catch::StartsWith(head + "mm -->\n"));
  const std::vector<double> in_mm = array_of(grains_vtp(turned), "Points");
  REQUIRE(in_mm.size() == in_d.size());
  for (std::size_t k = 0; k < in_d.size(); ++k) CHECK(in_mm[k] == 2.0 * in_d[k]);
}

TEST_CASE("extended XYZ holds count, box, periodic axes and a line per grain") {
  CHECK(grains_xyz(exported_bed()) ==
        "2\n"
        "Lattice=\"20 0 0 0 5.5 0 0 0 1.75\" "
        "Properties=species:S:1:pos:R:3:id:I:1:size_class:I:1:radius:R:1:coordination:I:1:"
        "force:R:1 pbc=\"T F F\" length_unit=d\n"
        "X 0.1 0.3333333333333333 0.5 1 1 0.5 6 2.75\n"
        "X 19.25 5 1.5 2 2 0.25 0 1e-300\n");
}

TEST_CASE("grains that are turned have their quaternion in CSV and extended XYZ") {
  ExportedBed bed = exported_turned_bed();
  bed.bed.turned->orientations = {{0, 0.6, 0, 0.8}, {0, 0, 0, 1}};
  CHECK(grains_csv(bed) ==
        "id,size_class,x,y,z,radius,force,coordination,qx,qy,qz,qw\n"
        "1,large,5,2,1,1,2.75,6,0,0.6,0,0.8\n"
        "2,large,6,2,1,0.5,0.5,0,0,0,0,1\n");
  CHECK_THAT(grains_xyz(bed), Catch::Contains("force:R:1:orientation:R:4 pbc=") &&
                                  Catch::EndsWith("X 6 2 1 2 1 0.5 0 0.5 0 0 0 1\n"));
}

TEST_CASE("the box of turned grains is as high as their highest vertex") {
  CHECK_THAT(grains_xyz(exported_turned_bed()),
             Catch::Contains("Lattice=\"20 0 0 0 5.5 0 0 0 3\""));
}

TEST_CASE("a bed that is written as CSV can be read as the grains of another packing") {
  const GrainsReading reading = parse_grains(grains_csv(exported_turned_bed()), "bed.csv");
  REQUIRE(reading.errors.empty());
  REQUIRE(reading.grains.size() == 2);
  CHECK(reading.grains[0].radius == 1.0);
  CHECK(reading.orientations == exported_turned_bed().bed.turned->orientations);
  CHECK(parse_grains(grains_csv(exported_bed()), "bed.csv").orientations.empty());
}

TEST_CASE("VTP holds the faces of grains that are turned, where they are") {
  const std::string text = grains_vtp(exported_turned_bed());
  CHECK_THAT(text, Catch::Contains("NumberOfPoints=\"8\" NumberOfVerts=\"0\"") &&
                       Catch::Contains("NumberOfPolys=\"8\"") &&
                       Catch::Contains("<CellData Scalars=\"size\">"));
  const auto points = array_of(text, "Points");
  REQUIRE(points.size() == 24);
  const std::vector<double> first = {5, 2, 1, 5, 4, 1, 3, 2, 1, 5, 2, 3};
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(points[i] == about(first[i], 1e-15));  // the root of a half is rounded
  }
  const auto corners = array_of(text, "connectivity");
  REQUIRE(corners.size() == 24);
  CHECK(std::vector<double>(corners.begin() + 9, corners.begin() + 15) ==
        std::vector<double>{1, 2, 3, 4, 6, 5});
  CHECK(array_of(text, "offsets") == std::vector<double>{3, 6, 9, 12, 15, 18, 21, 24});
  CHECK(array_of(text, "id") == std::vector<double>{1, 1, 1, 1, 2, 2, 2, 2});
  CHECK(array_of(text, "size") == std::vector<double>{2, 2, 2, 2, 1, 1, 1, 1});
  CHECK(array_of(text, "coordination") == std::vector<double>{6, 6, 6, 6, 0, 0, 0, 0});
  CHECK(array_of(text, "force") == std::vector<double>{2.75, 2.75, 2.75, 2.75, .5, .5, .5, .5});
}

TEST_CASE("VTP arrays read back as the grains") {
  const std::string text = grains_vtp(exported_bed());
  CHECK_THAT(text, Catch::Contains("NumberOfPoints=\"2\"") && Catch::EndsWith("</VTKFile>\n"));
  CHECK(array_of(text, "Points") == std::vector<double>{0.1, 1.0 / 3.0, 0.5, 19.25, 5.0, 1.5});
  CHECK(array_of(text, "radius") == std::vector<double>{0.5, 0.25});
  CHECK(array_of(text, "id") == std::vector<double>{1, 2});
  CHECK(array_of(text, "size_class") == std::vector<double>{1, 2});
  CHECK(array_of(text, "coordination") == std::vector<double>{6, 0});
  CHECK(array_of(text, "force") == std::vector<double>{2.75, 1e-300});
  CHECK(array_of(text, "connectivity") == std::vector<double>{0, 1});
  CHECK(array_of(text, "offsets") == std::vector<double>{1, 2});
}

TEST_CASE("every opened element of a VTP file is closed, innermost first") {
  const std::string text = GENERATE(grains_vtp(exported_bed()), grains_vtp(exported_turned_bed()));
  const std::regex element("<(/?)([A-Za-z]+)[^>]*>");
  std::vector<std::string> open;
  for (std::sregex_iterator tag(text.begin(), text.end(), element), end; tag != end; ++tag) {
    if ((*tag)[1].length() == 0) {
      open.push_back((*tag)[2]);
    } else {
      REQUIRE(!open.empty());
      CHECK(open.back() == (*tag)[2].str());
      open.pop_back();
    }
  }
  CHECK(open.empty());
}

TEST_CASE("grains of a mixture tell their component, and have faces of its mesh alone") {
  ExportedBed exported = exported_turned_bed();
  Turned& turned = *exported.bed.turned;
  turned.components = {1, 0};
  const double half = 0.5;  // a pyramid of five faces
  turned.meshes.push_back(
      {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}, {0, 0, 1}},
       {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}});
  const std::string csv = grains_csv(exported);
  CHECK(csv.substr(0, csv.find('\n')).ends_with(",qw,component"));
  CHECK_THAT(csv, Catch::Contains(",2\n2,large,") && Catch::EndsWith(",0,0,0,1,1\n"));
  const std::string xyz = grains_xyz(exported);
  CHECK_THAT(xyz, Catch::Contains(":orientation:R:4:component:I:1 pbc"));
  const std::string vtp = grains_vtp(exported);
  CHECK(array_of(vtp, "component") == std::vector<double>{2, 2, 2, 2, 2, 1, 1, 1, 1});
  CHECK(array_of(vtp, "Points").size() == 3 * (5 + 4));
  const std::vector<double> corners = array_of(vtp, "connectivity");
  REQUIRE(corners.size() == 4 + 4 * 3 + 4 * 3);
  CHECK(corners[16] == 5);  // the first corner of the second grain
  CHECK(array_of(vtp, "offsets").back() == 28);
}

}  // namespace
}  // namespace grainsweep
