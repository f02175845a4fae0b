#include "runner/jobs/growing_families.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "runner/tables/fits.hpp"
#include "runner/tables/job_facts.hpp"

namespace grainsweep {
namespace {

/// The jobs with one key, by their places, in the order of their first jobs.
template <class Key>
std::vector<Places> gathered(const std::vector<Job>& jobs, Key (*key_of)(const Job&)) {
  std::vector<Places> groups;
  std::map<Key, std::size_t> index_of;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto [known, is_new] = index_of.try_emplace(key_of(jobs[i]), groups.size());
    if (is_new) groups.emplace_back();
    groups[known->second].push_back(i);
  }
  return groups;
}

/// What the jobs of a parameter set have in common. Refers to the job.
std::pair<std::string_view, std::string_view> set_of(const Job& job) {
  return {job.label, job.parameters.text()};
}

/// What the jobs of a group have in common, with their requested accuracies. Refers to the job.
using GroupKey = std::tuple<std::uint64_t, std::string_view, std::string_view, double, double,
                            double, double, double, double>;

GroupKey key_of(const Job& job) {
  const ErrorWish& means = job.wish;
  const FitWish& fit = job.fit_wish;
  return {job.seed,
          job.label,
          job.parameters.text(),
          means.solid_fraction,
          means.coordination,
          fit.phi_bulk,
          fit.c,
          fit.z_bulk,
          fit.c_z};
}

bool has_fit_wish(const Sweep& whole) {
  return std::any_of(whole.jobs.begin(), whole.jobs.end(),
                     [](const Job& job) { return job.fit_wish.is_given(); });
}

void take_smaller(double FitWish::*part, const FitWish& other, FitWish& wish) {
  const double asked = other.*part;
  if (asked > 0.0 && (wish.*part == 0.0 || asked < wish.*part)) wish.*part = asked;
}

}  // namespace

bool may_grow(const Job& job) { return job.wish.is_given() || job.fit_wish.is_given(); }

bool grows(const Sweep& sweep) {
  return std::any_of(sweep.jobs.begin(), sweep.jobs.end(), may_grow);
}

std::vector<Places> groups_in(const Sweep& sweep) { return gathered(sweep.jobs, key_of); }

std::vector<Places> parameter_sets(const std::vector<Job>& jobs) { return gathered(jobs, set_of); }

std::vector<GrowingFamily> growing_families(const Sweep& whole, const std::vector<Places>& groups) {
  std::vector<GrowingFamily> families;
  if (!has_fit_wish(whole)) return families;
  std::vector<JobFacts> jobs;
  jobs.reserve(groups.size());
  for (const Places& group : groups) jobs.push_back(facts_of(whole.jobs[group.front()]));
  const std::vector<std::string> parameters = parameters_of_families(jobs);
  std::map<std::string, std::size_t> index_of;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Job& job = whole.jobs[groups[k].front()];
    const auto [known, is_new] = index_of.try_emplace(parameters[k], families.size());
    if (is_new) families.emplace_back();
    GrowingFamily& family = families[known->second];
    family.groups.push_back(k);
    for (double FitWish::*part : {&FitWish::phi_bulk, &FitWish::c, &FitWish::z_bulk, &FitWish::c_z})
      take_smaller(part, job.fit_wish, family.wish);
  }
  std::erase_if(families, [](const GrowingFamily& family) { return !family.wish.is_given(); });
  return families;
}

bool is_walled(const Job& job) { return job.spec.box.y == Boundary::walls; }

std::optional<ProtocolBias> bound_of(const Job& job) {
  auto bound = bias_bound(facts_of(job));
  if (bound && std::isnan(bound->coordination)) bound->coordination = 0.0;
  return bound;
}

bool is_bounded(const Job& job, const ErrorWish& wish) {
  const auto bound = bias_bound(facts_of(job));
  return bound && !(wish.coordination > 0.0 && std::isnan(bound->coordination));
}
bool is_bounded(const Job& job, const FitWish& wish) {
  return is_bounded(job, ErrorWish{wish.phi_bulk, wish.z_bulk});
}

}  // namespace grainsweep
