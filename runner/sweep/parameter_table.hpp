// The parameters of a sweep for readers of a manual.
#pragma once

#include <string>

namespace grainsweep {

/// All parameters as a table in GitHub's Markdown: path, type, range or names, default, meaning.
std::string parameter_table();

}  // namespace grainsweep
