// One runner per output folder, as a courtesy.
//
// The lock is flock(2) on <folder>/runner.lock, whose text names host and process. It ends with the
// process however that ends. Network file systems may not honour it; nothing breaks if two runners
// meet, since each writes its own journal and equal jobs have equal results.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "runner/store/files.hpp"

namespace grainsweep {

/// Another runner holds the folder; the message names it.
struct FolderBusy : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class FolderLock {
 public:
  /// Throws FolderBusy if another process holds the lock, FileError if it cannot be opened.
  explicit FolderLock(const std::string& folder);

  /// False where the file system offers no locks: the folder is used without one.
  bool is_held() const { return is_held_; }

 private:
  OpenFile file_;
  bool is_held_;
};

/// "host, process 4711" of the runner that works in `folder` now; nothing if none does.
std::optional<std::string> present_runner(const std::string& folder);

/// The machine's name, with only the characters that are safe in a file name.
std::string host_name();

/// "<host>-<pid>", the name this process writes under.
std::string process_name();

}  // namespace grainsweep
