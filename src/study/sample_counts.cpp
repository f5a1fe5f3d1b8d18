#include "study/sample_counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <utility>

#include "base/random.hpp"
#include "io/tally_file.hpp"

namespace freestand::study {

std::int64_t kept_samples(const Study& study, std::int64_t samples) {
  const auto one_in = static_cast<std::int64_t>(study.keep.one_in);
  const std::int64_t wanted = one_in == 0 ? 0 : (samples - 1) / one_in + 1;
  return std::min(samples, std::max(wanted, bin_layout_samples));
}

std::string counts_fingerprint(const Study& study) {
  Study counted = study;
  const FragilityPart whatever;  // what is done with the counts
  counted.fragility.resamples = whatever.resamples;
  counted.fragility.confidence = whatever.confidence;
  counted.fragility.false_discovery = whatever.false_discovery;
  counted.fragility.adequate = whatever.adequate;
  counted.fragility.empirical_fallback = whatever.empirical_fallback;
  return fmt::format("{:016x}", random::stable_hash(fingerprint(counted) + io::tally_format));
}

SampleCounts::SampleCounts(const Study& study, const Target& target, const std::vector<int>& motion_group,
                           const MotionSummaries& summaries, Table first)
    : intensity_(study.fragility.im, summaries),
      demands_(study, target, fragility_options(study, target, intensity_.beside(std::move(first)), motion_group)),
      ranking_(study, target, motion_group, summaries),
      demand_words_(demands_.words().size()),
      size_(demand_words_ + ranking_.words().size()) {}

void SampleCounts::add(Table rows, std::int64_t first, bool alike) {
  if (alike) ranking_.add(rows, first);
  demands_.add(intensity_.beside(std::move(rows)), static_cast<std::uint64_t>(first));
}

parallel::Words SampleCounts::take() {
  parallel::Words words = demands_.words();
  const parallel::Words ranking = ranking_.words();
  words.insert(words.end(), ranking.begin(), ranking.end());
  demands_.clear();
  ranking_.clear();
  return words;
}

parallel::Words SampleCounts::normal(const parallel::Words& added) const {
  parallel::Words words = demands_.normal(std::span(added).first(demand_words_));
  const parallel::Words ranking = ranking_.normal(std::span(added).subspan(demand_words_));
  words.insert(words.end(), ranking.begin(), ranking.end());
  return words;
}

fragility::Result SampleCounts::result(const parallel::Words& words, const Jobs& jobs) const {
  if (words.size() != size_)
    throw Error(
        fmt::format("the counts of this sweep cannot be read ({} words, not {}): sweep again", words.size(), size_),
        Exit::data);
  return demands_.result(std::span(words).first(demand_words_), jobs);
}

Ranking SampleCounts::ranking(const parallel::Words& words, std::int64_t alike, std::int64_t swept) const {
  return ranking_.ranking(std::span(words).subspan(demand_words_), alike, swept);
}

}  // namespace freestand::study
