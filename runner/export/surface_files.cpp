#include "runner/export/surface_files.hpp"

#include <cstdio>
#include <utility>

#include "engine/shape/convex_shape.hpp"
#include "runner/export/surfaces.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

/// Of the container's top above the highest grain, which it would touch otherwise, d.
constexpr double headroom = 0.1;

/// Nine digits: what a single-precision reader can use.
std::string short_text(const Vector& v) {
  char text[64];
  std::snprintf(text, sizeof text, "%.9g %.9g %.9g", v.x(), v.y(), v.z());
  return text;
}

std::string name_of(const ExportedBed& exported, const GrainSurface& surface) {
  const std::size_t grain = surface.grain;
  if (surface.grains > 1) return "joined_" + cell(id_of(grain));
  return "grain_" + cell(id_of(grain)) + "_" + class_name(exported, grain);
}

/// name and surface of every grain, and of the container, in the lengths of the settings.
template <class Write>
void for_each_surface(const ExportedBed& exported, Write write) {
  const auto write_scaled = [&](const std::string& name, Surface surface) {
    for (Vector& vertex : surface.vertices) vertex *= exported.settings.lengths.d;
    write(name, surface);
  };
  for (GrainSurface& grain : grain_surfaces(exported)) {
    write_scaled(name_of(exported, grain), std::move(grain.surface));
  }
  write_scaled("container",
               container_surface(exported.bed.box, height_of(exported.bed) + headroom));
}

std::string facet(const Vector& a, const Vector& b, const Vector& c) {
  const Vector normal = (b - a).cross(c - a).normalized();
  return "facet normal " + short_text(normal) + "\nouter loop\nvertex " + short_text(a) +
         "\nvertex " + short_text(b) + "\nvertex " + short_text(c) + "\nendloop\nendfacet\n";
}

}  // namespace

std::string surfaces_stl(const ExportedBed& exported) {
  std::string text;
  for_each_surface(exported, [&](const std::string& name, const Surface& surface) {
    text += "solid " + name + "\n";
    for (const auto& face : surface.faces) {
      for (std::size_t k = 2; k < face.size(); ++k) {
        text +=
            facet(corner(surface, face[0]), corner(surface, face[k - 1]), corner(surface, face[k]));
      }
    }
    text += "endsolid " + name + "\n";
  });
  return text;
}

std::string surfaces_obj(const ExportedBed& exported) {
  std::string text = "# grainsweep, lengths in " + exported.settings.lengths.unit + "\n";
  std::size_t first = 1;
  for_each_surface(exported, [&](const std::string& name, const Surface& surface) {
    text += "o " + name + "\n";
    for (const Vector& vertex : surface.vertices) text += "v " + short_text(vertex) + "\n";
    for (const auto& face : surface.faces) {
      text += "f";
      for (const std::int32_t k : face) text += " " + cell(first + static_cast<std::size_t>(k));
      text += "\n";
    }
    first += surface.vertices.size();
  });
  return text;
}

}  // namespace grainsweep
