#include "runner/store/checkpoints.hpp"

#include <utility>

#include "runner/store/bytes.hpp"
#include "runner/store/checksum.hpp"
#include "runner/store/files.hpp"

namespace grainsweep {
namespace {

constexpr std::string_view magic = "GRAINCP1";

std::string checkpoint_folder(const std::string& folder) { return folder + "/checkpoints"; }

bool is_whole(std::string_view bytes) {
  return bytes.size() >= magic.size() + checksum_size && bytes.starts_with(magic) &&
         ends_in_its_checksum(bytes);
}

/// Removes the files whose name without its ending is wanted.
template <class IsWanted>
void remove_where(const std::string& folder, IsWanted is_wanted) {
  for (const char* ending : {".0", ".1"}) {
    for (const std::string& name : files_in(checkpoint_folder(folder), "", ending)) {
      const std::string job = name.substr(0, name.size() - 2);
      if (is_wanted(job)) remove_file(checkpoint_folder(folder) + "/" + name);
    }
  }
}

}  // namespace

std::string checkpoint_bytes(const NumberedCheckpoint& numbered) {
  std::string bytes(magic);
  put(bytes, numbered.number);
  put(bytes, static_cast<std::uint64_t>(numbered.checkpoint.step));
  put(bytes, numbered.checkpoint.cpu_seconds);
  put_text(bytes, numbered.job);
  put_text(bytes, numbered.build);
  put_text(bytes, numbered.checkpoint.state);
  put(bytes, crc32(bytes));
  return bytes;
}

std::optional<NumberedCheckpoint> checkpoint_from_bytes(std::string_view bytes) {
  if (!is_whole(bytes)) return std::nullopt;
  bytes.remove_prefix(magic.size());
  NumberedCheckpoint read;
  read.number = take<std::uint64_t>(bytes);
  read.checkpoint.step = static_cast<std::int64_t>(take<std::uint64_t>(bytes));
  read.checkpoint.cpu_seconds = take_double(bytes);
  read.job = take_text(bytes);
  read.build = take_text(bytes);
  read.checkpoint.state = take_text(bytes);
  return read;
}

CheckpointFiles::CheckpointFiles(const std::string& folder, std::string job, std::string build)
    : folder_(checkpoint_folder(folder)), job_(std::move(job)), build_(std::move(build)) {}

std::optional<Checkpoint> CheckpointFiles::newest() {
  std::optional<Checkpoint> newest;
  for (const std::uint64_t slot : {0u, 1u}) {
    if (!file_exists(path(slot))) continue;
    auto read = checkpoint_from_bytes(read_file(path(slot)));
    const bool is_ours = read && read->job == job_ && read->build == build_;
    if (!is_ours || (newest && read->number < next_)) continue;
    newest = std::move(read->checkpoint);
    next_ = read->number + 1;
  }
  return newest;
}

void CheckpointFiles::write(const Checkpoint& checkpoint) {
  make_folder(folder_);
  replace_file(path(next_), checkpoint_bytes({next_, job_, build_, checkpoint}));
  ++next_;
}

void CheckpointFiles::remove() const {
  remove_file(path(0));
  remove_file(path(1));
}

std::string CheckpointFiles::path(std::uint64_t number) const {
  return folder_ + "/" + job_ + "." + std::to_string(number % 2);
}

void remove_checkpoints_of(const std::string& folder, const std::set<std::string>& jobs) {
  remove_where(folder, [&](const std::string& job) { return jobs.contains(job); });
}

void remove_all_checkpoints(const std::string& folder) {
  remove_where(folder, [](const std::string&) { return true; });
}

}  // namespace grainsweep
