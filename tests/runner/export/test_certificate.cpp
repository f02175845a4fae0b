#include <cmath>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "runner/exit_codes.hpp"
#include "runner/export/certificate.hpp"
#include "tests/runner/export/touching_beds.hpp"

namespace grainsweep {
namespace {

/// A sphere in a corner of the walls y and the floor, and one that leans on it and on both walls.
ExportedBed leaning_spheres() {
  // Across 1.5 d the centres are 0.5 d apart, and as high as sqrt(3)/2 d one above the other.
  const double rise = std::sqrt(0.75), tilted = 1.0 / rise;
  ExportedBed exported;
  exported.bed.job = "0123456789abcdef";
  exported.bed.box = {4, 1.5, Boundary::periodic, Boundary::walls};
  exported.bed.grains = {{2, 0.5, 0.5, 0.5, 0, 1}, {2, 1.0, 0.5 + rise, 0.5, 0, 1}};
  exported.bed.forces = {{0, 1, tilted}};
  exported.bed.wall_forces = {{0, 0, 2.0}, {0, 1, 0.5 * tilted}, {1, 2, 0.5 * tilted}};
  return exported;
}

TEST_CASE("a certificate tells what holds a bed, and what the program finds of it") {
  const auto certificate = nlohmann::json::parse(certificate_json(leaning_spheres()));
  CHECK(certificate["job"] == "0123456789abcdef");
  CHECK(certificate["box"]["y"] == "walls");
  CHECK(certificate["spheres"][1][2] == 0.5 + std::sqrt(0.75));
  CHECK(certificate["forces"].size() == 1);
  CHECK(certificate["wall_forces"][1][1] == "y_low");
  const auto& found = certificate["found"];
  CHECK(found["imbalance_max"].get<double>() < 1e-15);
  CHECK(std::abs(found["overlap_max"].get<double>()) < 1e-15);
  CHECK(found["contacts"] == 4);
  CHECK(found["least_force"].get<double>() == Approx(0.5 / std::sqrt(0.75)));
  // Both may go along x, together; across it they are held, twice over or not: 3 n - 1.
  CHECK(found["degrees_of_freedom"] == 5);
  REQUIRE(certificate["free_motions"].size() == 1);
  CHECK(certificate["free_motions"][0]["spheres"].size() == 2);
  CHECK(certificate["free_motions"][0]["direction"][0] == 1.0);
}

TEST_CASE("grains that touch without a force are no contact of a certificate") {
  ExportedBed exported = leaning_spheres();
  const auto before = nlohmann::json::parse(certificate_json(exported));
  exported.gap_tolerance = 1e-4;
  exported.bed.grains.push_back({3, 0.5, 0.5, 0.5, 0, 2});  // beside the first, and at the walls
  const auto found = nlohmann::json::parse(certificate_json(exported))["found"];
  CHECK(found["contacts"] == 4);
  CHECK(found["least_force"] == before["found"]["least_force"]);
}

TEST_CASE("a certificate tells of a net force, of an overlap, and of turns about a tube's axis") {
  ExportedBed exported;
  exported.bed.box = tube_of(4);
  exported.bed.grains = {{2, 2, 0.4, 0.5, 0, 1}};
  exported.bed.wall_forces = {{0, 0, 1.25}};
  const auto certificate = nlohmann::json::parse(certificate_json(exported));
  CHECK(certificate["found"]["imbalance_max"].get<double>() == Approx(0.25));
  CHECK(certificate["found"]["overlap_max"].get<double>() == Approx(0.1));
  CHECK(certificate["box"]["tube"] == 4.0);
  REQUIRE(certificate["free_motions"].size() == 2);  // along x, along y: to turn is no other motion
  exported.bed.grains.push_back({1.4, 2, 1.2, 0.5, 0, 1});
  exported.bed.forces = {{0, 1, 1.0}};
  const auto of_pair = nlohmann::json::parse(certificate_json(exported));
  REQUIRE(of_pair["free_motions"].size() == 3);
  CHECK(of_pair["free_motions"][2]["turn"] == "axis");
}

TEST_CASE("beds of polyhedra have no certificate") {
  CHECK_THROWS_AS(certificate_json(stacked_cubes()), BadInput);
}

}  // namespace
}  // namespace grainsweep
