#include "runner/jobs/known_beds.hpp"

#include <unordered_set>
#include <utility>

#include "engine/packing.hpp"
#include "runner/store/files.hpp"
#include "runner/store/states.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/versions.hpp"

namespace grainsweep {

namespace {

/// Whether a bed can be measured again if it is sound.
bool may_be_measured(const Outcome& outcome) {
  const PackingStatus status = outcome.result.status;
  const bool is_at_its_end =
      status == PackingStatus::settled || status == PackingStatus::not_settled;
  return is_at_its_end && outcome.bed && outcome.version == program_version();
}

std::optional<StoredBed> sound_bed(const std::string& folder, const Outcome& outcome) {
  try {
    return read_bed(folder, outcome);
  } catch (const FileError&) {
    return std::nullopt;
  }
}

}  // namespace

std::uint64_t name_of_bed(const Job& job, const PackingResult& result) {
  return result.status == PackingStatus::settled ? job.settled_bed : job.bed;
}

KnownBeds known_beds(const std::string& folder, const Outcomes& stored,
                     const std::vector<const Job*>& pending) {
  std::unordered_set<std::uint64_t> wanted;
  for (const Job* job : pending) wanted.insert({job->bed, job->settled_bed});
  std::unordered_map<std::uint64_t, std::shared_ptr<const Outcome>> sound;  // by their names
  for (const auto& [id, outcome] : stored) {
    if (!may_be_measured(*outcome) || !wanted.contains(*outcome->bed)) continue;
    if (!sound.contains(*outcome->bed) && sound_bed(folder, *outcome)) {
      sound.emplace(*outcome->bed, std::make_shared<const Outcome>(*outcome));
    }
  }
  KnownBeds beds;
  for (const Job* job : pending) {
    for (const std::uint64_t name : {job->settled_bed, job->bed}) {
      const auto known = sound.find(name);
      if (known == sound.end()) continue;
      const PackingResult& result = known->second->result;
      const bool has_steps = result.steps <= job->spec.accuracy.max_steps;
      if (has_steps && name == name_of_bed(*job, result)) beds.emplace(job->id, known->second);
    }
  }
  return beds;
}

std::vector<Cost> costs_with(const KnownBeds& beds, const std::vector<const Job*>& jobs) {
  std::vector<Cost> costs = costs_of(jobs);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (beds.contains(jobs[k]->id)) costs[k].cpu_seconds *= share_of_measuring;
  }
  return costs;
}

std::optional<Packing> measured_from(const KnownBeds& beds, const std::string& folder,
                                     const Job& job, const Kernels& kernels) {
  const auto known = beds.find(job.id);
  if (known == beds.end()) return std::nullopt;
  const Outcome& outcome = *known->second;
  auto bed = sound_bed(folder, outcome);
  if (!bed) return std::nullopt;
  return measure_again(job.spec, kernels, packing_of(std::move(*bed), outcome.result));
}

}  // namespace grainsweep
