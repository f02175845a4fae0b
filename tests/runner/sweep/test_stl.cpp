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
    CHECK(reading.faces == Loops{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {2, 1, 3}});
    CHECK(reading.face_places.back() == "rock.stl: triangle 4");
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
  CHECK(errors_of_stl(cut) ==
        Messages{"rock.stl: is cut off, or its number of triangles is wrong: 4 take 284 bytes (a "
                 "heading of 80, the number, and 50 for each), and it has 283"});
  std::string text = text_of(corner_of_a_cube);
  text.erase(text.rfind("endsolid"));
  CHECK(errors_of_stl(text) ==
        Messages{"rock.stl:29: the file ends without \"endsolid\": it is cut off"});
  text.erase(text.rfind("      vertex"));
  CHECK(errors_of_stl(text) ==
        Messages{"rock.stl:26: the file ends without \"endsolid\": it is cut off"});
  CHECK(errors_of_stl(text + "    endloop\n  endfacet\nendsolid\n") ==
        Messages{"rock.stl:28: a facet needs three corners, has 2"});
  CHECK(
      errors_of_stl("solid nothing\nendsolid\n") ==
      Messages{"rock.stl:1: no vertex in it; STL is text with lines \"vertex x y z\", or bytes: a "
               "heading of 80, the number of triangles and 50 for each"});
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

/// A bar along z, of the outline that corners in the plane z = 0 have, counter-clockwise.
std::string obj_of_bar(const std::vector<Vector>& outline) {
  std::string vertices, sides, ends[2] = {"f", "f"};
  const std::size_t n = outline.size();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t top = 0; top < 2; ++top) {
      vertices += "v " + std::to_string(outline[k].x()) + " " + std::to_string(outline[k].y()) +
                  " " + std::to_string(top) + "\n";
      ends[top] += " " + std::to_string(2 * k + top + 1);
    }
    const std::size_t next = (k + 1) % n;
    sides += "f " + std::to_string(2 * k + 1) + " " + std::to_string(2 * next + 1) + " " +
             std::to_string(2 * next + 2) + " " + std::to_string(2 * k + 2) + "\n";
  }
  return vertices + sides + ends[0] + "\n" + ends[1] + "\n";
}

std::vector<std::string> errors_of_body(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  folder.write(name, content);
  std::vector<std::string> errors;
  for (Diagnostic diagnostic : read_vertices(folder.path(name)).errors) {
    diagnostic.place.erase(0, folder.path("").size());
    errors.push_back(to_string(diagnostic));
  }
  return errors;
}

TEST_CASE("a body that is not convex is refused, though all its vertices lie on the hull") {
  const std::vector<Vector> angle = {Vector(0, 0, 0),     Vector(1, 0, 0),   Vector(1, 0.2, 0),
                                     Vector(0.2, 0.2, 0), Vector(0.2, 1, 0), Vector(0, 1, 0)};
  // The corner of the notch lies 0.2 below two sides; the first vertex is sqrt(2.04) from the last.
  CHECK(errors_of_body("angle.obj", obj_of_bar(angle)) ==
        Messages{"angle.obj:15: this face lies inside the hull of the vertices, 14 % of the "
                 "shape's extent deep: the shape is not convex, and only convex ones are packed; "
                 "give a file of its hull if that is meant"});
}

TEST_CASE("without faces a file is noted that has more vertices than corners") {
  const std::string cube =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
  const ScratchFolder folder;
  folder.write("cube.obj", cube);
  folder.write("hole.obj", cube + "v 0.5 0.5 0\nv 0.5 0.5 1\n");
  CHECK(read_vertices(folder.path("cube.obj")).note.empty());
  const VerticesReading reading = read_vertices(folder.path("hole.obj"));
  CHECK(reading.errors.empty());
  CHECK(
      reading.note ==
      "2 of its 10 vertices lie on edges or faces of their hull, which is packed; if they are of a "
      "hole or a notch, the shape is not convex, and the hull another");
}

TEST_CASE("convex bodies pass however their faces are cut, turned and rounded") {
  const std::vector<Vector> hexagon = {
      Vector(1, 0, 0),  Vector(0.5, 0.866025, 0),   Vector(-0.5, 0.866025, 0),
      Vector(-1, 0, 0), Vector(-0.5, -0.866025, 0), Vector(0.5, -0.866025, 0)};
  CHECK(errors_of_body("bar.obj", obj_of_bar(hexagon)).empty());
  CHECK(errors_of_body("turned.obj", obj_of_bar({hexagon.rbegin(), hexagon.rend()})).empty());
  CHECK(errors_of_body("corner.stl", bytes_of(corner_of_a_cube)).empty());
  // A square whose corners rounding has bent by 1e-6, cut along the diagonal that lies deeper.
  CHECK(errors_of_body("bent.obj",
                       "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.000001\nv 0.5 0.5 -1\n"
                       "f 1 2 3\nf 1 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n")
            .empty());
}

}  // namespace
}  // namespace grainsweep
