#include "runner/export/contacts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "engine/measure/bond_order.hpp"
#include "engine/rows/contacts.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/shape/hull.hpp"
#include "kernels/kernels.hpp"
#include "runner/export/vtp.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

using Sides = std::pair<std::int32_t, std::int32_t>;  // two grains, or a grain and WallForce::wall

/// The force between them, m g, and how it acts, where that is stored.
struct Borne {
  double force = 0.0;
  const ForceLine* line = nullptr;
};
using Forces = std::map<Sides, Borne>;

void add(const Sides& sides, double magnitude, const std::vector<ForceLine>& lines, std::size_t k,
         Forces& forces) {
  Borne& borne = forces[sides];
  borne.force += magnitude;
  if (!lines.empty()) borne.line = &lines.at(k);
}

Forces forces_of_grains(const StoredBed& bed) {
  Forces forces;
  for (std::size_t k = 0; k < bed.forces.size(); ++k) {
    const PairForce& force = bed.forces[k];
    add(std::minmax(force.a, force.b), force.magnitude, bed.lines, k, forces);
  }
  return forces;
}

Forces forces_of_walls(const StoredBed& bed) {
  Forces forces;
  for (std::size_t k = 0; k < bed.wall_forces.size(); ++k) {
    const WallForce& force = bed.wall_forces[k];
    add({force.grain, force.wall}, force.magnitude, bed.wall_lines, k, forces);
  }
  return forces;
}

SphereBed spheres_of(const StoredBed& bed) {
  std::vector<PlacedSphere> spheres;
  for (const SettledGrain& grain : bed.grains) {
    spheres.push_back({grain.x, grain.y, grain.z, grain.radius});
  }
  return make_bed(bed.box, spheres);
}

/// Throws std::logic_error if the mesh is no shape, which no stored one is.
ConvexShape shape_of(const Mesh& mesh) {
  if (mesh.is_ball()) return shape_of(ShapeSpec(SphereShape{})).shape.value();
  std::vector<Vector> vertices;
  for (const auto& [x, y, z] : mesh.vertices) vertices.emplace_back(x, y, z);
  return convex_hull(vertices, flat_as_stored).shape.value();
}

PolyhedronBed polyhedra_of(const StoredBed& bed) {
  const Turned& turned = *bed.turned;
  std::vector<ConvexShape> shapes;
  for (const Mesh& mesh : turned.meshes) shapes.push_back(shape_of(mesh));
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < bed.grains.size(); ++k) {
    const SettledGrain& grain = bed.grains[k];
    const auto& [x, y, z, w] = turned.orientations[k];
    const Quaternion given(shapes[turned.component(k)].given.rotation);
    poses.push_back(
        {{grain.x, grain.y, grain.z}, 2.0 * grain.radius, Quaternion(w, x, y, z) * given});
  }
  return make_bed(bed.box, std::move(shapes), turned.components, poses);
}

/// What `sides` bear; nothing if they bear no force.
std::optional<Borne> borne_by(const Forces& forces, const Sides& sides) {
  const auto found = forces.find(sides);
  return found == forces.end() ? std::nullopt : std::optional(found->second);
}

bool counts(const ExportedBed& exported, double gap, const std::optional<Borne>& borne) {
  return borne || gap < exported.gap_tolerance;
}

Vector vector_of(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// Where a force acts on grain a.
ContactPlace place_of(const ForceLine& line, const StoredBed& bed, std::size_t a) {
  return {vector_of(line.normal).normalized(), centre_in_box(bed, a) + vector_of(line.lever),
          line.constraints};
}

/// A contact that counts; `found` gives where its grains touch if no force does.
template <class Found>
Contact contact_of(const ExportedBed& exported, const Sides& sides, bool is_wall, double gap,
                   const std::optional<Borne>& borne, const Found& found) {
  const auto a = static_cast<std::size_t>(sides.first), b = static_cast<std::size_t>(sides.second);
  const bool is_told = borne && borne->line != nullptr;
  return {a,
          b,
          is_wall,
          gap,
          borne ? borne->force : 0.0,
          is_told ? place_of(*borne->line, exported.bed, a) : found()};
}

/// Appends `touching` if it counts, with its force. If it has one, points of a line or an area
/// count as in the tables.
template <class Bed, class Pair>
void append(const ExportedBed& exported, const Bed& bed, const Forces& forces, const Sides& sides,
            const Pair& touching, std::vector<Contact>& contacts) {
  const std::optional<Borne> borne = borne_by(forces, sides);
  if (!counts(exported, touching.gap, borne)) return;
  const double of_points = borne ? closed_gap : exported.gap_tolerance;
  contacts.push_back(contact_of(exported, sides, std::is_same_v<Pair, TouchingWall>, touching.gap,
                                borne, [&] { return contact_place(bed, touching, of_points); }));
}

void append_wall(const ExportedBed& exported, const SphereBed& bed, const Forces& forces,
                 const TouchingWall& wall, std::vector<Contact>& contacts) {
  append(exported, bed, forces, {wall.grain, wall.wall}, wall, contacts);
}
/// A polyhedron touches a tube with its vertices, each in a contact of its own.
void append_wall(const ExportedBed& exported, const PolyhedronBed& bed, const Forces& forces,
                 const TouchingWall& wall, std::vector<Contact>& contacts) {
  const bool is_tube = bed.walls[static_cast<std::size_t>(wall.wall)].is_round();
  if (!is_tube || !bed.turns(static_cast<std::size_t>(wall.grain))) {
    append(exported, bed, forces, {wall.grain, wall.wall}, wall, contacts);
    return;
  }
  for (const VertexPlace& at : vertex_places(bed, wall)) {
    const auto borne = borne_by(forces, {wall.grain, wall_of_vertex(at.vertex)});
    if (!counts(exported, at.gap, borne)) continue;
    contacts.push_back(contact_of(exported, {wall.grain, wall.wall}, true, at.gap, borne,
                                  [&] { return at.place; }));
  }
}

template <class Kind>
std::vector<Contact> contacts_of(const ExportedBed& exported, Bed<Kind>&& bed) {
  const double reach = std::max(exported.gap_tolerance, longest_bond_gap);
  const Touching touching = find_touching(bed, reach, kernels_for(Isa::sse2));
  std::vector<Contact> contacts;
  const Forces of_grains = forces_of_grains(exported.bed), of_walls = forces_of_walls(exported.bed);
  for (const TouchingPair& pair : touching.pairs) {
    append(exported, bed, of_grains, {pair.a, pair.b}, pair, contacts);
  }
  for (const TouchingWall& wall : touching.walls) {
    append_wall(exported, bed, of_walls, wall, contacts);
  }
  return contacts;
}

const char* kind_name(int constraints) {
  return constraints == 1 ? "point" : constraints == 2 ? "line" : "area";
}

std::string joined(const Vector& v, char separator) {
  return cell(v.x()) + separator + cell(v.y()) + separator + cell(v.z());
}

/// The other end of a contact's line: the centre of b beside a, or the wall.
Vector end_of(const ExportedBed& exported, const Contact& contact) {
  if (contact.is_wall) return contact.place.point;
  return centre_in_box(exported.bed, contact.a) +
         between_centres(exported.bed, contact.a, contact.b);
}

/// The arrays of the lines.
std::string contact_arrays(const ExportedBed& exported, const std::vector<Contact>& contacts) {
  const auto of_contact = [&](const std::string& attributes, const auto& value) {
    return vtp_array(attributes, contacts.size(),
                     [&](std::size_t k) { return value(contacts[k]); });
  };
  const auto number = [](const char* name) {
    return "type=\"Int64\" Name=\"" + std::string(name) + "\"";
  };
  const auto real = [](const char* name) {
    return "type=\"Float64\" Name=\"" + std::string(name) + "\"";
  };
  return of_contact(real("force"), [](const Contact& c) { return cell(c.force); }) +
         of_contact(real("gap"), [](const Contact& c) { return cell(c.gap); }) +
         of_contact(number("kind"), [](const Contact& c) { return cell(c.place.constraints); }) +
         of_contact(number("a"), [](const Contact& c) { return cell(id_of(c.a)); }) +
         of_contact(number("b"),
                    [](const Contact& c) { return cell(c.is_wall ? 0 : id_of(c.b)); }) +
         of_contact(number("size_class_a"),
                    [&](const Contact& c) { return cell(size_class(exported, c.a)); }) +
         of_contact(
             number("size_class_b"),
             [&](const Contact& c) { return cell(c.is_wall ? 0 : size_class(exported, c.b)); }) +
         of_contact(real("normal") + " NumberOfComponents=\"3\"",
                    [](const Contact& c) { return joined(c.place.normal, ' '); });
}

}  // namespace

std::vector<Contact> contacts_of(const ExportedBed& exported) {
  return exported.bed.turned ? contacts_of(exported, polyhedra_of(exported.bed))
                             : contacts_of(exported, spheres_of(exported.bed));
}

std::string wall_name(const Box& box, std::size_t wall) {
  if (wall == 0) return "floor";
  if (box.is_tube) return "tube";
  const std::array names = {"x_low", "x_high", "y_low", "y_high"};
  return names.at(wall - 1 + (box.x == Boundary::walls ? 0 : 2));
}

std::string contacts_csv(const ExportedBed& exported) {
  std::string text = "a,b,wall,size_class_a,size_class_b,kind,gap,nx,ny,nz,x,y,z,force\n";
  for (const Contact& c : contacts_of(exported)) {
    const std::string b = c.is_wall ? "" : cell(id_of(c.b));
    const std::string wall = c.is_wall ? wall_name(exported.bed.box, c.b) : "";
    text += csv_line({cell(id_of(c.a)), b, wall, class_name(exported, c.a),
                      c.is_wall ? "" : class_name(exported, c.b), kind_name(c.place.constraints),
                      cell(c.gap), joined(c.place.normal, ','), joined(c.place.point, ','),
                      cell(c.force)});
  }
  return text;
}

std::string contacts_vtp(const ExportedBed& exported) {
  const std::vector<Contact> contacts = contacts_of(exported);
  std::string connectivity, offsets;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    connectivity += cell(2 * k) + " " + cell(2 * k + 1) + "\n";
    offsets += cell(2 * k + 2) + "\n";
  }
  const auto end = [&](std::size_t k) {
    const Contact& contact = contacts[k / 2];
    return joined(k % 2 == 0 ? centre_in_box(exported.bed, contact.a) : end_of(exported, contact),
                  ' ');
  };
  return vtp_file(
      "Lines", 2 * contacts.size(), contacts.size(), "d",
      vtp_points(2 * contacts.size(), end) +
          vtp_element("CellData Scalars=\"force\"", contact_arrays(exported, contacts)) +
          vtp_cells("Lines", connectivity, offsets));
}

}  // namespace grainsweep
