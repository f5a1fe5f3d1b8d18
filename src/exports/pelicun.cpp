// A component for pelicun and its damage and loss library: fragility.csv and fragility.json, as that library holds them.
//
// Offset 0 and directional 1: the demand is that of the floor on which the component stands, in its direction. A lognormal
// goes out as one; anything else as multilinear_CDF, "x,x,x|y,y,y", which must rise strictly from exactly 0 to exactly 1.
// pelicun turns the x into its own units and writes all numbers again with six digits (%g); the numbers are written so that
// they are still apart behind that.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <nlohmann/json.hpp>

#include "base/shown_text.hpp"
#include "exports/exporter.hpp"

namespace freestand::exports::pelicun {
namespace {

// pelicun wants 1 at the end, which a sweep need not have reached: a line so long to there that at twice the highest
// intensity swept the probability has grown by 1e-6 of what is missing.
constexpr double far_away = 1e6;

struct Demand {
  std::string type, unit;
};

Demand demand_of(const Intensity& im) {
  if (im.name == "pga_g" || im.name == "pta_g") return {"Peak Floor Acceleration", "g"};
  if (im.name == "pgv_mps") return {"Peak Floor Velocity", "mps"};
  if (im.name == "pgd_m") return {"Peak Floor Displacement", "m"};
  if (im.name == "sa_g") return {fmt::format("Spectral Acceleration|{:#}", im.period_s), "g"};
  if (im.name.starts_with("record.") || im.name.starts_with("ground."))
    throw Error(fmt::format(
        "pelicun has no demand for {} (its demands are those of the floor on which a component stands, not of the "
        "ground under the building): fit the sweep over pga_g, pgv_mps or pgd_m, which are those of the floor's "
        "motion, and export that",
        im.name));
  throw Error(
      fmt::format("pelicun has no demand for the intensity {} (it knows peak floor acceleration, velocity and "
                  "displacement, and spectral acceleration): fit the sweep over pga_g, pgv_mps, pgd_m or sa_g, "
                  "and export that",
                  im.name));
}

void refuse(const Model& model) {
  demand_of(model.im);
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
  };
  if (model.id.empty() || !std::all_of(model.id.begin(), model.id.end(), allowed))
    throw Error(
        fmt::format("pelicun refuses the id {} (letters, digits, _ and . only: it splits names at every -): give "
                    "another one with --id",
                    shown(model.id)));
  for (const LimitState& state : model.states)
    if (state.curve.form != Form::lognormal && !(state.curve.points.back().probability > 0))
      throw Error(
          fmt::format("{} never happened (pelicun's capacities must end at probability 1, and none is known): leave "
                      "it out with --limit-state, or sweep stronger shaking",
                      state.name));
}

double six_digits(double value) { return std::stod(fmt::format("{:.6g}", value)); }

// pelicun takes probabilities that differ by 1e-8 for the same (numpy.isclose); these are further apart.
constexpr double apart = 1e-7;

// The least probability that is told from this one, in six digits.
double above(double p) {
  const double digit = p > 0 ? std::pow(10.0, std::floor(std::log10(p * (1 + 1e-12))) - 5) : 0;
  return six_digits(p + std::max(digit, apart));
}

// Points that rise strictly from 0 to 1 in six digits, through those of the curve. Of a plateau the ends are kept, its
// last one above the first.
std::vector<Point> strictly_rising(const std::vector<Point>& points) {
  const auto value = [&](std::size_t i) {
    const double p = six_digits(points[i].probability);
    return p < apart ? 0 : p;
  };
  std::vector<Point> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    const double p = value(i), least = result.empty() ? 0 : above(result.back().probability);
    if (p >= 1 || least >= 1) {
      result.push_back({points[i].im, 1});
      return result;
    }
    if (!(p > 0)) {
      if (last || value(i + 1) > 0) result.push_back({points[i].im, 0});
    } else if (p >= least) {
      result.push_back({points[i].im, p});
    } else if (last || value(i + 1) >= above(least)) {
      result.push_back({points[i].im, least});
    }
  }
  result.push_back({far_away * points.back().im, 1});
  return result;
}

std::string multilinear(const Curve& curve) {
  std::vector<double> x, y;
  for (const Point& point : strictly_rising(curve.points)) {
    x.push_back(point.im);
    y.push_back(point.probability);
  }
  return fmt::format("\"{}|{}\"", fmt::join(x, ","), fmt::join(y, ","));
}

// One row a component; one with fewer limit states than others leaves the rest of its cells empty.
std::string table(const std::vector<Model>& models) {
  std::size_t most = 0;
  for (const Model& model : models) most = std::max(most, model.states.size());
  std::string text = "ID,Incomplete,Demand-Type,Demand-Unit,Demand-Offset,Demand-Directional";
  for (std::size_t s = 0; s < most; ++s)
    text += fmt::format(",LS{0}-Family,LS{0}-Theta_0,LS{0}-Theta_1,LS{0}-DamageStateWeights", s + 1);
  text += "\n";
  for (const Model& model : models) {
    const Demand demand = demand_of(model.im);
    text += fmt::format("{},0,{},{},0,1", model.id, demand.type, demand.unit);
    for (const LimitState& state : model.states)
      text += state.curve.form == Form::lognormal
                  ? fmt::format(",lognormal,{},{},", state.curve.median, state.curve.dispersion)
                  : fmt::format(",multilinear_CDF,{},,", multilinear(state.curve));
    text += std::string(4 * (most - model.states.size()), ',') + "\n";
  }
  return text;
}

nlohmann::ordered_json words(const Model& model) {
  nlohmann::ordered_json states;
  for (std::size_t s = 0; s < model.states.size(); ++s) {
    const LimitState& state = model.states[s];
    const std::string what = std::isnan(state.capacity) ? state.demand
                                                        : fmt::format("{} above {}{}", state.demand, state.capacity,
                                                                      state.unit == "1" ? "" : " " + state.unit);
    states[fmt::format("LS{}", s + 1)][fmt::format("DS{}", s + 1)] = {
        {"Description", fmt::format("{}: {}", state.name, what)}, {"RepairAction", "n/a"}};
  }
  return {{"Description", model.description},
          {"Comments", fmt::format("{}", fmt::join(model.notes, "\n"))},
          {"SuggestedComponentBlockSize", "1 EA"},
          {"RoundUpToIntegerQuantity", "True"},
          {"LimitStates", states}};
}

std::string words(const Collection& collection) {
  nlohmann::ordered_json all, groups = nlohmann::ordered_json::array();
  for (const Model& model : collection.models) groups.push_back(model.id);
  all["_GeneralInformation"] = {{"ShortName", collection.id},
                                {"Description", collection.description},
                                {"Version", "1"},
                                {"ComponentGroups", groups}};
  for (const Model& model : collection.models) all[model.id] = words(model);
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::vector<std::string> notes_on(const Model& model) {
  std::vector<std::string> notes;
  for (const LimitState& state : model.states) {
    const std::vector<Point>& points = state.curve.points;
    if (state.curve.form != Form::discrete || strictly_rising(points).back().im <= points.back().im) continue;
    notes.push_back(fmt::format(
        "{}: from {:.4g} {} on the curve is beyond the sweep; pelicun wants probability 1 at its end, which "
        "therefore stands at {:.4g} {}, where nothing is known",
        state.name, points.back().im, model.im.unit, far_away * points.back().im, model.im.unit));
  }
  return notes;
}

std::vector<File> write_all(const Collection& all, const std::string& name) {
  return {{name, table(all.models)}, {"fragility.json", words(all)}};
}

std::vector<File> write(const Model& model, const std::string& name) {
  return write_all({model.id, model.description, {model}}, name);
}

const Register here{
    {.name = "pelicun",
     .summary = "a component for pelicun and its damage and loss library: fragility.csv and fragility.json",
     .file = "fragility.csv",
     .folder = true,
     .forms = {Form::lognormal, Form::discrete},
     .notes_on = notes_on,
     .refuse = refuse,
     .write = write,
     .write_all = write_all}};

}  // namespace
}  // namespace freestand::exports::pelicun
