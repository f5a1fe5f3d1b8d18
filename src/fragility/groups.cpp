#include "fragility/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <map>

#include "base/random.hpp"
#include "fragility/leave_out_groups.hpp"

namespace freestand::fragility {
namespace {

// What joining groups costs: from G of them a standard error is known to 1/sqrt(2 (G - 1)), and Student's t makes a 95 % interval wider
// than the normal one. Of 256 that is 4.4 % and 0.5 %, of 128 6.3 % and 1 %: less than the two digits that are told. The tally holds every
// count once a group, so that twice as many would double its memory and the time of a fit.
constexpr int most_record_groups = 256;
constexpr int hashed_group_count = 128;

}  // namespace

MotionGroups::MotionGroups(const Options& options) : scrambles_(static_cast<std::uint64_t>(options.scrambles)) {
  const std::vector<int>& given = options.motion_group;
  std::map<int, int> number;  // of each group, in the order of first mention
  for (const int group : given)
    if (group >= 0) number.try_emplace(group, static_cast<int>(number.size()));
  records_ = static_cast<int>(number.size());
  const bool lone = records_ == 1;
  record_groups_ = lone ? 0 : std::min(records_, most_record_groups);
  for (const int group : given)
    record_group_.push_back(group >= 0 && !lone ? number.at(group) % most_record_groups : -1);
  const bool pulses = std::any_of(given.begin(), given.end(), [](int group) { return group < 0; });
  if (lone || pulses || given.empty()) hashed_groups_ = scrambles_ > 1 ? options.scrambles : hashed_group_count;
}

int MotionGroups::group(int motion, std::uint64_t sample) const {
  if (!record_group_.empty()) {
    if (motion < 0 || motion >= static_cast<int>(record_group_.size()))
      throw Error(fmt::format("sample {} names motion {} (the study has {}): the samples belong to another study",
                              sample, motion, record_group_.size()),
                  Exit::data);
    const int record = record_group_[static_cast<std::size_t>(motion)];
    if (record >= 0) return record;
  }
  if (scrambles_ > 1) return record_groups_ + static_cast<int>(sample % scrambles_);
  return record_groups_ + static_cast<int>(random::mix(sample + 0x9e3779b97f4a7c15ULL) % hashed_group_count);
}

Resampling::Resampling(const MotionGroups& groups, const std::vector<bool>& has_samples, int resamples,
                       std::uint64_t seed)
    : weight_(Eigen::MatrixXd::Zero(resamples, groups.count())) {
  leave_out(groups, has_samples);
  const std::uint64_t stream = random::stable_hash("fragility/motions");
  const int borders[] = {0, groups.record_groups(), groups.count()};
  for (int stratum = 0; stratum < 2; ++stratum) {
    std::vector<int> there;
    for (int g = borders[stratum]; g < borders[stratum + 1]; ++g)
      if (has_samples[static_cast<std::size_t>(g)]) there.push_back(g);
    for (int r = 0; r < resamples; ++r)
      for (std::size_t k = 0; k < there.size(); ++k) {
        const std::uint64_t counter = (static_cast<std::uint64_t>(r) << 20) + k;
        const double u = random::uniform(seed, counter, stream + static_cast<std::uint64_t>(stratum));
        weight_(r, there[static_cast<std::size_t>(u * static_cast<double>(there.size()))]) += 1;
      }
  }
}

void Resampling::leave_out(const MotionGroups& groups, const std::vector<bool>& has_samples) {
  const LeaveOutGroups together(groups);
  std::vector<Eigen::Index> members(static_cast<std::size_t>(together.count()), 0);
  Eigen::Index in_stratum[2] = {0, 0};
  const auto of = [&](int g) { return static_cast<std::size_t>(together.of(g)); };
  const auto there = [&](int g) { return has_samples[static_cast<std::size_t>(g)]; };
  for (int g = 0; g < groups.count(); ++g)
    if (there(g)) {
      ++members[of(g)];
      ++in_stratum[together.stratum(together.of(g))];
    }
  std::vector<Eigen::RowVectorXd> rows;
  for (int out = 0; out < together.count(); ++out) {
    const int stratum = together.stratum(out);
    const Eigen::Index all = in_stratum[stratum], gone = members[static_cast<std::size_t>(out)];
    if (gone == 0 || gone == all) continue;
    const double others = static_cast<double>(all) / static_cast<double>(all - gone);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(groups.count());
    for (int g = 0; g < groups.count(); ++g) {
      const int part = together.of(g);
      if (there(g)) row(g) = part == out ? 0 : together.stratum(part) == stratum ? others : 1;
    }
    rows.push_back(std::move(row));
    if (stratum == 0) ++left_out_records_;
  }
  left_out_.resize(static_cast<Eigen::Index>(rows.size()), groups.count());
  for (std::size_t i = 0; i < rows.size(); ++i) left_out_.row(static_cast<Eigen::Index>(i)) = rows[i];
}

}  // namespace freestand::fragility
