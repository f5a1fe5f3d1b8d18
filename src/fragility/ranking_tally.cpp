#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <map>

#include "base/random.hpp"
#include "fragility/ranking.hpp"

namespace freestand::fragility {
namespace {

constexpr double ln_first = -9.3, ln_step = 0.04;  // 1e-4 to 8e2, in any unit

std::size_t cell_of(double im) {
  if (!(im > 0)) return 0;
  const double place = 1 + (std::log(im) - ln_first) / ln_step;
  return static_cast<std::size_t>(std::clamp(place, 1.0, static_cast<double>(RankingTally::cells - 1)));
}

}  // namespace

RankingTally::RankingTally(RankingOptions options) : options_(std::move(options)) {
  std::map<int, int> number;  // of each group, in the order of first mention
  for (const int group : options_.motion_group) {
    if (group >= 0) number.try_emplace(group, static_cast<int>(number.size()));
    unit_.push_back(group >= 0 ? number.at(group) : -1);
  }
  records_ = number.size();
  units_ = records_ + folds;
  const std::size_t pairs = options_.edps.size() * (options_.ims.size() + 1);
  first_.resize(pairs * units_);
  second_.resize(pairs * folds);
  with_period_.resize(pairs);
  std::size_t binary = 0;
  for (const RankedEdp& edp : options_.edps) binary_.push_back(edp.binary ? binary++ : 0);
  cell_.resize(binary * options_.ims.size() * folds * cells);
}

std::size_t RankingTally::unit_of_motion(std::size_t motion) const {
  return static_cast<std::size_t>(unit_.at(motion));
}

void RankingTally::add(const RankedSample& sample) {
  if (sample.motion < 0 || sample.motion >= static_cast<int>(unit_.size()) || sample.im.size() != options_.ims.size() ||
      sample.edp.size() != options_.edps.size())
    throw Error(
        "a sample cannot be ranked (its motion, intensities or demands are not those of the options): pass one "
        "of each",
        Exit::data);
  const int record = unit_[static_cast<std::size_t>(sample.motion)];
  const bool of_pulse = record < 0;
  const std::size_t hashed = random::mix(sample.index + 0x9e3779b97f4a7c15ULL) % folds;
  const std::size_t unit = of_pulse ? records_ + hashed : static_cast<std::size_t>(record);
  for (std::size_t e = 0; e < options_.edps.size(); ++e) add_edp(e, unit, of_pulse, sample);
}

void RankingTally::add_edp(std::size_t e, std::size_t unit, bool of_pulse, const RankedSample& sample) {
  const RankedEdp& edp = options_.edps[e];
  const double value = sample.edp[e];
  const std::size_t fold = fold_of_unit(unit), count = options_.ims.size();
  if (edp.binary) {
    if (!std::isfinite(value)) return;
    for (std::size_t k = 0; k < count; ++k) {
      Cell& cell = cell_[((binary_[e] * count + k) * folds + fold) * cells + cell_of(sample.im[k])];
      ++cell.n;
      cell.hits += value > 0.5;
    }
    return;
  }
  if ((sample.overturned && edp.censored) || !std::isfinite(value) || !(value > edp.still_threshold)) return;
  const double y = std::log(value), z = of_pulse ? std::log(sample.pulse_period_s) : 0;
  for (std::size_t k = 0; k <= count; ++k) {
    const double im = k < count ? sample.im[k] : 1;
    if (!(im > 0) || !std::isfinite(im)) continue;
    const double x = std::log(im);
    const std::size_t pair = pair_of(e, k);
    First& first = first_[pair * units_ + unit];
    ++first.n;
    first.x.add(x);
    first.y.add(y);
    Second& second = second_[pair * folds + fold];
    second.xx.add(x * x);
    second.xy.add(x * y);
    second.yy.add(y * y);
    if (!of_pulse) continue;
    WithPeriod& sums = with_period_[pair];
    ++sums.n;
    ExactSum* const of[] = {&sums.x, &sums.y, &sums.z, &sums.xz, &sums.yz, &sums.zz, &sums.xx, &sums.xy, &sums.yy};
    const double terms[] = {x, y, z, x * z, y * z, z * z, x * x, x * y, y * y};
    for (std::size_t i = 0; i < std::size(terms); ++i) of[i]->add(terms[i]);
  }
}

const RankingTally::First& RankingTally::first(std::size_t edp, std::size_t im, std::size_t unit) const {
  return first_[pair_of(edp, im) * units_ + unit];
}
const RankingTally::Second& RankingTally::second(std::size_t edp, std::size_t im, std::size_t fold) const {
  return second_[pair_of(edp, im) * folds + fold];
}
const RankingTally::WithPeriod& RankingTally::with_period(std::size_t edp, std::size_t im) const {
  return with_period_[pair_of(edp, im)];
}
const RankingTally::Cell& RankingTally::cell(std::size_t edp, std::size_t im, std::size_t fold, std::size_t i) const {
  return cell_[((binary_[edp] * options_.ims.size() + im) * folds + fold) * cells + i];
}
double RankingTally::im_of_cell(std::size_t i) {
  return i == 0 ? 0 : std::exp(ln_first + ln_step * (static_cast<double>(i) - 0.5));
}

namespace {

// Every number of the tally in one order, for `visit(count)` and `visit(sum)`. The lower half of a sum travels as two words
// of 32 bits, so that words of up to 2^31 ranks may be added.
void each(auto& first, auto& second, auto& with_period, auto& cell, const auto& visit) {
  for (auto& f : first) {
    visit(f.n);
    for (auto* sum : {&f.x, &f.y}) visit(*sum);
  }
  for (auto& s : second)
    for (auto* sum : {&s.xx, &s.xy, &s.yy}) visit(*sum);
  for (auto& w : with_period) {
    visit(w.n);
    for (auto* sum : {&w.x, &w.y, &w.z, &w.xz, &w.yz, &w.zz, &w.xx, &w.xy, &w.yy}) visit(*sum);
  }
  for (auto& c : cell) {
    visit(c.n);
    visit(c.hits);
  }
}

}  // namespace

std::vector<std::int64_t> RankingTally::words() const {
  std::vector<std::int64_t> words;
  each(first_, second_, with_period_, cell_, [&](const auto& value) {
    if constexpr (requires { value.high(); }) {
      words.push_back(value.high());
      words.push_back(static_cast<std::int64_t>(value.low() >> 32));
      words.push_back(static_cast<std::int64_t>(value.low() & 0xffffffffU));
    } else {
      words.push_back(value);
    }
  });
  return words;
}

RankingTally RankingTally::from_words(RankingOptions options, std::span<const std::int64_t> words) {
  RankingTally tally(std::move(options));
  std::size_t at = 0;
  const auto next = [&] {
    if (at >= words.size())
      throw Error("a ranking cannot be read (too few words): rank with the same options", Exit::data);
    return words[at++];
  };
  each(tally.first_, tally.second_, tally.with_period_, tally.cell_, [&](auto& value) {
    if constexpr (requires { value.high(); }) {
      const std::int64_t high = next();
      const auto middle = static_cast<std::uint64_t>(next()), low = static_cast<std::uint64_t>(next());
      const std::uint64_t carried = middle + (low >> 32);
      value =
          ExactSum::from_words(high + static_cast<std::int64_t>(carried >> 32), (carried << 32) | (low & 0xffffffffU));
    } else {
      value = next();
    }
  });
  return tally;
}

}  // namespace freestand::fragility
