// Who works on a shard.
//
// The lock is flock(2) on the shard's journal; it ends with the process however that ends. Network
// file systems may not honour it: two runners that then share a shard write journals of their own
// names (runner/store/shard.hpp), and equal jobs have equal results.
#pragma once

#include <stdexcept>
#include <string>

#include "runner/store/files.hpp"

namespace grainsweep {

/// Another runner works there; the message names it.
struct FolderBusy : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Held while it lives.
class FileLock {
 public:
  /// Makes the file if missing. Tries for a fifth of a second, since checking the lock takes it for
  /// a moment. Throws FileError if it cannot be opened.
  explicit FileLock(const std::string& path);

  bool is_held() const { return error_ == 0; }
  /// Whether another process holds it. If it is neither held nor taken, the file system has no
  /// locks.
  bool is_taken() const;

 private:
  OpenFile file_;
  int error_;
};

/// Whether a process holds the lock of this file; not if there is no file.
bool is_locked(const std::string& path);

}  // namespace grainsweep
