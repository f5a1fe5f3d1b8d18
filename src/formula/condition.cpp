#include "formula/condition.hpp"

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "formula/parse_error.hpp"

namespace freestand::formula {
namespace {

bool of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; }

// `and`, `or` and `not` as signs, padded so that every character keeps its place.
std::string with_signs(std::string text) {
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin;
    while (end < text.size() && of_word(text[end])) ++end;
    const std::string word = text.substr(begin, end - begin);
    if (word == "and") text.replace(begin, 3, "&& ");
    if (word == "or") text.replace(begin, 2, "||");
    if (word == "not") text.replace(begin, 3, "!  ");
    begin = std::max(end, begin + 1);
  }
  return text;
}

double negated(double value) { return value == 0 ? 1 : 0; }

// Signs that muParser reads, and that mean something else than a user who writes them expects.
void refuse_others(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char before = i > 0 ? text[i - 1] : ' ', after = i + 1 < text.size() ? text[i + 1] : ' ';
    if (text[i] == '=' && after != '=' && before != '=' && before != '<' && before != '>' && before != '!')
      throw FormulaError("\"=\" is not known here, == is", i);
    if ((text[i] == '&' && after != '&' && before != '&') || (text[i] == '|' && after != '|' && before != '|'))
      throw FormulaError(text[i] == '&' ? "\"&\" is not known here, `and` is" : "\"|\" is not known here, `or` is", i);
    if (text[i] == '?') throw FormulaError("\"?\" is not known here, `and` and `or` are", i);
  }
}

// Values that a condition is tried at: of every size, in every order.
constexpr double trials[] = {0, 0.37, 1.7, 42, 1e3, 1e-6};

}  // namespace

struct Condition::Parser {
  mu::Parser parser;
  std::vector<double> values;
  std::vector<std::size_t> uses;

  double eval() {
    int results = 0;
    const double* found = parser.Eval(results);
    if (results != 1) throw FormulaError("it has more than one value", 0);
    return found[0];
  }
};

Condition::Condition(const std::string& text, const std::vector<Name>& names) : parser_(std::make_unique<Parser>()) {
  refuse_others(text);
  mu::Parser& parser = parser_->parser;
  parser_->values.resize(names.size());
  try {
    // Above `and`, below comparisons.
    parser.DefineInfixOprt("!", negated, mu::prLOGIC);
    for (std::size_t i = 0; i < names.size(); ++i) parser.DefineVar(names[i].name, &parser_->values[i]);
    parser.SetExpr(with_signs(text));
    for (std::size_t trial = 0; trial < std::size(trials) * names.size() + 1; ++trial) {
      for (std::size_t i = 0; i < names.size(); ++i)
        parser_->values[i] = names[i].binary
                                 ? static_cast<double>((trial + i) % 2)
                                 : trials[(trial + i * (1 + trial / std::size(trials))) % std::size(trials)];
      const double value = parser_->eval();
      if (value != 0 && value != 1) throw FormulaError("it is a number and no condition, compare it with something", 0);
    }
    const auto& used = parser.GetUsedVar();
    for (std::size_t i = 0; i < names.size(); ++i)
      if (used.count(names[i].name)) parser_->uses.push_back(i);
  } catch (const mu::ParserError& error) {
    throw formula_error(error, text);
  }
}

Condition::~Condition() = default;
Condition::Condition(Condition&&) noexcept = default;

const std::vector<std::size_t>& Condition::uses() const { return parser_->uses; }

bool Condition::holds(std::span<const double> values) const {
  for (const std::size_t i : parser_->uses) parser_->values[i] = values[i];
  return parser_->eval() != 0;
}

}  // namespace freestand::formula
