#include "runner/jobs/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "runner/machine.hpp"

namespace grainsweep {
namespace {

constexpr double seconds_between_drawings = 0.2;

std::string bar(double share, int width) {
  const int full = static_cast<int>(std::floor(share * width));
  std::string text(static_cast<std::size_t>(width), ' ');
  std::fill_n(text.begin(), full, '=');
  if (full < width) text[static_cast<std::size_t>(full)] = '>';
  return "[" + text + "]";
}

}  // namespace

double time_left(const RunState& state) {
  if (state.share_done <= 0.0) return -1.0;
  return state.elapsed * (1.0 - state.share_done) / state.share_done;
}

std::string clock_text(double seconds) {
  const long total = std::lround(std::max(0.0, seconds));
  std::array<char, 40> text{};
  if (total >= 3600) {
    std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld", total / 3600, total / 60 % 60,
                  total % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%ld:%02ld", total / 60, total % 60);
  }
  return text.data();
}

std::string progress_line(const RunState& state) {
  const double left = time_left(state);
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), " %zu/%zu  %3d %%  %zu running  %s elapsed, %s",
                state.finished, state.total, static_cast<int>(100.0 * state.share_done),
                state.running, clock_text(state.elapsed).c_str(),
                left < 0 ? "time left unknown" : ("about " + clock_text(left) + " left").c_str());
  std::string rest = text.data();
  if (state.unsettled > 0) rest += ", " + std::to_string(state.unsettled) + " not settled";
  const int width = std::clamp(79 - static_cast<int>(rest.size()) - 2, 4, 24);
  return (bar(state.share_done, width) + rest).substr(0, 79);
}

ProgressDisplay::ProgressDisplay(std::vector<double> costs, ProgressStyle style, std::FILE* out)
    : costs_(std::move(costs)),
      shares_(costs_.size(), 0.0),
      style_(style),
      out_(out),
      started_at_(wall_seconds()) {}

void ProgressDisplay::start(std::size_t /*task*/) {
  const std::scoped_lock lock(mutex_);
  ++running_;
  draw(true);
}

void ProgressDisplay::advance(std::size_t task, double share_done) {
  const std::scoped_lock lock(mutex_);
  shares_[task] = std::clamp(share_done, shares_[task], 1.0);
  draw(wall_seconds() - drawn_at_ > seconds_between_drawings);
}

void ProgressDisplay::finish(std::size_t task, bool is_settled, const std::string& line) {
  const std::scoped_lock lock(mutex_);
  shares_[task] = 1.0;
  --running_;
  ++finished_;
  unsettled_ += is_settled ? 0 : 1;
  if (style_ == ProgressStyle::plain) {
    std::fprintf(out_, "%zu/%zu  %s\n", finished_, costs_.size(), line.c_str());
    std::fflush(out_);
  }
  draw(true);
}

void ProgressDisplay::say(const std::string& line) {
  const std::scoped_lock lock(mutex_);
  const char* const live_line_away = style_ == ProgressStyle::live ? "\r\033[K" : "";
  std::fprintf(out_, "%s%s\n", live_line_away, line.c_str());
  std::fflush(out_);
  draw(true);
}

void ProgressDisplay::clear() {
  const std::scoped_lock lock(mutex_);
  if (style_ != ProgressStyle::live) return;
  std::fputs("\r\033[K", out_);
  std::fflush(out_);
}

RunState ProgressDisplay::state() const {
  const std::scoped_lock lock(mutex_);
  return state_now();
}

RunState ProgressDisplay::state_now() const {
  const double all = std::accumulate(costs_.begin(), costs_.end(), 0.0);
  const double done = std::inner_product(costs_.begin(), costs_.end(), shares_.begin(), 0.0);
  RunState state;
  state.finished = finished_;
  state.total = costs_.size();
  state.running = running_;
  state.unsettled = unsettled_;
  state.share_done = all > 0 ? done / all : 0.0;
  state.elapsed = wall_seconds() - started_at_;
  return state;
}

void ProgressDisplay::draw(bool is_due) {
  if (!is_due || style_ != ProgressStyle::live) return;
  drawn_at_ = wall_seconds();
  std::fprintf(out_, "\r%s\033[K", progress_line(state_now()).c_str());
  std::fflush(out_);
}

}  // namespace grainsweep
