// The curves, grains and forces of each finished bed, so that neither tables nor exports need to
// pack again.
//
// They stand one after the other in shards/<shard>.beds; each outcome says where its own is. A bed
// is "GRAINS14\n", a StoredBed in the form of runner/store/archive.hpp, in the order of its members
// and of those of the engine's structs in states.cpp, and a CRC-32 of all before. Units as in
// SettledGrain and PackingResult. What a killed run has left between beds is never read.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/results.hpp"
#include "engine/scene/box.hpp"
#include "runner/store/outcome.hpp"

namespace grainsweep {

/// The curves and lists of a packing, by far the largest part of what is measured: kept with its
/// grains, not in the journal. Members as in PackingResult and its Order; empty if nothing was
/// measured.
struct Curves {
  Profile profile_x;
  Profile profile_y;
  Profile profile_from_walls;
  Profile profile_z;
  Curve pair_correlation;
  Curve force_density;
  std::vector<SizeRow> sizes;
  std::vector<ComponentMeasure> components;
};

Curves curves_of(const PackingResult& result);
void set_curves(Curves&& curves, PackingResult& result);

/// A force that two grains exert on each other.
struct StoredForce {
  std::int32_t a = 0, b = 0;  ///< numbers of the grains, from 0
  double magnitude = 0.0;     ///< m g
};

std::vector<StoredForce> stored_forces(const std::vector<PairForce>& forces);

struct StoredBed {
  std::string job;               ///< Job::id
  std::uint64_t state_hash = 0;  ///< PackingResult::state_hash
  Box box;
  Curves curves;
  std::vector<SettledGrain> grains;
  std::optional<Turned> turned;  ///< for non-spherical grains; an orientation per grain
  std::vector<StoredForce> forces;
  std::vector<WallForce> wall_forces;
  /// One for each of `forces` and `wall_forces`; empty for spheres.
  std::vector<ForceLine> lines = {}, wall_lines = {};
  std::vector<std::array<double, 4>> axes = {};  ///< as in Packing
};

/// The packing that such a bed was stored of.
Packing packing_of(StoredBed&& bed, const PackingResult& result);

/// The whole bed, checked. Throws FileError if there is none, if it is damaged or of another
/// version, or if it is not the bed of this outcome.
StoredBed read_bed(const std::string& folder, const Outcome& outcome);

/// Checks only the size of the file that holds the bed. Throws FileError if there is no file, or if
/// it ends before the bed does.
void expect_bed(const std::string& folder, const Outcome& outcome,
                const std::optional<std::int64_t>& file_size);

/// A bed's bytes, and back; nothing if they are damaged or of another version.
std::string bed_bytes(const StoredBed& bed);
std::optional<StoredBed> bed_from_bytes(std::string_view bytes);

}  // namespace grainsweep
