// What this program was built from.
#pragma once

#include <map>
#include <string>

namespace grainsweep {

/// "0.1.0"
std::string program_version();

/// "g++ 12.2.0"
std::string compiler_version();

/// Library -> version.
std::map<std::string, std::string> library_versions();

}  // namespace grainsweep
