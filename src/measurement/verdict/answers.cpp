#include "measurement/verdict/answers.hpp"

#include <algorithm>

namespace freestand::measurement {

const Chance* answer(const Diagnosis& d, const std::string& question, const std::string& about) {
  const auto found = std::find_if(d.chances.begin(), d.chances.end(),
                                  [&](const Chance& c) { return c.question == question && c.about == about; });
  return found == d.chances.end() ? nullptr : &*found;
}

bool is_chance(Diagnosis& d, const char* question, const std::string& about, const std::function<Chance()>& ask) {
  if (const Chance* known = answer(d, question, about)) return known->chance();
  d.chances.push_back(ask());
  d.chances.back().about = about;
  return d.chances.back().chance();
}

const Chance* help_of(const Diagnosis& d) {
  const auto found =
      std::find_if(d.chances.begin(), d.chances.end(), [](const Chance& c) { return c.question == help_question; });
  return found == d.chances.end() ? nullptr : &*found;
}

}  // namespace freestand::measurement
