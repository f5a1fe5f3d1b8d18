#include "motion/band_pass.hpp"

#include <fmt/format.h>

#include <cmath>
#include <freestand/error.hpp>
#include <vector>

#include "base/units.hpp"
#include "motion/channel.hpp"
#include "motion/fourier.hpp"

namespace freestand::motion {
namespace {

// What the lower corner's filter makes of a blow dies out as exp(-2 pi f sin(pi/(2n)) t), by the pole next to the axis: to 1e-8
// in this time.
double zeros_s(double low_hz) { return std::log(1e8) / (2 * pi * low_hz * std::sin(pi / (2 * band_pass_order))); }

// Samples of a piecewise linear channel.
std::vector<double> samples(const FloorMotion& record, const MotionValues& coefficients) {
  std::vector<double> values;
  for (std::size_t i = 0; i < record.segments(); ++i) values.push_back(coefficients[2 * i]);
  values.push_back(segment(record, coefficients, record.segments() - 1)(length(record, record.segments() - 1)));
  return values;
}

void check(const FloorMotion& record, const BandPass& band, double step_s) {
  const double highest = 1 / (2 * step_s);
  if (band.high_hz >= highest)
    throw Error(fmt::format("{}: no band up to {:g} Hz (its step of {:g} s holds nothing from {:g} Hz on): lower the "
                            "upper corner",
                            record.name, band.high_hz, step_s, highest),
                Exit::data);
  if (band.low_hz * record.duration_s() < 1)
    throw Error(
        fmt::format("{}: no band from {:g} Hz (a period of {:g} s is longer than the record, {:g} s): raise the "
                    "lower corner",
                    record.name, band.low_hz, 1 / band.low_hz, record.duration_s()),
        Exit::data);
}

// With so many zeros kept at each end.
std::vector<double> filtered(std::vector<double> values, std::size_t zeros, double step_s, const BandPass& band) {
  values.insert(values.begin(), zeros, 0.0);
  values.insert(values.end(), zeros, 0.0);
  const std::size_t size = values.size();
  const RealTransform transform(transform_size(size));
  RealTransform::Spectrum spectrum = transform.forward(values);
  const double resolution_hz = 1 / (static_cast<double>(transform.size()) * step_s);
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    spectrum[k] *= band_pass_gain(band, static_cast<double>(k) * resolution_hz);
  values = transform.inverse(spectrum);
  values.resize(size);
  return values;
}

}  // namespace

double band_pass_gain(const BandPass& band, double frequency_hz) {
  if (frequency_hz <= 0) return 0;
  const double below = std::pow(band.low_hz / frequency_hz, 2 * band_pass_order),
               above = std::pow(frequency_hz / band.high_hz, 2 * band_pass_order);
  return 1 / ((1 + below) * (1 + above));
}

FloorMotion band_pass(const FloorMotion& record, const BandPass& band) {
  const double step_s = record.duration_s() / static_cast<double>(record.segments());
  check(record, band, step_s);
  const auto zeros = static_cast<std::size_t>(std::ceil(zeros_s(band.low_hz) / step_s));
  const auto channel = [&](const MotionValues& coefficients) {
    return coefficients.empty() ? std::vector<double>{} : filtered(samples(record, coefficients), zeros, step_s, band);
  };
  return piecewise_linear(record.name, step_s, channel(record.horizontal_mps2), channel(record.vertical_mps2));
}

}  // namespace freestand::motion
