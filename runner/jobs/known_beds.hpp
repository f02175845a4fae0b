// Beds that are stored already, under the id of another packing: of one that differs in what is
// measured alone, or in accuracy.max_steps if it settled. They are measured again, not packed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/cost.hpp"
#include "kernels/kernels.hpp"
#include "runner/store/journal.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// The packing that the bed of a job was stored with, by Job::id.
using KnownBeds = std::unordered_map<std::string, std::shared_ptr<const Outcome>>;

/// What a packing's bed is known by: Job::settled_bed if it settled, else Job::bed.
std::uint64_t name_of_bed(const Job& job, const PackingResult& result);

/// Those that pending packings have in common with stored ones of this version of the program, if
/// these were measured and have a sound bed with grains in `folder`.
KnownBeds known_beds(const std::string& folder, const Outcomes& stored,
                     const std::vector<const Job*>& pending);

/// What measuring takes of the CPU time of packing: a fiftieth to a tenth.
inline constexpr double share_of_measuring = 0.05;

/// The costs of jobs, of those whose bed is known that of measuring.
std::vector<Cost> costs_with(const KnownBeds& beds, const std::vector<const Job*>& jobs);

/// The packing of a job from its bed in `folder`, as packing it would give. Nothing if there is
/// none, or no sound one.
std::optional<Packing> measured_from(const KnownBeds& beds, const std::string& folder,
                                     const Job& job, const Kernels& kernels);

}  // namespace grainsweep
