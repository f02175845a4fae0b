#include "runner/jobs/stop.hpp"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace grainsweep {
namespace {

/// A signal handler can reach nothing but a global.
std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void receive_signal(int signal) {
  int none = 0;
  const bool is_first = received_signal.compare_exchange_strong(none, signal);
  if (!is_first && signal == SIGINT) _exit(128 + signal);
}

}  // namespace

void watch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = receive_signal;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGXCPU}) sigaction(signal, &action, nullptr);
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);  // ignored under nohup: leave it so
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
}

void ignore_file_size_signal() {
  struct sigaction action {};
  action.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &action, nullptr);
}

int stop_signal() { return received_signal.load(); }

}  // namespace grainsweep
