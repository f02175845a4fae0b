#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "runner/store/files.hpp"
#include "runner/store/states.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

StoredBed sample_bed() {
  StoredBed bed;
  bed.box = {20.0, 5.5, Boundary::periodic, Boundary::walls};
  bed.grains = {{0.1, 1.0 / 3.0, 5e-324, 0.5, 2.75, 6},
                {-0.0, 5.0, 1e300, 0.25, std::numeric_limits<double>::infinity(), -1}};
  return bed;
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
}

TEST_CASE("the file is little-endian with the layout its header states") {
  const std::string bytes = bed_bytes(sample_bed());
  CHECK(bytes.size() == 8 + 8 + 16 + 2 + 2 * 44 + 4);
  CHECK(bytes.substr(0, 16) == std::string("GRAINS1\n\2\0\0\0\0\0\0\0", 16));
  CHECK(bytes.substr(16, 8) == std::string("\0\0\0\0\0\0\x34\x40", 8));  // 20.0
  CHECK(bytes.substr(32, 2) == std::string("\0\1", 2));
}

TEST_CASE("a bed without grains can be stored") {
  CHECK(bed_from_bytes(bed_bytes({}), "x").grains.empty());
}

TEST_CASE("a cut or changed file is refused by name") {
  const std::string bytes = bed_bytes(sample_bed());
  for (std::size_t kept = 0; kept < bytes.size(); ++kept) {
    CHECK_THROWS_AS(bed_from_bytes(bytes.substr(0, kept), "x"), FileError);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    CHECK_THROWS_AS(bed_from_bytes(changed, "x"), FileError);
  }
  CHECK_THROWS_WITH(bed_from_bytes("", "out/states/a.grains"),
                    Catch::StartsWith("out/states/a.grains: damaged; remove it and run"));
}

TEST_CASE("a missing bed is named") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_bed(folder.path(), "job"), Catch::Contains("/states/job.grains"));
}

}  // namespace
}  // namespace grainsweep
