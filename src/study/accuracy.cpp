#include "study/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/random.hpp"
#include "base/units.hpp"
#include "edp/edp.hpp"
#include "fragility/intervals.hpp"

namespace freestand::study {
namespace {

constexpr double confidence = 0.95;
constexpr double error_to_warn_of = 0.01, flips_to_warn_of = 0.01;

// The sample of each stretch.
std::uint64_t pick(std::uint64_t seed, std::int64_t stretch, std::int64_t stretches, std::int64_t samples) {
  const std::int64_t first = stretch * samples / stretches, end = (stretch + 1) * samples / stretches;
  const double u = random::uniform(seed, static_cast<std::uint64_t>(stretch), random::stable_hash("accuracy"));
  return static_cast<std::uint64_t>(first + static_cast<std::int64_t>(u * static_cast<double>(end - first)));
}

// The rows of this rank's samples, plain and tight, as words.
parallel::Words rows_of(const parallel::Communicator& world, const Study& study, const Evaluator& plain,
                        std::int64_t stretches, std::int64_t samples) {
  Study strict = study;
  strict.tolerance = tighter(study.tolerance);
  const Evaluator tight(strict, plain.motions(), plain.summaries());
  std::vector<double> values;
  for (std::int64_t i = world.rank(); i < stretches; i += world.size()) {
    const std::uint64_t sample = pick(study.seed, i, stretches, samples);
    plain.append(sample, values);
    tight.append_alone(sample, values);
  }
  parallel::Words words(values.size());
  std::transform(values.begin(), values.end(), words.begin(), [](double x) { return std::bit_cast<std::int64_t>(x); });
  return words;
}

double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::min(sorted.size() - 1, rank > 0 ? rank - 1 : 0)];
}

struct Pair {
  const double* plain;
  const double* tight;
};

DemandError demand_error(const edp::Edp& edp, const std::vector<Pair>& pairs, std::size_t column) {
  std::vector<double> errors, demands;
  for (const auto& [plain, tight] : pairs) {
    if (!std::isfinite(plain[column]) || !std::isfinite(tight[column])) continue;
    errors.push_back(std::abs(plain[column] - tight[column]));
    if (std::abs(tight[column]) > edp.still) demands.push_back(std::abs(tight[column]));
  }
  std::sort(errors.begin(), errors.end());
  std::sort(demands.begin(), demands.end());
  return {edp.name,
          edp.unit,
          errors.size(),
          quantile(errors, 0.5),
          quantile(errors, 0.95),
          quantile(errors, 1),
          quantile(demands, 0.5)};
}

}  // namespace

double tighter(double tolerance) { return std::max(0.01 * tolerance, tightest_tolerance); }

Accuracy check_accuracy(const parallel::Communicator& world, const Study& study, const Evaluator& evaluator,
                        std::int64_t samples) {
  const std::int64_t stretches = std::min(samples, checked_samples);
  const std::size_t width = evaluator.columns().size();
  const std::vector<parallel::Words> of_ranks = world.gather(rows_of(world, study, evaluator, stretches, samples));
  if (!world.is_root()) return {};

  Accuracy accuracy{.tolerance = study.tolerance, .tighter_tolerance = tighter(study.tolerance), .checked = stretches};
  std::vector<std::vector<double>> rows;
  for (const auto& words : of_ranks) {
    rows.emplace_back(words.size());
    std::transform(words.begin(), words.end(), rows.back().begin(), [](auto x) { return std::bit_cast<double>(x); });
  }
  const std::size_t outcome = column_index(evaluator.columns(), "outcome");
  std::vector<Pair> alike;
  for (const auto& values : rows)
    for (std::size_t i = 0; i < values.size(); i += 2 * width) {
      const Pair pair{values.data() + i, values.data() + i + width};
      if (pair.plain[outcome] == pair.tight[outcome])
        alike.push_back(pair);
      else
        ++accuracy.flips;
    }
  accuracy.flip_share_upper = fragility::clopper_pearson(accuracy.flips, stretches, confidence).upper;
  for (const edp::Edp& edp : edp::all())
    if (!edp.binary)
      accuracy.demands.push_back(demand_error(edp, alike, column_index(evaluator.columns(), "edp_" + edp.name)));
  return accuracy;
}

nlohmann::ordered_json accuracy_json(const Accuracy& accuracy) {
  nlohmann::ordered_json json = {{"tolerance", accuracy.tolerance},
                                 {"tighter_tolerance", accuracy.tighter_tolerance},
                                 {"samples_checked", accuracy.checked},
                                 {"outcome_flips", accuracy.flips},
                                 {"flip_share", static_cast<double>(accuracy.flips) /
                                                    static_cast<double>(std::max<std::int64_t>(accuracy.checked, 1))},
                                 {"flip_share_upper", accuracy.flip_share_upper},
                                 {"edps", nlohmann::ordered_json::object()}};
  for (const auto& d : accuracy.demands)
    if (d.samples > 0)  // else nothing was told of it: everything fell, or the study does not follow it
      json["edps"][d.name] = {{"unit", d.unit},
                              {"median_error", d.median},
                              {"p95_error", d.p95},
                              {"largest_error", d.largest},
                              {"median_demand", d.median_demand}};
  return json;
}

nlohmann::ordered_json accuracy_json(double tolerance, const Response& a, const Response& b) {
  return {{"tolerance", tolerance},
          {"tighter_tolerance", tighter(tolerance)},
          {"outcome_flips", a.outcome != b.outcome},
          {"errors",
           {{"peak_slip_m", std::abs(a.peak_slip_m - b.peak_slip_m)},
            {"residual_slip_m", std::abs(a.residual_slip_m - b.residual_slip_m)},
            {"slid_path_m", std::abs(a.slid_path_m - b.slid_path_m)},
            {"peak_rotation_rad", std::abs(a.peak_rotation_rad - b.peak_rotation_rad)},
            {"peak_acceleration_g",
             std::abs(a.peak_acceleration_mps2 - b.peak_acceleration_mps2) / standard_gravity_mps2}}}};
}

std::vector<std::string> accuracy_warnings(const nlohmann::ordered_json& accuracy) {
  std::vector<std::string> warnings;
  if (!accuracy.contains("edps")) return warnings;
  for (const auto& [name, edp] : accuracy["edps"].items()) {
    const double error = edp["p95_error"], scale = edp["median_demand"];
    if (error > error_to_warn_of * scale)
      warnings.push_back(
          fmt::format("{}: one sample in twenty changes by more than {:.2g}{} under a tighter tolerance "
                      "(the median demand is {:.2g}): lower `tolerance`, or take the sample as chaotic",
                      name, error, edp["unit"] == "1" ? "" : " " + edp["unit"].get<std::string>(), scale));
  }
  const double share = accuracy["flip_share"];
  if (share > flips_to_warn_of)
    warnings.push_back(
        fmt::format("{:.1f} % of the samples checked end differently under a tighter tolerance: near "
                    "overturning the response is chaotic, and only its distribution means something",
                    100 * share));
  return warnings;
}

}  // namespace freestand::study
