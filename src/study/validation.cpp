#include "study/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/folder.hpp"
#include "io/provenance.hpp"
#include "measurement/fit/grown_fit.hpp"
#include "measurement/fit/outcome_fit.hpp"
#include "measurement/tell/findings.hpp"
#include "measurement/verdict/diagnose_outcomes.hpp"
#include "study/problems.hpp"
#include "study/read_measurements.hpp"
#include "study/read_parts.hpp"
#include "study/validation_parts.hpp"

namespace freestand::study {
namespace {

using namespace measurement;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// The first few.
std::string listed(const std::vector<std::string>& ids) {
  constexpr std::size_t most = 4;
  const std::vector<std::string> shown(ids.begin(), ids.begin() + static_cast<long>(std::min(ids.size(), most)));
  return fmt::format("{}{}", fmt::join(shown, ", "),
                     ids.size() > most ? fmt::format(" and {} more", ids.size() - most) : "");
}

void check_dimensions(const Prepared& p) {
  Problems problems(p.measurements);
  for (const Test& test : p.data.tests)
    if (const std::string missing = missing_dimension(p.model, test); !missing.empty())
      problems.add(0, fmt::format("test {} has no {} (neither the specimen nor the study gives it): add it to the "
                                  "specimen, or block: {{{}: {{calibrate: [lower, upper]}}}} to the model",
                                  test.id, missing, missing));
  problems.throw_if_any();
}

void check_vertical(const Prepared& p) {
  if (p.model.has("vertical_shaking") &&
      std::none_of(p.data.tests.begin(), p.data.tests.end(), [](const Test& t) { return t.has_vertical(); }))
    throw Error(fmt::format("{}: effect vertical_shaking has nothing to act on (no test of {} has a vertical channel): "
                            "give floor_vertical_acceleration_mps2, or remove the effect",
                            p.validation.file.string(), p.measurements),
                Exit::data);
}

}  // namespace

std::string level_tests(const Prepared& p) {
  std::vector<std::string> ids;
  for (const Test& test : p.data.tests)
    if (p.model.has("vertical_shaking") && !test.has_vertical()) ids.push_back(test.id);
  return ids.empty() ? ""
                     : fmt::format(
                           "vertical_shaking acts on no vertical channel in {}: there the floor is taken to move "
                           "sideways alone",
                           listed(ids));
}

namespace {

// Histories, peaks and outcomes are judged each by a loss of its own, and the sum of two of them means nothing.
void check_one_kind(const Prepared& p) {
  constexpr const char* names[] = {"histories", "peaks alone", "outcomes alone"};
  std::vector<std::string> ids[3], told;
  for (const Test& test : p.data.tests) ids[static_cast<int>(kind(test))].push_back(test.id);
  for (int k = 0; k < 3; ++k)
    if (!ids[k].empty()) told.push_back(fmt::format("{} ({})", names[k], listed(ids[k])));
  if (told.size() > 1)
    throw Error(
        fmt::format("{}: the tests hold {} (errors of different kinds have no common scale): split the file into "
                    "one for each kind, and hold the model against each with --measurements",
                    p.measurements, fmt::join(told, " and ")),
        Exit::data);
}

// Outcomes are judged by probabilities: placements scatter.
void add_placement_scatter(Prepared& p) {
  bool outcomes = false;
  for (const Test& test : p.data.tests) outcomes |= kind(test) == Kind::outcome;
  if (!outcomes || p.model.placement_scatter) return;
  p.model.placement_scatter = Number{.value = 0, .free = static_cast<int>(p.model.free.size())};
  p.model.free.push_back({.name = "placement_scatter",
                          .unit = "1",
                          .lower = 0.001,
                          .upper = 0.5,
                          .low = 0.02,
                          .high = 0.3,
                          .logarithmic = true});
}

}  // namespace

const char* calibration_method(const Bench& bench) {
  if (outcomes_only(bench.data()))
    return "outcomes are computed for many placements of the specimen at points of a Sobol sequence that"
           " close in on the best; over these points, and over middle and scatter of the placements, "
           "Brier's score of the calibration tests is made least; tests left out are predicted by the "
           "mean over 25 fits to draws of the others with replacement; intervals of 95 % are those of joint "
           "draws: the likelihood of the outcomes, as wide as the disagreement of the tests makes it";
  if (measurement::kind_of_set(bench) == measurement::Kind::peaks)
    return "points of a Sobol sequence are screened, from the best few the simplex method of Nelder and "
           "Mead descends (GSL nmsimplex2), and once more from the best of those; the mean of "
           "ln(model/measured)^2 of the calibration tests' peaks is made least; intervals of 95 % are those of joint "
           "draws: Student's density of the misfit, as wide as the disagreement of the tests makes it";
  return "points of a Sobol sequence are screened, from the best few the simplex method of Nelder and "
         "Mead descends (GSL nmsimplex2), and once more from the best of those; the mean of "
         "ln(error^2) of the calibration tests is made least; histories end in Levenberg and "
         "Marquardt's least squares (GSL multifit_nlinear), at the noise weighed by the covariance "
         "that replays of the floor's noise show; intervals of 95 % are those of joint draws: "
         "Student's density of the misfit, as wide as noise and the disagreement of the tests make it";
}

nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json numbers_or_null(const std::vector<double>& values) {
  auto list = nlohmann::ordered_json::array();
  for (const double v : values) list.push_back(number_or_null(v));
  return list;
}

std::optional<Interval> interval_of(const ModelFit& fit, std::size_t i) {
  if (i >= fit.intervals.size()) return {};
  const auto [lower, upper] = fit.intervals[i];
  return std::isfinite(lower) && std::isfinite(upper) && lower < upper ? std::optional(fit.intervals[i]) : std::nullopt;
}

const char* no_interval(const ModelFit& fit, std::size_t i) {
  if (i >= fit.intervals.size())
    return fit.left_out_refitted ? "no tests could be left out" : "the model was not fitted with tests left out";
  return std::isfinite(fit.intervals[i].lower) ? "the error jumps on both sides of the value" : "none was given";
}

void add_interval(nlohmann::ordered_json& parameter, const ModelFit& fit, std::size_t i) {
  const auto known = interval_of(fit, i);
  parameter["interval"] = nullptr;
  if (known) parameter["interval"] = {known->lower, known->upper};
  const OpenEnds open = known ? open_ends(fit, i) : OpenEnds{};
  if (open.below || open.above) parameter["open"] = !open.above ? "below" : !open.below ? "above" : "both";
  if (!known) parameter["no_interval"] = no_interval(fit, i);
}

void add_provenance(nlohmann::ordered_json& document, const parallel::Communicator& world, const ValidationRun& run) {
  const io::Provenance p = io::provenance_here(run.command, world.size());
  document["created_utc"] = p.created_utc;
  document["version"] = p.version;
  document["git_commit"] = p.git_commit;
  document["command"] = p.command;
  document["compiler"] = p.compiler;
  document["host"] = p.host;
  document["ranks"] = p.ranks;
}

std::unique_ptr<Prepared> prepare(const parallel::Communicator& world, Validation validation, const ValidationRun& run,
                                  int replays) {
  auto p = std::make_unique<Prepared>();
  p->validation = std::move(validation);
  p->measurements = run.measurements.empty() ? p->validation.measurements.string() : run.measurements;
  if (p->measurements.empty())
    throw Error(
        fmt::format("{} names no measurements (what is the model held against?): add measurements: "
                    "dataset.yaml, or give --measurements",
                    p->validation.file.string()));
  world.on_root([&] {
    if (run.measurements.empty() && !is_file(p->measurements))
      throw Error(
          fmt::format("{}:{}: measurements are not there ({} is no file): correct the path, which starts at the "
                      "study's folder",
                      p->validation.file.string(), p->validation.measurements_line, p->measurements),
          Exit::data);
    read_measurements(p->measurements);
  });
  p->data = read_measurements(p->measurements);
  p->model = model_spec(p->validation, false);
  check_one_kind(*p);
  check_dimensions(*p);
  check_vertical(*p);
  add_placement_scatter(*p);
  p->bench = std::make_unique<Bench>(p->data, replays);
  p->bench->estimate_sensors();
  return p;
}

std::unique_ptr<Prepared> prepare(const parallel::Communicator& world, const ValidationRun& run, int replays) {
  world.on_root([&] { read_validation(run.study); });
  return prepare(world, read_validation(run.study), run, replays);
}

std::string content(const Prepared& p) {
  std::string all = read_text(p.validation.file) + read_text(p.measurements);
  for (const Test& test : p.data.tests) {
    all += test.id;
    for (const std::span<const double> numbers :
         {std::span<const double>(test.slip_m), std::span<const double>(test.rotation_rad),
          std::span<const double>(test.block_acceleration_mps2), std::span<const double>(test.motion.knot_s),
          std::span<const double>(test.motion.horizontal_mps2), std::span<const double>(test.motion.vertical_mps2)})
      all.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
  }
  return all;
}

namespace {

// As the study states them, in the order of the model's free numbers.
std::vector<Interval> known_intervals(const Prepared& p) {
  std::vector<Interval> known;
  for (const Free& free : p.model.free) {
    known.push_back({no_number, no_number});
    for (const Calibrated& c : p.validation.calibrated)
      if (c.name == free.name && c.interval.size() == 2) known.back() = {c.interval[0], c.interval[1]};
  }
  return known;
}

}  // namespace

ModelFit fitted(const Prepared& p, bool refit, const Jobs& jobs) {
  const Bench& bench = *p.bench;
  Values known = known_values(p.validation);
  const bool all_known = known.size() == p.model.free.size();
  if (p.model.free.empty() || (all_known && !refit)) {
    ModelFit fit{.model = p.model, .x = known, .score = 0};
    fit.score = mean_score(bench, tests_of(p.data, Role::calibration), fit.model, fit.x);
    evaluate(bench, {&fit}, jobs);
    fit.intervals = known_intervals(p);
    // Outcomes are predicted by the mean over all numbers that the tests leave open, whoever fitted them.
    if (outcomes_only(p.data) && !fit.x.empty() && !tests_of(p.data, Role::calibration).empty()) {
      ModelFit open = fit_outcomes(bench, p.model, known, {}, jobs);
      fit.draws = std::move(open.draws);
      fit.misfit = open.misfit;
    }
    return fit;
  }
  if (tests_of(p.data, Role::calibration).empty())
    throw Error(fmt::format("{} has no calibration test (the model has numbers to be calibrated): give some tests "
                            "role: calibration",
                            p.measurements),
                Exit::data);
  return all_known ? fit_from(bench, p.model, known, jobs) : grown_fit(bench, p.model, jobs);
}

// Of tests that say only whether the specimen overturned.
void average_over_draws(const Bench& bench, const ModelSpec& model, const Posterior& open,
                        std::vector<TestComparison>& tests, const Jobs& jobs) {
  constexpr std::size_t most = 25;  // a probability of 1/2 that differs wholly from draw to draw is known to 0.1
  std::vector<std::size_t> outcomes;
  for (std::size_t i = 0; i < tests.size(); ++i)
    if (kind(bench.test(i)) == Kind::outcome) outcomes.push_back(i);
  const std::size_t count = std::min(most, open.of_mean.size());
  if (outcomes.empty() || count == 0) return;
  const auto answers = jobs("predictions by the draws", count, [&](std::size_t k) {
    Values p;
    for (const TestError& error : test_errors(bench, outcomes, model, spread_row(open.of_mean, k, count)))
      p.push_back(error.probability);
    return p;
  });
  for (std::size_t t = 0; t < outcomes.size(); ++t) {
    double mean = 0;
    for (const Values& answer : answers) {
      mean += answer[t] / static_cast<double>(count);
      tests[outcomes[t]].by_draw.push_back(answer[t]);
    }
    tests[outcomes[t]].error = outcome_error(bench.test(outcomes[t]), std::clamp(mean, 0.0, 1.0));
  }
}

// The predictions stay those of one friction for all tests.
void allow_own_friction(const Bench& bench, const ModelFit& fit, const Posterior& open,
                        std::vector<TestComparison>& tests, const Jobs& jobs) {
  const auto answers = jobs("friction of each test", tests.size(), [&](std::size_t i) {
    if (!bench.test(tests[i].test).has_history()) return Values{};
    TestComparison own{.test = tests[i].test, .spread = tests[i].spread};
    give_own_friction(bench, fit.model, fit.x, open.friction_scatter, open.friction_freedom, own);
    return Values{own.explained, *own.own_friction};
  });
  for (std::size_t i = 0; i < tests.size(); ++i)
    if (!answers[i].empty()) tests[i].explained = answers[i][0], tests[i].own_friction = answers[i][1];
}

std::vector<TestComparison> compare_tests(const Bench& bench, const ModelFit& fit, const Posterior& open,
                                          const Jobs& jobs) {
  // The replays are the work; each test's variances travel, the prediction is made again.
  const auto spreads = jobs("replays of the floor's noise", bench.size(), [&](std::size_t i) {
    Values all;
    if (!bench.test(i).has_history()) return all;
    const Prediction nominal = predict(fit.model, bench.test(i), fit.x);
    for (const Spread& spread :
         {bench.spread(fit.model, i, fit.x, nominal), bench.unread_spread(fit.model, i, fit.x, nominal)})
      for (const auto& channel : spread) all.insert(all.end(), channel.begin(), channel.end());
    return all;
  });
  std::vector<TestComparison> tests;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    auto at = spreads[i].begin();
    const auto next = [&] {
      Spread spread(channel_count);
      for (int c = 0; c < channel_count && bench.test(i).has_history(); ++c) {
        const auto n = static_cast<long>(history(bench.test(i), static_cast<Channel>(c)).size());
        spread[static_cast<std::size_t>(c)].assign(at, at + n);
        at += n;
      }
      return spread;
    };
    Spread of_noise = next();
    tests.push_back(compare_test(bench, i, fit.model, fit.x, std::move(of_noise), next()));
  }
  average_over_draws(bench, fit.model, open, tests, jobs);
  if (open.friction_scatter > 0) allow_own_friction(bench, fit, open, tests, jobs);
  return tests;
}

RoleError role_error(const Bench& bench, const std::vector<TestComparison>& tests, Role role) {
  RoleError out;
  std::vector<TestError> errors;
  std::vector<std::size_t> places;
  double relative = 0, expected = 0, explained = 0, noise = 0;
  for (const TestComparison& t : tests) {
    if (bench.test(t.test).role != role) continue;
    errors.push_back(t.error);
    places.push_back(t.test);
    relative += t.error.relative * t.error.relative;
    expected += t.expected * t.expected;
    explained += t.explained * t.explained;
    noise += t.error.noise_units * t.error.noise_units;
  }
  out.tests = errors.size();
  const auto n = static_cast<double>(errors.size());
  out.error = pooled(bench, places, errors).error;
  out.relative = std::sqrt(relative / n);
  out.expected = std::sqrt(expected / n);
  out.explained = std::sqrt(explained / n);
  out.noise_units = std::sqrt(noise / n);
  if (outcomes_only(bench.data())) out.expected = expected_brier(errors).error;
  return out;
}

const char* error_unit(const Bench& bench) {
  const Kind judged = bench.size() == 0 ? Kind::history : kind(bench.test(0));
  return judged == Kind::history ? "noise units" : judged == Kind::peaks ? "ln ratio" : "Brier";
}

nlohmann::ordered_json ladder_json(const std::vector<LadderStep>& ladder) {
  auto json = nlohmann::ordered_json::array();
  for (const LadderStep& step : ladder)
    json.push_back({{"step", step.step},
                    {"error_calibration", number_or_null(step.error_calibration)},
                    {"error_holdout", number_or_null(step.error_holdout)},
                    {"noise_floor", number_or_null(step.noise_floor)},
                    {"noise_floor_holdout", number_or_null(step.noise_floor_holdout)},
                    {"explained_holdout", number_or_null(step.explained_holdout)},
                    {"explained_calibration", number_or_null(step.explained_calibration)}});
  return json;
}

}  // namespace freestand::study
