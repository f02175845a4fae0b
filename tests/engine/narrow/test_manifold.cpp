#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/narrow/clip.hpp"
#include "engine/narrow/constraints.hpp"
#include "engine/shape/named_shapes.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_pairs.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::PairFamily;

const double half_turn = 3.14159265358979323846;

struct Found {
  PairContact contact;
  std::vector<ContactPoint> points;

  int constraints() const { return constraints_of(points.data(), points.size(), 1e-4); }
  double deepest() const {
    const auto by_gap = [](const ContactPoint& p, const ContactPoint& q) { return p.gap < q.gap; };
    return std::min_element(points.begin(), points.end(), by_gap)->gap;
  }
  bool has(const Vector& position, double gap) const {
    return std::any_of(points.begin(), points.end(), [&](const ContactPoint& p) {
      return (p.position - position).norm() < 1e-12 && std::abs(p.gap - gap) < 1e-12;
    });
  }
};

Found contact_of(const ShapePair& pair, const TouchSettings& settings) {
  PairMemory memory;
  TouchColumns columns;
  Found found;
  found.contact = touch(pair, settings, memory, columns, found.points);
  REQUIRE(found.contact.first == 0);
  REQUIRE(found.contact.count == found.points.size());
  return found;
}

Found contact_of(const ShapePair& pair, double margin = 0.05, double preference = 0.0) {
  return contact_of(pair, TouchSettings{margin, preference, 0.0});
}

Matrix turn(double angle, const Vector& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

PairPose at(const Vector& centre, const Matrix& rotation = Matrix::Identity()) {
  return {centre, rotation, 1, 1};
}

TEST_CASE("a cube upon a cube touches with four corners") {
  const ConvexShape cube = testing::cube();
  for (const double gap : {0.01, 0.0, -0.02}) {
    const Found found = contact_of({cube, cube, at({0, 0, 1 + gap})});
    CHECK((found.contact.normal - Vector(0, 0, 1)).norm() < 1e-15);
    CHECK(found.contact.separation == about(gap, 1e-15));
    REQUIRE(found.points.size() == 4);
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) CHECK(found.has({x, y, 0.5 + gap / 2}, gap));
    }
    CHECK(found.constraints() == (gap > 1e-4 ? 0 : 3));
  }
}

TEST_CASE("a shifted cube touches with the corners of what it covers") {
  const ConvexShape cube = testing::cube();
  const Found found = contact_of({cube, cube, at({0.75, -0.5, 1})});
  REQUIRE(found.points.size() == 4);
  for (const double x : {0.25, 0.5}) {
    for (const double y : {-0.5, 0.0}) CHECK(found.has({x, y, 0.5}, 0));
  }
}

TEST_CASE("a cube turned by an eighth touches with the eight corners of the common octagon") {
  const ConvexShape cube = testing::cube();
  const Found found = contact_of({cube, cube, at({0, 0, 1}, turn(half_turn / 4, Vector::UnitZ()))});
  REQUIRE(found.points.size() == 8);
  const double cut = std::sqrt(0.5) - 0.5;
  for (const double p : {-1.0, 1.0}) {
    for (const double q : {-1.0, 1.0}) {
      CHECK(found.has({p * 0.5, q * cut, 0.5}, 0));
      CHECK(found.has({p * cut, q * 0.5, 0.5}, 0));
    }
  }
}

TEST_CASE("a cube on an edge touches with both ends, on a corner with one point") {
  const ConvexShape cube = testing::cube();
  const Matrix on_edge = turn(half_turn / 4, Vector::UnitX());
  const Found edge = contact_of({cube, cube, at({0, 0, 0.5 + std::sqrt(0.5)}, on_edge)});
  REQUIRE(edge.points.size() == 2);
  CHECK(edge.has({0.5, 0, 0.5}, 0));
  CHECK(edge.has({-0.5, 0, 0.5}, 0));
  CHECK(edge.constraints() == 2);
  const Matrix on_corner =
      Quaternion::FromTwoVectors(Vector(1, 1, 1), Vector(0, 0, -1)).toRotationMatrix();
  const Found corner = contact_of({cube, cube, at({0.1, 0.2, 0.5 + std::sqrt(0.75)}, on_corner)});
  REQUIRE(corner.points.size() == 1);
  CHECK(corner.has({0.1, 0.2, 0.5}, 0));
  CHECK(corner.constraints() == 1);
}

TEST_CASE("crossed edges touch in the point where they cross") {
  const ConvexShape cube = testing::cube();
  const double reach = std::sqrt(0.5);
  ShapePair crossed{cube, cube, at({0, 0, 0})};
  const Matrix a_up = turn(half_turn / 4, Vector::UnitX());  // a's frame seen upright
  const Matrix b_up = turn(half_turn / 4, Vector::UnitY());
  crossed.pose.turn = a_up.transpose() * b_up;
  crossed.pose.centre = a_up.transpose() * Vector(0.1, 0.2, 2 * reach + 0.01);
  const Found found = contact_of(crossed);
  CHECK(found.contact.kind == AxisKind::edges);
  CHECK((a_up * found.contact.normal - Vector(0, 0, 1)).norm() < 1e-15);
  REQUIRE(found.points.size() == 1);
  CHECK((a_up * found.points[0].position - Vector(0.1, 0, reach + 0.005)).norm() < 1e-14);
  CHECK(found.points[0].gap == about(0.01, 1e-15));
}

/// Its ends rise less than its sides, so that a face at an end faces the base most. Its frame is
/// upright: all vertices of the edge, 0.4 d long and along x, have the least z.
const ConvexShape& knife() {
  static const ConvexShape shape = testing::hull_of({{0.2, 0, -0.3},
                                                     {-0.2, 0, -0.3},
                                                     {1.2, 0.2, 0.2},
                                                     {1.2, -0.2, 0.2},
                                                     {-1.2, 0.2, 0.2},
                                                     {-1.2, -0.2, 0.2}});
  return shape;
}

/// The knife upon a cube of side 1, so many times as large, its edge's middle there and turned.
Found knife_on_cube(double x, double y, double angle, double gap, double size = 1.0) {
  static const ConvexShape cube = testing::cube();
  double lowest = 0;
  for (const Vector& v : knife().vertices) lowest = std::min(lowest, v.z());
  const Vector centre(x, y, 0.5 - size * lowest + gap);
  return contact_of({cube, knife(), {centre, turn(angle, Vector::UnitZ()), 1.0, size}}, 0.01);
}

TEST_CASE("a knife lying on its edge touches with both ends of the edge") {
  const Found found = knife_on_cube(0, 0, 0, 0);
  REQUIRE(found.points.size() == 2);
  CHECK(found.constraints() == 2);
}

/// Checks for two points, from left to right there.
void check_edge(const Found& found, const Vector& left, const Vector& right, double gap) {
  REQUIRE(found.points.size() == 2);
  const bool in_order = found.points[0].position.x() < found.points[1].position.x();
  const ContactPoint& first = found.points[in_order ? 0 : 1];
  const ContactPoint& last = found.points[in_order ? 1 : 0];
  CHECK((first.position - left).norm() < 1e-14);
  CHECK((last.position - right).norm() < 1e-14);
  CHECK(first.gap == about(gap, 1e-14));
  CHECK(last.gap == about(gap, 1e-14));
}

// Where the edge leaves the face, the face at the knife's end that touches it there shares one
// corner with the edge: a single point would let the knife turn into the cube.
TEST_CASE("a knife whose edge leaves a face touches where it leaves it") {
  for (const double gap : {0.005, 0.0, -0.005}) {
    const double z = 0.5 + gap / 2;
    for (const double angle : {0.0, 0.1, 3.0}) {
      const double across = std::sin(angle), along = std::cos(angle), sign = along > 0 ? 1 : -1;
      const Vector end(0.4 - 0.2 * sign * along, 0.1 - 0.2 * sign * across, z);
      check_edge(knife_on_cube(0.4, 0.1, angle, gap), end, {0.5, 0.1 + 0.1 * across / along, z},
                 gap);
      // Both ends lie beside the face.
      check_edge(knife_on_cube(0, 0.1, angle, gap, 4.0), {-0.5, 0.1 - 0.5 * across / along, z},
                 {0.5, 0.1 + 0.5 * across / along, z}, gap);
    }
  }
}

// The end inside the face is the lower one, and touches; the edge crosses the face's side above.
TEST_CASE("a knife whose edge rises touches where it leaves a face only while it nearly lies") {
  const ConvexShape cube = testing::cube();
  std::int32_t up = 0;
  for (std::size_t f = 0; f < cube.faces.size(); ++f) {
    if (cube.faces[f].normal.z() > 0.99) up = static_cast<std::int32_t>(f);
  }
  double lowest = 0;
  for (const Vector& v : knife().vertices) lowest = std::min(lowest, v.z());
  Vector inner(9, 0, 0);  // end of the edge
  for (const Vector& v : knife().vertices) {
    if (v.z() < lowest + 1e-9 && v.x() < inner.x()) inner = v;
  }
  for (const double rise : {0.01, 0.019, 0.021, 0.05}) {
    const Matrix tilt = turn(-std::asin(rise), Vector::UnitY());
    const PairPose pose = at(Vector(0.3, 0, 0.5) - tilt * inner, tilt);
    ClipColumns columns;
    std::vector<ContactPoint> points;
    clip_on_face({cube, knife(), pose}, Of::a, up, 0.05, columns, points);
    const auto at_x = [&](double x) {
      return std::count_if(points.begin(), points.end(), [&](const ContactPoint& point) {
        return std::abs(point.position.x() - x) < 1e-9 && std::abs(point.position.y()) < 1e-9;
      });
    };
    INFO(rise);
    CHECK(at_x(0.3) == 1);
    CHECK(at_x(0.5) == (rise < 0.02 ? 1 : 0));
  }
}

/// Largest distance of a point of `p` from its nearest in `q`, positions and gaps.
double mismatch(const std::vector<ContactPoint>& p, const std::vector<ContactPoint>& q) {
  double worst = 0;
  for (const ContactPoint& one : p) {
    double nearest = 1;
    for (const ContactPoint& other : q) {
      nearest =
          std::min(nearest, (one.position - other.position).norm() + std::abs(one.gap - other.gap));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

// Where two axes part the pair equally well to rounding either may be taken; a preference decides
// between faces and edges, and pairs whose best faces tie are left out.
TEST_CASE("a pinacoid and the hull of its vertices have the same contacts") {
  const ConvexShape closed = pinacoid({}), hull = testing::hull_of(closed.vertices);
  Draw draw(21);
  int contacts = 0;
  for (const PairFamily family : testing::all_pair_families) {
    if (family == PairFamily::parallel_edges) continue;  // sides cross anywhere along the edges
    for (int k = 0; k < 200; ++k) {
      const PairPose pose = testing::pose_of_family(family, draw, closed, closed);
      const Found first = contact_of({closed, closed, pose}, 0.05, 1e-6);
      const Found second = contact_of({hull, hull, pose}, 0.05, 1e-6);
      REQUIRE((first.points.empty()) == (second.points.empty()));
      if ((first.contact.normal - second.contact.normal).norm() > 1e-9) continue;
      REQUIRE(mismatch(first.points, second.points) < 1e-9);
      REQUIRE(mismatch(second.points, first.points) < 1e-9);
      contacts += first.points.empty() ? 0 : 1;
    }
  }
  CHECK(contacts > 800);
}

TEST_CASE("two grains exchanged have the same contact from the other side") {
  const ConvexShape shape = pinacoid({}), cube = testing::cube();
  Draw draw(22);
  int contacts = 0;
  for (int k = 0; k < 1000; ++k) {
    const PairPose pose = testing::random_pose(draw, 0.7, 1.1);
    PairPose back{-(pose.turn.transpose() * pose.centre), pose.turn.transpose(), pose.scale_b,
                  pose.scale_a};
    const Found here = contact_of({shape, cube, pose}), there = contact_of({cube, shape, back});
    REQUIRE(here.points.size() == there.points.size());
    if (here.points.empty()) continue;
    ++contacts;
    REQUIRE((here.contact.normal + pose.turn * there.contact.normal).norm() < 1e-12);
    std::vector<ContactPoint> seen;
    for (const ContactPoint& p : there.points) {
      seen.push_back({pose.centre + pose.turn * p.position, p.gap});
    }
    REQUIRE(mismatch(here.points, seen) < 1e-12);
  }
  CHECK(contacts > 300);
}

// 1e-12 d is the bound of the separating axes.
TEST_CASE("gaps never exceed the true distance, and the deepest is the true depth") {
  Draw draw(23);
  const ConvexShape shape = pinacoid({});
  const ConvexShape hull = testing::hull_of(testing::random_corners(draw, 12));
  for (const PairFamily family : testing::all_pair_families) {
    for (int k = 0; k < 200; ++k) {
      const ConvexShape& b = k % 2 == 0 ? shape : hull;
      const ShapePair pair{shape, b, testing::pose_of_family(family, draw, shape, b)};
      const auto truth = static_cast<double>(testing::true_gap(pair).gap());
      const Found found = contact_of(pair);
      INFO(testing::name_of(family) << " " << k << ", gap " << truth);
      if (truth <= 0.05) REQUIRE_FALSE(found.points.empty());
      if (found.points.empty()) continue;
      REQUIRE(found.contact.separation <= truth + 1e-12);
      if (truth < 0) REQUIRE(found.contact.separation == about(truth, 1e-12));
      double least = 1;
      for (const ContactPoint& point : found.points) {
        REQUIRE(point.gap <= 0.05);
        REQUIRE(point.gap >= found.contact.separation - 1e-12);
        least = std::min(least, point.gap);
      }
      if (truth < 0) REQUIRE(least == about(truth, 1e-9));
    }
  }
}

TEST_CASE("a pair that moves gives the same contacts with its memory as without") {
  Draw draw(24);
  for (const ConvexShape& shape :
       {pinacoid({}), testing::hull_of(testing::random_corners(draw, 16))}) {
    PairMemory memory;
    TouchColumns columns;
    const double usual = 0.95 * (shape.inradius + shape.circumradius);
    PairPose pose = testing::random_pose(draw, usual, usual);
    int contacts = 0, parted = 0;
    for (int k = 0; k < 2000; ++k) {
      pose.centre += 0.02 * testing::random_direction(draw) -
                     0.1 * (pose.centre.norm() - usual) * pose.centre.normalized();
      pose.turn = turn(0.02, testing::random_direction(draw)) * pose.turn;
      std::vector<ContactPoint> points;
      const PairContact contact = touch({shape, shape, pose}, {0.05, 0}, memory, columns, points);
      const Found afresh = contact_of({shape, shape, pose});
      REQUIRE(contact.count == afresh.points.size());
      REQUIRE(mismatch(points, afresh.points) == 0);
      (contact.count > 0 ? contacts : parted) += 1;
    }
    CHECK(contacts > 100);
    CHECK(parted > 100);
  }
}

TEST_CASE(
    "edges give the normal only where they part a pair better, or nothing is above the face") {
  const ConvexShape shape = pinacoid({});
  Draw draw(25);
  int switched = 0, on_faces = 0;
  for (int k = 0; k < 2000; ++k) {
    const ShapePair pair{shape, shape, testing::random_pose(draw, 0.7, 1.0)};
    const ContactAxes axes = separating_axes(pair, testing::kernels().hull);
    if (axes.edges.kind == AxisKind::none) continue;
    const double ahead = axes.edges.separation - axes.face.separation;
    if (axes.separation() > 0.05 || ahead < 1e-6) continue;
    ++switched;
    CHECK(contact_of(pair, 0.05, 0.999 * ahead).contact.kind == AxisKind::edges);
    const Found any = contact_of(pair, 0.05, 1.0);  // on the face, but where nothing is above it
    const bool is_above = any.contact.kind != AxisKind::edges &&
                          any.deepest() <= axes.edges.separation + 1.001 * ahead;
    const AxisKind kind = contact_of(pair, 0.05, 1.001 * ahead).contact.kind;
    CHECK(kind == (is_above ? axes.face.kind : AxisKind::edges));
    on_faces += is_above ? 1 : 0;
  }
  CHECK(switched > 100);
  CHECK(on_faces > 100);
}

TEST_CASE(
    "the deeper edges overlap the more a face is preferred, where it sees the overlap whole") {
  const ConvexShape shape = pinacoid({});
  Draw draw(26);
  int faces = 0, edges = 0;
  for (int k = 0; k < 20000; ++k) {
    const ShapePair pair{shape, shape, testing::random_pose(draw, 0.5, 0.9)};
    const ContactAxes axes = separating_axes(pair, testing::kernels().hull);
    const double depth = -axes.edges.separation;
    const double ahead = axes.edges.separation - axes.face.separation;
    if (axes.edges.kind == AxisKind::none || depth < 1e-3 || ahead < 1e-6) continue;
    const double share = ahead / depth;
    CHECK(contact_of(pair, {0.05, 0.0, 0.999 * share}).contact.kind == AxisKind::edges);
    const Found found = contact_of(pair, {0.05, 0.0, 1.001 * share});
    const AxisKind kind = found.contact.kind;
    CHECK((kind == axes.face.kind || kind == AxisKind::edges));
    CHECK(contact_of(pair, {0.05, 0.5 * ahead, 0.501 * share}).contact.kind == kind);
    CHECK(found.deepest() <= axes.edges.separation);
    (kind == AxisKind::edges ? edges : faces) += 1;
  }
  CHECK(faces > 1000);
  CHECK(edges > 10);
}

// The sides of such a prism are narrow: what touches often lies beside the one that parts a pair
// best, and not above it.
TEST_CASE("a face is touched on only where what touches lies above it") {
  const ConvexShape prism = testing::hull_of(corners_of(PrismSize{32}));
  Draw draw(29);
  constexpr double preference = 1.25e-3;  // of a quarter of a step
  int touched = 0, on_faces = 0;
  for (int k = 0; k < 2000; ++k) {
    const Draw::Direction n = draw.direction();
    const Vector centre = draw.uniform(0.9, 1.2) * Vector(n.x, n.y, n.z);
    const Matrix rotation = testing::random_rotation(draw).toRotationMatrix();
    const ShapePair pair{prism, prism, at(centre, rotation)};
    const double separation = separating_axes(pair, testing::kernels().hull).separation();
    for (const double margin : {0.015, 1e-4}) {  // of steps, and of measuring them
      const Found found = contact_of(pair, margin, preference);
      if (found.points.empty()) continue;
      ++touched;
      on_faces += found.contact.kind == AxisKind::edges ? 0 : 1;
      INFO(k << ", separation " << separation);
      REQUIRE(found.deepest() <= separation + preference + 1e-12);
    }
  }
  CHECK(touched > 500);
  CHECK(on_faces > touched / 4);
}

TEST_CASE("edges that are apart give the normal whatever is preferred by their depth") {
  const ConvexShape shape = pinacoid({});
  Draw draw(27);
  int apart = 0;
  for (int k = 0; k < 2000; ++k) {
    const ShapePair pair{shape, shape, testing::random_pose(draw, 0.7, 1.0)};
    const ContactAxes axes = separating_axes(pair, testing::kernels().hull);
    if (axes.edges.kind == AxisKind::none || axes.separation() > 0.05) continue;
    if (axes.edges.separation < 1e-6 || axes.edges.separation < axes.face.separation + 1e-6)
      continue;
    ++apart;
    CHECK(contact_of(pair, {0.05, 0.0, 1.0}).contact.kind == AxisKind::edges);
  }
  CHECK(apart > 20);
}

TEST_CASE("shapes beyond the margin have no contact") {
  const ConvexShape cube = testing::cube();
  CHECK(contact_of({cube, cube, at({0, 0, 1.0501})}, 0.05).points.empty());
  CHECK(contact_of({cube, cube, at({0, 0, 1.0501})}, 0.0502).points.size() == 4);
  CHECK(contact_of({cube, cube, at({5, 5, 5})}, 0.05).points.empty());
}

TEST_CASE("grains scale: contacts of larger grains are those of the scaled shapes") {
  const ConvexShape cube = testing::cube(), large = testing::box_shape(2, 2, 2);
  PairPose pose = at({0.3, 0.2, 1.51}, turn(0.3, Vector::UnitZ()));
  const Found plain = contact_of({cube, large, pose});
  pose.scale_b = 2;
  const Found scaled = contact_of({cube, cube, pose});
  REQUIRE(plain.points.size() == scaled.points.size());
  CHECK(mismatch(plain.points, scaled.points) < 1e-15);
}

std::vector<ContactPoint> on_floor(const ConvexShape& shape, const Pose& pose,
                                   double margin = 0.05) {
  std::vector<ContactPoint> points;
  const std::size_t count = touch_wall(shape, pose, {}, margin, points);
  CHECK(count == points.size());
  return points;
}

TEST_CASE("a cube on the floor rests on four corners, tilted on an edge or a corner") {
  const ConvexShape cube = testing::cube();
  Pose pose;
  pose.centre = {3, 4, 0.51};
  const auto flat = on_floor(cube, pose);
  REQUIRE(flat.size() == 4);
  for (const ContactPoint& p : flat) {
    CHECK(p.gap == Approx(0.01));
    CHECK(p.position.z() == -0.5);
  }
  pose.orientation = Eigen::AngleAxisd(half_turn / 4, Vector::UnitX());
  pose.centre.z() = std::sqrt(0.5) - 0.02;
  const auto edge = on_floor(cube, pose);
  REQUIRE(edge.size() == 2);
  CHECK(edge[0].gap == Approx(-0.02));
  pose.orientation = Quaternion::FromTwoVectors(Vector(1, 1, 1), Vector(0, 0, -1));
  pose.centre.z() = 1.5 * std::sqrt(0.75);
  pose.scale = 1.5;
  const auto corner = on_floor(cube, pose);
  REQUIRE(corner.size() == 1);
  CHECK((corner[0].position - Vector(0.75, 0.75, 0.75)).norm() < 1e-15);
  CHECK(corner[0].gap == Approx(0).margin(1e-15));
}

TEST_CASE("a wall keeps grains on the side its normal points to") {
  const ConvexShape cube = testing::cube();
  Pose pose;
  pose.centre = {0, 4.52, 0};
  std::vector<ContactPoint> points;
  CHECK(touch_wall(cube, pose, {{0, -1, 0}, 5}, 0.05, points) == 4);
  for (const ContactPoint& p : points) {
    CHECK(p.gap == Approx(-0.02));
    CHECK(p.position.y() == 0.5);
  }
  CHECK(touch_wall(cube, pose, {{0, 1, 0}, 0}, 0.05, points) == 0);
}

}  // namespace
}  // namespace grainsweep
