// muParser reads the text and checks it. It evaluates on numbers only, so its operators and functions are replaced by
// ones that write down what they are asked to do: the "numbers" that pass through it are the places of operations in the
// list, and one evaluation yields the list.
#include "formula/formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "base/key_names.hpp"
#include "base/units.hpp"
#include "formula/parse_error.hpp"

namespace freestand::formula {
namespace {

using dynamics::At;
using dynamics::Value;

enum Kind {
  number,
  variable,
  add,
  subtract,
  multiply,
  divide,
  power,
  negate,
  less,
  greater,
  exp_of,
  log_of,
  sqrt_of,
  sin_of,
  cos_of,
  tanh_of,
  abs_of,
  step_of,
  min_of,
  max_of,
  where_of
};

const std::vector<std::string>& variables() {
  static const std::vector<std::string> names = {"u",    "v",     "theta", "omega", "t",  "path", "normal",
                                                 "side", "sigma", "speed", "rest",  "mu", "g",    "pi"};
  return names;
}

Value variable_value(const At& at, int i) {
  const Value inputs[] = {at.u,      at.v,    at.theta, at.omega, at.t,   at.path,
                          at.normal, at.side, at.sigma, at.speed, at.rest};
  if (i < static_cast<int>(std::size(inputs))) return inputs[i];
  const double constants[] = {at.mu, standard_gravity_mps2, pi};
  return at.u.tape->constant(constants[i - static_cast<int>(std::size(inputs))]);
}

std::string without_unit(const std::string& name) { return name.substr(0, name.rfind('_')); }

}  // namespace

struct Recorder {
  explicit Recorder(Formula& to) : formula(to) {}
  Formula& formula;

  static thread_local Recorder* current;
  static double put(Kind kind, std::vector<int> operands, double value = 0) {
    auto& operations = current->formula.operations_;
    operations.push_back({kind, value, std::move(operands)});
    return static_cast<double>(operations.size() - 1);
  }
};
thread_local Recorder* Recorder::current = nullptr;

namespace {

template <Kind kind>
double unary(double a) {
  return Recorder::put(kind, {static_cast<int>(a)});
}
template <Kind kind>
double binary(double a, double b) {
  return Recorder::put(kind, {static_cast<int>(a), static_cast<int>(b)});
}
double choose(double a, double b, double c) {
  return Recorder::put(where_of, {static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
}

int read_number(const char* text, int* position, double* value) {
  if (!(std::isdigit(static_cast<unsigned char>(text[0])) || text[0] == '.')) return 0;
  char* end = nullptr;
  const double x = std::strtod(text, &end);
  if (end == text) return 0;
  *position += static_cast<int>(end - text);
  *value = Recorder::put(number, {}, x);
  return 1;
}

class Parser : public mu::ParserBase {
 public:
  Parser() {
    InitCharSets();
    EnableOptimizer(false);
    EnableBuiltInOprt(false);
    AddValIdent(read_number);
    DefineOprt("<", binary<less>, mu::prCMP);
    DefineOprt(">", binary<greater>, mu::prCMP);
    DefineOprt("+", binary<add>, mu::prADD_SUB);
    DefineOprt("-", binary<subtract>, mu::prADD_SUB);
    DefineOprt("*", binary<multiply>, mu::prMUL_DIV);
    DefineOprt("/", binary<divide>, mu::prMUL_DIV);
    DefineOprt("^", binary<power>, mu::prPOW, mu::oaRIGHT);
    DefineInfixOprt("-", unary<negate>, mu::prINFIX, false);
    DefineFun("exp", unary<exp_of>, false);
    DefineFun("log", unary<log_of>, false);
    DefineFun("sqrt", unary<sqrt_of>, false);
    DefineFun("sin", unary<sin_of>, false);
    DefineFun("cos", unary<cos_of>, false);
    DefineFun("tanh", unary<tanh_of>, false);
    DefineFun("abs", unary<abs_of>, false);
    DefineFun("step", unary<step_of>, false);
    DefineFun("min", binary<min_of>, false);
    DefineFun("max", binary<max_of>, false);
    DefineFun("if", choose, false);
  }

 private:
  void InitCharSets() override {
    DefineNameChars("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    DefineOprtChars("+-*/^<>");
    DefineInfixOprtChars("-");
  }
  void InitFun() override {}
  void InitConst() override {}
  void InitOprt() override {}
};

double computed(Kind kind, const std::vector<int>& operands, const std::vector<double>& values) {
  const auto of = [&](std::size_t i) { return values[static_cast<std::size_t>(operands[i])]; };
  switch (kind) {
    case add:
      return of(0) + of(1);
    case subtract:
      return of(0) - of(1);
    case multiply:
      return of(0) * of(1);
    case divide:
      return of(0) / of(1);
    case power:
      return std::pow(of(0), of(1));
    case negate:
      return -of(0);
    case less:
      return of(0) < of(1);
    case greater:
      return of(0) > of(1);
    case exp_of:
      return std::exp(of(0));
    case log_of:
      return std::log(of(0));
    case sqrt_of:
      return std::sqrt(of(0));
    case sin_of:
      return std::sin(of(0));
    case cos_of:
      return std::cos(of(0));
    case tanh_of:
      return std::tanh(of(0));
    case abs_of:
      return std::abs(of(0));
    case step_of:
      return of(0) > 0;
    case min_of:
      return std::min(of(0), of(1));
    case max_of:
      return std::max(of(0), of(1));
    case where_of:
      return of(0) > 0 ? of(1) : of(2);
    default:
      return 0;
  }
}

}  // namespace

Formula::Formula(const std::string& text, const std::vector<std::string>& parameters) {
  // muParser would evaluate one branch only.
  for (const char* sign : {"?", ":", "=", "!", "&", "|"})
    if (const auto at = text.find(sign); at != std::string::npos)
      throw FormulaError(std::string("\"") + sign + "\" is not known here, if(condition, yes, no) is", at);
  Recorder recorder(*this);
  Recorder::current = &recorder;
  std::vector<double> places;
  places.reserve(variables().size() + 3 * parameters.size());  // they stay where they are
  Parser parser;
  const auto define = [&](const std::string& name, int i) {
    if (name.empty() || parser.GetVar().count(name)) return;
    places.push_back(Recorder::put(variable, {i}));
    parser.DefineVar(name, &places.back());
  };
  try {
    const int known = static_cast<int>(variables().size());
    for (int i = 0; i < known; ++i) define(variables()[static_cast<std::size_t>(i)], i);
    for (std::size_t i = 0; i < parameters.size(); ++i) define(parameters[i], known + static_cast<int>(i));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      define(without_unit(parameters[i]), known + static_cast<int>(i));
      define(std::string(freestand::without_unit(parameters[i])), known + static_cast<int>(i));  // rate_per_s: rate too
    }
    parser.SetExpr(text);
    int results = 0;
    const double* values = parser.Eval(results);
    if (results != 1) throw FormulaError("it has more than one value", text.find(','));
    result_ = static_cast<int>(values[0]);
  } catch (const mu::ParserError& error) {
    throw formula_error(error, text);
  }
}

Value Formula::record(const At& at, const std::vector<double>& parameters) const {
  const int known = static_cast<int>(variables().size());
  std::vector<Value> values;
  for (const auto& [kind, x, operands] : operations_) {
    const auto operand = [&, &o = operands](std::size_t i) { return values[static_cast<std::size_t>(o[i])]; };
    const auto constant = [&, &o = operands](std::size_t i) {
      const Operation& of = operations_[static_cast<std::size_t>(o[i])];
      return of.kind == number ? &of.number : nullptr;
    };
    // What is positive where a condition holds.
    const auto condition = [&](int place) {
      const Operation& of = operations_[static_cast<std::size_t>(place)];
      const auto side = [&](std::size_t i) { return values[static_cast<std::size_t>(of.operands[i])]; };
      if (of.kind == less) return side(1) - side(0);
      if (of.kind == greater) return side(0) - side(1);
      return of.kind == step_of ? side(0) : values[static_cast<std::size_t>(place)];
    };
    const auto result = [&, &operands = operands, &k = kind, &number_value = x]() -> Value {
      switch (static_cast<Kind>(k)) {
        case number:
          return at.u.tape->constant(number_value);
        case variable:
          return operands[0] < known ? variable_value(at, operands[0])
                                     : at.u.tape->constant(parameters[static_cast<std::size_t>(operands[0] - known)]);
        case add:
          return operand(0) + operand(1);
        case subtract:
          return operand(0) - operand(1);
        case multiply:
          return operand(0) * operand(1);
        case divide:
          return operand(0) / operand(1);
        case power:
          return constant(1) ? pow(operand(0), *constant(1)) : pow(operand(0), operand(1));
        case negate:
          return -operand(0);
        case less:
          return step(operand(1) - operand(0));
        case greater:
          return step(operand(0) - operand(1));
        case exp_of:
          return exp(operand(0));
        case log_of:
          return log(operand(0));
        case sqrt_of:
          return sqrt(operand(0));
        case sin_of:
          return sin(operand(0));
        case cos_of:
          return cos(operand(0));
        case tanh_of:
          return tanh(operand(0));
        case abs_of:
          return abs(operand(0));
        case step_of:
          return step(operand(0));
        case min_of:
          return min(operand(0), operand(1));
        case max_of:
          return max(operand(0), operand(1));
        case where_of:
          return where(condition(operands[0]), operand(1), operand(2));
      }
      return at.u;
    };
    values.push_back(result());
  }
  return values[static_cast<std::size_t>(result_)];
}

double Formula::value(const Inputs& inputs, double mu, const std::vector<double>& parameters) const {
  std::vector<double> known(inputs.begin(), inputs.end());
  known.insert(known.end(), {mu, standard_gravity_mps2, pi});
  known.insert(known.end(), parameters.begin(), parameters.end());
  std::vector<double> values;
  for (const auto& [kind, x, operands] : operations_)
    values.push_back(static_cast<Kind>(kind) == number     ? x
                     : static_cast<Kind>(kind) == variable ? known[static_cast<std::size_t>(operands[0])]
                                                           : computed(static_cast<Kind>(kind), operands, values));
  return values[static_cast<std::size_t>(result_)];
}

bool Formula::uses(std::size_t parameter) const { return looks_at(static_cast<int>(variables().size() + parameter)); }

namespace {
int number_of(const std::string& variable) {
  return static_cast<int>(std::find(variables().begin(), variables().end(), variable) - variables().begin());
}
}  // namespace

bool Formula::looks_at(const std::string& variable) const { return looks_at(number_of(variable)); }

bool Formula::turns_by_direction() const {
  const auto bit = [](const char* name) { return 1U << number_of(name); };
  const unsigned sigma = bit("sigma"), changing = bit("t") | bit("rest") | bit("normal") | bit("theta") | bit("omega") |
                                                  bit("side") | bit("u") | bit("v");
  std::vector<unsigned> seen;  // by each operation
  for (const auto& [kind, x, operands] : operations_) {
    const bool known = kind == variable;
    unsigned all = known && operands[0] < static_cast<int>(variables().size()) ? 1U << operands[0] : 0;
    for (std::size_t i = 0; i < operands.size() && !known; ++i) all |= seen[static_cast<std::size_t>(operands[i])];
    const unsigned argument = kind == where_of ? seen[static_cast<std::size_t>(operands[0])] : all;
    const bool bends = kind == less || kind == greater || (kind >= abs_of && kind <= where_of);
    if (bends && (argument & sigma) && (argument & changing)) return true;
    seen.push_back(all);
  }
  return false;
}

bool Formula::looks_at(int sought) const {
  const auto is_it = [&](int place) {
    const Operation& of = operations_[static_cast<std::size_t>(place)];
    return of.kind == variable && of.operands[0] == sought;
  };
  return is_it(result_) || std::any_of(operations_.begin(), operations_.end(), [&](const Operation& o) {
           return o.kind != variable && std::any_of(o.operands.begin(), o.operands.end(), is_it);
         });
}

bool is_variable(const std::string& name) {
  return std::find(variables().begin(), variables().end(), name) != variables().end();
}

dynamics::Effect effect(const std::string& name, const std::string& friction, const std::string& force,
                        const std::vector<std::string>& parameters) {
  dynamics::Effect effect{.name = name,
                          .summary = "formula of the study",
                          .law = friction.empty() ? "force: " + force : "friction: " + friction,
                          .source = "the study",
                          .suspect = "",
                          .parameters = {}};
  if (!friction.empty() && !force.empty()) effect.law += ", force: " + force;
  for (const auto& parameter : parameters)
    effect.parameters.push_back({.name = parameter, .unit = "", .summary = "", .lower = -1e300, .upper = 1e300});
  for (const std::string* text : {&friction, &force})
    if (!text->empty() && Formula(*text, parameters).looks_at("rest"))
      effect.excludes = {"bouc_wen"};  // never stands still
  if (!friction.empty()) {
    // The formula stands in the place of mu, but acts as a factor on it: a mu of 0 becomes one that no answer can tell from 0. Beside it no
    // mu_s above 0 has a ratio that the formula could be multiplied by.
    effect.specimen = [](Specimen& specimen, const dynamics::Parameters&) {
      Friction& mu = specimen.friction;
      if (mu.mu_k == 0) mu.mu_k = mu.mu_s = mu.mu_s == 0 ? 1e-15 : std::nan("");
    };
    const Formula law(friction, parameters);
    effect.friction = [law, by_direction = law.turns_by_direction()](const At& at, const dynamics::Parameters& p) {
      if (!by_direction) return law.record(at, p) / at.mu;
      const auto towards = [&](double direction) {
        At there = at;
        there.sigma = at.u.tape->constant(direction);
        return law.record(there, p);
      };
      return where(at.sigma, towards(+1), towards(-1)) / at.mu;
    };
  }
  if (!force.empty())
    effect.force = [law = Formula(force, parameters)](const At& at, const dynamics::Parameters& p) {
      return law.record(at, p);
    };
  return effect;
}

}  // namespace freestand::formula
