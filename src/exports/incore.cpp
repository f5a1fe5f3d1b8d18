// A fragility set for IN-CORE: one JSON document. Its curves are rules of Python text, gone through in order: the first
// one whose conditions hold gives the result, and one without a condition is the last word. So a curve is
// "PGA > 0" -> formula, else 0. What numpy and scipy can say goes in: the lognormal as norm.cdf, levels as numpy.interp,
// and the three parts of each bin with each part interpolated.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

#include "exports/exporter.hpp"
#include "exports/ground.hpp"

namespace freestand::exports::incore {
namespace {

using Json = nlohmann::ordered_json;

// IN-CORE's name of an intensity, the variable in formulas, its unit, and how much one of freestand's unit is in that.
struct Demand {
  std::string type, variable, unit;
  double factor;
};

Demand demand_of(const Intensity& im) {
  const std::string name = ground_name(im);
  if (name == "pga_g" || name == "pta_g") return {"PGA", "PGA", "g", 1};
  if (name == "pgv_mps") return {"PGV", "PGV", "cm/s", 100};
  if (name == "pgd_m") return {"PGD", "PGD", "m", 1};
  if (name == "sa_g") return {fmt::format("{:#} SA", im.period_s), "SA", "g", 1};
  throw Error(
      fmt::format("IN-CORE has no demand for the intensity {} (it knows PGA, PGV, PGD and SA of the ground): {}",
                  im.name, fit_over_the_ground));
}

// How many limit states IN-CORE turns into damage states, by the kind of thing in its inventory.
struct Inventory {
  const char* name;
  std::size_t states;
};
constexpr Inventory inventories[] = {{"building", 3},     {"bridge", 4}, {"electric_facility", 4},
                                     {"gas_facility", 4}, {"road", 4},   {"water_facility", 4},
                                     {"pipeline", 4}};

// "--limit-state wall_hit --limit-state wall_hit=again_2 ...": as many as are wanted, out of those there are; the last of them, the most
// severe, is always one.
std::string asked_for(const Model& model, std::size_t wanted) {
  std::string text;
  for (std::size_t i = 0; i < wanted; ++i) {
    const LimitState& state =
        model.states[i + 1 == wanted ? model.states.size() - 1 : std::min(i, model.states.size() - 1)];
    const std::string demand =
        std::isnan(state.capacity) ? state.demand : fmt::format("{}:{}", state.demand, state.capacity);
    text += fmt::format("{}--limit-state {}{}", i ? " " : "", demand,
                        i < model.states.size() ? "" : fmt::format("=again_{}", i + 1));
  }
  return text;
}

void refuse(const Model& model) {
  demand_of(model.im);
  std::vector<std::string> known;
  for (const Inventory& inventory : inventories) {
    known.push_back(fmt::format("{} {}", inventory.name, inventory.states));
    if (model.asset_category != inventory.name) continue;
    if (model.states.size() == inventory.states) return;
    throw Error(fmt::format(
        "IN-CORE takes exactly {} limit states for {} {}, and these are {} (it has no way from {} to damage states): "
        "choose {} ({}), or name another --asset-category",
        inventory.states, std::string_view("aeiou").find(*inventory.name) == std::string_view::npos ? "a" : "an",
        inventory.name, model.states.size(), model.states.size(),
        model.states.size() > inventory.states ? fmt::format("{} of them, the most severe among them", inventory.states)
                                               : std::string("them, where the last may stand again under other names"),
        asked_for(model, inventory.states)));
  }
  throw Error(
      fmt::format("IN-CORE has no inventory {} (it knows, with their numbers of limit states: {}): name one with "
                  "--asset-category",
                  model.asset_category, fmt::join(known, ", ")));
}

template <class Points, class Get>
std::string interpolated(const Points& points, const Demand& demand, Get get) {
  std::vector<double> x, y;
  for (const auto& point : points) {
    x.push_back(point.im * demand.factor);
    y.push_back(get(point));
  }
  return fmt::format("numpy.interp({}, [{}], [{}])", demand.variable, fmt::join(x, ", "), fmt::join(y, ", "));
}

std::string formula(const Curve& curve, const Demand& demand) {
  if (curve.form == Form::lognormal)
    return fmt::format("scipy.stats.norm.cdf((math.log({}) - ({})) / ({}))", demand.variable,
                       std::log(curve.median * demand.factor), curve.dispersion);
  if (curve.form == Form::discrete)
    return interpolated(curve.points, demand, [](const Point& p) { return p.probability; });
  const auto part = [&](double PartsPoint::*member) {
    return interpolated(curve.parts, demand, [member](const PartsPoint& p) { return p.*member; });
  };
  const std::string over = part(&PartsPoint::p_over);
  return fmt::format("{} + (1 - {}) * (1 - {}) * scipy.stats.norm.cdf(({} - ({})) / {})", over, over,
                     part(&PartsPoint::p_never), part(&PartsPoint::lambda), curve.ln_capacity,
                     part(&PartsPoint::omega));
}

Json curve_json(const LimitState& state, const Demand& demand, std::size_t index) {
  const Json guarded{{"condition", {fmt::format("{} > 0", demand.variable)}},
                     {"expression", formula(state.curve, demand)}};
  const Json otherwise{{"condition", nullptr}, {"expression", "0"}};
  return {{"description", state.name},
          {"returnType", {{"type", "Limit State"}, {"unit", ""}, {"description", fmt::format("LS_{}", index)}}},
          {"rules", {guarded, otherwise}}};
}

std::vector<File> write(const Model& model, const std::string& name) {
  const Demand demand = demand_of(model.im);
  Json curves = Json::array();
  for (std::size_t s = 0; s < model.states.size(); ++s) curves.push_back(curve_json(model.states[s], demand, s));
  const Json parameter{{"name", demand.variable},
                       {"unit", demand.unit},
                       {"description", demand.type},
                       {"fullName", demand.type},
                       {"expression", nullptr}};
  const Json set{{"description", model.description},
                 {"authors", Json::array({"freestand"})},
                 {"paperReference", nullptr},
                 {"resultType", "Limit State"},
                 {"resultUnit", nullptr},
                 {"hazardType", "earthquake"},
                 {"inventoryType", model.asset_category},
                 {"demandTypes", {demand.type}},
                 {"demandUnits", {demand.unit}},
                 {"curveParameters", Json::array({parameter})},
                 {"fragilityCurves", curves}};
  return {{name, set.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"}};
}

const Register here{
    {.name = "incore",
     .summary = "a fragility set for IN-CORE: lognormals, levels, or the three parts as they are",
     .file = "fragility.json",
     .forms = {Form::lognormal, Form::parts, Form::discrete},
     .fixed_number = true,
     .notes_on = [](const Model& model) -> std::vector<std::string> { return {of_the_ground(model.im, "IN-CORE")}; },
     .usual_category = "building",
     .refuse = refuse,
     .write = write}};

}  // namespace
}  // namespace freestand::exports::incore
