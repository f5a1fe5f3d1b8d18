// Overturning spectra of a rocking block under a pulse [KM05 figures 6.4 to 6.6]: at which amplitudes it stands, and at which
// it falls. The answer is not monotonic in amplitude: above the lowest amplitude that overturns it, after an impact, there may
// be a safe cape, before it falls without impact. So amplitudes are scanned from below, and every change of the outcome is
// narrowed in on.
#pragma once

#include <freestand/specimen.hpp>
#include <string>
#include <vector>

#include "report/item.hpp"

namespace freestand::report {

struct SpectrumBlock {
  double p_radps = 1.25, alpha_rad = 0.16;
  Specimen specimen() const;  // uniform, of model rock
};

// One amplitude, over alpha g, at which the outcome changes.
struct Boundary {
  double amplitude = 0;
  bool falls_above = false;  // it stands below and falls above, or the other way round
  int impacts = 0;           // before it falls, on the side where it does
};

// From the amplitude that lifts a corner up to `most`, in steps of 2 %. Between two steps that differ in outcome, or in the
// number of impacts before the fall, each change in between is located, to 1e-8 of the amplitude: so a cape narrower than a step
// is seen too, since it parts falls after an impact from falls without one. What comes and goes within a step between two alike
// ends is not. frequency: w_p/p.
inline constexpr double amplitude_step = 1.02;
std::vector<Boundary> boundaries(const SpectrumBlock&, const std::string& pulse, double frequency, double most);

// The least amplitude, over alpha g, that overturns; nan where none up to `most` does.
double least_overturning(const std::vector<Boundary>&);

// Between two frequencies (ends of a grid) the block stands again above its least overturning amplitude.
struct Cape {
  bool found = false;
  double from = 0, to = 0;                     // w_p/p
  double widest_at = 0, below = 0, above = 0;  // where, and between which amplitudes, it is widest
};

struct Spectrum {
  std::vector<double> frequency;
  std::vector<std::vector<Boundary>> boundaries;
  Cape cape;
};
Spectrum spectrum(const SpectrumBlock&, const std::string& pulse, const Jobs&);

// The figure of one pulse: its boundaries, the cape, and the least overturning amplitude at some frequencies.
Item spectrum_item(const Sources&, const std::string& name, const std::string& pulse, const std::string& words,
                   const std::string& print);

}  // namespace freestand::report
