#include "runner/export/vtp.hpp"

#include <string_view>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

std::string data_array(const std::string& attributes, const std::string& values) {
  return "<DataArray " + attributes + " format=\"ascii\">\n" + values + "</DataArray>\n";
}

}  // namespace

std::string vtp_array(const std::string& attributes, std::size_t size,
                      const std::function<std::string(std::size_t)>& value) {
  std::string values;
  for (std::size_t k = 0; k < size; ++k) values += value(k) + "\n";
  return data_array(attributes, values);
}

std::string vtp_points(std::size_t size, const std::function<std::string(std::size_t)>& point) {
  return vtp_element(
      "Points",
      vtp_array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", size, point));
}

std::string vtp_element(const std::string& name, const std::string& content) {
  return "<" + name + ">\n" + content + "</" + name.substr(0, name.find(' ')) + ">\n";
}

std::string vtp_cells(const std::string& kind, const std::string& connectivity,
                      const std::string& offsets) {
  return vtp_element(kind, data_array("type=\"Int64\" Name=\"connectivity\"", connectivity) +
                               data_array("type=\"Int64\" Name=\"offsets\"", offsets));
}

std::string vtp_file(const char* kind, std::size_t points, std::size_t cells,
                     const std::string& unit, const std::string& content) {
  std::string counts = " NumberOfPoints=\"" + cell(points) + "\"";
  for (const char* known : {"Verts", "Lines", "Strips", "Polys"}) {
    const std::size_t count = std::string_view(known) == kind ? cells : 0;
    counts += std::string(" NumberOf") + known + "=\"" + cell(count) + "\"";
  }
  return "<?xml version=\"1.0\"?>\n<!-- grainsweep, lengths in " + unit +
         " -->\n<VTKFile type=\"PolyData\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece" +
         counts + ">\n" + content + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace grainsweep
