#include <algorithm>
#include <cstdio>
#include <fcntl.h>
#include <pty.h>
#include <string>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <sys/ioctl.h>

#include "runner/jobs/progress.hpp"

namespace grainsweep {
namespace {

RunState half_done() {
  RunState state;
  state.finished = 12;
  state.total = 30;
  state.running = 2;
  state.share_done = 0.5;
  state.elapsed = 35.0;
  return state;
}

/// What a display writes to a file.
class Capture {
 public:
  Capture() : file_(std::tmpfile()) {}
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  ~Capture() { std::fclose(file_); }
  std::FILE* file() { return file_; }
  std::string text() {
    std::rewind(file_);
    std::string all;
    for (int c = std::fgetc(file_); c != EOF; c = std::fgetc(file_)) all += static_cast<char>(c);
    return all;
  }

 private:
  std::FILE* file_;
};

TEST_CASE("the time left continues the pace so far") {
  CHECK(time_left(half_done()) == Approx(35.0));
  RunState quarter = half_done();
  quarter.share_done = 0.25;
  CHECK(time_left(quarter) == Approx(105.0));
  quarter.share_done = 1.0;
  CHECK(time_left(quarter) == Approx(0.0));
}

TEST_CASE("without any work done the time left is unknown") {
  RunState state = half_done();
  state.share_done = 0.0;
  CHECK(time_left(state) < 0);
  CHECK_THAT(progress_line(state), Catch::EndsWith("time left unknown"));
}

TEST_CASE("clock times read as people write them") {
  CHECK(clock_text(0.2) == "0:00");
  CHECK(clock_text(59.6) == "1:00");
  CHECK(clock_text(245) == "4:05");
  CHECK(clock_text(3723) == "1:02:03");
}

TEST_CASE("the progress line shows bar, packings, share, running and times") {
  CHECK(progress_line(half_done()) ==
        "[===========>          ] 12/30   50 %  2 running  0:35 elapsed, about 0:35 left");
}

TEST_CASE("the progress line fits every window and tells first how many packings are done") {
  RunState many = half_done();
  many.unsettled = 3;
  many.finished = many.total = 100000;
  many.share_done = 1.0;
  many.elapsed = 360000;
  for (int columns = 1; columns <= 200; ++columns) {
    INFO(columns);
    for (const RunState& state : {half_done(), many}) {
      const auto room = static_cast<std::size_t>(std::clamp(columns, 2, 80));
      CHECK(progress_line(state, columns).size() < room);
    }
  }
  CHECK(progress_line(half_done(), 50) == "[========>        ] 12/30   50 %  about 0:35 left");
  CHECK(progress_line(half_done(), 30) == "[=======>      ] 12/30   50 %");
  CHECK(progress_line(half_done(), 12) == "12/30   50 ");
}

TEST_CASE("a resumed run counts from what earlier runs made") {
  Capture out;
  ProgressDisplay display({1.0, 1.0}, ProgressStyle::plain, out.file(), 4);
  display.start();
  display.finish(0, true, "settled");
  CHECK(out.text() == "5/6  settled\n");
  CHECK(progress_line(display.state()).find(" 5/6   50 %") != std::string::npos);
}

TEST_CASE("the time left counts what this run did, not what earlier runs did of a packing") {
  RunState resumed;
  resumed.share_done = 0.9;
  resumed.share_before = 0.8;
  resumed.elapsed = 10.0;
  CHECK(time_left(resumed) == Approx(10.0));
  resumed.share_before = 0.9;
  CHECK(time_left(resumed) < 0.0);
  Capture out;
  ProgressDisplay display({30.0, 10.0}, ProgressStyle::quiet, out.file());
  display.start();
  display.advance(0, 0.5);
  display.advance(0, 0.7);
  display.start();
  display.finish(1, true, "");
  CHECK(display.state().share_before == Approx(15.0 / 40.0));
  CHECK(display.state().share_done == Approx(31.0 / 40.0));
}

TEST_CASE("the share done weighs tasks by their cost and never falls") {
  Capture out;
  ProgressDisplay display({30.0, 10.0}, ProgressStyle::quiet, out.file());
  CHECK(display.state().share_done == 0.0);
  display.start();
  display.start();
  display.advance(0, 0.5);
  CHECK(display.state().share_done == Approx(15.0 / 40.0));
  display.advance(0, 0.4);
  CHECK(display.state().share_done == Approx(15.0 / 40.0));
  display.finish(1, false, "");
  CHECK(display.state().share_done == Approx(25.0 / 40.0));
  CHECK(display.state().running == 1);
  CHECK(display.state().finished == 1);
  CHECK(display.state().unsettled == 1);
  CHECK(out.text().empty());
}

TEST_CASE("plain style writes one line per finished packing") {
  Capture out;
  ProgressDisplay display({1.0, 1.0}, ProgressStyle::plain, out.file());
  display.start();
  display.advance(1, 0.5);
  display.finish(1, true, "MSP W=5 #1  settled");
  display.start();
  display.finish(0, true, "MSP W=6 #1  settled");
  CHECK(out.text() == "1/2  MSP W=5 #1  settled\n2/2  MSP W=6 #1  settled\n");
}

TEST_CASE("live style redraws one line and takes it away at the end") {
  Capture out;
  ProgressDisplay display({1.0}, ProgressStyle::live, out.file());
  display.start();
  display.finish(0, true, "not shown");
  display.clear();
  const std::string text = out.text();
  CHECK(text.find('\n') == std::string::npos);
  CHECK_THAT(text, Catch::Contains("1/1  100 %") && Catch::EndsWith("\r\033[J"));
  CHECK_THAT(text, !Catch::Contains("not shown"));
}

/// A terminal whose window can be made wider and narrower.
class Terminal {
 public:
  Terminal() {
    int terminal = -1;
    REQUIRE(openpty(&reader_, &terminal, nullptr, nullptr, nullptr) == 0);
    fcntl(reader_, F_SETFL, O_NONBLOCK);
    file_ = fdopen(terminal, "w");
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    std::fclose(file_);
    ::close(reader_);
  }
  std::FILE* file() { return file_; }
  void resize(int columns) {
    winsize window{};
    window.ws_row = 24;
    window.ws_col = static_cast<unsigned short>(columns);
    REQUIRE(ioctl(fileno(file_), TIOCSWINSZ, &window) == 0);
  }
  /// What was written to it since it was last asked.
  std::string text() {
    std::string all;
    for (char c = 0; ::read(reader_, &c, 1) == 1;) all += c;
    return all;
  }

 private:
  int reader_ = -1;
  std::FILE* file_ = nullptr;
};

TEST_CASE(
    "the live line fits the window as it is now, and takes away all of what stood in a wider") {
  Terminal terminal;
  ProgressDisplay display({1.0, 1.0}, ProgressStyle::live, terminal.file());
  const auto drawn_in = [&](int columns) {
    terminal.resize(columns);
    display.start();
    return terminal.text();
  };
  const auto line_of = [](const std::string& text) {
    return text.substr(text.rfind("\033[J") + 3);
  };
  const std::string wide = line_of(drawn_in(100));
  CHECK((wide.size() > 60 && wide.size() < 80));
  const std::string narrow = drawn_in(30);
  CHECK_THAT(narrow, Catch::StartsWith("\033[2A\r\033[J"));  // more than 60 characters are 3 rows
  CHECK(line_of(narrow).size() < 30);
  CHECK_THAT(drawn_in(100), Catch::StartsWith("\r\033[J") && Catch::Contains("left"));
}

TEST_CASE("live style draws no more than a few times a second") {
  Capture out;
  ProgressDisplay display({1.0}, ProgressStyle::live, out.file());
  display.start();
  for (int step = 0; step < 1000; ++step) display.advance(0, step / 1000.0);
  const std::string text = out.text();
  CHECK(std::count(text.begin(), text.end(), '\r') <= 4);
}

TEST_CASE("a line of its own is printed in every style, above the live line") {
  for (const ProgressStyle style : {ProgressStyle::quiet, ProgressStyle::plain}) {
    Capture out;
    ProgressDisplay({1.0}, style, out.file()).say("warning: no room");
    CHECK(out.text() == "warning: no room\n");
  }
  Capture out;
  ProgressDisplay({1.0}, ProgressStyle::live, out.file()).say("warning: no room");
  CHECK_THAT(out.text(), Catch::StartsWith("\r\033[Jwarning: no room\n\r\033[J["));
}

}  // namespace
}  // namespace grainsweep
