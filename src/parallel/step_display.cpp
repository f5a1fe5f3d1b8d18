#include "parallel/step_display.hpp"

#include <fmt/format.h>

#include "parallel/progress.hpp"

namespace freestand::parallel {

StepDisplay::StepDisplay(bool quiet) : quiet_(quiet), terminal_(on_terminal()) {}

StepDisplay::~StepDisplay() {
  if (open_) tell("\n");
}

void StepDisplay::show(const std::string& what, std::size_t done, std::size_t total) {
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_).count();
  if (quiet_ || since < (terminal_ ? 0.2 : 10)) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string line = fmt::format("{}: {}/{}, {} so far", what, done, total, duration_text(elapsed));
  tell(terminal_ ? "\r\033[K" + line : line + "\n");
  open_ = terminal_;
}

}  // namespace freestand::parallel
