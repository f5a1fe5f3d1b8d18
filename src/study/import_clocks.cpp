#include "study/import_clocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "measurement/laboratory/timing.hpp"
#include "measurement/predict/bench.hpp"

namespace freestand::study {
namespace {

constexpr double surely_mirrored = 4;  // times steadier, as more than chance is (timing.hpp)

// What the slip of a test tells.
struct Seen {
  measurement::Timing as_given, turned;  // turned: or as it is given, the better
  measurement::SlipScale scale;

  bool surely_turned() const { return turned.gain > surely_mirrored * as_given.gain; }
  bool in_another_unit() const {
    return scale.is_a_unit() && std::abs(std::log(scale.factor)) > std::log(measurement::factor_of_springs) &&
           scale.gain > std::max(as_given.gain, turned.gain);
  }
};

class SlipClocks {
 public:
  SlipClocks(const Laboratory& lab, const std::vector<File>& floors, const std::vector<File>& responses)
      : lab_(lab), floors_(floors), responses_(responses), seen_(lab.tests.size()) {
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (asks(i)) seen_[i] = look(i);
  }

  Clocks run() {
    sort();
    std::vector<double> found;
    for (const std::size_t i : wrong_) found.push_back(late_s_[i]);
    std::sort(found.begin(), found.end());
    const bool one_clock = found.size() > 1 && found.back() - found.front() <= 2 * longest_step();
    tell_unset();
    if (!one_clock) tell_taken_as_one();  // else it is told of all tests below
    if (!found.empty()) set(0.5 * (found[(found.size() - 1) / 2] + found[found.size() / 2]), one_clock);
    return {late_s_, sentences_};
  }

 private:
  using Ids = std::vector<std::string>;
  void say(std::string sentence) { sentences_.push_back(std::move(sentence)); }
  bool asks(std::size_t i) const { return !lab_.tests[i].clock_s && lab_.tests[i].slip; }

  Seen look(std::size_t i) const {
    const LabTest& lab = lab_.tests[i];
    const TestOfLab test = on_one_clock(lab_, lab, floors_[i], responses_[i], 0);
    measurement::Dataset set;
    set.noise.slip_m = noise_of(responses_[i], lab.slip, lab_.noise.slip_m);
    set.noise.rotation_rad = noise_of(responses_[i], lab.rotation, lab_.noise.rotation_rad);
    set.tests = {test.test};
    const measurement::Bench bench(set, 0);
    const int most = static_cast<int>(longest_offset_s / test.test.dt_s);
    return {slip_timing(bench, 0, most, true), slip_timing(bench, 0, most, false), slip_scale(bench, 0)};
  }

  // One that is mirrored beyond doubt tells of the others, too, unless one goes better as it is.
  void sort() {
    const bool one_sure = std::ranges::any_of(seen_, &Seen::surely_turned);
    const bool none_as_given =
        std::ranges::all_of(seen_, [](const Seen& seen) { return seen.turned.mirrored || !seen.turned.judged(); });
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const LabTest& lab = lab_.tests[i];
      const Seen& seen = seen_[i];
      late_s_.push_back(lab.clock_s.value_or(0));
      if (!asks(i)) continue;
      const bool two_files = lab.floor.path != lab.response.path;
      if (seen.in_another_unit()) {
        in_units_.push_back(fmt::format("{} ({:.3g})", lab.id, seen.scale.factor));
      } else if (seen.surely_turned() || (one_sure && none_as_given && seen.turned.mirrored)) {
        mirrored_.push_back(lab.id);
      } else if (!seen.as_given.wrong()) {
        if (two_files) (seen.as_given.judged() ? together_ : too_short_).push_back(lab.id);
      } else if (!seen.as_given.known()) {
        unsure_.push_back(lab.id);
      } else {
        late_s_.back() = std::round(1e4 * seen.as_given.late * step_of(lab_, floors_[i], responses_[i])) / 1e4;
        wrong_.push_back(i);
      }
    }
  }

  double longest_step() const {
    double longest = 0;
    for (std::size_t i = 0; i < floors_.size(); ++i)
      longest = std::max(longest, step_of(lab_, floors_[i], responses_[i]));
    return longest;
  }

  void tell_unset() {
    for (const LabTest& lab : lab_.tests)
      if (!lab.slip && !lab.clock_s && lab.floor.path != lab.response.path)
        say(fmt::format(
            "{}: the clocks of floor and response are taken as one: slips show their offset, and none was measured "
            "(clock_s of a test says what it is)",
            lab.id));
    if (!in_units_.empty())
      say(fmt::format(
          "{}: the slip goes with the floor, and no clock was set by it, if it is so many times what is read: check "
          "unit: of the slip and of the floor's acceleration",
          fmt::join(in_units_, ", ")));
    if (!mirrored_.empty())
      say(fmt::format(
          "{}: the slip looks mirrored, and no clock was set by it: with the other sign (sign: of its column) it goes "
          "with the floor far better at some time than as it is at any, up to {} s either way",
          fmt::join(mirrored_, ", "), longest_offset_s));
  }

  void tell_taken_as_one() {
    if (!together_.empty())
      say(fmt::format(
          "{}: no offset between the clocks of floor and response is seen by the slips, which are looked through up "
          "to {} s either way: they are taken as one (clock_s of a test says otherwise)",
          fmt::join(together_, ", "), longest_offset_s));
    if (!too_short_.empty())
      say(
          fmt::format("{}: slips are too few or too short to tell whether the clocks of floor and response differ: "
                      "they are taken as one (give clock_s of the test, by how much the response is stamped late)",
                      fmt::join(too_short_, ", ")));
    if (!unsure_.empty())
      say(fmt::format(
          "{}: the slips say that the clocks of floor and response differ, and not by how much: several offsets suit "
          "them, or more than the {} s that are looked through. They are taken as one: give clock_s of the test, by "
          "how much the response is stamped late",
          fmt::join(unsure_, ", "), longest_offset_s));
  }

  void set(double middle, bool one_clock) {
    for (std::size_t i = 0; i < late_s_.size(); ++i) {
      if (!asks(i)) continue;
      if (one_clock) late_s_[i] = middle;
      if (!one_clock && late_s_[i] != 0) say(shifted(lab_.tests[i].id, late_s_[i]));
    }
    if (one_clock) say(shifted("all tests", middle));
  }

  static std::string shifted(const std::string& whose, double late_s) {
    return fmt::format(
        "{}: the response is stamped {:.4g} s {} against the floor by what slips show, and was shifted by that "
        "(clock_s of a test says what it is, 0 too)",
        whose, std::abs(late_s), late_s > 0 ? "late" : "early");
  }

  const Laboratory& lab_;
  const std::vector<File>&floors_, &responses_;
  std::vector<Seen> seen_;
  std::vector<double> late_s_;
  std::vector<std::size_t> wrong_;  // tests whose clock the slips tell
  Ids in_units_, mirrored_, together_, too_short_, unsure_;
  std::vector<std::string> sentences_;
};

}  // namespace

Clocks clocks(const Laboratory& lab, const std::vector<File>& floors, const std::vector<File>& responses) {
  return SlipClocks(lab, floors, responses).run();
}

}  // namespace freestand::study
