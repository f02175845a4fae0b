#include "runner/export/lammps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "engine/shape/build.hpp"
#include "engine/shape/convex_shape.hpp"
#include "engine/units.hpp"
#include "runner/exit_codes.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

std::string joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + cell(number);
  return text;
}

/// Number of size classes; for a mixture those of the first component, then those of the second,
/// ...
std::size_t type_count(const StoredBed& bed) {
  return 2 * (bed.turned ? bed.turned->meshes.size() : 1);
}
std::size_t type_of(const ExportedBed& exported, std::size_t grain) {
  const auto& turned = exported.bed.turned;
  const auto by_size = static_cast<std::size_t>(size_class(exported, grain));
  return by_size + 2 * (turned ? turned->component(grain) : 0);
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

// What LAMMPS reads of a body: 32 lines with its two headers, each of 255 characters with its end.
constexpr std::size_t most_lines = 30, most_characters = 254;

using Words = std::vector<std::string>;

Words words_of(const std::vector<double>& numbers) {
  Words words;
  for (const double number : numbers) words.push_back(cell(number));
  return words;
}

/// As many words per line as LAMMPS reads.
std::string in_lines(const Words& words) {
  std::string text;
  std::size_t length = 0;
  for (const std::string& word : words) {
    const bool is_full = length + 1 + word.size() > most_characters;
    if (length > 0) text += is_full ? "\n" : " ";
    length = word.size() + (length == 0 || is_full ? 0 : length + 1);
    text += word;
  }
  return text + "\n";
}

/// Corners, edges and small faces of a mesh.
struct Parts {
  explicit Parts(const Mesh& mesh)
      : corners(mesh.is_ball() ? 1 : mesh.vertices.size()),
        edges(edges_of(mesh.faces)),
        faces(small_faces(mesh.faces)) {}

  std::size_t corners;
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  std::vector<std::array<std::int32_t, 4>> faces;
};

/// The words of a body: moments of inertia, corners about its centre, edges, faces, and the
/// diameter of its rounding.
Words body_words(const Parts& parts, const Words& moments, const Words& corners) {
  Words words = moments;
  words.insert(words.end(), corners.begin(), corners.end());
  for (const auto& [from, to] : parts.edges) words.insert(words.end(), {cell(from), cell(to)});
  for (const auto& face : parts.faces) {
    for (const std::int32_t corner : face) words.push_back(cell(corner));
  }
  words.emplace_back("1e-09");
  return words;
}

/// To 15 decimals, which rounding leaves for lengths near d, so that no coordinate is longer than
/// longest_coordinate.
double rounded(double coordinate) {
  constexpr double decimals = 1e15;
  return std::round(coordinate * decimals) / decimals;
}
constexpr std::string_view longest_coordinate = "-12.345678901234567";
constexpr std::string_view longest_number = "-1.2345678901234567e-100";

/// Whether a body with these parts fits into the lines that LAMMPS reads, however it is turned.
bool has_room(const Parts& parts) {
  const Words moments(6, std::string(longest_number));
  const Words corners(3 * parts.corners, std::string(longest_coordinate));
  const std::string lines = in_lines(body_words(parts, moments, corners));
  return static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n')) <= most_lines;
}

/// Fewest and most corners that a body may have: LAMMPS reserves room by them, for as many edges
/// and faces as corners, two and four numbers each. A sphere among polyhedra has one corner.
std::string corners_to_ask_for(const StoredBed& bed) {
  constexpr std::size_t per_corner = 9, usual = 64;
  std::size_t fewest = 3, most = usual;
  for (const Mesh& mesh : bed.turned->meshes) {
    const Parts parts(mesh);
    const std::size_t numbers = 3 * parts.corners + 2 * parts.edges.size() + 4 * parts.faces.size();
    fewest = std::min(fewest, parts.corners);
    most = std::max({most, parts.corners, (numbers + per_corner - 1) / per_corner});
  }
  return cell(fewest) + " " + cell(most);
}

/// Comment, numbers and bounds.
std::string header(const ExportedBed& exported) {
  const StoredBed& bed = exported.bed;
  const auto boundary = [](Boundary axis) { return axis == Boundary::periodic ? " p" : " f"; };
  const std::string style =
      bed.turned ? "body rounded/polyhedron " + corners_to_ask_for(bed) : "sphere";
  const std::string count = cell(bed.grains.size());
  return "grainsweep, lengths in d; atom_style " + style + "; boundary" + boundary(bed.box.x) +
         boundary(bed.box.y) + " f\n\n" + count + " atoms\n" +
         (bed.turned ? count + " bodies\n" : "") + cell(type_count(bed)) + " atom types\n\n0 " +
         cell(bed.box.length) + " xlo xhi\n0 " + cell(bed.box.width) + " ylo yhi\n0 " +
         cell(height_of(bed)) + " zlo zhi\n\n";
}

/// Volume of a grain of size 1.
double volume_of(const Mesh& mesh) {
  if (mesh.is_ball()) return sphere_volume(0.5);
  std::vector<Vector> corners;
  for (const auto& [x, y, z] : mesh.vertices) corners.emplace_back(x, y, z);
  return mass_moments(corners, mesh.faces).volume;
}

/// In units of the mass of a grain of size 1, of the first component of a mixture.
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
  return cell(id_of(grain)) + " 3 " + cell(numbers.size()) + "\n1 0 0\n" +
         in_lines(words_of(numbers));
}

/// A body: how many numbers, corners, edges and faces, and its words.
std::string body(const StoredBed& bed, std::size_t grain) {
  const Mesh& mesh = bed.turned->mesh(grain);
  if (mesh.is_ball()) return round_body(bed, grain);
  std::vector<double> coordinates;
  const std::vector<Vector> corners = vertices_about_centre(bed, grain);
  for (const Vector& corner : corners) {
    for (const double along : corner) coordinates.push_back(rounded(along));
  }
  const Eigen::Matrix3d inertia =
      mass_of(bed, grain) * inertia_of(mass_moments(corners, mesh.faces).second);
  const Parts parts(mesh);
  const Words words = body_words(parts,
                                 words_of({inertia(0, 0), inertia(1, 1), inertia(2, 2),
                                           inertia(0, 1), inertia(0, 2), inertia(1, 2)}),
                                 words_of(coordinates));
  return cell(id_of(grain)) + " 3 " + cell(words.size()) + "\n" + cell(parts.corners) + " " +
         cell(parts.edges.size()) + " " + cell(parts.faces.size()) + "\n" + in_lines(words);
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

std::string fault_for_lammps(const StoredBed& bed) {
  if (!bed.turned) return "";
  for (const Mesh& mesh : bed.turned->meshes) {
    const Parts parts(mesh);
    if (has_room(parts)) continue;
    return "a grain has " + cell(parts.corners) + " corners and " + cell(parts.edges.size()) +
           " edges, more than the 32 lines that LAMMPS reads of a body can hold; take a shape of "
           "fewer, as prisms and cylinders of up to " +
           cell(most_sides_for_lammps) + " sides are, or --format vtp or stl";
  }
  return "";
}

std::string lammps_data(const ExportedBed& exported) {
  const std::string fault = fault_for_lammps(exported.bed);
  if (!fault.empty()) throw BadInput("packing " + exported.bed.job + ": " + fault);
  return header(exported) + (exported.bed.turned ? bodies(exported) : spheres(exported));
}

}  // namespace grainsweep
