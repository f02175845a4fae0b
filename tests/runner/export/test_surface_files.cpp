#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/export/surface_files.hpp"
#include "runner/store/archive.hpp"
#include "tests/runner/export/touching_beds.hpp"

namespace grainsweep {
namespace {

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

/// Of binary STL.
struct Triangle {
  Eigen::Vector3f normal;
  std::array<Eigen::Vector3f, 3> corners;
  std::uint16_t number = 0;
};

std::vector<Triangle> triangles_in(const std::string& stl) {
  ByteReader bytes(std::string_view(stl).substr(80));
  std::uint32_t count = 0;
  bytes.take(count);
  REQUIRE(stl.size() == 84 + 50 * std::size_t{count});
  const auto take = [&](Eigen::Vector3f& v) {
    for (int axis = 0; axis < 3; ++axis) bytes.take(v[axis]);
  };
  std::vector<Triangle> triangles(count);
  for (Triangle& triangle : triangles) {
    take(triangle.normal);
    for (Eigen::Vector3f& v : triangle.corners) take(v);
    bytes.take(triangle.number);
  }
  return triangles;
}

/// How many triangles have each number.
std::map<int, int> numbers_in(const std::string& stl) {
  std::map<int, int> count;
  for (const Triangle& triangle : triangles_in(stl)) ++count[triangle.number];
  return count;
}

/// The highest corner.
float top_of(const std::string& stl) {
  float top = 0.0F;
  for (const Triangle& triangle : triangles_in(stl)) {
    for (const Eigen::Vector3f& v : triangle.corners) top = std::max(top, v.z());
  }
  return top;
}

TEST_CASE("binary STL has the triangles of each grain, with its id, and those of the container") {
  const std::string text = surfaces_stl(stacked_cubes());
  CHECK_THAT(text, Catch::StartsWith("grainsweep, lengths in d; "));
  CHECK(numbers_in(text) == std::map<int, int>{{0, 12}, {1, 12}, {2, 12}});
  const Triangle first = triangles_in(text).front();
  CHECK(first.number == 1);
  CHECK(first.normal == Eigen::Vector3f(0, 0, -1));
  CHECK(first.corners[0] == Eigen::Vector3f(1.5, 1.5, 0));
  CHECK(first.corners[1] == Eigen::Vector3f(1.5, 2.5, 0));
  CHECK(first.corners[2] == Eigen::Vector3f(2.5, 2.5, 0));
  CHECK(triangles_in(text).back().number == 0);
}

TEST_CASE("each side of a triangle in single precision is that of another, the other way round") {
  ExportedBed exported = stacked_spheres();
  exported.settings.treatment = *contact_treatment("bridge:0.2");
  exported.settings.lengths = {0.7, "mm", {}};
  using Corner = std::array<float, 3>;
  std::set<std::pair<Corner, Corner>> sides;
  std::size_t count = 0;
  for (const Triangle& triangle : triangles_in(surfaces_stl(exported))) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &a = triangle.corners[k], &b = triangle.corners[(k + 1) % 3];
      sides.insert({{a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()}});
      ++count;
    }
  }
  CHECK(sides.size() == count);
  for (const auto& [from, to] : sides) CHECK(sides.contains({to, from}));
}

TEST_CASE("a corner that single precision does not tell from its neighbour leaves no hole") {
  ExportedBed exported = stacked_cubes();
  for (auto& vertex : exported.bed.turned->meshes[0].vertices) vertex[0] *= 1e-9;  // all but flat
  exported.bed.grains.pop_back();
  // The two faces across are left, one upon the other: all others had a side between two corners
  // that are now one.
  CHECK(numbers_in(surfaces_stl(exported)) == std::map<int, int>{{0, 12}, {1, 4}});
}

TEST_CASE(
    "OBJ has the same surfaces as objects, called by id and size class, with their polygons") {
  ExportedBed exported = stacked_cubes();
  exported.small_limit = 0.3;
  exported.bed.grains[0].radius = 0.25;
  CHECK_THAT(surfaces_obj(exported), Catch::Contains("\no grain_1_small\n"));
  const std::string text = surfaces_obj(stacked_cubes());
  CHECK(count_of(text, "\no ") == 3);
  CHECK(count_of(text, "\nv ") == 3 * 8);
  CHECK(count_of(text, "\nf ") == 3 * 6);
  CHECK_THAT(text, Catch::Contains("o grain_2_large\nv 1.75 1.5 1\n") &&
                       Catch::Contains("\nf 9 11 12 10\n") &&
                       Catch::Contains("o container\nv 0 0 0\n"));
}

TEST_CASE("the faces of the container in OBJ are in groups by what they bound") {
  ExportedBed exported = stacked_cubes();
  exported.bed.box.x = Boundary::periodic;
  exported.bed.box.y = Boundary::walls;
  const std::string text = surfaces_obj(exported);
  CHECK_THAT(text, Catch::EndsWith("g container_floor\nf 20 19 18 17\n"
                                   "g container_periodic_x\nf 18 19 23 22\nf 20 17 21 24\n"
                                   "g container_top\nf 21 22 23 24\n"
                                   "g container_walls\nf 17 18 22 21\nf 19 20 24 23\n"));
}

TEST_CASE("lengths are in the unit that is asked for, those of cuts and necks, too") {
  ExportedBed exported = stacked_cubes();
  exported.settings.lengths = {2.0, "mm", {}};
  CHECK_THAT(surfaces_obj(exported), Catch::StartsWith("# grainsweep, lengths in mm\n") &&
                                         Catch::Contains("o grain_2_large\nv 3.5 3 2\n") &&
                                         Catch::Contains("o container\nv 0 0 0\n"));
  CHECK_THAT(surfaces_stl(exported), Catch::StartsWith("grainsweep, lengths in mm; "));
  CHECK(triangles_in(surfaces_stl(exported)).front().corners[0] == Eigen::Vector3f(3, 3, 0));
  exported.settings.treatment = *contact_treatment("bridge:0.2");
  CHECK(top_of(surfaces_stl(exported)) == 4.2F);
}

TEST_CASE("joined grains are one body, called by the first, below the container's top") {
  ExportedBed exported = stacked_cubes();
  exported.settings.treatment = *contact_treatment("bridge:0.2");
  const std::string text = surfaces_stl(exported);
  CHECK(numbers_in(text).size() == 2);
  CHECK(numbers_in(text).at(0) == 12);
  CHECK(numbers_in(text).at(1) > 12);
  CHECK(top_of(text) == 2.1F);
  CHECK_THAT(surfaces_obj(exported), Catch::Contains("\no joined_1\n"));
}

}  // namespace
}  // namespace grainsweep
