#include "runner/store/states.hpp"

#include <cstdint>
#include <string_view>

#include "runner/store/bytes.hpp"
#include "runner/store/checksum.hpp"
#include "runner/store/files.hpp"

namespace grainsweep {
namespace {

constexpr std::string_view magic = "GRAINS1\n";
constexpr std::size_t header_size = 8 + 8 + 16 + 2;
constexpr std::size_t grain_size = 5 * 8 + 4;
constexpr std::size_t checksum_size = 4;

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

bool is_whole(std::string_view bytes) {
  if (bytes.size() < header_size + checksum_size || !bytes.starts_with(magic)) return false;
  std::string_view end = bytes.substr(bytes.size() - checksum_size);
  return take<std::uint32_t>(end) == crc32(bytes.substr(0, bytes.size() - checksum_size));
}

}  // namespace

std::string state_path(const std::string& folder, const std::string& job) {
  return folder + "/states/" + job + ".grains";
}

std::string bed_bytes(const StoredBed& bed) {
  std::string bytes(magic);
  bytes.reserve(header_size + bed.grains.size() * grain_size + checksum_size);
  put(bytes, static_cast<std::uint64_t>(bed.grains.size()));
  put(bytes, bed.box.length);
  put(bytes, bed.box.width);
  put(bytes, static_cast<std::uint8_t>(bed.box.x == Boundary::walls));
  put(bytes, static_cast<std::uint8_t>(bed.box.y == Boundary::walls));
  for (const SettledGrain& grain : bed.grains) put_grain(bytes, grain);
  put(bytes, crc32(bytes));
  return bytes;
}

StoredBed bed_from_bytes(std::string_view bytes, const std::string& path) {
  const std::string damaged = "damaged; remove it and run the sweep again to make it anew";
  if (!is_whole(bytes)) throw FileError(path, damaged);
  std::string_view rest = bytes.substr(magic.size(), bytes.size() - magic.size() - checksum_size);
  const auto count = take<std::uint64_t>(rest);
  StoredBed bed;
  bed.box.length = take_double(rest);
  bed.box.width = take_double(rest);
  bed.box.x = take_boundary(rest);
  bed.box.y = take_boundary(rest);
  if (rest.size() != count * grain_size) throw FileError(path, damaged);
  bed.grains.reserve(count);
  for (std::uint64_t grain = 0; grain < count; ++grain) bed.grains.push_back(take_grain(rest));
  return bed;
}

void write_bed(const std::string& folder, const std::string& job, const StoredBed& bed) {
  make_folder(folder + "/states");
  replace_file(state_path(folder, job), bed_bytes(bed));
}

StoredBed read_bed(const std::string& folder, const std::string& job) {
  const std::string path = state_path(folder, job);
  return bed_from_bytes(read_file(path), path);
}

}  // namespace grainsweep
