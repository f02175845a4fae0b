#include "runner/tables/grain_files.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

double top_of(const StoredBed& bed, std::size_t grain) {
  if (!bed.turned) return bed.grains[grain].z + bed.grains[grain].radius;
  double top = 0.0;
  for (const Eigen::Vector3d& vertex : vertices_in_box(bed, grain)) top = std::max(top, vertex.z());
  return top;
}

/// z of the highest point of a grain, d.
double height_of(const StoredBed& bed) {
  double height = 0.0;
  for (std::size_t i = 0; i < bed.grains.size(); ++i) height = std::max(height, top_of(bed, i));
  return height;
}

/// `values(grain)` of every grain, a line each.
template <class Values>
std::string lines(const StoredBed& bed, Values values) {
  std::string text;
  for (const SettledGrain& grain : bed.grains) text += values(grain) + "\n";
  return text;
}

std::string position(const SettledGrain& grain) {
  return cell(grain.x) + " " + cell(grain.y) + " " + cell(grain.z);
}

/// The numbers of a grain's orientation, each behind a separator; "" for spheres.
std::string orientation(const StoredBed& bed, const SettledGrain& grain, char separator) {
  std::string text;
  if (!bed.turned) return text;
  const auto index = static_cast<std::size_t>(&grain - bed.grains.data());
  for (const double part : bed.turned->orientations[index]) text += separator + cell(part);
  return text;
}

std::string data_array(const std::string& attributes, const std::string& values) {
  return "<DataArray " + attributes + " format=\"ascii\">\n" + values + "</DataArray>\n";
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">\n" + content + "</" + name + ">\n";
}

std::string vtp_points(const std::string& points) {
  return element("Points",
                 data_array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", points));
}

std::string vtp_cells(const std::string& kind, const std::string& connectivity,
                      const std::string& offsets) {
  return element(kind, data_array("type=\"Int64\" Name=\"connectivity\"", connectivity) +
                           data_array("type=\"Int64\" Name=\"offsets\"", offsets));
}

/// One of the parts of the file, with `points` points and `cells` cells of one kind.
std::string vtp_file(const char* kind, std::size_t points, std::size_t cells,
                     const std::string& content) {
  std::string counts = " NumberOfPoints=\"" + cell(points) + "\"";
  for (const char* known : {"Verts", "Lines", "Strips", "Polys"}) {
    const std::size_t count = std::string_view(known) == kind ? cells : 0;
    counts += std::string(" NumberOf") + known + "=\"" + cell(count) + "\"";
  }
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece" +
         counts + ">\n" + content + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

/// An array with `repeats` times the value of each grain.
template <class Value>
std::string vtp_array(const StoredBed& bed, const std::string& attributes, std::size_t repeats,
                      Value value) {
  return data_array(attributes, lines(bed, [&](const SettledGrain& grain) {
                      std::string text = cell(value(grain));
                      const std::string once = " " + text;
                      for (std::size_t k = 1; k < repeats; ++k) text += once;
                      return text;
                    }));
}

std::string vtp_contacts(const StoredBed& bed, std::size_t repeats) {
  const auto coordination = [](const SettledGrain& grain) { return grain.touching; };
  const auto force = [](const SettledGrain& grain) { return grain.force; };
  return vtp_array(bed, "type=\"Int32\" Name=\"coordination\"", repeats, coordination) +
         vtp_array(bed, "type=\"Float64\" Name=\"force\"", repeats, force);
}

/// Point data, and one vertex cell per point, so that viewers draw the points without a glyph
/// filter.
std::string spheres_vtp(const StoredBed& bed) {
  const auto radius = [](const SettledGrain& grain) { return grain.radius; };
  std::string connectivity, offsets;
  for (std::size_t point = 0; point < bed.grains.size(); ++point) {
    connectivity += cell(point) + "\n";
    offsets += cell(point + 1) + "\n";
  }
  return vtp_file("Verts", bed.grains.size(), bed.grains.size(),
                  vtp_points(lines(bed, position)) + "<PointData Scalars=\"radius\">\n" +
                      vtp_array(bed, "type=\"Float64\" Name=\"radius\"", 1, radius) +
                      vtp_contacts(bed, 1) + "</PointData>\n" +
                      vtp_cells("Verts", connectivity, offsets));
}

/// The vertices of the mesh where the grain is.
std::string corners_of(const StoredBed& bed, std::size_t grain) {
  std::string text;
  for (const Eigen::Vector3d& p : vertices_in_box(bed, grain)) {
    text += cell(p.x()) + " " + cell(p.y()) + " " + cell(p.z()) + "\n";
  }
  return text;
}

/// Faces of all grains: where each ends in the list of corners, and the corners.
std::string faces_vtp(const StoredBed& bed, const Mesh& mesh) {
  std::string connectivity, offsets;
  std::size_t corners = 0;
  for (std::size_t grain = 0; grain < bed.grains.size(); ++grain) {
    const std::size_t first = grain * mesh.vertices.size();
    for (const auto& face : mesh.faces) {
      for (const std::int32_t corner : face) {
        connectivity += cell(first + static_cast<std::size_t>(corner)) + " ";
      }
      connectivity.back() = '\n';
      corners += face.size();
      offsets += cell(corners) + "\n";
    }
  }
  return vtp_cells("Polys", connectivity, offsets);
}

std::string polygons_vtp(const StoredBed& bed, const Turned& turned) {
  const auto size = [](const SettledGrain& grain) { return 2.0 * grain.radius; };
  const std::size_t grains = bed.grains.size(), faces = turned.mesh.faces.size();
  std::string points, numbers;
  for (std::size_t i = 0; i < grains; ++i) {
    points += corners_of(bed, i);
    for (std::size_t k = 0; k < faces; ++k) numbers += cell(i) + (k + 1 < faces ? " " : "\n");
  }
  return vtp_file("Polys", grains * turned.mesh.vertices.size(), grains * faces,
                  vtp_points(points) + "<CellData Scalars=\"size\">\n" +
                      data_array("type=\"Int64\" Name=\"grain\"", numbers) +
                      vtp_array(bed, "type=\"Float64\" Name=\"size\"", faces, size) +
                      vtp_contacts(bed, faces) + "</CellData>\n" + faces_vtp(bed, turned.mesh));
}

}  // namespace

std::vector<Eigen::Vector3d> vertices_in_box(const StoredBed& bed, std::size_t grain) {
  const SettledGrain& at = bed.grains[grain];
  const auto& [qx, qy, qz, qw] = bed.turned->orientations[grain];
  const Eigen::Quaterniond turn(qw, qx, qy, qz);
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& [x, y, z] : bed.turned->mesh.vertices) {
    const Eigen::Vector3d turned = turn * Eigen::Vector3d(x, y, z);
    vertices.emplace_back(Eigen::Vector3d(at.x, at.y, at.z) + 2.0 * at.radius * turned);
  }
  return vertices;
}

const char* name_of(ExportFormat format) {
  switch (format) {
    case ExportFormat::csv:
      return "csv";
    case ExportFormat::xyz:
      return "xyz";
    case ExportFormat::vtp:
      return "vtp";
  }
  return "";
}

std::optional<ExportFormat> export_format(std::string_view name) {
  for (const auto format : {ExportFormat::csv, ExportFormat::xyz, ExportFormat::vtp}) {
    if (name == name_of(format)) return format;
  }
  return std::nullopt;
}

std::string grains_csv(const StoredBed& bed) {
  const std::string turned = bed.turned ? ",qx,qy,qz,qw" : "";
  return "x,y,z,radius,force,coordination" + turned + "\n" +
         lines(bed, [&](const SettledGrain& grain) {
           return cell(grain.x) + "," + cell(grain.y) + "," + cell(grain.z) + "," +
                  cell(grain.radius) + "," + cell(grain.force) + "," + cell(grain.touching) +
                  orientation(bed, grain, ',');
         });
}

std::string grains_xyz(const StoredBed& bed) {
  const auto flag = [](Boundary boundary) { return boundary == Boundary::periodic ? "T" : "F"; };
  const std::string turned = bed.turned ? ":orientation:R:4" : "";
  const std::string comment =
      "Lattice=\"" + cell(bed.box.length) + " 0 0 0 " + cell(bed.box.width) + " 0 0 0 " +
      cell(height_of(bed)) +
      "\" Properties=species:S:1:pos:R:3:radius:R:1:coordination:I:1:force:R:1" + turned +
      " pbc=\"" + flag(bed.box.x) + " " + flag(bed.box.y) + " F\"\n";
  return cell(bed.grains.size()) + "\n" + comment + lines(bed, [&](const SettledGrain& grain) {
           return "grain " + position(grain) + " " + cell(grain.radius) + " " +
                  cell(grain.touching) + " " + cell(grain.force) + orientation(bed, grain, ' ');
         });
}

std::string grains_vtp(const StoredBed& bed) {
  return bed.turned ? polygons_vtp(bed, *bed.turned) : spheres_vtp(bed);
}

std::string grains_text(const StoredBed& bed, ExportFormat format) {
  switch (format) {
    case ExportFormat::csv:
      return grains_csv(bed);
    case ExportFormat::xyz:
      return grains_xyz(bed);
    case ExportFormat::vtp:
      return grains_vtp(bed);
  }
  return "";
}

}  // namespace grainsweep
