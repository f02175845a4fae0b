// A packing under way, on the disk, so that a long one goes on where it was stopped.
//
// Each running packing has two files, checkpoints/<job>.0 and .1, written in turn, so that one is
// whole whatever happens to the other. A file is "GRAINCP2", a NumberedCheckpoint in the form of
// runner/store/archive.hpp, and a CRC-32 of all before. Files that are torn, changed, of another
// job or made by another build of the program are never used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace grainsweep {

struct Checkpoint {
  std::int64_t step = 0;     ///< steps the packing has taken
  double cpu_seconds = 0.0;  ///< spent on it so far, in all runs
  std::string state;         ///< bytes of Progress::save
};

/// The checkpoints of one packing.
class CheckpointFiles {
 public:
  /// `build` names the program that may go on from them: a saved state is no exchange format.
  CheckpointFiles(const std::string& folder, std::string job, std::string build);

  /// The newest whole one; nothing if there is none. Throws FileError if one cannot be read, or if
  /// none is whole.
  std::optional<Checkpoint> newest();

  /// Returns once it is on the disk. Makes the folder checkpoints if missing. Throws FileError.
  void write(const Checkpoint& checkpoint);

  /// Removes both files. Returns which of them it could not and why, lines for people.
  std::vector<std::string> remove() const;

 private:
  std::string path(std::uint64_t number) const;

  std::string folder_, job_, build_;
  std::uint64_t next_ = 0;  ///< number of the checkpoint to be written next
};

/// A checkpoint as its file holds it.
struct NumberedCheckpoint {
  std::uint64_t number = 0;
  std::string job, build;
  Checkpoint checkpoint;
};

/// The file's bytes, and back; nothing if they are not what was written.
std::string checkpoint_bytes(const NumberedCheckpoint& numbered);
std::optional<NumberedCheckpoint> checkpoint_from_bytes(std::string_view bytes);

/// How many packings have checkpoints in an output folder.
std::size_t saved_packings(const std::string& folder);

/// Removes the checkpoints of these jobs, or of all. Returns which it could not remove, as above.
/// Throws FileError if the folder cannot be listed.
std::vector<std::string> remove_checkpoints_of(const std::string& folder,
                                               const std::set<std::string>& jobs);
std::vector<std::string> remove_all_checkpoints(const std::string& folder);

}  // namespace grainsweep
