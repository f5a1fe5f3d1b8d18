// The numbers of one IM bin of one EDP, in one list: what fragility.h5 and bins.csv write.
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
};

std::span<const BinField> bin_fields();

}  // namespace freestand::io
