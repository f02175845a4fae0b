#include "runner/jobs/known_beds.hpp"

#include <unordered_set>

#include "engine/packing.hpp"
#include "runner/store/files.hpp"
#include "runner/store/states.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/versions.hpp"

namespace grainsweep {

KnownBeds known_beds(const Outcomes& stored, const std::vector<const Job*>& pending) {
  std::unordered_set<std::uint64_t> wanted;
  for (const Job* job : pending) wanted.insert(job->bed);
  KnownBeds beds;
  for (const auto& [job, outcome] : stored) {
    const PackingStatus status = outcome->result.status;
    const bool is_rest = status == PackingStatus::settled || status == PackingStatus::not_settled;
    const bool is_known = is_rest && outcome->bed && outcome->version == program_version();
    if (is_known && wanted.contains(*outcome->bed)) beds.emplace(*outcome->bed, *outcome);
  }
  return beds;
}

std::vector<Cost> costs_with(const KnownBeds& beds, const std::vector<const Job*>& jobs) {
  std::vector<Cost> costs = costs_of(jobs);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (beds.contains(jobs[k]->bed)) costs[k].cpu_seconds *= share_of_measuring;
  }
  return costs;
}

std::optional<Packing> measured_from(const KnownBeds& beds, const std::string& folder,
                                     const Job& job, const Kernels& kernels) {
  const auto known = beds.find(job.bed);
  if (known == beds.end()) return std::nullopt;
  try {
    const Outcome& outcome = known->second;
    return measure_again(job.spec, kernels, packing_of(read_bed(folder, outcome), outcome.result));
  } catch (const FileError&) {
    return std::nullopt;
  }
}

}  // namespace grainsweep
