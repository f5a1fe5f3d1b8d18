// Cycles of a load that goes up and down at random, by rainflow counting (M. Matsuishi & T. Endo, 1968; ASTM E1049-85, as four points:
// C. Amzallag et al., Int. J. Fatigue 16, 1994): of four turning points that follow each other the inner two are a cycle where the outer
// ranges hold theirs; they are taken out, and the others are neighbours from then on. What never closes counts half a cycle a range.
//
// Damage adds up as the m-th power of the amplitude a, half the range (M. A. Miner, 1945; O. H. Basquin, 1910), m = 3 as of welded steel
// (EN 1993-1-9). Told is the amplitude of the one cycle that does as much:
//
//   (sum of a^m over cycles + 1/2 sum of a^m over half cycles)^(1/m)
//
// Only what has not closed is remembered: a few turning points, however long the load.
#pragma once

#include <cmath>
#include <vector>

namespace freestand::dynamics {

class Rainflow {
 public:
  // The load as it goes on, seen at its turning points at least.
  void see(double x) {
    const std::size_t n = open_.size();
    if (n > 1 && (x - open_[n - 1]) * (open_[n - 1] - open_[n - 2]) >= 0) {
      open_.back() = x;  // on its way
      return;
    }
    if (n == 1 && x == open_[0]) return;
    // The last one has turned: what it closes can close no other way.
    close(open_, damage_);
    open_.push_back(x);
  }

  double amplitude() const {
    double sum = damage_;
    std::vector<double> rest = open_;
    close(rest, sum);
    for (std::size_t i = 1; i < rest.size(); ++i) sum += 0.5 * cycle(rest[i - 1], rest[i]);
    return std::cbrt(sum);
  }

 private:
  static double cycle(double a, double b) { return std::pow(0.5 * std::abs(a - b), 3); }

  static void close(std::vector<double>& points, double& damage) {
    while (points.size() >= 4) {
      const double* last = points.data() + points.size() - 4;
      const double inner = std::abs(last[2] - last[1]);
      if (inner > std::abs(last[1] - last[0]) || inner > std::abs(last[3] - last[2])) return;
      damage += cycle(last[1], last[2]);
      points.erase(points.end() - 3, points.end() - 1);
    }
  }

  std::vector<double> open_;  // turning points that belong to no cycle yet; the last one may still go on
  double damage_ = 0;
};

}  // namespace freestand::dynamics
