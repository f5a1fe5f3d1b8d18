#include "measurement/tell/findings_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/digits.hpp"
#include "measurement/laboratory/plausible.hpp"

namespace freestand::measurement {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// How far specimen and model went, in least_motion().
struct Reached {
  bool known = false;  // of the specimen
  double measured = 0, model = 0;
  bool specimen_moves() const { return known && measured > 8; }
  bool specimen_stands() const { return known && measured < 6; }
  bool model_moves() const { return model > 16; }
  bool model_stands() const { return model < 1; }
};

struct Motions {
  Reached slip, rotation;
  // Only where more was measured: outcomes alone are judged by their probabilities.
  std::optional<bool> specimen_overturns = {};
  bool model_overturns = false;
  bool specimen_moves() const { return slip.specimen_moves() || rotation.specimen_moves(); }
  bool model_stands() const { return slip.model_stands() && rotation.model_stands(); }
};

// Greatest of a history or, where there is none, the peak.
std::optional<double> greatest_of(const std::vector<double>& samples, const std::optional<double>& peak) {
  if (!samples.empty()) return greatest(samples);
  return peak ? std::optional(std::abs(*peak)) : std::nullopt;
}

Reached reached(const std::optional<double>& measured, double model, double least) {
  return {.known = measured.has_value(), .measured = measured.value_or(0) / least, .model = model / least};
}

Motions motions(const Bench& bench, const TestComparison& c, double half_base_m) {
  const Test& test = bench.test(c.test);
  const auto& p = test.peaks;
  const auto turn = greatest_of(test.rotation_rad, p.peak_rotation_rad);
  auto slip = greatest_of(test.slip_m, p.peak_slip_m ? p.peak_slip_m : p.residual_slip_m);
  const double model_turn = *greatest_of(c.model.rotation_rad, c.model.response.peak_rotation_rad);
  double model_slip = *greatest_of(c.model.slip_m, c.model.response.peak_slip_m);
  const auto rolled = [&](double rotation) { return half_base_m * (1 - std::cos(rotation)); };
  if (slip && turn) *slip = std::max(0.0, *slip - rolled(*turn));
  model_slip = std::max(0.0, model_slip - rolled(model_turn));
  Motions m{reached(slip, model_slip, least_motion(bench, Channel::slip)),
            reached(turn, model_turn, least_motion(bench, Channel::rotation))};
  if (kind(test) != Kind::outcome) m.specimen_overturns = p.overturned;
  m.model_overturns = c.model.response.outcome == Outcome::overturned;
  if (test.slip_m.empty() && !peaks_compare(test, c.model.response)) m.slip.known = false;
  if (!fell(test)) return m;
  if (!m.rotation.known) m.rotation = {.known = true, .measured = infinity, .model = m.rotation.model};
  if (c.error.probability > 1e-3) m.rotation.model = infinity;
  return m;
}

class MotionFindings {
 public:
  MotionFindings(const Bench& bench, const ModelSpec& model, std::span<const double> x,
                 const std::vector<TestComparison>& tests)
      : bench_(bench), model_(model), x_(x) {
    for (const TestComparison& t : tests)
      if (!t.model.failed() && !(t.expected > drowned))
        tests_.push_back({t.test, motions(bench, t, specimen(model, bench.test(t.test), x).block.half_base_m())});
  }

  std::vector<std::string> all() {
    const auto still = [](const Motions& m) { return m.model_stands() && m.specimen_moves(); };
    say("the model stands still in {} of {} tests in which the specimen moves", &Motions::specimen_moves, still,
        [&](std::size_t i) { return why_it_stands(i); });
    say(
        "the model does not rotate in {} of {} tests in which the specimen rocks",
        [](const Motions& m) { return m.rotation.specimen_moves(); },
        [&](const Motions& m) { return m.rotation.model_stands() && !(rotates() && still(m)); },
        [&](std::size_t i) { return why_it_does_not_rotate(i); });
    say(
        "the model does not slide in {} of {} tests in which the specimen slides",
        [](const Motions& m) { return m.slip.specimen_moves(); },
        [&](const Motions& m) { return m.slip.model_stands() && !(model_.model != Model::rock && still(m)); },
        [&](std::size_t i) { return why_it_does_not_slide(i); });
    say(
        "the model rocks in {} of {} tests in which the specimen does not",
        [](const Motions& m) { return m.rotation.specimen_stands(); },
        [](const Motions& m) { return m.rotation.model_moves(); },
        [&](std::size_t i) { return above(i) ? rather(i) : "width/height is too small, or the floor too strong"; });
    say(
        "the model slides in {} of {} tests in which the specimen does not",
        [](const Motions& m) { return m.slip.specimen_stands(); },
        [](const Motions& m) { return m.slip.model_moves(); },
        [&](std::size_t i) {
          if (!of(i).rotation.specimen_moves()) return std::string("its friction is too low");
          return above(i) ? std::string() : rather(i);
        });
    say(
        "the model overturns in {} of {} tests in which the specimen stays on its base",
        [](const Motions& m) { return m.specimen_overturns == false; },
        [](const Motions& m) { return m.model_overturns; },
        [](std::size_t) { return "it is too slender, too small, or lacks what takes energy from rocking"; });
    say(
        "the model stays on its base in {} of {} tests in which the specimen overturns",
        [](const Motions& m) { return m.specimen_overturns == true; },
        [](const Motions& m) { return !m.model_overturns; }, [](std::size_t) { return std::string(); });
    return std::move(said_);
  }

 private:
  // among(): tests that are counted, is(): those of them that are told. why(test): of the first of these.
  template <class Among, class Is, class Why>
  void say(const char* text, Among&& among, Is&& is, Why&& why) {
    std::vector<std::string> ids;
    std::size_t first = 0, count = 0;
    for (const auto& [test, m] : tests_) {
      if (!std::invoke(among, m)) continue;
      ++count;
      if (!is(m)) continue;
      if (ids.empty()) first = test;
      ids.push_back(bench_.test(test).id);
    }
    if (ids.empty()) return;
    std::string because = why(first);
    if (because == because_) because.clear();
    if (!because.empty()) because_ = because;
    said_.push_back(fmt::format("{} ({}){}{}", fmt::format(fmt::runtime(text), ids.size(), count), listed(ids),
                                because.empty() ? "" : ": ", because));
  }

  bool rotates() const { return model_.model == Model::rock || model_.model == Model::slide_rock; }

  const Motions& of(std::size_t test) const {
    return std::find_if(tests_.begin(), tests_.end(), [&](const auto& t) { return t.test == test; })->motions;
  }

  double mu(std::size_t i) const { return specimen(model_, bench_.test(i), x_).friction.mu_s; }
  double slenderness(std::size_t i) const {
    const Block block = specimen(model_, bench_.test(i), x_).block;
    return std::min(block.left_m, block.right_m) / block.height_m;
  }
  bool above(std::size_t i) const { return mu(i) > slenderness(i); }

  std::string rather(std::size_t i) const {
    return fmt::format("mu ({}) is {} width/height ({}), where a block {}{}", three_digits(mu(i)),
                       above(i) ? "above" : "not above", three_digits(slenderness(i)),
                       above(i) ? "rocks rather than slides" : "slides rather than rocks",
                       model_.mu_k.free < 0 ? ""
                       : above(i)           ? "; calibrate it below that"
                                            : "; calibrate it above that");
  }

  std::string why_it_stands(std::size_t i) const {
    const double least = model_.model == Model::slide_rock ? std::min(mu(i), slenderness(i))
                         : model_.model == Model::rock     ? slenderness(i)
                                                           : mu(i);
    return fmt::format("the floor must exceed {} g to move it", three_digits(least));
  }

  std::string why_it_does_not_rotate(std::size_t i) const {
    if (model_.model == Model::slide) return "\"model: slide\" knows no rotation, slide_rock and rock do";
    if (model_.model == Model::bouc_wen) return "\"model: bouc_wen\" knows no rotation, slide_rock and rock do";
    if (model_.model == Model::slide_rock && !above(i)) return rather(i);
    return fmt::format("its floor must exceed width/height, {} g", three_digits(slenderness(i)));
  }

  std::string why_it_does_not_slide(std::size_t i) const {
    if (model_.model == Model::rock) return "\"model: rock\" knows no slip, slide_rock and slide do";
    if (model_.model == Model::slide_rock && above(i)) return rather(i);
    return fmt::format("its floor must exceed mu, {} g", three_digits(mu(i)));
  }

  struct Seen {
    std::size_t test;
    Motions motions;
  };

  const Bench& bench_;
  const ModelSpec& model_;
  std::span<const double> x_;
  std::vector<Seen> tests_;
  std::string because_;  // told last
  std::vector<std::string> said_;
};

}  // namespace

std::vector<std::string> motion_findings(const Bench& bench, const ModelSpec& model, std::span<const double> x,
                                         const std::vector<TestComparison>& tests) {
  return MotionFindings(bench, model, x, tests).all();
}

}  // namespace freestand::measurement
