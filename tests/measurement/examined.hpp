// What examine() says of made tests of a cabinet that slides.
#pragma once

#include "measurement/laboratory/quality.hpp"
#include "measurement/made_tests.hpp"

namespace freestand::test {

inline Specimen sliding_cabinet(double mu) {
  Specimen s;
  s.block = Block::rectangular(0.8, 0.6, 100);
  s.friction = {mu, mu};
  s.model = Model::slide;
  return s;
}

// By the model of a friction of 0.2.
inline measurement::Quality examined(const measurement::Dataset& data) {
  using namespace measurement;
  const Bench bench(data, 0);
  ModelFit fit{.model = free_friction(), .x = {0.2}};
  fit.score = mean_score(bench, tests_of(data, Role::calibration), fit.model, fit.x);
  return examine(bench, fit, Effort{}, run_here);
}

}  // namespace freestand::test
