// What the tests of the readers share: files of their own, and what reading them gives or says.
#pragma once

#include <gmock/gmock.h>

#include <freestand/error.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/units.hpp"
#include "motion/peaks.hpp"
#include "motion/record.hpp"
#include "motion/temporary_folder.hpp"

namespace freestand::motion {

using testing::AllOf;
using testing::HasSubstr;

inline constexpr double g = standard_gravity_mps2;

// Samples of a piecewise linear motion: the starts of its segments and the end of the last.
inline std::vector<double> samples(const FloorMotion& motion, Channel channel = Channel::horizontal) {
  const MotionValues& c = channel == Channel::horizontal ? motion.horizontal_mps2 : motion.vertical_mps2;
  std::vector<double> values;
  for (std::size_t i = 0; i < c.size(); i += 2) values.push_back(c[i]);
  if (!c.empty()) values.push_back(c[c.size() - 2] + c.back() * (motion.knot_s.back() - motion.knot_s.end()[-2]));
  return values;
}

inline std::vector<double> in_mps2(std::vector<double> values, double unit) {
  for (double& value : values) value *= unit;
  return values;
}

inline void expect_samples(const FloorMotion& motion, double dt, std::vector<double> values, double unit) {
  EXPECT_NEAR(motion.knot_s[1], dt, 1e-15);
  EXPECT_THAT(samples(motion), testing::Pointwise(testing::DoubleNear(1e-12), in_mps2(std::move(values), unit)));
}

// One channel of a CSMIP V2 file, of three samples.
inline std::string csmip_channel(int number, const std::string& name, const std::string& values,
                                 const std::string& dt = ".010") {
  return "Corrected accelerogram   58667-L2866-14236.52       Chan  " + std::to_string(number) + ":  " + name +
         "         from   \nChan  " + std::to_string(number) + ":  " + name +
         "   \nsome header\n    3 points of accel data equally spaced at  " + dt + " sec, in cm/sec2. (8f10.6)    \n" +
         values +
         "    3 points of veloc data equally spaced at  .010 sec, in cm/sec.  (8f10.7)\n 9.0000000 9.0000000 "
         "9.0000000\n/&  ----------  End of data\n";
}

class Record : public TemporaryFolder {
 protected:
  // The message of the Error that reading throws, and its exit code.
  std::pair<std::string, Exit> problem(const std::filesystem::path& path, const ReadOptions& options = {}) const {
    try {
      read_record(path, options);
    } catch (const Error& error) {
      return {error.what(), error.exit()};
    }
    return {"(no error)", Exit::done};
  }
  void expect_data_error(const std::filesystem::path& path, int line, const std::string& text,
                         const ReadOptions& options = {}) const {
    const auto [message, exit] = problem(path, options);
    const std::string place = line > 0 ? path.string() + ":" + std::to_string(line) + ": " : path.string();
    EXPECT_THAT(message, AllOf(HasSubstr(place), HasSubstr(text)));
    EXPECT_EQ(exit, Exit::data) << message;
  }
  void expect_usage_error(const std::filesystem::path& path, const std::string& text,
                          const ReadOptions& options = {}) const {
    const auto [message, exit] = problem(path, options);
    EXPECT_THAT(message, HasSubstr(text));
    EXPECT_EQ(exit, Exit::usage) << message;
  }
};

inline const std::string at2_head =
    "PEER NGA STRONG MOTION DATABASE RECORD\n"
    "Somewhere, 1/1/2000, Station, 90\n"
    "ACCELERATION TIME SERIES IN UNITS OF G\n";
inline const std::vector<double> seven = {0.1394908e-2, -0.5, 0.25, -0.125, 1.5, -.4229e-5, 0.75};
inline const std::string seven_text =
    "   .1394908E-02  -.5000000E+00   .2500000E+00  -.1250000E+00   .1500000E+01\n"
    "  -.4229000E-05   .7500000E+00\n";

}  // namespace freestand::motion
