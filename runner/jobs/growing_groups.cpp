#include "runner/jobs/growing_groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "engine/dynamics/presets.hpp"
#include "engine/units.hpp"
#include "runner/analysis/fit.hpp"
#include "runner/jobs/estimates.hpp"
#include "runner/jobs/growing_fits.hpp"
#include "runner/jobs/replicate_means.hpp"
#include "runner/sweep/bed_kind.hpp"
#include "runner/tables/fits.hpp"
#include "runner/tables/job_facts.hpp"
#include "runner/tables/packing_names.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// The interval over what the request leaves for it; at most 1 if the request is met, and infinite
/// if the bias leaves nothing.
double over_wish(double interval, double wish, double bias) {
  if (wish == 0.0) return 0.0;
  return wish > bias ? interval / (wish - bias) : infinity;
}

/// Half of the 95 % interval of the mean solid fraction; see error_of_layers.
double interval_of_phi(const Means& means) {
  const Spread& phi = means.solid_fraction;
  const double of_layers = means.are_of_one_state()
                               ? normal_quantile * error_of_layers(phi.mean, means.slab_height.mean)
                               : 0.0;
  return std::hypot(half_interval(phi.sd, phi.n), of_layers);
}
double over_wishes(const Means& means, const ErrorWish& wish,
                   const std::optional<ProtocolBias>& bound) {
  const ProtocolBias bias = bound.value_or(ProtocolBias());
  const double interval_of_z = half_interval(means.coordination.sd, means.coordination.n);
  return std::max(over_wish(interval_of_phi(means), wish.solid_fraction, bias.solid_fraction),
                  over_wish(interval_of_z, wish.coordination, bias.coordination));
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

bool are_made(const std::vector<const Outcome*>& made, int count) {
  return std::find(made.begin(), made.begin() + count, nullptr) == made.begin() + count;
}

/// How many packings a growing group calls for.
int count_called_for(const Sweep& whole, const Places& group, const Outcomes& outcomes) {
  const Job& first = whole.jobs[group.front()];
  return replicates_called_for(made_of(whole, group, outcomes), first.wish, bound_of(first));
}

/// A group of a fit. Those without walls only show how packings scatter.
FitGroup fit_group_of(const Sweep& whole, const Places& group, std::size_t mean,
                      const Outcomes& outcomes) {
  const Job& job = whole.jobs[group.front()];
  const bool walled = is_walled(job);
  return {mean,
          job.spec.box.width,
          job.spec.box.floor_area(),
          walled,
          walled && job.fit_wish.is_given(),
          made_of(whole, group, outcomes),
          is_narrow(job.spec.box)};
}

/// The first jobs of the groups of a fit, but for narrow ones that its line leaves out.
std::vector<const Job*> jobs_of_fit(const Sweep& whole, const std::vector<Places>& groups,
                                    const GrowingFamily& family) {
  std::vector<LineWidth> widths;
  for (const std::size_t k : family.groups) {
    const Job& job = whole.jobs[groups[k].front()];
    widths.push_back({job.spec.box.width, is_narrow(job.spec.box) || !is_walled(job)});
  }
  const std::vector<bool> are_on_line = widths_on_line(widths);
  std::vector<const Job*> jobs;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const Job& job = whole.jobs[groups[family.groups[i]].front()];
    if (are_on_line[i] || !is_walled(job)) jobs.push_back(&job);
  }
  return jobs;
}

/// The largest bounds of the bias of settling among these; nothing if one has none.
std::optional<ProtocolBias> largest_bound(const std::vector<const Job*>& jobs) {
  ProtocolBias largest;
  for (const Job* job : jobs) {
    const auto bound = bound_of(*job);
    if (!bound) return std::nullopt;
    largest.solid_fraction = std::max(largest.solid_fraction, bound->solid_fraction);
    largest.coordination = std::max(largest.coordination, bound->coordination);
  }
  return largest;
}

CalledFit called_for(const Sweep& whole, const std::vector<Places>& groups,
                     const GrowingFamily& family, const Outcomes& outcomes) {
  std::vector<FitGroup> of_fit;
  of_fit.reserve(family.groups.size());
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> means;  // as in groups.csv
  for (const std::size_t k : family.groups) {
    const Job& job = whole.jobs[groups[k].front()];
    const std::size_t mean =
        means.try_emplace({job.label, job.parameters.text()}, means.size()).first->second;
    of_fit.push_back(fit_group_of(whole, groups[k], mean, outcomes));
  }
  return called_for_fit(of_fit, family.wish, largest_bound(jobs_of_fit(whole, groups, family)));
}

/// How many packings of each group are called for.
std::vector<std::size_t> counts_called_for(const Sweep& whole, const std::vector<Places>& groups,
                                           const Outcomes& outcomes) {
  std::vector<std::size_t> counts;
  counts.reserve(groups.size());
  for (const Places& group : groups) {
    counts.push_back(whole.jobs[group.front()].wish.is_given()
                         ? static_cast<std::size_t>(count_called_for(whole, group, outcomes))
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

/// Where the requested accuracies of the job's block are written.
std::string place_of_wishes(const Sweep& whole, const Job& job) {
  const auto& pointers = whole.wish_pointers;
  return job.block < pointers.size() ? pointers[job.block] : "";
}

std::string place_of(const std::string& wish, const Sweep& whole, const Job& job) {
  return place_of_wishes(whole, job) + "/" + wish;
}

/// The presets whose beds may be off by less than `wish`, as an alternative; "" if there is none.
std::string finer_text(const Job& job, double wish, double ProtocolBias::*bound) {
  JobFacts facts = facts_of(job);
  for (const Preset& preset : presets()) {
    facts.settles_as = preset.name;
    const auto bias = bias_bound(facts);
    if (bias && (*bias).*bound < wish) return ", or take \"" + facts.settles_as + "\"";
  }
  return "";
}

double bias_of(const Job& job, double ProtocolBias::*bound) {
  return bound_of(job).value_or(ProtocolBias()).*bound;
}

/// Notes an error requested by a job, called `key` in the file, that is no larger than the bias of
/// settling of packings as those of `worst`.
void refuse_wish(const std::string& key, double wish, double ProtocolBias::*bound,
                 const Sweep& whole, const Job& asking, const Job& worst,
                 Diagnostics& diagnostics) {
  const double bias = bias_of(worst, bound);
  if (wish == 0.0 || wish > bias) return;
  std::ostringstream message;
  message << "cannot be met in \"" << worst.label << "\": settled as \""
          << settles_as(worst.spec.accuracy) << "\" such packings may be off by " << bias
          << " however many there are; ask for more than that" << finer_text(worst, wish, bound);
  diagnostics.push_back({place_of(key, whole, asking), message.str()});
}

/// Of the jobs of each block the one with the largest bound.
std::vector<const Job*> worst_of_blocks(const Sweep& whole, const std::vector<const Job*>& jobs,
                                        double ProtocolBias::*bound) {
  std::vector<const Job*> worst;
  for (const Job* job : jobs) {
    const auto same = std::find_if(worst.begin(), worst.end(), [&](const Job* other) {
      return place_of_wishes(whole, *other) == place_of_wishes(whole, *job);
    });
    if (same == worst.end()) {
      worst.push_back(job);
    } else if (bias_of(*job, bound) > bias_of(**same, bound)) {
      *same = job;
    }
  }
  return worst;
}

/// Notes a requested error of a fit, called `key` in the file, wherever it is requested, that is no
/// larger than the bias of settling of the packings on its line.
void refuse_fit_wish(const std::string& key, double FitWish::*wish, double ProtocolBias::*bound,
                     const Sweep& whole, const std::vector<Places>& groups,
                     const GrowingFamily& family, Diagnostics& diagnostics) {
  const std::vector<const Job*> on_line = jobs_of_fit(whole, groups, family);
  if (!largest_bound(on_line)) return;
  const Job& worst = **std::max_element(
      on_line.begin(), on_line.end(),
      [&](const Job* a, const Job* b) { return bias_of(*a, bound) < bias_of(*b, bound); });
  std::set<std::string> places;
  for (const std::size_t k : family.groups) {
    const Job& job = whole.jobs[groups[k].front()];
    if (!places.insert(place_of_wishes(whole, job)).second) continue;
    refuse_wish(key, job.fit_wish.*wish, bound, whole, job, worst, diagnostics);
  }
}

/// Notes why the requested errors of a fit cannot be reached.
void refuse_fit(const Sweep& whole, const std::vector<Places>& groups, const GrowingFamily& family,
                Diagnostics& diagnostics) {
  const Job* asking = nullptr;
  const Job* asks_of_means = nullptr;
  std::set<double> widths;
  for (const std::size_t k : family.groups) {
    const Job& job = whole.jobs[groups[k].front()];
    if (job.wish.is_given()) asks_of_means = &job;
    if (asking == nullptr && job.fit_wish.is_given()) asking = &job;
    if (is_walled(job)) widths.insert(job.spec.box.width);
  }
  const std::string place = place_of("fit", whole, *asking);
  const std::string start = "cannot be had of \"" + asking->label + "\": ";
  if (widths.size() < least_widths_of_line) {
    diagnostics.push_back({place, start +
                                      "a fit takes 3 or more widths between walls with otherwise "
                                      "equal parameters, and there are " +
                                      std::to_string(widths.size()) +
                                      "; add widths, or ask for errors of means"});
  }
  if (asks_of_means != nullptr) {
    diagnostics.push_back({place, start + "\"" + asks_of_means->label +
                                      "\", of the same family, asks for errors of means; ask for "
                                      "one of them"});
  }
  refuse_fit_wish("fit/phi_bulk", &FitWish::phi_bulk, &ProtocolBias::solid_fraction, whole, groups,
                  family, diagnostics);
  refuse_fit_wish("fit/Z_bulk", &FitWish::z_bulk, &ProtocolBias::coordination, whole, groups,
                  family, diagnostics);
}

std::string unmeasured_text(std::size_t count, const char* noun) {
  if (count == 0) return "";
  return "; what settling does to the means of " + counted(count, noun) +
         " was not measured and is left out";
}

using Firsts = std::vector<const Job*>;  // of groups, or of families

/// What became of the requests of groups, or of fits. Those not made say so themselves.
struct Grown {
  std::size_t all = 0, packings = 0, unbounded = 0;
  std::size_t met = 0;
  std::size_t at_most = 0;  ///< of `larger`: these would grow but for replicates.most
  Firsts larger, seldom_settled, bent, without_errors;
};

/// Whether seeds tell groups apart.
bool has_seeds(const Sweep& whole) {
  return std::any_of(whole.jobs.begin(), whole.jobs.end(),
                     [&](const Job& job) { return job.seed != whole.jobs.front().seed; });
}

/// What tells a group, or a family, from the others.
using NameOf = std::string (PackingNames::*)(const JobFacts&) const;

/// Names some of them.
std::string named_text(const std::string& title, const Firsts& firsts, NameOf name,
                       const Sweep& whole, const PackingNames& names) {
  constexpr std::size_t most_named = 5;
  if (firsts.empty()) return "";
  const bool tells_seed = name == &PackingNames::set_of && has_seeds(whole);
  std::string text;
  for (std::size_t k = 0; k < std::min(firsts.size(), most_named); ++k) {
    text += (k == 0 ? title + ": " : "; ") + (names.*name)(facts_of(*firsts[k]));
    if (tells_seed) text += ", seed " + std::to_string(firsts[k]->seed);
  }
  if (firsts.size() > most_named) {
    text += "; and " + std::to_string(firsts.size() - most_named) + " more";
  }
  return text + "\n";
}

std::string counts_text(const Grown& grown, const char* noun) {
  const auto in = [](const Firsts& firsts) { return "; in " + std::to_string(firsts.size()); };
  std::string text = "Errors as asked for (95 %) in " + std::to_string(grown.met) + " of " +
                     counted(grown.all, noun) + ", by " + counted(grown.packings, "packing") +
                     unmeasured_text(grown.unbounded, noun);
  if (!grown.bent.empty()) {
    text +=
        in(grown.bent) +
        " the packings scatter as little, but their means miss the straight line by more: errors "
        "in fits.csv are wider, and no packings mend it";
  }
  if (!grown.without_errors.empty()) {
    text +=
        in(grown.without_errors) +
        " the packings do not scatter, and tell no error: no more of them help, but higher beds "
        "may";
  }
  if (!grown.seldom_settled.empty()) {
    text += "; " + std::to_string(grown.seldom_settled.size()) +
            " stopped growing, since fewer than one packing in six settles";
  }
  if (grown.at_most > 0) text += "; raise replicates.most for the others";
  return text + "\n";
}

std::string text_of(const Grown& grown, const char* noun, NameOf name, const Sweep& whole) {
  if (grown.all == 0) return "";
  const PackingNames names = grown.met == grown.all ? PackingNames() : names_in(whole);
  return counts_text(grown, noun) + named_text("Larger", grown.larger, name, whole, names) +
         named_text("Seldom settle", grown.seldom_settled, name, whole, names) +
         named_text("Off the line", grown.bent, name, whole, names) +
         named_text("No scatter", grown.without_errors, name, whole, names);
}

void add_group(const Sweep& whole, const Places& group, const Outcomes& outcomes, Grown& grown) {
  const Job& first = whole.jobs[group.front()];
  const std::vector<const Outcome*> made = made_of(whole, group, outcomes);
  const auto bound = bound_of(first);
  const int count = replicates_called_for(made, first.wish, bound);
  ++grown.all;
  grown.packings += static_cast<std::size_t>(count);
  grown.unbounded += is_bounded(first, first.wish) ? 0 : 1;
  if (!are_made(made, count)) return grown.larger.push_back(&first);
  const Means means = means_of(made, count);
  if (over_wishes(means, first.wish, bound) <= 1.0) {
    ++grown.met;
  } else if (means.are_of_one_state()) {
    grown.without_errors.push_back(&first);
  } else if (settle_too_seldom(means.solid_fraction.n, count)) {
    grown.seldom_settled.push_back(&first);
  } else {
    ++grown.at_most;
    grown.larger.push_back(&first);
  }
}

void add_fit(const Sweep& whole, const std::vector<Places>& groups, const GrowingFamily& family,
             const Outcomes& outcomes, Grown& grown) {
  const Job& first = whole.jobs[groups[family.groups.front()].front()];
  const CalledFit called = called_for(whole, groups, family, outcomes);
  ++grown.all;
  for (const int count : called.replicates) grown.packings += static_cast<std::size_t>(count);
  const bool are_bounded = std::all_of(
      family.groups.begin(), family.groups.end(),
      [&](std::size_t k) { return is_bounded(whole.jobs[groups[k].front()], family.wish); });
  grown.unbounded += are_bounded ? 0 : 1;
  if (!called.is_made) return grown.larger.push_back(&first);
  if (!called.tells_errors) {
    grown.without_errors.push_back(&first);
  } else if (called.is_met) {
    if (called.over_widened > 1.0) return grown.bent.push_back(&first);
    ++grown.met;
  } else if (called.settles_too_seldom) {
    grown.seldom_settled.push_back(&first);
  } else {
    ++grown.at_most;
    grown.larger.push_back(&first);
  }
}

}  // namespace

int replicates_called_for(const std::vector<const Outcome*>& made, const ErrorWish& wish,
                          const std::optional<ProtocolBias>& bound) {
  const int most = static_cast<int>(made.size());
  int count = std::min(first_replicates, most);
  while (are_made(made, count)) {
    const Means means = means_of(made, count);
    const double over = over_wishes(means, wish, bound);
    const bool is_enough = over <= 1.0 || means.are_of_one_state();  // more would be the same
    if (is_enough || count == most || settle_too_seldom(means.solid_fraction.n, count)) {
      return count;
    }
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
  std::unordered_set<std::string> before;
  for (const Job& job : called_.jobs) before.insert(job.id);
  called_ = called_for(whole_, made);
  return std::any_of(called_.jobs.begin(), called_.jobs.end(),
                     [&](const Job& job) { return !before.contains(job.id); });
}

Diagnostics unreachable_wishes(const Sweep& whole) {
  Diagnostics diagnostics;
  if (!grows(whole)) return diagnostics;
  const std::vector<Places> groups = groups_in(whole);
  std::vector<const Job*> asking;
  for (const Places& group : groups) {
    const Job& job = whole.jobs[group.front()];
    if (job.wish.is_given()) asking.push_back(&job);
  }
  for (const Job* job : worst_of_blocks(whole, asking, &ProtocolBias::solid_fraction)) {
    refuse_wish("solid_fraction", job->wish.solid_fraction, &ProtocolBias::solid_fraction, whole,
                *job, *job, diagnostics);
  }
  for (const Job* job : worst_of_blocks(whole, asking, &ProtocolBias::coordination)) {
    refuse_wish("coordination", job->wish.coordination, &ProtocolBias::coordination, whole, *job,
                *job, diagnostics);
  }
  for (const GrowingFamily& family : growing_families(whole, groups)) {
    refuse_fit(whole, groups, family, diagnostics);
  }
  return diagnostics;
}

Diagnostics notes_on_unbounded_wishes(const Sweep& whole) {
  if (!grows(whole)) return {};
  std::map<std::string, std::size_t> groups_at;  // by the place of the request
  for (const Places& group : groups_in(whole)) {
    const Job& job = whole.jobs[group.front()];
    const ErrorWish wish{std::max(job.wish.solid_fraction, job.fit_wish.phi_bulk),
                         std::max(job.wish.coordination, job.fit_wish.z_bulk)};
    if (!wish.is_given() || is_bounded(job, wish)) continue;
    ++groups_at[place_of_wishes(whole, job)];
  }
  Diagnostics notes;
  for (const auto& [place, count] : groups_at) {
    notes.push_back({place,
                     "what settling does to the means of " + counted(count, "parameter set") +
                         " was not measured; their errors will be those of the scatter alone",
                     Anchor::key, "", true});
  }
  return notes;
}

std::string growth_text(const std::vector<Cost>& most) {
  return "Groups grow until their errors are as asked for: at most " +
         counted(most.size(), "packing") + ", " + duration_text(total_cpu_seconds(most)) + " CPU";
}

std::string wishes_text(const Sweep& whole, const Outcomes& outcomes) {
  if (!grows(whole)) return "";
  const std::vector<Places> groups = groups_in(whole);
  Grown means, fits;
  for (const Places& group : groups) {
    if (whole.jobs[group.front()].wish.is_given()) add_group(whole, group, outcomes, means);
  }
  for (const GrowingFamily& family : growing_families(whole, groups)) {
    add_fit(whole, groups, family, outcomes, fits);
  }
  return text_of(means, "group", &PackingNames::set_of, whole) +
         text_of(fits, "fit", &PackingNames::family_of, whole);
}

}  // namespace grainsweep
