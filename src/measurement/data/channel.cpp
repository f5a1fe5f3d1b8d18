#include "measurement/data/channel.hpp"

#include "measurement/data/every.hpp"

namespace freestand::measurement {

const char* name(Channel channel) {
  constexpr const char* names[] = {"slip_m", "rotation_rad", "block_acceleration_mps2"};
  return names[static_cast<int>(channel)];
}

const std::vector<double>& history(const Test& test, Channel channel) {
  if (channel == Channel::slip) return test.slip_m;
  return channel == Channel::rotation ? test.rotation_rad : test.block_acceleration_mps2;
}

std::vector<double> readings(const Test& test, Channel channel) {
  return every(test.steps_a_reading, history(test, channel));
}

double noise(const Noise& noise, Channel channel) {
  if (channel == Channel::slip) return noise.slip_m;
  return channel == Channel::rotation ? noise.rotation_rad : noise.block_acceleration_mps2;
}

}  // namespace freestand::measurement
