#include "parallel/step_display.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "parallel/progress.hpp"

namespace freestand::parallel {

StepDisplay::StepDisplay(bool quiet) : quiet_(quiet), terminal_(on_terminal()) {}

StepDisplay::~StepDisplay() {
  if (open_) std::fputs("\n", stderr);
}

void StepDisplay::show(const std::string& what, std::size_t done, std::size_t total) {
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_).count();
  if (quiet_ || since < (terminal_ ? 0.2 : 60)) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string line = fmt::format("{}: {}/{}, {} so far", what, done, total, duration_text(elapsed));
  if (terminal_)
    fmt::print(stderr, "\r\033[K{}", line);
  else
    fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
  open_ = terminal_;
}

}  // namespace freestand::parallel
