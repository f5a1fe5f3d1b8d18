// The cases that are judged: one specimen with one or two effects on one floor, each a pure function of (seed, number).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hidden_effect/generator.hpp"

namespace freestand::test {

// How the block is made to move, beside its effects.
enum class Setting {
  slide,       // model slide
  rock,        // model rock
  slide_rock,  // model slide_rock
  thrown,      // the floor shakes vertically as well, strongly enough to throw the block up; any model
  on_a_slope,  // floor_tilt as well; any model
  bouc_wen     // model bouc_wen; thrown up or on a slope by chance
};
inline constexpr int rigid_setting_count = 5, setting_count = 6;
const char* name(Setting setting);

// The catalogue and the chain, and the laws that the generator knows beside them.
const std::vector<std::string>& judged_effects();
bool outside_catalogue(const std::string& effect);

// What a case is drawn from: the effects that it is about, and its setting.
struct Recipe {
  std::vector<std::string> effects;
  Setting setting = Setting::slide_rock;
};

// What the block stands on, and laws of no catalogue on a rigid contact, which studies write as formulas. Each family has recipes and
// numbers of its own.
enum class Family { rigid, bouc_wen, formulas };

// Every effect alone in every setting that it goes with, then every pair of effects that go together (slack_tether and
// wall_impact with themselves too, one a side); the settings of pairs take turns. On a Bouc-Wen contact there is one setting. Of formulas:
// each law of no catalogue alone, and with every other effect.
std::vector<Recipe> recipes(Family family = Family::rigid);

struct JudgedCase {
  std::uint64_t seed = 0, number = 0;
  Family family = Family::rigid;
  Recipe recipe;
  Truth truth;
  FloorSamples floor;
  std::string text() const;  // one line that describes the case, for messages
};

// Number `number` is of recipe number mod recipes().size(), a pair in the next setting each time that its turn comes.
JudgedCase judged_case(std::uint64_t seed, std::uint64_t number, Family family = Family::rigid);

}  // namespace freestand::test
