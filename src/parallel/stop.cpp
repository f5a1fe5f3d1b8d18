#include "parallel/stop.hpp"

#include <csignal>
#include <initializer_list>

namespace freestand::parallel {
namespace {

volatile std::sig_atomic_t stop_flag = 0;
constexpr std::initializer_list<int> stop_signals = {SIGTERM, SIGINT, SIGUSR1};

void on_signal(int signal_number) {
  if (signal_number == SIGINT && stop_flag) std::signal(SIGINT, SIG_DFL), std::raise(SIGINT);
  stop_flag = 1;
}

void handle(int signal_number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

StopOnSignal::StopOnSignal() {
  for (const int signal_number : stop_signals) handle(signal_number, on_signal);
}

StopOnSignal::~StopOnSignal() {
  for (const int signal_number : stop_signals) handle(signal_number, SIG_DFL);
}

bool stop_requested() { return stop_flag != 0; }
void request_stop() { stop_flag = 1; }
void clear_stop() { stop_flag = 0; }

}  // namespace freestand::parallel
