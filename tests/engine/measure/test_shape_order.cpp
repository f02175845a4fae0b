#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/measure/components.hpp"
#include "engine/measure/profile.hpp"
#include "engine/measure/shape_order.hpp"
#include "engine/shape/hull.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::pose_at;

/// A bar as its corners were written: long along z, askew about it.
ConvexShape askew_bar() {
  const Quaternion askew(Eigen::AngleAxisd(0.3, Vector::UnitZ()));
  std::vector<Vector> corners;
  for (const double x : {-0.2, 0.2}) {
    for (const double y : {-0.3, 0.3}) {
      for (const double z : {-0.5, 0.5}) corners.emplace_back(askew * Vector(x, y, z));
    }
  }
  return convex_hull(corners).shape.value();
}

/// Three upright bars of each of two components, turned about z by 60 degrees each.
PolyhedronBed upright_bars() {
  const ConvexShape bar = askew_bar();
  const Quaternion given(bar.given.rotation);
  std::vector<Pose> poses;
  for (int k = 0; k < 6; ++k) {
    const Quaternion turn(Eigen::AngleAxisd(k * std::numbers::pi / 3, Vector::UnitZ()));
    poses.push_back(pose_at(1.0 + k / 3, 1.0 + k % 3, 1, turn * given));
  }
  return make_bed({4, 4, periodic, periodic}, {bar, bar}, {0, 0, 0, 1, 1, 1}, poses);
}

/// All along z; the other two in all directions of a plane alike.
void check_upright(const std::array<double, 3>& nematic) {
  CHECK(nematic[0] == Approx(0.25));
  CHECK(nematic[1] == Approx(0.25));
  CHECK(nematic[2] == Approx(1));
}

TEST_CASE("nematic order is that of the axes of the frame in which a shape is written") {
  REQUIRE_FALSE(askew_bar().given.rotation.isIdentity(0.1));
  const PolyhedronBed bed = upright_bars();
  const Slab slab{0.5, 1.5};
  check_upright(measure_shape_order(bed, {}, {}, slab).nematic);
  for (const ComponentMeasure& one : measure_components(bed, {}, {}, {}, slab, 1e-4)) {
    check_upright(one.nematic);
  }
  for (const ComponentProfile& one :
       component_profiles(ProfileAxis::z, bed, {}, {}, {2, 0, 1e-4})) {
    check_upright(one.bins[0].nematic);
  }
}

TEST_CASE("grains outside the slab have no part in the order of its shapes") {
  CHECK(std::isnan(measure_shape_order(upright_bars(), {}, {}, {2, 3}).nematic[2]));
}

TEST_CASE("contacts and forces have the shares of their kinds, those outside the slab none") {
  const std::vector<PairForce> forces = {
      {0, 1, 1.0, 1.0}, {1, 2, 2.0, 1.2}, {0, 2, 5.0, 0.8}, {3, 4, 7.0, 2.5}};
  std::vector<ForceLine> lines;
  for (const int kind : {1, 3, 1, 2}) lines.push_back({{0, 0, 1}, {0, 0, 0}, kind});
  const ShapeOrder order = measure_shape_order(upright_bars(), forces, lines, {0.5, 1.5});
  CHECK(order.contact_share[0] == Approx(2.0 / 3.0));
  CHECK(order.contact_share[1] == 0.0);
  CHECK(order.contact_share[2] == Approx(1.0 / 3.0));
  CHECK(order.force_share[0] == Approx(0.75));
  CHECK(order.force_share[1] == 0.0);
  CHECK(order.force_share[2] == Approx(0.25));
}

}  // namespace
}  // namespace grainsweep
