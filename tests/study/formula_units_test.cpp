// Parameters of a law that a study writes as a formula: their units, and by which names the formula knows them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_text.hpp"

namespace freestand::study::formula_units_test {
namespace {

using namespace test;
using testing::HasSubstr;

std::string told(const std::string& force, const std::string& parameter) {
  return problems(block + friction + motions + fragility + samples + "effects:\n  - {name: own, force: \"" + force +
                  "\", parameters: {" + parameter + ": 2}}\n");
}

TEST(FormulaUnits, OfOtherSystemsAreRefused) {
  for (const char* parameter : {"c_mm", "c_g", "c_deg", "c_ms", "c_ft"})
    EXPECT_THAT(told("-c*v", parameter),
                HasSubstr(std::string("parameter ") + parameter + " of effect own has a unit"));
  for (const char* parameter : {"c", "c_m", "c_hz", "c_hzps", "c_mps2", "c_rad", "c_kg"})
    EXPECT_EQ(told("-c*v", parameter), "");
}

TEST(FormulaUnits, AreLeftOutInTheFormula) {
  for (const char* force : {"-rate*v", "-rate_per*v", "-rate_per_s*v"}) EXPECT_EQ(told(force, "rate_per_s"), "");
  EXPECT_THAT(told("-speed_loss*v", "rate_per_s"),
              HasSubstr("is not known here, character 2; its parameters are rate"));
}

}  // namespace
}  // namespace freestand::study::formula_units_test
