#include "runner/jobs/growing_groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>

#include "runner/jobs/growing_fits.hpp"
#include "runner/jobs/replicate_means.hpp"
#include "runner/tables/job_facts.hpp"
#include "runner/tables/packing_names.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

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
  for (const std::size_t i : group) {
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
  const Job& first = whole.jobs[group.front()];
  Called called{made_of(whole, group, outcomes), bound_of(first), 0};
  called.count = replicates_called_for(called.made, first.wish, called.bound);
  return called;
}

/// A group of a fit. Those without walls tell how packings scatter, and have as many as all have at
/// first.
FitGroup fit_group_of(const Sweep& whole, const Places& group, const Outcomes& outcomes) {
  const Job& job = whole.jobs[group.front()];
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
  const Job& first = whole.jobs[groups[family.groups.front()].front()];
  return called_for_fit(of_fit, family.wish, bound_of(first));
}

/// How many packings of each group are called for.
std::vector<std::size_t> counts_called_for(const Sweep& whole, const std::vector<Places>& groups,
                                           const Outcomes& outcomes) {
  std::vector<std::size_t> counts;
  counts.reserve(groups.size());
  for (const Places& group : groups) {
    counts.push_back(whole.jobs[group.front()].wish.is_given()
                         ? static_cast<std::size_t>(called_for(whole, group, outcomes).count)
                         : group.size());
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
  Places places;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const auto end = groups[k].begin() + static_cast<std::ptrdiff_t>(counts[k]);
    places.insert(places.end(), groups[k].begin(), end);
  }
  std::sort(places.begin(), places.end());
  called.jobs.reserve(places.size());
  for (const std::size_t i : places) called.jobs.push_back(whole.jobs[i]);
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
    const Job& job = whole.jobs[groups[k].front()];
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

std::string unmeasured_text(std::size_t count, const char* noun) {
  if (count == 0) return "";
  return "; what settling does to the means of " + counted(count, noun) +
         " was not measured and is left out";
}

std::string end_of_text(std::size_t met, std::size_t all) {
  return met < all ? "; raise replicates.most for the others\n" : "\n";
}

/// Whether seeds tell groups apart.
bool has_seeds(const Sweep& whole) {
  return std::any_of(whole.jobs.begin(), whole.jobs.end(),
                     [&](const Job& job) { return job.seed != whole.jobs.front().seed; });
}

/// Which groups have larger errors than wished, by their first jobs.
std::string missed_text(const Sweep& whole, const std::vector<const Job*>& missed) {
  constexpr std::size_t most_named = 5;
  if (missed.empty()) return "";
  const PackingNames names = names_in(whole);
  std::string text;
  for (std::size_t k = 0; k < std::min(missed.size(), most_named); ++k) {
    text += (k == 0 ? "Larger: " : "; ") + names.set_of(facts_of(*missed[k]));
    if (has_seeds(whole)) text += ", seed " + std::to_string(missed[k]->seed);
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
    const ErrorWish& wish = whole.jobs[group.front()].wish;
    if (!wish.is_given()) continue;
    const Called called = called_for(whole, group, outcomes);
    ++groups;
    packings += static_cast<std::size_t>(called.count);
    unbounded += called.bound ? 0 : 1;
    const auto end = called.made.begin() + called.count;
    const bool is_made = std::find(called.made.begin(), end, nullptr) == end;
    const bool is_met =
        is_made && over_wishes(means_of(called.made, called.count), wish, called.bound) <= 1.0;
    if (!is_met) missed.push_back(&whole.jobs[group.front()]);
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
    unbounded += bound_of(whole.jobs[groups[family.groups.front()].front()]) ? 0 : 1;
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

std::string unreachable_wishes(const Sweep& whole) {
  std::string text;
  if (!grows(whole)) return text;
  const std::vector<Places> groups = groups_in(whole);
  for (const Places& group : groups) {
    const Job& job = whole.jobs[group.front()];
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
