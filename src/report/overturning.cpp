#include "report/overturning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "report/table_pulses.hpp"

namespace freestand::report {
namespace {

constexpr double frequency_least = 0.5, frequency_most = 10, frequency_step = 0.1, amplitude_most = 40;

class Shaken {
 public:
  Shaken(const SpectrumBlock& block, const std::string& pulse, double frequency)
      : block_(block), specimen_(block.specimen()), type_(pulse), period_s_(2 * pi / (frequency * block.p_radps)) {}

  Response at(double amplitude) {
    return respond(specimen_, pulses_.shaking_g(type_, period_s_, amplitude * block_.alpha_rad));
  }

 private:
  SpectrumBlock block_;
  Specimen specimen_;
  TablePulses pulses_;
  std::string type_;
  double period_s_;
};

constexpr int stands = -1;

// How it ends: it stands, or falls after so many impacts.
int ending(const Response& response) { return response.outcome == Outcome::overturned ? response.impacts : stands; }

constexpr double located = 1 + 1e-8;

// Every change between two amplitudes that end differently, from below: the last one first found, then those below it.
void locate(Shaken& shaken, double low, int at_low, double high, int at_high, std::vector<Boundary>& found) {
  if (at_low == at_high) return;
  double below = low, above = high;
  int at_below = at_low;
  while (above / below > located) {
    const double middle = std::sqrt(below * above);
    const int at_middle = ending(shaken.at(middle));
    if (at_middle == at_high) {
      above = middle;
    } else {
      below = middle;
      at_below = at_middle;
    }
  }
  locate(shaken, low, at_low, below, at_below, found);
  if ((at_below == stands) != (at_high == stands))
    found.push_back({std::sqrt(below * above), at_high != stands, std::max(at_below, at_high)});
}

Cape cape_of(const Spectrum& spectrum) {
  Cape cape;
  double widest = 1;
  for (std::size_t i = 0; i < spectrum.frequency.size(); ++i) {
    const auto& b = spectrum.boundaries[i];
    if (b.size() < 3) continue;
    if (!cape.found) cape.from = spectrum.frequency[i];
    cape.found = true;
    cape.to = spectrum.frequency[i];
    for (std::size_t k = 1; k + 1 < b.size(); k += 2)
      if (b[k + 1].amplitude / b[k].amplitude > widest) {
        widest = b[k + 1].amplitude / b[k].amplitude;
        cape.widest_at = spectrum.frequency[i];
        cape.below = b[k].amplitude;
        cape.above = b[k + 1].amplitude;
      }
  }
  return cape;
}

// A row for each frequency and stretch of amplitudes of one outcome.
Sheet spectrum_sheet(const std::string& name, const Spectrum& spectrum) {
  Sheet sheet{name, {"frequency_over_p", "amplitude_over_alpha_g", "falls_above", "impacts"}, {}};
  for (std::size_t i = 0; i < spectrum.frequency.size(); ++i)
    for (std::size_t k = 0; k < spectrum.boundaries[i].size(); ++k) {
      const Boundary& b = spectrum.boundaries[i][k];
      sheet.rows.push_back({"boundary " + std::to_string(k + 1), spectrum.frequency[i], b.amplitude,
                            b.falls_above ? 1.0 : 0.0, static_cast<double>(b.impacts)});
    }
  return sheet;
}

}  // namespace

Specimen SpectrumBlock::specimen() const {
  const double R = 0.75 * standard_gravity_mps2 / (p_radps * p_radps);
  Specimen made{Block::rectangular(2 * R * std::sin(alpha_rad), 2 * R * std::cos(alpha_rad), 1), {1, 1}, {}};
  made.model = Model::rock;
  return made;
}

std::vector<Boundary> boundaries(const SpectrumBlock& block, const std::string& pulse, double frequency, double most) {
  Shaken shaken(block, pulse, frequency);
  std::vector<Boundary> found;
  double below = std::tan(block.alpha_rad) / block.alpha_rad;  // lifts a corner
  int at_below = stands;
  for (double amplitude = below * amplitude_step; amplitude <= most; amplitude *= amplitude_step) {
    const int now = ending(shaken.at(amplitude));
    locate(shaken, below, at_below, amplitude, now, found);
    at_below = now;
    below = amplitude;
  }
  return found;
}

double least_overturning(const std::vector<Boundary>& found) {
  return found.empty() ? std::numeric_limits<double>::quiet_NaN() : found.front().amplitude;
}

Spectrum spectrum(const SpectrumBlock& block, const std::string& pulse, const Jobs& jobs) {
  Spectrum made;
  for (int i = 0; frequency_least + i * frequency_step < frequency_most + 1e-9; ++i)
    made.frequency.push_back(frequency_least + i * frequency_step);
  const auto answers = jobs("overturning under pulse " + pulse, made.frequency.size(), [&](std::size_t i) {
    std::vector<double> flat;
    for (const Boundary& b : boundaries(block, pulse, made.frequency[i], amplitude_most)) {
      flat.push_back(b.amplitude);
      flat.push_back(b.falls_above ? 1 : 0);
      flat.push_back(b.impacts);
    }
    return flat;
  });
  for (const std::vector<double>& flat : answers) {
    made.boundaries.emplace_back();
    for (std::size_t k = 0; k + 2 < flat.size(); k += 3)
      made.boundaries.back().push_back({flat[k], flat[k + 1] > 0.5, static_cast<int>(flat[k + 2])});
  }
  made.cape = cape_of(made);
  return made;
}

Item spectrum_item(const Sources& sources, const std::string& name, const std::string& pulse, const std::string& words,
                   const std::string& print) {
  const SpectrumBlock block;
  const Spectrum found = spectrum(block, pulse, sources.jobs);
  const Cape& cape = found.cape;
  Item item;
  for (const double frequency : {2.0, 4.0, 7.0})
    item.numbers.push_back({.id = fmt::format("{}.least_{:g}", name, frequency),
                            .what = fmt::format("least a_p/(α g) that overturns at ω_p/p = {:g}, {}", frequency, words),
                            .ours = least_overturning(boundaries(block, pulse, frequency, amplitude_most))});
  const std::string ours = cape.found ? fmt::format(
                                            "the block stands again above the lowest overturning curve, at ω_p/p from "
                                            "{:.1f} to {:.1f}; widest at {:.1f}, from a_p/(α g) = "
                                            "{:.2f} to {:.2f}",
                                            cape.from, cape.to, cape.widest_at, cape.below, cape.above)
                                      : "no safe cape up to ω_p/p = 10";
  item.statements = {{name + ".cape", "a safe cape above the lowest overturning curve?", ours, print,
                      print.empty() ? Verdict::not_printed
                      : cape.found  ? Verdict::agrees
                                    : Verdict::disagrees,
                      ""}};
  item.sheets = {spectrum_sheet(name, found)};
  return item;
}

}  // namespace freestand::report
