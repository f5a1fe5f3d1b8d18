#include "measurement/verdict/meets_all.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "measurement/levels.hpp"

namespace freestand::measurement {

std::string meets_all_tests(const Diagnosis& d, const std::function<bool(const Candidate&)>& enough) {
  if (d.verdict != Verdict::unknown) return {};
  const auto before = [](const Candidate& a, const Candidate& b) {
    return std::pair(a.fit.x.size(), a.misfit_of_fit) < std::pair(b.fit.x.size(), b.misfit_of_fit);
  };
  const Candidate* found = nullptr;
  for (const Candidate& c : d.candidates)
    if (c.visible && !c.laboratory && c.fit.left_out_refitted && c.explained > adequate &&
        c.misfit_of_fit < d.base.misfit_of_fit && (!found || before(c, *found)) && enough(c))
      found = &c;
  if (!found) return {};
  return fmt::format(
      "{} meets all tests together as closely as noise lets it, but those left out are missed by {:.3g} (by {:.3g} "
      "without it), the "
      "floor's noise allowed for: so few tests do not fix its numbers; add tests, or give its numbers the ranges that "
      "are known",
      fmt::join(found->effects, " with "), found->explained, d.base.explained);
}

}  // namespace freestand::measurement
