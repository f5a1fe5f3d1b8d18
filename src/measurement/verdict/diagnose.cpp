#include "measurement/verdict/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <map>

#include "measurement/fit/outcome_fit.hpp"
#include "measurement/fit/starts.hpp"
#include "measurement/laboratory/laboratory.hpp"
#include "measurement/laboratory/sides.hpp"
#include "measurement/laboratory/units.hpp"
#include "measurement/noise/unread_floors.hpp"
#include "measurement/verdict/chance_of_peaks.hpp"
#include "measurement/verdict/comparison.hpp"
#include "measurement/verdict/decide.hpp"
#include "measurement/verdict/diagnose_outcomes.hpp"
#include "measurement/verdict/meets_all.hpp"
#include "measurement/verdict/pair_search.hpp"
#include "measurement/verdict/specimens.hpp"

namespace freestand::measurement {
namespace {

// A verdict is only as good as the data.
void withdraw(Diagnosis& d) {
  d.verdict = Verdict::bad_data;
  d.reason = Reason::data;
  d.effects.clear();
  d.best.reset();
  for (Candidate& c : d.candidates) c.rival = false;
  d.sentences = {
      "the measurements look wrong in a sign, a clock, a unit, an offset or a dimension (see the findings): no effect "
      "can be named before that is settled"};
}

class Diagnoser : PairSearch {
 public:
  using PairSearch::PairSearch;

  // With the friction of each test as an earlier search has found it, which stands in the base.
  void know(const OwnNumbers& friction) {
    friction_known_ = true;
    out_.own_friction = friction;
    out_.friction_of_base = false;
    out_.friction_scatter = friction.scatter;
  }

  const std::optional<OwnFriction>& friction_beside_an_effect() const { return friction_beside_; }

  // Empty: friction was found to differ from test to test beside an effect, and the search is to be made again with that.
  std::optional<Diagnosis> run() {
    fit_base();
    out_.quality = examine(bench_, out_.base.fit, options_.effort, jobs_);
    if (out_.quality.spoilt()) {
      judge();
      withdraw(out_);
      return std::move(out_);
    }
    Singles singles = single_effects();
    add_laboratory_faults(singles);
    fit(singles);
    judge();
    look_for_chance();
    if (friction_beside_) return {};
    const Stated stated = clocks_at_fault_.empty() ? enough_if_stated_otherwise() : Stated{clocks_at_fault_};
    for (std::string& fault :
         std::vector{stated.within ? "" : stated.told,
                     sides_turned_round(bench_, out_.base.fit, least_score(), quick(), jobs_), unit_of_peaks()})
      if (!fault.empty()) {
        out_.quality.findings.push_back(std::move(fault));
        withdraw(out_);
        return std::move(out_);
      }
    if (!stated.within) search_more();
    decide_all();
    if (stated.within) needs_no_effect(stated.told);
    tell_unread_floors();
    tell_scatter_of_friction();
    tell_deviations();
    if (kind_of_set(bench_) == Kind::history && only_friction_scatters(out_))
      if (std::string whose = friction_of_specimens(bench_, *out_.own_friction); !whose.empty())
        out_.sentences.push_back(std::move(whose));
    if (kind_of_set(bench_) == Kind::history)
      if (std::string met =
              meets_all_tests(out_, [&](const Candidate& c) { return chance_of_misfit_of(c.fit).chance(); });
          !met.empty())
        out_.sentences.push_back(std::move(met));
    if (out_.verdict == Verdict::unknown)
      if (std::string specimens = several_specimens(bench_); !specimens.empty()) out_.sentences.push_back(specimens);
    if (out_.verdict == Verdict::unknown) tell_closest_fault();
    name_untried();
    return std::move(out_);
  }

 private:
  Effort wide() const {
    Effort effort = options_.effort;
    effort.screened_per_number *= 2;
    return effort;
  }

  void fit_base() {
    FitTask task{.model = base_};
    if (!options_.start.empty()) task.starts = {options_.start};
    auto fits = fit_models(bench_, {task}, wide(), jobs_);
    polish(bench_, {&fits[0]}, options_.effort, 0.05, jobs_);
    leave_out({&fits[0]});
    out_.base.fit = std::move(fits[0]);
  }

  void add_laboratory_faults(Singles& singles) {
    if (kind_of_set(bench_) != Kind::history || base_.free.size() + 1 >= tests_) return;
    constexpr std::size_t points = 8;
    for (LaboratoryFault& fault : laboratory_faults(bench_, base_, out_.base.fit.x)) {
      Candidate candidate{.effects = {fault.name}, .fit = out_.base.fit, .laboratory = true};
      candidate.fit.model = fault.model;
      singles.places.push_back(out_.candidates.size());
      out_.candidates.push_back(std::move(candidate));
      FitTask task{.model = std::move(fault.model), .screened = false, .known = known_of(out_.base.fit)};
      task.starts = starts_from({out_.base.fit.x}, task.model, points);
      singles.tasks.push_back(std::move(task));
    }
  }

  void name_untried() {
    std::vector<std::string> names;
    for (const auto* effect : untried()) names.push_back(effect->name);
    if (const auto& refused = pairs().refused(); !refused.empty())
      names.push_back(fmt::format("{} pair{}, as {} with {}", refused.size(), refused.size() == 1 ? "" : "s",
                                  refused.begin()->first, refused.begin()->second));
    if (!names.empty())
      out_.sentences.push_back(
          fmt::format("not tried, since they have more numbers than so few tests can fix: {}", fmt::join(names, ", ")));
  }

  // Of all models fitted to all tests.
  double least_score() const {
    double least = out_.base.fit.score;
    for (const Candidate& c : out_.candidates)
      if (c.visible) least = std::min(least, c.fit.score);
    return least;
  }

  // The fault that all peaks are written in another unit. Where effects were not tried a small factor may be theirs: it is told alone.
  std::string unit_of_peaks() {
    if (kind_of_set(bench_) != Kind::peaks) return {};
    double least = out_.base.fit.mean_left_out();
    for (const Candidate& c : out_.candidates)
      if (c.visible && c.fit.left_out_refitted) least = std::min(least, c.fit.mean_left_out());
    UnitOfPeaks unit = peaks_in_another_unit(bench_, out_.base.fit, least, quick(), jobs_);
    if (unit.told.empty() || !unit.may_be_physical() || untried().empty()) return std::move(unit.told);
    out_.quality.findings.push_back(std::move(unit.told));
    return {};
  }

  // What is named because it is enough where something that is stated is off: its numbers and errors are those of a fit in which that is free.
  void tell_deviations() {
    if (kind_of_set(bench_) != Kind::history || out_.effects.empty()) return;
    std::vector<ModelFit*> fits;
    for (Candidate& c : out_.candidates) {
      if (!c.rival || c.laboratory || !enough_within_tolerances(out_, c)) continue;
      const AsStated stated = what_suits(c.fit);
      const std::string off = most_off(stated);
      if (off.empty()) continue;
      const auto error = [&](double misfit) { return std::sqrt(misfit / total(out_.samples)); };
      out_.sentences.push_back(fmt::format(
          "{} is judged with what is stated as suits it best within the tolerances, above all as if {}: "
          "there it leaves {:.2f} where noise explains 1, and {:.3g} as things are stated; measure that again",
          joined(c.effects), off, error(stated.misfit), error(c.misfit_of_fit)));
      c.remark = fmt::format("if {}", off);
      c.fit = fitted_with_what_is_off(c.fit, stated);
      fits.push_back(&c.fit);
    }
    if (fits.empty()) return;
    polish(bench_, fits, options_.effort, 0.05, jobs_);
    leave_out(fits);
    judge();
  }

  ModelFit fitted_with_what_is_off(const ModelFit& fit, const AsStated& stated) const {
    FitTask task{.model = fit.model, .screened = false};
    Values x(stated.x.begin(), stated.x.begin() + static_cast<long>(fit.x.size()));
    for (const StatedNumber& number : stated_numbers(bench_.data().tolerance, fit.model)) {
      const auto k = static_cast<std::size_t>(std::ranges::find(stated.names, number.name) - stated.names.begin());
      if (!stated.is_off[k]) continue;
      let_free(task.model, number);
      x.push_back(stated.x[fit.x.size() + k]);
    }
    task.starts = {std::move(x)};
    return std::move(fit_models(bench_, {task}, quick(), jobs_)[0]);
  }

  // Where nothing is named: does, of all that was tried, the base come closest with something stated wrongly?
  void tell_closest_fault() {
    const Candidate* closest = &out_.base;
    for (const Candidate& c : out_.candidates)
      if (c.visible && c.fit.left_out_refitted && c.misfit < closest->misfit) closest = &c;
    if (!closest->laboratory) return;
    const Free& free = closest->fit.model.free.back();
    const double number = closest->fit.x.back();
    out_.sentences.push_back(fmt::format(
        "of all that was tried the model comes closest to the tests left out, to {:.3g}, if {}{}: measure that again",
        closest->explained, fault_sentence(closest->effects.front(), number), at_its_limit(free, number)));
  }

  struct Stated {
    std::string told;     // empty: nothing of the kind
    bool within = false;  // what the tolerances make by chance
  };
  // Is nothing that was tried enough as it is, and the base where all that is stated may be off? Then no effect is needed.
  Stated enough_if_stated_otherwise() const {
    const auto enough = [&](const ModelFit& fit) { return chance_as_stated(judge_of(fit), fit).chance(); };
    if (kind_of_set(bench_) != Kind::history || enough(out_.base.fit)) return {};
    for (const Candidate& c : out_.candidates)
      if (c.visible && c.fit.left_out_refitted && enough(c.fit)) return {};
    const auto [stated, judge] = stated_beside(out_.base.fit);
    const std::string off = most_off(stated);
    if (off.empty() || !chance_of_misfit(bench_, judge, out_.base.fit, stated.misfit).chance()) return {};
    if (within_tolerances(stated)) return {off, true};
    return {fmt::format(
        "the model is enough within the tolerances of what is stated, above all if {}: measure that again", off)};
  }

  void needs_no_effect(const std::string& if_stated_otherwise) {
    out_.verdict = Verdict::none;
    out_.reason = Reason::none;
    out_.effects.clear();
    for (Candidate& c : out_.candidates) c.rival = false;
    out_.enough_if = if_stated_otherwise;
    out_.sentences = {
        fmt::format("no effect is needed: the model is enough within the tolerances of what is stated, above all if {}",
                    if_stated_otherwise)};
  }

  void decide_all() {
    std::map<std::string, Judge> judges;  // the same for all rivals
    const auto lead = [&](const Candidate& best, const Candidate& rival) {
      if (kind_of_set(bench_) == Kind::peaks) return chance_of_lead_of_peaks(bench_, best.fit, rival.fit, jobs_);
      if (enough_within_tolerances(out_, best))
        return chance_of_lead(bench_, stated_beside(best.fit).judge, fit_beside(best.fit), fit_beside(rival.fit),
                              jobs_);
      const std::string name = fmt::format("{}", fmt::join(best.effects, "+"));
      if (!judges.count(name)) judges.emplace(name, judge_of(best.fit));
      return chance_of_lead(bench_, judges.at(name), best.fit, rival.fit, jobs_);
    };
    const auto steady = [&](const Candidate& c) {
      return chance_of_steady_gain(bench_, out_.base.fit, enough_within_tolerances(out_, c) ? fit_beside(c.fit) : c.fit,
                                   std::max<std::size_t>(1, tried_alone().size()), jobs_, out_.friction_scatter);
    };
    decide(bench_, out_,
           {lead,
            [&](const Candidate& c) {
              return kind_of_set(bench_) == Kind::peaks ? chance_of_misfit_of_peaks(bench_, c.fit)
                                                        : chance_of_misfit_of(c.fit);
            },
            [&](const Candidate& c) { return chance_of_another(c); }, steady,
            [&](const Candidate& c) { return what_suits(c.fit).misfit; }});
  }

  std::vector<const ModelFit*> tried_alone() const {
    std::vector<const ModelFit*> tried;
    for (const Candidate& c : out_.candidates)
      if (c.visible && !c.laboratory && c.effects.size() == 1) tried.push_back(&c.fit);
    return tried;
  }

  // Does any effect help? And, of histories, would a friction or a clock of its own in each test do as well?
  void look_for_chance() {
    const std::vector<const ModelFit*> tried = tried_alone();
    const auto keep = [&](Chance chance) {
      chance.about = fmt::format("{} effects", tried.size());
      out_.chances.push_back(std::move(chance));
    };
    if (kind_of_set(bench_) == Kind::peaks) {
      if (!tried.empty()) keep(chance_of_gain_of_peaks(bench_, out_.base.fit, tried, jobs_));
      return;
    }
    const Judge judge = judge_of(out_.base.fit);
    out_.strays = judge.strays();
    if (!tried.empty()) keep(chance_of_gain(bench_, judge, out_.base.fit, tried, jobs_));
    if (friction_known_) return;
    if (!chance_of_misfit_of(out_.base.fit).chance()) {
      out_.own_friction = own_friction(bench_, judge, out_.base.fit, jobs_);
      look_at_clocks(judge, out_.base, std::min(least_misfit(out_), out_.own_friction->misfit));
    }
    if (clocks_at_fault_.empty() && !only_friction_scatters(out_)) look_for_friction_beside_an_effect();
  }

  // The base where nothing helps.
  const Candidate& named_by_verdict() const {
    return out_.verdict == Verdict::none || !out_.best ? out_.base : out_.candidates[*out_.best];
  }

  // Said where a floor was read so seldom that this tells more of a history's error than sensors and the floor's noise together: under the
  // model that comes closest, since one that is wrong may fan out where the specimen did not.
  void tell_unread_floors() {
    if (kind_of_set(bench_) != Kind::history || out_.friction_scatter > 0) return;
    const Judge judge = judge_of(named_by_verdict().fit);
    std::vector<UnreadFloor> floors;
    for (std::size_t i = 0; i < tests_; ++i) floors.push_back({&judge.test(i), judge.unread()[i], judge.expected()[i]});
    if (std::string told = told_of_unread(floors); !told.empty()) out_.quality.findings.push_back(std::move(told));
  }

  void tell_scatter_of_friction() {
    if (kind_of_set(bench_) != Kind::peaks) return;
    const Candidate& model = named_by_verdict();
    const PeakScatter scatter = scatter_of_peaks(bench_, model.fit, jobs_);
    if (scatter.p_without_friction() > chance_level) return;
    out_.quality.findings.push_back(fmt::format(
        "peaks scatter as if friction differed by {:.2g} % from test to test (standard deviation), and by {:.2g} % "
        "besides: chances allow for that; measure friction in each test",
        100 * scatter.of_friction(), 100 * scatter.own()));
  }

  // Does a clock of its own in each test take a model to the noise, where all else leaves at least so much?
  void look_at_clocks(const Judge& judge, const Candidate& c, double least_of_all_else) {
    const OwnNumbers clocks = own_clocks(bench_, judge, c.fit, jobs_);
    std::vector<std::string> late;  // by more than half a sampling step
    const auto tests = tests_of(bench_.data(), Role::calibration);
    for (std::size_t k = 0; k < tests.size(); ++k) {
      const Test& test = bench_.test(tests[k]);
      if (std::abs(clocks.of_tests[k]) > 0.5 * test.dt_s)
        late.push_back(clock_sentence("the response of test " + test.id + " is stamped", clocks.of_tests[k]));
    }
    if (late.empty() || !explain_tests(clocks, total(out_.samples), least_of_all_else)) return;
    const auto error = [&](double misfit) { return std::sqrt(misfit / total(out_.samples)); };
    clocks_at_fault_ = fmt::format(
        "{}: with that {} leaves {:.2f} where noise explains 1, and {:.2f} with the best of all else; check the "
        "clocks of the channels",
        fmt::join(late, ", "), c.effects.empty() ? "the model" : fmt::format("{}", fmt::join(c.effects, " and ")),
        error(clocks.misfit), error(least_of_all_else));
  }

  // Where even the best effect leaves more than chance: does it, or another, less with a friction, or a clock, of its own in each test, and by
  // more than one more effect would? Then each test has that friction, or the clocks are at fault. (A drag that grows with the square of the
  // speed is near enough to one in proportion to it with such frictions, and leaves more than chance.)
  void look_for_friction_beside_an_effect() {
    const Candidate& known = best();
    if (known.effects.empty() || known.laboratory || chance_of_misfit_of(known.fit).chance()) return;
    const OwnFriction own = closest_with_own_friction(tried_alone());
    const double least = what_suits(known.fit).misfit - chance_of_another(known).observed;
    const bool near_enough = known.misfit_of_fit <= adequate * adequate * total(out_.samples);
    if (!near_enough) look_at_clocks(judge_of(known.fit), known, std::min(least, own.of_tests.misfit));
    if (clocks_at_fault_.empty() && explain_tests(own.of_tests, total(out_.samples), least) &&
        chance_as_stated(judge_of(own.fit), own.fit).chance())
      friction_beside_ = own;
  }

  bool friction_known_ = false;
  std::optional<OwnFriction> friction_beside_;
  std::string clocks_at_fault_;  // a sentence; empty: none is
};

}  // namespace

const char* name(Verdict verdict) {
  constexpr const char* names[] = {"none", "missing", "ambiguous", "unknown", "bad_data"};
  return names[static_cast<int>(verdict)];
}

const char* name(Reason reason) {
  constexpr const char* names[] = {"", "data", "none_helps", "none_suffices", "one_law"};
  return names[static_cast<int>(reason)];
}

Diagnosis diagnose(const Bench& bench, const ModelSpec& base, const Catalogue& catalogue,
                   const DiagnosisOptions& options, const Jobs& jobs) {
  const std::size_t tests = tests_of(bench.data(), Role::calibration).size();
  if (tests < 3 || tests <= base.free.size())
    throw Error(
        fmt::format("{} has {} calibration test{} for {} number{} to be calibrated (a diagnosis leaves tests out, "
                    "and needs three and more than there are numbers): add tests, or fix numbers",
                    bench.data().name, tests, tests == 1 ? "" : "s", base.free.size(),
                    base.free.size() == 1 ? "" : "s"),
        Exit::data);
  if (outcomes_only(bench.data())) {
    Diagnosis d = diagnose_outcomes(bench, base, catalogue, options.start, {}, jobs);
    d.quality = examine(bench, d.base.fit, options.effort, jobs);
    if (d.quality.spoilt()) withdraw(d);
    return d;
  }
  Diagnoser diagnoser(bench, base, catalogue, options, jobs);
  if (auto diagnosis = diagnoser.run()) return std::move(*diagnosis);
  const OwnFriction& own = *diagnoser.friction_beside_an_effect();
  ModelSpec with_own = base;
  with_own.friction_of_test = own.fit.model.friction_of_test;
  Diagnoser again(bench, with_own, catalogue, options, jobs);
  again.know(own.of_tests);
  return *again.run();
}

}  // namespace freestand::measurement
