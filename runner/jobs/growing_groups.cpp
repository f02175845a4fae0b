#include "runner/jobs/growing_groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include "runner/jobs/growing_fits.hpp"
#include "runner/jobs/replicate_means.hpp"
#include "runner/jobs/split.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/tables/fits.hpp"
#include "runner/tables/job_facts.hpp"
#include "runner/tables/packing_names.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// Jobs of a group, which follow one another, by their places in the sweep.
struct Places {
  std::size_t begin = 0, end = 0;
};

std::vector<Places> groups_in(const Sweep& sweep) {
  std::vector<Places> groups;
  for (std::size_t i = 0; i < sweep.jobs.size(); ++i) {
    const Job& job = sweep.jobs[i];
    const Job* const before = i == 0 ? nullptr : &sweep.jobs[i - 1];
    if (before != nullptr && before->parameters == job.parameters && before->label == job.label) {
      groups.back().end = i + 1;
    } else {
      groups.push_back({i, i + 1});
    }
  }
  return groups;
}

bool has_fit_wish(const Sweep& whole) {
  return std::any_of(whole.jobs.begin(), whole.jobs.end(),
                     [](const Job& job) { return job.fit_wish.is_given(); });
}

std::optional<ProtocolBias> bound_of(const Job& job) { return bias_bound(facts_of(job)); }

/// The interval over what the wish leaves for it; at most 1 if the wish is met.
double over_wish(const Spread& spread, double wish, double bias) {
  return wish > 0.0 ? half_interval(spread.sd, spread.n) / (wish - bias) : 0.0;
}
double over_wishes(const Means& means, const ErrorWish& wish,
                   const std::optional<ProtocolBias>& bound) {
  const ProtocolBias bias = bound.value_or(ProtocolBias());
  return std::max(over_wish(means.solid_fraction, wish.solid_fraction, bias.solid_fraction),
                  over_wish(means.coordination, wish.coordination, bias.coordination));
}

std::vector<const Outcome*> made_of(const Sweep& sweep, const Places& group,
                                    const Outcomes& outcomes) {
  std::vector<const Outcome*> made;
  for (std::size_t i = group.begin; i < group.end; ++i) {
    const auto found = outcomes.find(sweep.jobs[i].id);
    const bool is_made = found != outcomes.end() && !found->second->exception;
    made.push_back(is_made ? &*found->second : nullptr);
  }
  return made;
}

/// What is called for of a growing group.
struct Called {
  std::vector<const Outcome*> made;
  std::optional<ProtocolBias> bound;
  int count = 0;
};
Called called_for(const Sweep& whole, const Places& group, const Outcomes& outcomes) {
  const Job& first = whole.jobs[group.begin];
  Called called{made_of(whole, group, outcomes), bound_of(first), 0};
  called.count = replicates_called_for(called.made, first.wish, called.bound);
  return called;
}

/// The groups that one wall effect is fitted to, by their places in the list of groups.
struct GrowingFamily {
  std::vector<std::size_t> groups;
  FitWish wish;
};

bool is_walled(const Job& job) { return job.spec.box.y == Boundary::walls; }

void take_smaller(double FitWish::*part, const FitWish& other, FitWish& wish) {
  const double asked = other.*part;
  if (asked > 0.0 && (wish.*part == 0.0 || asked < wish.*part)) wish.*part = asked;
}

/// Families whose fit is to have small errors; of several wishes for one fit the smallest holds.
std::vector<GrowingFamily> growing_families(const Sweep& whole, const std::vector<Places>& groups) {
  std::vector<GrowingFamily> families;
  if (!has_fit_wish(whole)) return families;
  std::map<std::string, std::size_t> index_of;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Job& job = whole.jobs[groups[k].begin];
    const auto [known, is_new] =
        index_of.try_emplace(parameters_of_family(facts_of(job)), families.size());
    if (is_new) families.emplace_back();
    GrowingFamily& family = families[known->second];
    family.groups.push_back(k);
    for (double FitWish::*part : {&FitWish::phi_bulk, &FitWish::c, &FitWish::z_bulk, &FitWish::c_z})
      take_smaller(part, job.fit_wish, family.wish);
  }
  std::erase_if(families, [](const GrowingFamily& family) { return !family.wish.is_given(); });
  return families;
}

/// A group of a fit. Those without walls tell how packings scatter, and have as many as all have at
/// first.
FitGroup fit_group_of(const Sweep& whole, const Places& group, const Outcomes& outcomes) {
  const Job& job = whole.jobs[group.begin];
  FitGroup of_fit{job.spec.box.width, is_walled(job), false, made_of(whole, group, outcomes)};
  if (!job.fit_wish.is_given()) return of_fit;
  of_fit.may_grow = of_fit.is_walled;
  if (!of_fit.is_walled && of_fit.made.size() > first_replicates) {
    of_fit.made.resize(first_replicates);
  }
  return of_fit;
}

CalledFit called_for(const Sweep& whole, const std::vector<Places>& groups,
                     const GrowingFamily& family, const Outcomes& outcomes) {
  std::vector<FitGroup> of_fit;
  of_fit.reserve(family.groups.size());
  for (const std::size_t k : family.groups) {
    of_fit.push_back(fit_group_of(whole, groups[k], outcomes));
  }
  const Job& first = whole.jobs[groups[family.groups.front()].begin];
  return called_for_fit(of_fit, family.wish, bound_of(first));
}

/// How many packings of each group are called for.
std::vector<std::size_t> counts_called_for(const Sweep& whole, const std::vector<Places>& groups,
                                           const Outcomes& outcomes) {
  std::vector<std::size_t> counts;
  counts.reserve(groups.size());
  for (const Places& group : groups) {
    counts.push_back(whole.jobs[group.begin].wish.is_given()
                         ? static_cast<std::size_t>(called_for(whole, group, outcomes).count)
                         : group.end - group.begin);
  }
  for (const GrowingFamily& family : growing_families(whole, groups)) {
    const CalledFit called = called_for(whole, groups, family, outcomes);
    for (std::size_t i = 0; i < family.groups.size(); ++i) {
      counts[family.groups[i]] = static_cast<std::size_t>(called.replicates[i]);
    }
  }
  return counts;
}

/// The sweep without the replicates that are not called for.
Sweep called_for(const Sweep& whole, const Outcomes& outcomes) {
  Sweep called{whole.name, whole.seed, whole.replicates, {}, whole.units};
  const std::vector<Places> groups = groups_in(whole);
  const std::vector<std::size_t> counts = counts_called_for(whole, groups, outcomes);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const auto first = whole.jobs.begin() + static_cast<std::ptrdiff_t>(groups[k].begin);
    called.jobs.insert(called.jobs.end(), first, first + static_cast<std::ptrdiff_t>(counts[k]));
  }
  return called;
}

void append_once(const std::string& line, std::string& text) {
  if (text.find(line) == std::string::npos) text += line;
}

void append_wish(const char* what, double wish, double bias, const Job& job, std::string& text) {
  if (wish == 0.0 || wish > bias) return;
  std::ostringstream line;
  line << "replicates.until of \"" << job.label << "\" asks for " << what << " within " << wish
       << ", but settled as \"" << facts_of(job).accuracy << "\" such packings may be off by "
       << bias << " however many there are; ask for more than that, or take a finer accuracy\n";
  append_once(line.str(), text);
}

/// What keeps the wishes of a fit from being met.
void append_fit(const Sweep& whole, const std::vector<Places>& groups, const GrowingFamily& family,
                std::string& text) {
  const Job* asking = nullptr;
  const Job* asks_of_means = nullptr;
  std::set<double> widths;
  for (const std::size_t k : family.groups) {
    const Job& job = whole.jobs[groups[k].begin];
    if (job.wish.is_given()) asks_of_means = &job;
    if (asking == nullptr && job.fit_wish.is_given()) asking = &job;
    if (is_walled(job)) widths.insert(job.spec.box.width);
  }
  const std::string start = "replicates.until of \"" + asking->label + "\" asks for a fit, ";
  if (widths.size() < 3) {
    append_once(start +
                    "which takes 3 or more widths between walls with otherwise equal "
                    "parameters, and there are " +
                    std::to_string(widths.size()) + "; add widths, or ask for errors of means\n",
                text);
  }
  if (asks_of_means != nullptr) {
    append_once(start + "and that of \"" + asks_of_means->label +
                    "\", of the same family, for errors of means; ask for one of them\n",
                text);
  }
  const ProtocolBias bias = bound_of(*asking).value_or(ProtocolBias());
  append_wish("phi_bulk", family.wish.phi_bulk, bias.solid_fraction, *asking, text);
  append_wish("Z_bulk", family.wish.z_bulk, bias.coordination, *asking, text);
}

/// Jobs that belong to one shard.
struct Part {
  std::vector<Places> jobs;
  Cost cost;
};

/// Adds a group to a part, with what it takes at first.
void add_group(const Sweep& whole, const Places& group, const std::vector<Cost>& costs,
               Part& part) {
  const Cost& one = costs[group.begin];
  const std::size_t count = may_grow(whole.jobs[group.begin])
                                ? static_cast<std::size_t>(first_replicates)
                                : group.end - group.begin;
  part.jobs.push_back(group);
  part.cost.cpu_seconds += one.cpu_seconds * static_cast<double>(count);
  part.cost.bytes = std::max(part.cost.bytes, one.bytes);
}

std::vector<Part> parts_of(const Sweep& whole, const std::vector<Cost>& costs) {
  const std::vector<Places> groups = groups_in(whole);
  std::vector<Part> parts;
  std::set<std::size_t> of_families;
  for (const GrowingFamily& family : growing_families(whole, groups)) {
    parts.emplace_back();
    for (const std::size_t k : family.groups) add_group(whole, groups[k], costs, parts.back());
    of_families.insert(family.groups.begin(), family.groups.end());
  }
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (of_families.contains(k)) continue;
    if (may_grow(whole.jobs[groups[k].begin])) {
      add_group(whole, groups[k], costs, parts.emplace_back());
      continue;
    }
    for (std::size_t i = groups[k].begin; i < groups[k].end; ++i) {
      parts.push_back({{{i, i + 1}}, costs[i]});
    }
  }
  return parts;
}

std::string unmeasured_text(std::size_t count, const char* noun) {
  if (count == 0) return "";
  return "; what settling does to the means of " + counted(count, noun) +
         " was not measured and is left out";
}

std::string end_of_text(std::size_t met, std::size_t all) {
  return met < all ? "; raise replicates.most for the others\n" : "\n";
}

/// Which groups have larger errors than wished, by their first jobs.
std::string missed_text(const Sweep& whole, const std::vector<const Job*>& missed) {
  constexpr std::size_t most_named = 5;
  if (missed.empty()) return "";
  const PackingNames names = names_in(whole);
  std::string text;
  for (std::size_t k = 0; k < std::min(missed.size(), most_named); ++k) {
    text += (k == 0 ? "Larger: " : "; ") + names.set_of(facts_of(*missed[k]));
  }
  if (missed.size() > most_named) {
    text += "; and " + counted(missed.size() - most_named, "other group");
  }
  return text + "\n";
}

std::string means_text(const Sweep& whole, const std::vector<Places>& all,
                       const Outcomes& outcomes) {
  std::size_t groups = 0, packings = 0, unbounded = 0;
  std::vector<const Job*> missed;
  for (const Places& group : all) {
    const ErrorWish& wish = whole.jobs[group.begin].wish;
    if (!wish.is_given()) continue;
    const Called called = called_for(whole, group, outcomes);
    ++groups;
    packings += static_cast<std::size_t>(called.count);
    unbounded += called.bound ? 0 : 1;
    const auto end = called.made.begin() + called.count;
    const bool is_made = std::find(called.made.begin(), end, nullptr) == end;
    const bool is_met =
        is_made && over_wishes(means_of(called.made, called.count), wish, called.bound) <= 1.0;
    if (!is_met) missed.push_back(&whole.jobs[group.begin]);
  }
  if (groups == 0) return "";
  const std::size_t met = groups - missed.size();
  return "Errors as asked for (95 %) in " + std::to_string(met) + " of " +
         counted(groups, "group") + ", by " + counted(packings, "packing") +
         unmeasured_text(unbounded, "group") + end_of_text(met, groups) +
         missed_text(whole, missed);
}

std::string fits_text(const Sweep& whole, const std::vector<Places>& groups,
                      const Outcomes& outcomes) {
  std::size_t met = 0, packings = 0, unbounded = 0, bent = 0;
  const std::vector<GrowingFamily> families = growing_families(whole, groups);
  if (families.empty()) return "";
  for (const GrowingFamily& family : families) {
    const CalledFit called = called_for(whole, groups, family, outcomes);
    for (const int count : called.replicates) packings += static_cast<std::size_t>(count);
    const bool is_met = called.is_made && called.is_met;
    const bool is_bent = called.chi2_per_dof > largest_chi2;
    met += is_met && !is_bent ? 1 : 0;
    bent += is_met && is_bent ? 1 : 0;
    unbounded += bound_of(whole.jobs[groups[family.groups.front()].begin]) ? 0 : 1;
  }
  std::string text = "Errors as asked for (95 %) in " + std::to_string(met) + " of " +
                     counted(families.size(), "fit") + ", by " + counted(packings, "packing") +
                     unmeasured_text(unbounded, "fit");
  if (bent > 0) {
    text += "; in " + std::to_string(bent) +
            " more the packings scatter as little, but the straight line does not hold: its errors "
            "in fits.csv are wider, and no packings mend it";
  }
  return text + end_of_text(met + bent, families.size());
}

}  // namespace

int replicates_called_for(const std::vector<const Outcome*>& made, const ErrorWish& wish,
                          const std::optional<ProtocolBias>& bound) {
  const int most = static_cast<int>(made.size());
  int count = std::min(first_replicates, most);
  while (std::find(made.begin(), made.begin() + count, nullptr) == made.begin() + count) {
    const double over = over_wishes(means_of(made, count), wish, bound);
    if (over <= 1.0 || count == most) return count;
    const double next = std::min(std::ceil(count * over * over), 2.0 * count);
    count = std::min(std::max(static_cast<int>(next), count + 1), most);
  }
  return count;
}

bool may_grow(const Job& job) { return job.wish.is_given() || job.fit_wish.is_given(); }

bool grows(const Sweep& sweep) {
  return std::any_of(sweep.jobs.begin(), sweep.jobs.end(), may_grow);
}

GrowingSweep::GrowingSweep(const Sweep& whole, const Outcomes& made)
    : whole_(whole), grows_(grows(whole)) {
  grow(made);
}

bool GrowingSweep::grow(const Outcomes& made) {
  if (!grows_) return false;
  const std::size_t before = called_.jobs.size();
  called_ = called_for(whole_, made);
  wishes_ = wishes_text(whole_, made);
  return called_.jobs.size() > before;
}

std::vector<int> shards_of(const Sweep& whole, int shards) {
  const std::vector<Cost> costs = costs_of(whole.jobs);
  if (!grows(whole)) return split(costs, shards);
  const std::vector<Part> parts = parts_of(whole, costs);
  std::vector<Cost> of_parts;
  of_parts.reserve(parts.size());
  for (const Part& part : parts) of_parts.push_back(part.cost);
  const std::vector<int> shard_of_part = split(of_parts, shards);
  std::vector<int> shard_of(whole.jobs.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const Places& places : parts[k].jobs) {
      std::fill(shard_of.begin() + static_cast<std::ptrdiff_t>(places.begin),
                shard_of.begin() + static_cast<std::ptrdiff_t>(places.end), shard_of_part[k]);
    }
  }
  return shard_of;
}

std::string unreachable_wishes(const Sweep& whole) {
  std::string text;
  if (!grows(whole)) return text;
  const std::vector<Places> groups = groups_in(whole);
  for (const Places& group : groups) {
    const Job& job = whole.jobs[group.begin];
    const auto bound = job.wish.is_given() ? bound_of(job) : std::nullopt;
    if (!bound) continue;
    append_wish("solid_fraction", job.wish.solid_fraction, bound->solid_fraction, job, text);
    append_wish("coordination", job.wish.coordination, bound->coordination, job, text);
  }
  for (const GrowingFamily& family : growing_families(whole, groups)) {
    append_fit(whole, groups, family, text);
  }
  return text;
}

std::string wishes_text(const Sweep& whole, const Outcomes& outcomes) {
  if (!grows(whole)) return "";
  const std::vector<Places> groups = groups_in(whole);
  return means_text(whole, groups, outcomes) + fits_text(whole, groups, outcomes);
}

}  // namespace grainsweep
