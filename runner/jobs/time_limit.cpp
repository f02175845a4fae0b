#include "runner/jobs/time_limit.hpp"

#include <algorithm>
#include <charconv>

namespace grainsweep {

std::optional<double> seconds_in(std::string_view text) {
  double seconds = 0.0;
  for (int part = 0; part < 3; ++part) {
    unsigned number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || (part > 0 && number > 59)) return std::nullopt;
    seconds = 60.0 * seconds + number;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty()) return seconds > 0.0 ? std::optional(seconds) : std::nullopt;
    if (text.front() != ':') return std::nullopt;
    text.remove_prefix(1);
  }
  return std::nullopt;
}

TimeLimit::TimeLimit(double seconds, double (*clock)())
    : clock_(clock), begun_at_(clock()), usable_(seconds - std::min(30.0, 0.1 * seconds)) {}

TimeLimit TimeLimit::from_now() const {
  TimeLimit rest = *this;
  if (begun_at_) rest.begun_at_ = clock_(), rest.usable_ = left();
  return rest;
}

double TimeLimit::left() const { return usable_ - (clock_() - *begun_at_); }

bool TimeLimit::is_over() const { return begun_at_ && left() <= 0.0; }

bool TimeLimit::may_begin(double seconds) const {
  return !begun_at_ || seconds <= left() || (seconds > usable_ && !is_over());
}

}  // namespace grainsweep
