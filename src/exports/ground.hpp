// Targets that know intensities of the ground only, and what of freestand's is one.
#pragma once

#include <string>
#include <vector>

#include "exports/model.hpp"

namespace freestand::exports {

// What tables of records give of the ground under the building stands for the ground's: record.pga_g is pga_g, and so is
// ground.pga_g of a sweep in a building. Others as they are. Throws Error (Exit::usage) for one of a floor, and for a spectral one of
// which no period is stated.
std::string ground_name(const Intensity&);

// A sentence for the certificate on whose motion the intensity is; target: "OpenQuake".
std::string of_the_ground(const Intensity&, const char* target);

// What to do where a target knows no such intensity.
inline constexpr const char* fit_over_the_ground =
    "fit the sweep over an intensity of the ground, and export that: pga_g, pgv_mps, pgd_m or sa_g where the equipment "
    "stands "
    "on the ground; ground.pga_g and the like where the records go through a building; record.pga_g, record.pgv_mps, "
    "record.pgd_m or record.sa_g, out of the table of records, where it "
    "stands on "
    "a floor";

}  // namespace freestand::exports
