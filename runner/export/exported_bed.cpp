#include "runner/export/exported_bed.hpp"

#include <algorithm>
#include <charconv>
#include <map>

#include <Eigen/Geometry>

namespace grainsweep {
namespace {

double top_of(const StoredBed& bed, std::size_t grain) {
  if (is_sphere(bed, grain)) return bed.grains[grain].z + bed.grains[grain].radius;
  double top = 0.0;
  for (const Eigen::Vector3d& vertex : vertices_in_box(bed, grain)) top = std::max(top, vertex.z());
  return top;
}

}  // namespace

ExportedBed scaled(ExportedBed exported) {
  const double d = exported.settings.lengths.d;
  Box& box = exported.bed.box;
  for (double* length : {&box.length, &box.width, &exported.small_limit}) *length *= d;
  for (SettledGrain& grain : exported.bed.grains) {
    for (double* length : {&grain.x, &grain.y, &grain.z, &grain.radius}) *length *= d;
  }
  return exported;
}

int size_class(const ExportedBed& exported, std::size_t grain) {
  return exported.bed.grains[grain].radius < exported.small_limit ? 2 : 1;
}

bool is_sphere(const StoredBed& bed, std::size_t grain) {
  return !bed.turned || bed.turned->mesh(grain).is_ball();
}

bool has_components(const StoredBed& bed) { return bed.turned && !bed.turned->components.empty(); }

std::string component_text(const StoredBed& bed, std::size_t grain, char separator) {
  if (!has_components(bed)) return "";
  return separator + std::to_string(bed.turned->component(grain) + 1);
}

const char* class_name(const ExportedBed& exported, std::size_t grain) {
  return size_class(exported, grain) == 1 ? "large" : "small";
}

std::optional<ContactTreatment> contact_treatment(std::string_view text) {
  using Kind = ContactTreatment::Kind;
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  const std::map<std::string_view, Kind> kinds = {
      {"shrink", Kind::shrink}, {"cap", Kind::cap}, {"bridge", Kind::bridge}};
  const auto kind = kinds.find(name);
  if (colon == std::string_view::npos || kind == kinds.end()) return std::nullopt;
  ContactTreatment treatment{kind->second};
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data() + colon + 1, last, treatment.share);
  const bool cuts = treatment.kind != Kind::shrink;
  const bool is_share =
      (cuts ? treatment.share >= least_cut : treatment.share > 0.0) && treatment.share < 1.0;
  return error == std::errc() && end == last && is_share ? std::optional(treatment) : std::nullopt;
}

std::vector<Eigen::Vector3d> vertices_about_centre(const StoredBed& bed, std::size_t grain) {
  const auto& [qx, qy, qz, qw] = bed.turned->orientations[grain];
  const Eigen::Quaterniond turn(qw, qx, qy, qz);
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& [x, y, z] : bed.turned->mesh(grain).vertices) {
    vertices.emplace_back(2.0 * bed.grains[grain].radius * (turn * Eigen::Vector3d(x, y, z)));
  }
  return vertices;
}

Eigen::Vector3d centre_in_box(const StoredBed& bed, std::size_t grain) {
  const SettledGrain& at = bed.grains[grain];
  return {at.x, at.y, at.z};
}

Eigen::Vector3d between_centres(const StoredBed& bed, std::size_t a, std::size_t b) {
  const Eigen::Vector3d between = centre_in_box(bed, b) - centre_in_box(bed, a);
  return {nearest_image(between.x(), bed.box.period_x()),
          nearest_image(between.y(), bed.box.period_y()), between.z()};
}

std::vector<Eigen::Vector3d> vertices_in_box(const StoredBed& bed, std::size_t grain) {
  std::vector<Eigen::Vector3d> vertices = vertices_about_centre(bed, grain);
  for (Eigen::Vector3d& vertex : vertices) vertex += centre_in_box(bed, grain);
  return vertices;
}

double height_of(const StoredBed& bed) {
  double height = 0.0;
  for (std::size_t i = 0; i < bed.grains.size(); ++i) height = std::max(height, top_of(bed, i));
  return height;
}

}  // namespace grainsweep
