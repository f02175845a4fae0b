// When a runner has to be done, and what it may still begin.
#pragma once

#include <optional>
#include <string_view>

#include "runner/machine.hpp"

namespace grainsweep {

/// The seconds in "90", "45:00" or "10:30:00"; nothing if the text is no such time above 0.
std::optional<double> seconds_in(std::string_view text);

/// A limit of wall time, counted from its construction. By default there is none.
class TimeLimit {
 public:
  TimeLimit() = default;
  /// `clock` gives the time, s from any beginning.
  explicit TimeLimit(double seconds, double (*clock)() = wall_seconds);

  /// The same end, for a run whose packings begin now: what came before took some of its time.
  TimeLimit from_now() const;

  /// Whether it is time to save what is under way and to write the tables: half a minute before the
  /// end, or a tenth of the limit if that is less.
  bool is_over() const;

  /// Whether a packing that takes so many seconds may begin: it would end in time, or it would not
  /// end within the whole limit either, so that it has to be saved at the end of some run.
  bool may_begin(double seconds) const;

 private:
  double left() const;

  double (*clock_)() = wall_seconds;
  std::optional<double> begun_at_;
  double usable_ = 0.0;  ///< from the beginning on, s
};

}  // namespace grainsweep
