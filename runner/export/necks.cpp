#include "runner/export/necks.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "engine/units.hpp"
#include "runner/export/contacts.hpp"

namespace grainsweep {
namespace {

constexpr double narrower = 0.8;
constexpr double narrowest = 0.1, narrowest_of_spheres = 1e-3;  // of the requested radius
constexpr double neck_clearance = 0.1;                          // of a radius, that necks keep

/// What is around a neck.
struct Surroundings {
  const ExportedBed& exported;
  const GrainBodies& grains;
  std::vector<std::vector<std::size_t>> neighbours = {};  ///< of each grain, with itself
  std::vector<std::vector<std::size_t>> necks = {};       ///< of each grain
  std::vector<double> extents = {};  ///< of each grain: the radius of a ball that holds it, d
};

void sort_out(std::vector<std::size_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// For each grain, those near enough for one to reach a neck of the other.
std::vector<std::vector<std::size_t>> neighbours_of(const ExportedBed& exported,
                                                    const std::vector<Neck>& necks) {
  double reach = exported.gap_tolerance;
  for (const Neck& neck : necks) {
    if (!neck.is_wall) reach = std::max(reach, neck.high - neck.low + neck.radius);
  }
  std::vector<std::vector<std::size_t>> neighbours(exported.bed.grains.size());
  for (std::size_t k = 0; k < neighbours.size(); ++k) neighbours[k].push_back(k);
  ExportedBed wide = exported;
  wide.gap_tolerance = reach;
  for (const Contact& contact : contacts_of(wide)) {
    if (contact.is_wall) continue;
    neighbours[contact.a].push_back(contact.b);
    neighbours[contact.b].push_back(contact.a);
  }
  for (auto& of_grain : neighbours) sort_out(of_grain);
  return neighbours;
}

std::vector<double> extents_of(const GrainBodies& grains) {
  std::vector<double> extents = grains.radii;
  for (std::size_t k = 0; k < extents.size(); ++k) {
    double furthest = 0.0;
    for (const Vector& point : grains.points[k]) furthest = std::max(furthest, point.norm());
    extents[k] += furthest;
  }
  return extents;
}

/// Grains near a neck, including those that it joins.
std::vector<std::size_t> grains_about(const Neck& neck, const Surroundings& around) {
  std::vector<std::size_t> grains = around.neighbours[neck.a];
  if (!neck.is_wall) {
    const auto& of_b = around.neighbours[neck.b];
    grains.insert(grains.end(), of_b.begin(), of_b.end());
  }
  sort_out(grains);
  return grains;
}

/// A ball that holds a neck, about the centre of its grain a.
struct Ball {
  Vector centre;
  double radius = 0.0;

  bool is_apart(const Ball& other, double distance) const {
    return (centre - other.centre).norm() > radius + other.radius + distance;
  }
};

Ball ball_of(const Neck& neck) {
  return {neck.middle + 0.5 * (neck.low + neck.high) * neck.normal,
          std::hypot(0.5 * (neck.high - neck.low), neck.radius)};
}

bool meets_third_grain(const Neck& neck, const std::vector<std::size_t>& grains,
                       const Surroundings& around) {
  if (neck.is_wall) return false;
  const std::vector<Vector> body = neck_corners(neck, Vector::Zero());
  const Ball about = ball_of(neck);
  const double margin = neck_clearance * neck.radius;
  return std::any_of(grains.begin(), grains.end(), [&](std::size_t grain) {
    if (grain == neck.a || grain == neck.b) return false;
    const Vector offset = between_centres(around.exported.bed, neck.a, grain);
    if (about.is_apart({offset, around.extents[grain]}, margin)) return false;
    std::vector<Vector> points = around.grains.points[grain];
    for (Vector& point : points) point += offset;
    return !are_apart(body, points, around.grains.radii[grain] + margin);
  });
}

Vector outward_at(const Neck& neck, std::size_t grain) {
  return neck.a == grain ? neck.normal : Vector(-neck.normal);
}

/// Whether the flat places that two necks take on a sphere meet.
bool meet_on_sphere(const Neck& neck, const Neck& other, std::size_t grain, double radius) {
  const double angle =
      std::acos(std::clamp(outward_at(neck, grain).dot(outward_at(other, grain)), -1.0, 1.0));
  const double taken = std::asin(neck.radius / radius) + std::asin(other.radius / radius);
  return angle < (1.0 + neck_clearance) * taken;
}

/// From the centre of the first neck's grain a to that of the second one's.
Vector between_necks(const Neck& neck, const Neck& other, const StoredBed& bed) {
  if (neck.a == other.a) return Vector::Zero();
  if (neck.a == other.b) return -other.between;
  if (neck.b == other.a) return neck.between;
  if (neck.b == other.b) return neck.between - other.between;
  return between_centres(bed, neck.a, other.a);
}

bool necks_meet(const Neck& neck, const Neck& other, const Surroundings& around) {
  for (const std::size_t grain : {neck.a, neck.b}) {
    if (neck.is_wall && grain != neck.a) continue;
    const bool is_shared = grain == other.a || (!other.is_wall && grain == other.b);
    const double radius = around.grains.radii[grain];
    if (is_shared && radius > 0.0 && meet_on_sphere(neck, other, grain, radius)) return true;
  }
  if (neck.is_wall || other.is_wall) return false;
  const Vector offset = between_necks(neck, other, around.exported.bed);
  const double clearance = neck_clearance * std::min(neck.radius, other.radius);
  Ball about = ball_of(other);
  about.centre += offset;
  return !ball_of(neck).is_apart(about, clearance) &&
         !are_apart(neck_corners(neck, Vector::Zero()), neck_corners(other, offset), clearance);
}

std::vector<std::size_t> necks_about(const std::vector<std::size_t>& grains,
                                     const Surroundings& around) {
  std::vector<std::size_t> found;
  for (const std::size_t grain : grains) {
    found.insert(found.end(), around.necks[grain].begin(), around.necks[grain].end());
  }
  sort_out(found);
  return found;
}

/// Which necks must become narrower.
std::vector<bool> crowded(const std::vector<Neck>& necks, const Surroundings& around) {
  std::vector<bool> is_crowded(necks.size(), false);
  for (std::size_t k = 0; k < necks.size(); ++k) {
    const std::vector<std::size_t> grains = grains_about(necks[k], around);
    if (meets_third_grain(necks[k], grains, around)) is_crowded[k] = true;
    for (const std::size_t other : necks_about(grains, around)) {
      if (other <= k || !necks_meet(necks[k], necks[other], around)) continue;
      is_crowded[k] = true;
      is_crowded[other] = true;
    }
  }
  return is_crowded;
}

std::vector<std::vector<std::size_t>> necks_by_grain(const std::vector<Neck>& necks,
                                                     std::size_t grains) {
  std::vector<std::vector<std::size_t>> of_grains(grains);
  for (std::size_t k = 0; k < necks.size(); ++k) {
    of_grains[necks[k].a].push_back(k);
    if (!necks[k].is_wall) of_grains[necks[k].b].push_back(k);
  }
  return of_grains;
}

}  // namespace

std::vector<std::vector<NeckEnd>> neck_ends(const std::vector<Neck>& necks, std::size_t grains) {
  std::vector<std::vector<NeckEnd>> ends(grains);
  for (std::size_t k = 0; k < necks.size(); ++k) {
    ends[necks[k].a].push_back({&necks[k], k, false});
    if (!necks[k].is_wall) ends[necks[k].b].push_back({&necks[k], k, true});
  }
  return ends;
}

Vector neck_corner(const Neck& neck, int k, double height) {
  const double angle = 2.0 * pi * k / neck_sides;
  const Vector up = neck.normal.cross(neck.across);
  return neck.middle + height * neck.normal +
         neck.radius * (std::cos(angle) * neck.across + std::sin(angle) * up);
}

std::vector<Vector> neck_corners(const Neck& neck, const Vector& centre) {
  std::vector<Vector> corners;
  for (const double height : {neck.low, neck.high}) {
    for (int k = 0; k < neck_sides; ++k) {
      corners.emplace_back(centre + neck_corner(neck, k, height));
    }
  }
  return corners;
}

bool are_apart(const std::vector<Vector>& points, const std::vector<Vector>& others,
               double distance) {
  constexpr int most_steps = 200;
  Vector nearest = points.front() - others.front();  // of the points' differences, so far
  for (int step = 0; step < most_steps; ++step) {
    const double length = nearest.norm();
    if (length <= distance) return false;
    const auto along = [&](const Vector& p, const Vector& q) {
      return nearest.dot(p) < nearest.dot(q);
    };
    const Vector difference = *std::min_element(points.begin(), points.end(), along) -
                              *std::max_element(others.begin(), others.end(), along);
    if (nearest.dot(difference) > distance * length) return true;
    const Vector way = difference - nearest;
    const double share = -nearest.dot(way) / way.squaredNorm();
    nearest += std::clamp(share, 0.0, 1.0) * way;
  }
  return false;
}

void narrow(const ExportedBed& exported, const GrainBodies& grains,
            const std::function<void(Neck&)>& fit, std::vector<Neck>& necks) {
  Surroundings around{exported, grains};
  around.neighbours = neighbours_of(exported, necks);
  around.extents = extents_of(grains);
  for (bool is_done = false; !is_done;) {
    around.necks = necks_by_grain(necks, exported.bed.grains.size());
    const std::vector<bool> is_crowded = crowded(necks, around);
    is_done = true;
    for (std::size_t k = 0; k < necks.size(); ++k) {
      if (!is_crowded[k]) continue;
      is_done = false;
      necks[k].radius *= narrower;
      fit(necks[k]);
    }
    std::erase_if(necks, [&](const Neck& neck) {
      const bool is_sphere = grains.radii[neck.a] > 0.0;
      return neck.radius < (is_sphere ? narrowest_of_spheres : narrowest) * neck.asked;
    });
  }
}

}  // namespace grainsweep
