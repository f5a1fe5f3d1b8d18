#include "parallel/stop.hpp"

#include <chrono>
#include <csignal>
#include <initializer_list>
#include <utility>

namespace freestand::parallel {
namespace {

volatile std::sig_atomic_t stop_flag = 0;
constexpr std::initializer_list<int> stop_signals = {SIGTERM, SIGINT, SIGUSR1, SIGUSR2};

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

StopOnSignal::StopOnSignal(Overdue overdue) : StopOnSignal() {
  watch_ = std::thread([this, overdue = std::move(overdue)] {
    using Clock = std::chrono::steady_clock;
    const std::chrono::duration<double> patience(overdue.patience_s);
    for (auto since = Clock::now(); !over_; std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
      if (!stop_requested()) since = Clock::now();
      if (Clock::now() - since <= patience) continue;
      overdue.act();
      return;
    }
  });
}

StopOnSignal::~StopOnSignal() {
  over_ = true;
  if (watch_.joinable()) watch_.join();
  for (const int signal_number : stop_signals) handle(signal_number, SIG_DFL);
}

bool stop_requested() { return stop_flag != 0; }
void request_stop() { stop_flag = 1; }
void clear_stop() { stop_flag = 0; }

}  // namespace freestand::parallel
