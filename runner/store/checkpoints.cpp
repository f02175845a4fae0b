#include "runner/store/checkpoints.hpp"

#include <tuple>
#include <utility>

#include "runner/store/archive.hpp"
#include "runner/store/files.hpp"

namespace grainsweep {

constexpr auto members_of(const Checkpoint* /*type*/) {
  return std::tuple(&Checkpoint::step, &Checkpoint::cpu_seconds, &Checkpoint::state);
}
constexpr auto members_of(const NumberedCheckpoint* /*type*/) {
  using Numbered = NumberedCheckpoint;
  return std::tuple(&Numbered::number, &Numbered::job, &Numbered::build, &Numbered::checkpoint);
}

namespace {

constexpr std::string_view checkpoint_mark = "GRAINCP2";

std::string checkpoint_folder(const std::string& folder) { return folder + "/checkpoints"; }

/// Where the file cannot be removed, appends the reason to `failures`.
void try_to_remove(const std::string& path, std::vector<std::string>& failures) {
  try {
    remove_file(path);
  } catch (const FileError& error) {
    failures.push_back(std::string(error.what()) + "; it is not needed, remove it by hand");
  }
}

/// Removes the files whose name without its ending is wanted.
template <class IsWanted>
std::vector<std::string> remove_where(const std::string& folder, IsWanted is_wanted) {
  std::vector<std::string> failures;
  for (const char* ending : {".0", ".1"}) {
    for (const std::string& name : files_in(checkpoint_folder(folder), "", ending)) {
      const std::string job = name.substr(0, name.size() - 2);
      if (is_wanted(job)) try_to_remove(checkpoint_folder(folder) + "/" + name, failures);
    }
  }
  return failures;
}

}  // namespace

std::string checkpoint_bytes(const NumberedCheckpoint& numbered) {
  return file_bytes(checkpoint_mark, numbered);
}

std::optional<NumberedCheckpoint> checkpoint_from_bytes(std::string_view bytes) {
  return value_in_file<NumberedCheckpoint>(checkpoint_mark, bytes);
}

CheckpointFiles::CheckpointFiles(const std::string& folder, std::string job, std::string build)
    : folder_(checkpoint_folder(folder)), job_(std::move(job)), build_(std::move(build)) {}

std::optional<Checkpoint> CheckpointFiles::newest() {
  std::optional<Checkpoint> newest;
  std::string damaged;
  for (const std::uint64_t slot : {0u, 1u}) {
    if (!file_exists(path(slot))) continue;
    auto read = checkpoint_from_bytes(read_file(path(slot)));
    if (!read) damaged = path(slot);
    const bool is_ours = read && read->job == job_ && read->build == build_;
    if (!is_ours || (newest && read->number < next_)) continue;
    newest = std::move(read->checkpoint);
    next_ = read->number + 1;
  }
  if (!newest && !damaged.empty()) throw FileError(damaged, "is damaged, or of another version");
  return newest;
}

void CheckpointFiles::write(const Checkpoint& checkpoint) {
  make_folder_inside(folder_);
  replace_file(path(next_), checkpoint_bytes({next_, job_, build_, checkpoint}));
  ++next_;
}

std::vector<std::string> CheckpointFiles::remove() const {
  std::vector<std::string> failures;
  try_to_remove(path(0), failures);
  try_to_remove(path(1), failures);
  return failures;
}

std::string CheckpointFiles::path(std::uint64_t number) const {
  return folder_ + "/" + job_ + "." + std::to_string(number % 2);
}

std::size_t saved_packings(const std::string& folder) {
  std::set<std::string> jobs;
  for (const char* ending : {".0", ".1"}) {
    for (const std::string& name : files_in(checkpoint_folder(folder), "", ending)) {
      jobs.insert(name.substr(0, name.size() - 2));
    }
  }
  return jobs.size();
}

std::vector<std::string> remove_checkpoints_of(const std::string& folder,
                                               const std::set<std::string>& jobs) {
  return remove_where(folder, [&](const std::string& job) { return jobs.contains(job); });
}

std::vector<std::string> remove_all_checkpoints(const std::string& folder) {
  return remove_where(folder, [](const std::string&) { return true; });
}

}  // namespace grainsweep
