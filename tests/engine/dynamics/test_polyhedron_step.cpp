#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/dynamics/step.hpp"
#include "engine/scene/start.hpp"
#include "tests/support/about.hpp"
#include "tests/support/dense_bodies.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_beds.hpp"
#include "tests/support/solvers.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::periodic;
using testing::pose_at;
using testing::shape_bed;
using testing::walls;

/// Steps that repair overlaps whole and are solved to 1e-9 m g.
StepSettings tight_steps(double momentum) {
  StepSettings settings;
  settings.momentum = momentum;
  settings.correction = 1.0;
  settings.limits = {Solver::accelerated_gauss_seidel, 100'000, 1e-9};
  return settings;
}

template <class Real>
StepReport take_steps(int steps, const StepSettings& settings, PolyhedronBed& bed,
                      StepState<Polyhedron, Real>& state) {
  StepReport report;
  for (int k = 0; k < steps; ++k) report = step(settings, kernels(), bed, state);
  return report;
}

// Of four forces three are determined: they carry the cube and do not turn it.
TEMPLATE_TEST_CASE("a cube on the floor rests on four corners that carry and do not turn it", "",
                   float, double) {
  // Solved to 1e-9 m g; f32 rounds at 1e-7 of the motions.
  const double margin = std::is_same_v<TestType, float> ? 1e-5 : 1e-8;
  PolyhedronBed bed = shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.5)});
  StepState<Polyhedron, TestType> state;
  StepSettings settings = tight_steps(0);
  settings.limits.iterations = 2000;
  take_steps(3, settings, bed, state);
  REQUIRE(testing::list_of(state).contacts.size() == 1);
  REQUIRE(testing::list_of(state).contacts[0].count == 4);
  CHECK(testing::list_of(state).contacts[0].b == bed.wall_name(0));
  double force = 0.0;
  Vector torque = Vector::Zero();
  for (std::size_t j = 0; j < 4; ++j) {
    const double push = testing::impulse_of(state, 0, j) / 0.04;
    CHECK(push > 0.2);
    force += push;
    torque += push * testing::list_of(state).points[j].position.cross(Vector(0, 0, 1));
  }
  CHECK(force == about(1, margin));
  CHECK(torque.norm() == Approx(0).margin(margin));
  CHECK(bed.position[0].z == about(0.5, margin));
}

PolyhedronBed cube_stack(int cubes) {
  std::vector<Pose> poses;
  for (int k = 0; k < cubes; ++k) poses.push_back(pose_at(3, 3, 0.5 + k));
  return shape_bed({6, 6, periodic, walls}, testing::cube(), poses);
}

TEST_CASE("a stack of 20 cubes stands still, each face carrying the weight above it") {
  PolyhedronBed bed = cube_stack(20);
  StepState<Polyhedron, double> state;
  const StepSettings settings = tight_steps(0.9);
  for (const int steps : {1, 50}) {
    take_steps(steps, settings, bed, state);
    INFO("after " << steps << " more steps");
    REQUIRE(testing::list_of(state).contacts.size() == 20);
    for (std::size_t k = 0; k < 20; ++k) {
      const PolyhedronContact& c = testing::list_of(state).contacts[k];
      const double above = bed.is_grain(c.b) ? 19.0 - c.a : 20.0 - c.a;
      REQUIRE(c.count == 4);
      // Twenty rows of a residual of 1e-9 add up, and a stack multiplies them by its height.
      CHECK(testing::contact_force(state, k, settings.dt) == about(above, 1e-6));
    }
  }
  for (std::size_t i = 0; i < 20; ++i) {
    CHECK(bed.position[i].z == about(0.5 + static_cast<double>(i), 1e-7));
    CHECK(std::abs(bed.orientation[i].w) == about(1, 1e-12));
  }
}

/// The face that looks down most, and how far it is from looking straight down, radians.
struct Lie {
  std::size_t face;
  double tilt;
};
Lie lie_of(const PolyhedronBed& bed, std::size_t grain) {
  Lie lie{0, 10};
  for (std::size_t k = 0; k < bed.shape(grain).faces.size(); ++k) {
    const Vector n = bed.pose(grain).orientation * bed.shape(grain).faces[k].normal;
    const double tilt = std::atan2(std::hypot(n.x(), n.y()), -n.z());
    if (tilt < lie.tilt) lie = {k, tilt};
  }
  return lie;
}

double area_of(const ConvexShape& shape, const Face& face) {
  Vector sum = Vector::Zero();
  for (std::int32_t k = 0; k < face.corners; ++k) {
    const auto corner = [&](std::int32_t i) {
      return shape.vertices[static_cast<std::size_t>(
          shape.loops[static_cast<std::size_t>(face.first + i % face.corners)])];
    };
    sum += corner(k).cross(corner(k + 1));
  }
  return sum.norm() / 2;
}

TEST_CASE("a pinacoid tipped by 20 degrees comes to lie flat on its largest face") {
  const ConvexShape shape = pinacoid({});
  const auto largest = std::max_element(
      shape.faces.begin(), shape.faces.end(),
      [&](const Face& a, const Face& b) { return area_of(shape, a) < area_of(shape, b) - 1e-12; });
  testing::Draw draw(3);
  for (int k = 0; k < 5; ++k) {
    const Quaternion down = Quaternion::FromTwoVectors(largest->normal, -Vector::UnitZ());
    const double angle = draw.uniform(0, 6.28);
    const Vector axis(std::cos(angle), std::sin(angle), 0);
    const Quaternion tipped = Quaternion(Eigen::AngleAxisd(0.35, axis)) * down;
    PolyhedronBed bed = shape_bed({6, 6, periodic, walls}, shape, {pose_at(3, 3, 0.75, tipped)});
    StepState<Polyhedron, double> state;
    take_steps(400, tight_steps(0.9), bed, state);
    const Lie lie = lie_of(bed, 0);
    CHECK(area_of(shape, shape.faces[lie.face]) == Approx(area_of(shape, *largest)));
    CHECK(lie.tilt < 1e-6);
    CHECK(bed.position[0].z == about(largest->offset, 1e-6));
    CHECK(testing::list_of(state).contacts[0].count == static_cast<std::size_t>(largest->corners));
    CHECK(testing::contact_force(state, 0, 0.2) == about(1, 1e-6));
  }
}

// Corners of a random start overlap deeply, and the first whole step follows a short one that
// looked less far than it does: this start once made its solve diverge.
TEST_CASE("no grain is thrown out of a start whose grains overlap deeply") {
  PackingSpec spec;
  spec.box = {6, 5, walls, walls};
  spec.fill = GrainCount{600};
  spec.shape = PinacoidSize{};
  spec.random_key = 944195639736249979U;
  PolyhedronBed bed = start<Polyhedron>(spec).value();
  StepState<Polyhedron, float> state;
  StepSettings look{0.05, 0.0, 0.5, 0.01, 0.05, {}}, fall{0.2, 0.9, 0.2, 0.05, 0.05, {}};
  look.limits.iterations = 400;
  fall.limits.iterations = 40;
  step(look, kernels(), bed, state);
  change_step(fall.dt / look.dt, bed, state);
  // Motions are limited, whatever the solve: its residual tells, in masses times d.
  const StepReport report = step(fall, kernels(), bed, state);
  CHECK(report.solve.residual < 0.1);
  CHECK(report.largest_motion < 1.0);
  for (const Record<double>& c : bed.centres()) {
    CHECK(c.x == about(3, 3));
    CHECK(c.y == about(2.5, 2.5));
    CHECK(c.z == about(12, 12));
  }
}

// As of spheres: forty on one spot, whose impulses grow.
TEST_CASE("no grain moves or turns further in a step than the longest motion") {
  testing::Draw draw(5);
  std::vector<Pose> poses;
  for (int k = 0; k < 40; ++k) {
    const Quaternion turn =
        Quaternion::FromTwoVectors(Vector::UnitZ(), testing::random_direction(draw));
    poses.push_back(pose_at(2, 2, 0.5, turn, k < 20 ? 0.2 : 3.0));
  }
  PolyhedronBed bed = shape_bed({4, 4, periodic, walls}, testing::cube(), poses);
  StepState<Polyhedron, double> state;
  StepSettings settings = tight_steps(0.9);
  settings.limits.iterations = 5;
  for (const double longest : {longest_motion, 0.02}) {
    settings.longest = longest;
    double most = 0.0;
    for (int k = 0; k < 10; ++k) {
      const StepReport report = step(settings, kernels(), bed, state);
      REQUIRE(report.largest_motion <= longest + 1e-12);  // of rounding
      most = std::max(most, report.largest_motion);
      for (std::size_t i = 0; i < bed.grains(); ++i) {
        REQUIRE(bed.spin[i].norm() * bed.circumradius(i) <= longest + 1e-12);
      }
    }
    CHECK(most > 0.9 * longest);
  }
}

// The ends of such prisms touch in up to 64 points, of which three are independent: swept in one
// order, with momentum, 100,000 sweeps do not solve some of these steps.
TEST_CASE("steps of prisms with 32 sides are solved within a few hundred sweeps") {
  PackingSpec spec;
  spec.box = {4, 4, periodic, periodic};
  spec.fill = GrainCount{100};
  spec.shape = PrismSize{32};
  PolyhedronBed bed = start<Polyhedron>(spec).value();
  StepState<Polyhedron, float> state;
  StepSettings settings{0.2, 0.9, 0.2, 0.05, 0.05, {}};
  settings.limits.iterations = 100'000;
  settings.limits.rms_tolerance = 0.005;  // that of the fall at `balanced`, m g
  int most = 0;
  for (int k = 0; k < 60; ++k) {
    most = std::max(most, step(settings, kernels(), bed, state).solve.iterations);
  }
  CHECK(most < 400);
}

TEST_CASE("a free grain keeps its angular momentum while it tumbles") {
  const ConvexShape shape = pinacoid({});
  PolyhedronBed bed = shape_bed({6, 6, periodic, walls}, shape, {pose_at(3, 3, 50)});
  bed.spin[0] = Vector(0.02, -0.1, 0.05);
  const auto momentum = [&] {
    return Vector(bed.pose(0).orientation * shape.inertia.cwiseProduct(bed.spin[0]));
  };
  const Vector before = momentum();
  StepState<Polyhedron, double> state;
  take_steps(50, tight_steps(1), bed, state);
  CHECK((momentum() - before).norm() < 1e-14);
  CHECK(bed.pose(0).orientation.angularDistance(Quaternion::Identity()) > 0.5);
}

TEST_CASE("a grain that spins moves its corners no further than it may move in the air") {
  PolyhedronBed bed = shape_bed({9, 9, periodic, walls}, testing::cube(),
                                {pose_at(4, 4, 50, Quaternion::Identity(), 3.0)});
  bed.spin[0] = Vector(0.0, 0.0, 0.1);
  StepState<Polyhedron, double> state;
  StepSettings settings = tight_steps(1.0);
  settings.longest_free = 0.15;
  step(settings, kernels(), bed, state);
  CHECK(bed.spin[0].norm() * bed.circumradius(0) == Approx(0.15));
}

TEST_CASE("velocities and spins stay as they are when steps become shorter or longer") {
  PolyhedronBed bed = shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 50)});
  bed.motion[0].x = 0.04;
  bed.spin[0] = Vector(0.02, -0.1, 0.05);
  StepState<Polyhedron, double> state;
  change_step(0.25, bed, state);
  CHECK(bed.motion[0].x == 0.01);
  CHECK(bed.spin[0] == Vector(0.005, -0.025, 0.0125));
}

TEST_CASE("grains are said to have sunk where the balls within them overlap by half") {
  for (const ConvexShape& shape : {pinacoid({}), testing::cube()}) {
    for (const double share : {0.4, 0.6}) {
      const double touching = 2 * shape.inradius;
      PolyhedronBed bed = shape_bed({6, 6, periodic, walls}, shape,
                                    {pose_at(3, 3, 4), pose_at(3, 3, 4 + share * touching)});
      StepState<Polyhedron, double> state;
      const double sunk = step(tight_steps(0), kernels(), bed, state).sunk;
      CHECK(sunk == about(share < 0.5 ? 0.1 * touching : 0.0, 1e-12));
    }
  }
}

TEST_CASE("contacts between grains change neither their momentum nor their angular momentum") {
  PolyhedronBed bed = testing::random_shape_bed({6, 6, periodic, periodic}, pinacoid({}), 60, 4, 7);
  for (std::size_t i = 0; i < bed.grains(); ++i) bed.position[i].z += 20;  // far above the floor
  const PolyhedronBed before = bed;
  StepState<Polyhedron, double> state;
  StepSettings settings = tight_steps(0);
  settings.correction = 0.1;  // no grain is moved by more than the longest motion
  settings.limits.iterations = 300;
  step(settings, kernels(), bed, state);
  const std::vector<testing::Wrench> sums = testing::wrenches(before, state, settings.dt);
  const double unit = settings.dt * settings.dt;
  Vector total = Vector::Zero();
  double largest = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Vector v(bed.motion[i].x, bed.motion[i].y, bed.motion[i].z + unit);
    const Vector& f = sums[i].force;
    largest = std::max(largest, f.norm());
    total += v / bed.motion[i].w;
    // The motion is what the forces at the points of contact give.
    REQUIRE((v / bed.motion[i].w / unit - f).norm() < 1e-9 * (1 + f.norm()));
    const Quaternion q = before.pose(i).orientation;
    const Vector root = before.root_inertia[i];
    const Vector turned = q.conjugate() * sums[i].torque * unit;
    const Quaternion step_turn = q.conjugate() * bed.pose(i).orientation;
    const Eigen::AngleAxisd angles(step_turn);
    const Vector momentum = (angles.angle() * angles.axis()).cwiseProduct(root).cwiseProduct(root);
    REQUIRE((momentum - turned).norm() < 1e-9 * (1 + turned.norm()));
  }
  REQUIRE(largest > 1);  // they do push
  CHECK(total.norm() < 1e-12);
}

/// A few layers of pinacoids, settled by the stages known to bring them to rest.
template <class Real>
StepReport settle(PolyhedronBed& bed, StepState<Polyhedron, Real>& state) {
  struct Stage {
    double dt, momentum, near, correction;
    int iterations, steps;
  };
  double last = 0.2;
  StepReport report;
  for (const Stage& s : {Stage{0.2, 0.95, 0.05, 0.2, 40, 120}, Stage{0.2, 0.9, 0.03, 0.1, 100, 40},
                         Stage{0.1, 0.9, 0.03, 0.1, 200, 40}, Stage{0.05, 0.5, 0.03, 0.5, 400, 80},
                         Stage{0.05, 0.0, 0.03, 1.0, 2000, 30}}) {
    change_step(s.dt / last, bed, state);
    last = s.dt;
    StepSettings settings{s.dt, s.momentum, s.correction, s.near, 0.05, {}};
    settings.limits = {Solver::accelerated_gauss_seidel, s.iterations, 1e-4};
    for (int k = 0; k < s.steps; ++k) report = step(settings, kernels(), bed, state);
  }
  return report;
}

TEST_CASE("a settled bed of pinacoids balances its weight and is isostatic", "[slow]") {
  PackingSpec spec;
  spec.box = {5, 5, periodic, walls};
  spec.fill = SolidHeight{3};
  spec.shape = PinacoidSize{};
  const auto begin = start<Polyhedron>(spec);
  REQUIRE(begin);
  PolyhedronBed bed = *begin;
  StepState<Polyhedron, double> state;
  const StepReport report = settle(bed, state);
  const PolyhedronBed before = bed;
  StepSettings still = tight_steps(0);
  still.dt = 0.05;
  still.near = 0.03;
  still.limits = {Solver::accelerated_gauss_seidel, 5000, 1e-6};
  const StepReport last = step(still, kernels(), bed, state);
  CHECK(report.solve.residual < 5e-2);
  CHECK(last.largest_motion < 2e-3);  // rest is the slow sliding of a few grains
  // The floor carries what does not accelerate.
  const double weight = testing::weight_of(bed);
  CHECK(testing::wall_force(state, bed.wall_name(0), 0.05) == Approx(weight).epsilon(0.02));
  std::int64_t constraints = 0;
  for (const PolyhedronContact& c : testing::list_of(state).contacts) {
    constraints += constraints_of(testing::list_of(state).points.data() + c.first, c.count, 1e-4);
    for (std::size_t j = 0; j < c.count; ++j) {
      REQUIRE(testing::list_of(state).points[c.first + j].gap > -1e-3);
    }
  }
  // Six for each grain, less those that still slide; few contacts, so by 5 % here.
  const auto grains = static_cast<double>(bed.grains());
  CHECK(static_cast<double>(constraints) / (6 * grains) == about(1, 0.05));
}

/// A cube above the floor, tilted by 0.1 about an edge of its own.
PolyhedronBed tilted_cube() {
  const Quaternion tilt(Eigen::AngleAxisd(0.1, Vector::UnitY()));
  return shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.56, tilt)});
}

TEST_CASE("a second step on the same contacts ends where one on new ones does, to second order") {
  StepSettings settings = tight_steps(0.9);
  settings.dt = 0.02;  // so that the cube comes nearer to the floor, and tips on it, by 1e-3 d
  PolyhedronBed twice = tilted_cube(), anew = tilted_cube();
  StepState<Polyhedron, double> state_of_twice, state_of_anew;
  take_steps(12, settings, twice, state_of_twice);
  take_steps(12, settings, anew, state_of_anew);
  REQUIRE(state_hash(twice) == state_hash(anew));
  settings.steps = 2;
  const StepReport both = take_steps(1, settings, twice, state_of_twice);
  settings.steps = 1;
  const StepReport last = take_steps(2, settings, anew, state_of_anew);
  CHECK(both.steps == 2);
  CHECK(last.steps == 1);
  const double moved = last.largest_motion;
  CHECK(moved > 1e-4);
  CHECK(std::abs(twice.position[0].z - anew.position[0].z) < 2.0 * moved * moved);
  const Record<double>&p = twice.orientation[0], &q = anew.orientation[0];
  const double half_angle = std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
  CHECK(half_angle < 2.0 * moved * moved);
  CHECK(both.largest_motion == Approx(moved).epsilon(0.05));
}

TEST_CASE("the iterations of all steps on the same contacts are told") {
  PolyhedronBed bed = cube_stack(5);
  StepState<Polyhedron, double> state;
  StepSettings settings = tight_steps(0);
  settings.limits = {Solver::accelerated_gauss_seidel, 7, 0.0};
  settings.steps = 2;
  const StepReport report = step(settings, kernels(), bed, state);
  CHECK(report.steps == 2);
  CHECK(report.solve.iterations == 14);
}

TEST_CASE("after a long way contacts are found anew") {
  StepSettings settings;
  settings.steps = 2;
  PolyhedronBed bed = shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 3)});
  bed.motion[0].z = -2.0 * longest_on_same_contacts;
  StepState<Polyhedron, float> state;
  CHECK(step(settings, kernels(), bed, state).steps == 1);
  bed.motion[0].z = 0.0;
  CHECK(step(settings, kernels(), bed, state).steps == 2);
}

TEST_CASE("grains of one sweep are the same on every instruction set") {
  std::vector<std::uint64_t> hashes;
  for (const Isa isa : testing::testable_isas()) {
    PolyhedronBed bed = testing::random_shape_bed({6, 6, periodic, walls}, pinacoid({}), 80, 5, 2);
    StepState<Polyhedron, float> state;
    StepSettings settings;
    settings.steps = 2;
    for (int k = 0; k < 30; ++k) step(settings, kernels_for(isa), bed, state);
    hashes.push_back(state_hash(bed));
    CHECK(hashes.back() == hashes.front());
  }
}

TEMPLATE_TEST_CASE("every solver finds the impulses and the residual of a dense reference", "",
                   float, double) {
  PolyhedronBed bed = testing::random_shape_bed({6, 6, periodic, walls}, pinacoid({}), 8, 1.5, 4);
  StepState<Polyhedron, TestType> state;
  StepSettings settings = tight_steps(0);
  settings.limits.iterations = 1;
  const PolyhedronBed start = bed;
  step(settings, kernels(), bed, state);
  const testing::DenseBodies dense = testing::dense_bodies(state.contacts, state.motion.free);
  const testing::WideVector exact = testing::solve_dense(dense);
  REQUIRE(dense.violation(exact) < 1e-15L);
  REQUIRE(exact.maxCoeff() > 0.01L);
  // What f32 leaves of impulses of up to 1: some 1e-7 times the condition of the problem.
  const double tolerance = std::is_same_v<TestType, float> ? 1e-5 : 1e-10;
  for (const Solver solver : testing::all_solvers) {
    std::fill(state.contacts.impulse.begin(), state.contacts.impulse.end(), TestType(0));
    const SolveReport report =
        solve({solver, 200'000, tolerance}, kernels(), state.contacts, state.motion);
    testing::WideVector p(exact.size());
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      p[k] = state.contacts.impulse[static_cast<std::size_t>(k)];
    }
    INFO("solver " << static_cast<int>(solver));
    CHECK(report.residual <= tolerance);
    CHECK(report.residual ==
          Approx(static_cast<double>(dense.violation(p))).epsilon(0.01).margin(tolerance / 10));
    // Impulses of a polygon's corners are not unique, what they do to the gaps is.
    const testing::WideVector w = dense.coupling * (p - exact);
    CHECK(static_cast<double>(w.cwiseAbs().maxCoeff()) < 1e3 * tolerance);
  }
}

}  // namespace
}  // namespace grainsweep
