#include <limits>

#include <catch2/catch.hpp>

#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

const PinacoidSize paper{};  // length = width = height = d, 60 degrees

double surface_of(const ConvexShape& shape) {
  double surface = 0;
  for (const Face& face : shape.faces) {
    Vector area = Vector::Zero();
    for (int k = 0; k < face.corners; ++k) {
      const auto corner = [&](int at) {
        return shape.vertices[shape.loops[face.first + at % face.corners]];
      };
      area += corner(k).cross(corner(k + 1)) / 2;
    }
    surface += area.dot(face.normal);
  }
  return surface;
}

// The digits printed for the reference study's pinacoid; each holds to its last one.
TEST_CASE("the pinacoid of the reference study has its volume, surface, radii and inertia") {
  const ConvexShape shape = pinacoid(paper);
  CHECK(shape.vertices.size() == 8);
  CHECK(shape.faces.size() == 8);
  CHECK(shape.edges.size() == 14);
  CHECK(shape.edge_directions.size() == 6);
  CHECK(testing::is_symmetric(shape));
  CHECK(2 * shape.pinacoid->c == about(0.422650, 5e-7));
  CHECK(shape.volume == about(0.403775, 5e-7));
  CHECK(surface_of(shape) == about(3.16663, 5e-6));
  CHECK(shape.circumradius == about(0.70711, 5e-6));
  CHECK(shape.inradius == about(0.35355, 5e-6));
  CHECK(shape.inertia.x() == about(0.07936, 5e-6));
  CHECK(shape.inertia.y() == about(0.09255, 5e-6));
  CHECK(shape.inertia.z() == about(0.10447, 5e-6));
}

TEST_CASE("a pinacoid in closed form is the hull of its vertices") {
  for (const PinacoidSize& size : {paper, PinacoidSize{1.5, 0.8, 0.6, 0.9},
                                   PinacoidSize{1, 1, 0.01, 0.3}, PinacoidSize{1, 2, 1, pi / 4}}) {
    const ConvexShape closed = pinacoid(size), hull = testing::hull_of(closed.vertices);
    INFO(size.length << " " << size.width << " " << size.height << " " << size.angle);
    CHECK(hull.vertices.size() == closed.vertices.size());
    CHECK(hull.faces.size() == closed.faces.size());
    CHECK(hull.edges.size() == closed.edges.size());
    CHECK(hull.edge_directions.size() == closed.edge_directions.size());
    CHECK(hull.volume == Approx(closed.volume).epsilon(1e-14));
    CHECK((hull.inertia - closed.inertia).norm() < 1e-14);
    CHECK(hull.inradius == Approx(closed.inradius).epsilon(1e-14));
    CHECK(hull.circumradius == Approx(closed.circumradius).epsilon(1e-14));
    CHECK(testing::is_symmetric(hull));
  }
}

// The numbers by which the batch kernel names axes.
TEST_CASE("faces of a pinacoid lie opposite each other four numbers apart, edges begin along x") {
  for (const double angle : {pi / 3, pi / 4}) {
    const ConvexShape shape = pinacoid({1, 1, 1, angle});
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK((shape.faces[k].normal + shape.faces[k + 4].normal).norm() < 1e-15);
    }
    const PinacoidHalves w = *shape.pinacoid;
    const double s = w.a - w.c;
    const Vector normals[] = {{0, w.e, w.b}, {0, -w.e, w.b}, {w.e, 0, s}, {-w.e, 0, s}};
    const Vector edges[] = {{1, 0, 0},      {s, -w.b, w.e},   {s, w.b, -w.e},
                            {-s, w.b, w.e}, {-s, -w.b, -w.e}, {0, 1, 0}};
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK((shape.faces[k].normal - normals[k].normalized()).norm() < 1e-15);
    }
    REQUIRE(shape.edge_directions.size() == 6);
    for (std::size_t k = 0; k < 6; ++k) {
      CHECK(shape.edge_directions[k].cross(edges[k].normalized()).norm() < 1e-15);
    }
  }
}

TEST_CASE("the half width of a pinacoid is the reach of its vertices in every direction") {
  testing::Draw draw(3);
  for (const PinacoidSize& size : {paper, PinacoidSize{1.5, 0.8, 0.6, 0.9}}) {
    const ConvexShape shape = pinacoid(size);
    for (int k = 0; k < 1000; ++k) {
      const Vector n = testing::random_direction(draw);
      REQUIRE(half_width(*shape.pinacoid, n) == Approx(reach_along(shape, n)).epsilon(1e-15));
    }
  }
}

TEST_CASE("a pinacoid whose ends would cross, or with a bad length, is refused with the reason") {
  const auto refusal = [](const PinacoidSize& size) { return problem_with(size); };
  CHECK(refusal(paper) == "");
  CHECK(refusal({1, 1, 1, pi / 4}) == "");
  CHECK(refusal({1, 1, 1, 0.7}).find("tan(angle) must be at least height / length = 1") !=
        std::string::npos);
  CHECK(refusal({1, 1, 1, 0.7}).find("the least angle is 45 degrees") != std::string::npos);
  CHECK(refusal({1e-3, 1, 1, 1.5}).find("no angle is that steep") != std::string::npos);
  CHECK(refusal({1, 0, 1, 1}).find("width must lie in [1e-06, 10000], is 0") == 0);
  CHECK(refusal({-1, 1, 1, 1}).find("length") == 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal({1, 1, nan, 1}).find("height") == 0);
  CHECK(refusal({1, 1, 1, nan}).find("angle") == 0);
  CHECK(refusal({1, 1, 1, pi / 2}).find("at most 89 degrees, is 90") != std::string::npos);
  CHECK(refusal({1, 1, 1, 0}).find("angle must be above 0") == 0);
}

}  // namespace
}  // namespace grainsweep
