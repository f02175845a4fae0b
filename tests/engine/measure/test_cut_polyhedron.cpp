#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "engine/measure/cut_polyhedron.hpp"
#include "tests/support/about.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

const double infinite = std::numeric_limits<double>::infinity();

Pose random_pose(Draw& draw) {
  return {{draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-2, 2)},
          draw.uniform(0.5, 1.5),
          testing::random_rotation(draw)};
}

double whole(const ConvexShape& shape, const Pose& pose) {
  return std::pow(pose.scale, 3) * shape.volume;
}

TEST_CASE("a slab cuts from an upright cube its thickness") {
  const ConvexShape cube = testing::cube();
  Pose pose;
  pose.centre = {1, 2, 3};
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = pose.centre[axis];
    CHECK(slab_volume(cube, pose, axis, middle - 0.2, middle + 0.3) == Approx(0.5).epsilon(1e-15));
    CHECK(slab_volume(cube, pose, axis, -infinite, middle) == Approx(0.5).epsilon(1e-15));
    CHECK(slab_volume(cube, pose, axis, -infinite, infinite) == cube.volume);
    CHECK(slab_volume(cube, pose, axis, middle + 0.5, infinite) == 0);
    CHECK(slab_volume(cube, pose, axis, middle - 2, middle - 0.5) == 0);
  }
}

TEST_CASE("a plane cuts from a cube on its corner the pyramid that geometry says") {
  const ConvexShape cube = testing::cube();
  Pose pose;
  pose.orientation = Quaternion::FromTwoVectors(Vector(1, 1, 1), Vector(0, 0, 1));
  const double top = std::sqrt(0.75);
  // Up to the next corners, a third of the diagonal down: legs of sqrt 3 h, volume (sqrt 3 h)^3
  // / 6.
  for (const double h : {0.1, 0.3, 1 / std::sqrt(3.0)}) {
    const double pyramid = std::pow(std::sqrt(3.0) * h, 3) / 6;
    CHECK(slab_volume(cube, pose, 2, top - h, infinite) == Approx(pyramid).epsilon(1e-13));
  }
  CHECK(slab_volume(cube, pose, 2, -infinite, 0) == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("a pinacoid lying flat has in each slab the volume of its rectangles") {
  const ConvexShape shape = pinacoid({});
  const PinacoidHalves w = *shape.pinacoid;
  const double s = w.a - w.c;
  for (const double t : {0.1, 0.5, 0.9}) {  // integral of 4 (a - s t) (b - b t) e dt
    const double upper = 4 * w.b * w.e * (w.a * t - (w.a + s) * t * t / 2 + s * t * t * t / 3);
    CHECK(slab_volume(shape, {}, 2, 0, t * w.e) == Approx(upper).epsilon(1e-14));
    CHECK(slab_volume(shape, {}, 2, -t * w.e, t * w.e) == Approx(2 * upper).epsilon(1e-14));
  }
}

TEST_CASE("the bins of a profile together hold the whole grain") {
  Draw draw(31);
  for (int run = 0; run < 100; ++run) {
    const ConvexShape shape =
        run % 2 == 0 ? pinacoid({}) : testing::hull_of(testing::random_corners(draw, 15));
    const Pose pose = random_pose(draw);
    double along_y = 0, along_z = 0, boxes = 0;
    for (int k = -40; k < 40; ++k) {
      along_y += slab_volume(shape, pose, 1, 0.1 * k, 0.1 * (k + 1));
      along_z += slab_volume(shape, pose, 2, 0.1 * k, 0.1 * (k + 1));
    }
    for (int j = -8; j < 8; ++j) {
      for (int k = -8; k < 8; ++k) {
        boxes += box_volume(shape, pose, {-infinite, 0.5 * j, 0.5 * k},
                            {infinite, 0.5 * (j + 1), 0.5 * (k + 1)});
      }
    }
    REQUIRE(along_y == Approx(whole(shape, pose)).epsilon(1e-13));
    REQUIRE(along_z == Approx(whole(shape, pose)).epsilon(1e-13));
    REQUIRE(boxes == Approx(whole(shape, pose)).epsilon(1e-13));
  }
}

// 100,000 points in the circumscribed ball's cube; 4.5 standard errors.
TEST_CASE("the volume in a box is that of random points inside") {
  Draw draw(32);
  for (int run = 0; run < 6; ++run) {
    const ConvexShape shape = testing::hull_of(testing::random_corners(draw, 10));
    const Pose pose = random_pose(draw);
    const double r = shape.circumradius;
    Vector low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = pose.centre[axis] - draw.uniform(0, r);
      high[axis] = low[axis] + draw.uniform(0.2, 1.0);
    }
    const int samples = 100000;
    int inside = 0;
    for (int k = 0; k < samples; ++k) {
      const Vector x(draw.uniform(-r, r), draw.uniform(-r, r), draw.uniform(-r, r));
      const bool in_shape =
          std::all_of(shape.faces.begin(), shape.faces.end(),
                      [&](const Face& face) { return face.normal.dot(x) <= face.offset; });
      const Vector placed = pose.centre + pose.scale * (pose.orientation * x);
      inside += in_shape && (placed.array() >= low.array()).all() &&
                        (placed.array() <= high.array()).all()
                    ? 1
                    : 0;
    }
    const double share = static_cast<double>(inside) / samples;
    const double cube = std::pow(2 * r * pose.scale, 3);
    CHECK(share > 0);
    CHECK(box_volume(shape, pose, low, high) ==
          about(share * cube, 4.5 * cube * std::sqrt(share * (1 - share) / samples)));
  }
}

TEST_CASE("a slab of a grain shrinks to nothing with its thickness") {
  Draw draw(33);
  const ConvexShape shape = pinacoid({});
  for (int run = 0; run < 50; ++run) {
    const Pose pose = random_pose(draw);
    const double at = pose.centre.z() + draw.uniform(-0.3, 0.3) * pose.scale;
    const double thin = slab_volume(shape, pose, 2, at, at + 1e-9);
    CHECK((thin >= 0 && thin < 1e-9 * 4 * pose.scale * pose.scale));
    CHECK(slab_volume(shape, pose, 2, at, at) == Approx(0).margin(1e-16));
  }
}

TEST_CASE("the span of a grain is that of its vertices") {
  Draw draw(34);
  const ConvexShape shape = testing::hull_of(testing::random_corners(draw, 10));
  const Pose pose = random_pose(draw);
  for (int axis = 0; axis < 3; ++axis) {
    const Span span = span_along(shape, pose, axis);
    double low = infinite, high = -infinite;
    for (const Vector& v : shape.vertices) {
      const double at = (pose.centre + pose.scale * (pose.orientation * v))[axis];
      low = std::min(low, at);
      high = std::max(high, at);
    }
    CHECK(span.low == Approx(low).epsilon(1e-14));
    CHECK(span.high == Approx(high).epsilon(1e-14));
  }
}

}  // namespace
}  // namespace grainsweep
