// Figures of Konstantinidis & Makris (2005), from the tables in configs/report.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "base/units.hpp"
#include "fragility/goodness.hpp"
#include "fragility/regression.hpp"
#include "support/data.hpp"

namespace freestand::fragility {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      result.emplace_back();
    } else if (c != '\r') {
      result.back() += c;
    }
  }
  return result;
}

std::map<std::string, std::vector<double>> table(const std::string& name) {
  std::ifstream file(test::source_dir() / "configs" / "report" / name);
  std::string line;
  std::getline(file, line);
  const auto header = cells(line);
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(file, line)) {
    const auto row = cells(line);
    for (std::size_t i = 3; i < header.size(); ++i) columns[header[i]].push_back(std::stod(row[i]));
  }
  return columns;
}

struct Data {
  std::vector<double> im, delta;
};

// IM = PTA/(mu g) - 1 [KM05 5.6]; Delta as printed.
Data data(const std::string& name, const std::string& mu) {
  const auto columns = table(name);
  Data result;
  result.delta = columns.at("edp_printed");
  for (std::size_t i = 0; i < result.delta.size(); ++i)
    result.im.push_back(columns.at("pta_g")[i] / columns.at(mu)[i] - 1);
  return result;
}

// Delta = U w^2/PTA [KM05 5.7], with g = 386.09 in/s2.
TEST(Report, PrintedDemandsAreThoseOfTheDefinition) {
  for (const std::string name : {"table_5_1.csv", "table_8_1.csv"}) {
    const auto columns = table(name);
    const std::size_t rows = columns.at("pta_g").size();
    ASSERT_EQ(rows, name == "table_5_1.csv" ? 28u : 27u);
    for (std::size_t i = 0; i < rows; ++i) {
      const double w = 2 * pi / columns.at("pulse_period_s")[i];
      const double delta = columns.at("peak_slip_in")[i] * w * w / (columns.at("pta_g")[i] * 386.09);
      EXPECT_NEAR(delta / columns.at("edp_printed")[i], 1, 0.02) << name << " row " << i;
    }
  }
}

TEST(Report, RegressionsThroughTheOrigin) {
  const Data best = data("table_5_1.csv", "mu_best_fit"), slow = data("table_5_1.csv", "mu_slow_pull"),
             rare = data("table_8_1.csv", "mu_best_fit");
  const LinearDemand of_best = fit_linear_demand(best.im, best.delta), of_slow = fit_linear_demand(slow.im, slow.delta),
                     of_rare = fit_linear_demand(rare.im, rare.delta);
  EXPECT_NEAR(of_best.slope, 0.672, 0.0005);
  EXPECT_NEAR(of_best.r2, 0.196, 0.0005);
  EXPECT_NEAR(of_rare.slope, 0.380, 0.0005);
  EXPECT_NEAR(of_rare.r2, 0.327, 0.0006);
  EXPECT_NEAR(of_slow.slope, 1.368, 0.0005);  // the print says 1.31, and 0.25: it disagrees with its own table
  EXPECT_NEAR(of_slow.r2, 0.39, 0.005);
  EXPECT_NEAR(of_best.sd_slope, 0.41, 0.005);
  EXPECT_NEAR(of_slow.sd_slope, 0.76, 0.005);
  EXPECT_NEAR(of_rare.sd_slope, 0.17, 0.005);
}

// Slopes as the report prints them; standard deviations of the test above, to two figures.
const LinearDemand best_fit{0.67, 0.41, 0}, slow_pull{1.31, 0.76, 0}, rare_motions{0.38, 0.17, 0};

double statistic(const LinearDemand& model, const Data& data) {
  return ks_statistic(linear_demand_transform(model, data.im, data.delta));
}

TEST(Report, KolmogorovSmirnovStatistics) {
  EXPECT_NEAR(statistic(slow_pull, data("table_5_1.csv", "mu_slow_pull")), 0.140, 0.0005);
  EXPECT_NEAR(statistic(best_fit, data("table_5_1.csv", "mu_best_fit")), 0.141, 0.0005);
  EXPECT_NEAR(statistic(rare_motions, data("table_8_1.csv", "mu_best_fit")), 0.186, 0.0005);
}

// What chance makes of S when the two slopes of the line come from the same data, by simulation of that very fit: neither the
// textbook's null (no parameter fitted) nor that of one lognormal (lambda and omega fitted). All three lines stand, as the
// report says. The figures are those of a simulation written apart, 20000 data sets for each.
TEST(Report, LinesStandUnderTheNullOfTheirOwnFit) {
  struct Expected {
    const char *table, *mu;
    double s, critical, p;
  };
  for (const auto& [table, mu, expected_s, expected_critical, expected_p] :
       {Expected{"table_8_1.csv", "mu_best_fit", 0.185, 0.230, 0.20},
        Expected{"table_5_1.csv", "mu_slow_pull", 0.152, 0.195, 0.26},
        Expected{"table_5_1.csv", "mu_best_fit", 0.141, 0.198, 0.39}}) {
    const Data points = data(table, mu);
    const LinearDemand line = fit_linear_demand(points.im, points.delta);
    const double s = statistic(line, points);
    const std::vector<double> null = linear_demand_null(line, points.im, 20000, 1);
    const auto below = static_cast<double>(std::lower_bound(null.begin(), null.end(), s) - null.begin());
    EXPECT_NEAR(s, expected_s, 0.001) << table;
    EXPECT_NEAR(null[static_cast<std::size_t>(0.95 * 20000)], expected_critical, 0.003) << table;  // 2 standard errors
    EXPECT_NEAR(1 - below / 20000, expected_p, 0.015) << table;
  }
}

// With the null of one lognormal in its place the 2 % motions would be rejected.
TEST(Report, TheNullOfOneLognormalIsAnother) {
  const double s = statistic(rare_motions, data("table_8_1.csv", "mu_best_fit"));
  EXPECT_LT(s, kolmogorov_critical(0.05, 27));
  EXPECT_GT(s, estimated_ks_critical(0.05, 27));
}

TEST(Report, DesignExample) {
  EXPECT_NEAR(linear_demand_exceedance(best_fit, 1.8, 2), 0.119, 0.0005);
  EXPECT_NEAR(linear_demand_exceedance(slow_pull, 1.8, 2), 0.514, 0.001);
}

}  // namespace
}  // namespace freestand::fragility
