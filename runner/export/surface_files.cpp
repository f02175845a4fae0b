#include "runner/export/surface_files.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include "engine/shape/convex_shape.hpp"
#include "runner/export/surfaces.hpp"
#include "runner/store/archive.hpp"
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

/// name, id and surface of every grain, and of the container, whose id is 0, in the lengths of the
/// settings.
template <class Write>
void for_each_surface(const ExportedBed& exported, Write write) {
  const auto write_scaled = [&](const std::string& name, std::size_t id, Surface surface) {
    for (Vector& vertex : surface.vertices) vertex *= exported.settings.lengths.d;
    write(name, id, surface);
  };
  for (GrainSurface& grain : grain_surfaces(exported)) {
    write_scaled(name_of(exported, grain), id_of(grain.grain), std::move(grain.surface));
  }
  write_scaled("container", 0,
               container_surface(exported.bed.box, height_of(exported.bed) + headroom));
}

using Single = Eigen::Vector3f;

void put(const Single& v, ByteWriter& bytes) {
  for (const float coordinate : {v.x(), v.y(), v.z()}) bytes.put(coordinate);
}

/// A triangle of 50 bytes. None if two of its corners are one in single precision: its neighbours
/// then close the surface.
void put_triangle(const Vector& a, const Vector& b, const Vector& c, std::uint16_t number,
                  ByteWriter& bytes) {
  const Single from_a = a.cast<float>(), from_b = b.cast<float>(), from_c = c.cast<float>();
  if (from_a == from_b || from_b == from_c || from_c == from_a) return;
  const Vector normal = (b - a).cross(c - a).normalized();
  for (const Single& v : {Single(normal.cast<float>()), from_a, from_b, from_c}) put(v, bytes);
  bytes.put(number);
}

/// The heading of a binary STL file, 80 bytes. One of text would begin with "solid".
std::string stl_heading(const std::string& unit) {
  std::string text = "grainsweep, lengths in " + unit + "; attribute: id of the grain, 0 container";
  text.resize(80, ' ');
  return text;
}

std::string face_line(const std::vector<std::int32_t>& face, std::size_t first) {
  std::string text = "f";
  for (const std::int32_t k : face) text += " " + cell(first + static_cast<std::size_t>(k));
  return text + "\n";
}

/// The faces of a surface, each below the name of its part.
std::string faces_in_groups(const Surface& surface, const std::vector<std::string>& parts,
                            std::size_t first) {
  std::map<std::string, std::string> lines;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    lines[parts[k]] += face_line(surface.faces[k], first);
  }
  std::string text;
  for (const auto& [part, faces] : lines) text += "g " + part + "\n" + faces;
  return text;
}

}  // namespace

std::string surfaces_stl(const ExportedBed& exported) {
  constexpr std::size_t largest_number = std::numeric_limits<std::uint16_t>::max();
  constexpr std::size_t triangle_size = 50;
  ByteWriter triangles;
  for_each_surface(exported, [&](const std::string&, std::size_t id, const Surface& surface) {
    const auto number = static_cast<std::uint16_t>(std::min(id, largest_number));
    for (const auto& face : surface.faces) {
      for (std::size_t k = 2; k < face.size(); ++k) {
        put_triangle(corner(surface, face[0]), corner(surface, face[k - 1]),
                     corner(surface, face[k]), number, triangles);
      }
    }
  });
  ByteWriter count;
  count.put(static_cast<std::uint32_t>(triangles.bytes().size() / triangle_size));
  return stl_heading(exported.settings.lengths.unit) + count.bytes() + triangles.bytes();
}

std::string surfaces_obj(const ExportedBed& exported) {
  std::string text = "# grainsweep, lengths in " + exported.settings.lengths.unit + "\n";
  std::size_t first = 1;
  for_each_surface(exported, [&](const std::string& name, std::size_t id, const Surface& surface) {
    text += "o " + name + "\n";
    for (const Vector& vertex : surface.vertices) text += "v " + short_text(vertex) + "\n";
    if (id == 0) {
      text += faces_in_groups(surface, container_parts(exported.bed.box), first);
    } else {
      for (const auto& face : surface.faces) text += face_line(face, first);
    }
    first += surface.vertices.size();
  });
  return text;
}

}  // namespace grainsweep
