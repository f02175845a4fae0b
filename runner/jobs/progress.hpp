// How far a run is: one live line on a terminal, a line per finished packing elsewhere.
#pragma once

#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

namespace grainsweep {

/// A run at one moment.
struct RunState {
  std::size_t finished = 0;   ///< packings
  std::size_t total = 0;      ///< packings of this run
  std::size_t running = 0;    ///< packings
  std::size_t unsettled = 0;  ///< of the finished ones: not settled or failed
  double share_done = 0.0;    ///< of the estimated work, 0..1
  double elapsed = 0.0;       ///< wall time, s
};

/// Wall time left if the work goes on as fast as so far, s; negative while nothing is done yet.
double time_left(const RunState& state);

/// "4:05", "1:02:03".
std::string clock_text(double seconds);

/// "[=======>      ]  12/30  41 %  2 running  0:35 elapsed, about 0:50 left", at most 79 columns.
std::string progress_line(const RunState& state);

enum class ProgressStyle { quiet, plain, live };

/// Keeps the state of a run and shows it. All members may be called from any thread.
class ProgressDisplay {
 public:
  /// `costs`: estimated CPU time of each task, s.
  ProgressDisplay(std::vector<double> costs, ProgressStyle style, std::FILE* out);

  void start(std::size_t task);
  /// `share_done` of this task, 0..1. Draws five times a second at most.
  void advance(std::size_t task, double share_done);
  /// `line` describes the finished packing; plain style prints it.
  void finish(std::size_t task, bool is_settled, const std::string& line);
  /// Prints a line of its own, whatever the style.
  void say(const std::string& line);
  /// Takes the live line away.
  void clear();

  RunState state() const;

 private:
  RunState state_now() const;
  void draw(bool is_due);

  mutable std::mutex mutex_;
  std::vector<double> costs_;
  std::vector<double> shares_;
  ProgressStyle style_;
  std::FILE* out_;
  double started_at_;
  double drawn_at_ = 0.0;
  std::size_t finished_ = 0, running_ = 0, unsettled_ = 0;
};

}  // namespace grainsweep
