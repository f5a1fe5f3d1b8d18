#include "io/text_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/error_text.hpp"

namespace freestand::io {
namespace {

TEST(HistoryCsv, HasTheColumnsAndReadsBackToTheBit) {
  History history;
  const HistoryPoint point{0.1 + 0.2, -1.0 / 3, 1e-310, -0.0, M_PI, 6.02e23, Mode::slide_rock};
  history.points = {{0, 0, 0, 0, 0, 0, Mode::rest}, point};
  history.points[1].acceleration_mps2 = -1.0 / 7, history.points[1].vertical_acceleration_mps2 = 1e-5;
  history.points[1].contact_x_mps2 = 0.5, history.points[1].contact_y_mps2 = 9.75;
  std::istringstream lines(history_csv(history, {0, 0.3}, 200));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(
      line,
      "time_s,floor_acceleration_mps2,slip_m,slip_velocity_mps,rotation_rad,rotation_rate_radps,mode,"
      "floor_displacement_m,acceleration_mps2,vertical_acceleration_mps2,contact_horizontal_n,contact_vertical_n");
  std::getline(lines, line);
  EXPECT_NE(line.find(",rest,"), std::string::npos);
  std::getline(lines, line);
  std::istringstream cells(line);
  for (const double expected : {point.time_s, point.floor_acceleration_mps2, point.slip_m, point.slip_velocity_mps,
                                point.rotation_rad, point.rotation_rate_radps}) {
    std::string cell;
    std::getline(cells, cell, ',');
    const double back = std::strtod(cell.c_str(), nullptr);
    EXPECT_EQ(back, expected);
    EXPECT_EQ(std::signbit(back), std::signbit(expected));
  }
  std::getline(cells, line, ',');
  EXPECT_EQ(line, "slide_rock");
  for (const double expected : {0.3, -1.0 / 7, 1e-5, 100.0, 1950.0}) {
    std::getline(cells, line, ',');
    EXPECT_EQ(std::strtod(line.c_str(), nullptr), expected);
  }
}

TEST(HistoryCsv, HasTheOtherDirectionAtItsEnd) {
  History history;
  history.cross = true;
  HistoryPoint point{0, 1, 2, 3, 0, 0, Mode::slide};
  point.cross_slip_m = 4;
  point.cross_slip_velocity_mps = 5;
  point.floor_cross_acceleration_mps2 = 6;
  history.points = {point};
  EXPECT_EQ(history_csv(history, {7}, 1),
            "time_s,floor_acceleration_mps2,slip_m,slip_velocity_mps,rotation_rad,rotation_rate_radps,mode,"
            "floor_displacement_m,cross_slip_m,cross_slip_velocity_mps,floor_cross_acceleration_mps2\n"
            "0,1,2,3,0,0,slide,7,4,5,6\n");
  Response response;
  response.residual_slip_m = -3;
  response.residual_cross_slip_m = 4;
  EXPECT_EQ(response_summary(response)["residual_slip_m"], -3);
  const auto plane = response_summary(response, true);
  EXPECT_EQ(plane["residual_slip_m"], 5);
  EXPECT_EQ(plane["residual_slip_along_m"], -3);
  EXPECT_EQ(plane["residual_slip_across_m"], 4);
}

TEST(ResponseSummary, HasTheKeysOfTheContract) {
  Response response;
  response.outcome = Outcome::overturned;
  response.peak_slip_m = 0.1;
  response.peak_acceleration_mps2 = 2 * 9.80665;
  response.peak_rotation_rad = NAN;
  response.events = 12;
  const auto json = nlohmann::json::parse(json_text(response_summary(response)));
  for (const char* key : {"peak_slip_m", "residual_slip_m", "slid_path_m", "peak_rotation_rad", "overturned", "outcome",
                          "peak_acceleration_g", "events"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["overturned"], true);
  EXPECT_EQ(json["outcome"], "overturned");
  EXPECT_EQ(json["peak_slip_m"], 0.1);
  EXPECT_DOUBLE_EQ(json["peak_acceleration_g"], 2.0);
  EXPECT_TRUE(json["peak_rotation_rad"].is_null());
  EXPECT_EQ(json["events"], 12);
}

TEST(JsonText, DoublesReadBackToTheBit) {
  nlohmann::ordered_json json;
  const std::vector<double> values{0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 123456789012345680.0};
  json["values"] = values;
  json["infinite"] = INFINITY;
  json["text"] = "not UTF-8: \xff";
  const auto back = nlohmann::json::parse(json_text(json));
  EXPECT_EQ(back["values"].get<std::vector<double>>(), values);
  EXPECT_TRUE(back["infinite"].is_null());
}

}  // namespace
}  // namespace freestand::io
