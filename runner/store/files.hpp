// Files as results need them: whole or not there at all, and an error that names path and cause.
//
// Every function throws FileError. Interrupted system calls are repeated, short writes continued.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace grainsweep {

/// "out/a/packings.csv: cannot write: No space left on device"
struct FileError : std::runtime_error {
  /// `action` is what was tried ("write"), `error` the errno it ended with.
  FileError(const std::string& path, const std::string& action, int error);
  /// A file that can be read but is not what it should be; `what` says so.
  FileError(const std::string& path, const std::string& what);
};

/// An open file descriptor, closed with its owner.
class OpenFile {
 public:
  /// `flags` and `mode` as for open(2); close-on-exec is added.
  OpenFile(std::string path, int flags, unsigned mode = 0666);
  OpenFile(const OpenFile&) = delete;
  OpenFile(OpenFile&&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  OpenFile& operator=(OpenFile&&) = delete;
  ~OpenFile();

  int descriptor() const { return descriptor_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

/// Fills up descriptors 0 to 2 where the program was started with some of them closed. Otherwise
/// the next file opened would take their place, and what is printed would go into it.
void ensure_std_descriptors();

/// Writes all of `bytes` at the file's position.
void write_all(const OpenFile& file, std::string_view bytes);

/// Returns once what was written is on the disk.
void flush_to_disk(const OpenFile& file);

/// Returns once the names of the files in `path`'s folder are on the disk.
void flush_folder_of(const std::string& path);

/// The whole file.
std::string read_file(const std::string& path);

/// `size` bytes of a file from its byte `at` on, counted from 0, or what of them it has.
std::string read_part(const std::string& path, std::int64_t at, std::size_t size);

/// Calls `use` with each line of a file, without its line feed; the last one may have none.
void for_each_line(const std::string& path, const std::function<void(std::string_view)>& use);

/// Whether the new file and its name are on the disk on return. If later, a power cut may leave it
/// empty: for many files that can be made again.
enum class Flush { now, later };

/// Replaces `path` by a file holding `bytes`: a reader or a crash sees the old file or the new one,
/// never a part. Writes a temporary file beside it, flushes it, renames it, flushes the folder.
void replace_file(const std::string& path, std::string_view bytes, Flush flush = Flush::now);

/// The same for a file that is written bit by bit: nothing of it is seen before it is committed,
/// nor ever if it is not.
class Replacement {
 public:
  explicit Replacement(std::string path);
  Replacement(const Replacement&) = delete;
  Replacement(Replacement&&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  Replacement& operator=(Replacement&&) = delete;
  ~Replacement();

  void write(std::string_view bytes);
  void commit(Flush flush = Flush::now);

 private:
  std::string path_, temporary_;
  OpenFile file_;
  std::string bytes_;  ///< not yet in the file
  bool is_committed_ = false;
};

/// Makes the folder and those above it; nothing happens if it is there.
void make_folder(const std::string& path);

/// The same, but the folder above must exist: one that was removed is not made anew. On return the
/// folder is on the disk.
void make_folder_inside(const std::string& path);

/// Removes the file; nothing happens if there is none.
void remove_file(const std::string& path);

bool file_exists(const std::string& path);

/// In bytes; nothing if there is no such file.
std::optional<std::int64_t> file_size(const std::string& path);

/// Removes what killed calls of replace_file have left in `folder`: the temporary files, of this
/// machine or another, for files whose names end in `ending`. No other process may be writing such
/// files there.
void remove_leftovers(const std::string& folder, std::string_view ending);

/// The same of any files, left ten minutes ago or earlier by processes of this machine that have
/// ended: others may be at work.
void remove_leftovers_of_ended(const std::string& folder);

/// Names of the files in `folder` that start and end with these, sorted; none if there is no
/// folder.
std::vector<std::string> files_in(const std::string& folder, std::string_view start,
                                  std::string_view end);

}  // namespace grainsweep
