#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "engine/shape/build.hpp"
#include "engine/units.hpp"
#include "runner/export/caps.hpp"
#include "runner/export/open_surfaces.hpp"

namespace grainsweep {
namespace {

using Flat = Eigen::Vector2d;  // perpendicular to a neck's normal, from the centre of grain a

/// The polyhedron lies where normal . x <= offset, from its centre.
struct HalfSpace {
  Vector normal;
  double offset = 0.0;
};

std::vector<HalfSpace> half_spaces_of(const Surface& surface) {
  std::vector<HalfSpace> spaces;
  for (const auto& face : surface.faces) {
    const Vector normal = area_vector(surface.vertices, face).normalized();
    spaces.push_back({normal, normal.dot(corner(surface, face[0]))});
  }
  return spaces;
}

/// The cut polyhedra of a bed.
struct Polyhedra {
  std::vector<Surface> surfaces;
  std::vector<std::vector<HalfSpace>> spaces;
};

/// A polyhedron at one end of a neck, as seen from the other.
struct End {
  const Surface& surface;
  const std::vector<HalfSpace>& spaces;
  Vector outward;  ///< along the neck
  Vector centre;   ///< from that of grain a
};

std::array<End, 2> ends_of(const Neck& neck, const Polyhedra& bed) {
  return {End{bed.surfaces[neck.a], bed.spaces[neck.a], neck.normal, Vector::Zero()},
          End{bed.surfaces[neck.b], bed.spaces[neck.b], -neck.normal, neck.between}};
}

std::pair<double, double> reaches(const End& end) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector& vertex : end.surface.vertices) {
    low = std::min(low, end.outward.dot(vertex));
    high = std::max(high, end.outward.dot(vertex));
  }
  return {low, high};
}

/// A side of a polygon, which lies where outward . x <= offset.
struct FlatSide {
  Flat outward;
  double offset = 0.0;
};

/// The section of the end at a depth below its highest corner.
void append_section(const End& end, const Neck& neck, double depth, std::vector<FlatSide>& sides) {
  constexpr double upright = 1e-9;
  const Vector up = neck.normal.cross(neck.across);
  const Vector foot = (reaches(end).second - depth) * end.outward;
  for (const HalfSpace& space : end.spaces) {
    const Flat outward(space.normal.dot(neck.across), space.normal.dot(up));
    const double slope = outward.norm();
    if (slope < upright) continue;
    const double offset = space.offset - space.normal.dot(foot);
    const Flat centre(end.centre.dot(neck.across), end.centre.dot(up));
    sides.push_back({outward / slope, offset / slope + outward.dot(centre) / slope});
  }
}

/// The part of a convex polygon where side.outward . x <= offset.
std::vector<Flat> clipped(const std::vector<Flat>& polygon, const Flat& outward, double offset) {
  std::vector<Flat> left;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Flat &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double here = outward.dot(from) - offset, there = outward.dot(to) - offset;
    if (here <= 0.0) left.push_back(from);
    if ((here <= 0.0) != (there <= 0.0))
      left.emplace_back(from + here / (here - there) * (to - from));
  }
  return left;
}

/// Centres of circles of a radius within the sides, no further than `reach` from `near` along x
/// and y.
std::vector<Flat> centres_within(const std::vector<FlatSide>& sides, double radius,
                                 const Flat& near, double reach) {
  std::vector<Flat> polygon;
  for (const Flat& to : {Flat(-1, -1), Flat(1, -1), Flat(1, 1), Flat(-1, 1)}) {
    polygon.emplace_back(near + reach * to);
  }
  for (const FlatSide& side : sides) polygon = clipped(polygon, side.outward, side.offset - radius);
  return polygon;
}

/// The point of a convex polygon, counter-clockwise, that is nearest to p.
Flat nearest_within(const std::vector<Flat>& polygon, const Flat& p) {
  Flat nearest = p;
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = true;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Flat &from = polygon[k], way = polygon[(k + 1) % polygon.size()] - from;
    const Flat to_p = p - from;
    is_inside = is_inside && way.x() * to_p.y() - way.y() * to_p.x() >= 0.0;
    const double share = std::clamp(to_p.dot(way) / std::max(way.squaredNorm(), 1e-300), 0.0, 1.0);
    const Flat on_side = from + share * way;
    if ((on_side - p).norm() >= least) continue;
    least = (on_side - p).norm();
    nearest = on_side;
  }
  return is_inside ? p : nearest;
}

/// The circle of the requested radius, or the widest one, within the sections of both ends, as near
/// as possible to the contact; nothing if there is none.
bool place(const Polyhedra& bed, const Vector& contact, Neck& neck) {
  constexpr int halvings = 20;
  constexpr double margin = 0.95;  // of a radius that sections bound
  const Vector up = neck.normal.cross(neck.across);
  const Flat near(contact.dot(neck.across), contact.dot(up));
  std::vector<FlatSide> sides;
  for (const End& end : ends_of(neck, bed)) {
    const auto [low, high] = reaches(end);
    append_section(end, neck, std::min(2.0 * neck.asked, (high - low) / 4.0), sides);
  }
  const double reach = 10.0 * neck.asked;
  double within = 0.0, beyond = neck.asked;
  std::vector<Flat> centres = centres_within(sides, beyond, near, reach);
  neck.radius = neck.asked;
  if (centres.empty()) {
    for (int k = 0; k < halvings; ++k) {
      const double radius = (within + beyond) / 2.0;
      std::vector<Flat> found = centres_within(sides, radius, near, reach);
      (found.empty() ? beyond : within) = radius;
      if (!found.empty()) centres = std::move(found);
    }
    neck.radius = margin * within;
  }
  if (centres.empty()) return false;
  const Flat centre = nearest_within(centres, near);
  neck.middle = centre.x() * neck.across + centre.y() * up;
  return true;
}

/// Height of the surface of an end above its centre, over a point.
double height_over(const End& end, const Vector& point) {
  constexpr double steep = 1e-9;
  const Vector from_centre = point - end.centre;
  const Vector foot = from_centre - end.outward.dot(from_centre) * end.outward;
  double height = std::numeric_limits<double>::infinity();
  for (const HalfSpace& space : end.spaces) {
    const double slope = space.normal.dot(end.outward);
    if (slope < steep) continue;
    height = std::min(height, (space.offset - space.normal.dot(foot)) / slope);
  }
  return height;
}

void fit_to_polyhedra(const Polyhedra& bed, Neck& neck) {
  const auto [a, b] = ends_of(neck, bed);
  double of_a = std::numeric_limits<double>::infinity(), of_b = of_a;
  for (int k = 0; k < neck_sides; ++k) {
    const Vector point = neck_corner(neck, k, 0.0);
    of_a = std::min(of_a, height_over(a, point));
    of_b = std::min(of_b, height_over(b, point));
  }
  neck.low = of_a;
  neck.high = neck.between.dot(neck.normal) - of_b;
}

double distance_to_line(const Flat& p, const Flat& from, const Flat& to) {
  const Flat way = to - from;
  const double share = std::clamp((p - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (from + share * way - p).norm();
}

/// How near corners of the neck come to edges of the end, and corners of the end to the neck's
/// sides; if not beyond `wanted`, any distance that shows it.
double clearance_at(const End& end, const Neck& neck, double wanted) {
  const Vector up = neck.normal.cross(neck.across);
  const auto flat = [&](const Vector& v) { return Flat(v.dot(neck.across), v.dot(up)); };
  std::vector<Flat> rim;
  rim.reserve(neck_sides);
  for (int k = 0; k < neck_sides; ++k) rim.push_back(flat(neck_corner(neck, k, 0.0)));
  const Flat middle = flat(neck.middle);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < end.spaces.size(); ++f) {
    if (end.spaces[f].normal.dot(end.outward) <= 0.0) continue;
    const auto& face = end.surface.faces[f];
    for (std::size_t j = 0; j < face.size() && least > wanted; ++j) {
      const Flat from = flat(corner(end.surface, face[j]) + end.centre);
      const Flat to = flat(corner(end.surface, face[(j + 1) % face.size()]) + end.centre);
      if (distance_to_line(middle, from, to) - neck.radius >= least) continue;  // too far away
      for (std::size_t k = 0; k < rim.size(); ++k) {
        least = std::min({least, distance_to_line(rim[k], from, to),
                          distance_to_line(from, rim[k], rim[(k + 1) % rim.size()])});
      }
    }
  }
  return least;
}

/// Turns the neck, and makes it narrower by up to a tenth, so that its sides run clear of corners
/// and edges: no slivers are left.
void turn_clear(const Polyhedra& bed, Neck& neck) {
  constexpr int turns = 8, sizes = 5;
  constexpr double enough = 0.03;  // radii
  Neck best = neck;
  double largest = -1.0;
  for (int k = 0; k < turns * sizes && largest < enough * best.radius; ++k) {
    const int size = k / turns;
    Neck turned = neck;
    const double angle = 2.0 * pi * (k % turns) / (turns * neck_sides);
    turned.across =
        std::cos(angle) * neck.across + std::sin(angle) * neck.normal.cross(neck.across);
    turned.radius *= 1.0 - 0.02 * size;
    const auto [a, b] = ends_of(turned, bed);
    const double clearance =
        std::min(clearance_at(a, turned, largest), clearance_at(b, turned, largest));
    if (clearance <= largest) continue;
    largest = clearance;
    best = turned;
  }
  neck = best;
  fit_to_polyhedra(bed, neck);
}

std::vector<Neck> placed_necks(const ExportedBed& exported, const Polyhedra& bed) {
  const auto& grains = exported.bed.grains;
  std::vector<Neck> necks;
  for (const Contact& contact : treated_contacts(exported)) {
    if (contact.is_wall) continue;
    const SettledGrain &a = grains[contact.a], &b = grains[contact.b];
    Neck neck;
    neck.a = contact.a;
    neck.b = contact.b;
    neck.between = between_centres(exported.bed, neck.a, neck.b);
    neck.normal = contact.place.normal;
    neck.across = neck.normal.unitOrthogonal();
    neck.asked = exported.settings.treatment.share * std::min(a.radius, b.radius);
    if (!place(bed, contact.place.point - Vector(a.x, a.y, a.z), neck)) continue;
    fit_to_polyhedra(bed, neck);
    necks.push_back(neck);
  }
  return necks;
}

}  // namespace

OpenSurfaces open_polyhedra(const ExportedBed& exported) {
  Polyhedra bed{whole_surfaces(exported), {}};
  cut_caps(exported, bed.surfaces);
  GrainBodies bodies;
  for (const Surface& surface : bed.surfaces) {
    bed.spaces.push_back(half_spaces_of(surface));
    bodies.points.push_back(surface.vertices);
    bodies.radii.push_back(0.0);
  }
  OpenSurfaces all;
  all.necks = placed_necks(exported, bed);
  // Turned before testing what they meet: where a neck runs along a face a turn shifts its ends.
  for (Neck& neck : all.necks) turn_clear(bed, neck);
  narrow(
      exported, bodies, [&](Neck& neck) { turn_clear(bed, neck); }, all.necks);
  const auto columns = neck_ends(all.necks, bed.surfaces.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    all.grains.push_back(with_holes(bed.surfaces[k], columns[k]));
  }
  return all;
}

}  // namespace grainsweep
