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
          {"largest_difference", largest.difference},
          {"at", largest.at},
          {"beyond_sweep_from", beyond_sweep_from(model, state.curve)},
          {"largest_difference_from_surface", state.off_surface},
          {"surface_at", state.off_surface_at},
          {"pooled_by", state.pooled}};
}

}  // namespace

Certified certify(const Model& model, const Format& format, const std::filesystem::path& file) {
  const ReadBack back = check_of(format.name).open(file, model.im);
  Certified certified;
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
    certified.difference = std::max(certified.difference, largest.difference);
    states.push_back(state_json(model, state, largest));
  }
  certified.allowed = wanted_difference + back.rounds_by;
  certified.json = {{"target", format.name},
                    {"id", model.id},
                    {"largest_difference", certified.difference},
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
  return certified;
}

}  // namespace freestand::exports
