// Which packings of a shared folder were taken, once runners help each other.
//
// shards/claims is a file that all runners append to, a line for each packing that one is about to
// make: job and runner. Of two lines for a job the earlier one counts, so that two runners agree
// without a lock. The file is there only from when the first runner has ended its own shard until
// the sweep is made: before, no runner claims anything. Where a file system mixes up what two
// machines append, or a claim is lost, a packing is made twice, which does no harm.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace grainsweep {

/// Every function throws FileError.
class Claims {
 public:
  /// The claims of `runner`, a process. All claims in the file count.
  Claims(const std::string& folder, std::string runner);

  /// Claims that are in the file now are void if their runner is not among those `at_work`.
  Claims(const std::string& folder, std::string runner, const std::set<std::string>& at_work);

  /// Claims those of the jobs that no other runner has; returns them.
  std::vector<std::string> take(const std::vector<std::string>& jobs);

  /// Whether this runner may begin the job: claims it if runners claim.
  bool may_begin(const std::string& job);

  /// The runner at work that has claimed the job, as far as the file was read; empty if none has.
  std::string owner_of(const std::string& job) const;

  /// Jobs whose claim is void and that nobody has claimed since.
  const std::set<std::string>& abandoned() const { return abandoned_; }

 private:
  /// Reads what was appended since. `at_work`: null if all claims count.
  void read(const std::set<std::string>* at_work = nullptr);
  void read_line(std::string_view line, const std::set<std::string>* at_work);

  std::string path_;
  std::string runner_;
  std::unordered_map<std::string, std::string> owners_;  ///< of each job
  std::set<std::string> abandoned_;
  std::int64_t read_to_ = 0;
};

/// Whether a runner has claimed something.
bool has_claims(const std::string& folder);

/// From now on every runner claims what it begins.
void open_claims(const std::string& folder);

/// For when the whole sweep is made.
void forget_claims(const std::string& folder);

}  // namespace grainsweep
