// Bin edges of an intensity measure or of a second axis, from the rule of the study and the values that occur.
#pragma once

#include <vector>

#include "study/study.hpp"

namespace freestand::study {

// Increasing edges, those that are given, or, with the finite values (log: the positive ones):
// width: multiples of the width that enclose all values; count: that many bins from the least to the greatest value, of
// equal width, of equal ratio, or with as many values each (fewer bins where values repeat). Values that are all alike
// give one bin around them. No edge parts values that are one to 1e-9 of them (records scaled to one intensity differ by their last digits):
// an edge on such values is moved below them by that. Throws Error when no value can be used (Exit::data), or a width makes more bins than can be
// held or filled (Exit::usage).
std::vector<double> bin_edges(const BinsPart&, std::vector<double> values);

}  // namespace freestand::study
