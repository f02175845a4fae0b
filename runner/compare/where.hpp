// Which families published values belong to: `where` of a file of published values.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/tables/families.hpp"

namespace grainsweep {

/// What parameters of a family are: dotted path -> value, as JSON without needless digits.
using Where = std::map<std::string, std::string>;

/// That of a JSON object at `pointer`. Notes what no packing can have.
Where read_where(const Json& from, const std::string& pointer, Diagnostics& diagnostics);

/// Whether `family` is one that `where` describes: by its parameters, by the name of its shape, and
/// by that of the preset that it settles as.
bool describes(const Where& where, const Family& family);

/// What families have at `path`, as `where` has it, with its unit: "1.1, 1.2 d"; "" if nothing.
std::string values_in(const std::vector<Family>& families, const std::string& path);

/// What to write in `where` in place of a parameter that families do not have, since their packings
/// differ in it; "" for any other path.
std::string advice_on(const std::string& path);

}  // namespace grainsweep
