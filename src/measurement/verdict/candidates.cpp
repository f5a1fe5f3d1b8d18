#include "measurement/verdict/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace freestand::measurement {
namespace {

// n ln(mean e^2) + k ln n over all samples of the calibration tests.
double bic(const std::vector<double>& samples, const ModelFit& fit) {
  double n = 0, square = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    n += samples[i];
    square += samples[i] * fit.calibration[i].noise_units * fit.calibration[i].noise_units;
  }
  return n * std::log(square / n) + static_cast<double>(fit.x.size()) * std::log(n);
}

}  // namespace

bool is_part(const Candidate& part, const Candidate& whole) {
  return part.effects.size() < whole.effects.size() &&
         std::all_of(part.effects.begin(), part.effects.end(), [&](const std::string& effect) {
           return std::find(whole.effects.begin(), whole.effects.end(), effect) != whole.effects.end();
         });
}

Pooled paired_difference(const std::vector<TestError>& a, const std::vector<TestError>& b) {
  const auto n = static_cast<double>(a.size());
  Pooled difference;
  for (std::size_t i = 0; i < a.size(); ++i) difference.error += (a[i].score - b[i].score) / n;
  double variance = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    variance += std::pow(a[i].score - b[i].score - difference.error, 2) / std::max(n - 1, 1.0);
  difference.standard_error = std::sqrt(variance / std::max(n, 1.0));
  return difference;
}

double least_misfit(const Diagnosis& d) {
  double least = d.base.misfit_of_fit;
  for (const Candidate& c : d.candidates)
    if (c.visible && c.fit.left_out_refitted) least = std::min(least, c.misfit_of_fit);
  return least;
}

void put_in_order(const Bench& bench, const Candidate* best, Diagnosis& d) {
  const Candidate reference = best ? *best : d.base;
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto mark = [&](Candidate& c) {
    const Pooled difference = paired_difference(c.fit.left_out, reference.fit.left_out);
    c.difference = difference.error;
    c.difference_se = difference.standard_error;
  };
  mark(d.base);
  for (Candidate& c : d.candidates) mark(c);
  const auto place = [&](const Candidate& c) {
    const bool to_the_end = c.fit.left_out_refitted;
    return std::tuple(!c.visible, c.effects != reference.effects, !c.rival, !to_the_end,
                      pooled(bench, tests, to_the_end ? c.fit.left_out : c.fit.calibration).error);
  };
  std::stable_sort(d.candidates.begin(), d.candidates.end(),
                   [&](const Candidate& a, const Candidate& b) { return place(a) < place(b); });
  if (best) d.best = 0;
}

bool practical(const ModelFit& fit, std::size_t known) {
  for (std::size_t i = known; i < fit.x.size(); ++i) {
    const Free& free = fit.model.free[i];
    if (free.logarithmic && (fit.x[i] < free.low / beyond_practice || fit.x[i] > beyond_practice * free.high))
      return false;
  }
  return true;
}

void judge_histories(const Bench&, const Judge& judge, Diagnosis& d, const Jobs& jobs) {
  std::vector<Candidate*> all = {&d.base};
  for (Candidate& c : d.candidates) all.push_back(&c);
  d.samples = judge.samples();
  const double n = total(d.samples);
  const double base_bic = bic(d.samples, d.base.fit);
  const auto answers = jobs("judging", all.size(), [&](std::size_t i) {
    if (!all[i]->visible) return Values{};  // never fitted: its numbers are the base's alone
    Values misfits = judge.misfit(all[i]->fit);
    const Values of_fit = judge.misfit_of_fit(all[i]->fit);
    misfits.insert(misfits.end(), of_fit.begin(), of_fit.end());
    return misfits;
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    Candidate& c = *all[i];
    if (!c.visible) {
      c.misfits = d.base.misfits;
      c.misfit = d.base.misfit;
      c.misfits_of_fit = d.base.misfits_of_fit;
      c.misfit_of_fit = d.base.misfit_of_fit;
      c.explained = d.base.explained;
      continue;
    }
    const auto middle = answers[i].begin() + static_cast<long>(answers[i].size() / 2);
    c.misfits.assign(answers[i].begin(), middle);
    c.misfits_of_fit.assign(middle, answers[i].end());
    c.misfit = total(c.misfits);
    c.misfit_of_fit = total(c.misfits_of_fit);
    c.explained = std::sqrt(c.misfit / n);
    c.delta_bic = bic(d.samples, c.fit) - base_bic;
  }
}

}  // namespace freestand::measurement
