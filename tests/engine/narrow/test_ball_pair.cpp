#include <vector>

#include <catch2/catch.hpp>

#include "engine/narrow/ball_pair.hpp"
#include "engine/narrow/gjk.hpp"
#include "engine/narrow/manifold.hpp"
#include "engine/shape/given_shape.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

ConvexShape shape(const ShapeSpec& spec) { return *shape_of(spec).shape; }

const ConvexShape a_ball = shape(SphereShape{}), a_cube = shape(CubeSize{}), corner_alone = [] {
  ConvexShape none = a_ball;
  none.is_ball = false;  // its one vertex alone
  return none;
}();

Vector any_direction(Draw& draw) {
  for (;;) {
    const Vector v(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1));
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

PairPose pose(const Vector& centre, const Matrix& turn = Matrix::Identity(), double scale_a = 1,
              double scale_b = 1) {
  return {centre, turn, scale_a, scale_b};
}

TEST_CASE("a sphere touches a cube on a face, an edge or a corner at its true distance") {
  struct Case {
    Vector centre, on_cube;
    AxisKind kind;
  };
  const double half = 0.5;
  for (const Case& at : {Case{{0.2, 0.1, 1.2}, {0.2, 0.1, half}, AxisKind::ball_on_face},
                         Case{{0.9, 0.1, 0.8}, {half, 0.1, half}, AxisKind::ball_on_edge},
                         Case{{0.9, 0.7, 0.8}, {half, half, half}, AxisKind::round}}) {
    const BallContact contact = ball_contact({a_cube, a_ball, pose(at.centre)});
    const Vector between = at.centre - at.on_cube;
    const double gap = between.norm() - 0.5;
    CHECK(contact.kind == at.kind);
    CHECK(contact.gap == about(gap, 1e-15));
    CHECK((contact.normal - between.normalized()).norm() < 1e-15);
    CHECK((contact.position - (at.on_cube + gap / 2 * between.normalized())).norm() < 1e-15);
  }
}

TEST_CASE("a centre within a polyhedron is as deep as its nearest face") {
  const NearestPoint nearest = nearest_point(a_cube, 2.0, {0.1, -0.9, 0.3});
  CHECK(nearest.distance == Approx(-0.1));
  CHECK((nearest.outward - Vector(0, -1, 0)).norm() < 1e-15);
  CHECK((nearest.point - Vector(0.1, -1, 0.3)).norm() < 1e-15);
  CHECK(ball_contact({a_cube, a_ball, pose({0, 0, 0})}).gap == Approx(-1));
}

// On an edge rounding decides whether the centre lies between the sides of a face.
TEST_CASE("a centre on a corner or an edge of a polyhedron lies on a face, with a normal") {
  Draw draw(7);
  for (const ConvexShape& hull : {a_cube, shape(PrismSize{7, 1.3, 0.8}), shape(IcosahedronSize{}),
                                  shape(PinacoidSize{2, 1, 1, 0.5})}) {
    for (const Edge& edge : hull.edges) {
      const Vector from = hull.vertices[static_cast<std::size_t>(edge.from)];
      const Vector to = hull.vertices[static_cast<std::size_t>(edge.to)];
      const double scale = draw.uniform(0.2, 3);
      for (const double share : {0.0, draw.unit(), 1.0}) {
        const Vector centre = scale * (from + share * (to - from));
        const NearestPoint nearest = nearest_point(hull, scale, centre);
        REQUIRE(nearest.outward.norm() == about(1, 1e-12));
        REQUIRE(nearest.distance == about(0, 1e-14));
        REQUIRE((nearest.point - centre).norm() < 1e-14);
      }
    }
  }
}

const Vector& normal_of(const ConvexShape& hull, std::int32_t face) {
  return hull.faces[static_cast<std::size_t>(face)].normal;
}

TEST_CASE("at every corner and every edge of a hull a sphere is told which of them it touches") {
  for (const ConvexShape& hull : {a_cube, shape(PrismSize{7, 1.3, 0.8}), shape(IcosahedronSize{}),
                                  shape(PinacoidSize{2, 1, 1, 0.5})}) {
    for (const Edge& edge : hull.edges) {
      const Vector middle = (hull.vertices[static_cast<std::size_t>(edge.from)] +
                             hull.vertices[static_cast<std::size_t>(edge.to)]) /
                            2;
      const Vector out = normal_of(hull, edge.left) + normal_of(hull, edge.right);
      REQUIRE(nearest_point(hull, 1, middle + out).kind == AxisKind::ball_on_edge);
    }
    for (std::size_t v = 0; v < hull.vertices.size(); ++v) {
      Vector out = Vector::Zero();  // between the normals of the faces there
      for (auto k = hull.vertex_faces_begin[v]; k < hull.vertex_faces_begin[v + 1]; ++k) {
        out += normal_of(hull, hull.vertex_faces[static_cast<std::size_t>(k)]);
      }
      const NearestPoint nearest = nearest_point(hull, 1, hull.vertices[v] + out);
      REQUIRE(nearest.kind == AxisKind::round);
      REQUIRE((nearest.point - hull.vertices[v]).norm() < 1e-14);
    }
  }
}

TEST_CASE("two spheres touch between their centres, and never divide by nothing") {
  const BallContact contact =
      ball_contact({a_ball, a_ball, pose({0, 3, 4}, Matrix::Identity(), 2, 6)});
  CHECK(contact.gap == Approx(1));
  CHECK((contact.position - Vector(0, 0.6, 0.8) * 1.5).norm() < 1e-15);
  CHECK(ball_contact({a_ball, a_ball, pose({0, 0, 0})}).normal.norm() == 1);
}

// GJK is told to 1e-7 where it ends by rounding; here it never does.
TEST_CASE("the nearest point of a hull is that of GJK, from any side and scale") {
  const std::vector<ConvexShape> shapes = {a_cube, shape(PinacoidSize{1, 1, 0.3}),
                                           shape(PrismSize{7, 1.3, 0.8}), shape(IcosahedronSize{}),
                                           shape(PinacoidSize{2, 1, 1, 0.5})};
  Draw draw(11);
  for (int k = 0; k < 20000; ++k) {
    const ConvexShape& hull = shapes[static_cast<std::size_t>(k) % shapes.size()];
    const double scale = draw.uniform(0.2, 3);
    const Vector centre = scale * draw.uniform(0.9, 2) * hull.circumradius * any_direction(draw);
    const Closest twin = closest_points(
        {hull, corner_alone, pose(centre, Matrix::Identity(), scale)}, testing::kernels().hull);
    const NearestPoint nearest = nearest_point(hull, scale, centre);
    if (nearest.distance < 1e-3) continue;  // GJK tells no depth
    REQUIRE(nearest.distance == about(twin.distance, 1e-12));
    REQUIRE((nearest.point - twin.on_a).norm() < 1e-9);
    REQUIRE((nearest.point + nearest.distance * nearest.outward - centre).norm() < 1e-13);
  }
}

TEST_CASE("which of a pair is the sphere does not matter") {
  const ConvexShape hull = shape(PrismSize{5, 0.8, 1.1});
  Draw draw(5);
  for (int k = 0; k < 1000; ++k) {
    const Quaternion turn(Eigen::AngleAxisd(draw.uniform(0, 3), any_direction(draw)));
    const Vector centre = draw.uniform(0.6, 1.4) * any_direction(draw);
    const double size = draw.uniform(0.5, 2);
    const BallContact straight =
        ball_contact({hull, a_ball, pose(centre, turn.toRotationMatrix(), 1, size)});
    const BallContact mirrored = ball_contact(
        {a_ball, hull,
         pose(-(turn.conjugate() * centre), turn.conjugate().toRotationMatrix(), size, 1)});
    REQUIRE(mirrored.kind == straight.kind);
    REQUIRE(mirrored.gap == about(straight.gap, 1e-14));
    REQUIRE((turn * mirrored.normal + straight.normal).norm() < 1e-13);
    REQUIRE((centre + turn * mirrored.position - straight.position).norm() < 1e-13);
  }
}

TEST_CASE("a pair with a sphere touches at one point up to the margin, and remembers its axis") {
  PairMemory memory;
  TouchColumns columns;
  std::vector<ContactPoint> points;
  const auto touch_at = [&](double z) {
    return touch({a_cube, a_ball, pose({0.1, 0.2, z})}, {0.05, 1e-3}, memory, columns, points);
  };
  const PairContact near = touch_at(1.04);
  CHECK((near.kind == AxisKind::ball_on_face && near.count == 1 && near.first == 0));
  CHECK(points.at(0).gap == Approx(0.04));
  CHECK(touch_at(1.06).count == 0);
  CHECK(memory.axis.z() == 1);
  CHECK(touch_at(1.06).count == 0);  // by its axis
  CHECK(touch_at(1.0).count == 1);
}

TEST_CASE("a sphere among polyhedra touches a wall at its nearest point") {
  Wall floor;
  std::vector<ContactPoint> points;
  const Pose at{{1, 2, 0.8}, 1.5, Quaternion(Eigen::AngleAxisd(1, Vector::UnitX()))};
  REQUIRE(touch_wall(a_ball, at, floor, 0.06, points) == 1);
  CHECK(points[0].gap == Approx(0.05));
  CHECK((at.orientation * points[0].position - Vector(0, 0, -0.75)).norm() < 1e-15);
  CHECK(touch_wall(a_ball, at, floor, 0.04, points) == 0);
}

}  // namespace
}  // namespace grainsweep
