// Fits that do not stop where the plain score does. A model whose slips come out a little wrong is shifted more with
// each of them, and its plain error has a valley as narrow as the noise and walls all around: no simplex finds in. By
// strides (score.hpp) the valley is wide; from its ground derivatives lead to the least plain score.
#pragma once

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

struct StrideFit {
  std::size_t task = 0;
  ModelFit fit;  // score: the plain one
};

// Each task from its starts by strides; the best `finals` of them then by derivatives. Best first. Histories only.
std::vector<StrideFit> fit_by_strides(const Bench&, const std::vector<FitTask>&, std::size_t finals, const Effort&,
                                      const Jobs&);

}  // namespace freestand::measurement
