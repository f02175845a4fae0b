#include "tests/support/shape_pairs.hpp"

#include <cmath>

#include "tests/support/pair_oracle.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep::testing {

const std::vector<PairFamily> all_pair_families = {
    PairFamily::random,         PairFamily::near_touching,    PairFamily::parallel_faces,
    PairFamily::parallel_edges, PairFamily::vertex_on_vertex, PairFamily::deep_overlap,
    PairFamily::flat,           PairFamily::far_away};

std::string name_of(PairFamily family) {
  const char* const names[] = {"random",         "near touching",    "nearly parallel faces",
                               "parallel edges", "vertex on vertex", "deep overlap",
                               "flat",           "far away"};
  return names[static_cast<int>(family)];
}

PairPose random_pose(Draw& draw, double nearest, double farthest) {
  PairPose pose;
  pose.scale_a = draw.uniform(0.9, 1.1);
  pose.scale_b = draw.uniform(0.9, 1.1);
  pose.turn = random_rotation(draw).toRotationMatrix();
  pose.centre = draw.uniform(nearest, farthest) * random_direction(draw);
  return pose;
}

namespace {

/// 1e-2 .. 1e-12, every power as likely, of either sign.
double tiny(Draw& draw) {
  return (draw.chance(0.5) ? 1 : -1) * std::pow(10.0, draw.uniform(-12, -2));
}

/// The shortest turn from one unit vector to the opposite of another, then any turn about it, then
/// a tilt.
Matrix turned_against(Draw& draw, const Vector& from, const Vector& to, double tilt) {
  const Quaternion facing = Quaternion::FromTwoVectors(from, -to);
  const Quaternion spin(Eigen::AngleAxisd(draw.uniform(0, 6.283185307179586), to));
  const Quaternion tilting(Eigen::AngleAxisd(tilt, random_direction(draw)));
  return (tilting * spin * facing).normalized().toRotationMatrix();
}

/// Moves b along `n` until the gap along it is `gap`.
void bring_to(PairPose& pose, const ConvexShape& a, const ConvexShape& b, const Vector& n,
              double gap) {
  const double reach = pose.scale_a * reach_along(a, n) +
                       pose.scale_b * reach_along(b, -(pose.turn.transpose() * n));
  pose.centre += (reach + gap - n.dot(pose.centre)) * n;
}

struct Segment3 {
  Vector from, to;
};

Vector any_vertex(Draw& draw, const ConvexShape& shape) {
  return shape.vertices[draw.below(shape.vertices.size())];
}

/// Gaps of 1e-2 .. 1e-12 of either sign, by moving along the separating direction of the centres.
PairPose near_touching_pose(Draw& draw, const ConvexShape& a, const ConvexShape& b) {
  PairPose pose = random_pose(draw, 1, 1.4);
  for (int k = 0; k < 3; ++k) {
    const long double gap = true_gap({a, b, pose}).gap();
    pose.centre -= static_cast<double>(gap) * pose.centre.normalized();
  }
  pose.centre += tiny(draw) * pose.centre.normalized();
  return pose;
}

PairPose parallel_faces_pose(Draw& draw, const ConvexShape& a, const ConvexShape& b) {
  PairPose pose = random_pose(draw, 0, 0.6);
  const Vector n = a.faces[draw.below(a.faces.size())].normal;
  pose.turn = turned_against(draw, b.faces[draw.below(b.faces.size())].normal, n, tiny(draw));
  bring_to(pose, a, b, n, tiny(draw));
  return pose;
}

Segment3 segment_of(const ConvexShape& shape, const Edge& edge) {
  return {shape.vertices[static_cast<std::size_t>(edge.from)],
          shape.vertices[static_cast<std::size_t>(edge.to)]};
}

/// Edges parallel to 1e-2 .. 1e-12: one upon the other, shifted along it, in half of the pairs;
/// beside each other in the rest.
PairPose parallel_edges_pose(Draw& draw, const ConvexShape& a, const ConvexShape& b) {
  PairPose pose = random_pose(draw, 0, 0.3);
  const Edge& edge = a.edges[draw.below(a.edges.size())];
  const Segment3 p = segment_of(a, edge);
  const Segment3 q = segment_of(b, b.edges[draw.below(b.edges.size())]);
  const Vector u = (p.to - p.from).normalized();
  const Vector n = (a.faces[static_cast<std::size_t>(edge.left)].normal +
                    a.faces[static_cast<std::size_t>(edge.right)].normal)
                       .normalized();
  // The middle of the edge of b is turned against that of a as far as a turn about the edge can.
  const Quaternion laid = Quaternion::FromTwoVectors((q.to - q.from).normalized(), u);
  const Vector outward = laid * (q.from + q.to), across = outward - outward.dot(u) * u;
  const Quaternion spun = Quaternion::FromTwoVectors(across, -n);
  const Quaternion tilting(Eigen::AngleAxisd(tiny(draw), random_direction(draw)));
  pose.turn = (tilting * spun * laid).normalized().toRotationMatrix();
  if (draw.chance(0.5)) {
    pose.centre =
        (pose.scale_a * (p.from + p.to) - pose.scale_b * (pose.turn * (q.from + q.to))) / 2 +
        draw.uniform(-0.3, 0.3) * u + tiny(draw) * n.cross(u);
  }
  bring_to(pose, a, b, n, tiny(draw));
  return pose;
}

PairPose vertex_on_vertex_pose(Draw& draw, const ConvexShape& a, const ConvexShape& b) {
  PairPose pose = random_pose(draw, 0, 1);
  const Vector p = any_vertex(draw, a), q = any_vertex(draw, b);
  pose.turn = turned_against(draw, q.normalized(), p.normalized(), draw.uniform(-0.4, 0.4));
  pose.centre = pose.scale_a * p - pose.scale_b * (pose.turn * q) + tiny(draw) * p.normalized();
  return pose;
}

/// Two poses a million d from the origin, whose difference is still exact.
PairPose far_away_pose(Draw& draw) {
  const PairPose near = random_pose(draw, 0.7, 1.4);
  Pose a, b;
  a.centre = 1e6 * random_direction(draw);
  b.centre = a.centre + near.centre;
  a.orientation = random_rotation(draw);
  b.orientation = random_rotation(draw);
  a.scale = near.scale_a;
  b.scale = near.scale_b;
  return seen_from_a(a, b, b.centre - a.centre);
}

}  // namespace

PairPose pose_of_family(PairFamily family, Draw& draw, const ConvexShape& a, const ConvexShape& b) {
  switch (family) {
    case PairFamily::near_touching:
      return near_touching_pose(draw, a, b);
    case PairFamily::parallel_faces:
      return parallel_faces_pose(draw, a, b);
    case PairFamily::parallel_edges:
      return parallel_edges_pose(draw, a, b);
    case PairFamily::vertex_on_vertex:
      return vertex_on_vertex_pose(draw, a, b);
    case PairFamily::deep_overlap:
      return random_pose(draw, 0, 0.3);
    case PairFamily::far_away:
      return far_away_pose(draw);
    default:
      return random_pose(draw, 0.5, 1.5);
  }
}

}  // namespace grainsweep::testing
