// Measured tests ready to be computed again and again: motions, replays of their noise, and what came out.
#pragma once

#include <freestand/simulate.hpp>
#include <functional>
#include <vector>

#include "measurement/data/channel.hpp"
#include "measurement/data/dataset.hpp"
#include "measurement/noise/between_readings.hpp"
#include "measurement/noise/sensor.hpp"
#include "measurement/predict/model.hpp"

namespace freestand::measurement {

// What the model gives for a test, on the time steps of its histories.
struct Prediction {
  Response response;
  std::vector<double> slip_m = {}, rotation_rad = {},
                      block_acceleration_mps2 = {};  // as long as the measured ones; empty: no history
  std::vector<double> slip_velocity_mps = {};
  std::vector<Mode> mode = {};
  bool failed() const { return response.outcome >= Outcome::painleve; }
  const std::vector<double>& channel(Channel) const;
};

// The test with the free numbers at x, under its own motion or another one of the same length.
Prediction predict(const ModelSpec&, const Test&, std::span<const double> x, const FloorMotion* other = nullptr);

// Many of them at once, in packs: each with the bits that it has alone. Model, test and motion must outlive the answer.
struct Asked {
  const ModelSpec& model;
  const Test& test;
  Values x;
  const FloorMotion* other = nullptr;
};
std::vector<Prediction> predict(const std::vector<Asked>&);
// The same one after the other, for those who need not keep them.
void predict(const std::vector<Asked>&, const std::function<void(std::size_t i, Prediction)>& use);
// Each of the tests, by its place, at each of the points x.
void predict(const ModelSpec&, const std::vector<const Test*>& tests, const std::vector<Values>& points,
             const std::function<void(std::size_t point, std::size_t test, const Prediction&)>& use);

// Variance of each channel at each time that the noise of the measured floor motion makes: mean square of the
// differences between replays with that noise added once more, and the history without. What even the true model would
// miss; large where the motion is chaotic. One vector a channel; empty where the channel was not measured.
using Spread = std::vector<std::vector<double>>;

class Bench {
 public:
  // replays: of the floor's noise, each test. Keeps a reference to the data set.
  Bench(const Dataset&, int replays);

  const Dataset& data() const { return data_; }
  const Test& test(std::size_t i) const { return data_.tests[i]; }
  std::size_t size() const { return data_.tests.size(); }
  double noise(Channel) const;
  // Noise of the channel's sensor in that unit: as stated, until it is estimated where nothing moves.
  const Sensor& sensor(Channel channel) const { return sensors_[static_cast<std::size_t>(channel)]; }
  void estimate_sensors();
  double floor_noise_mps2(std::size_t test) const { return floor_noise_mps2_[test]; }
  const std::vector<FloorMotion>& replays(std::size_t test) const { return replays_[test]; }
  const BetweenReadings& between_readings(std::size_t test) const { return between_readings_[test]; }
  // Of the measured slips: of the calibration tests, or of these. Tests held out or left out reach nothing of a fit.
  Reach reach() const;
  Reach reach(const std::vector<std::size_t>& tests) const;

  // The test under its motion with each replay of its noise.
  std::vector<Asked> replays_asked(const ModelSpec&, std::size_t test, std::span<const double> x) const;
  Spread spread(const ModelSpec&, std::size_t test, std::span<const double> x, const Prediction& nominal) const;
  // The same of what the floor may do between its readings.
  Spread unread_spread(const ModelSpec&, std::size_t test, std::span<const double> x, const Prediction& nominal) const;

 private:
  void leave_out_floor(Sensor& both) const;
  // Mean square of what these motions in place of the test's change.
  Spread changes(const ModelSpec&, std::size_t test, std::span<const double> x, const Prediction& nominal,
                 const std::vector<FloorMotion>&) const;

  const Dataset& data_;
  std::vector<double> floor_noise_mps2_;
  std::vector<std::vector<FloorMotion>> replays_;
  std::vector<BetweenReadings> between_readings_;  // of measured floors
  std::vector<Reach> reach_;                       // of each test
  Sensor sensors_[channel_count];
};

}  // namespace freestand::measurement
