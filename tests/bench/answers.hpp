// Answers of freestand and of its peers to the samples of a job, and how far they are off.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "jobs.hpp"
#include "peers.hpp"

namespace freestand::bench {

struct Answer {
  double slip = 0, rotation = 0;
  bool overturned = false, failed = false;
  int events = 0;
};

inline Answer answer(const Response& r) {
  const bool failed = r.outcome > Outcome::overturned;
  return {r.peak_slip_m, r.peak_rotation_rad, r.outcome == Outcome::overturned, failed, r.events};
}

inline Answer answer(const PeerResponse& r) { return {r.slip_m, r.rotation_rad, r.overturned, r.failed, r.events}; }

using Solver = std::function<std::vector<Answer>(const Job&, std::size_t count)>;  // of the first `count` samples

struct Accuracy {
  double median = 0, high = 0;  // 50 % and 99 %
  int flips = 0, failed = 0;
  double events = 0;  // per sample
};

inline double part(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

inline Accuracy accuracy(const Job& job, const std::vector<Answer>& answers, const std::vector<Answer>& truth) {
  Accuracy result;
  std::vector<double> errors;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    result.events += answers[i].events / static_cast<double>(answers.size());
    result.failed += answers[i].failed;
    if (answers[i].failed) continue;
    result.flips += answers[i].overturned != truth[i].overturned;
    if (answers[i].overturned || truth[i].overturned || truth[i].events == 0) continue;
    double error = 0;
    for (const std::string& demand : job.demands) {
      const double a = demand == "slip" ? answers[i].slip : answers[i].rotation;
      const double b = demand == "slip" ? truth[i].slip : truth[i].rotation;
      if (b > 1e-6) error = std::max(error, std::abs(a - b) / b);
    }
    errors.push_back(error);
  }
  result.median = part(errors, 0.5);
  result.high = part(errors, 0.99);
  return result;
}

inline Solver one_by_one(std::function<Answer(const Specimen&, const Shaking&)> one) {
  return [one](const Job& job, std::size_t count) {
    std::vector<Answer> answers(count);
    for (std::size_t i = 0; i < count; ++i) answers[i] = one(job.specimens[i], job.shakings[i]);
    return answers;
  };
}

inline std::vector<Answer> in_packs(const Job& job, std::size_t count) {
  std::vector<Response> responses(count);
  respond_batch(std::span(job.specimens).first(count), std::span(job.shakings).first(count), {}, responses);
  std::vector<Answer> answers(count);
  std::transform(responses.begin(), responses.end(), answers.begin(), [](const Response& r) { return answer(r); });
  return answers;
}

inline std::vector<Answer> tight_run(const Job& job) {
  const auto one = [](const Specimen& b, const Shaking& s) { return answer(respond(b, s, {.tolerance = 1e-13})); };
  return one_by_one(one)(job, job.samples());
}

// Odeint with the fewest steps that make its median error no larger than the kernel's, or as small as it gets; below 1e-13 round-off
// is not told from round-off. Under pulses it is the tolerance that is sought. Finds it on its first call.
class AsAccurate {
 public:
  explicit AsAccurate(Peer peer) : peer_(peer) {}
  std::vector<Answer> operator()(const Job& job, std::size_t count) {
    if (!found_) find(job);
    return answers(job, count);
  }

  const OdeintSteps& steps() const { return steps_; }

 private:
  void find(const Job& job) {
    const auto truth = tight_run(job);
    const double wanted = std::max(accuracy(job, in_packs(job, job.samples()), truth).median, round_off);
    std::vector<double> errors;
    for (int finer = 0; finer < most_tries; ++finer) {
      steps_ = steps_of(job, finer);
      errors.push_back(accuracy(job, answers(job, job.samples()), truth).median);
      if (errors.back() <= wanted) break;
    }
    if (errors.back() > wanted) {
      const double good = 1.1 * *std::min_element(errors.begin(), errors.end());
      int finer = 0;
      while (errors[static_cast<std::size_t>(finer)] > good) ++finer;
      steps_ = steps_of(job, finer);
    }
    found_ = true;
  }
  static OdeintSteps steps_of(const Job& job, int finer) {
    if (job.pulses) return {.tolerance = std::pow(10, -6 - 0.5 * finer), .root_s = 1e-16};
    return {.per_knot = 1 + finer, .root_s = 1e-16};
  }
  std::vector<Answer> answers(const Job& job, std::size_t count) const {
    const auto one = [this](const Specimen& b, const Shaking& s) { return answer(peer_(b, s, steps_)); };
    return one_by_one(one)(job, count);
  }

  static constexpr int most_tries = 16;
  static constexpr double round_off = 1e-13;
  Peer peer_;
  bool found_ = false;
  OdeintSteps steps_;
};

}  // namespace freestand::bench
