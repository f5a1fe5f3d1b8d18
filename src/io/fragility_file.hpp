// What a fragility analysis found, as files: fragility.h5, bins.csv, surface.csv.
#pragma once

#include <filesystem>
#include <string>

#include "fragility/result.hpp"
#include "io/provenance.hpp"

namespace freestand::io {

inline constexpr const char* fragility_format = "freestand-fragility/1";

// By one process. Groups: /im {edge, centre}; /edp/NAME with the fields of BinFit [im] under their names, `im` and
// `capacity` (dimension scales), surface/, functions/, distribution/, axis/AXIS/, and attributes unit, symbol, kind and
// the regressions; /overturning. A bin stands at the mean IM of its samples (Result::im). Missing values are NaN.
void write_fragility(const std::filesystem::path& path, const Provenance&, const fragility::Result&);

// The same values again, with where they come from. Throws Error (Exit::data) where the file is none of these.
struct FragilityFile {
  Provenance provenance;
  fragility::Result result;
};
FragilityFile read_fragility(const std::filesystem::path& path);

// The text of bins.csv: one row per EDP and bin, the columns of /edp/NAME beside edp, unit, im, im_lower, im_upper.
// Missing values are empty, numbers read back to the same bits.
std::string bins_csv(const fragility::Result&);
// The text of surface.csv: im_name, im_unit, im, im_lower, im_upper, edp, unit, capacity, axis, axis_unit, axis_value,
// axis_lower, axis_upper, n, probability, lower, upper, empirical, status. The columns axis to axis_upper are empty in the
// rows over the intensity alone.
std::string surface_csv(const fragility::Result&);

// The intensity as `fit --im` takes it: "pga_g", "sa_g:0.5".
std::string im_text(const fragility::Result&);

// "fitted", "too_few", "rejected", "counts_only", "not_refuted"
const char* name(fragility::BinStatus);

}  // namespace freestand::io
