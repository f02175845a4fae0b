#include "runner/export/caps.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "runner/exit_codes.hpp"

namespace grainsweep {
namespace {

/// An offset not above the given one to which no corner is nearer than `clearance`: slivers that
/// rounding would turn inside out are not left.
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
      .clear();  // a place is the middle of all that is near, whatever of it bears a force
  near.bed.wall_forces.clear();
  return contacts_of(near);
}

void cut_caps(const ExportedBed& exported, std::vector<Surface>& surfaces) {
  const StoredBed& bed = exported.bed;
  const double clearance = bed.turned ? 1e-3 : 1e-4;  // in radii
  const double depth = cap_depth(exported.settings.treatment.share);
  for (const Contact& contact : treated_contacts(exported)) {
    const Vector& normal = contact.place.normal;
    const auto cut = [&](std::size_t grain, const Vector& outward, const Vector& point) {
      const double radius = bed.grains[grain].radius;
      const double offset = outward.dot(point) - contact.gap / 2.0 - depth * radius;
      surfaces[grain] = cut_off(surfaces[grain], outward,
                                clear_offset(surfaces[grain], outward, offset, clearance * radius));
      if (surfaces[grain].faces.empty()) {
        throw BadInput("--contacts: caps of that share leave nothing of grain " +
                       std::to_string(id_of(grain)) + " of packing " + bed.job +
                       "; take a smaller share");
      }
    };
    const Vector point = contact.place.point - centre_in_box(bed, contact.a);
    cut(contact.a, normal, point);
    if (contact.is_wall) continue;
    cut(contact.b, -normal, point - between_centres(bed, contact.a, contact.b));
  }
}

}  // namespace grainsweep
