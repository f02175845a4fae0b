// Which values of a sweep file may not stand together, as far as a JSON Schema can say it: it
// compares no values with each other and opens no other file. Each function gives a list of rules
// that all hold.
#pragma once

#include <string>

#include "runner/sweep/values.hpp"

namespace grainsweep {

/// For an object of parameters: what excludes each other, and the same parameter written in two
/// ways. The object describes `group`, "" for all parameters.
Json said_once(const std::string& group);

/// For a zip: its lists are equally long, or longer than anyone writes by hand.
Json equally_long();

/// For a zip of two rows or of one list: no row is there twice.
Json distinct_rows();

/// For two bounds: no round number is above the second but not above the first.
Json ascending();

/// For a block: it does not set what it varies.
Json set_or_varied();

/// For the whole sweep, where no block says otherwise: a length of a start file needs the file, one
/// start allows no replicates, and a distribution of sizes needs a formula or a table.
Json rules_of_the_whole();

}  // namespace grainsweep
