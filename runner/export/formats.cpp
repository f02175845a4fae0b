#include "runner/export/formats.hpp"

#include <algorithm>

#include "runner/export/certificate.hpp"
#include "runner/export/contacts.hpp"
#include "runner/export/grain_files.hpp"
#include "runner/export/lammps.hpp"
#include "runner/export/surface_files.hpp"
#include "runner/export/voxels.hpp"

namespace grainsweep {

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {"csv", ".csv", grains_csv},
      {"xyz", ".xyz", grains_xyz},
      {"vtp", ".vtp", grains_vtp},
      {"contacts", ".contacts.csv", contacts_csv},
      {"contacts-vtp", ".contacts.vtp", contacts_vtp},
      {"lammps", ".data", lammps_data, fault_for_lammps},
      {"stl", ".stl", surfaces_stl},
      {"obj", ".obj", surfaces_obj},
      {"voxels", ".nrrd", voxels_nrrd},
      {"certificate", ".certificate.json", certificate_json, fault_for_certificate}};
  return formats;
}

const ExportFormat* export_format(std::string_view name) {
  const auto& formats = export_formats();
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const ExportFormat& format) { return format.name == name; });
  return found == formats.end() ? nullptr : &*found;
}

}  // namespace grainsweep
