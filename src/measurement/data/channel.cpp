#include "measurement/data/channel.hpp"

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
  const std::vector<double>& all = history(test, channel);
  std::vector<double> read;
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(test.steps_a_reading)) read.push_back(all[i]);
  return read;
}

double noise(const Noise& noise, Channel channel) {
  if (channel == Channel::slip) return noise.slip_m;
  return channel == Channel::rotation ? noise.rotation_rad : noise.block_acceleration_mps2;
}

}  // namespace freestand::measurement
