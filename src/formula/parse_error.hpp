// What muParser finds wrong, in words. Internal to src/formula.
#pragma once

#include <muParser.h>

#include <string>

#include "formula/formula.hpp"

namespace freestand::formula {

FormulaError formula_error(const mu::ParserError& error, const std::string& text);

}  // namespace freestand::formula
