// Forms of laws that a diagnosis proposes: each is a study's effect as it is written out.
#include "study/law_forms.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "formula/formula.hpp"
#include "study/read_validation.hpp"

namespace freestand::study {
namespace {

TEST(LawForms, EachEntryIsReadAsAnEffectWithItsNumbersFree) {
  std::set<std::string> names;
  for (const LawForm& form : law_forms()) {
    std::vector<double> values;
    for (const auto& p : form.effect.parameters) values.push_back(0.5 * (p.low + p.high));
    const std::string text = fmt::format(
        "measurements: dataset.yaml\nmodel:\n  friction: {{mu: 0.2}}\n  effects:\n    - {}", entry_of(form, values));
    const Validation study = parse_validation(text, "study.yaml");
    ASSERT_EQ(study.model.effects.size(), 1u) << text;
    EXPECT_EQ(study.model.effects[0].name, form.effect.name);
    EXPECT_EQ(study.model.effects[0].parameters.size(), form.effect.parameters.size());
    EXPECT_TRUE(names.insert(form.effect.name).second) << form.effect.name;
  }
}

std::string friction_in(const std::string& entry) {
  const std::string key = "friction: \"";
  const std::size_t from = entry.find(key) + key.size();
  return entry.substr(from, entry.find('"', from) - from);
}

// Measured to 0.03 m a friction that falls by 18 a metre is right there, and turns round at 0.055 m: a slip beyond it had no motion at all.
TEST(LawForms, FrictionOfAnEntryEndsAtZero) {
  const auto& all = law_forms();
  const auto named = [&](const std::string& name) {
    return *std::find_if(all.begin(), all.end(), [&](const LawForm& f) { return f.effect.name == name; });
  };
  const formula::Formula one(friction_in(entry_of(named("law_of_position"), {-18})), {"a"});
  EXPECT_NEAR(one.value({0.03, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0}, 0.2, {-18}), 0.2 * 0.46, 1e-15);
  EXPECT_EQ(one.value({0.06, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0}, 0.2, {-18}), 0);
  const LawForm two = together({named("law_of_position"), named("law_of_time")});
  const formula::Formula both(friction_in(entry_of(two, {-18, -0.1})), {"a", "d"});
  EXPECT_NEAR(both.value({0.03, 0, 0, 0, 5, 0, 1, 0, 1, 0, 0}, 0.2, {-18, -0.1}), 0.2 * 0.46 * 0.5, 1e-15);
  EXPECT_EQ(both.value({0.06, 0, 0, 0, 20, 0, 1, 0, 1, 0, 0}, 0.2, {-18, -0.1}), 0);
  EXPECT_EQ(friction_in(entry_of(named("healing_at_rest"), {0.3, 0.1})), named("healing_at_rest").friction());
}

// Over its own variable every law is what its formula says by hand.
TEST(LawForms, TheLawOverItsVariable) {
  const auto& all = law_forms();
  const auto named = [&](const std::string& name) {
    return *std::find_if(all.begin(), all.end(), [&](const LawForm& f) { return f.effect.name == name; });
  };
  EXPECT_NEAR(law_at(named("law_of_time"), {2}, 0.2, {0.1})[0], 0.2 * 1.2, 1e-15);
  EXPECT_NEAR(law_at(named("law_of_normal_force"), {1.5}, 0.2, {-0.4})[0], 0.2 * 0.8, 1e-15);
  EXPECT_NEAR(law_at(named("law_of_path"), {0.5}, 0.2, {1})[0], 0.3, 1e-15);
  EXPECT_NEAR(law_at(named("law_of_speed"), {0.5}, 0.2, {1, -2})[0], 0.2, 1e-15);
  EXPECT_NEAR(law_at(named("quadratic_drag"), {-0.5}, 0.2, {3})[0], 0.75, 1e-15);
  EXPECT_NEAR(law_at(named("healing_at_rest"), {std::exp(1.0) - 1}, 0.2, {0.3, 1})[0], 0.26, 1e-15);
  EXPECT_NEAR(law_at(named("waves_over_position"), {0.025}, 0.2, {0.5, 0.1, 0.1})[0], 0.3, 1e-12);
}

// Two of them in one entry, with the numbers of both, is what they are one after the other: factors multiply, forces add.
TEST(LawForms, TwoTogetherAreOneLaw) {
  const auto& all = law_forms();
  for (const LawForm& one : all)
    for (const LawForm& other : all) {
      if (one.variable == other.variable) continue;
      const LawForm both = together({one, other});
      std::set<std::string> names;
      std::vector<double> values;
      for (const auto& p : both.effect.parameters) {
        EXPECT_TRUE(names.insert(p.name).second) << p.name << " of " << both.effect.name;
        values.push_back(0.5 * (p.low + p.high));
      }
      const std::string text = fmt::format(
          "measurements: dataset.yaml\nmodel:\n  friction: {{mu: 0.2}}\n  effects:\n    - {}", entry_of(both, values));
      const Validation study = parse_validation(text, "study.yaml");
      ASSERT_EQ(study.model.effects.size(), 1u) << text;
      const std::vector<std::string> known(names.begin(), names.end());
      std::vector<double> sorted;
      for (const std::string& name : known)
        for (std::size_t i = 0; i < values.size(); ++i)
          if (both.effect.parameters[i].name == name) sorted.push_back(values[i]);
      const formula::Inputs at = {0.03, 0.2, 0, 0, 1.5, 0.3, 1.1, 0, 1, 0.2, 0.4};
      const auto value = [&](const std::string& text, double without) {
        return text.empty() ? without : formula::Formula(text, known).value(at, 0.2, sorted);
      };
      EXPECT_NEAR(value(both.friction(), 0.2), value(one.friction(), 0.2) * value(other.friction(), 0.2) / 0.2, 1e-12);
      EXPECT_NEAR(value(both.force, 0), value(one.force, 0) + value(other.force, 0), 1e-12);
    }
}

// Numbers to be calibrated hold the value that was found, within what is allowed.
TEST(LawForms, RangesHoldTheValueFound) {
  for (const LawForm& form : law_forms()) {
    std::vector<double> low, high;
    for (const auto& p : form.effect.parameters) {
      EXPECT_LT(p.lower, p.low) << p.name;
      EXPECT_LT(p.low, p.high) << p.name;
      ASSERT_TRUE(p.neutral) << p.name;
      low.push_back(p.low), high.push_back(p.high);
    }
    EXPECT_NE(entry_of(form, low), entry_of(form, high));
  }
}

}  // namespace
}  // namespace freestand::study
