// Separating axes in closed form, those of hulls against the exact search over all of them, and the
// batch test of pinacoids against the f64 one; test_gjk.cpp holds all against brute force in long
// double. GRAINSWEEP_PAIRS multiplies the pairs of the slow test: 100 is the full test of a
// million pairs.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/narrow/manifold.hpp"
#include "tests/support/about.hpp"
#include "tests/support/all_axes.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_pairs.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::PairFamily;

/// Of a grain of radius 1, whose scale is 2.
PinacoidHalves halves_of(const ConvexShape& shape) {
  const PinacoidHalves& w = *shape.pinacoid;
  return {2 * w.a, 2 * w.b, 2 * w.c, 2 * w.e};
}

Record<double> record(const Quaternion& q) { return {q.x(), q.y(), q.z(), q.w()}; }

/// Grains 2 k and 2 k + 1 of the columns are pair k.
struct Batch {
  std::vector<Record<double>> centres, orientations;
  std::vector<PinacoidBlock> blocks;

  ShapePair pair(const ConvexShape& shape, std::size_t k) const {
    const Pose a = pose_of(centres[2 * k], orientations[2 * k]);
    const Pose b = pose_of(centres[2 * k + 1], orientations[2 * k + 1]);
    return {shape, shape, seen_from_a(a, b, b.centre - a.centre)};
  }
  std::size_t pairs() const { return centres.size() / 2; }
};

/// Both grains turned at random, at about `place`.
Batch batch_of(PairFamily family, const ConvexShape& shape, std::size_t blocks, Draw& draw,
               const Vector& place) {
  Batch batch;
  for (std::size_t k = 0; k < blocks * block_width; ++k) {
    const PairPose pose = testing::pose_of_family(family, draw, shape, shape);
    const Quaternion a = testing::random_rotation(draw);
    const Quaternion b = (a * Quaternion(pose.turn)).normalized();
    const Vector centre = place + a * pose.centre;
    batch.centres.push_back({place.x(), place.y(), place.z(), 0.5 * pose.scale_a});
    batch.centres.push_back({centre.x(), centre.y(), centre.z(), 0.5 * pose.scale_b});
    batch.orientations.push_back(record(a));
    batch.orientations.push_back(record(b));
  }
  batch.blocks.resize(blocks);
  for (std::size_t k = 0; k < batch.pairs(); ++k) {
    const auto a = static_cast<std::int32_t>(2 * k);
    batch.blocks[k / block_width].set_grains(k % block_width, a, a + 1);
  }
  return batch;
}

void test(const ConvexShape& shape, Isa isa, Batch& batch, double period = 0) {
  kernels_for(isa).pinacoid_axes(halves_of(shape), halves_of(shape), batch.blocks.data(),
                                 batch.blocks.size(), batch.centres.data(),
                                 batch.orientations.data(), period, period);
}

// pinacoid_rounding is what the header promises; after the f64 measurement it is the most by which
// two axes that f32 confuses can differ.
TEST_CASE("the batch test finds the separation of the f64 test within its rounding", "[slow]") {
  const ConvexShape shape = pinacoid({}), plate = pinacoid({1, 1, 0.01, 0.3});
  for (const PairFamily family : testing::all_pair_families) {
    const ConvexShape& used = family == PairFamily::flat ? plate : shape;
    Draw draw(31 + static_cast<std::uint64_t>(family));
    Batch batch = batch_of(family, used, 200, draw, {3, -4, 5});
    test(used, best_isa(), batch);
    double worst_batch = 0, worst_chosen = 0;
    std::size_t parallel = 0;
    for (std::size_t k = 0; k < batch.pairs(); ++k) {
      INFO(testing::name_of(family) << " " << k);
      const ShapePair pair = batch.pair(used, k);
      const PinacoidBlock& block = batch.blocks[k / block_width];
      const std::size_t lane = k % block_width;
      const ContactAxes exact = separating_axes(pair, testing::kernels().hull),
                        chosen = separating_axes(pair, block, lane);
      const double found = std::max(block.face_separation[lane], block.edge_separation[lane]);
      const double over = found - exact.separation();
      REQUIRE(over < pinacoid_rounding);
      REQUIRE(std::abs(block.face_separation[lane] - exact.face.separation) < pinacoid_rounding);
      REQUIRE(chosen.separation() <= exact.separation());
      worst_chosen = std::max(worst_chosen, exact.separation() - chosen.separation());
      worst_batch = std::max(worst_batch, over);
      if (block.edges_parallel[lane] != 0) {
        ++parallel;
        continue;
      }
      REQUIRE(-over < pinacoid_rounding);
      worst_batch = std::max(worst_batch, -over);
    }
    REQUIRE(worst_chosen < pinacoid_rounding);
    INFO(testing::name_of(family) << ": batch within " << worst_batch << " d, chosen axes within "
                                  << worst_chosen << " d");
    CAPTURE(parallel, batch.pairs());
    if (family == PairFamily::random) CHECK(parallel < batch.pairs() / 12);  // 131 of 3200 have
  }
}

TEST_CASE("a pair that the batch parts is apart, one that it does not part is near") {
  const auto [size, least_parted] =
      GENERATE(std::pair(PinacoidSize{}, 1000), std::pair(PinacoidSize{12, 1, 0.1}, 900));
  const ConvexShape shape = pinacoid(size);
  const double reach = std::max(1.1, 1.1 * shape.circumradius);  // no grain is larger than 1.1
  CAPTURE(size.length);
  Draw draw(41);
  Batch batch = batch_of(PairFamily::random, shape, 200, draw, {0, 0, 0});
  test(shape, best_isa(), batch);
  int parted = 0;
  for (std::size_t k = 0; k < batch.pairs(); ++k) {
    const ShapePair pair = batch.pair(shape, k);
    const bool apart = parted_by(batch.blocks[k / block_width], k % block_width, reach) > 0.05;
    const double separation = separating_axes(pair, testing::kernels().hull).separation();
    parted += apart ? 1 : 0;
    if (apart) REQUIRE(separation > 0.05);
    if (!apart && batch.blocks[k / block_width].edges_parallel[k % block_width] == 0) {
      REQUIRE(separation < 0.05 + 1e-4 * reach);
    }
  }
  CHECK(parted > least_parted);  // of 3200
}

TEST_CASE("all instruction sets give the same bits for pairs of pinacoids") {
  const ConvexShape shape = pinacoid({});
  for (const PairFamily family : testing::all_pair_families) {
    Draw draw(51);
    Batch first = batch_of(family, shape, 20, draw, {1, 2, 3});
    test(shape, Isa::sse2, first, 20);
    for (const Isa isa : testing::testable_isas()) {
      INFO(name_of(isa) << ", " << testing::name_of(family));
      Batch other = first;
      test(shape, isa, other, 20);
      REQUIRE(testing::same_bits(first.blocks, other.blocks));
    }
  }
}

TEST_CASE("the batch test sees the nearest image and offsets of a million d") {
  const ConvexShape shape = pinacoid({});
  Draw draw(61);
  Batch batch = batch_of(PairFamily::random, shape, 10, draw, {2, 2, 2});
  test(shape, best_isa(), batch);
  Batch moved = batch, far = batch;
  for (std::size_t k = 0; k < batch.pairs(); ++k) {
    moved.centres[2 * k + 1].x += 16;
    moved.centres[2 * k + 1].y -= 32;
  }
  for (Record<double>& centre : far.centres) centre.z += 0x1p20;
  test(shape, best_isa(), moved, 16);
  test(shape, best_isa(), far);
  for (std::size_t k = 0; k < batch.pairs(); ++k) {
    const PinacoidBlock &here = batch.blocks[k / block_width],
                        &image = moved.blocks[k / block_width];
    const std::size_t lane = k % block_width;
    // Adding 16 or 2^20 and taking it away again rounds a coordinate by 4e-15 or 2e-10.
    CHECK(image.face_separation[lane] == about(here.face_separation[lane], 1e-6));
    CHECK(far.blocks[k / block_width].face_separation[lane] ==
          about(here.face_separation[lane], 1e-6));
  }
}

TEST_CASE("upright pinacoids side by side are parted by exact numbers") {
  const ConvexShape shape = pinacoid({1.5, 1, 0.5, 1});
  Batch batch;
  batch.centres = {{0, 0, 0, 0.5}, {0, 0, 0.75, 0.5}, {0, 0, 0, 1}, {0, 0, 0.75, 0.5}};
  batch.orientations.assign(4, {0, 0, 0, 1});
  batch.blocks.resize(1);
  for (std::size_t lane = 0; lane < block_width; ++lane) {
    batch.blocks[0].set_grains(lane, lane < 8 ? 0 : 2, lane < 8 ? 1 : 3);
  }
  test(shape, best_isa(), batch);
  // Ridge on ridge: .25 along z, which no face axis shows, but crossed edges x and y do.
  CHECK(batch.blocks[0].edge_separation[0] == about(0.25, 1e-6));
  CHECK(batch.blocks[0].edge_separation[15] == Approx(0.0).margin(1e-6));
  CHECK((batch.blocks[0].edge_axis[0] == 8 + 5 || batch.blocks[0].edge_axis[0] == 8 + 30));
  CHECK(batch.blocks[0].edges_parallel[0] == 1);
}

// Apart, they are compared over all axes, of a hull over the normals of the shapes' difference.
TEST_CASE("the axes of a pinacoid in closed form are those of its hull") {
  const ConvexShape closed = pinacoid({}), hull = testing::hull_of(closed.vertices);
  Draw draw(6);
  for (const PairFamily family : testing::all_pair_families) {
    for (int k = 0; k < 300; ++k) {
      const PairPose pose = testing::pose_of_family(family, draw, closed, closed);
      const double first =
          separating_axes({closed, closed, pose}, testing::kernels().hull).separation();
      const double second =
          separating_axes({hull, hull, pose}, testing::kernels().hull).separation();
      if (first <= 0) REQUIRE(first == about(second, 1e-12));
      if (first > 1e-12) REQUIRE((second > 0 && second <= first + 1e-12));
    }
  }
}

TEST_CASE("the axis of a pair points from a to b and gives its separation") {
  const ConvexShape shape = pinacoid({});
  Draw draw(7);
  for (int k = 0; k < 500; ++k) {
    const ShapePair pair{shape, shape, testing::random_pose(draw, 0.6, 1.3)};
    const ContactAxes axes = separating_axes(pair, testing::kernels().hull);
    for (const ContactAxis& axis : {axes.face, axes.edges}) {
      if (axis.kind == AxisKind::none) continue;
      CHECK(axis.normal.norm() == Approx(1).epsilon(1e-15));
      CHECK(axis.normal.dot(pair.pose.centre) > 0);
      CHECK(separation_along(pair, axis.normal) == about(axis.separation, 1e-15));
    }
    const bool of_a = axes.face.kind == AxisKind::face_of_a;
    const Vector outward = of_a ? shape.faces[axes.face.a].normal
                                : Vector(-(pair.pose.turn * shape.faces[axes.face.b].normal));
    CHECK((outward - axes.face.normal).norm() < 1e-15);
    if (axes.edges.kind == AxisKind::none) continue;
    CHECK(axes.edges.separation > axes.face.separation);
    const Vector u = shape.edge_directions[axes.edges.a];
    const Vector v = pair.pose.turn * shape.edge_directions[axes.edges.b];
    CHECK(std::abs(axes.edges.normal.dot(u)) < 1e-15);
    CHECK(std::abs(axes.edges.normal.dot(v)) < 1e-15);
  }
}

/// The shapes that a packing is expected to be made of.
std::vector<ConvexShape> usual_shapes() {
  Draw draw(71);
  std::vector<ConvexShape> shapes = {testing::tetrahedron(),        testing::cube(),
                                     testing::octahedron(),         testing::dodecahedron(),
                                     testing::icosahedron(),        testing::box_shape(1, 0.7, 0.4),
                                     testing::box_shape(1, 1, 0.1), testing::box_shape(1, 0.1, 0.1),
                                     testing::prism(24, 0.1),       testing::prism(6, 5)};
  for (const int sides : {3, 5, 8, 16, 32}) shapes.push_back(testing::prism(sides, 0.8));
  for (const int corners : {9, 20}) {
    shapes.push_back(testing::hull_of(testing::random_corners(draw, corners)));
  }
  for (const PinacoidSize& size :
       {PinacoidSize{}, {2, 1, 0.3}, {3, 1, 1}, {1, 1, 0.2}, {1, 1, 0.01, 0.3}}) {
    shapes.push_back(testing::hull_of(pinacoid(size).vertices));
  }
  return shapes;
}

/// The frame of b along that of a to quarter turns, b's centre straight beyond that of a: faces,
/// edges and corners lie exactly on each other.
PairPose aligned_pose(Draw& draw, const ConvexShape& a, const ConvexShape& b) {
  PairPose pose;
  for (int k = 0; k < 3; ++k) {
    const Vector axis = Vector::Unit(static_cast<Eigen::Index>(draw.below(3)));
    const Quaternion quarter(Eigen::AngleAxisd(0.5 * 3.14159265358979323846, axis));
    pose.turn = pose.turn * quarter.toRotationMatrix().array().round().matrix();
  }
  const Vector n = draw.chance(0.5) ? a.faces[draw.below(a.faces.size())].normal
                                    : a.vertices[draw.below(a.vertices.size())].normalized();
  const double reach = reach_along(a, n) + reach_along(b, -(pose.turn.transpose() * n));
  const double gaps[] = {0.0, 1e-3, -1e-3, -0.1};
  pose.centre = (reach + gaps[draw.below(4)]) * n;
  return pose;
}

// Axes as good as the best one may differ from it: what is found must part the pair as far as it
// says, and overlapping ones as far as the exact search does. 1e-12 d is what is promised of the
// axes.
void check_axes(const ShapePair& pair) {
  const ContactAxes exact = testing::all_axes(pair),
                    found = separating_axes(pair, testing::kernels().hull);
  REQUIRE(found.face.separation == about(exact.face.separation, 1e-14));
  for (const ContactAxis& axis : {found.face, found.edges}) {
    if (axis.kind == AxisKind::none) continue;
    REQUIRE(separation_along(pair, axis.normal) == about(axis.separation, 1e-14));
  }
  if (exact.separation() <= 0) REQUIRE(found.separation() >= exact.separation() - 1e-12);
  if (exact.separation() > 1e-12) REQUIRE(found.separation() > 0);
}

/// Overlapping pairs, and those no further apart than the margin, must have a contact.
bool check_contact(const ShapePair& pair) {
  constexpr double margin = 0.05;
  PairMemory memory;
  TouchColumns columns;
  std::vector<ContactPoint> points;
  const bool touches = touch(pair, {margin, 0}, memory, columns, points).count > 0;
  const bool near = closest_points(pair, testing::kernels().hull).distance <= margin;
  REQUIRE(touches == near);
  return touches;
}

/// How far along `n` the edges of that direction lie that reach farthest with both ends, in the
/// frame of the shape, d.
double reach_of_edges(const ConvexShape& shape, std::int32_t direction, const Vector& n) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const Edge& edge : shape.edges) {
    if (edge.direction != direction) continue;
    const double ends = std::min(n.dot(shape.vertices[static_cast<std::size_t>(edge.from)]),
                                 n.dot(shape.vertices[static_cast<std::size_t>(edge.to)]));
    reach = std::max(reach, ends);
  }
  return reach;
}

// Else a contact would lie where the edges do not.
TEST_CASE("the edges that part two hulls are the outermost of both along their axis") {
  Draw draw(73);
  int parted = 0;
  for (int n = 0; n < 2000; ++n) {
    const ConvexShape a = testing::tetrahedron(), b = testing::octahedron();
    const ShapePair pair{a, b, testing::pose_of_family(testing::PairFamily::random, draw, a, b)};
    const ContactAxis axis = separating_axes(pair, testing::kernels().hull).edges;
    if (axis.kind == AxisKind::none) continue;
    ++parted;
    const Vector from_b = -(pair.pose.turn.transpose() * axis.normal);
    // 1e-9 d: edges that nearly lie along each other cross where rounding says.
    CHECK(reach_of_edges(a, axis.a, axis.normal) == about(reach_along(a, axis.normal), 1e-9));
    CHECK(reach_of_edges(b, axis.b, from_b) == about(reach_along(b, from_b), 1e-9));
  }
  CHECK(parted > 200);
}

/// That many of each shape and family.
void check_pairs_of_usual_shapes(int of_each) {
  const std::vector<ConvexShape> shapes = usual_shapes();
  const std::size_t families = testing::all_pair_families.size() + 1;
  Draw draw(72);
  int pairs = 0, contacts = 0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    for (std::size_t f = 0; f < families; ++f) {
      for (int n = 0; n < of_each; ++n, ++pairs) {
        const ConvexShape &a = shapes[k], &b = n % 5 == 0 ? shapes[draw.below(shapes.size())] : a;
        const PairPose pose =
            f == 0 ? aligned_pose(draw, a, b)
                   : testing::pose_of_family(testing::all_pair_families[f - 1], draw, a, b);
        INFO("shape " << k << ", family " << f << ", pair " << n);
        check_axes({a, b, pose});
        contacts += check_contact({a, b, pose}) ? 1 : 0;
      }
    }
  }
  if (std::getenv("GRAINSWEEP_PAIRS") != nullptr) WARN(pairs << " pairs, " << contacts << " touch");
  CHECK(contacts > pairs / 3);
}

TEST_CASE("hulls are parted as far as the exact search finds, and none that touch are missed") {
  check_pairs_of_usual_shapes(testing::tries(6));
}

TEST_CASE("many more hulls are parted so, and none that touch are missed", "[slow]") {
  const char* factor = std::getenv("GRAINSWEEP_PAIRS");
  check_pairs_of_usual_shapes(50 * (factor != nullptr ? std::atoi(factor) : 1));
}

int searches = 0;

TEST_CASE("the axes of hulls are found by the kernels that are given") {
  HullKernels counting = testing::kernels().hull;
  counting.farthest = [](const PointColumns& points, const double* n, double* reach) {
    ++searches;
    return testing::kernels().hull.farthest(points, n, reach);
  };
  const ConvexShape cube = testing::cube();
  const ShapePair pair{cube, cube, {{0, 0, 1.25}, Matrix::Identity(), 1.0, 1.0}};
  CHECK(separating_axes(pair, counting).separation() == 0.25);
  CHECK(searches > 0);
}

}  // namespace
}  // namespace grainsweep
