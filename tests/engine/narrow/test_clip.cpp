#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/narrow/clip.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

std::int32_t face_towards(const ConvexShape& shape, const Vector& direction) {
  std::int32_t face = 0;
  for (std::size_t k = 0; k < shape.faces.size(); ++k) {
    if (shape.faces[k].normal.dot(direction) > 0.999) face = static_cast<std::int32_t>(k);
  }
  return face;
}

/// What of a second grain lies above the upper face of the first, up to .1 d.
std::vector<ContactPoint> on_upper_face(const ShapePair& pair) {
  ClipColumns columns;
  std::vector<ContactPoint> points;
  clip_on_face(pair, Of::a, face_towards(pair.a, {0, 0, 1}), 0.1, columns, points);
  return points;
}

double height_of(const ConvexShape& shape) {
  return 2.0 * shape.faces[static_cast<std::size_t>(face_towards(shape, {0, 0, 1}))].offset;
}

PairPose above(double x, double height) { return {{x, 0, height}, Matrix::Identity(), 1.0, 1.0}; }

TEST_CASE("a cube flat on another one touches it at four corners, the gap apart") {
  const ConvexShape cube = testing::cube();
  const double side = height_of(cube);
  for (const double gap : {0.01, 0.0, -0.01}) {
    const std::vector<ContactPoint> points = on_upper_face({cube, cube, above(0, side + gap)});
    REQUIRE(points.size() == 4);
    for (const ContactPoint& point : points) {
      CHECK(point.gap == about(gap, 1e-15));
      CHECK(std::abs(point.position.x()) == Approx(side / 2));
      CHECK(std::abs(point.position.y()) == Approx(side / 2));
      CHECK(point.position.z() == Approx(side / 2 + gap / 2));  // midway
    }
  }
}

// Each square of a bent cube is two triangles; a point for each corner keeps it from tilting.
TEST_CASE("bent cubes touch all over their faces, not triangle by triangle") {
  Draw draw(3);
  for (int run = 0; run < 50; ++run) {
    const double bent = run % 2 == 0 ? 1e-7 : 3e-3;
    const auto bent_cube = [&] {
      std::vector<Vector> points = testing::cube().vertices;
      for (Vector& p : points) {
        p += bent * Vector(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1));
      }
      return testing::hull_of(points);
    };
    const ConvexShape lower = bent_cube(), upper = bent_cube();
    const Matrix given = lower.given.rotation.transpose();
    const Vector up = given.col(2);  // in the frame of the lower cube
    ClipColumns columns;
    std::vector<ContactPoint> points;
    clip_on_face({lower, upper, {up, given * upper.given.rotation, 1.0, 1.0}}, Of::a,
                 face_towards(lower, up), 0.1, columns, points);
    for (const Vector& corner : lower.vertices) {
      if (corner.dot(up) < 0) continue;
      CHECK(std::any_of(points.begin(), points.end(), [&](const ContactPoint& point) {
        return (point.position - corner).norm() < 10 * bent + 1e-9;
      }));
    }
  }
}

TEST_CASE("a cube moved along another one is cut at its side") {
  const ConvexShape cube = testing::cube();
  const double side = height_of(cube);
  const std::vector<ContactPoint> points =
      on_upper_face({cube, cube, above(0.75 * side, side + 0.01)});
  REQUIRE(points.size() == 4);
  for (const ContactPoint& point : points) {
    CHECK(point.position.x() >= side / 4 - 1e-15);
    CHECK(point.position.x() <= side / 2 + 1e-15);
  }
}

TEST_CASE("a cube beside a face, or higher above it than the margin, has no point on it") {
  const ConvexShape cube = testing::cube();
  const double side = height_of(cube);
  CHECK(on_upper_face({cube, cube, above(1.5 * side, side + 0.01)}).empty());
  CHECK(on_upper_face({cube, cube, above(0, side + 0.11)}).empty());
}

/// Whether a point lies within the sides of an upright prism, up to 1e-12 d.
bool is_within(const ConvexShape& prism, const Matrix& turn, const Vector& centre,
               const Vector& x) {
  const Vector seen = turn.transpose() * (x - centre);
  return std::all_of(prism.faces.begin(), prism.faces.end(), [&](const Face& face) {
    return std::abs(face.normal.z()) > 0.5 || face.normal.dot(seen) <= face.offset + 1e-12;
  });
}

TEST_CASE(
    "faces of many sides touch at each other's corners that lie above, and where edges cross") {
  Draw draw(41);
  int crossings = 0, corners = 0;
  for (const int sides : {3, 8, 32, 60}) {
    const ConvexShape shape = testing::prism(sides, 0.5);
    for (int k = 0; k < 200; ++k) {
      const double gap = draw.uniform(-0.05, 0.05);
      const Vector centre(draw.uniform(-0.7, 0.7), draw.uniform(-0.7, 0.7), height_of(shape) + gap);
      const Matrix turn(Eigen::AngleAxisd(draw.uniform(0, 6), Vector::UnitZ()));
      const std::vector<ContactPoint> points = on_upper_face({shape, shape, {centre, turn, 1, 1}});
      std::size_t expected = 0;
      for (const Vector& vertex : shape.vertices) {
        const Vector upper = centre + turn * vertex;
        if (vertex.z() > 0) expected += is_within(shape, turn, centre, vertex) ? 1 : 0;
        if (vertex.z() < 0)
          expected += is_within(shape, Matrix::Identity(), {0, 0, 0}, upper) ? 1 : 0;
      }
      corners += static_cast<int>(expected);
      std::size_t crossed = 0;
      for (const ContactPoint& point : points) {
        CHECK(point.gap == about(gap, 1e-12));
        CHECK(is_within(shape, Matrix::Identity(), {0, 0, 0}, point.position));
        CHECK(is_within(shape, turn, centre, point.position));
        const bool is_corner =
            std::any_of(shape.vertices.begin(), shape.vertices.end(), [&](const Vector& vertex) {
              const Vector from_a = vertex - point.position;
              const Vector from_b = centre + turn * vertex - point.position;
              return std::min(from_a.head<2>().norm(), from_b.head<2>().norm()) < 1e-9;
            });
        crossed += is_corner ? 0 : 1;
      }
      CHECK(points.size() - crossed == expected);
      CHECK(crossed % 2 == 0);  // each polygon enters the other as often as it leaves it
      crossings += static_cast<int>(crossed);
    }
  }
  CHECK(crossings > 500);
  CHECK(corners > 1000);
}

TEST_CASE("the middle of the shortest line between two crossing edges lies midway between them") {
  const Segment along_x{{-1, 0, 0}, {1, 0, 0}}, along_y{{0.25, -1, 1}, {0.25, 1, 1}};
  CHECK((closest_of(along_x, along_y).midway - Vector(0.25, 0, 0.5)).norm() < 1e-15);
}

TEST_CASE("edges that are parallel, nearly or to rounding, are closest in the middle they share") {
  const Segment below{{-1, 0, 0}, {1, 0, 0}};
  for (const double angle : {0.0, 1e-16, 1e-14, 1e-10, 1e-8}) {
    for (const double sense : {1.0, -1.0}) {
      const Vector middle(1, 0.1, 0.5), half(sense * std::cos(angle), sense * std::sin(angle), 0);
      const Closeness closest = closest_of(below, {middle - half, middle + half});
      CHECK((closest.midway - Vector(0.5, 0.05, 0.25)).norm() < 2e-8);
      CHECK(closest.distance == Approx(std::hypot(0.1, 0.5)).epsilon(1e-7));
    }
  }
}

TEST_CASE("no points of two edges are nearer to each other than those found, wherever they lie") {
  Draw draw(13);
  const auto point = [&] {
    return Vector(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1));
  };
  constexpr int steps = 20;
  for (int k = 0; k < 500; ++k) {
    const Segment p{point(), point()}, q{point(), point()};
    const Closeness closest = closest_of(p, q);
    for (int i = 0; i <= steps; ++i) {
      const Vector on_p = p.from + i * (p.to - p.from) / steps;
      for (int j = 0; j <= steps; ++j) {
        const Vector on_q = q.from + j * (q.to - q.from) / steps;
        REQUIRE((on_p - on_q).norm() > closest.distance - 1e-14);
      }
    }
  }
}

/// A cube of side 1 with a corner of its upper face, bent along a diagonal, so far down.
ConvexShape cube_bent_by(double way) {
  std::vector<Vector> points;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      points.emplace_back(x, y, -0.5);
      points.emplace_back(x, y, x + y > 0.5 ? 0.5 - way : 0.5);
    }
  }
  return testing::hull_of(points);
}

// At the ends of the bend, the lower half of the face sees a gap of height / cos.
TEST_CASE("where a bent face touches twice at a place the smaller gap counts") {
  const double height = 0.05;
  const ConvexShape lower = cube_bent_by(0.004), upper = testing::box_shape(2, 2, 1);
  const Matrix given = lower.given.rotation.transpose();
  const Vector up = given.col(2);
  // The hull's frame has its origin at its own centre.
  double top = -1;
  for (const Vector& v : lower.vertices) top = std::max(top, v.dot(up));
  std::vector<Vector> ends;
  for (const Vector& v : lower.vertices) {
    if (v.dot(up) > top - 1e-6) ends.push_back(v);
  }
  REQUIRE(ends.size() == 3);  // one of them is not an end of the bend
  int faces = 0;
  for (std::size_t f = 0; f < lower.faces.size(); ++f) {
    if (lower.faces[f].normal.dot(up) < 0.99) continue;
    ++faces;
    ClipColumns columns;
    std::vector<ContactPoint> points;
    clip_on_face({lower, upper, {(top + 0.5 + height) * up, given * upper.given.rotation, 1, 1}},
                 Of::a, static_cast<std::int32_t>(f), 0.1, columns, points);
    REQUIRE(points.size() == 4);
    for (const Vector& end : ends) {
      const Vector midway = end + height / 2 * up;
      const auto near = std::find_if(points.begin(), points.end(), [&](const ContactPoint& point) {
        return (point.position - midway).norm() < 1e-3;
      });
      REQUIRE(near != points.end());
      CHECK(near->gap == about(height, 1e-12));
    }
  }
  CHECK(faces == 2);
}

TEST_CASE("the edge that reaches farthest is the one towards the direction asked for") {
  const ConvexShape cube = testing::cube();
  const ShapePair pair{cube, cube, above(0, height_of(cube))};
  std::int32_t along_x = 0;
  for (std::size_t k = 0; k < cube.edge_directions.size(); ++k) {
    if (std::abs(cube.edge_directions[k].x()) > 0.999) along_x = static_cast<std::int32_t>(k);
  }
  const Segment edge = farthest_edge(pair, Of::a, along_x, Vector(0, 1, 1).normalized());
  const double half = height_of(cube) / 2;
  CHECK((edge.from + edge.to - 2 * Vector(0, half, half)).norm() < 1e-15);
  CHECK((edge.to - edge.from).norm() == Approx(2 * half));
}

}  // namespace
}  // namespace grainsweep
