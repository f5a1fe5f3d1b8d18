#include "parallel/stop.hpp"

#include <chrono>
#include <utility>

namespace freestand::parallel {
namespace {

volatile std::sig_atomic_t stop_flag = 0;
StopOnSignal* innermost = nullptr;  // of the main thread
constexpr std::array stop_signals = {SIGTERM, SIGINT, SIGUSR1, SIGUSR2};

void on_signal(int signal_number) {
  if (signal_number == SIGINT && stop_flag) std::signal(SIGINT, SIG_DFL), std::raise(SIGINT);
  stop_flag = 1;
}

struct sigaction action_of(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  return action;
}

}  // namespace

StopOnSignal::StopOnSignal() : around_(std::exchange(innermost, this)) {
  if (around_) around_->handed_over_ = true;
  const struct sigaction action = action_of(on_signal);
  for (std::size_t i = 0; i < stop_signals.size(); ++i) sigaction(stop_signals[i], &action, &before_[i]);
}

StopOnSignal::StopOnSignal(Overdue overdue) : StopOnSignal() {
  watch_ = std::thread([this, overdue = std::move(overdue)] {
    using Clock = std::chrono::steady_clock;
    const std::chrono::duration<double> patience(overdue.patience_s);
    for (auto since = Clock::now(); !over_; std::this_thread::sleep_for(std::chrono::milliseconds(20))) {
      if (handed_over_) return;
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
  innermost = around_;
  for (std::size_t i = 0; i < stop_signals.size(); ++i) {
    const bool leaving = stop_flag && stop_signals[i] != SIGINT && before_[i].sa_handler == SIG_DFL;
    const struct sigaction ignored = action_of(SIG_IGN);
    sigaction(stop_signals[i], leaving ? &ignored : &before_[i], nullptr);
  }
}

bool stop_requested() { return stop_flag != 0; }
void request_stop() { stop_flag = 1; }
void clear_stop() { stop_flag = 0; }

}  // namespace freestand::parallel
