#include <csignal>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <sys/wait.h>

#include "runner/jobs/stop.hpp"

namespace grainsweep {
namespace {

/// How `child` ends, in a process of its own: signals and what they left are the process's.
template <class Child>
int code_of(Child child) {
  const pid_t process = fork();
  REQUIRE(process >= 0);
  if (process == 0) _exit(child());
  int status = 0;
  REQUIRE(waitpid(process, &status, 0) == process);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// 0 if the first signal asks to stop, and stays the one that did.
int asked_by(int signal) {
  watch_stop_signals();
  if (stop_signal() != 0) return 1;
  raise(signal);
  return stop_signal() == signal ? 0 : 2;
}

TEST_CASE("signals that ask to stop are told, the first of them") {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGXCPU, SIGHUP}) {
    INFO(signal);
    CHECK(code_of([=] {
            std::signal(SIGHUP, SIG_DFL);  // whoever runs the tests may have it ignored
            return asked_by(signal);
          }) == 0);
  }
}

TEST_CASE("a second Ctrl-C ends at once, others may come again and again") {
  CHECK(code_of([] {
          if (asked_by(SIGTERM) != 0) return 1;
          raise(SIGTERM);
          raise(SIGUSR1);
          if (stop_signal() != SIGTERM) return 2;
          raise(SIGINT);
          return 3;
        }) == 128 + SIGINT);
}

TEST_CASE("a closed terminal that nohup has ignored does not stop") {
  CHECK(code_of([] {
          std::signal(SIGHUP, SIG_IGN);
          watch_stop_signals();
          raise(SIGHUP);
          return stop_signal();
        }) == 0);
}

TEST_CASE("a closed pipe and a file that may not grow end nothing") {
  CHECK(code_of([] {
          watch_stop_signals();
          ignore_file_size_signal();
          raise(SIGPIPE);
          raise(SIGXFSZ);
          return stop_signal();
        }) == 0);
}

}  // namespace
}  // namespace grainsweep
