// What goes out: limit states over one intensity, as plain values that no target's habits have touched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "exports/curve.hpp"
#include "fragility/counted_curve.hpp"

namespace freestand::exports {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// An intensity under freestand's name: pga_g, pta_g, pgv_mps, pgd_m, sa_g ... SI, but g for accelerations.
struct Intensity {
  std::string name, unit;
  double period_s = unknown;  // of sa_g
  bool of_a_floor = false;    // known to be: the sweep had records of the ground, and the equipment stood in a building
};

// One bin of intensity as the surface has it.
struct Bin {
  std::size_t index;  // in the results
  double im, probability, lower, upper, counted;
  std::int64_t n;
};

// The fragility function behind a limit state, NaN where there is none.
struct Fitted {
  double median = unknown, median_se = unknown, dispersion = unknown, dispersion_se = unknown;
  double off_by = unknown;                                           // bound on |fitted - counted|
  bool adequate = false, not_refuted = false, extrapolated = false;  // not_refuted: nor known to be off by little
  bool rates_differ = false;                                         // from those of the counts
};

struct LimitState {
  std::string name;  // letters, digits, _
  std::string demand, unit;
  double capacity = unknown;  // NaN: it happens or not
  Curve curve;
  std::string why;  // this form and no other
  Fitted fitted;
  std::vector<Bin> bins;  // as they were, before anything was pooled
  double pooled = 0;      // largest change of a bin so that the curve does not fall
  // Discrete: the counted curve, which annual rates go by, the one of which points are taken at these places, and how far straight lines
  // between them are off the first: the largest difference, and their annual rate over its own under hazards of slope 1, 2 and 3.
  std::optional<fragility::CountedCurve> counted = {}, drawn = {};
  std::vector<double> places = {};
  double off_lines = 0, rate_by_lines[3] = {1, 1, 1};
  double off_surface = 0;  // largest |curve - surface| at the bins
  double off_surface_at = unknown;
};

struct Model {
  std::string id, description, asset_category, loss_category;
  Intensity im;
  double im_least = unknown, im_most = unknown;  // what was swept
  std::vector<LimitState> states;                // least severe first
  std::vector<std::string> notes;                // plain sentences for the certificate
};

}  // namespace freestand::exports
