#include "runner/jobs/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <unistd.h>
#include <utility>

#include <sys/ioctl.h>

#include "runner/machine.hpp"
#include "runner/text.hpp"

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

/// Columns of the terminal's window now; the usual number if there is none.
int columns_of(std::FILE* out) {
  winsize window{};
  const bool is_known = ioctl(fileno(out), TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
  return is_known ? window.ws_col : 80;
}

}  // namespace

double time_left(const RunState& state) {
  const double now = state.share_done - state.share_before;
  return now > 0.0 ? state.elapsed * (1.0 - state.share_done) / now : -1.0;
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

std::string progress_line(const RunState& state, int columns) {
  const double left = time_left(state);
  const std::string count =
      " " + std::to_string(state.before + state.finished) + "/" + std::to_string(state.total) +
      "  " + pad_left(std::to_string(static_cast<int>(100.0 * state.share_done)), 3) + " %";
  const std::string running = "  " + std::to_string(state.running) + " running";
  const std::string elapsed = "  " + clock_text(state.elapsed) + " elapsed,";
  const std::string rest = left < 0 ? " time left unknown" : " about " + clock_text(left) + " left";
  const std::string unsettled =
      state.unsettled > 0 ? ", " + std::to_string(state.unsettled) + " not settled" : "";
  const std::size_t room = static_cast<std::size_t>(std::clamp(columns, 2, 80)) - 1;
  constexpr std::size_t least_bar = 6, widest_bar = 26;
  for (const std::string& text : {count + running + elapsed + rest + unsettled,
                                  count + running + elapsed + rest, count + " " + rest, count}) {
    if (text.size() + least_bar > room) continue;
    const std::size_t width = std::min(room - text.size(), widest_bar);
    return bar(state.share_done, static_cast<int>(width) - 2) + text;
  }
  return count.substr(1, room);
}

ProgressStyle progress_style() {
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
  return isatty(STDERR_FILENO) != 0 && can_redraw ? ProgressStyle::live : ProgressStyle::plain;
}

ProgressDisplay::ProgressDisplay(std::vector<double> costs, ProgressStyle style, std::FILE* out,
                                 std::size_t before)
    : costs_(std::move(costs)),
      shares_(costs_.size(), 0.0),
      is_under_way_(costs_.size(), false),
      style_(style),
      out_(out),
      started_at_(wall_seconds()),
      all_(std::accumulate(costs_.begin(), costs_.end(), 0.0)),
      before_(before) {}

void ProgressDisplay::start() {
  const std::scoped_lock lock(mutex_);
  ++running_;
  draw(true);
}

void ProgressDisplay::advance(std::size_t task, double share_done) {
  const std::scoped_lock lock(mutex_);
  reach(task, std::clamp(share_done, shares_[task], 1.0));
  if (!is_under_way_[task]) done_before_ += costs_[task] * shares_[task];
  is_under_way_[task] = true;
  draw(wall_seconds() - drawn_at_ > seconds_between_drawings);
}

void ProgressDisplay::finish(std::size_t task, bool is_settled, const std::string& line) {
  const std::scoped_lock lock(mutex_);
  reach(task, 1.0);
  --running_;
  ++finished_;
  unsettled_ += is_settled ? 0 : 1;
  if (style_ == ProgressStyle::plain) {
    std::fprintf(out_, "%zu/%zu  %s\n", before_ + finished_, before_ + costs_.size(), line.c_str());
    std::fflush(out_);
  }
  draw(true);
}

void ProgressDisplay::say(const std::string& line) {
  const std::scoped_lock lock(mutex_);
  if (style_ == ProgressStyle::live) wipe();
  std::fprintf(out_, "%s\n", line.c_str());
  std::fflush(out_);
  draw(true);
}

void ProgressDisplay::clear() {
  const std::scoped_lock lock(mutex_);
  if (style_ != ProgressStyle::live) return;
  wipe();
  std::fflush(out_);
}

RunState ProgressDisplay::state() const {
  const std::scoped_lock lock(mutex_);
  return state_now();
}

void ProgressDisplay::reach(std::size_t task, double share_done) {
  done_ += costs_[task] * (share_done - shares_[task]);
  shares_[task] = share_done;
}

RunState ProgressDisplay::state_now() const {
  RunState state;
  state.before = before_;
  state.finished = finished_;
  state.total = before_ + costs_.size();
  state.running = running_;
  state.unsettled = unsettled_;
  state.share_done = all_ > 0 ? std::min(done_ / all_, 1.0) : 0.0;
  state.share_before = all_ > 0 ? std::min(done_before_ / all_, state.share_done) : 0.0;
  state.elapsed = wall_seconds() - started_at_;
  return state;
}

void ProgressDisplay::draw(bool is_due) {
  if (!is_due || style_ != ProgressStyle::live) return;
  drawn_at_ = wall_seconds();
  wipe();
  const std::string line = progress_line(state_now(), columns_of(out_));
  std::fputs(line.c_str(), out_);
  std::fflush(out_);
  drawn_length_ = static_cast<int>(line.size());
}

void ProgressDisplay::wipe() {
  const int rows = (drawn_length_ - 1) / columns_of(out_);
  if (rows > 0) std::fprintf(out_, "\033[%dA", rows);
  std::fputs("\r\033[J", out_);
  drawn_length_ = 0;
}

}  // namespace grainsweep
