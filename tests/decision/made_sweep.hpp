// A sweep made by hand: when the blocks of each record overturn is drawn, so that the true rate is known.
#pragma once

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "decision/hazard.hpp"
#include "fragility/fit.hpp"

namespace freestand::decision::made_sweep {

inline double uniform(std::uint64_t seed, std::uint64_t counter, std::string_view stream) {
  return random::uniform(seed, counter, random::stable_hash(stream));
}
inline double normal(std::uint64_t seed, std::uint64_t counter, std::string_view stream) {
  return gsl_cdf_ugaussian_Pinv(uniform(seed, counter, stream));
}

inline HazardCurve power_law(double k0, double k, double first, double last) {
  HazardCurve curve{"pga_g", 0, {}, {}};
  for (int i = 0; i < 8; ++i) {
    curve.im.push_back(first * std::pow(last / first, i / 7.0));
    curve.annual_rate.push_back(k0 * std::pow(curve.im.back(), -k));
  }
  return curve;
}

// Records of which each overturns at its own intensity: ln of it is normal with `between` among records, and `within` among the
// samples of one. A share `floor` overturns at whatever intensity, and only a share `ceiling` can overturn at all, so that the curve is no
// lognormal where they are not 0 and 1. A share `weak` of the records overturns at 0.3 of the others' intensity. What happens is over again
// from `ends` times the own intensity on: a window that is entered and left.
struct Sweep {
  int records = 40, per_record = 25, bins = 10;
  double median = 0.6, between = 0.35, within = 0.25, floor = 0, ceiling = 1, weak = 0, ends = HUGE_VAL, least = 0.05,
         most = 3;
  double dispersion() const { return std::hypot(between, within); }
  double own(std::uint64_t seed, std::uint64_t record) const {
    return median * std::exp(between * normal(seed, record, "record")) *
           (uniform(seed, record, "weak") < weak ? 0.3 : 1);
  }

  fragility::Result fit(std::uint64_t seed, int resamples) const {
    fragility::Options options;
    options.im_name = "pga_g";
    options.im_unit = "g";
    for (int i = 0; i <= bins; ++i) options.im_edge.push_back(least * std::pow(most / least, i / (1.0 * bins)));
    fragility::EdpOptions edp;
    edp.name = "overturned";
    edp.binary = true;
    edp.censored = false;
    options.edps = {edp};
    for (int r = 0; r < records; ++r) options.motion_group.push_back(r);
    options.resamples = resamples;
    options.confidence = 0.9;
    fragility::Tally tally(options);
    for (int r = 0, i = 0; r < records; ++r) {
      const auto record = static_cast<std::uint64_t>(r);
      const double own = this->own(seed, record);
      for (int k = 0; k < per_record; ++k, ++i) {
        const auto at = static_cast<std::uint64_t>(i);
        const double im = least * std::pow(most / least, uniform(seed, at, "im"));
        const double at_im = own * std::exp(within * normal(seed, at, "sample"));
        const bool over = (im > at_im && im < ends * at_im && uniform(seed, at, "ceiling") < ceiling) ||
                          uniform(seed, at, "floor") < floor;
        const double value = over;
        tally.add({at, im, r, over ? Outcome::overturned : Outcome::moved, {&value, 1}, {}});
      }
    }
    return fragility::fit(tally);
  }
};

// One whose share levels off at 0.5.
inline Sweep half_that_overturn() {
  Sweep sweep;
  sweep.records = 200;
  sweep.per_record = 200;
  sweep.median = 0.3;
  sweep.between = sweep.within = 0.2;
  sweep.ceiling = 0.5;
  return sweep;
}

}  // namespace freestand::decision::made_sweep
