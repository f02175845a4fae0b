#include "engine/measure/contact_places.hpp"

#include <algorithm>
#include <vector>

#include "engine/narrow/constraints.hpp"
#include "engine/narrow/polyhedra.hpp"

namespace grainsweep {

namespace {

/// Faces that lie on each other by less than this are an area, not crossing edges, d.
constexpr double preference_of_faces = 1e-4;

Vector centre_of(const Grains& bed, std::int32_t grain) {
  return vector_of(bed.position[static_cast<std::size_t>(grain)]);
}

Vector towards(const Wall& wall, const Vector& place) {
  const UnitVector inward = wall.normal(place.x(), place.y(), place.z());
  return -Vector(inward.x, inward.y, inward.z);
}

Vector middle_of(const std::vector<ContactPoint>& points, double tolerance) {
  Vector sum = Vector::Zero();
  double count = 0.0;
  for (const ContactPoint& point : points) {
    if (point.gap >= tolerance) continue;
    sum += point.position;
    count += 1.0;
  }
  return sum / count;
}

int counted(const std::vector<ContactPoint>& points, double tolerance) {
  return std::max(1, constraints_of(points.data(), points.size(), tolerance));
}

/// A reach that includes a gap of `gap` and everything else that touches.
double reach_of(double gap, double tolerance) {
  constexpr double rounding = 1e-9;
  return std::max(tolerance, gap + rounding);
}

/// The vertices of a grain, in the box frame, with their gaps to a wall.
std::vector<ContactPoint> points_of(const PolyhedronBed& bed, const TouchingWall& touching) {
  const Wall& wall = bed.walls[static_cast<std::size_t>(touching.wall)];
  const Pose pose = bed.pose(static_cast<std::size_t>(touching.grain));
  std::vector<ContactPoint> points;
  for (const Vector& vertex : bed.shape(static_cast<std::size_t>(touching.grain)).vertices) {
    const Vector place = pose.place(vertex);
    points.push_back({place, wall.distance(place.x(), place.y(), place.z())});
  }
  return points;
}

/// The contact place of a sphere at a wall.
ContactPlace place_of_sphere(const Grains& bed, const TouchingWall& touching) {
  const Vector centre = centre_of(bed, touching.grain);
  const Vector normal = towards(bed.walls[static_cast<std::size_t>(touching.wall)], centre);
  const double radius = bed.position[static_cast<std::size_t>(touching.grain)].w;
  return {normal, centre + (radius + touching.gap / 2.0) * normal, 1};
}

}  // namespace

ContactPlace contact_place(const SphereBed& bed, const TouchingPair& pair, double /*tolerance*/) {
  const Vector between =
      nearest_difference(bed, static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b));
  const Vector normal = between.normalized();
  const double radius = bed.position[static_cast<std::size_t>(pair.a)].w;
  return {normal, centre_of(bed, pair.a) + (radius + pair.gap / 2.0) * normal, 1};
}

ContactPlace contact_place(const PolyhedronBed& bed, const TouchingPair& pair, double tolerance) {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const double reach = reach_of(pair.gap, tolerance);
  TouchColumns columns;
  PairMemory memory;
  std::vector<ContactPoint> points;
  const PairContact contact =
      touch(shape_pair(bed, a, b), {reach, preference_of_faces, 0.0}, memory, columns, points);
  const Pose pose = bed.pose(a);
  return {pose.orientation * contact.normal,
          pose.centre + pose.orientation * middle_of(points, reach), counted(points, tolerance)};
}

ContactPlace contact_place(const SphereBed& bed, const TouchingWall& touching,
                           double /*tolerance*/) {
  return place_of_sphere(bed, touching);
}

ContactPlace contact_place(const PolyhedronBed& bed, const TouchingWall& touching,
                           double tolerance) {
  if (!bed.turns(static_cast<std::size_t>(touching.grain))) return place_of_sphere(bed, touching);
  const Wall& wall = bed.walls[static_cast<std::size_t>(touching.wall)];
  const std::vector<ContactPoint> points = points_of(bed, touching);
  const Vector vertex = middle_of(points, reach_of(touching.gap, tolerance));
  const Vector normal = towards(wall, vertex);
  return {normal, vertex + touching.gap / 2.0 * normal, counted(points, tolerance)};
}

std::vector<VertexPlace> vertex_places(const PolyhedronBed& bed, const TouchingWall& touching) {
  const Wall& wall = bed.walls[static_cast<std::size_t>(touching.wall)];
  std::vector<VertexPlace> places;
  for (const ContactPoint& point : points_of(bed, touching)) {
    const Vector normal = towards(wall, point.position);
    places.push_back({static_cast<std::int32_t>(places.size()),
                      point.gap,
                      {normal, point.position + point.gap / 2.0 * normal, 1}});
  }
  return places;
}

}  // namespace grainsweep
