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
  std::size_t before = 0;     ///< packings that earlier runs made
  std::size_t finished = 0;   ///< packings that this run made
  std::size_t total = 0;      ///< packings of this run and of those before
  std::size_t running = 0;    ///< packings
  std::size_t unsettled = 0;  ///< of the finished ones: not settled or failed
  double share_done = 0.0;    ///< of this run's estimated work, 0..1
  double share_before = 0.0;  ///< of the work that earlier runs did, part of share_done
  double elapsed = 0.0;       ///< wall time, s
};

/// Wall time left if the work goes on as fast as so far, s; negative while nothing is done yet.
double time_left(const RunState& state);

/// "4:05", "1:02:03".
std::string clock_text(double seconds);

/// "[=======>      ]  12/30  41 %  2 running  0:35 elapsed, about 0:50 left": as much of it as fits
/// into a window of so many columns, at most 79 characters.
std::string progress_line(const RunState& state, int columns = 80);

enum class ProgressStyle { quiet, plain, live };

/// Live where standard error is a terminal that can redraw a line, plain elsewhere.
ProgressStyle progress_style();

/// Keeps the state of a run and shows it. All members may be called from any thread.
class ProgressDisplay {
 public:
  /// `costs`: estimated CPU time of each task, s. `before`: packings that earlier runs made.
  ProgressDisplay(std::vector<double> costs, ProgressStyle style, std::FILE* out,
                  std::size_t before = 0);

  void start();
  /// `share_done` of this task, 0..1. Draws five times a second at most.
  void advance(std::size_t task, double share_done);
  /// `line` describes the finished packing; plain style prints it.
  void finish(std::size_t task, bool is_settled, const std::string& line);
  /// Prints a line of its own, whatever the style.
  void say(const std::string& line);
  /// Removes the live line.
  void clear();

  RunState state() const;

 private:
  /// Notes how much of a task is done.
  void reach(std::size_t task, double share_done);
  RunState state_now() const;
  void draw(bool is_due);
  /// Removes the live line, which lies on several rows after a window has become narrower.
  void wipe();

  mutable std::mutex mutex_;
  std::vector<double> costs_;
  std::vector<double> shares_;
  std::vector<bool> is_under_way_;  ///< whether a share was given: the first is from earlier runs
  ProgressStyle style_;
  std::FILE* out_;
  double started_at_;
  double all_, done_ = 0.0;   ///< cost of all tasks, and of what is done of them, s
  double done_before_ = 0.0;  ///< by earlier runs
  double drawn_at_ = 0.0;
  int drawn_length_ = 0;  ///< of the line on the terminal, characters
  std::size_t before_, finished_ = 0, running_ = 0, unsettled_ = 0;
};

}  // namespace grainsweep
