// provenance.json: what was run, with what, when, and the resolved sweep. From it and the journals
// every table can be written again without the sweep file.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "runner/store/run_record.hpp"
#include "runner/sweep/units.hpp"
#include "runner/tables/job_facts.hpp"

namespace grainsweep {

/// What the program was built from.
struct Build {
  std::string version;
  std::string commit;  ///< of its source, "-dirty" if that was changed; "unknown" outside git
  std::string compiler;
  std::map<std::string, std::string> libraries;  ///< name -> version
  bool operator==(const Build&) const = default;
};

/// A sweep file.
struct SweepFile {
  std::string file;         ///< as given on the command line
  std::string text;         ///< all of it, verbatim
  std::string folder = {};  ///< in which it was given, absolute
  bool operator==(const SweepFile&) const = default;
};

struct Provenance {
  Build build;
  std::vector<SweepFile> sweeps;  ///< one, or those of all collected folders, equal texts once
  std::string sweep_name;
  GivenUnits units = {};        ///< of the sweep; of collected ones if they agree
  std::vector<RunRecord> runs;  ///< in the order they started
};

/// The file of the only sweep; empty if there are several.
std::string sweep_file_of(const Provenance& provenance);

/// The whole file, with the jobs of `rows` and the totals of their packings, and a CRC-32 of all
/// before at its end.
std::string provenance_text(const Provenance& provenance, const std::vector<Row>& rows);

/// What provenance_text made a text from.
struct ProvenanceReading {
  Provenance provenance;
  JobList jobs;
};

/// Throws nlohmann::json::exception if `text` is not a provenance.json of this version, every byte
/// of it.
ProvenanceReading provenance_from_text(const std::string& text);

/// Whether its checksum is right, which is quick to find out.
bool has_checksum(std::string_view text);

struct Totals {
  StatusCounts counts;
  double cpu_seconds = 0.0;  ///< of all finished packings, s
};
Totals totals_of(const std::vector<Row>& rows);

}  // namespace grainsweep
