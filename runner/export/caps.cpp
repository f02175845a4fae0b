#include "runner/export/caps.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/results.hpp"
#include "engine/units.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {
namespace {

/// The largest offset not above the given one to which no corner is nearer than `clearance`, so
/// that no slivers are left that rounding would turn inside out.
double clear_offset(const Surface& surface, const Vector& normal, double offset, double clearance) {
  std::vector<double> heights;
  for (const Vector& vertex : surface.vertices) heights.push_back(normal.dot(vertex));
  std::sort(heights.begin(), heights.end(), std::greater<>());
  for (const double height : heights) {
    if (std::abs(height - offset) < clearance) offset = height - clearance;
  }
  return offset;
}

}  // namespace

double cap_depth(double share) { return 1.0 - std::sqrt(1.0 - share * share); }

std::vector<Contact> treated_contacts(const ExportedBed& exported) {
  ExportedBed near = exported;
  near.gap_tolerance =
      std::max(exported.gap_tolerance, cap_depth(exported.settings.treatment.share));
  near.bed.forces
      .clear();  // a place is the middle of all that is near, whichever part bears a force
  near.bed.wall_forces.clear();
  return contacts_of(near);
}

bool is_at_tube(const Box& box, const Contact& contact) {
  return box.is_tube && contact.is_wall && contact.b == static_cast<std::size_t>(tube_wall);
}

std::map<std::size_t, TubeEnd> tube_ends(const ExportedBed& exported,
                                         const std::vector<Contact>& treated) {
  constexpr double left_out = 0.125;  // of the depth, at most, in the middle of a side
  const StoredBed& bed = exported.bed;
  std::map<std::size_t, TubeEnd> ends;
  const double tube = bed.box.width / 2.0;
  for (const Contact& contact : treated) {
    if (!is_at_tube(bed.box, contact)) continue;
    const double depth =
        cap_depth(exported.settings.treatment.share) * bed.grains[contact.a].radius;
    TubeEnd& end = ends[contact.a];
    end.centre = centre_in_box(bed, contact.a) - Vector(tube, tube, 0.0);
    end.centre.z() = 0.0;
    end.radius = std::max(end.radius, tube - std::max(contact.gap, 0.0) - depth);
    end.sides = static_cast<int>(std::ceil(pi / std::sqrt(2.0 * left_out * depth / tube)));
  }
  return ends;
}

namespace {

/// Cuts grains, and reports those of which nothing is left.
class Cutter {
 public:
  Cutter(const StoredBed& bed, std::vector<Surface>& surfaces) : bed_(bed), surfaces_(surfaces) {}

  /// Leaves what lies below a plane across `outward`, at most so far from the centre.
  void cut(std::size_t grain, const Vector& outward, double offset) {
    Surface& surface = surfaces_[grain];
    const double clearance = (bed_.turned ? 1e-3 : 1e-4) * bed_.grains[grain].radius;
    surface = cut_off(surface, outward, clear_offset(surface, outward, offset, clearance));
    if (!surface.faces.empty()) return;
    throw BadInput("--contacts: caps of that share leave nothing of grain " +
                   std::to_string(id_of(grain)) + " of packing " + bed_.job +
                   "; take a smaller share");
  }

  /// Leaves what lies within the prism of a tube's end.
  void cut(std::size_t grain, const TubeEnd& end) {
    const double apothem = end.radius * std::cos(pi / end.sides);
    for (int side = 0; side < end.sides; ++side) {
      const double angle = 2.0 * pi * side / end.sides;
      const Vector outward(std::cos(angle), std::sin(angle), 0.0);
      const double offset = apothem - outward.dot(end.centre);
      const auto& vertices = surfaces_[grain].vertices;
      const bool bites = std::any_of(vertices.begin(), vertices.end(), [&](const Vector& vertex) {
        return outward.dot(vertex) > offset;
      });
      if (bites) cut(grain, outward, offset);
    }
  }

 private:
  const StoredBed& bed_;
  std::vector<Surface>& surfaces_;
};

}  // namespace

void cut_caps(const ExportedBed& exported, std::vector<Surface>& surfaces) {
  const StoredBed& bed = exported.bed;
  const double depth = cap_depth(exported.settings.treatment.share);
  const std::vector<Contact> treated = treated_contacts(exported);
  const std::map<std::size_t, TubeEnd> ends = tube_ends(exported, treated);
  Cutter cutter(bed, surfaces);
  for (const auto& [grain, end] : ends) cutter.cut(grain, end);
  for (const Contact& contact : treated) {
    if (is_at_tube(bed.box, contact)) continue;
    const Vector& normal = contact.place.normal;
    // From midway to where a cap begins: the grain's surface, or, for a grain that overlaps, the
    // wall or midway.
    const double before = contact.is_wall ? std::abs(contact.gap) : std::max(contact.gap, 0.0);
    const auto cut = [&](std::size_t grain, const Vector& outward, const Vector& point) {
      cutter.cut(grain, outward,
                 outward.dot(point) - before / 2.0 - depth * bed.grains[grain].radius);
    };
    const Vector point = contact.place.point - centre_in_box(bed, contact.a);
    cut(contact.a, normal, point);
    if (!contact.is_wall) {
      cut(contact.b, -normal, point - between_centres(bed, contact.a, contact.b));
    }
  }
}

}  // namespace grainsweep
