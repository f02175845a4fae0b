#include "runner/export/lammps.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "engine/shape/build.hpp"
#include "engine/shape/convex_shape.hpp"
#include "engine/units.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

std::string joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + cell(number);
  return text;
}

/// Classes of sizes; of a mixture those of the first component, then those of the second, ...
std::size_t type_count(const StoredBed& bed) {
  return 2 * (bed.turned ? bed.turned->meshes.size() : 1);
}
std::size_t type_of(const ExportedBed& exported, std::size_t grain) {
  const auto& turned = exported.bed.turned;
  const auto by_size = static_cast<std::size_t>(size_class(exported, grain));
  return by_size + 2 * (turned ? turned->component(grain) : 0);
}

/// That a body may have: LAMMPS makes room by it, and a sphere among polyhedra has one.
std::string fewest_corners(const StoredBed& bed) {
  const auto& meshes = bed.turned->meshes;
  const auto is_ball = [](const Mesh& mesh) { return mesh.is_ball(); };
  return std::any_of(meshes.begin(), meshes.end(), is_ball) ? "1" : "3";
}

/// Comment, numbers and bounds.
std::string header(const ExportedBed& exported) {
  const StoredBed& bed = exported.bed;
  const auto boundary = [](Boundary axis) { return axis == Boundary::periodic ? " p" : " f"; };
  const std::string style =
      bed.turned ? "body rounded/polyhedron " + fewest_corners(bed) + " 64" : "sphere";
  const std::string count = cell(bed.grains.size());
  return "grainsweep, lengths in d; atom_style " + style + "; boundary" + boundary(bed.box.x) +
         boundary(bed.box.y) + " f\n\n" + count + " atoms\n" +
         (bed.turned ? count + " bodies\n" : "") + cell(type_count(bed)) + " atom types\n\n0 " +
         cell(bed.box.length) + " xlo xhi\n0 " + cell(bed.box.width) + " ylo yhi\n0 " +
         cell(height_of(bed)) + " zlo zhi\n\n";
}

std::string spheres(const ExportedBed& exported) {
  std::string text = "Atoms # sphere\n\n";
  const double density = 6.0 / pi;  // so that a sphere of diameter 1 has mass 1
  for (std::size_t k = 0; k < exported.bed.grains.size(); ++k) {
    const SettledGrain& grain = exported.bed.grains[k];
    text += cell(id_of(k)) + " " + cell(type_of(exported, k)) + " " +
            joined({2.0 * grain.radius, density, grain.x, grain.y, grain.z}) + "\n";
  }
  return text;
}

using Corners = std::vector<std::int32_t>;

std::set<std::pair<std::int32_t, std::int32_t>> edges_of(const std::vector<Corners>& faces) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const Corners& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      edges.insert(std::minmax(face[k], face[(k + 1) % face.size()]));
    }
  }
  return edges;
}

/// Faces of three and four corners, -1 in place of a fourth.
std::vector<std::array<std::int32_t, 4>> small_faces(const std::vector<Corners>& faces) {
  std::vector<std::array<std::int32_t, 4>> small;
  for (const Corners& face : faces) {
    if (face.size() == 4) {
      small.push_back({face[0], face[1], face[2], face[3]});
      continue;
    }
    for (std::size_t k = 2; k < face.size(); ++k)
      small.push_back({face[0], face[k - 1], face[k], -1});
  }
  return small;
}

/// Nine to a line: LAMMPS takes at most 32 lines of a body and 256 characters of a line.
std::string in_lines(const std::vector<double>& numbers) {
  std::string text;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    text += cell(numbers[k]) + ((k + 1) % 9 == 0 || k + 1 == numbers.size() ? "\n" : " ");
  }
  return text;
}

/// Of a grain of size 1.
double volume_of(const Mesh& mesh) {
  if (mesh.is_ball()) return sphere_volume(0.5);
  std::vector<Vector> corners;
  for (const auto& [x, y, z] : mesh.vertices) corners.emplace_back(x, y, z);
  return mass_moments(corners, mesh.faces).volume;
}

/// In that of a grain of size 1, of the first component of a mixture.
double mass_of(const StoredBed& bed, std::size_t grain) {
  const double by_size = sphere_mass(bed.grains[grain].radius);
  if (bed.turned->component(grain) == 0) return by_size;
  return by_size * volume_of(bed.turned->mesh(grain)) / volume_of(bed.turned->meshes.front());
}

/// A sphere among polyhedra: one corner with a rounding.
std::string round_body(const StoredBed& bed, std::size_t grain) {
  const double radius = bed.grains[grain].radius;
  const double moment = 0.4 * mass_of(bed, grain) * radius * radius;
  const std::vector<double> numbers = {moment, moment, moment, 0, 0, 0, 0, 0, 0, 2.0 * radius};
  return cell(id_of(grain)) + " 3 " + cell(numbers.size()) + "\n1 0 0\n" + in_lines(numbers);
}

/// A body: how many numbers, moments of inertia, corners about its centre, edges, faces, and the
/// diameter of its rounding.
std::string body(const StoredBed& bed, std::size_t grain) {
  const Mesh& mesh = bed.turned->mesh(grain);
  if (mesh.is_ball()) return round_body(bed, grain);
  const std::vector<Vector> corners = vertices_about_centre(bed, grain);
  const auto edges = edges_of(mesh.faces);
  const auto faces = small_faces(mesh.faces);
  const Eigen::Matrix3d inertia =
      mass_of(bed, grain) * inertia_of(mass_moments(corners, mesh.faces).second);
  std::vector<double> numbers = {inertia(0, 0), inertia(1, 1), inertia(2, 2),
                                 inertia(0, 1), inertia(0, 2), inertia(1, 2)};
  for (const Vector& corner : corners) numbers.insert(numbers.end(), corner.begin(), corner.end());
  for (const auto& [from, to] : edges) numbers.insert(numbers.end(), {double(from), double(to)});
  for (const auto& face : faces) numbers.insert(numbers.end(), face.begin(), face.end());
  numbers.push_back(1e-9);
  return cell(id_of(grain)) + " 3 " + cell(numbers.size()) + "\n" + cell(corners.size()) + " " +
         cell(edges.size()) + " " + cell(faces.size()) + "\n" + in_lines(numbers);
}

std::string bodies(const ExportedBed& exported) {
  std::string atoms = "Atoms # body\n\n", text = "\nBodies\n\n";
  for (std::size_t k = 0; k < exported.bed.grains.size(); ++k) {
    const SettledGrain& grain = exported.bed.grains[k];
    atoms += cell(id_of(k)) + " " + cell(type_of(exported, k)) + " 1 " +
             joined({mass_of(exported.bed, k), grain.x, grain.y, grain.z}) + "\n";
    text += body(exported.bed, k);
  }
  return atoms + text;
}

}  // namespace

std::string lammps_data(const ExportedBed& exported) {
  return header(exported) + (exported.bed.turned ? bodies(exported) : spheres(exported));
}

}  // namespace grainsweep
