#include <cstdint>
#include <cstring>
#include <limits>

#include <catch2/catch.hpp>

#include "runner/sweep/stl.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

using Triangle = std::array<Vector, 3>;

/// The faces of the tetrahedron at the corner of a cube.
const std::vector<Triangle> corner_of_a_cube = {
    Triangle{Vector(0, 0, 0), Vector(0, 1, 0), Vector(1, 0, 0)},
    Triangle{Vector(0, 0, 0), Vector(0, 0, 1), Vector(0, 1, 0)},
    Triangle{Vector(0, 0, 0), Vector(1, 0, 0), Vector(0, 0, 1)},
    Triangle{Vector(1, 0, 0), Vector(0, 1, 0), Vector(0, 0, 1)}};

void add_bytes(float value, std::string& bytes) {
  char four[sizeof value];
  std::memcpy(four, &value, sizeof value);
  bytes.append(four, sizeof value);
}

/// The same in bytes, as most programs write it.
std::string bytes_of(const std::vector<Triangle>& triangles) {
  std::string bytes = "solid in spite of its first word, in bytes";
  bytes.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(triangles.size());
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const Triangle& triangle : triangles) {
    for (int k = 0; k < 3; ++k) add_bytes(0.5F, bytes);  // the normal, which nothing reads
    for (const Vector& corner : triangle) {
      for (int k = 0; k < 3; ++k) add_bytes(static_cast<float>(corner[k]), bytes);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string text_of(const std::vector<Triangle>& triangles) {
  std::string text = "solid rock\n";
  for (const Triangle& triangle : triangles) {
    text += "  facet normal 0 0 1\r\n    outer loop\n";
    for (const Vector& corner : triangle) {
      text += "      vertex\t" + std::to_string(corner.x()) + " " + std::to_string(corner.y()) +
              "  " + std::to_string(corner.z()) + "e0\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid rock\n";
}

std::vector<std::string> errors_of_stl(const std::string& bytes) {
  std::vector<std::string> errors;
  for (const Diagnostic& diagnostic : parse_stl(bytes, "rock.stl").errors) {
    errors.push_back(to_string(diagnostic));
  }
  return errors;
}

using Messages = std::vector<std::string>;

TEST_CASE("the corners of an STL file are taken once each, from text and from bytes") {
  const std::vector<Vector> corners = {Vector(0, 0, 0), Vector(0, 1, 0), Vector(1, 0, 0),
                                       Vector(0, 0, 1)};
  for (const std::string& file : {text_of(corner_of_a_cube), bytes_of(corner_of_a_cube)}) {
    const VerticesReading reading = parse_stl(file, "rock.stl");
    REQUIRE(reading.errors.empty());
    CHECK(reading.vertices == corners);
  }
}

TEST_CASE("faults of an STL file are told with their place") {
  CHECK(errors_of_stl("solid a\nvertex 1 2\n vertex 1 2 x\nvertex 1 2 3\n") ==
        Messages{"rock.stl:2: a vertex needs three coordinates, has 2",
                 "rock.stl:3: z must be a finite number, is \"x\""});
  std::vector<Triangle> far = corner_of_a_cube;
  far[2][1].x() = std::numeric_limits<double>::infinity();
  CHECK(errors_of_stl(bytes_of(far)) ==
        Messages{"rock.stl: triangle 3 has a corner whose coordinates are no finite numbers"});
}

TEST_CASE("an STL file that is cut short, or none, says so") {
  std::string cut = bytes_of(corner_of_a_cube);
  cut.pop_back();
  const std::string start =
      "rock.stl:1: no vertex in it; STL is text with lines \"vertex x y z\", or bytes: a heading "
      "of "
      "80, the number of triangles and 50 for each, ";
  CHECK(errors_of_stl(cut) == Messages{start + "284 in all, not 283"});
  CHECK(errors_of_stl("solid nothing\nendsolid\n") == Messages{start + "84 in all, not 23"});
}

TEST_CASE("a file is STL by its name, in capitals or not, and else OBJ") {
  CHECK(is_stl("a.stl"));
  CHECK(is_stl("folder.obj/A.STL"));
  CHECK_FALSE(is_stl("a.obj"));
  CHECK_FALSE(is_stl("stl"));
  CHECK_FALSE(is_stl("a.stl.obj"));
  const ScratchFolder folder;
  folder.write("a.Stl", text_of(corner_of_a_cube));
  folder.write("a.obj", "v 1 2 3\n");
  CHECK(read_vertices(folder.path("a.Stl")).vertices.size() == 4);
  CHECK(read_vertices(folder.path("a.obj")).vertices.size() == 1);
  CHECK(read_vertices("/nowhere/rock.stl").errors.size() == 1);
}

}  // namespace
}  // namespace grainsweep
