#include <cerrno>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "runner/store/files.hpp"
#include "runner/store/states.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

/// Stores a bed of the packing "job", and returns the outcome that knows where.
Outcome stored(const TemporaryFolder& folder, const StoredBed& bed) {
  Outcome outcome = sample_outcome("job", 0.6, 6);
  add_stored_bed(folder.path(), bed, outcome);
  return outcome;
}

StoredBed sample_bed() {
  StoredBed bed;
  bed.job = "job";
  bed.state_hash = sample_outcome("job", 0.6, 6).result.state_hash;
  bed.box = {20.0, 5.5, Boundary::periodic, Boundary::walls};
  bed.grains = {{0.1, 1.0 / 3.0, 5e-324, 0.5, 2.75, 6},
                {-0.0, 5.0, 1e300, 0.25, std::numeric_limits<double>::infinity(), -1}};
  bed.curves = sample_curves();
  bed.forces = {{0, 1, 2.75}};
  bed.wall_forces = {{1, 2, 1.0 / 3.0}};
  return bed;
}

StoredBed bed_of_polyhedra() {
  StoredBed bed = sample_bed();
  bed.turned = sample_turned();
  return bed;
}

TEST_CASE("beds that cannot be used are told once for each file and reason, as they come") {
  const std::vector<BedFault> faults = {{"b", "p1", "missing"},
                                        {"a", "p2", "missing"},
                                        {"b", "p3", "missing"},
                                        {"b", "p4", "cut off"}};
  CHECK(lines_of(faults, "left out") ==
        std::vector<std::string>{"b: packings p1, p3: missing; left out",
                                 "a: packing p2: missing; left out",
                                 "b: packing p4: cut off; left out"});
  const std::vector<BedFault> many(20, {"b", "p", "missing"});
  CHECK(lines_of(many, "left out") ==
        std::vector<std::string>{"b: 20 packings, p, p and others: missing; left out"});
  CHECK(fault_of_bed("p", BedError({"a", "p2", "cut off"})).file == "a");
  CHECK(lines_of({fault_of_bed("p", FileError("a", "read", EIO))}, "left out").front() ==
        "packing p: a: cannot read: Input/output error; left out");
}

TEST_CASE("a stored bed of polyhedra reads back bit by bit") {
  const TemporaryFolder folder;
  const StoredBed back = read_bed(folder.path(), stored(folder, bed_of_polyhedra()));
  CHECK(bed_bytes(back) == bed_bytes(bed_of_polyhedra()));
  REQUIRE(back.turned);
  CHECK(back.turned->orientations == sample_turned().orientations);
  CHECK(back.turned->mesh(0).vertices == sample_turned().mesh(0).vertices);
  CHECK(back.turned->mesh(0).faces == sample_turned().mesh(0).faces);
}

TEST_CASE(
    "a stored bed of a mixture has a mesh for each component, and the component of each grain") {
  StoredBed bed = bed_of_polyhedra();
  bed.turned->meshes.push_back(bed.turned->meshes[0]);
  bed.turned->meshes[1].vertices[3][2] = 0.25;
  bed.turned->components = {1, 0};
  const TemporaryFolder folder;
  const StoredBed back = read_bed(folder.path(), stored(folder, bed));
  CHECK(bed_bytes(back) == bed_bytes(bed));
  REQUIRE(back.turned);
  CHECK(back.turned->components == bed.turned->components);
  CHECK(back.turned->mesh(0).vertices[3][2] == 0.25);
  CHECK(back.turned->mesh(1).vertices[3][2] == 1);
}

TEST_CASE("a stored bed of spheres reads back bit by bit, without orientations") {
  const TemporaryFolder folder;
  const StoredBed back = read_bed(folder.path(), stored(folder, sample_bed()));
  CHECK(bed_bytes(back) == bed_bytes(sample_bed()));
  REQUIRE(back.grains.size() == 2);
  CHECK(back.grains[0].y == 1.0 / 3.0);
  CHECK(back.grains[0].z == 5e-324);
  CHECK(std::signbit(back.grains[1].x));
  CHECK(back.grains[1].touching == -1);
  REQUIRE(back.forces.size() == 1);
  CHECK(back.forces[0].b == 1);
  CHECK(back.forces[0].magnitude == 2.75);
  REQUIRE(back.wall_forces.size() == 1);
  CHECK(back.wall_forces[0].wall == 2);
  CHECK(back.wall_forces[0].magnitude == 1.0 / 3.0);
  CHECK(back.box.width == 5.5);
  CHECK(back.box.x == Boundary::periodic);
  CHECK(back.box.y == Boundary::walls);
  CHECK(back.curves.profile_y.bins.at(0).small == 1.0 / 3.0);
  CHECK(back.curves.profile_z.bins.at(0).neighbours == -1);
  CHECK(std::isnan(back.curves.force_density.values.at(1)));
  CHECK(back.curves.sizes.at(0).packed == 1.0 / 3.0);
  CHECK(back.curves.components.at(0).nematic[2] == 0.75);
  CHECK(back.curves.components.at(1).contacts.at(1)[2] == 6);
  CHECK(back.curves.components.at(1).profile_z.bins.at(0).neighbours.at(1) == 9);
  CHECK_FALSE(back.turned);
}

TEST_CASE("a bed begins as its header states") {
  const std::string bytes = bed_bytes(sample_bed());
  CHECK(bytes.substr(0, 20) == std::string("GRAINS14\n\3\0\0\0\0\0\0\0job", 20));
}

TEST_CASE("the lines of forces and exact orientations read back") {
  StoredBed bed = bed_of_polyhedra();
  bed.lines = {{{0.6F, 0, 0.8F}, {0.25F, 0, -0.5F}, 3}};
  bed.wall_lines = {{{0, 0, -1}, {0, 0.125F, -0.5F}, 2}};
  bed.axes = {{0.5, -0.5, 0.5, 0.5}};
  const StoredBed back = bed_from_bytes(bed_bytes(bed)).value();
  CHECK(back.lines.at(0).normal == bed.lines[0].normal);
  CHECK(back.lines.at(0).lever == bed.lines[0].lever);
  CHECK(back.lines.at(0).constraints == 3);
  CHECK(back.wall_lines.at(0).lever[1] == 0.125F);
  CHECK(back.axes == bed.axes);
}

TEST_CASE("a bed without grains can be stored") {
  CHECK(bed_from_bytes(bed_bytes({})).value().grains.empty());
}

TEST_CASE("a cut or changed bed is refused by name") {
  const std::string bytes = GENERATE(bed_bytes(sample_bed()), bed_bytes(bed_of_polyhedra()));
  for (std::size_t kept = 0; kept < bytes.size(); ++kept) {
    CHECK_FALSE(bed_from_bytes(bytes.substr(0, kept)));
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    CHECK_FALSE(bed_from_bytes(changed));
  }
  const TemporaryFolder folder;
  const Outcome outcome = stored(folder, sample_bed());
  damage_bed(folder.path(), outcome, 30);
  CHECK_THROWS_WITH(
      read_bed(folder.path(), outcome),
      Catch::EndsWith("/shards/1-of-1.beds: packing job: damaged, or of another version"));
}

TEST_CASE("a missing bed is named") {
  const TemporaryFolder folder;
  Outcome outcome = stored(folder, sample_bed());
  outcome.stored_at += 1;
  CHECK_THROWS_WITH(read_bed(folder.path(), outcome), Catch::Contains("packing job: cut off"));
  outcome.shard = "2-of-2";
  CHECK_THROWS_WITH(read_bed(folder.path(), outcome),
                    Catch::Contains("/shards/2-of-2.beds: packing job: missing"));
}

TEST_CASE("the bed of another packing is not taken, wherever it stands") {
  const TemporaryFolder folder;
  StoredBed other = sample_bed();
  other.job = "other";
  CHECK_THROWS_WITH(read_bed(folder.path(), stored(folder, other)),
                    Catch::Contains("packing job: the bed of another packing"));
}

}  // namespace
}  // namespace grainsweep
