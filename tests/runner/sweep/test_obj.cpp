#include <catch2/catch.hpp>

#include "runner/sweep/obj.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

std::vector<std::string> errors_of_obj(const std::string& text) {
  std::vector<std::string> errors;
  for (const Diagnostic& diagnostic : parse_obj(text, "rock.obj").errors) {
    errors.push_back(to_string(diagnostic));
  }
  return errors;
}

using Messages = std::vector<std::string>;

TEST_CASE("the vertices of an OBJ file are read past everything else in it") {
  const VerticesReading reading = parse_obj(
      "# a rock\r\nmtllib a.mtl\no rock\nv 1 2 3\r\n  v\t-0.5 1e-1 .25 1.0\nvn 0 0 1\n"
      "vt 0 0\nv 4 5 6 0.5 0.5 0.5\nf 1 2 3\n\n",
      "rock.obj");
  REQUIRE(reading.errors.empty());
  REQUIRE(reading.vertices.size() == 3);
  CHECK(reading.vertices[0] == Vector(1, 2, 3));
  CHECK(reading.vertices[1] == Vector(-0.5, 0.1, 0.25));
  CHECK(reading.vertices[2] == Vector(4, 5, 6));
}

TEST_CASE("coordinates that are missing or no numbers are refused with their line") {
  CHECK(errors_of_obj("v 1 2\nv 1 2 3\nv 1 two 3\nv 1 2 nan\nv inf 0 0\nv\n") ==
        Messages{"rock.obj:1: a vertex needs three coordinates, has 2",
                 "rock.obj:3: y must be a finite number, is \"two\"",
                 "rock.obj:4: z must be a finite number, is \"nan\"",
                 "rock.obj:5: x must be a finite number, is \"inf\"",
                 "rock.obj:6: a vertex needs three coordinates, has 0"});
}

TEST_CASE("an OBJ file without a vertex says so") {
  const Messages none{
      "rock.obj:1: no vertex in it; it is read as Wavefront OBJ, at least 4 lines \"v x y z\"; "
      "a file of STL must be called .stl"};
  CHECK(errors_of_obj("") == none);
  CHECK(errors_of_obj("f 1 2 3\nvn 0 0 1\n") == none);
}

TEST_CASE("faces of an OBJ file are read, in all ways in which their vertices are named") {
  const VerticesReading reading = parse_obj(
      "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/2/2 3//3\nf -3 -2 -1\nv 0 0 1\nf 2\t3 4 1\n",
      "rock.obj");
  REQUIRE(reading.errors.empty());
  CHECK(reading.faces == Loops{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {1, 2, 3, 0}});
  CHECK(reading.face_places ==
        std::vector<std::string>{"rock.obj:1", "rock.obj:5", "rock.obj:6", "rock.obj:8"});
}

TEST_CASE("faces of an OBJ file that cannot be are refused with their line") {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK(errors_of_obj(corners + "f 1 2 x\nf 0 1 2\nf 1 2\nf 1.5 2 3\n") ==
        Messages{"rock.obj:4: a face needs numbers of vertices, from 1, has \"x\"",
                 "rock.obj:5: a face needs numbers of vertices, from 1, has \"0\"",
                 "rock.obj:6: a face needs three vertices or more, has 2",
                 "rock.obj:7: a face needs numbers of vertices, from 1, has \"1.5\""});
  CHECK(errors_of_obj(corners + "f 1 2 3\nf 1 2 4\n") ==
        Messages{"rock.obj:5: the face has a vertex 4, and the file has those from 1 to 3"});
  CHECK(errors_of_obj(corners + "f -4 1 2\n") ==
        Messages{"rock.obj:4: the face has a vertex 0, and the file has those from 1 to 3"});
}

TEST_CASE("no more than twenty errors of an OBJ file are listed") {
  std::string text;
  for (int k = 0; k < 50; ++k) text += "v 0 0\n";
  CHECK(errors_of_obj(text).size() == 20);
}

TEST_CASE("an OBJ file that is missing is named") {
  const VerticesReading reading = read_obj("/nowhere/rock.obj");
  REQUIRE(reading.errors.size() == 1);
  CHECK(to_string(reading.errors[0]).find("/nowhere/rock.obj") != std::string::npos);
  CHECK(reading.vertices.empty());
}

}  // namespace
}  // namespace grainsweep
