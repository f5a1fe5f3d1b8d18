// The numbers of one IM bin of one EDP, and those of one curve over IM, each in one list: what the files hold.
#pragma once

#include <span>

#include "fragility/result.hpp"

namespace freestand::io {

enum class FieldUnit { one, edp };

struct BinField {
  const char* name;
  bool whole;  // an integer in the files
  FieldUnit unit;
  const char* description;
  double (*value)(const fragility::BinFit&);
  bool (*set)(fragility::BinFit&, double);  // false: it can be no value of this field
};

std::span<const BinField> bin_fields();

struct FunctionField {
  const char* name;
  bool of_im;  // in the unit of IM; else a plain number
  const char* description;
  double (*value)(const fragility::FragilityFunction&);
  bool (*set)(fragility::FragilityFunction&, double);
};

std::span<const FunctionField> function_fields();

// The regressions of one EDP; attributes of its group.
struct RegressionField {
  const char* name;
  double fragility::Regressions::*value;
};

std::span<const RegressionField> regression_fields();

}  // namespace freestand::io
