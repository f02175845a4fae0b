#include <array>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "engine/dynamics/step.hpp"
#include "engine/narrow/constraints.hpp"
#include "engine/rows/polyhedron_contacts.hpp"
#include "engine/shape/mixture.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

struct Scene {
  PolyhedronBed bed = testing::random_shape_bed({6, 5, periodic, walls}, pinacoid({}), 150, 4, 9);
  Candidates candidates;
  PolyhedronContacts<double> rows;

  Scene() {
    renew_candidates(0.05, 0.05, kernels_for(best_isa()), bed, candidates);
    take_candidates(bed, candidates, rows);
    find(0.05, 1.0);
  }
  void find(double margin, double correction) {
    find_contacts({margin, 1e-3}, correction, bed, kernels_for(best_isa()), rows);
  }
  const ContactList& found() const { return testing::part_of(rows).found; }
  std::size_t first(std::size_t k) const { return testing::part_of(rows).first[k]; }
  std::size_t lane(std::size_t k) const { return first(k) % block_width; }
  std::size_t point(std::size_t k, std::size_t j) const { return first(k) / block_width + j; }
  const BodyBlock<double>& block(std::size_t k) const {
    const std::size_t first = point(k, 0);
    for (const BodyBlock<double>& b : rows.blocks) {
      if (b.first == first) return b;
    }
    FAIL("no block begins at point " << first);
    return rows.blocks.front();
  }
};

TEST_CASE("no grain is twice in a block of rows with levers") {
  const Scene scene;
  for (const BodyBlock<double>& block : scene.rows.blocks) {
    std::set<std::int32_t> grains;
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      for (const std::int32_t name : {block.a(lane), block.b(lane)}) {
        if (scene.bed.is_grain(name)) REQUIRE(grains.insert(name).second);
      }
    }
  }
}

TEST_CASE("every point of every contact has a row of its own, all other rows are void") {
  const Scene scene;
  std::set<std::size_t> used;
  for (std::size_t k = 0; k < scene.found().contacts.size(); ++k) {
    const PolyhedronContact& c = scene.found().contacts[k];
    const BodyBlock<double>& block = scene.block(k);
    const std::int32_t side_b = scene.bed.is_grain(c.b) ? c.b : scene.bed.wall();
    REQUIRE((block.a(scene.lane(k)) == c.a && block.b(scene.lane(k)) == side_b));
    REQUIRE(c.count <= block.points);
    for (std::size_t j = 0; j < c.count; ++j) {
      REQUIRE(used.insert(scene.first(k) + j * block_width).second);
      REQUIRE(scene.rows.points[scene.point(k, j)].gap[scene.lane(k)] ==
              scene.found().points[c.first + j].gap);
    }
  }
  for (std::size_t at = 0; at < scene.rows.impulse.size(); ++at) {
    const BodyPoints<double>& points = scene.rows.points[at / block_width];
    const std::size_t lane = at % block_width;
    if (used.count(at) > 0) continue;
    REQUIRE(points.gap[lane] > 0);
    REQUIRE((points.lever_a[0][lane] == 0 && points.lever_b[2][lane] == 0));
  }
  // Contacts in a block have about as many points as one another: little is wasted on void rows.
  CHECK(used.size() * 2 > scene.rows.impulse.size());
}

/// A step from rest, solved to 1e-9 m g.
StepSettings solved_step() {
  StepSettings settings;
  settings.momentum = 0;
  settings.limits = {Solver::accelerated_gauss_seidel, 10'000, 1e-9};
  return settings;
}

TEST_CASE("a sphere that pushes a face holds the polyhedron's turns across the normal") {
  const auto shapes = shapes_of(Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}});
  PolyhedronBed bed = make_bed({6, 6, periodic, walls}, shapes, {0, 1},
                               {testing::pose_at(3, 3, 0.5), testing::pose_at(3.1, 3.2, 1.5)});
  StepState<Polyhedron, double> state;
  const StepSettings settings = solved_step();
  step(settings, kernels_for(best_isa()), bed, state);
  const Vector own = bed.root_inertia[0].cwiseAbs2();
  hold_turning(state.contacts, serial_for, bed);
  const double weight = bed.shapes[1].volume;  // of the sphere, m g: the cube has mass 1
  const Vector added = bed.root_inertia[0].cwiseAbs2() - own;
  // By the force times dt^2 times the distance of the centres along the normal.
  const double dt2 = settings.dt * settings.dt;
  CHECK(added.x() == Approx(weight * dt2).epsilon(1e-6));
  CHECK(added.y() == Approx(weight * dt2).epsilon(1e-6));
  CHECK(std::abs(added.z()) < 1e-12);
  CHECK(bed.root_inertia[1].cwiseAbs2().isApprox(Vector(0.1, 0.1, 0.1) * weight));
  hold_turning(state.contacts, serial_for, bed);  // nothing adds up
  CHECK((bed.root_inertia[0].cwiseAbs2() - own).isApprox(added));
}

/// What a step adds to the moments of two cubes, the upper one turned so that it touches the lower
/// one below its centre, in its weight times dt^2.
struct HeldCubes {
  PolyhedronBed bed;
  Vector lower, upper;

  HeldCubes(const Quaternion& of_lower, double height_of_lower, const Quaternion& of_upper,
            double height_of_upper)
      : bed(testing::shape_bed({6, 6, periodic, walls}, testing::cube(),
                               {testing::pose_at(3, 3, height_of_lower, of_lower),
                                testing::pose_at(3, 3, height_of_upper, of_upper)})) {
    StepState<Polyhedron, double> state;
    const StepSettings settings = solved_step();
    step(settings, kernels_for(best_isa()), bed, state);
    const double dt2 = settings.dt * settings.dt;
    const auto own = [&](std::size_t k) { return principal_moments(bed, k); };
    hold_turning(state.contacts, serial_for, bed);
    lower = (bed.root_inertia[0].cwiseAbs2() - own(0)) / dt2;
    upper = (bed.root_inertia[1].cwiseAbs2() - own(1)) / dt2;
  }
};

TEST_CASE("a corner on a face holds the face's grain by its weight times the height of the face") {
  const Quaternion on_corner =
      Quaternion::FromTwoVectors(Vector(1, 1, 1).normalized(), Vector::UnitZ());
  const HeldCubes cubes(Quaternion::Identity(), 0.5, on_corner, 1.0 + std::sqrt(0.75));
  CHECK(cubes.lower.isApprox(Vector(0.5, 0.5, 0.0), 1e-6));
  CHECK(cubes.upper.norm() < 1e-6);
}

TEST_CASE("edges that cross hold both grains, each about the other one's edge") {
  const Quaternion edge_along_x(Eigen::AngleAxisd(0.25 * pi, Vector::UnitX()));
  const Quaternion edge_along_y(Eigen::AngleAxisd(0.25 * pi, Vector::UnitY()));
  const double height = std::sqrt(0.5);  // of an edge over the centre
  const HeldCubes cubes(edge_along_x, height, edge_along_y, 3.0 * height);
  // Each turns about the other one's edge: seen from the upper cube, which is turned about y,
  // that of the lower one along x lies between its axes x and z.
  CHECK(cubes.lower.isApprox(height * Vector(0.0, 0.5, 0.5), 1e-6));
  CHECK(cubes.upper.isApprox(height * Vector(0.5, 0.0, 0.5), 1e-6));
}

TEST_CASE("faces on one another hold both grains, and the floor holds none") {
  const HeldCubes cubes(Quaternion::Identity(), 0.5, Quaternion::Identity(), 1.5);
  // Which face counts as that of the contact is a matter of rounding.
  const Vector both = cubes.lower + cubes.upper;
  CHECK(both.isApprox(Vector(0.5, 0.5, 0.0), 1e-6));
}

/// Where a point fixed to a grain goes when the grain moves by its part of a motion.
Vector moved(const PolyhedronBed& bed, std::size_t grain, const Vector& from_centre,
             const Vector& v, const Vector& angles) {
  const Quaternion q = bed.pose(grain).orientation;
  const Vector body = q.conjugate() * from_centre;
  const double angle = angles.norm();
  return v + q * (Eigen::AngleAxisd(angle, angles / angle) * body) - from_centre;
}

/// What hold_turning adds to the moments of two grains after a step, over dt^2.
std::array<Vector, 2> held_by_a_step(PolyhedronBed bed) {
  StepState<Polyhedron, double> state;
  const StepSettings settings = solved_step();
  step(settings, kernels_for(best_isa()), bed, state);
  hold_turning(state.contacts, serial_for, bed);
  const auto added = [&](std::size_t k) {
    return Vector((bed.root_inertia[k].cwiseAbs2() - principal_moments(bed, k)) /
                  (settings.dt * settings.dt));
  };
  return {added(0), added(1)};
}

TEST_CASE("each grain is held by the height of its own side of the contact, whichever is listed") {
  const Box box{9, 9, periodic, walls};
  const Quaternion on_corner =
      Quaternion::FromTwoVectors(Vector(1, 1, 1).normalized(), Vector::UnitZ());
  const auto [corner, face] = held_by_a_step(testing::shape_bed(
      box, testing::cube(),
      {testing::pose_at(3, 3, 1.0 + std::sqrt(0.75), on_corner), testing::pose_at(3, 3, 0.5)}));
  CHECK(face.isApprox(Vector(0.5, 0.5, 0.0), 1e-6));
  CHECK(corner.norm() < 1e-6);
  // The upper cube is twice as large, and weighs 8.
  const Quaternion edge_along_x(Eigen::AngleAxisd(0.25 * pi, Vector::UnitX()));
  const Quaternion edge_along_y(Eigen::AngleAxisd(0.25 * pi, Vector::UnitY()));
  const double height = std::sqrt(0.5);
  const auto [lower, upper] =
      held_by_a_step(testing::shape_bed(box, testing::cube(),
                                        {testing::pose_at(4, 4, height, edge_along_x),
                                         testing::pose_at(4, 4, 4.0 * height, edge_along_y, 2.0)}));
  CHECK(lower.isApprox(8.0 * height * Vector(0.0, 0.5, 0.5), 1e-6));
  CHECK(upper.isApprox(16.0 * height * Vector(0.5, 0.0, 0.5), 1e-6));
}

TEST_CASE("a sphere on a face, an edge or a corner says how many turns of the grain it holds") {
  const auto shapes = shapes_of(Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}});
  const Quaternion on_edge(Eigen::AngleAxisd(0.25 * pi, Vector::UnitX()));
  const Quaternion on_corner =
      Quaternion::FromTwoVectors(Vector(1, 1, 1).normalized(), Vector::UnitZ());
  struct Place {
    Quaternion turn;
    double height;  // of the cube's centre above the floor
    int by_turning;
  };
  for (const Place& place :
       {Place{Quaternion::Identity(), 0.5, 2}, Place{on_edge, std::sqrt(0.5), 1},
        Place{on_corner, std::sqrt(0.75), 0}}) {
    PolyhedronBed bed = make_bed({6, 6, periodic, walls}, shapes, {0, 1},
                                 {testing::pose_at(3, 3, place.height, place.turn),
                                  testing::pose_at(3, 3, 2 * place.height + 0.5)});
    StepState<Polyhedron, double> state;
    const StepSettings settings = solved_step();
    const ExecutionContext context = kernels_for(best_isa());
    step(settings, context, bed, state);
    const auto bearing = force_contacts(bed, settings.dt, state.contacts);
    const auto all = closures(bed, context, settings.dt, state.candidates, state.contacts);
    REQUIRE(all.size() == bearing.size());
    int pairs = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!bed.is_grain(bearing[k].b)) continue;
      ++pairs;
      CHECK(all[k].by_turning == place.by_turning);
      CHECK(all[k].constraints == 1);
    }
    CHECK(pairs == 1);
  }
}

// With a step so long that faces are preferred far beyond the best axis.
TEST_CASE(
    "a closed contact is as deep as its grains overlap, and of the kind that it has as such") {
  Scene scene;
  scene.rows.impulse.assign(scene.rows.impulse.size(), 0.0);
  for (std::size_t k = 0; k < scene.found().contacts.size(); ++k) {
    scene.rows.impulse[scene.first(k)] = 1.0;
  }
  const double dt = 0.2;
  const TouchSettings shallow{closed_gap, touch_settings(closed_gap, dt * dt).preference, 0.0};
  const auto bearing = force_contacts(scene.bed, dt, scene.rows);
  const auto all = closures(scene.bed, kernels_for(best_isa()), dt, scene.candidates, scene.rows);
  REQUIRE(all.size() == bearing.size());
  int closed = 0, on_faces = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!scene.bed.is_grain(bearing[k].b)) continue;
    const ShapePair pair = shape_pair(scene.bed, static_cast<std::size_t>(bearing[k].a),
                                      static_cast<std::size_t>(bearing[k].b));
    const ContactAxes axes = separating_axes(pair, testing::kernels().hull);
    ClipColumns columns;
    std::vector<ContactPoint> points;
    const PairContact contact = touch(pair, shallow, axes, columns, points);
    if (contact.count == 0) continue;
    ++closed;
    on_faces += contact.separation < axes.separation() - 1e-9 ? 1 : 0;
    CHECK(all[k].gap >= axes.separation() - 1e-12);
    CHECK(all[k].constraints == constraints_of(points.data(), points.size(), closed_gap));
  }
  CHECK(closed > 50);
  CHECK(on_faces > 5);
}

TEST_CASE("the steps of a scene prefer faces by a ten-thousandth at least, more in long ones") {
  CHECK(touch_settings(0.05, 1e-6).preference == 1e-4);
  CHECK(touch_settings(0.05, 0.01).preference == Approx(0.5 * 0.01));
}

TEST_CASE("a grain that sleeps is neither moved nor turned by its rows") {
  Scene scene;
  const std::size_t sleeper = static_cast<std::size_t>(scene.found().contacts[3].a);
  scene.bed.asleep.assign(scene.bed.grains(), 0);
  scene.bed.asleep[sleeper] = 1;
  scene.find(0.05, 1.0);
  int rows = 0;
  for (std::size_t k = 0; k < scene.found().contacts.size(); ++k) {
    const PolyhedronContact& c = scene.found().contacts[k];
    const bool is_a = static_cast<std::size_t>(c.a) == sleeper;
    const bool is_b = static_cast<std::size_t>(c.b) == sleeper;
    if (!is_a && !is_b) continue;
    for (std::size_t j = 0; j < c.count; ++j) {
      const BodyPoints<double>& points = scene.rows.points[scene.point(k, j)];
      for (int x = 0; x < 3; ++x) {
        const auto& lever = is_a ? points.lever_a : points.lever_b;
        CHECK(lever[x][scene.lane(k)] == 0.0);
      }
      ++rows;
    }
  }
  CHECK(rows > 0);
}

TEST_CASE("rows say how gaps change when grains move and turn") {
  const Scene scene;
  testing::Draw draw(2);
  constexpr double size = 1e-6;
  std::vector<Vector> v, angles;
  for (std::size_t i = 0; i < scene.bed.grains(); ++i) {
    v.push_back(size * testing::random_direction(draw));
    angles.push_back(size * testing::random_direction(draw));
  }
  for (std::size_t k = 0; k < scene.found().contacts.size(); ++k) {
    const PolyhedronContact& c = scene.found().contacts[k];
    const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
    const bool of_wall = !scene.bed.is_grain(c.b);
    const Quaternion turn = scene.bed.pose(a).orientation;
    const Vector n = turn * c.normal;
    const BodyBlock<double>& block = scene.block(k);
    const std::size_t lane = scene.lane(k);
    REQUIRE((Vector(block.normal_x[lane], block.normal_y[lane], block.normal_z[lane]) - n).norm() <
            1e-15);
    for (std::size_t j = 0; j < c.count; ++j) {
      const Vector r = turn * scene.found().points[c.first + j].position;
      const Vector way_a = moved(scene.bed, a, r, v[a], angles[a]);
      const Vector way_b =
          of_wall ? Vector(Vector::Zero())
                  : moved(scene.bed, b, r - nearest_difference(scene.bed, a, b), v[b], angles[b]);
      const BodyPoints<double>& points = scene.rows.points[scene.point(k, j)];
      double change = n.dot((of_wall ? Vector(Vector::Zero()) : v[b]) - v[a]);
      for (int x = 0; x < 3; ++x) {
        change -= points.lever_a[x][lane] * scene.bed.root_inertia[a][x] * angles[a][x];
        if (of_wall) continue;
        change += points.lever_b[x][lane] * scene.bed.root_inertia[b][x] * angles[b][x];
      }
      REQUIRE(change == about(n.dot(way_b - way_a), 4 * size * size));  // second order
    }
  }
}

TEST_CASE("the mass of a row is what one impulse on it meets") {
  const Scene scene;
  for (std::size_t k = 0; k < scene.found().contacts.size(); ++k) {
    const PolyhedronContact& c = scene.found().contacts[k];
    const std::size_t lane = scene.lane(k);
    double inverse_masses = scene.bed.motion[static_cast<std::size_t>(c.a)].w;
    if (scene.bed.is_grain(c.b)) {
      inverse_masses += scene.bed.motion[static_cast<std::size_t>(c.b)].w;
    }
    for (std::size_t i = 0; i < c.count; ++i) {
      const BodyPoints<double>& p = scene.rows.points[scene.point(k, i)];
      double diagonal = inverse_masses;
      for (int x = 0; x < 3; ++x) {
        diagonal += p.lever_a[x][lane] * p.lever_a[x][lane];
        diagonal += p.lever_b[x][lane] * p.lever_b[x][lane];
      }
      REQUIRE(p.reduced_mass[lane] * diagonal == Approx(1));
    }
  }
}

TEST_CASE("an overlap is repaired by the share asked for, a gap is left as it is, of shapes too") {
  Scene scene;
  scene.find(0.05, 0.25);
  for (std::size_t k = 0; k < scene.found().contacts.size(); ++k) {
    for (std::size_t j = 0; j < scene.found().contacts[k].count; ++j) {
      const double gap = scene.found().points[scene.found().contacts[k].first + j].gap;
      REQUIRE(scene.rows.points[scene.point(k, j)].gap[scene.lane(k)] ==
              (gap < 0 ? 0.25 * gap : gap));
    }
  }
}

double sum_of(const std::vector<double>& impulse) {
  double sum = 0;
  for (const double p : impulse) sum += p;
  return sum;
}

TEST_CASE("impulses come back to their points, and those of contacts that are gone are dropped") {
  Scene scene;
  testing::Draw draw(8);
  double kept = 0;
  for (std::size_t k = 0; k < scene.found().contacts.size(); ++k) {
    const PolyhedronContact& c = scene.found().contacts[k];
    for (std::size_t j = 0; j < c.count; ++j) {
      scene.rows.impulse[scene.first(k) + j * block_width] = draw.unit();
    }
  }
  const std::vector<double> before = scene.rows.impulse;
  const ContactList all = scene.found();
  scene.find(0.05, 1.0);
  CHECK(scene.rows.impulse == before);

  // Within a smaller margin some contacts are gone and others have fewer points, which take all.
  const Scene wide = scene;
  scene.find(0.01, 1.0);
  REQUIRE(scene.found().contacts.size() < all.contacts.size());
  REQUIRE(scene.found().points.size() < all.points.size());
  std::size_t k = 0;
  for (const PolyhedronContact& c : scene.found().contacts) {
    while (all.contacts[k].a != c.a || all.contacts[k].b != c.b) ++k;
    for (std::size_t j = 0; j < all.contacts[k].count; ++j) {
      kept += before[wide.first(k) + j * block_width];
    }
  }
  CHECK(sum_of(scene.rows.impulse) == Approx(kept));
}

}  // namespace
}  // namespace grainsweep
