#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "engine/rows/polyhedron_contacts.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::periodic;
using testing::walls;

constexpr TouchSettings usual{0.05, 1e-3};

/// All contacts of a bed, and the candidates that they were found between.
struct Search {
  Candidates candidates;
  PolyhedronContacts<double> contacts;

  /// Whether candidates were listed anew.
  bool find(PolyhedronBed& bed) {
    const bool renewed = renew_candidates(usual.margin, 0.05, kernels(), bed, candidates);
    if (renewed) take_candidates(bed, candidates, contacts);
    find_contacts(usual, 1.0, bed, kernels(), contacts);
    return renewed;
  }
  const ContactList& found() const { return testing::part_of(contacts).found; }
};

/// Number of points of each contact.
using Found = std::map<std::pair<std::int32_t, std::int32_t>, std::size_t>;

Found names_of(const ContactList& found) {
  Found names;
  for (const PolyhedronContact& c : found.contacts) {
    REQUIRE(c.a < c.b);
    REQUIRE(names.emplace(std::pair(c.a, c.b), c.count).second);  // each once
  }
  return names;
}

/// Whether hulls are further apart than the margin though no axis parts them so far, as where a
/// vertex faces a vertex; pinacoids are not asked.
bool far_by_distance(const ShapePair& pair, double margin) {
  return !pair.a.pinacoid && closest_points(pair, testing::kernels().hull).distance > margin;
}

/// Every pair by all axes in f64, every grain and wall.
Found brute_force(const PolyhedronBed& bed, const TouchSettings& settings) {
  Found names;
  ClipColumns clip;
  std::vector<ContactPoint> points;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    for (std::size_t j = i + 1; j < bed.grains(); ++j) {
      const ShapePair pair = shape_pair(bed, i, j);
      if (far_by_distance(pair, settings.margin)) continue;
      const PairContact c =
          touch(pair, settings, separating_axes(pair, testing::kernels().hull), clip, points);
      if (c.count > 0) names[{static_cast<int>(i), static_cast<int>(j)}] = c.count;
    }
    for (std::size_t k = 0; k < bed.walls.size(); ++k) {
      std::size_t count = 0;
      for (const Vector& v : bed.shape(i).vertices) {
        const Vector x = bed.pose(i).centre + bed.scale(i) * (bed.pose(i).orientation * v);
        count += bed.walls[k].distance(x.x(), x.y(), x.z()) <= settings.margin ? 1 : 0;
      }
      if (count > 0) names[{static_cast<int>(i), bed.wall_name(k)}] = count;
    }
  }
  return names;
}

/// What one list has and the other has not, in words.
std::string difference(const Found& a, const Found& b) {
  std::ostringstream text;
  const auto list = [&](const Found& has, const Found& lacks, const char* name) {
    for (const auto& [pair, count] : has) {
      const auto other = lacks.find(pair);
      if (other != lacks.end() && other->second == count) continue;
      text << name << " " << pair.first << "-" << pair.second << ": " << count << " points; ";
    }
  };
  list(a, b, "found");
  list(b, a, "expected");
  return text.str();
}

TEST_CASE("contacts of a bed of shapes are those of all pairs and walls, no more and no less") {
  const ConvexShape hull = testing::hull_of(pinacoid({}).vertices);
  for (const ConvexShape& shape : {pinacoid({}), hull, testing::cube()}) {
    for (const Boundary y : {periodic, walls}) {
      PolyhedronBed bed = testing::random_shape_bed({6, 5, periodic, y}, shape, 150, 4, 11);
      Search search;
      CHECK(search.find(bed));
      REQUIRE(difference(names_of(search.found()), brute_force(bed, usual)) == "");
    }
  }
}

TEST_CASE("contacts stay complete while grains move and turn, with few searches") {
  PolyhedronBed bed = testing::random_shape_bed({6, 5, periodic, walls}, pinacoid({}), 100, 4, 3);
  testing::Draw draw(5);
  Search search;
  int searches = 0;
  for (int k = 0; k < 40; ++k) {
    searches += search.find(bed) ? 1 : 0;
    REQUIRE(difference(names_of(search.found()), brute_force(bed, usual)) == "");
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      move_grain(bed, i, 0.005 * testing::random_direction(draw),
                 0.3 * testing::random_direction(draw));
    }
  }
  CHECK(searches > 1);
  CHECK(searches < 20);
}

/// Share of the pairs listed that need no look where their grains are.
double share_far(const PolyhedronContacts<double>& contacts) {
  const std::vector<GrainPair>& pairs = contacts.subdomains.pairs;
  const FarPairs grains{contacts.travel.way, {}};
  double far = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    far += contacts.far_until[k] - grains.travel_of(pairs[k]) > usual.margin ? 1 : 0;
  }
  return far / static_cast<double>(pairs.size());
}

TEST_CASE("pairs found apart are not looked at until they may touch") {
  const ConvexShape long_one = pinacoid({.length = 2.0, .width = 1.0, .height = 0.3});
  for (const ConvexShape& shape : {long_one, testing::hull_of(long_one.vertices)}) {
    PolyhedronBed bed = testing::random_shape_bed({6, 5, periodic, walls}, shape, 60, 5, 3);
    testing::Draw draw(6);
    std::vector<Vector> course, spin;
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      course.push_back(0.02 * testing::random_direction(draw));
      spin.push_back(0.02 * testing::random_direction(draw));
    }
    Search search;
    for (int k = 0; k < 150; ++k) {
      search.find(bed);
      REQUIRE(difference(names_of(search.found()), brute_force(bed, usual)) == "");
      for (std::size_t i = 0; i < bed.grains(); ++i) move_grain(bed, i, course[i], spin[i]);
    }
    CHECK(share_far(search.contacts) > 0.4);
  }
}

TEST_CASE("two grains that part on one side may meet on the other of a narrow box") {
  const ConvexShape spike =
      testing::hull_of({{1.2, 0, 0}, {0, 0.3, 0}, {0, -0.2, 0.2}, {0, -0.2, -0.2}});
  const double least = 2.0 * (2.0 * spike.circumradius + 0.1);  // that such a box may have
  const Vector tip = *std::max_element(
      spike.vertices.begin(), spike.vertices.end(),
      [](const Vector& p, const Vector& q) { return p.squaredNorm() < q.squaredNorm(); });
  const auto pointed = [&](double x, double tip_x) {
    return testing::pose_at(x, 1, 2, Quaternion::FromTwoVectors(tip, Vector(tip_x, 0, 0)));
  };
  // Back to back, and tip to tip across the box.
  PolyhedronBed bed = testing::shape_bed({least, least, periodic, periodic}, spike,
                                         {pointed(least / 2, 1), pointed(0.05, -1)});
  Search search;
  std::size_t met = 0;
  for (int k = 0; k < 60; ++k) {
    search.find(bed);
    const Found expected = brute_force(bed, usual);
    REQUIRE(difference(names_of(search.found()), expected) == "");
    met += expected.size();
    move_grain(bed, 1, {-0.02, 0, 0}, Vector::Zero());
  }
  CHECK(met > 10);
}

TEST_CASE("grains that sank into each other tell how far, each by its own shape and size") {
  const std::vector<ConvexShape> shapes = {testing::cube(), testing::tetrahedron()};
  for (const bool is_cube_large : {false, true}) {
    const double of_cube = is_cube_large ? 2.0 : 1.0, of_other = is_cube_large ? 1.0 : 2.0;
    PolyhedronBed bed = make_bed({9, 9, periodic, walls}, shapes, {0, 1},
                                 {testing::pose_at(4, 4, 4, Quaternion::Identity(), of_cube),
                                  testing::pose_at(4.1, 4, 4, Quaternion::Identity(), of_other)});
    Search search;
    search.find(bed);
    const double sunk = find_contacts(usual, 1.0, bed, kernels(), search.contacts);
    const double inner = of_cube * shapes[0].inradius + of_other * shapes[1].inradius;
    CHECK(sunk == Approx(sunk_share * inner - 0.1).epsilon(1e-12));
  }
}

TEST_CASE("a pinacoid and the hull of its corners touch at the same points") {
  const ConvexShape shape = pinacoid({}), hull = testing::hull_of(shape.vertices);
  // At random no two axes are equally good, so that both choose the same.
  PolyhedronBed closed = testing::random_shape_bed({6, 5, periodic, walls}, shape, 120, 4, 2);
  PolyhedronBed open = closed;
  open.shapes = {hull};
  Search search_closed, search_open;
  search_closed.find(closed);
  search_open.find(open);
  const ContactList &a = search_closed.found(), &b = search_open.found();
  REQUIRE(a.contacts.size() == b.contacts.size());
  REQUIRE(a.contacts.size() > 300);
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    const PolyhedronContact &p = a.contacts[k], &q = b.contacts[k];
    REQUIRE((p.a == q.a && p.b == q.b && p.count == q.count));
    REQUIRE((p.normal - q.normal).norm() < 1e-9);
    for (std::size_t j = 0; j < p.count; ++j) {
      const Vector& x = a.points[p.first + j].position;
      const auto same = [&](const ContactPoint& point) {
        return (point.position - x).norm() < 1e-8;
      };
      const auto first = b.points.begin() + static_cast<std::ptrdiff_t>(q.first);
      REQUIRE(std::any_of(first, first + static_cast<std::ptrdiff_t>(q.count), same));
    }
  }
}

}  // namespace
}  // namespace grainsweep
