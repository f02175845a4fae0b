// What values of a sweep file may not stand together, as far as a JSON Schema can say it: it
// compares no values with each other and opens no other file.
#pragma once

#include <string>

#include "runner/sweep/values.hpp"

namespace grainsweep {

/// Of an object of parameters: what excludes each other, and the same parameter written in two
/// ways. `group` is the one it describes, "" for all parameters. A list of rules that all hold, as
/// those below.
Json said_once(const std::string& group);

/// Of a zip: its lists are equally long, or longer than anyone writes by hand.
Json equally_long();

/// Of a block: what it varies it does not set.
Json set_or_varied();

/// Of the whole sweep, where no block says otherwise: a length of a start file needs the file, one
/// start serves no replicates, the ends of a pinacoid do not cross, a period holds two of the usual
/// spheres, and a bed of them in the usual box is high enough to be measured.
Json sweep_rules();

}  // namespace grainsweep
