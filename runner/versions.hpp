// What this program was built from.
#pragma once

#include <map>
#include <string>

namespace grainsweep {

/// "0.2.0"
std::string program_version();

/// "0.2.0-1f2e3d4c": the version and a checksum of the running program's file, which tells two
/// builds of one version apart.
std::string build_name();

/// What the source was when it was built, by git: "461e38b0a1b2", with "-dirty" behind it if it
/// had changes; "unknown" without git.
std::string source_commit();

/// "g++ 12.2.0"
std::string compiler_version();

/// Library -> version.
std::map<std::string, std::string> library_versions();

}  // namespace grainsweep
