// Evaluates the rules of an IN-CORE fragility set, as IN-CORE does: ^ is a power, rules are gone through in order, the
// result is rounded to ten digits.
#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/durable_file.hpp"
#include "exports/exporter.hpp"

namespace freestand::exports::check_incore {
namespace {

using Json = nlohmann::json;

[[noreturn]] void broken(const std::filesystem::path& file, const std::string& rule) {
  throw Error(fmt::format("{} is not what IN-CORE reads ({}): export again, and tell the makers of freestand",
                          file.string(), rule),
              Exit::data);
}
void require(bool holds, const std::filesystem::path& file, const std::string& rule) {
  if (!holds) broken(file, rule);
}

double normal(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// numpy.interp(at, [x...], [y...]) with its lists laid open.
double interp(const double* values, int count) {
  if (count < 5 || count % 2 == 0) return std::nan("");
  const int n = (count - 1) / 2;
  const double at = values[0], *x = values + 1, *y = x + n;
  if (at <= x[0]) return y[0];
  for (int i = 1; i < n; ++i)
    if (at < x[i]) return y[i - 1] + (y[i] - y[i - 1]) / (x[i] - x[i - 1]) * (at - x[i - 1]);
  return y[n - 1];
}

// One text of a rule, with the intensity as its one variable.
class Formula {
 public:
  Formula(std::string text, const std::string& variable)
      : level_(std::make_unique<double>()), parser_(std::make_unique<mu::Parser>()) {
    std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
    parser_->DefineNameChars("0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    parser_->DefineFun("math.log", static_cast<double (*)(double)>(std::log));
    parser_->DefineFun("scipy.stats.norm.cdf", normal);
    parser_->DefineFun("numpy.interp", interp);
    parser_->DefineVar(variable, level_.get());
    parser_->SetExpr(text);
    (*this)(1);  // tells at once what cannot be evaluated
  }
  double operator()(double level) const {
    *level_ = level;
    return parser_->Eval();
  }

 private:
  std::unique_ptr<double> level_;
  std::unique_ptr<mu::Parser> parser_;
};

struct Rule {
  std::vector<Formula> conditions;
  Formula expression;
};

double of_rules(const std::vector<Rule>& rules, double level) {
  double result = 0;
  for (const Rule& rule : rules) {
    if (rule.conditions.empty()) {  // gives a result, but does not end the search
      result = rule.expression(level);
      continue;
    }
    const bool met = std::all_of(rule.conditions.begin(), rule.conditions.end(),
                                 [&](const Formula& condition) { return condition(level) != 0; });
    result = met ? rule.expression(level) : 0;
    if (met) break;
  }
  return std::round(result * 1e10) / 1e10;
}

// What one unit of the document's is in SI (or g).
double unit_of(const std::string& type, const std::string& unit, const Intensity& im,
               const std::filesystem::path& file) {
  if (type == "PGA" && unit == "g" && im.unit == "g") return 1;
  if (type == "PGV" && unit == "cm/s" && im.unit == "m/s") return 0.01;
  if (type == "PGD" && unit == "m" && im.unit == "m") return 1;
  if (type.ends_with(" SA") && unit == "g" && im.unit == "g" && std::stod(type) == im.period_s) return 1;
  broken(file, type + " in " + unit + " is the demand that was fitted");
}

std::vector<Rule> rules_of(const Json& curve, const std::string& variable) {
  std::vector<Rule> rules;
  for (const Json& rule : curve.at("rules")) {
    Rule one{{}, Formula(rule.at("expression").get<std::string>(), variable)};
    if (rule.contains("condition") && !rule["condition"].is_null())
      for (const Json& condition : rule["condition"])
        one.conditions.emplace_back(condition.get<std::string>(), variable);
    rules.push_back(std::move(one));
  }
  return rules;
}

ReadBack read(const std::filesystem::path& file, const Intensity& im) {
  const Json set = Json::parse(read_whole(file));
  for (const char* key : {"demandTypes", "demandUnits", "resultType", "hazardType", "inventoryType", "curveParameters"})
    require(set.contains(key), file, std::string("it has ") + key);
  require(set["resultType"] == "Limit State" && set["hazardType"] == "earthquake", file,
          "limit states of an earthquake");
  const std::string type = set["demandTypes"].at(0), unit = set["demandUnits"].at(0);
  const double in_si = unit_of(type, unit, im, file);
  const Json& parameter = set["curveParameters"].at(0);
  const std::string variable = parameter.at("name");
  require(parameter.at("fullName") == type && parameter.at("unit") == unit, file, "its parameter is its demand");
  const std::size_t wanted = set["inventoryType"] == "building" ? 3 : 4;
  require(set.at("fragilityCurves").size() == wanted, file, fmt::format("this inventory has {} curves", wanted));
  auto curves = std::make_shared<std::vector<std::vector<Rule>>>();
  ReadBack back{{}, {}, unit, "IN-CORE rounds probabilities to ten digits", 5e-11};
  for (const Json& curve : set["fragilityCurves"]) {
    require(curve.at("returnType").at("type") == "Limit State", file, "a curve returns a limit state");
    back.states.push_back(curve.at("description"));
    curves->push_back(rules_of(curve, variable));
  }
  back.probability = [curves, in_si](std::size_t s, double value) { return of_rules((*curves)[s], value / in_si); };
  return back;
}

ReadBack open(const std::filesystem::path& file, const Intensity& im) {
  try {
    return read(file, im);
  } catch (const Json::exception& error) {
    broken(file, error.what());
  } catch (const mu::ParserError& error) {
    broken(file, error.GetMsg());
  }
}

const RegisterCheck here{{.name = "incore", .open = open}};

}  // namespace
}  // namespace freestand::exports::check_incore
