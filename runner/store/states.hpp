// The curves and grains of each finished bed, so that neither tables nor exporting pack again.
//
// states/<job>.grains, little-endian: "GRAINS2\n", or "GRAINS3\n" if grains are turned; u64 bytes
// of curves; curves as of put_curves; u32 CRC-32 of all before, so that curves are read without the
// grains; u64 number of grains; f64 box length, box width; u8 x walled, y walled; per grain f64 x,
// y, z, radius, force, i32 touching; of turned grains orientations and mesh as of put_turned; u32
// CRC-32 of all before. Units as in SettledGrain and PackingResult.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/results.hpp"
#include "engine/scene/box.hpp"
#include "runner/store/curves.hpp"

namespace grainsweep {

struct StoredBed {
  Box box;
  std::vector<SettledGrain> grains;
  Curves curves = {};
  std::optional<Turned> turned = {};  ///< unless they are spheres; an orientation per grain
};

/// <folder>/states/<job>.grains
std::string state_path(const std::string& folder, const std::string& job);

/// Replaces the file as a whole and flushes it. Makes the folder states if missing.
void write_bed(const std::string& folder, const std::string& job, const StoredBed& bed);

/// Throws FileError if there is no such file, or if it is damaged.
StoredBed read_bed(const std::string& folder, const std::string& job);

/// The curves alone, without a look at the grains: nothing if there is no such file, if the curves
/// are damaged, or if a version of the program with another form of them wrote it. Throws FileError
/// if the file cannot be read.
std::optional<Curves> read_curves(const std::string& folder, const std::string& job);

/// The file's bytes, and back; `path` is named in the FileError about damaged bytes.
std::string bed_bytes(const StoredBed& bed);
StoredBed bed_from_bytes(std::string_view bytes, const std::string& path);

}  // namespace grainsweep
