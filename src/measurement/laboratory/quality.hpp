// What may be wrong with measurements that are formally in order. Of tests held out it is told; it decides nothing, since
// they reach nothing but the last table.
#pragma once

#include <string>
#include <vector>

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

struct Quality {
  std::vector<std::string> findings;
  bool mirrored_slip = false, mirrored_rotation = false;
  double late_s = 0;  // by which the response lags behind the floor's channel, beyond what the model gives
  // Of the calibration tests:
  std::size_t doubtful = 0;       // those whose slip alone looks mirrored, or late
  std::size_t wrong_numbers = 0;  // those whose floor or response looks as if in another unit, dead, or clipped
  std::size_t moving = 0;         // tests with a history in which anything moved

  // No verdict on an effect can be drawn from such data.
  bool spoilt() const { return mirrored_slip || mirrored_rotation || late_s != 0 || doubtful + wrong_numbers > 0; }
};

// Units, dead channels and the stated noise are judged by plausible.hpp. Clipped sensors and tests without motion are
// read off the histories; sign and clock of the slip as well, where there is slip enough (timing.hpp). Otherwise they are
// judged by the model: with the floor mirrored, a rotation mirrored, or the histories shifted by up to 0.15 s, and its
// free numbers fitted again, does it come much closer?
Quality examine(const Bench&, const ModelFit&, const Effort&, const Jobs&);

}  // namespace freestand::measurement
