// An output folder as a whole: what is stored in it, and the tables written from that.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runner/jobs/growing_groups.hpp"
#include "runner/report/report.hpp"
#include "runner/store/shard_files.hpp"
#include "runner/store/states.hpp"
#include "runner/tables/families.hpp"
#include "runner/tables/provenance.hpp"

namespace grainsweep {

struct Results {
  Provenance provenance;
  std::vector<Row> rows;
  std::vector<std::string> damage;                  ///< what was left out, where and why
  std::map<std::string, RunRecord> last_runs = {};  ///< as in JournalReading
  std::size_t orphaned = 0;  ///< stored packings that do not belong to the present sweep
  std::string wishes = {};   ///< which requested accuracies a growing sweep reached: wishes_text
};

/// The record of a sweep, which every output folder has.
std::string provenance_path(const std::string& folder);

/// Throws BadInput where `folder` is no output folder, but holds files of names that one has: they
/// would be replaced.
void expect_no_foreign_files(const std::string& folder);

/// Throws BadInput unless `folder` has a provenance.json that is whole.
void expect_results(const std::string& folder);

/// What provenance.json and the journals of a folder hold, before it is put together.
struct StoredSweep {
  Provenance provenance;
  JobList jobs;
  Outcomes outcomes;
  std::map<std::string, RunRecord> last_runs;  ///< as in JournalReading
  std::vector<std::string> damage;             ///< as in Results
};

/// Throws BadInput if `folder` is no output folder, FileError if a file cannot be read.
StoredSweep read_stored_sweep(const std::string& folder, Detail detail = Detail::whole);

/// Everything from provenance.json and the journals: all but the curves. A summary has only what
/// `status` needs and takes a tenth of the time. Throws BadInput if `folder` is no output folder,
/// FileError if a file cannot be read.
Results read_results(const std::string& folder, Detail detail = Detail::whole);

/// The packings that a sweep calls for by now, and what is stored of them. Both come from one
/// reading: where none is pending, nothing more is called for, whatever other runners made
/// meanwhile. A growing sweep needs Detail::whole.
Results read_called_for(GrowingSweep& growing, Provenance provenance, const std::string& folder,
                        Detail detail);

/// Writes provenance.json, from which others know the sweep, unless it is already there.
void record_sweep(const std::string& folder, const Provenance& provenance,
                  const std::vector<Row>& rows);

/// Whether a packing is stored with its curves, but without its grains.
bool lacks_grains(const Outcome& outcome);

/// How to have the grains of packings that were stored without.
std::string grains_remedy(const std::string& sweep_file, const std::string& folder);

/// How to have a folder without packings that no table shows: "; grainsweep collect ...".
std::string others_remedy(const std::string& folder);

/// Whether the outcome's bed, if it has one, is stored whole; appends to `faults` why not.
bool has_sound_bed(const std::string& folder, const Outcome& outcome,
                   std::vector<BedFault>& faults);

/// Reads the whole of each stored bed. A row whose bed is missing, damaged or that of another
/// outcome becomes pending; returns what was left out, as in Results::damage, a line a file.
std::vector<std::string> check_beds(const std::string& folder, std::vector<Row>& rows);

/// Checks that the stored beds are there with the sizes they had, without opening any: 100,000 in a
/// second. A flipped bit is not noticed.
std::vector<std::string> expect_beds(const std::string& folder, std::vector<Row>& rows);

/// The same for outcomes; those without a sound bed are removed.
std::vector<std::string> expect_beds(const std::string& folder, Outcomes& outcomes);

/// Packings whose tables and page without figures are written in a few seconds.
inline constexpr std::size_t most_in_haste = 5000;

/// How much of the page a run writes at its end, with the tables; nothing if it is in haste, told
/// to stop or near its limit of time, and not even these would be written soon.
std::optional<PageExtent> extent_at_end(std::size_t packings, bool is_in_haste);

/// Replaces report.html and its figures, made from rows whose beds were checked; prints notes on
/// what is missing from it. Returns a line that says where it is. Throws FileError.
std::string write_page(const std::string& folder, const Provenance& provenance,
                       const std::vector<Row>& rows, const Analysis& analysis,
                       PageExtent extent = PageExtent::whole);

/// Replaces the CSV tables, made from rows whose beds were checked and from their analysis,
/// columns.csv, which explains them, and provenance.json. Throws FileError.
void write_tables(const std::string& folder, const Provenance& provenance,
                  const std::vector<Row>& rows, const Analysis& analysis);

/// Replaces provenance.json alone.
void write_provenance(const std::string& folder, const Provenance& provenance,
                      const std::vector<Row>& rows);

/// What this program was built from, for provenance.json.
Build this_build();

/// The columns of every table of a sweep that has these further gap tolerances, varies these
/// parameters and gives these units.
std::vector<ColumnText> all_columns(const std::vector<double>& tolerances, const Varied& varied,
                                    const GivenUnits& units = {});

/// A line of warning for each entry of `damage`, as in Results.
std::string damage_warnings(const std::vector<std::string>& damage);

/// A line that says how many rows another version of the program made, whose results may not belong
/// in one table with this one's; empty if there are none.
std::string other_versions_warning(const std::vector<Row>& rows, const std::string& version);

/// "12 stored packings", and what cannot be read beside them; empty if there is neither.
std::string stored_packings(const std::string& folder);

/// Removes what killed runners left half written. No other runner may work in the folder.
void clean_up(const std::string& folder);

/// Warns that the file system offers no locks, if so.
void warn_without_lock(const std::string& folder, const ShardFiles& files);

/// Removes checkpoints and tables, and nothing else.
void remove_tables(const std::string& folder);

}  // namespace grainsweep
