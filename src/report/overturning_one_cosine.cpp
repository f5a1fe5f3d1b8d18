// Overturning of a block p = 1.25 rad/s, alpha = 0.16 under one-cosine pulses.
#include "report/overturning.hpp"

namespace freestand::report {
namespace {

Item overturning_one_cosine(const Sources& sources) {
  return spectrum_item(sources, "overturning_one_cosine", "B", "one-cosine pulses", "");
}

const RegisteredItem overturning_one_cosine_here{
    {.name = "overturning_one_cosine",
     .order = 630,
     .chapter = 6,
     .place = "Figures 6.4 to 6.6",
     .what = "overturning of a block p = 1.25 rad/s, α = 0.16 under one-cosine pulses",
     .compute = overturning_one_cosine}};

}  // namespace
}  // namespace freestand::report
