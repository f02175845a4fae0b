#include <stdexcept>

#include <catch2/catch.hpp>

#include "runner/store/turned.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

std::string bytes_of(const Turned& turned) {
  std::string bytes;
  put_turned(bytes, turned);
  return bytes;
}

Turned taken(std::string_view bytes, std::size_t grains) { return take_turned(bytes, grains); }

TEST_CASE("orientations and mesh read back bit by bit and leave what follows them") {
  const std::string bytes = bytes_of(sample_turned()) + "rest";
  std::string_view left = bytes;
  const Turned back = take_turned(left, 2);
  CHECK(left == "rest");
  CHECK(bytes_of(back) == bytes_of(sample_turned()));
  CHECK(back.orientations == sample_turned().orientations);
  CHECK(back.mesh.faces == sample_turned().mesh.faces);
}

TEST_CASE("a mesh takes the bytes that its layout states") {
  // Two orientations, four vertices, four triangles.
  CHECK(bytes_of(sample_turned()).size() == 2 * 32 + 4 + 4 * 24 + 4 + 4 * (4 + 3 * 4));
}

TEST_CASE("bytes that end too early anywhere are refused") {
  const std::string bytes = bytes_of(sample_turned());
  for (std::size_t kept = 0; kept < bytes.size(); ++kept) {
    CHECK_THROWS_AS(taken(std::string_view(bytes).substr(0, kept), 2), std::length_error);
  }
}

TEST_CASE("counts that no file can hold are refused before anything is set aside for them") {
  const std::string bytes = bytes_of(sample_turned());
  const std::size_t vertices = 2 * 32, faces = vertices + 4 + 4 * 24, corners = faces + 4;
  for (const std::size_t count : {vertices, faces, corners}) {
    std::string changed = bytes;
    changed.replace(count, 4, "\xff\xff\xff\xff");
    CHECK_THROWS_AS(taken(changed, 2), std::length_error);
  }
  CHECK_THROWS_AS(taken(bytes, std::size_t{1} << 60), std::length_error);
}

TEST_CASE("a face that names no vertex is refused") {
  Turned turned = sample_turned();
  turned.mesh.faces[2][1] = 4;
  CHECK_THROWS_AS(taken(bytes_of(turned), 2), std::out_of_range);
  turned.mesh.faces[2][1] = -1;
  CHECK_THROWS_AS(taken(bytes_of(turned), 2), std::out_of_range);
}

}  // namespace
}  // namespace grainsweep
