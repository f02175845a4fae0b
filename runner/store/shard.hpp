// The parts of a sweep that are made separately, and the files of an output folder that hold them.
//
// shards/3-of-64.jsonl is the journal of one, shards/3-of-64.beds holds its beds one after the
// other. A run of the whole sweep is a single shard, 1-of-1. Where the file system offers no locks,
// names end in the name of the process, 3-of-64-<host>-<pid>, so that no two processes write into
// one file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainsweep {

/// What is made for every shard stays small beside the packings.
inline constexpr int most_shards = 1'000'000;

struct Shard {
  int number = 1;  ///< 1 .. count
  int count = 1;
  bool operator==(const Shard&) const = default;
};

/// "3-of-64"
std::string name_of(const Shard& shard);

/// The shard with that name, or whose name it continues (3-of-64-<host>-<pid>); nothing if none.
std::optional<Shard> shard_from_name(std::string_view name);

/// The shard in "3/64"; nothing if it is none.
std::optional<Shard> shard_from_text(std::string_view text);

/// <folder>/shards
std::string shards_folder(const std::string& folder);
std::string journal_path(const std::string& folder, const std::string& name);
/// Locked by the shard that writes the tables of all; a shard that begins meanwhile goes on.
std::string tables_lock(const std::string& folder);
std::string beds_path(const std::string& folder, const std::string& name);

/// Names of all shards with a journal in the folder, sorted.
std::vector<std::string> shards_in(const std::string& folder);

/// Paths of the files of beds of shards whose journal is missing.
std::vector<std::string> beds_without_journal(const std::string& folder);

}  // namespace grainsweep
