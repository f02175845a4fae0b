#include <cmath>
#include <fstream>
#include <limits>

#include <catch2/catch.hpp>

#include "runner/store/files.hpp"
#include "runner/store/states.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

StoredBed sample_bed() {
  StoredBed bed;
  bed.box = {20.0, 5.5, Boundary::periodic, Boundary::walls};
  bed.grains = {{0.1, 1.0 / 3.0, 5e-324, 0.5, 2.75, 6},
                {-0.0, 5.0, 1e300, 0.25, std::numeric_limits<double>::infinity(), -1}};
  bed.curves = sample_curves();
  return bed;
}

StoredBed turned_bed() {
  StoredBed bed = sample_bed();
  bed.turned = sample_turned();
  return bed;
}

TEST_CASE("a stored bed of turned grains reads back bit by bit") {
  const TemporaryFolder folder;
  write_bed(folder.path(), "job", turned_bed());
  const StoredBed back = read_bed(folder.path(), "job");
  CHECK(bed_bytes(back) == bed_bytes(turned_bed()));
  REQUIRE(back.turned);
  CHECK(back.turned->orientations == sample_turned().orientations);
  CHECK(back.turned->mesh.vertices == sample_turned().mesh.vertices);
  CHECK(back.turned->mesh.faces == sample_turned().mesh.faces);
  CHECK(read_curves(folder.path(), "job"));
}

TEST_CASE("spheres carry nothing of orientations, turned grains say by the file's start") {
  const std::string spheres = bed_bytes(sample_bed()), turned = bed_bytes(turned_bed());
  CHECK_FALSE(bed_from_bytes(spheres, "x").turned);
  CHECK(turned.substr(0, 8) == "GRAINS3\n");
  CHECK(turned.size() == spheres.size() + 2 * 32 + 4 + 4 * 24 + 4 + 4 * 16);
}

TEST_CASE("a stored bed reads back bit by bit") {
  const TemporaryFolder folder;
  write_bed(folder.path(), "job", sample_bed());
  const StoredBed back = read_bed(folder.path(), "job");
  CHECK(bed_bytes(back) == bed_bytes(sample_bed()));
  REQUIRE(back.grains.size() == 2);
  CHECK(back.grains[0].y == 1.0 / 3.0);
  CHECK(back.grains[0].z == 5e-324);
  CHECK(std::signbit(back.grains[1].x));
  CHECK(back.grains[1].touching == -1);
  CHECK(back.box.width == 5.5);
  CHECK(back.box.x == Boundary::periodic);
  CHECK(back.box.y == Boundary::walls);
  CHECK(back.curves.profile_y.bins.at(0).small == 1.0 / 3.0);
}

TEST_CASE("curves are read without the grains, however many there are") {
  const TemporaryFolder folder;
  StoredBed bed = sample_bed();
  bed.grains.resize(10'000);
  write_bed(folder.path(), "job", bed);
  std::string read, written;
  put_curves(read, read_curves(folder.path(), "job").value());
  put_curves(written, bed.curves);
  CHECK(read == written);
  // What lies behind them does not matter.
  const std::string path = state_path(folder.path(), "job"), bytes = read_file(path);
  replace_file(path, bytes.substr(0, 16 + written.size() + 4));
  CHECK(read_curves(folder.path(), "job"));
  CHECK_THROWS_AS(read_bed(folder.path(), "job"), FileError);
}

TEST_CASE("missing, cut or changed curves are none") {
  const TemporaryFolder folder;
  CHECK_FALSE(read_curves(folder.path(), "job"));
  const std::string bytes = bed_bytes(sample_bed()), path = state_path(folder.path(), "job");
  std::string curves;
  put_curves(curves, sample_curves());
  const std::size_t first_part = 16 + curves.size() + 4;
  write_bed(folder.path(), "job", {});
  const auto write_quickly = [&](const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  };
  for (std::size_t kept = 0; kept < first_part; ++kept) {
    write_quickly(bytes.substr(0, kept));
    CHECK_FALSE(read_curves(folder.path(), "job"));
  }
  for (std::size_t bit = 0; bit < 8 * first_part; ++bit) {
    std::string changed = bytes;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << (bit % 8)));
    write_quickly(changed);
    CHECK_FALSE(read_curves(folder.path(), "job"));
  }
  write_quickly(bytes.substr(0, 8) + std::string(8, '\xff') + bytes.substr(16));
  CHECK_FALSE(read_curves(folder.path(), "job"));
}

TEST_CASE("the file is little-endian with the layout its header states") {
  const std::string bytes = bed_bytes(sample_bed());
  std::string curves;
  put_curves(curves, sample_curves());
  REQUIRE(curves.size() < 256);
  const std::string length = static_cast<char>(curves.size()) + std::string(7, '\0');
  CHECK(bytes.substr(0, 16) == "GRAINS2\n" + length);
  CHECK(bytes.substr(16, curves.size()) == curves);
  const std::string rest = bytes.substr(16 + curves.size() + 4);
  CHECK(rest.size() == 8 + 16 + 2 + 2 * 44 + 4);
  CHECK(rest.substr(0, 8) == std::string("\2\0\0\0\0\0\0\0", 8));
  CHECK(rest.substr(8, 8) == std::string("\0\0\0\0\0\0\x34\x40", 8));  // 20.0
  CHECK(rest.substr(24, 2) == std::string("\0\1", 2));
}

TEST_CASE("a bed without grains can be stored") {
  CHECK(bed_from_bytes(bed_bytes({}), "x").grains.empty());
}

TEST_CASE("a cut or changed file is refused by name") {
  const std::string bytes = GENERATE(bed_bytes(sample_bed()), bed_bytes(turned_bed()));
  for (std::size_t kept = 0; kept < bytes.size(); ++kept) {
    CHECK_THROWS_AS(bed_from_bytes(bytes.substr(0, kept), "x"), FileError);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    CHECK_THROWS_AS(bed_from_bytes(changed, "x"), FileError);
  }
  CHECK_THROWS_WITH(
      bed_from_bytes("", "out/states/a.grains"),
      Catch::StartsWith("out/states/a.grains: damaged, or of another version; remove it"));
}

TEST_CASE("a missing bed is named") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_bed(folder.path(), "job"), Catch::Contains("/states/job.grains"));
}

}  // namespace
}  // namespace grainsweep
