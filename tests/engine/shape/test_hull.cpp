#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::hull_of;

std::string refusal(const std::vector<Vector>& points) {
  const Hull hull = convex_hull(points);
  CHECK(hull.shape.has_value() == hull.error.empty());
  return hull.error;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool is_inside(const ConvexShape& shape, const Vector& x) {
  for (const Face& face : shape.faces) {
    if (face.normal.dot(x) > face.offset) return false;
  }
  return true;
}

TEST_CASE("a cube has six square faces, three edge directions and inertia of a sixth") {
  const ConvexShape cube = testing::box_shape(2, 2, 2);
  CHECK(cube.vertices.size() == 8);
  CHECK(cube.faces.size() == 6);
  CHECK(cube.edges.size() == 12);
  CHECK(cube.edge_directions.size() == 3);
  CHECK(cube.volume == Approx(8).epsilon(1e-15));
  CHECK((cube.inertia - Vector::Constant(4.0 / 6.0)).norm() < 1e-15);
  CHECK(cube.circumradius == Approx(std::sqrt(3.0)));
  CHECK(cube.inradius == Approx(1));
  CHECK(testing::is_symmetric(cube));
  for (const Face& face : cube.faces) CHECK(face.corners == 4);
}

TEST_CASE("a regular tetrahedron has its closed-form volume, inertia and radii") {
  const ConvexShape shape = testing::tetrahedron();  // edge sqrt 8
  CHECK(shape.faces.size() == 4);
  CHECK(shape.edges.size() == 6);
  CHECK(shape.edge_directions.size() == 6);
  CHECK(shape.volume == Approx(8.0 / 3.0).epsilon(1e-15));
  CHECK((shape.inertia - Vector::Constant(8.0 / 20.0)).norm() < 1e-15);
  CHECK(shape.circumradius == Approx(std::sqrt(3.0)));
  CHECK(shape.inradius == Approx(std::sqrt(3.0) / 3));
  CHECK_FALSE(testing::is_symmetric(shape));
}

/// Independent of the shape's own integrals: tetrahedra from a corner instead of the centroid, the
/// integrals of x^2 and x y from the corners' symmetric sums.
void check_mass(const ConvexShape& shape) {
  const Vector apex = shape.vertices[0];
  double volume = 0;
  Vector first = Vector::Zero(), squares = Vector::Zero(), products = Vector::Zero();
  for (const Face& face : shape.faces) {
    for (int k = 1; k + 1 < face.corners; ++k) {
      const auto corner = [&](int at) { return shape.vertices[shape.loops[face.first + at]]; };
      const Vector p[4] = {apex, corner(0), corner(k), corner(k + 1)};
      const double part = (p[1] - apex).dot((p[2] - apex).cross(p[3] - apex)) / 6;
      volume += part;
      for (int i = 0; i < 4; ++i) {
        first += part / 4 * p[i];
        for (int j = 0; j < 4; ++j) {
          const double weight = part / 20 * (i == j ? 2 : 1);
          const Vector next_i(p[i].y(), p[i].z(), p[i].x());
          squares += weight * p[i].cwiseProduct(p[j]);
          products += weight * next_i.cwiseProduct(p[j]);
        }
      }
    }
  }
  const double size = shape.circumradius;
  REQUIRE(volume == Approx(shape.volume).epsilon(1e-12));
  REQUIRE((first / volume).norm() < 1e-13 * size);
  REQUIRE((products / volume).norm() < 1e-13 * size * size);
  const Vector inertia = Vector::Constant(squares.sum()) - squares;
  REQUIRE((inertia / volume - shape.inertia).norm() < 1e-12 * size * size);
}

TEST_CASE("random hulls obey Euler's formula and have the mass of their tetrahedra") {
  Draw draw(11);
  for (int run = 0; run < 200; ++run) {
    const int count = 4 + static_cast<int>(draw.below(40));
    const ConvexShape shape = hull_of(testing::random_corners(draw, count));
    INFO("run " << run << ", " << count << " points");
    REQUIRE(shape.vertices.size() == static_cast<std::size_t>(count));
    REQUIRE(shape.vertices.size() + shape.faces.size() == shape.edges.size() + 2);
    REQUIRE(shape.inertia.x() <= shape.inertia.y());
    REQUIRE(shape.inertia.y() <= shape.inertia.z());
    check_mass(shape);
  }
}

TEST_CASE("vertices lie on the planes of their faces and behind all others, edges between two") {
  Draw draw(12);
  for (int run = 0; run < 50; ++run) {
    const ConvexShape shape = run % 2 == 0 ? hull_of(testing::random_corners(draw, 20))
                                           : pinacoid({1.2, 0.9, 0.5 + draw.unit() / 2, 1.1});
    for (const Face& face : shape.faces) {
      CHECK(face.normal.norm() == Approx(1).epsilon(1e-15));
      for (const Vector& v : shape.vertices) REQUIRE(face.normal.dot(v) <= face.offset);
      for (int k = 0; k < face.corners; ++k) {
        const Vector& v = shape.vertices[shape.loops[face.first + k]];
        REQUIRE(face.normal.dot(v) == about(face.offset, 1e-14));
      }
    }
    for (const Edge& edge : shape.edges) {
      const Vector along = shape.vertices[edge.to] - shape.vertices[edge.from];
      const Vector between = shape.faces[edge.left].normal.cross(shape.faces[edge.right].normal);
      REQUIRE(along.dot(between) > 0);
      REQUIRE(shape.edge_directions[edge.direction].cross(along).norm() < 1e-14);
    }
    for (std::size_t v = 0; v < shape.vertices.size(); ++v) {
      const int faces = shape.vertex_faces_begin[v + 1] - shape.vertex_faces_begin[v];
      REQUIRE(faces >= 3);
      for (int k = 0; k < faces; ++k) {
        const Face& face = shape.faces[shape.vertex_faces[shape.vertex_faces_begin[v] + k]];
        REQUIRE(face.normal.dot(shape.vertices[v]) == about(face.offset, 1e-14));
      }
    }
  }
}

// 200,000 points in the circumscribed cube: the share inside scatters by sqrt(p (1 - p) / n), the
// second moments by less than twice as much; 4.5 standard errors fail once in 150,000 checks.
TEST_CASE("volume and inertia of random hulls are those of random points inside") {
  Draw draw(13);
  for (int run = 0; run < 3; ++run) {
    const ConvexShape shape = hull_of(testing::random_corners(draw, 12));
    const int samples = 200000;
    const double r = shape.circumradius;
    int inside = 0;
    Vector squares = Vector::Zero();
    for (int k = 0; k < samples; ++k) {
      const Vector x(draw.uniform(-r, r), draw.uniform(-r, r), draw.uniform(-r, r));
      if (!is_inside(shape, x)) continue;
      ++inside;
      squares += x.cwiseProduct(x);
    }
    const double share = static_cast<double>(inside) / samples, cube = 8 * r * r * r;
    const double error = std::sqrt(share * (1 - share) / samples);
    CHECK(share * cube == about(shape.volume, 4.5 * error * cube));
    const Vector inertia = Vector::Constant((squares / inside).sum()) - squares / inside;
    CHECK((inertia - shape.inertia).norm() < 4.5 * 2 * r * r / std::sqrt(inside));
  }
}

TEST_CASE("a hull knows where its frame lies among the points it was given") {
  Draw draw(14);
  const ConvexShape upright = testing::box_shape(1, 2, 3);
  const Quaternion turn = testing::random_rotation(draw);
  std::vector<Vector> points;
  for (const Vector& v : upright.vertices) points.push_back(turn * v + Vector(5, -7, 2));
  const Hull hull = convex_hull(points);
  REQUIRE(hull.shape);
  CHECK((hull.shape->given.centroid - Vector(5, -7, 2)).norm() < 1e-14);
  CHECK(hull.shape->given.rotation.determinant() == Approx(1).epsilon(1e-14));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector back =
        hull.shape->given.rotation * hull.shape->vertices[k] + hull.shape->given.centroid;
    CHECK((back - points[k]).norm() < 1e-14);
  }
  CHECK((hull.shape->inertia - Vector(5.0 / 12, 10.0 / 12, 13.0 / 12)).norm() < 1e-13);
}

TEST_CASE("points on the faces and edges of a hull add nothing to it") {
  std::vector<Vector> points = testing::cube().vertices;
  points.insert(points.begin(), {0.5, 0, 0});
  points.emplace_back(0.5, 0.5, 0.1);
  points.emplace_back(0.2, 0.1, -0.5);
  const ConvexShape shape = hull_of(points);
  CHECK(shape.vertices.size() == 8);
  CHECK(shape.faces.size() == 6);
  CHECK(shape.edges.size() == 12);
}

/// A rhombic dodecahedron: four of its faces meet at six of its corners.
std::vector<Vector> rhombic_dodecahedron() {
  std::vector<Vector> points = testing::cube().vertices;
  for (int axis = 0; axis < 3; ++axis) {
    points.emplace_back(Vector::Unit(axis));
    points.emplace_back(-Vector::Unit(axis));
  }
  return points;
}

std::vector<Vector> prism_corners(int sides) {
  std::vector<Vector> points;
  for (int k = 0; k < 2 * sides; ++k) {
    const double angle = 2 * pi * (k / 2) / sides;
    points.emplace_back(std::cos(angle), std::sin(angle), k % 2);
  }
  return points;
}

TEST_CASE("faces of points that were rounded are flat, however the points were turned and moved") {
  Draw draw(16);
  struct Solid {
    std::vector<Vector> points;
    std::size_t faces;
  };
  const Solid solid = GENERATE(Solid{testing::cube().vertices, 6}, Solid{prism_corners(6), 8},
                               Solid{prism_corners(32), 34}, Solid{rhombic_dodecahedron(), 12});
  const double rounding = GENERATE(1e-12, 1e-8, 1e-6, 2e-5);
  const Quaternion turn = testing::random_rotation(draw);
  std::vector<Vector> points;
  for (const Vector& p : solid.points) {
    const Vector noise(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1));
    points.push_back(turn * p + Vector(3, -1, 2) + rounding * noise);
  }
  const ConvexShape exact = convex_hull(solid.points).shape.value();
  const ConvexShape flat = convex_hull(points, flat_as_written).shape.value();
  CHECK(flat.faces.size() == solid.faces);
  CHECK(flat.vertices.size() == solid.points.size());
  CHECK(flat.volume == Approx(exact.volume).epsilon(10 * rounding));
  for (const Face& face : flat.faces) {
    for (const std::int32_t k : corners_of(flat, face)) {
      CHECK(face.normal.dot(flat.vertices[static_cast<std::size_t>(k)]) ==
            about(face.offset, 1e-12));
    }
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector back = flat.given.rotation * flat.vertices[k] + flat.given.centroid;
    CHECK((back - points[k]).norm() < 30 * rounding);
  }
}

TEST_CASE("a flattened hull is what it was when it is made anew of its corners") {
  Draw draw(17);
  std::vector<Vector> points = rhombic_dodecahedron();
  for (Vector& p : points) p += 1e-5 * Vector(draw.unit(), draw.unit(), draw.unit());
  const ConvexShape once = convex_hull(points, flat_as_written).shape.value();
  const ConvexShape again = convex_hull(once.vertices, flat_as_stored).shape.value();
  CHECK(again.faces.size() == once.faces.size());
  for (std::size_t k = 0; k < once.vertices.size(); ++k) {
    CHECK((again.given.rotation * again.vertices[k] + again.given.centroid - once.vertices[k])
              .norm() < 1e-14);
  }
}

TEST_CASE("faces that are bent more, chamfers and thin plates keep their shape") {
  std::vector<Vector> roof = testing::cube().vertices;
  roof.emplace_back(0, 0, 0.501);
  CHECK(convex_hull(roof, flat_as_written).shape->faces.size() == 9);
  const double thin = 1e-5;
  std::vector<Vector> plate;
  for (const Vector& p : testing::cube().vertices) plate.emplace_back(p.x(), p.y(), thin * p.z());
  const ConvexShape shape = convex_hull(plate, flat_as_written).shape.value();
  CHECK(shape.faces.size() == 6);
  CHECK(shape.volume == Approx(thin));
}

TEST_CASE("a hull far from the origin has the shape and the mass of one there") {
  const Vector far_off(3e6, -5e6, 1e5);
  std::vector<Vector> points;
  for (const Vector& p : testing::box_shape(1, 2, 3).vertices) points.push_back(p + far_off);
  const ConvexShape shape = convex_hull(points, flat_as_written).shape.value();
  const double rounding = 1e-8;  // of coordinates of 5e6
  CHECK(shape.volume == Approx(6).epsilon(rounding));
  CHECK((shape.given.centroid - far_off).norm() < rounding);
  CHECK(shape.circumradius == Approx(std::sqrt(14.0) / 2).epsilon(rounding));
}

TEST_CASE("points that span no hull are refused with the reason") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double far_off = std::numeric_limits<double>::infinity();
  CHECK(says(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "at least 4 vertices, has 3"));
  CHECK(says(refusal({}), "has 0"));
  CHECK(says(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}}), "on a plane"));
  CHECK(says(refusal({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {4, 4, 4}}), "on a line"));
  CHECK(says(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}}),
             "vertex 4 of 4 must have finite coordinates"));
  CHECK(
      says(refusal({{0, far_off, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), "vertex 1 of 4 must have"));
  CHECK(says(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}),
             "vertex 5 of 5 is there twice, also as vertex 2"));
  std::vector<Vector> dented = testing::cube().vertices;
  dented.emplace_back(0.1, 0.2, 0.3);
  CHECK(says(
      refusal(dented),
      "vertex 9 of 9 lies inside the hull of the others, 11.547 % of the shape's extent deep"));
}

// Twisted far from the origin: what is flat there to rounding must not become a sliver of a hull.
TEST_CASE("a tilted plane of points is refused whatever its place and scale") {
  Draw draw(15);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Quaternion turn = testing::random_rotation(draw);
    std::vector<Vector> points;
    for (int k = 0; k < 10; ++k) {
      points.push_back(scale * (turn * Vector(draw.unit(), draw.unit(), 0) + Vector(3, 1, 2)));
    }
    CHECK(says(refusal(points), "on a plane"));
  }
}

TEST_CASE("faces of a hull leave out points within it, and points without a hull are refused") {
  std::vector<Vector> points = {{0.1, 0.2, 0.3}};
  for (int k = 0; k < 8; ++k) points.emplace_back(k & 1, (k >> 1) & 1, k >> 2);
  const Loops faces = hull_faces(points);
  CHECK(faces.size() == 6);
  for (const auto& face : faces) {
    CHECK(face.size() == 4);
    CHECK(*std::min_element(face.begin(), face.end()) > 0);
  }
  CHECK_THROWS_AS(hull_faces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), std::invalid_argument);
}

TEST_CASE(
    "a dent is as deep as its deepest face, wherever the body lies and however it is turned") {
  // A cube with a wedge cut out of its top, 0.5 deep along x = 0.5: the wedge's sides are the last.
  const std::vector<Vector> points = {
      Vector(0, 0, 0), Vector(1, 0, 0), Vector(1, 1, 0), Vector(0, 1, 0),     Vector(0, 0, 1),
      Vector(1, 0, 1), Vector(1, 1, 1), Vector(0, 1, 1), Vector(0.5, 0, 0.5), Vector(0.5, 1, 0.5)};
  Loops faces = {{3, 2, 1, 0}, {0, 1, 5, 8, 4}, {2, 3, 7, 9, 6}, {1, 2, 6, 5},
                 {3, 0, 4, 7}, {4, 8, 9, 7},    {8, 5, 6, 9}};
  for (const double far : {0.0, 1e5}) {
    std::vector<Vector> moved = points;
    for (Vector& point : moved) point += Vector(far, -far, 0.0);
    const auto found = deepest_dent(moved, faces);
    REQUIRE(found);
    CHECK((found->face == 5 || found->face == 6));  // both have the edge at the bottom
    CHECK(found->depth == Approx(0.5).epsilon(1e-9));
    CHECK(found->extent == Approx(std::sqrt(3.0)).epsilon(1e-9));
  }
  faces = {{0, 3, 2, 1}, {4, 5, 6, 7}};  // those of the hull are none
  CHECK_FALSE(deepest_dent(points, faces));
  CHECK_FALSE(deepest_dent({Vector(0, 0, 0), Vector(1, 0, 0)}, {{0, 1, 0}}));
}

TEST_CASE(
    "a flat face whose edges lie on the hull is a dent if it goes through it, a bent one not") {
  std::vector<Vector> points = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(1, 1, 0), Vector(0, 1, 0),
                                Vector(0, 0, 1), Vector(1, 0, 1), Vector(1, 1, 1), Vector(0, 1, 1)};
  const auto across = deepest_dent(points, {{0, 3, 2, 1}, {0, 2, 6, 4}});
  REQUIRE(across);
  CHECK(across->face == 1);
  CHECK(across->depth == Approx(0.5).epsilon(1e-9));
  for (const std::size_t k : {5, 7}) points[k].z() = 1.2;  // a ridge across the top
  CHECK_FALSE(deepest_dent(points, {{4, 5, 6, 7}}));
}

}  // namespace
}  // namespace grainsweep
