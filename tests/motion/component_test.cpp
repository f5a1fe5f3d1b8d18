// Vertical components are known by their headers, or by their names where the headers say nothing.
#include "motion/component.hpp"

#include "motion/record_channels.hpp"
#include "motion/record_fixture.hpp"

namespace freestand::motion {
namespace {

class VerticalSign : public Record {
 protected:
  std::string sign(const std::string& name, const std::string& text) const { return vertical_sign(write(name, text)); }
};

const std::string plain = "0.1\n0.2\n0.3\n";

TEST_F(VerticalSign, NamesOfVerticalOnes) {
  for (const char* name :
       {"TAB-UP", "TAB-UP.txt", "TCU065-V.ATH", "NIG023_UD.acc", "RinaldiUP.txt", "65006UD.txt", "CPEDWN.txt",
        "CHB002.UD", "CHB002.UD2", "abc.up", "x_vert.txt", "HI.ARS1..HNZ.D.2019.txt", "x_z.txt"})
    EXPECT_THAT(sign(name, plain), HasSubstr("its name")) << name;
}

TEST_F(VerticalSign, NamesOfHorizontalOnes) {
  for (const char* name :
       {"TAB-LN", "TCU065-E.ATH", "NIG023_NS.acc", "Rinaldi228.txt", "CE58667.V2", "V", "up.txt", "GROUP.txt",
        "CLOUD.txt", "setup.txt", "lineup.txt", "HI.ARS1..HNE.D.2019.txt", "CHB002.EW", "x.V1", "BHD.txt"})
    EXPECT_EQ(sign(name, plain), "") << name;
}

TEST_F(VerticalSign, HeadersSayIt) {
  const auto at2 = [](const std::string& component) {
    return "PEER\nSomewhere, 1/1/2000, Station, " + component +
           "\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n.1 .2 .3\n";
  };
  EXPECT_EQ(sign("a.AT2", at2("UP")), "its header says so");
  EXPECT_EQ(sign("b.AT2", at2("DWN (STATION 7)")), "its header says so");
  EXPECT_EQ(sign("c.AT2", at2("90")), "");
  const std::string csv = "time_s,floor_acceleration_mps2\n0,0\n0.1,1\n";
  EXPECT_EQ(sign("one-UP.csv", csv), "") << "the column says that it is horizontal";
  EXPECT_EQ(sign("none.txt", ""), "");
  EXPECT_EQ(vertical_sign("no/such-UP.AT2"), "");
}

TEST_F(VerticalSign, ChannelsOfAFileGoByTheSameWords) {
  for (const char* name : {"Up", "UD", "Z", "HNZ", "Vert", "V 90", "Down", "dwn"})
    EXPECT_TRUE(named_channel(name).vertical) << name;
  for (const char* name : {"360", "HNE", "90 Deg", "N"}) EXPECT_FALSE(named_channel(name).vertical) << name;
  for (const char* name : {"Down", "DWN 90", "dn"}) EXPECT_TRUE(is_downward_word(name)) << name;
  for (const char* name : {"DNZ", "UD", "Up", "V"}) EXPECT_FALSE(is_downward_word(name)) << name;
}

// DWN is positive downwards, a vertical floor upwards. What the name says holds where the header gives no direction.
TEST_F(VerticalSign, DownwardRecordsAreTurnedOver) {
  const auto at2 = [](const std::string& component) {
    return "PEER\nSomewhere, 1/1/2000, Station, " + component +
           "\nACCELERATION IN UNITS OF M/S2\nNPTS= 3, DT= 1.0 SEC\n.1 .2 .3\n";
  };
  const std::string one_column = "time_s,floor_acceleration_mps2\n0,.1\n1,.2\n2,.3\n";
  const auto horizontal = write("one.csv", "time_s,floor_acceleration_mps2\n0,7\n1,8\n2,9\n");
  const auto vertical = [&](const std::string& name, const std::string& text) {
    return samples(read_record(horizontal, {.vertical_file = write(name, text).string(), .begin_together = true}),
                   Channel::vertical);
  };
  const std::vector<double> up = {0.1, 0.2, 0.3}, down = {-0.1, -0.2, -0.3};
  EXPECT_EQ(vertical("a.AT2", at2("UP")), up);
  EXPECT_EQ(vertical("b.AT2", at2("DWN")), down);
  EXPECT_EQ(vertical("CPEDWN.AT2", at2("UP")), up);
  EXPECT_EQ(vertical("CPEDWN.csv", one_column), down);
  EXPECT_EQ(vertical("CPE-down.csv", one_column), down);
  EXPECT_EQ(vertical("CPE-UP.csv", one_column), up);
  EXPECT_EQ(samples(read_record(folder_ / "b.AT2")), up) << "as it stands, where it is read by itself";
}

TEST_F(VerticalSign, OfAFileWithSeveralChannelsAVerticalOneIsNotTakenForHorizontal) {
  const auto both =
      write("both.csv", "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n0,1,4\n1,2,5\n2,3,6\n");
  EXPECT_EQ(samples(read_record(both, {.component = Component::horizontal})), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(samples(read_record(both, {.component = Component::vertical})), (std::vector<double>{4, 5, 6}));
  expect_data_error(both, 0, "channel vertical is vertical",
                    {.channel = "vertical", .component = Component::horizontal});
  const auto one = write("one.csv", "time_s,floor_acceleration_mps2\n0,7\n1,8\n2,9\n");
  EXPECT_EQ(samples(read_record(one, {.vertical_file = both.string()}), Channel::vertical),
            (std::vector<double>{4, 5, 6}));
}

}  // namespace
}  // namespace freestand::motion
