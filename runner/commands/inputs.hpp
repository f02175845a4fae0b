// What commands are given: a sweep file, or the output folder of a run.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runner/commands/results.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// The sweep in `file`; prints a note on published values beside it that cannot be read. Throws
/// BadInput with every error in it.
Sweep sweep_or_refusal(const std::string& file);

/// The same; also prints notes on what is never used in it and on beds that will probably be too
/// low.
Sweep sweep_with_notes(const std::string& file);

/// The place in `ids` of the packing that is called `given`, its id or how that begins. Throws
/// BadInput, which says that ids are found in `where`, unless it is one.
std::size_t place_of_job(const std::string& given, const std::vector<std::string>& ids,
                         const std::string& where);

/// What is stored in the output folder; prints warnings about packings of another version, and
/// about damage unless all packings and the end of the last run are there.
Results results_with_warnings(const std::string& folder, Detail detail = Detail::whole);

}  // namespace grainsweep
