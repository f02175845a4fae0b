#include "runner/export/grain_files.hpp"

#include "runner/export/surfaces.hpp"
#include "runner/export/vtp.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

/// `values(k)` of every grain, a line each.
template <class Values>
std::string lines(const StoredBed& bed, Values values) {
  std::string text;
  for (std::size_t k = 0; k < bed.grains.size(); ++k) text += values(k) + "\n";
  return text;
}

std::string position(const SettledGrain& grain) {
  return cell(grain.x) + " " + cell(grain.y) + " " + cell(grain.z);
}

/// The numbers of a grain's orientation, each after a separator; "" for spheres.
std::string orientation(const StoredBed& bed, std::size_t grain, char separator) {
  std::string text;
  if (!bed.turned) return text;
  for (const double part : bed.turned->orientations[grain]) text += separator + cell(part);
  return text;
}

/// The grains that points or faces belong to, by their numbers.
using Owners = std::vector<std::size_t>;

/// The arrays that points and faces have.
std::string grain_arrays(const ExportedBed& exported, const Owners& owners) {
  const auto of_grain = [&](const char* attributes, const auto& value) {
    const auto values = [&](std::size_t k) { return cell(value(owners[k])); };
    return vtp_array(attributes, owners.size(), values);
  };
  const StoredBed& bed = exported.bed;
  const auto& grains = exported.bed.grains;
  return of_grain("type=\"Int64\" Name=\"id\"", id_of) +
         of_grain("type=\"Int32\" Name=\"size_class\"",
                  [&](std::size_t k) { return size_class(exported, k); }) +
         (has_components(bed)
              ? of_grain("type=\"Int32\" Name=\"component\"",
                         [&](std::size_t k) { return bed.turned->component(k) + 1; })
              : "") +
         of_grain("type=\"Int32\" Name=\"coordination\"",
                  [&](std::size_t k) { return grains[k].touching; }) +
         of_grain("type=\"Float64\" Name=\"force\"",
                  [&](std::size_t k) { return grains[k].force; });
}

/// Point data, and one vertex cell per point, so that viewers draw the points without a glyph
/// filter.
std::string spheres_vtp(const ExportedBed& exported) {
  const auto& grains = exported.bed.grains;
  std::string connectivity, offsets;
  Owners owners;
  for (std::size_t point = 0; point < grains.size(); ++point) {
    connectivity += cell(point) + "\n";
    offsets += cell(point + 1) + "\n";
    owners.push_back(point);
  }
  const auto radius = [&](std::size_t k) { return cell(grains[k].radius); };
  return vtp_file(
      "Verts", grains.size(), grains.size(), exported.settings.lengths.unit,
      vtp_points(grains.size(), [&](std::size_t k) { return position(grains[k]); }) +
          vtp_element("PointData Scalars=\"radius\"",
                      vtp_array("type=\"Float64\" Name=\"radius\"", grains.size(), radius) +
                          grain_arrays(exported, owners)) +
          vtp_cells("Verts", connectivity, offsets));
}

/// Faces of all grains: where each ends in the list of corners, and the corners.
std::string faces_vtp(const StoredBed& bed) {
  std::string connectivity, offsets;
  std::size_t corners = 0, first = 0;
  for (std::size_t grain = 0; grain < bed.grains.size(); ++grain) {
    const Mesh& mesh = bed.turned->mesh(grain);
    for (const auto& face : mesh.faces) {
      for (const std::int32_t corner : face) {
        connectivity += cell(first + static_cast<std::size_t>(corner)) + " ";
      }
      connectivity.back() = '\n';
      corners += face.size();
      offsets += cell(corners) + "\n";
    }
    first += mesh.vertices.size();
  }
  return vtp_cells("Polys", connectivity, offsets);
}

/// Spheres of a mixture have 320 triangles.
std::string polygons_vtp(ExportedBed exported) {
  for (Mesh& mesh : exported.bed.turned->meshes) mesh = drawn_mesh(mesh, 2);
  const StoredBed& bed = exported.bed;
  std::vector<Eigen::Vector3d> points;
  Owners owners;
  for (std::size_t i = 0; i < bed.grains.size(); ++i) {
    const auto vertices = vertices_in_box(bed, i);
    points.insert(points.end(), vertices.begin(), vertices.end());
    owners.insert(owners.end(), bed.turned->mesh(i).faces.size(), i);
  }
  const auto point = [&](std::size_t k) {
    return cell(points[k].x()) + " " + cell(points[k].y()) + " " + cell(points[k].z());
  };
  const auto size = [&](std::size_t k) { return cell(2.0 * bed.grains[owners[k]].radius); };
  return vtp_file("Polys", points.size(), owners.size(), exported.settings.lengths.unit,
                  vtp_points(points.size(), point) +
                      vtp_element("CellData Scalars=\"size\"",
                                  vtp_array("type=\"Float64\" Name=\"size\"", owners.size(), size) +
                                      grain_arrays(exported, owners)) +
                      faces_vtp(bed));
}

}  // namespace

std::string grains_csv(const ExportedBed& in_d) {
  const ExportedBed exported = scaled(in_d);
  const StoredBed& bed = exported.bed;
  const std::string turned = bed.turned ? ",qx,qy,qz,qw" : "";
  const std::string component = has_components(bed) ? ",component" : "";
  return "id,size_class,x,y,z,radius,force,coordination" + turned + component + "\n" +
         lines(bed, [&](std::size_t k) {
           const SettledGrain& grain = bed.grains[k];
           return cell(id_of(k)) + "," + class_name(exported, k) + "," + cell(grain.x) + "," +
                  cell(grain.y) + "," + cell(grain.z) + "," + cell(grain.radius) + "," +
                  cell(grain.force) + "," + cell(grain.touching) + orientation(bed, k, ',') +
                  component_text(bed, k, ',');
         });
}

std::string grains_xyz(const ExportedBed& in_d) {
  const ExportedBed exported = scaled(in_d);
  const StoredBed& bed = exported.bed;
  const auto flag = [](Boundary boundary) { return boundary == Boundary::periodic ? "T" : "F"; };
  const std::string turned = bed.turned ? ":orientation:R:4" : "";
  const std::string component = has_components(bed) ? ":component:I:1" : "";
  const std::string comment =
      "Lattice=\"" + cell(bed.box.length) + " 0 0 0 " + cell(bed.box.width) + " 0 0 0 " +
      cell(height_of(bed)) +
      "\" Properties=species:S:1:pos:R:3:id:I:1:size_class:I:1:radius:R:1:coordination:I:1:force:"
      "R:1" +
      turned + component + " pbc=\"" + flag(bed.box.x) + " " + flag(bed.box.y) +
      " F\" length_unit=" + exported.settings.lengths.unit + "\n";
  return cell(bed.grains.size()) + "\n" + comment + lines(bed, [&](std::size_t k) {
           const SettledGrain& grain = bed.grains[k];
           return "X " + position(grain) + " " + cell(id_of(k)) + " " +
                  cell(size_class(exported, k)) + " " + cell(grain.radius) + " " +
                  cell(grain.touching) + " " + cell(grain.force) + orientation(bed, k, ' ') +
                  component_text(bed, k, ' ');
         });
}

std::string grains_vtp(const ExportedBed& exported) {
  return exported.bed.turned ? polygons_vtp(scaled(exported)) : spheres_vtp(scaled(exported));
}

}  // namespace grainsweep
