#include "runner/tables/packing_names.hpp"

#include "runner/tables/csv.hpp"

namespace grainsweep {

PackingNames::PackingNames(const std::vector<Family>& families) {
  for (const Family& family : families) {
    if (family.distinction.empty()) continue;
    for (const auto* const groups : {&family.walled, &family.periodic}) {
      for (const Group& group : *groups) {
        distinctions_[group.job.parameters.text()] = family.distinction;
      }
    }
  }
}

std::string PackingNames::family_of(const JobFacts& job) const {
  if (distinctions_.empty()) return job.label;
  const auto found = distinctions_.find(job.parameters.text());
  if (found == distinctions_.end()) return job.label;
  return job.label + (job.label.empty() ? "" : " ") + found->second;
}

std::string PackingNames::set_of(const JobFacts& job) const {
  const std::string family = family_of(job);
  return family + (family.empty() ? "" : ", ") + (job.box.is_tube ? "D = " : "W = ") +
         width_text(cell(job.box.width), job.box.y);
}

PackingNames names_in(const Sweep& sweep) {
  std::vector<Row> rows;  // replicates have the names of the first
  const Job* before = nullptr;
  for (const Job& job : sweep.jobs) {
    const bool is_first =
        before == nullptr || before->parameters != job.parameters || before->label != job.label;
    before = &job;
    if (is_first) rows.push_back({facts_of(job), std::nullopt});
  }
  return PackingNames(families_of(groups_of(rows)));
}

}  // namespace grainsweep
