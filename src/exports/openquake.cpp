// Fragility for OpenQuake: NRML 0.5, element fragilityModel.
//
// Continuous: OpenQuake takes mean and standard deviation of the lognormal, mean = m exp(b^2/2), stddev = mean sqrt(exp(b^2)
// - 1), m the median, b the dispersion. It moves intensities into [minIML, maxIML] and then sets those at or below
// noDamageLimit to 0; with noDamageLimit = minIML an intensity below both is 0, and above maxIML the probability stays.
// Discrete: straight lines between levels, from 0 at noDamageLimit to the first one, and constant above the last.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "exports/exporter.hpp"
#include "exports/openquake_names.hpp"

namespace freestand::exports::openquake {
namespace {

// OpenQuake replaces a limit of 0 by this one, as it takes logarithms of levels.
constexpr double least_level = 1e-10;

// All curves are below 1e-9 here, so that cutting them off there is not seen.
double lowest(const Model& model) {
  double low = model.im_least;
  for (const LimitState& state : model.states)
    low = std::min(low, state.curve.median * std::exp(-6 * state.curve.dispersion));
  return low;
}

std::string continuous(const Model& model, const openquake::Imt& imt) {
  const double low = lowest(model) * imt.factor, high = model.im_most * imt.factor;
  std::string text = fmt::format("      <imls imt=\"{}\" noDamageLimit=\"{}\" minIML=\"{}\" maxIML=\"{}\"/>\n",
                                 imt.name, low, low, high);
  for (const LimitState& state : model.states) {
    const double median = state.curve.median * imt.factor, square = state.curve.dispersion * state.curve.dispersion;
    const double mean = median * std::exp(square / 2), deviation = mean * std::sqrt(std::expm1(square));
    text += fmt::format("      <params ls=\"{}\" mean=\"{}\" stddev=\"{}\"/>\n", state.name, mean, deviation);
  }
  return text;
}

std::string discrete(const Model& model, const openquake::Imt& imt) {
  const std::vector<double> nodes = openquake::levels(model.states, model.im_most);
  std::vector<double> scaled;
  for (const double im : nodes) scaled.push_back(im * imt.factor);
  std::string text = fmt::format("      <imls imt=\"{}\" noDamageLimit=\"{}\">{}</imls>\n", imt.name, least_level,
                                 openquake::numbers(scaled));
  for (const LimitState& state : model.states) {
    std::vector<double> values;
    for (const double im : nodes) values.push_back(probability(state.curve, im));
    text += fmt::format("      <poes ls=\"{}\">{}</poes>\n", state.name, openquake::numbers(values));
  }
  return text;
}

std::string function_of(const Model& model) {
  const openquake::Imt imt = openquake::imt_of(model.im);
  const bool lognormal = model.states.front().curve.form == Form::lognormal;
  return fmt::format("    <fragilityFunction id=\"{}\" format=\"{}\"{}>\n{}    </fragilityFunction>\n", model.id,
                     lognormal ? "continuous" : "discrete", lognormal ? " shape=\"logncdf\"" : "",
                     lognormal ? continuous(model, imt) : discrete(model, imt));
}

// One list of limit states stands for all functions of a model.
std::vector<std::string> states_of(const Collection& all) {
  std::vector<std::string> names;
  for (const LimitState& state : all.models.front().states) names.push_back(state.name);
  for (const Model& model : all.models) {
    std::vector<std::string> own;
    for (const LimitState& state : model.states) own.push_back(state.name);
    if (own != names)
      throw Error(fmt::format(
          "{} has the limit states {} and {} has {} (all functions of an OpenQuake model have the same): name "
          "those that all entries have with --limit-state, or add --each for a file of each",
          all.models.front().id, fmt::join(names, ", "), model.id, fmt::join(own, ", ")));
  }
  return names;
}

std::vector<File> write_all(const Collection& all, const std::string& name) {
  const Model& first = all.models.front();
  std::string body = fmt::format("    <description>{}</description>\n    <limitStates>{}</limitStates>\n",
                                 openquake::escaped(all.description), fmt::join(states_of(all), " "));
  for (const Model& model : all.models) body += function_of(model);
  return {
      {name, openquake::document(fmt::format(
                 "  <fragilityModel id=\"{}\" assetCategory=\"{}\" lossCategory=\"{}\">\n{}  </fragilityModel>\n",
                 all.id, openquake::escaped(first.asset_category), openquake::escaped(first.loss_category), body))}};
}

std::vector<File> write(const Model& model, const std::string& name) {
  return write_all({model.id, model.description, {model}}, name);
}

const Register here{
    {.name = "openquake",
     .summary = "fragility for OpenQuake, NRML 0.5: lognormal or by levels",
     .file = "fragility.xml",
     .forms = {Form::lognormal, Form::discrete},
     .one_list_of_states = true,
     .notes_on = openquake::notes_on,
     .usual_category = "buildings",
     .refuse = [](const Model& model) { openquake::refuse(model), openquake::refuse_loss_category(model, false); },
     .write = write,
     .write_all = write_all}};

}  // namespace
}  // namespace freestand::exports::openquake
