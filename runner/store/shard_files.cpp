#include "runner/store/shard_files.hpp"

#include <algorithm>
#include <cmath>
#include <fcntl.h>
#include <limits>
#include <unistd.h>

#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "runner/store/runners.hpp"

namespace grainsweep {
namespace {

/// Throws FolderBusy: a runner works on the shard of this journal.
[[noreturn]] void refuse(const std::string& folder, const std::string& path) {
  throw FolderBusy(folder + ": another runner works here (" + owner_text(last_run_in(path)) +
                   "); wait for it or give another folder with --out");
}

/// The journal's path, in a folder that is there.
std::string prepared(const std::string& folder, const Shard& shard) {
  make_folder_inside(shards_folder(folder));
  return journal_path(folder, name_of(shard));
}

/// A crash may have left a line without its end; the next one must not continue it.
bool ends_inside_a_line(const std::string& path) {
  const auto size = file_size(path);
  return size && *size > 0 && read_part(path, *size - 1, 1) != "\n";
}

/// Appends to a file; it is an error if the file is missing and may not be made.
void append_to(const std::string& path, std::string_view bytes, int further_flags) {
  const bool is_new = !file_exists(path);
  const OpenFile file(path, O_WRONLY | O_APPEND | further_flags);
  write_all(file, bytes);
  flush_to_disk(file);
  if (is_new) flush_folder_of(path);
}

void empty_file(const std::string& path) {
  const OpenFile file(path, O_WRONLY | O_TRUNC);
  flush_to_disk(file);
}

}  // namespace

ShardFiles::ShardFiles(const std::string& folder, const Shard& shard, const RunRecord& run)
    : folder_(folder), lock_(prepared(folder, shard)), name_(name_of(shard)) {
  if (lock_.is_taken()) refuse(folder, journal_path(folder, name_));
  for (const std::string& other : shards_in(folder)) {
    const std::string path = journal_path(folder, other);
    const bool overlaps = shard_from_name(other)->count != shard.count;
    if (overlaps && grainsweep::is_locked(path)) refuse(folder, path);
  }
  if (!lock_.is_held()) name_ += "-" + process_name();
  const std::string path = journal_path(folder_, name_);
  append_to(path, ends_inside_a_line(path) ? "\n" : "", O_CREAT);
  flush_folder_of(path);
  add(run);
  flush();
}

void ShardFiles::add_bed(const StoredBed& bed, Outcome& outcome) {
  if (beds_.empty()) beds_end_ = file_size(beds_path(folder_, name_)).value_or(0);
  const std::string bytes = bed_bytes(bed);
  outcome.shard = name_;
  outcome.stored_at = beds_end_ + static_cast<std::int64_t>(beds_.size());
  outcome.stored_bytes = static_cast<std::int64_t>(bytes.size());
  beds_ += bytes;
}

void ShardFiles::count_after(const Outcome& known) {
  const auto [at, is_new] = known_at_.try_emplace(known.job, known.finished_at);
  if (!is_new) at->second = std::max(at->second, known.finished_at);
}

Outcome ShardFiles::add(Outcome outcome) {
  const auto known = known_at_.find(outcome.job);
  if (known != known_at_.end()) {
    constexpr double forever = std::numeric_limits<double>::infinity();
    outcome.finished_at = std::max(outcome.finished_at, std::nextafter(known->second, forever));
  }
  lines_ += journal_line(outcome);
  return outcome;
}

void ShardFiles::add(const RunRecord& run) { lines_ += journal_line(run); }

void ShardFiles::flush() {
  if (!beds_.empty()) append_to(beds_path(folder_, name_), beds_, O_CREAT);
  beds_.clear();
  // A journal that is gone was removed with its folder: it is not made anew without its lock.
  if (!lines_.empty()) append_to(journal_path(folder_, name_), lines_, 0);
  lines_.clear();
}

void ShardFiles::remove_all(const RunRecord& run) {
  for (const std::string& name : shards_in(folder_)) {
    remove_file(beds_path(folder_, name));
    if (name != name_) remove_file(journal_path(folder_, name));
  }
  for (const std::string& path : beds_without_journal(folder_)) remove_file(path);
  empty_file(journal_path(folder_, name_));
  add(run);
  flush();
}

void ShardFiles::beat() const { touch_journal(journal_path(folder_, name_)); }

}  // namespace grainsweep
