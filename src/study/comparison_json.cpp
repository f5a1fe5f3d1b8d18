#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "measurement/fit/bands.hpp"
#include "measurement/noise/unread_floors.hpp"
#include "measurement/tell/findings.hpp"
#include "study/fitted_study.hpp"
#include "study/posterior_tables.hpp"
#include "study/spread_jobs.hpp"
#include "study/validation_parts.hpp"

namespace freestand::study {
namespace {

using namespace measurement;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_points = 2000;
const char* const roles[] = {"calibration", "holdout"};
const char* const kinds[] = {"history", "peaks", "outcome"};

double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

// Measured and predicted peaks, of what was measured. Those of a history are read from the model's history: where a block
// overturned both hold the fall. compared: not where a peak alone may hold it.
Json peaks_json(const Test& test, const Prediction& model) {
  Json list = Json::array();
  const Response& r = model.response;
  const auto add = [&](const char* key, const std::optional<double>& measured, double predicted) {
    if (measured)
      list.push_back({{"name", key},
                      {"measured", number_or_null(*measured)},
                      {"model", number_or_null(predicted)},
                      {"compared", peaks_compare(test, r)}});
  };
  const bool slip = !test.slip_m.empty() && !model.failed(), turn = !test.rotation_rad.empty() && !model.failed();
  add("peak_slip_m", test.slip_m.empty() ? test.peaks.peak_slip_m : greatest(test.slip_m),
      slip ? greatest(model.slip_m) : r.peak_slip_m);
  add("residual_slip_m", test.slip_m.empty() ? test.peaks.residual_slip_m : test.slip_m.back(),
      slip ? model.slip_m.back() : r.residual_slip_m);
  add("peak_rotation_rad", test.rotation_rad.empty() ? test.peaks.peak_rotation_rad : greatest(test.rotation_rad),
      turn ? greatest(model.rotation_rad) : r.peak_rotation_rad);
  add("peak_acceleration_g", test.peaks.peak_acceleration_g, r.peak_acceleration_mps2 / standard_gravity_mps2);
  return list;
}

// At the knots of a record, and at the ends of short steps of a pulse.
double floor_peak_g(const Test& test) {
  const double end = test.motion.knot_s.back() * test.stretch;
  const std::size_t n = std::max<std::size_t>(400, test.motion.segments());
  double most = 0;
  for (std::size_t i = 0; i <= n; ++i)
    most = std::max(
        most, std::abs(horizontal_acceleration(test.shaking(), end * static_cast<double>(i) / static_cast<double>(n))));
  return most / standard_gravity_mps2;
}

// Root mean square of ln(predicted/measured) of what a test of peaks measured, with the sign of their sum.
Json ln_ratio(const Bench& bench, const TestComparison& t) {
  if (kind(bench.test(t.test)) != Kind::peaks) return nullptr;
  double sum = 0;
  for (const double ratio : ln_ratios(bench, t.test, t.model)) sum += ratio;
  return number_or_null(std::copysign(std::sqrt(t.error.score), sum < 0 ? -1 : 1));
}

Json test_json(const Bench& bench, const TestComparison& t) {
  const Test& test = bench.test(t.test);
  Json json = {{"id", test.id},
               {"role", roles[static_cast<int>(test.role)]},
               {"kind", kinds[static_cast<int>(kind(test))]},
               {"source", test.source},
               {"floor_peak_g", floor_peak_g(test)},
               {"error_noise_units", number_or_null(t.error.noise_units)},
               {"error_relative", number_or_null(t.error.relative)},
               {"error_floor_noise_allowed", number_or_null(t.explained)},
               {"own_friction", t.own_friction ? Json(*t.own_friction) : Json(nullptr)},
               {"error_expected", number_or_null(t.expected)},
               {"score", number_or_null(t.error.score)},
               {"ln_ratio", ln_ratio(bench, t)},
               {"outcome", name(t.model.response.outcome)},
               {"peaks", peaks_json(test, t.model)}};
  json["channels"] = Json::array();
  for (const ChannelError& c : t.channels)
    json["channels"].push_back({{"name", name(c.channel)},
                                {"error_noise_units", number_or_null(c.noise_units)},
                                {"error_relative", number_or_null(c.relative)},
                                {"bias", c.bias},
                                {"autocorrelation", c.autocorrelation}});
  if (test.peaks.overturned) {
    json["overturned_measured"] = *test.peaks.overturned;
    const bool falls = t.model.response.outcome == Outcome::overturned;
    json["overturned_probability"] = kind(test) == Kind::outcome ? t.error.probability : falls ? 1.0 : 0.0;
  }
  return json;
}

Json history_json(const Bench& bench, const TestComparison& t, const Bands& bands) {
  const Test& test = bench.test(t.test);
  const std::size_t n = t.model.slip_m.size(), stride = std::max<std::size_t>(1, (n + most_points - 1) / most_points);
  Json json = {{"id", test.id}, {"role", roles[static_cast<int>(test.role)]}, {"dt_s", test.dt_s}};
  const auto thinned = [&](auto&& value) {
    Json list = Json::array();
    for (std::size_t k = 0; k < n; k += stride) list.push_back(number_or_null(value(k)));
    return list;
  };
  const auto each = [&](const std::vector<double>& values) {
    return thinned([&](std::size_t k) { return values[k]; });
  };
  json["time_s"] = thinned([&](std::size_t k) { return static_cast<double>(k) * test.dt_s; });
  json["floor_acceleration_mps2"] = thinned(
      [&](std::size_t k) { return horizontal_acceleration(test.shaking(), static_cast<double>(k) * test.dt_s); });
  for (int c = 0; c < channel_count; ++c) {
    const auto channel = static_cast<Channel>(c);
    const auto& measured = history(test, channel);
    if (measured.empty()) continue;
    const auto& model = t.model.channel(channel);
    const auto& spread = t.spread[static_cast<std::size_t>(c)];
    Json band = nullptr;
    if (!bands.empty()) {
      const Band& b = bands[static_cast<std::size_t>(c)];
      band = {{"lower", each(b.lower)}, {"mean", each(b.mean)}, {"upper", each(b.upper)}};
    }
    json[name(channel)] = {{"noise", bench.noise(channel)},
                           {"measured", each(measured)},
                           {"model", each(model)},
                           {"residual", thinned([&](std::size_t k) { return model[k] - measured[k]; })},
                           {"spread", thinned([&](std::size_t k) { return std::sqrt(spread[k]); })},
                           {"band", std::move(band)}};
  }
  return json;
}

Json tables_json(const std::vector<ErrorTable>& tables) {
  Json list = Json::array();
  for (const ErrorTable& t : tables)
    list.push_back({{"variable", t.variable},
                    {"unit", t.unit},
                    {"label", t.label},
                    {"edge", numbers_or_null(t.edge)},
                    {"centre", numbers_or_null(t.centre)},
                    {"count", numbers_or_null(t.count)},
                    {"error_noise_units", numbers_or_null(t.noise_units)},
                    {"growth_noise_units", numbers_or_null(t.growth)},
                    {"growth_slip_m", numbers_or_null(t.slip_growth_m)},
                    {"growth_rotation_rad", numbers_or_null(t.rotation_growth_rad)},
                    {"bias_noise_units", numbers_or_null(t.bias)}});
  return list;
}

// of_mean: error_of_mean of each of the tests.
Json role_json(const Bench& bench, const std::vector<TestComparison>& tests, const std::vector<double>& of_mean,
               Role role) {
  const RoleError e = role_error(bench, tests, role);
  if (e.tests == 0) return nullptr;
  double square = 0;
  for (std::size_t i = 0; i < tests.size(); ++i)
    if (bench.test(tests[i].test).role == role) square += of_mean[i] * of_mean[i] / static_cast<double>(e.tests);
  return {{"error_noise_units", number_or_null(e.noise_units)},
          {"error_relative", number_or_null(e.relative)},
          {"error", number_or_null(e.error)},
          {"error_expected", number_or_null(e.expected)},
          {"error_floor_noise_allowed", number_or_null(e.explained)},
          {"error_of_mean", number_or_null(std::sqrt(square))},
          {"tests", e.tests}};
}

Json parameters_json(const ModelFit& fit, const Posterior& open, bool calibrated) {
  Json list = Json::array();
  for (std::size_t i = 0; i < fit.x.size(); ++i) {
    const Free& free = fit.model.free[i];
    list.push_back({{"name", free.name},
                    {"unit", free.unit},
                    {"value", fit.x[i]},
                    {"lower", free.lower},
                    {"upper", free.upper},
                    {"calibrated", calibrated}});
    add_interval(list.back(), fit, i);
    list.back()["interval_90"] = nullptr;
    if (!open.of_mean.empty()) {
      const auto [lower, upper] = measurement::interval_of(open, fit, i, 0.9);
      list.back()["interval_90"] = {lower, upper};
    }
  }
  return list;
}

// Of numbers that were given, where draws fit better than they do.
std::string better_numbers(const ModelFit& fit, const Values& better) {
  std::string each;
  for (std::size_t i = 0; i < better.size(); ++i)
    each += fmt::format("{}{} = {:.4g} in place of {:.4g}", i ? ", " : "", fit.model.free[i].name, better[i], fit.x[i]);
  return "other numbers than those that are given fit the tests better, beyond chance: " + each;
}

Json posterior_json(const Posterior& open) {
  if (open.draws.empty() && open.slip_scatter_ln == 0) return nullptr;
  return {{"table", open.draws.empty() ? Json(nullptr) : Json(posterior_table)},
          {"draws", open.draws.size()},
          {"dispersion", open.dispersion},
          {"degrees_of_freedom", open.freedom},
          {"friction_scatter", open.friction_scatter},
          {"slip_bias_ln", open.slip_bias_ln},
          {"slip_scatter_ln", open.slip_scatter_ln},
          {"share_counted", open.counted}};
}

std::string unread_floors(const Bench& bench, const std::vector<TestComparison>& tests) {
  std::vector<UnreadFloor> floors;
  for (const TestComparison& t : tests)
    if (bench.test(t.test).has_history()) floors.push_back({&bench.test(t.test), t.unread, t.expected});
  return told_of_unread(floors);
}

}  // namespace

Compared compare(const parallel::Communicator& world, const ValidationRun& run, const std::filesystem::path& folder) {
  const auto p = prepare(world, run, 16);
  const Bench& bench = *p->bench;
  const Jobs jobs = spread_jobs(world, run.quiet);
  ModelFit fit = fitted(*p, false, jobs);
  const bool calibrated = fit.left_out_refitted || fit.evaluations > 0;
  const Posterior open = open_numbers(bench, fit, jobs);
  Effort effort;
  const Quality quality = examine(bench, fit, effort, jobs);
  Comparison c =
      measurement::compare(bench, fit.model, fit.x, compare_tests(bench, fit, open, jobs), quality, fit.misfit);
  for (std::string& finding : measurement::undetermined(fit)) c.findings.push_back(std::move(finding));

  if (open.friction_scatter > 0 && !draws_friction(fit.model, open))
    c.findings.push_back(
        fmt::format("friction differs by {:.2g} % from test to test, and the study gives it as a number: bands and "
                    "sweeps hold none of that until "
                    "it is fitted with the others (mu: {{calibrate: [0.05, 1]}})",
                    100 * open.friction_scatter));
  if (!open.stated_otherwise.empty())
    c.findings.push_back(fmt::format(
        "the tests are fitted best as if {}: measure that again, or let diagnose look for an effect that does as much; "
        "intervals, draws and bands allow for it",
        open.stated_otherwise));
  if (open.leaves_too_much && !open.draws.empty())
    c.findings.push_back(
        "by the readings that the floor's noise does not turn elsewhere the model leaves more of the tests than noise "
        "does: its intervals and draws do not tell by how much its "
        "numbers "
        "are off, nor do sweeps that take them (fitted.yaml): let diagnose look for what it lacks first");
  else if (open.tests_disagree)
    c.findings.push_back(
        fmt::format("the tests disagree about the numbers by {:.2g} times what noise explains: intervals and draws are "
                    "wider by as much; see the worst "
                    "test first",
                    open.dispersion));
  if (const std::string unread = unread_floors(bench, c.tests); !unread.empty()) c.findings.push_back(unread);
  if (const std::string level = level_tests(*p); !level.empty()) c.findings.push_back(level);
  if (fit.evaluations == 0 && !open.better.empty()) c.findings.push_back(better_numbers(fit, open.better));

  std::vector<std::string> effects;
  for (const EffectTerm& term : fit.model.effects) effects.push_back(term.effect->name);
  const std::vector<Bands> bands = predicted_bands(bench, fit.model, open, jobs);
  std::vector<double> of_mean;
  for (const TestComparison& t : c.tests) of_mean.push_back(error_of_mean(bench, t.test, bands[t.test]).noise_units);
  const PeakRatio ratio = peak_ratio(bench, c.tests);
  Json json = {{"format", "freestand-comparison/2"},
               {"study", run.study},
               {"measurements", p->measurements},
               {"name", p->data.name},
               {"effects", effects},
               {"error_unit", error_unit(bench)},
               {"method", calibration_method(bench)},
               {"findings", c.findings},
               {"calibration", role_json(bench, c.tests, of_mean, Role::calibration)},
               {"holdout", role_json(bench, c.tests, of_mean, Role::holdout)},
               {"parameters", parameters_json(fit, open, calibrated)},
               {"posterior", posterior_json(open)},
               {"peak_ratio",
                {{"count", ratio.count},
                 {"ratio", number_or_null(std::exp(ratio.bias_ln))},
                 {"bias_ln", number_or_null(ratio.bias_ln)},
                 {"scatter_ln", number_or_null(ratio.scatter_ln)},
                 {"within_ln", number_or_null(ratio.within_ln)},
                 {"biased", ratio.biased()}}}};
  json["tests"] = Json::array();
  for (std::size_t i = 0; i < c.tests.size(); ++i) {
    const TestComparison& t = c.tests[i];
    json["tests"].push_back(test_json(bench, t));
    json["tests"].back()["error_of_mean"] = number_or_null(of_mean[i]);
    json["tests"].back()["within_band"] = number_or_null(share_within(bench, bench.test(t.test), bands[t.test]));
  }
  json["histories"] = Json::array();
  for (const std::size_t i : c.worst)
    json["histories"].push_back(history_json(bench, c.tests[i], bands[c.tests[i].test]));
  json["error_tables"] = {{"calibration", tables_json(c.calibration)}, {"holdout", tables_json(c.holdout)}};
  json["ladder"] = ladder_json(p->validation.ladder);
  add_provenance(json, world, run);
  std::string draws = posterior_text(fit.model, open, quality.spoilt(), known_middle(*p));
  return {std::move(json), fitted_study(*p, fit, open, folder), std::move(draws)};
}

}  // namespace freestand::study
