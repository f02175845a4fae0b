#include "runner/store/states.hpp"

#include <cstdint>
#include <limits>
#include <stdexcept>

#include "runner/store/bytes.hpp"
#include "runner/store/checksum.hpp"
#include "runner/store/files.hpp"
#include "runner/store/turned.hpp"

namespace grainsweep {
namespace {

constexpr std::string_view magic_of_spheres = "GRAINS2\n";
constexpr std::string_view magic_of_turned = "GRAINS3\n";
constexpr std::size_t start_size = 8 + 8;
constexpr std::size_t grains_header_size = 8 + 16 + 2;
constexpr std::size_t grain_size = 5 * 8 + 4;

void put_grain(std::string& bytes, const SettledGrain& grain) {
  for (const double value : {grain.x, grain.y, grain.z, grain.radius, grain.force}) {
    put(bytes, value);
  }
  put(bytes, static_cast<std::uint32_t>(grain.touching));
}

SettledGrain take_grain(std::string_view& bytes) {
  SettledGrain grain;
  for (double* value : {&grain.x, &grain.y, &grain.z, &grain.radius, &grain.force}) {
    *value = take_double(bytes);
  }
  grain.touching = static_cast<std::int32_t>(take<std::uint32_t>(bytes));
  return grain;
}

Boundary take_boundary(std::string_view& bytes) {
  return take<std::uint8_t>(bytes) != 0 ? Boundary::walls : Boundary::periodic;
}

/// Size of the file's part up to the checksum of the curves; nothing if it does not begin right.
std::optional<std::size_t> size_of_first_part(std::string_view start) {
  const bool is_ours = start.starts_with(magic_of_spheres) || start.starts_with(magic_of_turned);
  if (start.size() < start_size || !is_ours) return std::nullopt;
  start.remove_prefix(magic_of_spheres.size());
  const auto curves = take<std::uint64_t>(start);
  constexpr std::uint64_t rest_size = start_size + checksum_size;
  if (curves > std::numeric_limits<std::uint64_t>::max() - rest_size) return std::nullopt;
  return curves + rest_size;
}

/// The curves in the first part of a file; nothing if it is damaged.
std::optional<Curves> curves_in(std::string_view first_part) {
  if (!ends_in_its_checksum(first_part)) return std::nullopt;
  std::string_view bytes = first_part.substr(start_size);
  bytes.remove_suffix(checksum_size);
  try {
    Curves curves = take_curves(bytes);
    return bytes.empty() ? std::optional(std::move(curves)) : std::nullopt;
  } catch (const std::length_error&) {
    return std::nullopt;
  }
}

/// False if what follows the grains is damaged.
bool take_turned_into(StoredBed& bed, std::string_view& rest) {
  try {
    bed.turned = take_turned(rest, bed.grains.size());
    return true;
  } catch (const std::logic_error&) {
    return false;
  }
}

/// The bed in a whole file; nothing if it is damaged.
std::optional<StoredBed> bed_in(std::string_view bytes) {
  const auto first_size = size_of_first_part(bytes);
  if (!first_size || *first_size > bytes.size() || !ends_in_its_checksum(bytes)) return {};
  auto curves = curves_in(bytes.substr(0, *first_size));
  std::string_view rest = bytes.substr(*first_size);
  if (!curves || rest.size() < grains_header_size + checksum_size) return std::nullopt;
  rest.remove_suffix(checksum_size);
  const auto count = take<std::uint64_t>(rest);
  StoredBed bed;
  bed.curves = std::move(*curves);
  bed.box.length = take_double(rest);
  bed.box.width = take_double(rest);
  bed.box.x = take_boundary(rest);
  bed.box.y = take_boundary(rest);
  if (count > rest.size() / grain_size) return std::nullopt;
  bed.grains.reserve(count);
  for (std::uint64_t grain = 0; grain < count; ++grain) bed.grains.push_back(take_grain(rest));
  if (bytes.starts_with(magic_of_turned) && !take_turned_into(bed, rest)) return std::nullopt;
  return rest.empty() ? std::optional(std::move(bed)) : std::nullopt;
}

}  // namespace

std::string state_path(const std::string& folder, const std::string& job) {
  return folder + "/states/" + job + ".grains";
}

std::string bed_bytes(const StoredBed& bed) {
  std::string curves;
  put_curves(curves, bed.curves);
  std::string bytes(bed.turned ? magic_of_turned : magic_of_spheres);
  bytes.reserve(start_size + curves.size() + grains_header_size + bed.grains.size() * grain_size +
                2 * checksum_size);
  put_text(bytes, curves);
  put(bytes, crc32(bytes));
  put(bytes, static_cast<std::uint64_t>(bed.grains.size()));
  put(bytes, bed.box.length);
  put(bytes, bed.box.width);
  put(bytes, static_cast<std::uint8_t>(bed.box.x == Boundary::walls));
  put(bytes, static_cast<std::uint8_t>(bed.box.y == Boundary::walls));
  for (const SettledGrain& grain : bed.grains) put_grain(bytes, grain);
  if (bed.turned) put_turned(bytes, *bed.turned);
  put(bytes, crc32(bytes));
  return bytes;
}

StoredBed bed_from_bytes(std::string_view bytes, const std::string& path) {
  if (auto bed = bed_in(bytes)) return std::move(*bed);
  throw FileError(path,
                  "damaged, or of another version; remove it and run the sweep again to make it "
                  "anew");
}

void write_bed(const std::string& folder, const std::string& job, const StoredBed& bed) {
  make_folder(folder + "/states");
  replace_file(state_path(folder, job), bed_bytes(bed));
}

StoredBed read_bed(const std::string& folder, const std::string& job) {
  const std::string path = state_path(folder, job);
  return bed_from_bytes(read_file(path), path);
}

std::optional<Curves> read_curves(const std::string& folder, const std::string& job) {
  const std::string path = state_path(folder, job);
  if (!file_exists(path)) return std::nullopt;
  const auto size = size_of_first_part(read_start(path, start_size));
  if (!size) return std::nullopt;
  const std::string first_part = read_start(path, *size);
  return first_part.size() == *size ? curves_in(first_part) : std::nullopt;
}

}  // namespace grainsweep
