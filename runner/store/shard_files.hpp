// What a runner adds to an output folder: finished packings, and that it is at work.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "runner/store/journal.hpp"
#include "runner/store/lock.hpp"
#include "runner/store/shard.hpp"
#include "runner/store/states.hpp"

namespace grainsweep {

/// The files of one shard, open to add to them. What was added is on the disk after flush(), the
/// beds first: a journal line promises that its bed is there. Every function throws FileError.
class ShardFiles {
 public:
  /// Takes the shard and notes in its journal that `run` has begun. Makes the folder shards if
  /// missing. Throws FolderBusy if another runner works on it, or on one of another division of the
  /// sweep, which overlaps with it.
  ShardFiles(const std::string& folder, const Shard& shard, const RunRecord& run);

  /// Whatever is added for this outcome's job from now on counts more than this outcome, in
  /// whichever journal it is: it was finished later, even where a clock was set back.
  void count_after(const Outcome& known);

  /// Sets where the bed is stored. To be followed by add(outcome).
  void add_bed(const StoredBed& bed, Outcome& outcome);
  /// Returns the outcome as it is written, with the time that makes it count.
  Outcome add(Outcome outcome);
  void add(const RunRecord& run);
  void flush();

  /// Says that the runner is alive, see runner/store/runners.hpp.
  void beat() const;

  /// False where the file system offers no locks: the shard is worked on without one.
  bool is_locked() const { return lock_.is_held(); }
  const std::string& name() const { return name_; }

  /// Forgets all that is stored in the folder, of all shards, and notes `run` again. For the shard
  /// 1-of-1 only.
  void remove_all(const RunRecord& run);

 private:
  std::string folder_;
  FileLock lock_;
  std::string name_;
  std::string beds_, lines_;                          ///< added and not yet in the files
  std::int64_t beds_end_ = 0;                         ///< where the next bed begins in the file
  std::unordered_map<std::string, double> known_at_;  ///< Outcome::finished_at, by job
};

}  // namespace grainsweep
