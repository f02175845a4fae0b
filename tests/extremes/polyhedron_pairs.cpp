#include <algorithm>
#include <cmath>

#include "engine/narrow/gjk.hpp"
#include "engine/narrow/manifold.hpp"
#include "engine/narrow/separating_axes.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/support/shape_pairs.hpp"

namespace grainsweep::extremes {

namespace {

// What narrow phase promises in f64, d: distances by GJK, separations by axes.
constexpr double gjk_bound = 1e-7, axes_bound = 1e-12;
constexpr double margin = 0.05;

using Poses = std::vector<PairPose>;

struct Errors {
  double distance = 0.0, overlap = 0.0, separation = 0.0, contact = 0.0, unconverged = 0.0;
};

void look_at(const ShapePair& pair, Errors& errors) {
  const testing::PairTruth truth = testing::true_gap(pair);
  const auto gap = static_cast<double>(truth.gap());
  const Closest closest = closest_points(pair, kernels_for(best_isa()).hull);
  const double distance = std::abs(closest.distance - static_cast<double>(truth.distance));
  const bool wrong = closest.overlap != truth.overlap;
  errors.distance = std::max(errors.distance, std::isfinite(distance) ? distance : 1.0);
  errors.overlap = std::max(errors.overlap, wrong ? std::abs(gap) : 0.0);
  errors.unconverged += closest.converged ? 0.0 : 1.0;
  const double separation = separating_axes(pair, kernels_for(best_isa()).hull).separation();
  const double above = separation - gap, below = truth.overlap ? gap - separation : 0.0;
  errors.separation = std::max({errors.separation, std::isfinite(above) ? above : 1.0, below});
  PairMemory memory;
  TouchColumns columns;
  std::vector<ContactPoint> points;
  const PairContact contact = touch(pair, {margin, 0.0}, memory, columns, points);
  if (points.empty() && gap < margin) errors.contact = std::max(errors.contact, margin - gap);
  if (!points.empty()) errors.contact = std::max(errors.contact, contact.separation - gap);
}

Finding look_at_all(const ConvexShape& a, const ConvexShape& b, const Poses& poses) {
  Errors errors;
  for (const PairPose& pose : poses) look_at({a, b, pose}, errors);
  Finding finding;
  const char* gjk = "promised of GJK in f64";
  const char* axes = "promised of the axes in f64";
  finding.answers = {
      {"pairs without convergence", errors.unconverged, 0.0, gjk},
      {"distance, d", errors.distance, gjk_bound, gjk},
      {"gap of pairs taken for overlapping or apart, d", errors.overlap, gjk_bound, gjk},
      {"separation, d", errors.separation, axes_bound, axes},
      {"gap of a contact, d", errors.contact, axes_bound, axes}};
  return finding;
}

/// Every degenerate position, `count` pairs of each.
Poses all_positions(const ConvexShape& a, const ConvexShape& b, int count) {
  testing::Draw draw(7);
  Poses poses;
  for (const testing::PairFamily family : testing::all_pair_families) {
    for (int k = 0; k < count; ++k) poses.push_back(testing::pose_of_family(family, draw, a, b));
  }
  return poses;
}

Matrix turn_about(const Vector& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

PairPose at(const Vector& centre, const Matrix& turn = Matrix::Identity()) {
  return {centre, turn, 1.0, 1.0};
}

const std::vector<double> tiny_gaps = {-1e-6, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-6};

/// Faces exactly parallel, shifted across, `height` apart but for tiny gaps.
Poses parallel_faces(double height) {
  Poses poses;
  for (const double gap : tiny_gaps) {
    for (const double shift : {0.0, 0.25, 0.5, 1.0 - 1e-12, 1.0}) {
      poses.push_back(at({shift, 0, height + gap}));
      poses.push_back(at({shift, shift, height + gap}));
    }
  }
  return poses;
}

/// Long edges of two upright squares crossed at the angle, one above the other.
Poses crossing_edges(double angle) {
  const double reach = std::sqrt(0.5);
  const Matrix up = turn_about(Vector::UnitX(), 0.25 * 3.14159265358979323846);
  Poses poses;
  for (const double gap : tiny_gaps) {
    const Matrix crossed = turn_about(Vector::UnitZ(), angle) * up;
    poses.push_back(
        at(up.transpose() * Vector(0.01, 0, 2 * reach + gap), up.transpose() * crossed));
  }
  return poses;
}

/// Along one line, so that simplices are collinear.
Poses in_a_row(double reach) {
  Poses poses;
  for (const double gap : tiny_gaps) {
    for (const double angle : {0.0, 1e-12, 1e-6}) {
      poses.push_back(at({reach + gap, 0, 0}, turn_about(Vector::UnitZ(), angle)));
    }
  }
  return poses;
}

std::vector<Vector> on_sphere(int count) {
  testing::Draw draw(11);
  std::vector<Vector> corners;
  for (int k = 0; k < count; ++k) corners.push_back(0.5 * testing::random_direction(draw));
  return corners;
}

/// A cube whose upper face is a flat roof, its middle raised by `rise`.
std::vector<Vector> flat_roof(double rise) {
  std::vector<Vector> corners = {{0, 0, 0.5 + rise}};
  for (int k = 0; k < 8; ++k) {
    corners.emplace_back(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5);
  }
  return corners;
}

/// A cube without one of its corners.
std::vector<Vector> seven_corners() {
  std::vector<Vector> corners = flat_roof(0.0);
  corners.erase(corners.begin());
  corners.pop_back();
  return corners;
}

Scene pairs(const std::string& name, const std::string& extreme, const ConvexShape& a,
            const ConvexShape& b, const Poses& poses) {
  return {"polyhedra", name,           extreme,
          "f64",       Outcome::right, [=] { return look_at_all(a, b, poses); }};
}

Scene in_all_positions(const std::string& name, const std::string& extreme,
                       const ConvexShape& shape, int count = 10) {
  return {"polyhedra", name, extreme + ", all degenerate positions", "f64", Outcome::right, [=] {
            return look_at_all(shape, shape, all_positions(shape, shape, count));
          }};
}

/// A shape that may be refused.
Scene hull_pairs(const std::string& name, const std::string& extreme,
                 const std::vector<Vector>& corners, Outcome expected) {
  return {"polyhedra", name, extreme, "f64", expected, [=] {
            const Hull hull = convex_hull(corners);
            if (!hull.shape) return Finding{hull.error};
            return look_at_all(*hull.shape, *hull.shape,
                               all_positions(*hull.shape, *hull.shape, 10));
          }};
}

void add_thin(std::vector<Scene>& scenes) {
  using testing::box_shape;
  scenes.push_back(in_all_positions("needles", "1 to 100", box_shape(1, 0.01, 0.01)));
  scenes.push_back(in_all_positions("plates", "1 to 100", box_shape(1, 1, 0.01)));
  scenes.push_back(in_all_positions("planks", "1 to 10 to 100", box_shape(1, 0.1, 0.01)));
  scenes.push_back(in_all_positions("foils", "1 to 1e6", box_shape(1, 1, 1e-6)));
  scenes.push_back(
      in_all_positions("pinacoid needles", "1 to 100", pinacoid({1, 0.01, 0.01, 0.8})));
  scenes.push_back(in_all_positions("pinacoid plates", "1 to 100", pinacoid({1, 1, 0.01, 0.3})));
  const ConvexShape needle = box_shape(1, 0.01, 0.01), plate = box_shape(1, 1, 0.01);
  scenes.push_back(pairs("needle and plate", "1 to 100 both, all degenerate positions", needle,
                         plate, all_positions(needle, plate, 10)));
}

void add_shapes(std::vector<Scene>& scenes) {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  scenes.push_back(in_all_positions("pinacoids without a ridge", "least angle, 45 degrees",
                                    pinacoid({1, 1, 1, 45 * degree})));
  scenes.push_back(in_all_positions("pinacoids with steep ends", "largest angle, 89 degrees",
                                    pinacoid({1, 1, 1, 89 * degree})));
  scenes.push_back(in_all_positions("tetrahedra", "4 vertices", testing::tetrahedron()));
  scenes.push_back(
      in_all_positions("hulls of 200 points", "200 vertices", testing::hull_of(on_sphere(200)), 1));
  scenes.push_back(hull_pairs("hulls of 3 points", "3 vertices", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                              Outcome::refused));
  scenes.push_back(hull_pairs("flat hulls", "4 vertices in a plane",
                              {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, Outcome::refused));
  scenes.push_back(hull_pairs("hulls with NaN", "a coordinate that is none",
                              {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}},
                              Outcome::refused));
  for (const char* rise : {"1e-3", "1e-5", "1e-7", "1e-10", "1e-13"}) {
    scenes.push_back(
        hull_pairs("cubes with a flat roof",
                   std::string("nearly coplanar faces, middle raised by ") + rise + " d",
                   flat_roof(std::stod(rise)), Outcome::right));
  }
}

void add_known_failures(std::vector<Scene>& scenes) {
  const ConvexShape cube = testing::cube(), seven = testing::hull_of(seven_corners());
  const ConvexShape flat = testing::box_shape(1, 1, 1e-3),
                    needle = testing::box_shape(1, 0.01, 0.01);
  scenes.push_back(pairs("cubes on cubes", "faces exactly parallel, gaps of 0 to 1e-6 d", cube,
                         cube, parallel_faces(1.0)));
  scenes.push_back(pairs("cube in itself", "equal centres, equal turns", cube, cube,
                         {at({0, 0, 0}), at({1e-12, 0, 0}), at({1e-9, 1e-9, 1e-9})}));
  scenes.push_back(pairs("flat boxes on flat boxes", "1 to 1000, gaps of 0 to 1e-6 d", flat, flat,
                         parallel_faces(1e-3)));
  scenes.push_back(
      pairs("needles end to end", "collinear simplices", needle, needle, in_a_row(1.0)));
  scenes.push_back(in_all_positions("cubes without a corner", "7 vertices", seven));
  scenes.push_back(pairs("cubes without a corner on each other",
                         "7 vertices, faces exactly parallel", seven, seven, parallel_faces(1.0)));
  for (const char* angle : {"1e-3", "1e-6", "1e-9", "1e-12", "1e-15"}) {
    scenes.push_back(pairs("crossing edges", std::string("at ") + angle + " rad", cube, cube,
                           crossing_edges(std::stod(angle))));
  }
}

}  // namespace

std::vector<Scene> polyhedron_pairs() {
  std::vector<Scene> scenes;
  add_thin(scenes);
  add_shapes(scenes);
  add_known_failures(scenes);
  return scenes;
}

}  // namespace grainsweep::extremes
