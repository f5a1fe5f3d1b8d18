// Acceleration of the floor between two of its samples, linear in time [m/s2].
#pragma once

namespace freestand::test {

struct FloorLine {
  double start_s = 0, a = 0, v = 0, a_rate = 0, v_rate = 0;
  double horizontal(double t) const { return a + a_rate * (t - start_s); }
  double vertical(double t) const { return v + v_rate * (t - start_s); }
};

}  // namespace freestand::test
