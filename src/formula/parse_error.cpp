#include "formula/parse_error.hpp"

#include <algorithm>
#include <cctype>

namespace freestand::formula {
namespace {

// The word, or the one sign, with which a token begins.
std::string beginning(const std::string& token) {
  std::size_t end = 0;
  while (end < token.size() && (std::isalnum(static_cast<unsigned char>(token[end])) || token[end] == '_')) ++end;
  return '"' + token.substr(0, std::max<std::size_t>(end, 1)) + '"';
}

std::string problem(const mu::ParserError& error) {
  const std::string token = error.GetToken();
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return beginning(token) +
             (std::isalpha(static_cast<unsigned char>(token[0])) ? " is not known here" : " stands where it cannot");
    case mu::ecUNEXPECTED_EOF:
      return "it ends too early";
    case mu::ecMISSING_PARENS:
      return "a parenthesis is not closed";
    case mu::ecUNEXPECTED_PARENS:
      return "a parenthesis stands where none can";
    case mu::ecTOO_MANY_PARAMS:
    case mu::ecTOO_FEW_PARAMS:
      return "a function has too many or too few arguments";
    case mu::ecEMPTY_EXPRESSION:
      return "it is empty";
    default:
      return token.empty() ? "it cannot be read" : beginning(token) + " stands where it cannot";
  }
}

}  // namespace

FormulaError formula_error(const mu::ParserError& error, const std::string& text) {
  const auto position = static_cast<std::size_t>(std::max(error.GetPos(), 0));
  return FormulaError(problem(error), std::min(position, text.size()));
}

}  // namespace freestand::formula
