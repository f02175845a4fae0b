// What is kept of a call of `run`: who did what with which machine.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace grainsweep {

struct RunRecord {
  std::string started;        ///< UTC, ISO 8601
  std::string ended;          ///< the same; empty while it runs, or if it was killed
  double wall_seconds = 0.0;  ///< s
  std::string process;        ///< "<host>-<random number>-<pid>"
  int threads = 1;
  std::string isa;        ///< "avx2"
  int packings = 0;       ///< finished by this run
  std::string command;    ///< as it was typed, options and all
  std::string host;       ///< name of the machine
  std::string processor;  ///< "AMD EPYC 7763 64-Core Processor"
  int cores = 0;          ///< that the process might use
  std::string commit;     ///< as in Build, of the program that ran
  std::string form = {};  ///< hash of its sweep's packings: equal where shards make parts of one
};

void to_json(nlohmann::json& to, const RunRecord& run);
/// Throws nlohmann::json::exception if `from` is not what to_json gives.
void from_json(const nlohmann::json& from, RunRecord& run);

/// Whether they are of the same run: a process begins only one at a time.
bool is_same_run(const RunRecord& a, const RunRecord& b);

/// By start, then by process.
void sort_runs(std::vector<RunRecord>& runs);

}  // namespace grainsweep
