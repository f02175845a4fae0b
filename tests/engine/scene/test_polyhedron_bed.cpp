#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/about.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::periodic;
using testing::pose_at;
using testing::shape_bed;
using testing::walls;

PolyhedronBed one_grain(double scale = 1) {
  return shape_bed({5, 4, periodic, walls}, pinacoid({}),
                   {pose_at(1, 2, 3, Quaternion::Identity(), scale)});
}

TEST_CASE("a grain is turned by exactly its angle vector, whatever its length") {
  Draw draw(1);
  for (int k = 0; k < 200; ++k) {
    const double angle = draw.uniform(0, 1) * (k % 2 == 0 ? 1 : 1e-7);
    const Vector axis = testing::random_direction(draw);
    PolyhedronBed bed = one_grain();
    const Quaternion before = testing::random_rotation(draw);
    bed.orientation[0] = {before.x(), before.y(), before.z(), before.w()};
    move_grain(bed, 0, Vector(0.1, 0.2, 0.3), angle * axis);
    const Quaternion expected = before * Quaternion(Eigen::AngleAxisd(angle, axis));
    CHECK((bed.pose(0).orientation.coeffs() - expected.coeffs()).norm() < 1e-15);  // four roundings
    CHECK((bed.pose(0).centre - Vector(1.1, 2.2, 3.3)).norm() < 1e-15);
  }
}

TEST_CASE("orientations stay unit quaternions through a million turns") {
  PolyhedronBed bed = one_grain();
  for (int k = 0; k < 1'000'000; ++k) move_grain(bed, 0, Vector::Zero(), Vector(0.1, -0.2, 0.15));
  CHECK(bed.pose(0).orientation.norm() == about(1, 1e-15));
}

TEST_CASE("a turn about a principal axis goes on as it is") {
  for (int axis = 0; axis < 3; ++axis) {
    PolyhedronBed bed = one_grain();
    move_grain(bed, 0, Vector::Zero(), 0.2 * Vector::Unit(axis));
    CHECK((bed.spin[0] - 0.2 * Vector::Unit(axis)).norm() < 1e-16);
  }
}

TEST_CASE("mass goes with the cube of the scale and moments with its fifth power") {
  const PolyhedronBed unit = one_grain(), large = one_grain(2);
  CHECK(1 / unit.motion[0].w == 1);
  CHECK(1 / large.motion[0].w == 8);
  CHECK((large.root_inertia[0].cwiseAbs2() - 32 * unit.root_inertia[0].cwiseAbs2()).norm() < 1e-14);
  CHECK((unit.root_inertia[0].cwiseAbs2() - unit.shape(0).inertia).norm() < 1e-15);
}

TEST_CASE("pairs are seen across periodic sides and not across walls") {
  const Box box{5, 4, periodic, walls};
  const PolyhedronBed bed =
      shape_bed(box, pinacoid({}), {pose_at(0.25, 0.25, 1), pose_at(4.75, 3.75, 1.5)});
  CHECK(nearest_difference(bed, 0, 1) == Vector(-0.5, 3.5, 0.5));
  CHECK(nearest_difference(bed, 1, 0) == Vector(0.5, -3.5, -0.5));
  CHECK(pair_pose(bed, 0, 1).centre == Vector(-0.5, 3.5, 0.5));
}

TEST_CASE("wrapping brings grains back into the box along periodic axes only") {
  PolyhedronBed bed = shape_bed({5, 4, periodic, walls}, pinacoid({}),
                                {pose_at(-0.5, -0.5, 1), pose_at(5.5, 4.5, -1)});
  wrap(bed);
  CHECK(bed.pose(0).centre == Vector(4.5, -0.5, 1));
  CHECK(bed.pose(1).centre == Vector(0.5, 4.5, -1));
}

TEST_CASE("the hash of a bed tells every coordinate and turn") {
  const PolyhedronBed bed = one_grain();
  PolyhedronBed moved = bed, turned = bed;
  moved.position[0].z = std::nextafter(moved.position[0].z, 4);
  turned.orientation[0].x = 1e-300;
  CHECK(state_hash(bed) == state_hash(one_grain()));
  CHECK(state_hash(bed) != state_hash(moved));
  CHECK(state_hash(bed) != state_hash(turned));
}

}  // namespace
}  // namespace grainsweep
