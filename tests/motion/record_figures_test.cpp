#include "motion/record_figures.hpp"

#include <cmath>
#include <freestand/floor_motion.hpp>
#include <numbers>

#include "base/csv_table.hpp"
#include "motion/record_table.hpp"
#include "record_fixture.hpp"

namespace freestand::motion::record_figures_test {
namespace {

class Figures : public Record {
 protected:
  // Ten cycles of 0.5 s, 0.3 g.
  std::filesystem::path sine(const std::string& name) const {
    std::string text = "time_s,floor_acceleration_mps2\n";
    for (int i = 0; i <= 1000; ++i)
      text +=
          std::to_string(i * 0.005) + "," + std::to_string(0.3 * g * std::sin(4 * std::numbers::pi * i * 0.005)) + "\n";
    return write(name, text);
  }
};

TEST_F(Figures, OfASine) {
  const RecordFigures f = record_figures(read_record(sine("a.csv")));
  EXPECT_EQ(f.samples, 1001u);
  EXPECT_NEAR(f.step_s, 0.005, 1e-12);
  EXPECT_NEAR(f.peaks.pga_mps2, 0.3 * g, 1e-5);
  const double arias = std::numbers::pi / (2 * g) * 5 * 0.09 * g * g / 2, cav = 5 * 2 / std::numbers::pi * 0.3 * g;
  EXPECT_NEAR(f.arias_mps, arias, 1e-3 * arias);  // chords of the sine: (w dt)^2/6 less
  EXPECT_NEAR(f.cav_mps, cav, 1e-3 * cav);
  EXPECT_NEAR(f.significant_5_95_s, 4.5, 2e-3);
  EXPECT_NEAR(f.bracketed_s, 5 - 2 * std::asin(1.0 / 6) / (4 * std::numbers::pi), 2e-3);
  EXPECT_THAT(figures_text(f), AllOf(HasSubstr("1001 samples, step 0.005 s"), HasSubstr("Arias intensity"),
                                     HasSubstr("5-95 % 4.50 s"), HasSubstr("Sa, 5 % damped:")));
}

// The table says of each record what reading it again gives, and is itself a table of records.
TEST_F(Figures, AreATableOfRecords) {
  const auto first = sine("a, \"b\".csv");
  std::filesystem::create_directories(folder_ / "more");
  const auto second = write("more/plain.txt", "0\n1\n-2\n0.5\n0\n0\n1\n0\n");
  const ReadOptions plain{.dt_s = 0.02, .unit = "m/s2"};
  const std::vector<ToldRecord> told = {{first, "", "", record_figures(read_record(first))},
                                        {second, "m/s2", "", record_figures(read_record(second, plain))}};
  const auto csv = write("told.csv", figures_csv(told, folder_));
  const RecordTable table = read_record_table(csv);
  ASSERT_EQ(table.rows.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const RecordRow& row = table.rows[i];
    const FloorMotion again = read_record(row.file, {.dt_s = row.dt_s, .unit = row.unit});
    const auto given = [&](const std::string& column) {
      for (std::size_t n = 0; n < table.numbers.size(); ++n)
        if (table.numbers[n].name == column) return row.numbers[n];
      ADD_FAILURE() << "no column " << column;
      return 0.0;
    };
    EXPECT_NEAR(given("pga_g"), peaks(again).pga_mps2 / g, 1e-5);
    EXPECT_NEAR(given("arias_mps"), told[i].figures.arias_mps, 1e-5 * told[i].figures.arias_mps);
    EXPECT_NEAR(given("sa_0.5s_g"), told[i].figures.sa_mps2[3] / g, 1e-5);
    EXPECT_NEAR(given("significant_5_95_s"), told[i].figures.significant_5_95_s, 1e-4);
    EXPECT_NEAR(given("identified_pulse_period_s"), told[i].figures.pulse.period_s, 1e-5);
    EXPECT_FALSE(row.pulse.any());  // identified again, not given
  }
  EXPECT_EQ(record_number("arias_mps")->power, 2);
  EXPECT_EQ(record_number("significant_5_95_s")->power, 0);
}

TEST_F(Figures, OfAFloorCsvComeBackFromIt) {
  const FloorMotion motion = piecewise_linear("both", 0.01, {0, 1.5, -0.25, 3}, {1, 2, 3, 4});
  const FloorMotion again = read_record(write("both.csv", floor_csv(motion)));
  const auto is = [](const std::vector<double>& values) {
    return testing::Pointwise(testing::DoubleNear(1e-14), values);
  };
  EXPECT_THAT(samples(again), is({0, 1.5, -0.25, 3}));
  EXPECT_THAT(samples(again, Channel::vertical), is({1, 2, 3, 4}));
}

}  // namespace
}  // namespace freestand::motion::record_figures_test
