// The formats that beds are exported in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

struct ExportFormat {
  std::string_view name;    ///< as in --format
  std::string_view ending;  ///< of its files
  std::string (*text)(const ExportedBed&);
  /// Why the format cannot hold grains of these shapes; "" if it can. Null where it holds all.
  std::string (*fault)(const StoredBed&) = nullptr;
};

/// All of them.
const std::vector<ExportFormat>& export_formats();

/// The one of that name, or null.
const ExportFormat* export_format(std::string_view name);

}  // namespace grainsweep
