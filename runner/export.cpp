#include "runner/export.hpp"

#include <algorithm>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

/// z of the highest point of a grain, d.
double height_of(const StoredBed& bed) {
  double height = 0.0;
  for (const SettledGrain& grain : bed.grains) height = std::max(height, grain.z + grain.radius);
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

std::string data_array(const std::string& attributes, const std::string& values) {
  return "<DataArray " + attributes + " format=\"ascii\">\n" + values + "</DataArray>\n";
}

std::string vtp_points(const StoredBed& bed) {
  return "<Points>\n" +
         data_array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"",
                    lines(bed, position)) +
         "</Points>\n";
}

std::string vtp_point_data(const StoredBed& bed) {
  const auto radius = [](const SettledGrain& grain) { return cell(grain.radius); };
  const auto coordination = [](const SettledGrain& grain) { return cell(grain.touching); };
  const auto force = [](const SettledGrain& grain) { return cell(grain.force); };
  return "<PointData Scalars=\"radius\">\n" +
         data_array("type=\"Float64\" Name=\"radius\"", lines(bed, radius)) +
         data_array("type=\"Int32\" Name=\"coordination\"", lines(bed, coordination)) +
         data_array("type=\"Float64\" Name=\"force\"", lines(bed, force)) + "</PointData>\n";
}

/// One vertex cell per point, so that viewers draw the points without a glyph filter.
std::string vtp_vertices(const StoredBed& bed) {
  std::string connectivity, offsets;
  for (std::size_t point = 0; point < bed.grains.size(); ++point) {
    connectivity += cell(point) + "\n";
    offsets += cell(point + 1) + "\n";
  }
  return "<Verts>\n" + data_array("type=\"Int64\" Name=\"connectivity\"", connectivity) +
         data_array("type=\"Int64\" Name=\"offsets\"", offsets) + "</Verts>\n";
}

}  // namespace

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
  return "x,y,z,radius,force,coordination\n" + lines(bed, [](const SettledGrain& grain) {
           return cell(grain.x) + "," + cell(grain.y) + "," + cell(grain.z) + "," +
                  cell(grain.radius) + "," + cell(grain.force) + "," + cell(grain.touching);
         });
}

std::string grains_xyz(const StoredBed& bed) {
  const auto flag = [](Boundary boundary) { return boundary == Boundary::periodic ? "T" : "F"; };
  const std::string comment =
      "Lattice=\"" + cell(bed.box.length) + " 0 0 0 " + cell(bed.box.width) + " 0 0 0 " +
      cell(height_of(bed)) +
      "\" Properties=species:S:1:pos:R:3:radius:R:1:coordination:I:1:force:R:1 pbc=\"" +
      flag(bed.box.x) + " " + flag(bed.box.y) + " F\"\n";
  return cell(bed.grains.size()) + "\n" + comment + lines(bed, [](const SettledGrain& grain) {
           return "grain " + position(grain) + " " + cell(grain.radius) + " " +
                  cell(grain.touching) + " " + cell(grain.force);
         });
}

std::string grains_vtp(const StoredBed& bed) {
  const std::string count = cell(bed.grains.size());
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece "
         "NumberOfPoints=\"" +
         count + "\" NumberOfVerts=\"" + count +
         "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n" + vtp_points(bed) +
         vtp_point_data(bed) + vtp_vertices(bed) + "</Piece>\n</PolyData>\n</VTKFile>\n";
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
