// What goes on in work that has steps: a line that is rewritten on a terminal, one plain line every ten seconds elsewhere.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace freestand::parallel {

class StepDisplay {
 public:
  explicit StepDisplay(bool quiet);
  ~StepDisplay();
  StepDisplay(const StepDisplay&) = delete;
  StepDisplay& operator=(const StepDisplay&) = delete;

  // "fit: 3/12, 4 s so far", when it is time for a line.
  void show(const std::string& what, std::size_t done, std::size_t total);

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_, open_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace freestand::parallel
