// An output folder as a whole: what is stored in it, and the tables written from that.
#pragma once

#include <string>
#include <vector>

#include "runner/store/journal.hpp"
#include "runner/tables/provenance.hpp"

namespace grainsweep {

struct Results {
  Provenance provenance;
  std::vector<Row> rows;
  std::vector<std::string> damage;  ///< journal lines that were left out, and why
  std::size_t foreign = 0;          ///< stored packings that are not of the present sweep
};

/// Everything from provenance.json and the journals: all but the curves. Throws BadInput if
/// `folder` is no output folder, FileError if a file cannot be read.
Results read_results(const std::string& folder);

/// How much of a sweep is done.
struct Overview {
  std::string name;        ///< of the sweep
  std::string sweep_file;  ///< as given on the command line
  std::size_t packings = 0;
  StatusCounts counts;
  double cpu_seconds = 0.0;         ///< of all finished packings, s
  std::vector<std::string> damage;  ///< as of Results
  std::size_t foreign = 0;          ///< as of Results
  std::size_t other_versions = 0;   ///< finished packings of another version than asked for
};

/// The same as counting read_results, in a tenth of the time and memory. `version`: of this
/// program.
Overview read_overview(const std::string& folder, const std::string& version);

/// The runs recorded in the folder so far; none if it is new.
std::vector<RunRecord> recorded_runs(const std::string& folder);

/// Reads the curves of all rows. A row whose curves are missing or damaged becomes a pending one;
/// returns what was left out, as in Results::damage.
std::vector<std::string> load_curves(const std::string& folder, std::vector<Row>& rows);

/// The journals without the packings whose grains and curves are missing or whose curves are
/// damaged; its damage names those too. Throws FileError.
JournalReading stored_outcomes(const std::string& folder);

/// The packings among them that need not be made again: those that did not end in an exception.
JournalReading finished_outcomes(const std::string& folder);

/// Replaces the CSV tables and provenance.json. Reads the curves of settled rows group by group.
/// Throws FileError, also if curves are damaged.
void write_tables(const std::string& folder, const Provenance& provenance,
                  const std::vector<Row>& rows);

/// Replaces provenance.json alone.
void write_provenance(const std::string& folder, const Provenance& provenance,
                      const std::vector<Row>& rows);

/// A line of warning for each of `damage`, as of Results.
std::string damage_warnings(const std::string& folder, const std::vector<std::string>& damage);

/// A line that says how many rows another version of the program made, whose results may not belong
/// into one table with this one's; empty if there are none.
std::string other_versions_warning(const std::vector<Row>& rows, const std::string& version);
std::string other_versions_warning(std::size_t count, std::size_t rows, const std::string& version);

/// Number of stored packings in the folder.
std::size_t stored_packings(const std::string& folder);

/// Removes what killed runners left half written. The caller must hold the folder's lock.
void remove_half_written(const std::string& folder);

/// Removes journals, grains, checkpoints and tables, and nothing else.
void remove_results(const std::string& folder);

}  // namespace grainsweep
