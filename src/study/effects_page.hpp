// The catalogue of effects for people and for programs: what `freestand effects` prints, all of it from the declarations.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "dynamics/effect.hpp"
#include "study/study.hpp"

namespace freestand::study {

// One line an effect.
std::string effects_list();

// Law, parameters with units and bounds, source, when to suspect it, what it is mistaken for, and how a study names it.
std::string effect_page(const dynamics::Effect&);

// {name, summary, law, source, suspect, twins, excludes, parameters: [{name, unit, summary, lower, upper, neutral,
// default, low, high}]}; null where there is no such number.
nlohmann::ordered_json effect_json(const dynamics::Effect&);

// The effects of a study, for its results: [{name, summary, law, source, parameters: [{name, unit, summary, value}]}];
// value as the study has it, a number or a distribution.
nlohmann::ordered_json effects_json(const Study&);

}  // namespace freestand::study
