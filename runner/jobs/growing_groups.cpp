#include "runner/jobs/growing_groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <sstream>

#include "runner/jobs/split.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/tables/groups.hpp"
#include "runner/tables/job_facts.hpp"
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

std::optional<ProtocolBias> bound_of(const Job& job) { return bias_bound(facts_of(job)); }

/// The settled ones of the first `count`.
struct Means {
  Spread solid_fraction, coordination;
};
Means means_of(const std::vector<const Outcome*>& made, int count) {
  std::vector<double> fractions, numbers;
  for (int i = 0; i < count; ++i) {
    const PackingResult& result = made[static_cast<std::size_t>(i)]->result;
    if (result.status != PackingStatus::settled || result.coordination.empty()) continue;
    fractions.push_back(result.solid_fraction);
    numbers.push_back(result.coordination.front().between_grains);
  }
  return {spread_of(fractions), spread_of(numbers)};
}

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
    const bool is_made = found != outcomes.end() && !found->second.exception;
    made.push_back(is_made ? &found->second : nullptr);
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

/// The sweep without the replicates that are not called for.
Sweep called_for(const Sweep& whole, const Outcomes& outcomes) {
  Sweep called{whole.name, whole.seed, whole.replicates, {}, whole.units};
  for (const Places& group : groups_in(whole)) {
    const auto count = whole.jobs[group.begin].wish.is_given()
                           ? static_cast<std::size_t>(called_for(whole, group, outcomes).count)
                           : group.end - group.begin;
    const auto first = whole.jobs.begin() + static_cast<std::ptrdiff_t>(group.begin);
    called.jobs.insert(called.jobs.end(), first, first + static_cast<std::ptrdiff_t>(count));
  }
  return called;
}

void append_wish(const char* what, double wish, double bias, const Job& job, std::string& text) {
  if (wish == 0.0 || wish > bias) return;
  std::ostringstream line;
  line << "replicates.until of \"" << job.label << "\" asks for " << what << " within " << wish
       << ", but settled as \"" << facts_of(job).accuracy << "\" such packings may be off by "
       << bias << " however many there are; ask for more than that, or take a finer accuracy\n";
  if (text.find(line.str()) == std::string::npos) text += line.str();
}

}  // namespace

double half_interval(double sd, int n) {
  if (n < 2) return std::numeric_limits<double>::infinity();
  // Quantile 0.975 of Student's distribution by that of the normal one (Abramowitz and Stegun
  // 26.7.5); from 5 degrees of freedom, which growing groups begin with, right to 1e-3.
  constexpr double x = 1.959963984540054, x2 = x * x;
  constexpr double terms[] = {
      x * (x2 + 1.0) / 4.0, x * ((5.0 * x2 + 16.0) * x2 + 3.0) / 96.0,
      x * (((3.0 * x2 + 19.0) * x2 + 17.0) * x2 - 15.0) / 384.0,
      x * ((((79.0 * x2 + 776.0) * x2 + 1482.0) * x2 - 1920.0) * x2 - 945.0) / 92160.0};
  double quantile = x, power = 1.0;
  for (const double term : terms) quantile += term / (power *= n - 1.0);
  return quantile * sd / std::sqrt(static_cast<double>(n));
}

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

bool grows(const Sweep& sweep) {
  return std::any_of(sweep.jobs.begin(), sweep.jobs.end(),
                     [](const Job& job) { return job.wish.is_given(); });
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
  std::vector<Places> parts;
  std::vector<Cost> of_parts;
  for (const Places& group : groups_in(whole)) {
    const bool is_one = whole.jobs[group.begin].wish.is_given();
    for (std::size_t i = group.begin; i < (is_one ? group.begin + 1 : group.end); ++i) {
      parts.push_back({i, is_one ? group.end : i + 1});
      of_parts.push_back(costs[i]);
      if (is_one) of_parts.back().cpu_seconds *= first_replicates;
    }
  }
  const std::vector<int> shard_of_part = split(of_parts, shards);
  std::vector<int> shard_of(whole.jobs.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::fill(shard_of.begin() + static_cast<std::ptrdiff_t>(parts[k].begin),
              shard_of.begin() + static_cast<std::ptrdiff_t>(parts[k].end), shard_of_part[k]);
  }
  return shard_of;
}

std::string unreachable_wishes(const Sweep& whole) {
  std::string text;
  if (!grows(whole)) return text;
  for (const Places& group : groups_in(whole)) {
    const Job& job = whole.jobs[group.begin];
    const auto bound = job.wish.is_given() ? bound_of(job) : std::nullopt;
    if (!bound) continue;
    append_wish("solid_fraction", job.wish.solid_fraction, bound->solid_fraction, job, text);
    append_wish("coordination", job.wish.coordination, bound->coordination, job, text);
  }
  return text;
}

std::string wishes_text(const Sweep& whole, const Outcomes& outcomes) {
  std::size_t groups = 0, met = 0, packings = 0, unbounded = 0;
  if (!grows(whole)) return "";
  for (const Places& group : groups_in(whole)) {
    const ErrorWish& wish = whole.jobs[group.begin].wish;
    if (!wish.is_given()) continue;
    const Called called = called_for(whole, group, outcomes);
    ++groups;
    packings += static_cast<std::size_t>(called.count);
    unbounded += called.bound ? 0 : 1;
    const auto end = called.made.begin() + called.count;
    const bool is_made = std::find(called.made.begin(), end, nullptr) == end;
    met += is_made && over_wishes(means_of(called.made, called.count), wish, called.bound) <= 1.0;
  }
  std::string text = "Errors as asked for (95 %) in " + std::to_string(met) + " of " +
                     counted(groups, "group") + ", by " + counted(packings, "packing");
  if (unbounded > 0) {
    text += "; what settling does to the means of " + counted(unbounded, "group") +
            " was not measured and is left out";
  }
  return text + (met < groups ? "; raise replicates.most for the others\n" : "\n");
}

}  // namespace grainsweep
