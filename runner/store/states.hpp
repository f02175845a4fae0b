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
#include "runner/store/files.hpp"
#include "runner/store/outcome.hpp"

namespace grainsweep {

/// Without the grains and forces of a bed where these were not to be stored. Curves are kept here,
/// not in the journal.
struct StoredBed : SettledBed {
  std::string job;               ///< Job::id
  std::uint64_t state_hash = 0;  ///< PackingResult::state_hash
  Box box;
  Curves curves;
};

/// The packing that such a bed was stored of.
Packing packing_of(StoredBed&& bed, const PackingResult& result);

/// Why a stored bed cannot be used.
struct BedFault {
  std::string file;     ///< of beds; empty where `what` names it
  std::string packing;  ///< id
  std::string what;     ///< "missing", "damaged, or of another version"
};

/// A stored bed that is not there as it was stored.
class BedError : public FileError {
 public:
  explicit BedError(BedFault fault);
  const BedFault& fault() const { return fault_; }

 private:
  BedFault fault_;
};

/// What this error says of the bed of a packing.
BedFault fault_of_bed(const std::string& packing, const FileError& error);

/// A line for each file and fault: "out/shards/1-of-1.beds: packing a1: missing; ", and then what
/// is or should be done, `remedy`. Of many packings it has their number and two ids.
std::vector<std::string> lines_of(const std::vector<BedFault>& faults, std::string_view remedy);

/// The whole bed, checked. Throws BedError if there is none, if it is damaged or of another
/// version, or if it is not the bed of this outcome; FileError if the file cannot be read.
StoredBed read_bed(const std::string& folder, const Outcome& outcome);

/// Checks only the size of the file that holds the bed. Throws BedError if there is no file, or if
/// it ends before the bed does.
void expect_bed(const std::string& folder, const Outcome& outcome,
                const std::optional<std::int64_t>& file_size);

/// A bed's bytes, and back; nothing if they are damaged or of another version.
std::string bed_bytes(const StoredBed& bed);
std::optional<StoredBed> bed_from_bytes(std::string_view bytes);

}  // namespace grainsweep
