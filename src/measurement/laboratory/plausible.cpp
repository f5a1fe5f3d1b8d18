#include "measurement/laboratory/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/shown_text.hpp"
#include "base/units.hpp"
#include "measurement/data/floor_readings.hpp"
#include "measurement/data/ground.hpp"
#include "measurement/data/smooth.hpp"
#include "measurement/laboratory/plausible_channels.hpp"
#include "measurement/laboratory/plausible_offsets.hpp"
#include "measurement/levels.hpp"
#include "measurement/noise/quiet.hpp"
#include "measurement/noise/third_differences.hpp"
#include "measurement/predict/score.hpp"

namespace freestand::measurement {
namespace {

constexpr double longest_size_m = 50, longest_slip_m = 5, largest_rotation_rad = 1.8, longest_step_s = 0.1;
constexpr double strongest_floor_g = 10, weakest_floor_g = 0.02;
constexpr double strangely_fast = 1.5, impossibly_fast = 3;  // slip speed, in the range of the floor's velocity

std::vector<double> floor_samples(const Test& test) {
  std::vector<double> samples = readings_of(test).horizontal_mps2;
  for (double& a : samples) a *= test.scale;
  return samples;
}

class Doubter {
 public:
  explicit Doubter(const Bench& bench) : bench_(bench), without_slip_(floor_without_slip_mps2(bench.data())) {}

  Doubts all() {
    for (std::size_t i = 0; i < bench_.size(); ++i) {
      const Test& test = bench_.test(i);
      sizes(test);
      response(test);
      if (test.pulse.empty()) floor(test);
      if (test.pulse.empty() && cut_off(floor_samples(test), bench_.floor_noise_mps2(i))) {
        out_.spoilt_tests += test.role == Role::calibration;
        say("the floor's channel of test {} stays at its extreme value for several samples: the sensor looks clipped",
            test.id);
      }
      offsets(i);
      channels(i);
      if (test.start.upright_at_rest() &&
          (moves_before_floor(bench_, i, Channel::slip) || moves_before_floor(bench_, i, Channel::rotation)))
        early_.add(test, 0);
    }
    tell();
    columns();
    for (const Channel channel : {Channel::slip, Channel::rotation}) noise(channel);
    return std::move(out_);
  }

 private:
  template <class... T>
  void say(fmt::format_string<T...> text, T&&... values) {
    out_.sentences.push_back(fmt::format(text, std::forward<T>(values)...));
  }

  // Once for the specimen that the tests share.
  void sizes(const Test& test) {
    const auto size = [&](const char* key, const std::optional<double>& value) {
      if (!value || *value <= longest_size_m) return;
      const std::string sentence =
          fmt::format("the specimen's {} is {:.4g}: is it in metres? The model takes it as it stands", key, *value);
      if (std::find(out_.sentences.begin(), out_.sentences.end(), sentence) == out_.sentences.end())
        out_.sentences.push_back(sentence);
    };
    size("width_m", test.specimen.width_m);
    size("height_m", test.specimen.height_m);
  }

  void response(const Test& test) {
    const double peak = test.peaks.peak_slip_m.value_or(0), remains = std::abs(test.peaks.residual_slip_m.value_or(0));
    const double slip = std::max({greatest(test.slip_m), peak, remains});
    // Of two readings of one sensor.
    if (test.peaks.peak_slip_m && remains > peak + 3 * std::numbers::sqrt2 * bench_.noise(Channel::slip))
      remaining_.add(test, remains - peak);
    const double rotation = std::max(greatest(test.rotation_rad), test.peaks.peak_rotation_rad.value_or(0));
    if (test.has_history() && test.dt_s > longest_step_s) steps_.add(test, test.dt_s);
    if (slip > longest_slip_m) slips_.add(test, slip);
    if (rotation > largest_rotation_rad) rotations_.add(test, rotation);
  }

  // Friction of any law takes the block's velocity towards the floor's, so that it stays among those that the floor has
  // had: a slip is at most as fast as they differ. Springs in tune with the floor, and slopes, may make it faster, though
  // not many times.
  bool faster(const Test& test, bool rotated, double times) const {
    if (test.slip_m.empty() || rotated) return false;
    constexpr double half_window_s = 0.04;
    const std::vector<double> floor = smooth(floor_displacement(test), test.dt_s, half_window_s).rate;
    const auto [least, most] = std::minmax_element(floor.begin(), floor.end());
    const double noise = bench_.noise(Channel::slip) * rate_noise(test.dt_s, half_window_s);
    return greatest(smooth(test.slip_m, test.dt_s, half_window_s).rate) > times * (*most - *least) + 8 * noise;
  }

  void floor(const Test& test) {
    const double peak_g = greatest(floor_samples(test)) / standard_gravity_mps2;
    const bool rotated = greatest(test.rotation_rad) > 8 * bench_.noise(Channel::rotation);
    const bool moved = rotated || greatest(test.slip_m) > 8 * bench_.noise(Channel::slip);
    if (peak_g > strongest_floor_g)
      strong_.add(test, peak_g);
    else if (!test.start.upright_at_rest())
      return;
    else if (moved && (peak_g < weakest_floor_g || faster(test, rotated, impossibly_fast)))
      weak_.add(test, peak_g);
    else if (moved && faster(test, rotated, strangely_fast))
      fast_.push_back(test.id);
  }

  void offsets(std::size_t i) {
    const Test& test = bench_.test(i);
    bool spoilt = false;
    const auto see = [&](Seen& seen, double offset, double least) {
      if (offset == 0) return;
      seen.add(test, std::abs(offset));
      spoilt |= std::abs(offset) > least;
    };
    if (test.start.upright_at_rest()) {
      see(late_slips_, start_offset(bench_, i, Channel::slip), 8 * bench_.noise(Channel::slip));
      see(late_rotations_, start_offset(bench_, i, Channel::rotation), 8 * bench_.noise(Channel::rotation));
    }
    const std::vector<double> floor = test.pulse.empty() ? floor_samples(test) : std::vector<double>{};
    see(floors_, floor_offset_mps2(floor), 0.02 * greatest(floor));
    out_.spoilt_tests += spoilt && test.role == Role::calibration;
  }

  void channels(std::size_t i) {
    const Test& test = bench_.test(i);
    // As one of the tests before that one, or of all others.
    const auto same = [&](std::size_t before, Seen& seen, const auto& alike) {
      for (std::size_t other = 0; other < before; ++other)
        if (other != i && alike(other)) return seen.add(test, 0);
    };
    for (int c = 0; c < channel_count; ++c) {
      const auto channel = static_cast<Channel>(c);
      if (const double frozen = frozen_s(bench_, i, channel); frozen > 0) frozen_[c].add(test, frozen);
      same(bench_.size(), copied_[c], [&](std::size_t other) { return same_history(bench_, i, other, channel); });
    }
    same(bench_.size(), same_floors_, [&](std::size_t other) { return same_floor(bench_, i, other); });
    same(i, same_peaks_, [&](std::size_t other) { return same_peaks(bench_, i, other); });
    if (test.start.upright_at_rest() && turns_against_floor(bench_, i)) turned_.add(test, 0);
    const double share = share_of_floor(bench_, {i}, without_slip_).value;
    if (share != 0 && !is_nearest_to_one(share)) shares_.add(test, share);
  }

  // Of what is met where a sign or a unit is mistaken: in g instead of m/s2, m/s2 taken as g, either turned round.
  static bool is_nearest_to_one(double share) {
    const double half_way = std::sqrt(standard_gravity_mps2);
    return share > 1 / half_way && share < half_way;
  }

  void tell() {
    const auto about = [&](const Seen& seen, const char* text, const char* question, bool spoils = true) {
      out_.spoilt_tests += spoils ? seen.calibration : 0;
      if (!seen.ids.empty())
        out_.sentences.push_back(fmt::format(fmt::runtime(text), fmt::join(seen.ids, ", "), seen.most) + question +
                                 held_out_note(bench_.data(), seen.ids));
    };
    about(steps_, "{} is sampled every {:.2g} s", ": is its time in seconds?");
    about(slips_, "the slip of {} reaches {:.3g} m", ": is slip_m in metres?");
    about(remaining_,
          "residual_slip_m of {} is {:.2g} m more than peak_slip_m, and no slip remains that was not reached",
          ": are the two columns the right way round?", false);
    about(rotations_, "the rotation of {} reaches {:.3g} rad", ": is rotation_rad in radians?");
    about(strong_, "the floor of {} reaches {:.3g} g", ": is floor_acceleration_mps2 in m/s2?");
    about(weak_, "the block of {} moves more than a floor that reaches {:.2g} g can make them",
          ": is floor_acceleration_mps2 in m/s2, and its sensor alive?");
    about(early_, "the block of {} moves before its floor does, or farther", ": check the clocks of the channels");
    constexpr const char* subtract =
        ": subtract its mean before the shaking, or begin the record before the block moves";
    about(late_slips_, "the slip of {} does not start at zero (up to {:.2g} m)", subtract, false);
    about(late_rotations_, "the rotation of {} does not start at zero (up to {:.2g} rad)", subtract, false);
    about(floors_, "the floor of {} is off zero before and after the shaking ({:.2g} m/s2)",
          ": subtract that from floor_acceleration_mps2, unless the floor is tilted", false);
    for (int c = 0; c < channel_count; ++c) {
      const std::string channel = name(static_cast<Channel>(c));
      about(frozen_[c],
            (channel + " of {} stays at one value for {:.2g} s, where its sensor's noise changes it").c_str(),
            ": did the recording stop?");
      about(copied_[c], (channel + " of {} is one and the same, sample by sample").c_str(),
            ": one file was taken for another");
    }
    about(same_peaks_, "the peaks of {} are those of an earlier test under the same floor, digit by digit",
          ": a copy would count twice", false);
    about(same_floors_,
          "the floor of {} is one and the same, sample by sample, which no sensor's noise lets come twice",
          ": one file was taken for another, or the noise stated for floor_acceleration_mps2 is not that of a motion "
          "that was "
          "commanded");
    about(turned_, "the rotation of {} looks mirrored: the floor turns the block the wrong way",
          ": rotation_rad is positive clockwise");
    about(shares_, "block_acceleration_mps2 of {} is {:.3g} times the floor's before anything moves",
          ": check its sign, and that it is in m/s2");
    const FloorShare share = share_of_floor(bench_, tests_of(bench_.data(), Role::calibration), without_slip_);
    if (share.value != 0 && is_nearest_to_one(share.value) &&
        std::abs(share.value - 1) > std::max(5 * share.error, fault_deviations * bench_.data().tolerance.floor_gain))
      say("block_acceleration_mps2 is {:.3g} times the floor's before anything moves: check its gain; or does the "
          "specimen sway on its "
          "feet?",
          share.value);
    if (!fast_.empty())
      say("the slip of {} is faster than the floor's velocities differ, which friction alone does not bring about: is "
          "floor_acceleration_mps2 in m/s2?",
          fmt::join(fast_, ", "));
  }

  // Columns that are not read, with the tests that have them.
  void columns() {
    std::vector<std::pair<std::string, std::vector<std::string>>> unused;
    for (std::size_t i = 0; i < bench_.size(); ++i)
      for (const std::string& name : bench_.test(i).unused_columns) {
        const auto same = std::find_if(unused.begin(), unused.end(), [&](const auto& c) { return c.first == name; });
        (same == unused.end() ? unused.emplace_back(name, std::vector<std::string>{}) : *same)
            .second.push_back(bench_.test(i).id);
      }
    for (const auto& [name, ids] : unused)
      say("column {} of {} {} is not used: it is none of those that a test may have", shown(name),
          ids.size() > 1 ? "tests" : "test", listed(ids));
  }

  void noise(Channel channel) {
    const double stated = bench_.noise(channel);
    std::vector<double> scatters;
    for (const std::size_t i : tests_of(bench_.data(), Role::calibration))
      if (const double s = sensor_noise(readings(bench_.test(i), channel)); s > 0) scatters.push_back(s);
    if (stated <= 0 || scatters.empty()) return;
    const auto middle = scatters.begin() + static_cast<long>(scatters.size() / 2);
    std::nth_element(scatters.begin(), middle, scatters.end());
    if (*middle > 3 * stated || *middle < 0.01 * stated)
      say("{} scatters by {:.2g} from sample to sample, where the data set states a noise of {:.2g}: errors in noise "
          "units are too {}; correct noise",
          name(channel), *middle, stated, *middle > stated ? "large" : "small");
  }

  struct Seen {
    std::vector<std::string> ids;
    std::size_t calibration = 0;  // of them
    double most = 0;
    void add(const Test& test, double value) {
      ids.push_back(test.id);
      calibration += test.role == Role::calibration;
      if (std::abs(value) > std::abs(most)) most = value;
    }
  };

  const Bench& bench_;
  const double without_slip_;
  Doubts out_;
  Seen steps_, slips_, remaining_, rotations_, strong_, weak_, early_, late_slips_, late_rotations_, floors_,
      same_floors_, same_peaks_, turned_, shares_;
  Seen frozen_[channel_count], copied_[channel_count];
  std::vector<std::string> fast_;
};

}  // namespace

std::string listed(const std::vector<std::string>& ids) {
  constexpr std::size_t most = 8;
  const std::string shown =
      fmt::format("{}", fmt::join(ids.begin(), ids.begin() + static_cast<long>(std::min(most, ids.size())), ", "));
  return ids.size() > most ? fmt::format("{} and {} more", shown, ids.size() - most) : shown;
}

std::string held_out_note(const Dataset& data, const std::vector<std::string>& ids) {
  std::vector<std::string> held_out;
  for (const std::size_t i : tests_of(data, Role::holdout))
    if (std::find(ids.begin(), ids.end(), data.tests[i].id) != ids.end()) held_out.push_back(data.tests[i].id);
  if (held_out.empty()) return "";
  return fmt::format(" ({} {} held out, which decides nothing here)", listed(held_out),
                     held_out.size() > 1 ? "are" : "is");
}

double greatest(const std::vector<double>& samples) {
  double most = 0;
  for (const double s : samples) most = std::max(most, std::abs(s));
  return most;
}

bool clipped(const std::vector<double>& samples, double noise) {
  if (samples.empty()) return false;
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
  for (const double extreme : {*least, *most}) {
    if (std::abs(extreme) < 10 * noise || *least == *most) continue;
    int run = 0, longest = 0;
    for (const double s : samples) longest = std::max(longest, run = s == extreme ? run + 1 : 0);
    if (longest >= 5) return true;
  }
  return false;
}

bool cut_off(const std::vector<double>& samples, double noise) {
  if (!clipped(samples, noise)) return false;
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
  double smallest = std::numeric_limits<double>::infinity(), to_plateau = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double step = std::abs(samples[i] - samples[i - 1]);
    if (step > 0) smallest = std::min(smallest, step);
    const bool on = samples[i] == *least || samples[i] == *most,
               was = samples[i - 1] == *least || samples[i - 1] == *most;
    if (on != was) to_plateau = std::max(to_plateau, step);
  }
  return to_plateau > 3 * smallest;
}

Doubts doubts(const Bench& bench) { return Doubter(bench).all(); }

}  // namespace freestand::measurement
