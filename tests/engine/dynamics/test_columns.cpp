#include <cmath>

#include <catch2/catch.hpp>

#include "engine/dynamics/columns.hpp"
#include "engine/dynamics/step.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::kernels;

constexpr double step_length = 0.1;
constexpr double unit = step_length * step_length;  // impulse of 1 m g

/// The contacts of a bed whose neighbours touch, each with an impulse of `forces`, m g.
SphereContacts<double> touching_contacts(SphereBed& bed, double force) {
  Candidates candidates;
  SphereContacts<double> contacts;
  renew_candidates(1e-3, 1e-3, kernels(), bed, candidates);
  lay_out(bed, candidates, contacts);
  update_gaps(bed, kernels(), 1.0, contacts);
  for (std::size_t at = 0; at < contacts.impulse.size(); ++at) {
    const auto& row = contacts.rows[at / block_width];
    const bool touches = row.gap[at % block_width] < 1e-3;
    contacts.impulse[at] = touches ? force * unit : 0.0;
  }
  return contacts;
}

TEST_CASE("each contact of a column carries the weight above it, whatever it carried before") {
  constexpr int spheres = 12;
  SphereBed bed = testing::column_bed(spheres, 0.0);
  SphereContacts<double> contacts = touching_contacts(bed, 8.0);
  carry_weight(step_length, bed, contacts);
  int seen = 0;
  for (const ForceContact& c : force_contacts(bed, step_length, contacts)) {
    const double low = bed.is_grain(c.b) ? std::min(bed.position[static_cast<std::size_t>(c.a)].z,
                                                    bed.position[static_cast<std::size_t>(c.b)].z)
                                         : bed.position[static_cast<std::size_t>(c.a)].z - 1.0;
    const double above = spheres - (std::floor(low) + 1.0);
    // Forces are at most doubled or halved: 8 carries 4 to 16.
    CHECK(c.force == Approx(std::max(above, 4.0)).epsilon(1e-12));
    ++seen;
  }
  CHECK(seen == spheres);
}

TEST_CASE("what pushes sideways goes with the weight carried at its height") {
  SphereBed bed = make_bed({6, 1, testing::walls, testing::walls}, {{0.5, 0.5, 0.5, 0.5}});
  SphereContacts<double> contacts = touching_contacts(bed, 3.0);
  carry_weight(step_length, bed, contacts);
  int sideways = 0;
  for (std::size_t at = 0; at < contacts.impulse.size(); ++at) {
    if (!(contacts.impulse[at] > 0.0)) continue;
    const bool is_floor =
        std::abs(contacts.rows[at / block_width].normal_z[at % block_width]) > 0.5;
    // The floor carries 3 m g where 1 is due: half of it is the least. Between it and the plane
    // above, which nothing crosses, the factor is linear.
    CHECK(contacts.impulse[at] == Approx(is_floor ? 1.5 * unit : 2.25 * unit).epsilon(1e-12));
    sideways += is_floor ? 0 : 1;
  }
  CHECK(sideways == 3);
}

TEST_CASE("contacts that do not push are not made to") {
  SphereBed bed = testing::column_bed(5, 0.0);
  SphereContacts<double> contacts = touching_contacts(bed, 0.0);
  carry_weight(step_length, bed, contacts);
  for (const double impulse : contacts.impulse) CHECK(impulse == 0.0);
}

TEST_CASE("a bed is tall from forty diameters on") {
  CHECK_FALSE(is_tall(testing::column_bed(40, 0.0)));
  CHECK(is_tall(testing::column_bed(41, 0.0)));
  CHECK(top_of(testing::column_bed(7, 0.0)) == Approx(6.5));
}

}  // namespace
}  // namespace grainsweep
