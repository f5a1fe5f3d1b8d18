// P(demand > capacity) over the intensity, in the three shapes that freestand knows it in. What an exporter writes and a
// check holds the written file to.
#pragma once

#include <limits>
#include <vector>

namespace freestand::exports {

enum class Form {
  lognormal,  // Phi(ln(im/median)/dispersion), from the fragility function
  discrete,   // straight lines between the bins, from the surface
  parts       // the three parts of each bin, each on straight lines between the bins
};

struct Point {
  double im, probability;
};

// The three parts at one intensity, as the surface has them: p_never is the share that shows no demand at all, of those that
// stood. P = p_over + (1 - p_over) (1 - p_never) (1 - Phi((ln C - lambda)/omega)).
struct PartsPoint {
  double im, p_over, p_never, lambda, omega;
};

struct Curve {
  Form form = Form::discrete;
  double median = std::numeric_limits<double>::quiet_NaN(), dispersion = median;  // lognormal
  std::vector<Point> points;                                                      // discrete: im rises
  std::vector<PartsPoint> parts;                                                  // parts: im rises
  double ln_capacity = median;                                                    // parts
};

Curve lognormal(double median, double dispersion);

// A lognormal is 0 at im <= 0; points are constant below the first and above the last.
double probability(const Curve&, double im);

}  // namespace freestand::exports
