// The instants at which a history has its points: 0, step_s, 2 step_s and so on.
#pragma once

#include <cmath>
#include <freestand/response.hpp>

namespace freestand::dynamics {

class OutputTimes {
 public:
  explicit OutputTimes(const History* history) : step_s_(history ? history->step_s : 0) {}

  bool wanted() const { return step_s_ > 0; }
  double step_s() const { return step_s_; }
  // How many lie behind, and others have gone by so many.
  long count() const { return count_; }
  void went_to(long count) { count_ = count; }
  double next() const { return static_cast<double>(count_) * step_s_; }

  // Each that is left before start + tau, as the time since start.
  template <class Use>
  void within(double start, double tau, Use&& use) {
    for (; wanted() && next() < start + tau; ++count_) use(std::fmax(next() - start, 0.0));
  }
  // Each that is left up to the end.
  template <class Use>
  void up_to(double end, Use&& use) {
    for (; wanted() && next() <= end; ++count_) use(next());
  }

 private:
  double step_s_;
  long count_ = 0;
};

}  // namespace freestand::dynamics
