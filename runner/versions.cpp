#include "runner/versions.hpp"

#include <zlib.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>
#include <tbb/version.h>
#include <xsimd/config/xsimd_config.hpp>

#include "runner/hash.hpp"
#include "runner/store/files.hpp"

namespace grainsweep {
namespace {

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

}  // namespace

std::string program_version() { return GRAINSWEEP_VERSION; }

std::string build_name() {
  return program_version() + "-" + hex8(crc32(read_file("/proc/self/exe")));
}

std::string compiler_version() {
#ifdef __clang__
  return __VERSION__;
#else
  return std::string("g++ ") + __VERSION__;
#endif
}

std::map<std::string, std::string> library_versions() {
  return {
      {"Boost", dotted(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"CLI11", CLI11_VERSION},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                               NLOHMANN_JSON_VERSION_PATCH)},
      {"oneTBB", TBB_runtime_version()},
      {"zlib", ZLIB_VERSION},
      {"xsimd", dotted(XSIMD_VERSION_MAJOR, XSIMD_VERSION_MINOR, XSIMD_VERSION_PATCH)}};
}

}  // namespace grainsweep
