// Small data sets for the tests of this folder: histories of the program's own block, with noise from a fixed seed.
// What the mechanics of fitting and judging need; that the diagnosis is right is shown by tests/hidden_effect, whose
// histories are not the program's own.
#pragma once

#include <freestand/simulate.hpp>

#include "measurement/fit/model_fit.hpp"
#include "measurement/predict/bench.hpp"
#include "support/free_friction.hpp"

namespace freestand::test {

inline constexpr double slip_noise_m = 3e-4, rotation_noise_rad = 3e-4;

// Two swings of the floor to and fro of that peak [m/s2] and period [s], beginning at 0.5 s; 4 s.
FloorMotion swings(double peak_mps2, double period_s, double dt_s = 0.005);

// One test: the response of that specimen, with so many times the noise of the sensors.
measurement::Test made_test(const std::string& id, const Specimen&, const FloorMotion&, std::uint64_t seed,
                            double dt_s = 0.005, double noise = 1);

// Four tests for calibration and one held out, of different strengths and periods. friction: factors, of each test.
measurement::Dataset made_dataset(const Specimen&, double noise = 1, const std::vector<double>& friction = {});

// The sensors' noise added, of that key; white, or correlated over that time.
measurement::Dataset with_noise(measurement::Dataset, std::uint64_t key, double correlation_s = 0);

// A cabinet that slides, with an effect or none.
Specimen cabinet(const char* effect = nullptr, std::vector<double> parameters = {});

// From the start downhill.
measurement::ModelFit fitted(const measurement::Bench&, measurement::ModelSpec, std::vector<double> start);

}  // namespace freestand::test
