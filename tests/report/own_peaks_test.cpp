// A table of the user's own gets the same treatment as the report's.
#include "report/own_peaks.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <freestand/error.hpp>
#include <fstream>

#include "report/peaks.hpp"
#include "support/data.hpp"

namespace freestand::report {
namespace {

double value(const Item& item, const std::string& id) {
  for (const Number& one : item.numbers)
    if (one.id.ends_with("." + id)) return one.ours;
  ADD_FAILURE() << id;
  return 0;
}

class OwnPeaks : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(file_) << text;
    return file_;
  }
  // Points on a line: slope 0.5, no scatter but a factor that alternates.
  static std::string made(int rows, const std::string& changed = "", int at = -1) {
    std::string text = "motion,pta_g,mu,period_s,peak_slip_mm\n";
    for (int i = 0; i < rows; ++i) {
      const double pta = 0.4 + 0.05 * i, im = intensity(pta, 0.2), delta = 0.5 * im * (i % 2 ? 1.3 : 0.7);
      const double slip_mm = 1000 * delta * pta * 9.80665 * 0.25 / (4 * 3.14159265358979 * 3.14159265358979);
      text += i == at ? changed + "\n"
                      : "m" + std::to_string(i % 4) + "," + std::to_string(pta) + ",0.2,0.5," +
                            std::to_string(slip_mm) + "\n";
    }
    return text;
  }
  std::string error(const std::string& text) const {
    try {
      own_peaks(write(text), run_here);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
  void TearDown() override { std::filesystem::remove(file_); }
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("freestand-peaks-" + std::to_string(::getpid()) + ".csv");
};

TEST_F(OwnPeaks, TheReportsOwnTableGivesItsLines) {
  const auto found = own_peaks(test::source_dir() / "configs/report/table_5_1.csv", run_here);
  ASSERT_EQ(found.size(), 2u);  // one for each column of friction
  EXPECT_EQ(found[0].first.name, "own_mu_slow_pull");
  EXPECT_NEAR(value(found[0].second, "slope"), 1.368, 0.001);
  EXPECT_NEAR(value(found[1].second, "slope"), 0.672, 0.001);
  EXPECT_NEAR(value(found[1].second, "r2"), 0.196, 0.001);
  EXPECT_NEAR(value(found[1].second, "ks_critical"), 0.198, 0.003);
  ASSERT_FALSE(found[1].second.left_out.empty());
  EXPECT_NE(found[1].second.left_out[0].find("pulse_velocity_in_per_s"), std::string::npos);
}

TEST_F(OwnPeaks, OtherUnitsAndNames) {
  const auto found = own_peaks(write(made(20)), run_here);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(value(found[0].second, "slope"), 0.5, 0.03);
  EXPECT_EQ(value(found[0].second, "n"), 20);
  EXPECT_EQ(found[0].second.sheets.size(), 5u);
}

// A line through two bins leaves nothing over that r2 could tell of.
TEST_F(OwnPeaks, OfTwoBinsNoCorrelationIsTold) {
  const auto tells = [&](int tests) {
    const auto found = own_peaks(write(made(tests)), run_here);
    const auto& numbers = found[0].second.numbers;
    return std::count_if(numbers.begin(), numbers.end(), [](const auto& n) {
      return n.id.find(".bin_") != std::string::npos && n.id.ends_with("_r2");
    });
  };
  EXPECT_EQ(tells(15), 0);
  EXPECT_EQ(tells(30), 2);
}

TEST_F(OwnPeaks, BadInputIsToldWithItsLine) {
  EXPECT_NE(error(made(20, "m,0.1,0.2,0.5,3", 4)).find(":6: IM = PTA/(mu g) - 1 is -0.5"), std::string::npos);
  EXPECT_NE(error(made(20, "m,0.5,0.2,0.5,0", 4)).find(":6: peak_slip_mm is 0 (it is a number above 0)"),
            std::string::npos);
  EXPECT_NE(error(made(20, "m,0.5,0.2,0.5,", 4)).find(":6: peak_slip_mm is empty"), std::string::npos);
  EXPECT_NE(error(made(20, "m,0.5,x,0.5,2", 4)).find(":6: mu is x"), std::string::npos);
  EXPECT_NE(error(made(9)).find("need 14 measured peaks (there are 9)"), std::string::npos);
  EXPECT_NE(error("pta_g,period_s,peak_slip_m\n1,1,1\n").find("no column im, mu"), std::string::npos);
  EXPECT_NE(error("pta_g,mu,peak_slip_m\n1,0.2,1\n").find("none of the columns pulse_period_s, period_s"),
            std::string::npos);
  EXPECT_NE(
      error("pta_g,mu,period_s,peak_slip_m,peak_slip_in\n1,0.2,1,1,1\n").find("several of the columns peak_slip_m"),
      std::string::npos);
  EXPECT_NE(error("mu,period_s,peak_slip_m\n0.2,1,1\n").find("no column pta_g"), std::string::npos);
}

}  // namespace
}  // namespace freestand::report
