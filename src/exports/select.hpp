// Out of the results of a sweep: the limit states that go out, each with its curve, in a form that is honest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exports/exporter.hpp"
#include "exports/model.hpp"
#include "fragility/result.hpp"

namespace freestand::exports {

// What was asked for.
struct Request {
  // Least severe first: "peak_slip_m:0.1", "overturned", "peak_slip_m" (all its capacities), each with "=NAME" behind it
  // where it should have a name of its own. Empty: the first demand with capacities, and overturned behind it; or the first
  // demand alone, where that is another one that happens or not; in a table all demands.
  std::vector<std::string> states;
  std::optional<Form> form;  // none: the first of the format's that is honest
  bool counted = false;      // discrete from the counted shares alone
  bool straight = false;     // discrete by straight lines from bin to bin, as a database is read
  bool skip_empty = false;   // leave bins with too few samples out
  std::string id, description, asset_category, loss_category = "contents";
};

// Throws Error (Exit::usage): no such demand or capacity, an empty row, a curve that falls by more than its band holds, limit
// states that cross, a form that would not be honest.
Model select(const fragility::Result&, const Intensity&, const Request&, const Format&);

// The report's intensity PTA/(mu g) - 1 as PTA in g, where all samples have one mu. Of the fitted functions the
// shares of fine cells are kept: a lognormal in one is none in the other.
fragility::Result as_pta(fragility::Result, double mu);

const char* name(Form);

}  // namespace freestand::exports
