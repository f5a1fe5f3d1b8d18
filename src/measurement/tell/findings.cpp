#include "measurement/tell/findings.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/digits.hpp"
#include "measurement/laboratory/plausible.hpp"
#include "measurement/tell/findings_friction.hpp"
#include "measurement/tell/findings_motion.hpp"
#include "measurement/tell/findings_where.hpp"

namespace freestand::measurement {
namespace {

constexpr double nearly = 1.2;  // of the error that noise makes, below which an error is as good as that

// Does a residual go on from sample to sample by more than noise does? The correlated part of its mean square is that of
// the sensor and of what the floor's noise makes; where that acts in one direction alone, it is 3.84 times its mean in
// one test of twenty (chi square of one degree); and the correlation of n white samples scatters by 1/sqrt(n).
bool goes_on(const Sensor& sensor, const ChannelError& e, double spread, std::size_t samples) {
  const double square = e.noise_units * e.noise_units, noise = sensor.coloured * sensor.coloured + spread;
  return e.autocorrelation * square > gsl_cdf_chisq_Pinv(0.95, 1) * noise + gsl_cdf_ugaussian_Pinv(0.95) * square /
                                                                                std::sqrt(static_cast<double>(samples));
}

class Findings {
 public:
  Findings(const Bench& bench, const ModelSpec& model, std::span<const double> x, const Comparison& c)
      : bench_(bench), model_(model), x_(x), c_(c) {}

  std::vector<std::string> all(const Quality& quality) {
    said_ = quality.findings;
    failures();
    for (std::string& said : motion_findings(bench_, model_, x_, c_.tests)) said_.push_back(std::move(said));
    errors();
    peaks();
    outcomes();
    if (std::string place = where_wrong(bench_, c_.calibration); !place.empty()) said_.push_back(std::move(place));
    drift();
    chaotic();
    numbers();
    return std::move(said_);
  }

 private:
  template <class... T>
  void say(fmt::format_string<T...> text, T&&... values) {
    said_.push_back(fmt::format(text, std::forward<T>(values)...));
  }

  // Tests that the model could not be computed to the end of: their errors say nothing of its quality.
  void failures() {
    for (const Outcome outcome : {Outcome::painleve, Outcome::step_limit, Outcome::not_finite}) {
      std::vector<std::string> ids;
      for (const TestComparison& t : c_.tests)
        if (t.model.response.outcome == outcome) ids.push_back(bench_.test(t.test).id);
      if (!ids.empty())
        say("the model breaks off in {} of {} tests ({}): {}; their errors are not its own", ids.size(),
            c_.tests.size(), failure(outcome), fmt::join(ids, ", "));
    }
  }

  void errors() {
    for (const Role role : {Role::calibration, Role::holdout}) {
      Pool all, judged;
      for (const TestComparison& t : c_.tests) {
        if (bench_.test(t.test).role != role || !bench_.test(t.test).has_history()) continue;
        all.add(t);
        if (!(t.expected > drowned)) judged.add(t);
      }
      if (all.n == 0) continue;
      std::string part;
      if (judged.n > 0 && judged.n < all.n)
        part = fmt::format("; without those in which that noise fans out, by {} where it would make {}",
                           judged.error_text(), three_digits(judged.floor()));
      const bool near = judged.n > 0 && judged.error() < nearly * judged.floor();
      const bool unread = !near && judged.n > 0 && judged.error() < nearly * judged.floor_and_unread();
      say("{} tests are missed by {} noise units (root mean square{}); the noise of sensors and floor alone would make "
          "{}{}{}",
          role == Role::calibration ? "calibration" : "held-out", all.error_text(), by_channel(all),
          three_digits(all.floor()), part,
          near     ? left_to_explain(judged, role)
          : unread ? ": what the floor did between its readings may be all that is left"
          : judged.n > 0 && judged.tests.front()->own_friction  ? told_with_own_friction(judged.tests, role)
          : judged.n > 0 && role == Role::calibration           ? ": diagnose asks what is missing"
          : judged.n == 0 && all.error() < nearly * all.floor() ? ", so that they cannot be judged"
                                                                : "");
    }
    worst();
  }

  struct Pool {
    double square = 0, expected = 0, unread = 0, n = 0;
    bool capped = false;
    std::vector<const TestComparison*> tests = {};
    void add(const TestComparison& t) {
      square += t.error.noise_units * t.error.noise_units;
      expected += t.expected * t.expected;
      unread += t.unread * t.unread;
      capped |= t.error.noise_units >= failed_error;
      tests.push_back(&t);
      ++n;
    }
    double error() const { return std::sqrt(square / n); }
    double floor() const { return std::sqrt(expected / n); }
    double floor_and_unread() const { return std::sqrt((expected + unread) / n); }
    std::string error_text() const { return (capped ? "at least " : "") + three_digits(error()); }
  };

  // "; slip by 18.3 mm, rotation by 4.2 mrad": root mean square over the tests that measured it.
  std::string by_channel(const Pool& pool) const {
    std::string all;
    for (int c = 0; c < channel_count && !pool.capped; ++c) {
      double square = 0, n = 0;
      for (const TestComparison* t : pool.tests)
        for (const ChannelError& e : t->channels)
          if (static_cast<int>(e.channel) == c && std::isfinite(e.noise_units))
            square += e.noise_units * e.noise_units, ++n;
      const auto channel = static_cast<Channel>(c);
      if (n > 0)
        all += fmt::format("{} {} by {}", all.empty() ? ";" : ",", word(channel),
                           told(channel, bench_.noise(channel) * std::sqrt(square / n)));
    }
    return all;
  }

  // What an error no greater than the noise makes says of the model.
  std::string left_to_explain(const Pool& pool, Role role) {
    if (std::none_of(pool.tests.begin(), pool.tests.end(),
                     [&](const TestComparison* t) { return moves(bench_, t->test); }))
      return ": nothing was measured above the noise, so that this says little of the model";
    const std::size_t tests = tests_of(bench_.data(), Role::calibration).size();
    if (role == Role::calibration && tests <= model_.free.size())
      return fmt::format(": as {} numbers fitted to {} tests may bring about with any model", model_.free.size(),
                         tests);
    // Of these tests, and no praise beside others whose errors go on.
    const std::string left = structure(pool.tests);
    std::vector<const TestComparison*> all;
    for (const TestComparison& t : c_.tests) all.push_back(&t);
    return (left.empty() && structure(all).empty() ? ": nothing is left to explain" : ": little is left to explain") +
           left;
  }

  // Residuals that go on from sample to sample, where they are more than one in twenty by chance.
  std::string structure(const std::vector<const TestComparison*>& tests) const {
    unsigned going = 0, n = 0;
    for (const TestComparison* t : tests)
      for (const ChannelError& e : t->channels) {
        if (!(bench_.noise(e.channel) > 0) || t->expected > drowned) continue;
        const auto& variance = t->spread[static_cast<std::size_t>(e.channel)];
        double spread = 0;
        for (const double v : variance)
          spread += v / (std::pow(bench_.noise(e.channel), 2) * static_cast<double>(variance.size()));
        ++n;
        going += goes_on(bench_.sensor(e.channel), e, spread, variance.size());
      }
    if (going == 0 || gsl_cdf_binomial_Q(going - 1, 0.05, n) > 0.05) return "";
    return fmt::format(
        ", but in {} of {} residuals the error goes on from sample to sample as noise does not: diagnose asks whether "
        "an "
        "effect or a sensor makes it",
        going, n);
  }

  void worst() {
    if (c_.worst.empty()) return;
    const TestComparison& worst = c_.tests[c_.worst.front()];
    if (!(worst.error.noise_units > 2)) return;
    const ChannelError* most = nullptr;
    for (const ChannelError& e : worst.channels)
      if ((moves(bench_, worst.test, e.channel) || e.channel == Channel::block_acceleration) &&
          std::isfinite(e.noise_units) && !(most && most->noise_units >= e.noise_units))
        most = &e;
    say("the worst test is {} with {} noise units{}", bench_.test(worst.test).id, one(worst).error_text(),
        most ? fmt::format(": its {} is missed by {}, {:.0f} % of the measured peak", word(most->channel),
                           told(most->channel, most->noise_units * bench_.noise(most->channel)), 100 * most->relative)
             : ", where nothing was measured above the noise");
  }

  static Pool one(const TestComparison& t) {
    Pool pool;
    pool.add(t);
    return pool;
  }

  void peaks() {
    std::vector<std::string> fallen;
    for (const TestComparison& t : c_.tests)
      if (kind(bench_.test(t.test)) == Kind::peaks && !peaks_compare(bench_.test(t.test), t.model.response))
        fallen.push_back(bench_.test(t.test).id);
    if (!fallen.empty())
      say("{} of {} tests overturned, as measured or in the model ({}): what counts there is whether both fall, since "
          "peaks may hold the fall",
          fallen.size(), c_.tests.size(), listed(fallen));
    const PeakRatio ratio = peak_ratio(bench_, c_.tests);
    if (ratio.odd && kind_of_set(bench_) == Kind::peaks)
      say("beside the model the peak slip of {} is {:.2g} times that of the others, which scatter by {:.2g} %, further "
          "off than chance puts one of {} (p {:.2g}): check its unit, its scale and its record",
          ratio.odd_test, std::exp(-ratio.odd->off), 100 * ratio.odd->scatter_of_others, ratio.count, ratio.odd->p);
    if (ratio.count < 3) return;
    const auto n = static_cast<double>(ratio.count);
    const auto ratio_text = [](double ln) {
      return ln < std::log(0.1) ? three_digits(std::exp(ln)) : fmt::format("{:.2f}", std::exp(ln));
    };
    const std::string middle = fmt::format(
        "{} times the measured ones (geometric mean of {} tests{}; 95 % between {} and {})", ratio_text(ratio.bias_ln),
        ratio.count, ratio.still ? fmt::format(" without {} in which the model stands still", ratio.still) : "",
        ratio_text(ratio.bias_ln - ratio.within_ln), ratio_text(ratio.bias_ln + ratio.within_ln));
    const bool under = ratio.bias_ln < 0;
    const double factor = std::exp(ratio.scatter_ln);
    const double scatter_of_noise = ratio.noise_ln * std::sqrt(gsl_cdf_chisq_Pinv(0.95, n - 1) / (n - 1));
    if (ratio.biased())
      say("the model {} the peak slip: predicted ones are {} and scatter by a factor of {:.2f}; its resistance is too "
          "{}",
          under ? "underpredicts" : "overpredicts", middle, factor, under ? "high" : "low");
    else if (ratio.scatter_ln > std::max(0.05, scatter_of_noise))
      say("predicted peak slips are {}: right in the mean, as far as these tests show, but they scatter by a factor of "
          "{:.2f} from test to test, {}",
          middle, factor,
          only_friction_differs(c_.tests)
              ? "as friction that differs between them makes"
              : "which another friction would not mend: look for an effect that is missing, or for "
                "what differs between the tests");
  }

  // Of tests that say whether the specimen overturned: how many are missed, and whether chance explains it.
  void outcomes() {
    for (const Role role : {Role::calibration, Role::holdout}) {
      std::vector<const TestComparison*> all;
      for (const TestComparison& t : c_.tests)
        if (const Test& test = bench_.test(t.test); test.role == role && kind(test) == Kind::outcome) all.push_back(&t);
      if (!all.empty()) outcomes(all, role);
    }
  }

  void outcomes(const std::vector<const TestComparison*>& all, Role role) {
    std::size_t missed = 0, false_alarms = 0, overturned = 0;
    double brier = 0;
    Values probability;
    std::vector<bool> fallen;
    std::vector<std::string> sure;
    const auto n = static_cast<double>(all.size());
    for (const TestComparison* t : all) {
      const bool fell = measurement::fell(bench_.test(t->test));
      const double p = t->error.probability;
      const bool says = p > 0.5;
      overturned += fell;
      missed += says != fell;
      false_alarms += says && !fell;
      brier += t->error.score / n;
      probability.push_back(p);
      fallen.push_back(fell);
      if (t->error.score > 0.81)
        sure.push_back(fmt::format("{} ({:.2f}, {})", bench_.test(t->test).id, p, fell ? "overturned" : "stood"));
    }
    const char* whose = role == Role::calibration ? "calibration" : "held-out";
    if (role == Role::calibration && (overturned == 0 || overturned == all.size()))
      say("all {} calibration tests {}: they bound the model from one side only, and one that {} misses none of them; "
          "add "
          "tests that {}",
          all.size(), overturned ? "overturned" : "stood", overturned ? "always overturns" : "never overturns",
          overturned ? "stood" : "overturned");
    say("{} of {} {} tests are missed ({:.1f} %){}", missed, all.size(), whose, 100.0 * static_cast<double>(missed) / n,
        missed == 0 ? std::string()
                    : fmt::format(": {} that stood were predicted to overturn, {} that overturned to stand",
                                  false_alarms, missed - false_alarms));
    const bool fitted = role == Role::calibration && c_.misfit;
    const OutcomeMisfit misfit = fitted ? *c_.misfit : outcome_misfit(probability, fallen, by_draw(all));
    say("the Brier score of the {} tests is {:.4f}{}; were the model's probabilities {}right, chance alone would make "
        "{:.4f} +- {:.4f}{}: {}",
        whose, brier, fitted ? fmt::format(", {:.4f} as fitted", std::abs(misfit.score)) : "",
        fitted ? "as fitted " : "", std::abs(misfit.usual_score), misfit.score_scatter, fitted ? " of the latter" : "",
        misfit.surer()         ? "the model is surer than it may be, something is missing"
        : misfit.other_count() ? "chance explains that score, but not how many overturned: something is missing"
        : misfit.score < misfit.usual_score - 2 * misfit.score_scatter ? "the model is less sure than it might be"
                                                                       : "chance explains what is missed");
    if (misfit.other_count())
      say("{} of the {} tests overturned where the model {}expects {:.1f} +- {:.1f}: it is too {}", overturned, whose,
          fitted ? "as fitted " : "", misfit.expected, misfit.count_scatter,
          misfit.expected > misfit.fell ? "unstable" : "stable");
    if (!sure.empty())
      say("against odds of nine to one (probability of overturning in brackets) came out {}", fmt::join(sure, ", "));
  }

  // Of each draw the probabilities of the tests.
  static std::vector<Values> by_draw(const std::vector<const TestComparison*>& all) {
    std::vector<Values> draws(all.front()->by_draw.size());
    for (std::size_t k = 0; k < draws.size(); ++k)
      for (const TestComparison* t : all) draws[k].push_back(t->by_draw[k]);
    return draws;
  }

  // Residual slips of the model end on one side of the measured ones, in more tests of any role than chance makes.
  void drift() {
    unsigned right = 0, left = 0;
    for (const TestComparison& t : c_.tests) {
      const Test& test = bench_.test(t.test);
      if (test.slip_m.empty() || t.model.failed() || t.expected > drowned) continue;
      const double end = t.model.slip_m.back() - test.slip_m.back();
      if (std::abs(end) > 6 * bench_.noise(Channel::slip)) ++(end > 0 ? right : left);
    }
    const unsigned most = std::max(right, left), all = right + left;
    const double p = most > 0 ? 2 * gsl_cdf_binomial_Q(most - 1, 0.5, all) : 1;
    if (p < 0.05)
      say("in {} of {} tests whose end is missed the block ends further to the {} than the model (by chance: p = {}): "
          "a "
          "bias of direction, as of a tilted floor or of friction that depends on direction; check the table's level",
          most, all, right > left ? "left" : "right", three_digits(p));
  }

  void chaotic() {
    std::vector<std::string> ids;
    for (const TestComparison& t : c_.tests)
      if (t.expected > drowned) ids.push_back(bench_.test(t.test).id);
    if (!ids.empty())
      say("the noise of the measured floor motion fans out in {}: parts of these histories cannot be predicted by any "
          "model, and say nothing for or against one",
          fmt::join(ids, ", "));
  }

  void numbers() {
    const std::size_t tests = tests_of(bench_.data(), Role::calibration).size();
    // A history has many readings.
    if (kind_of_set(bench_) != Kind::history && !model_.free.empty() && tests <= model_.free.size())
      say("{} calibration tests for {} calibrated numbers: the fit is not determined by them", tests,
          model_.free.size());
    for (std::size_t i = 0; i < model_.free.size() && i < x_.size(); ++i) {
      const Free& free = model_.free[i];
      const double z = to_unit(free, x_[i]), low = to_unit(free, free.lower), high = to_unit(free, free.upper);
      if (z < low + 1e-3 * (high - low) || z > high - 1e-3 * (high - low))
        say("{} ends at the bound of its range ({:.4g}): widen the range, or doubt the model", free.name, x_[i]);
    }
  }

  const Bench& bench_;
  const ModelSpec& model_;
  std::span<const double> x_;
  const Comparison& c_;
  std::vector<std::string> said_;
};

}  // namespace

std::vector<std::string> findings(const Bench& bench, const ModelSpec& model, std::span<const double> x,
                                  const Comparison& comparison, const Quality& quality) {
  return Findings(bench, model, x, comparison).all(quality);
}

OpenEnds open_ends(const ModelFit& fit, std::size_t number) {
  if (number >= fit.intervals.size()) return {};
  constexpr double within = 0.95, beyond = 0.5 * (1 - within), half = 0.5;
  const Free& free = fit.model.free[number];
  // As draws are spread beforehand: the scatter of placements evenly, others as fits move (outcome_draws.hpp).
  const auto& placed = fit.model.placement_scatter;
  const bool even = placed && placed->free == static_cast<int>(number);
  const auto place = [&](double x) { return even ? (x - free.lower) / (free.upper - free.lower) : to_unit(free, x); };
  const double lower = place(fit.intervals[number].lower), upper = place(fit.intervals[number].upper);
  const double widest = beyond / (half * within) * (upper - lower);
  return {lower - place(free.lower) <= widest, place(free.upper) - upper <= widest};
}

std::vector<std::string> undetermined(const ModelFit& fit) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < fit.intervals.size(); ++i) {
    const Free& free = fit.model.free[i];
    const auto [lower, upper] = fit.intervals[i];
    const OpenEnds open = open_ends(fit, i);
    if (open.below && open.above)
      found.push_back(fmt::format("the tests do not determine {}: it may be anything from {:.4g} to {:.4g}", free.name,
                                  free.lower, free.upper));
    else if (open.below || open.above)
      found.push_back(fmt::format("the tests bound {} from {} only, at {:.4g}", free.name,
                                  open.above ? "below" : "above", open.above ? lower : upper));
  }
  return found;
}

}  // namespace freestand::measurement
