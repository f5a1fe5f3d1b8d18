// Candidates whose errors are given, for tests of verdicts.
#pragma once

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "measurement/made_tests.hpp"
#include "measurement/verdict/decide.hpp"

namespace freestand::measurement {

inline constexpr double samples = 1000;

inline Chance chance(const char* question, double p) {
  return {.question = question, .about = {}, .p = p, .simulations = 2000};
}

// Answers as independent normal noise would give them: a lead L by exp(-L/2), a misfit by its normal deviate.
inline Questions by_misfit() {
  return {.lead =
              [](const Candidate& best, const Candidate& rival) {
                return chance(lead_question, std::min(1.0, std::exp((best.misfit - rival.misfit) / 2)));
              },
          .enough =
              [](const Candidate& c) {
                return chance(misfit_question,
                              gsl_cdf_ugaussian_Q((c.misfit_of_fit - samples) / std::sqrt(2 * samples)));
              },
          .another = [](const Candidate&) { return chance(another_question, 0.001); },
          .steady = [](const Candidate&) { return chance(steady_question, 0.001); },
          .beside = [](const Candidate& c) { return c.misfit_of_fit; }};
}

inline Dataset cabinet_tests() {
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.2, 0.2};
  return test::made_dataset(cabinet);
}

// error: of every test left out [noise units]; explained: sqrt(G/samples).
inline Candidate candidate(const Bench& bench, std::vector<std::string> effects, double error, double explained) {
  Candidate c{.effects = std::move(effects), .fit = {.model = test::free_friction(), .x = {0.2}}};
  const std::size_t tests = tests_of(bench.data(), Role::calibration).size();
  for (std::size_t i = 0; i < tests; ++i)
    c.fit.left_out.push_back({.score = 2 * std::log(error), .noise_units = error});
  c.fit.calibration = c.fit.left_out;
  c.fit.left_out_refitted = true;
  c.explained = explained;
  c.misfits.assign(tests, samples / static_cast<double>(tests) * explained * explained);
  c.misfits_of_fit = c.misfits;
  c.misfit = c.misfit_of_fit = samples * explained * explained;
  return c;
}

// strays: of every test of the base.
inline Diagnosis undecided(const Bench& bench, double strays) {
  const std::size_t tests = tests_of(bench.data(), Role::calibration).size();
  Diagnosis d;
  d.samples.assign(tests, samples / static_cast<double>(tests));
  d.strays.assign(tests, strays);
  d.base = candidate(bench, {}, 5.5, 2.9);
  return d;
}

// As candidate(), with the error of each test left out [noise units].
inline Candidate with_errors(const Bench& bench, std::vector<std::string> effects, const std::vector<double>& errors,
                             double explained) {
  Candidate c = candidate(bench, std::move(effects), 1, explained);
  for (std::size_t i = 0; i < errors.size(); ++i)
    c.fit.left_out[i] = {.score = 2 * std::log(errors[i]), .noise_units = errors[i]};
  return c;
}

inline Diagnosis decided_among(const Bench& bench, std::vector<Candidate> candidates,
                               const Questions& ask = by_misfit()) {
  Diagnosis d = undecided(bench, 0);
  d.candidates = std::move(candidates);
  decide(bench, d, ask);
  return d;
}

}  // namespace freestand::measurement
