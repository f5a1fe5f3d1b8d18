#include <freestand/response.hpp>

namespace freestand {

const char* name(Mode mode) {
  constexpr const char* names[] = {"rest", "slide", "rock", "slide_rock", "flight", "overturned"};
  return names[static_cast<int>(mode)];
}

const char* name(Outcome outcome) {
  constexpr const char* names[] = {"at_rest", "moved", "overturned", "painleve", "step_limit", "not_finite"};
  return names[static_cast<int>(outcome)];
}

const char* failure(Outcome outcome) {
  constexpr const char* words[] = {"",
                                   "",
                                   "",
                                   "no motion agrees with the contact forces, as in Painleve's paradox, or walls hold "
                                   "up a block whose floor falls away",
                                   "more steps than allowed",
                                   "the motion grows beyond all bounds, or a law gives no finite number"};
  return words[static_cast<int>(outcome)];
}

}  // namespace freestand
