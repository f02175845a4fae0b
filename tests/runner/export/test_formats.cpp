#include <set>
#include <string_view>

#include <catch2/catch.hpp>

#include "runner/export/formats.hpp"

namespace grainsweep {
namespace {

TEST_CASE("every format is found by its name, and no two write the same files") {
  std::set<std::string_view> endings;
  for (const ExportFormat& format : export_formats()) {
    CHECK(export_format(format.name) == &format);
    CHECK(endings.insert(format.ending).second);
  }
  CHECK(export_format("VTP") == nullptr);
}

TEST_CASE("an empty bed is written in every format") {
  const ExportedBed none;
  for (const ExportFormat& format : export_formats()) CHECK_FALSE(format.text(none).empty());
}

}  // namespace
}  // namespace grainsweep
