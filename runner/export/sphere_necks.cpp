#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "engine/shape/hull.hpp"
#include "engine/units.hpp"
#include "runner/export/caps.hpp"
#include "runner/export/open_surfaces.hpp"

namespace grainsweep {
namespace {

/// Height of the circle of a neck's radius on a sphere above the sphere's centre.
double circle_height(double radius, double of_circle) {
  return std::sqrt(radius * radius - of_circle * of_circle);
}

void fit_to_spheres(const StoredBed& bed, Neck& neck) {
  neck.low = circle_height(bed.grains[neck.a].radius, neck.radius);
  neck.high = neck.is_wall
                  ? neck.low
                  : neck.between.norm() - circle_height(bed.grains[neck.b].radius, neck.radius);
}

std::vector<Neck> asked_necks(const ExportedBed& exported, const std::vector<Contact>& treated) {
  const StoredBed& bed = exported.bed;
  std::vector<Neck> necks;
  for (const Contact& contact : treated) {
    if (is_at_tube(bed.box, contact)) continue;
    Neck& neck = necks.emplace_back();
    neck.a = contact.a;
    neck.b = contact.b;
    neck.is_wall = contact.is_wall;
    neck.normal = contact.place.normal;
    neck.across = neck.normal.unitOrthogonal();
    const double radius = bed.grains[neck.a].radius;
    double smaller = radius;
    if (!neck.is_wall) {
      const double other = bed.grains[neck.b].radius;
      neck.between = (radius + contact.gap + other) * neck.normal;
      smaller = std::min(radius, other);
    }
    neck.asked = neck.radius = exported.settings.treatment.share * smaller;
    fit_to_spheres(bed, neck);
  }
  return necks;
}

/// Corner k of a neck, on the circle in which it ends on a sphere about its centre.
Vector corner_of(const NeckEnd& rim, int k) {
  const Neck& neck = *rim.neck;
  return rim.is_of_b ? Vector(neck_corner(neck, k, neck.high) - neck.between)
                     : neck_corner(neck, k, neck.low);
}

/// Points on a sphere about its centre on the circle at which it ends beside the wall of a tube.
std::vector<Vector> edge_of(const TubeEnd& end, double radius) {
  const double from_axis = end.centre.norm(),
               both = end.radius * end.radius + from_axis * from_axis;
  const double widest = (both - radius * radius) / (2.0 * end.radius * from_axis);  // a cosine
  if (widest >= 1.0) return {};
  const bool goes_round = !(widest > -1.0);  // the axis lies within the grain
  const double half = goes_round ? pi : std::acos(widest);
  const int steps = std::max(3, static_cast<int>(std::ceil(half * end.sides / pi)));
  const double towards = std::atan2(end.centre.y(), end.centre.x());
  std::vector<Vector> edge;
  for (int step = goes_round ? 1 - steps : -steps; step <= steps; ++step) {
    const double angle = towards + half * step / steps;
    const Vector level = end.radius * Vector(std::cos(angle), std::sin(angle), 0.0) - end.centre;
    const bool is_end = !goes_round && std::abs(step) == steps;
    const double squared = is_end ? 0.0 : radius * radius - level.squaredNorm();
    edge.emplace_back(level + std::sqrt(std::max(squared, 0.0)) * Vector::UnitZ());
    if (squared > 0.0) edge.emplace_back(level - std::sqrt(squared) * Vector::UnitZ());
  }
  return edge;
}

/// The corners of a ball that lie outside the rims, by at least half an edge, and those of its end
/// beside the wall of a tube, if it has one, in place of those beyond it.
std::vector<Vector> corners_outside(const Surface& ball, double radius,
                                    const std::vector<NeckEnd>& rims, const TubeEnd* end) {
  constexpr double half_edge = 0.06;  // as an angle
  const auto is_free = [&](const Vector& corner) {
    return std::all_of(rims.begin(), rims.end(), [&](const NeckEnd& rim) {
      const double angle = std::acos(std::clamp(rim.outward().dot(corner) / radius, -1.0, 1.0));
      return angle > std::asin(rim.neck->radius / radius) + half_edge;
    });
  };
  std::vector<Vector> left;
  for (const Vector& corner : ball.vertices) {
    const Vector point = radius * corner;
    const bool is_within = end == nullptr || end->from_axis(point) < end->radius;
    if (is_within && is_free(point)) left.push_back(point);
  }
  if (end == nullptr) return left;
  for (const Vector& point : edge_of(*end, radius)) {
    if (is_free(point)) left.push_back(point);
  }
  return left;
}

/// The hole of rim r, whose corners the surface has from number neck_sides * r on.
Hole hole_of(const NeckEnd& rim, std::size_t r) {
  Hole hole{rim.number, {}, {{}}};
  for (int k = 0; k < neck_sides; ++k) {
    hole.sides.push_back({static_cast<std::int32_t>(r) * neck_sides + k});
    hole.lid.front().push_back(hole.sides.back().front());
  }
  if (rim.is_of_b) std::reverse(hole.lid.front().begin(), hole.lid.front().end());
  return hole;
}

/// The hull of the rims and what is left of the ball, without the flat faces within the rims.
OpenSurface open_sphere(const Surface& ball, double radius, const std::vector<NeckEnd>& rims,
                        const TubeEnd* end) {
  OpenSurface open;
  for (std::size_t r = 0; r < rims.size(); ++r) {
    for (int k = 0; k < neck_sides; ++k) open.surface.vertices.push_back(corner_of(rims[r], k));
    open.holes.push_back(hole_of(rims[r], r));
  }
  const auto of_rims = static_cast<std::int32_t>(open.surface.vertices.size());
  const std::vector<Vector> others = corners_outside(ball, radius, rims, end);
  open.surface.vertices.insert(open.surface.vertices.end(), others.begin(), others.end());
  open.surface.faces = hull_faces(open.surface.vertices);
  std::erase_if(open.surface.faces, [&](const Loop& face) {
    return std::all_of(face.begin(), face.end(), [&](std::int32_t k) {
      return k < of_rims && k / neck_sides == face.front() / neck_sides;
    });
  });
  return open;
}

/// Flat places at walls are closed for good.
void close_walls(const std::vector<Neck>& necks, OpenSurface& open) {
  for (const Hole& hole : open.holes) {
    if (necks[hole.neck].is_wall) open.surface.faces.push_back(hole.lid.front());
  }
  std::erase_if(open.holes, [&](const Hole& hole) { return necks[hole.neck].is_wall; });
}

}  // namespace

OpenSurfaces open_spheres(const ExportedBed& exported) {
  const StoredBed& bed = exported.bed;
  GrainBodies bodies;
  for (const SettledGrain& grain : bed.grains) {
    bodies.points.push_back({Vector::Zero()});
    bodies.radii.push_back(grain.radius);
  }
  const std::vector<Contact> treated = treated_contacts(exported);
  const std::map<std::size_t, TubeEnd> ends = tube_ends(exported, treated);
  std::vector<Neck> necks = asked_necks(exported, treated);
  narrow(
      exported, bodies, [&](Neck& neck) { fit_to_spheres(bed, neck); }, necks);
  const auto rims = neck_ends(necks, bed.grains.size());
  OpenSurfaces all;
  const Surface ball = unit_ball(3);
  for (std::size_t k = 0; k < rims.size(); ++k) {
    const auto end = ends.find(k);
    all.grains.push_back(open_sphere(ball, bed.grains[k].radius, rims[k],
                                     end == ends.end() ? nullptr : &end->second));
    close_walls(necks, all.grains.back());
  }
  all.necks = std::move(necks);
  return all;
}

}  // namespace grainsweep
