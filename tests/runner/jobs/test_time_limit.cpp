#include <chrono>
#include <thread>

#include <catch2/catch.hpp>

#include "runner/jobs/time_limit.hpp"

namespace grainsweep {
namespace {

TEST_CASE("a time is read as clusters write it") {
  CHECK(seconds_in("90") == 90.0);
  CHECK(seconds_in("45:00") == 2700.0);
  CHECK(seconds_in("240:00:05") == 864005.0);
  for (const char* text : {"", "0", "-1", "1:", ":1", "1:60", "1:2:3:4", "1h", "1.5", "0:00"}) {
    CHECK_FALSE(seconds_in(text));
  }
}

double set_clock = 0.0;  // s
double told_time() { return set_clock; }

TEST_CASE("without a limit everything may begin") {
  CHECK_FALSE(TimeLimit().is_over());
  CHECK(TimeLimit().may_begin(1e9));
}

TEST_CASE("what ends in time may begin, and what no such limit would hold") {
  const TimeLimit hour(3600);
  CHECK_FALSE(hour.is_over());
  CHECK(hour.may_begin(3500));
  CHECK(hour.may_begin(7200));
}

TEST_CASE("what took time before the first packing is no reason to begin none") {
  set_clock = 1000.0;
  const TimeLimit limit(0.5, told_time);
  set_clock += 0.1;
  CHECK_FALSE(limit.may_begin(0.44));
  const TimeLimit rest = limit.from_now();
  CHECK(rest.may_begin(0.44));
  CHECK_FALSE(rest.is_over());
  set_clock += 0.34;
  CHECK_FALSE(rest.is_over());
  set_clock += 0.02;
  CHECK(rest.is_over());
  CHECK_FALSE(rest.may_begin(0.44));
  CHECK(TimeLimit().from_now().may_begin(1e9));
}

TEST_CASE("what would end in a limit from its beginning on is not begun late, a tenth is kept") {
  set_clock = 1000.0;
  const TimeLimit short_one(0.5, told_time);
  set_clock += 0.1;
  CHECK_FALSE(short_one.may_begin(0.44));
  CHECK(short_one.may_begin(0.46));
  set_clock += 0.36;
  CHECK(short_one.is_over());
  CHECK_FALSE(short_one.may_begin(0.0));
  CHECK_FALSE(short_one.may_begin(1e9));
}

TEST_CASE("half a minute is kept of a long limit") {
  set_clock = 1000.0;
  const TimeLimit hour(3600.0, told_time);
  set_clock += 3569.0;
  CHECK_FALSE(hour.is_over());
  set_clock += 2.0;
  CHECK(hour.is_over());
}

TEST_CASE("a limit goes by the clock on the wall") {
  const TimeLimit limit(0.05);
  CHECK_FALSE(TimeLimit(3600).is_over());
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK(limit.is_over());
}

}  // namespace
}  // namespace grainsweep
