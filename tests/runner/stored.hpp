// Output folders as runs would leave them, without packing anything.
#pragma once

#include <string>
#include <unistd.h>

#include "runner/store/files.hpp"
#include "runner/store/shard_files.hpp"

namespace grainsweep {

/// Of this process; it began at `started`.
inline RunRecord sample_run(const std::string& started = "2026-01-01T00:00:00Z") {
  RunRecord run;
  run.started = started;
  run.host = "node";
  run.process = "node-" + std::to_string(getpid());
  return run;
}

/// Adds outcomes without beds, one behind the other.
inline void add_outcomes(const std::string& folder, const std::vector<Outcome>& outcomes,
                         const Shard& shard = {}) {
  ShardFiles files(folder, shard, sample_run());
  for (const Outcome& outcome : outcomes) files.add(outcome);
  files.flush();
}

/// The bed of an outcome with so many grains and these curves.
inline StoredBed bed_of(const Outcome& outcome, std::size_t grains = 1, Curves curves = {}) {
  StoredBed bed;
  bed.job = outcome.job;
  bed.state_hash = outcome.result.state_hash;
  bed.grains.resize(grains);
  bed.curves = std::move(curves);
  return bed;
}

/// Adds a bed, and tells the outcome where.
inline void add_stored_bed(const std::string& folder, const StoredBed& bed, Outcome& outcome,
                           const Shard& shard = {}) {
  ShardFiles files(folder, shard, sample_run());
  files.add_bed(bed, outcome);
  files.flush();
}

/// Flips a bit of the byte at this place of a bed.
inline void damage_bed(const std::string& folder, const Outcome& outcome, std::int64_t place) {
  const std::string path = beds_path(folder, outcome.shard);
  std::string bytes = read_file(path);
  char& byte = bytes.at(static_cast<std::size_t>(outcome.stored_at + place));
  byte = static_cast<char>(byte ^ 1);
  replace_file(path, bytes);
}

}  // namespace grainsweep
