#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "kernels/kernels.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::testable_isas;

struct Vec {
  double x, y, z;
};
double dot(const Vec& u, const Vec& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
Vec minus(const Vec& u, const Vec& v) { return {u.x - v.x, u.y - v.y, u.z - v.z}; }
Vec cross(const Vec& u, const Vec& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

constexpr std::size_t padded(std::size_t count) {
  return (count + block_width - 1) / block_width * block_width;
}

/// Columns of the form that kernels take.
struct Points {
  std::vector<double> x, y, z;
  std::size_t count;

  explicit Points(const std::vector<Vec>& points)
      : x(padded(points.size())), y(x.size()), z(x.size()), count(points.size()) {
    for (std::size_t k = 0; k < count; ++k)
      x[k] = points[k].x, y[k] = points[k].y, z[k] = points[k].z;
  }
  PointColumns columns() const { return {x.data(), y.data(), z.data(), count}; }
};

Vec unit(Draw& draw) {
  const Draw::Direction d = draw.direction();
  return {d.x, d.y, d.z};
}
std::vector<Vec> units(Draw& draw, std::size_t count) {
  std::vector<Vec> drawn;
  for (std::size_t k = 0; k < count; ++k) drawn.push_back(unit(draw));
  return drawn;
}

TEST_CASE("the farthest point is found as one by one, the first of equals") {
  Draw draw(3);
  for (const std::size_t count : {4, 8, 15, 16, 17, 64}) {
    std::vector<Vec> points = units(draw, count);
    points[0] = {-points[1].x, -points[1].y, -points[1].z};  // 0 lies between
    points.push_back(points[count / 2]);
    const Points columns(points);
    for (int trial = 0; trial < 50; ++trial) {
      const Vec& wanted = points[draw.below(points.size())];
      const Vec n = trial % 2 == 0 ? wanted : unit(draw);
      std::size_t first = 0;
      for (std::size_t k = 1; k < points.size(); ++k) {
        if (dot(points[k], n) > dot(points[first], n)) first = k;
      }
      for (const Isa isa : testable_isas()) {
        INFO(name_of(isa) << ", " << count << " points");
        std::vector<double> reach(columns.x.size());
        CHECK(kernels_for(isa).hull.farthest(columns.columns(), &n.x, reach.data()) == first);
        for (std::size_t k = 0; k < points.size(); ++k) CHECK(reach[k] == dot(points[k], n));
      }
    }
  }
}

TEST_CASE("the largest number is the first of equals, wherever it stands") {
  for (const std::size_t count : {1, 2, 7, 8, 9, 33}) {
    for (std::size_t at = 0; at < count; ++at) {
      std::vector<double> numbers(padded(count), -std::numeric_limits<double>::infinity());
      std::fill_n(numbers.begin(), count, -2.0);
      numbers[at] = -1.0;
      numbers[count - 1] = -1.0;
      for (const Isa isa : testable_isas()) {
        INFO(name_of(isa) << ", " << at << " of " << count);
        CHECK(kernels_for(isa).hull.largest(numbers.data(), count) == at);
      }
    }
  }
}

TEST_CASE("heights over planes are those of one by one, the least of several points is kept") {
  Draw draw(5);
  for (const std::size_t count : {4, 6, 12, 34}) {
    const std::vector<Vec> normals = units(draw, count), points = units(draw, 3);
    const Points columns(normals);
    std::vector<double> offset(columns.x.size(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < count; ++k) offset[k] = draw.uniform(0.1, 0.5);
    const double scale = draw.uniform(0.5, 2.0);
    for (const Isa isa : testable_isas()) {
      INFO(name_of(isa) << ", " << count << " planes");
      const HullKernels& kernels = kernels_for(isa).hull;
      const std::size_t stride = offset.size();
      std::vector<double> least(stride, std::numeric_limits<double>::infinity());
      std::vector<double> heights(stride * points.size());
      for (std::size_t p = 0; p < points.size(); ++p) {
        kernels.heights({columns.columns(), offset.data()}, scale, &points[p].x,
                        heights.data() + p * stride, least.data());
      }
      CHECK(kernels.largest(least.data(), count) < count);
      std::vector<std::uint64_t> below(stride);
      kernels.below(heights.data(), stride, points.size(), -0.3, below.data());
      for (std::size_t k = 0; k < count; ++k) {
        double lowest = std::numeric_limits<double>::infinity();
        for (std::size_t p = 0; p < points.size(); ++p) {
          const double height = dot(normals[k], points[p]) - scale * offset[k];
          CHECK(heights[p * stride + k] == height);
          CHECK((below[k] >> p & 1) == (height <= -0.3 ? 1 : 0));
          lowest = std::min(lowest, height);
        }
        CHECK(least[k] == lowest);
      }
    }
  }
}

TEST_CASE("of more than 64 points the first 64 are told apart") {
  const std::vector<double> heights(70 * block_width, -1.0);
  for (const Isa isa : testable_isas()) {
    std::vector<std::uint64_t> below(block_width);
    kernels_for(isa).hull.below(heights.data(), block_width, 70, 0.0, below.data());
    CHECK(below == std::vector<std::uint64_t>(block_width, ~std::uint64_t{0}));
  }
}

/// An edge between two faces of a hull.
struct Edge {
  Vec from, along, left, right;
};
Edge drawn_edge(Draw& draw) {
  const Vec along = unit(draw);
  const auto across = [&] {
    const Vec n = cross(along, unit(draw));
    const double length = std::sqrt(dot(n, n));
    return Vec{n.x / length, n.y / length, n.z / length};
  };
  return {unit(draw), along, across(), across()};
}

TEST_CASE("edges cross as one by one, with the same bits on all instruction sets") {
  constexpr double in_doubt = 1e-12, parallel = 1e-14;
  Draw draw(7);
  int crossed = 0;
  for (const std::size_t count : {1, 5, 8, 23}) {
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < count; ++k) edges.push_back(drawn_edge(draw));
    std::vector<Vec> from, along, left, right;
    for (const Edge& edge : edges) {
      from.push_back(edge.from), along.push_back(edge.along);
      left.push_back(edge.left), right.push_back(edge.right);
    }
    const Points froms(from), alongs(along), lefts(left), rights(right);
    for (int trial = 0; trial < 200; ++trial) {
      // Every tenth is parallel to one of them and lies between all normals.
      Edge q = trial % 10 == 0 ? edges[draw.below(count)] : drawn_edge(draw);
      HullEdge other{{q.from.x, q.from.y, q.from.z},
                     {q.along.x, q.along.y, q.along.z},
                     {q.left.x, q.left.y, q.left.z},
                     {q.right.x, q.right.y, q.right.z}};
      std::vector<double> first;
      for (const Isa isa : testable_isas()) {
        INFO(name_of(isa) << ", " << count << " edges");
        std::vector<double> parted(froms.x.size());
        std::vector<std::uint8_t> crossings(froms.x.size());
        kernels_for(isa).hull.crossings(
            {froms.columns(), alongs.columns(), lefts.columns(), rights.columns()}, other, in_doubt,
            parallel, parted.data(), crossings.data());
        std::vector<double> of_crossed;
        for (std::size_t k = 0; k < count; ++k) {
          const Edge& p = edges[k];
          int expected = no_crossing;
          for (const auto& [sign, name] :
               {std::pair{1.0, along_product}, {-1.0, against_product}}) {
            if (sign * dot(q.along, p.left) >= -in_doubt &&
                sign * dot(q.along, p.right) <= in_doubt &&
                sign * dot(p.along, q.left) >= -in_doubt &&
                sign * dot(p.along, q.right) <= in_doubt) {
              expected |= name;
            }
          }
          REQUIRE(int{crossings[k]} == expected);
          if (expected == no_crossing) continue;
          ++crossed;
          of_crossed.push_back(parted[k]);
          const Vec n = cross(p.along, q.along);
          const double sine = std::sqrt(dot(n, n));
          if (sine < parallel) {
            CHECK(parted[k] == 0.0);
          } else {
            // A few roundings of lengths of 1, divided by the sine.
            CHECK(parted[k] == about(dot(n, minus(q.from, p.from)) / sine, 1e-14 / sine));
          }
        }
        if (first.empty()) first = of_crossed;
        CHECK(of_crossed == first);
      }
    }
  }
  CHECK(crossed > 100);
}

}  // namespace
}  // namespace grainsweep
