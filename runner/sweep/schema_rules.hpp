// What values of a sweep file may not stand together, as far as a JSON Schema can say it: it
// compares no values with each other and opens no other file. Each is a list of rules that all
// hold.
#pragma once

#include <string>

#include "runner/sweep/values.hpp"

namespace grainsweep {

/// Of an object of parameters: what excludes each other, and the same parameter written in two
/// ways. `group` is the one it describes, "" for all parameters.
Json said_once(const std::string& group);

/// Of a zip: its lists are equally long, or longer than anyone writes by hand.
Json equally_long();

/// Of a zip: where it is of two rows or of one list, no row is there twice.
Json distinct_rows();

/// Of two bounds: no round number lies between them the wrong way round.
Json ascending();

/// Of a block: what it varies it does not set.
Json set_or_varied();

/// Of the whole sweep, where no block says otherwise: a length of a start file needs the file, and
/// one start serves no replicates; and a distribution of sizes needs a formula or a table.
Json rules_of_the_whole();

}  // namespace grainsweep
