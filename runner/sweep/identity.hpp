// What makes a job that job.
//
// A job's identity is the text
//     canonical parameters '\n' master seed '\n' replicate
// with both numbers in decimal; its id is FNV-1a (64 bits) of that text, put through the finaliser
// of SplitMix64 so that every bit of the text changes every bit of the id. Labels, the order of
// keys, the order of blocks and the number of replicates do not enter it. A replicate of fill.files
// is known by the hash of its file, which stands behind the parameters, and has the number 1: it is
// the same job wherever its file stands in the list.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "runner/hash.hpp"
#include "runner/sweep/resolved_spec.hpp"

namespace grainsweep {

/// 16 hex digits: hash of the coordinates, in their order.
std::string hash_of(const HullVertices& hull);

/// The same for a table of sizes.
std::string hash_of(const SizeTable& table);

/// Share and shape of a component of a mixture: {"cube":{"edge":1},"share":0.7}.
std::string canonical_component(double share, const ResolvedSpec& shape);

/// Every parameter of the packing as JSON without spaces, keys sorted, numbers in the shortest form
/// that reads back exactly (20, not 20.0). Presets appear as their parts, a fill file as the hash
/// of its content, a hull as that of its vertices, a file of sizes as that of its numbers, a
/// mixture as its components by their numbers, from 1.
std::string canonical_parameters(const ResolvedSpec& resolved);

/// The ids, as numbers, of the jobs with these parameters.
class JobHash {
 public:
  explicit JobHash(std::string_view parameters) : of_parameters_(fnv1a(parameters)) {}
  /// Those of jobs whose parameters go on with `more`.
  JobHash followed_by(std::string_view more) const;
  std::uint64_t operator()(std::uint64_t seed, int replicate) const;

 private:
  std::uint64_t of_parameters_;
};

/// Those parameters that say what is packed: all but "accuracy" and "measure". The key of a job's
/// random numbers is their hash: jobs that differ in nothing but how accurately they are made and
/// what is measured of them start from the same grains at the same places.
std::string canonical_scene(const ResolvedSpec& resolved);

/// Those that say what bed comes to rest: all but "measure".
std::string canonical_bed(const ResolvedSpec& resolved);
std::string canonical_settled_bed(const ResolvedSpec& resolved);  ///< without accuracy.max_steps

}  // namespace grainsweep
