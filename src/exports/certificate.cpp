#include "exports/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "exports/select.hpp"

namespace freestand::exports {
namespace {

using Json = nlohmann::ordered_json;

struct Largest {
  double difference = 0, at = unknown;
};

// Intensities at which a file is checked: equally spaced, the last of them the highest that was swept.
std::vector<double> intensities(const Model& model) {
  const double low = std::min(0.0, model.im_least);
  std::vector<double> values;
  for (int i = 1; i <= checked_intensities; ++i)
    values.push_back(i == checked_intensities ? model.im_most : low + (model.im_most - low) * i / checked_intensities);
  return values;
}

// Where the sweep ends: above it a lognormal is an extrapolation, and of other curves nothing is known.
double beyond_sweep_from(const Model& model, const Curve& curve) {
  if (curve.form == Form::discrete) return curve.points.back().im;
  if (curve.form == Form::parts) return curve.parts.back().im;
  return model.im_most;
}

Json state_json(const Model& model, const LimitState& state, const Largest& largest) {
  return {{"name", state.name},
          {"demand", state.demand},
          {"capacity", state.capacity},
          {"unit", state.unit},
          {"form", name(state.curve.form)},
          {"why", state.why},
          {"median", state.fitted.median},
          {"median_se", state.fitted.median_se},
          {"dispersion", state.fitted.dispersion},
          {"dispersion_se", state.fitted.dispersion_se},
          {"lognormal_off_by", state.fitted.off_by},
          {"lognormal_adequate", state.fitted.adequate},
          {"lognormal_not_refuted", state.fitted.not_refuted},
          {"lognormal_rates_differ", state.fitted.rates_differ},
          {"largest_difference", largest.difference},
          {"at", largest.at},
          {"beyond_sweep_from", beyond_sweep_from(model, state.curve)},
          {"largest_difference_from_surface", state.off_surface},
          {"surface_at", state.off_surface_at},
          {"largest_difference_between_points", state.off_lines},
          {"annual_rate_by_lines_at_slopes_1_2_3", state.rate_by_lines},
          {"pooled_by", state.pooled}};
}

}  // namespace

namespace {

Certified certified(const Model& model, const Format& format, const std::filesystem::path& file, const ReadBack& back) {
  Certified found;
  Json states = Json::array();
  for (std::size_t s = 0; s < model.states.size(); ++s) {
    const LimitState& state = model.states[s];
    if (!back.states.empty() && (s >= back.states.size() || back.states[s] != state.name))
      throw Error(fmt::format("{} lacks the limit state {} (it is not where it was written): export again",
                              file.string(), state.name),
                  Exit::data);
    Largest largest;
    for (const double im : intensities(model)) {
      const double difference = std::fabs(back.probability(s, im) - probability(state.curve, im));
      // A difference that is no number is as large as can be.
      if (!(difference < largest.difference) || std::isnan(largest.at))
        largest = {std::isnan(difference) ? 1 : difference, im};
    }
    found.difference = std::max(found.difference, largest.difference);
    states.push_back(state_json(model, state, largest));
  }
  found.allowed = wanted_difference + back.rounds_by;
  found.json = {{"target", format.name},
                {"id", model.id},
                {"holds", !(found.difference > found.allowed)},
                {"largest_difference", found.difference},
                {"allowed", found.allowed},
                {"wanted_below", wanted_difference},
                {"rounding", back.rounding.empty() ? "none" : back.rounding},
                {"rounding_at_most", back.rounds_by},
                {"intensities", checked_intensities},
                {"im", model.im.name},
                {"im_unit", model.im.unit},
                {"unit_in_file", back.unit},
                {"bands_in_file", format.bands},
                {"im_from", intensities(model).front()},
                {"im_to", intensities(model).back()},
                {"limit_states", states},
                {"notes", model.notes}};
  return found;
}

}  // namespace

Certified certify(const Model& model, const Format& format, const std::filesystem::path& file) {
  return certified(model, format, file, check_of(format.name).open(file, model.im));
}

Certified certify(const Collection& all, const Format& format, const std::filesystem::path& file) {
  Certified whole;
  Json functions;
  std::string rounding = "none";
  double rounds_by = 0;
  bool faulty = false;
  for (const Model& model : all.models) {
    const Certified one = certified(model, format, file, check_of(format.name).open_one(file, model.im, model.id));
    functions[model.id] = one.json;
    faulty = faulty || one.difference > one.allowed;
    whole.difference = std::max(whole.difference, one.difference);
    if (one.json["rounding"] != "none") rounding = one.json["rounding"];
    rounds_by = std::max(rounds_by, one.allowed - wanted_difference);
  }
  whole.allowed = faulty ? 0 : wanted_difference + rounds_by;  // one that is off by more than its own is off
  whole.json = {{"target", format.name},
                {"id", all.id},
                {"holds", !(whole.difference > whole.allowed)},
                {"largest_difference", whole.difference},
                {"allowed", whole.allowed},
                {"wanted_below", wanted_difference},
                {"rounding", rounding},
                {"rounding_at_most", rounds_by},
                {"im", all.models.front().im.name},
                {"im_unit", all.models.front().im.unit},
                {"bands_in_file", format.bands},
                {"functions", functions}};
  return whole;
}

}  // namespace freestand::exports
