// What every search for effects does with its candidates: who can be seen, fits to the end, judgement.
#pragma once

#include <cmath>
#include <map>
#include <tuple>

#include "measurement/fit/as_stated.hpp"
#include "measurement/verdict/diagnose.hpp"
#include "measurement/verdict/pairs.hpp"

namespace freestand::measurement {

using Catalogue = std::vector<const dynamics::Effect*>;

class EffectSearch {
 public:
  EffectSearch(const Bench& bench, const ModelSpec& base, const Catalogue& catalogue, const DiagnosisOptions& options,
               const Jobs& jobs)
      : bench_(bench),
        base_(base),
        catalogue_(catalogue),
        options_(options),
        jobs_(jobs),
        tests_(tests_of(bench.data(), Role::calibration).size()) {}

 protected:
  Effort quick() const;
  // Is that mean score better by as much as is worth a fit with tests left out? By a hundredth of the error: scores of histories are logarithms
  // of its square, those of peaks are squares, of which nobody reads one to better than a hundredth.
  bool gains(double score, double than) const {
    constexpr double share = 0.02, read = 0.01;
    return score <= than - (kind_of_set(bench_) == Kind::peaks ? std::fmax(share * than, read * read) : share);
  }
  void leave_out(std::vector<ModelFit*> fits);
  ModelSpec narrowed(const ModelFit& fit) const;
  // What a model that is joined to this one knows of it without each fold.
  static std::vector<std::vector<Values>> known_of(const ModelFit& fit);
  std::vector<bool> visible(const ModelFit& fit, const std::vector<const dynamics::Effect*>& effects) const;
  // Every effect of the catalogue that may join the base becomes a candidate; those that the tests can see are to be fitted.
  struct Singles {
    std::vector<FitTask> tasks;
    std::vector<std::size_t> places;  // of their candidates
  };
  Singles single_effects();
  // Fits them, and the best of them to the end.
  void fit(const Singles&);
  // Polishes and leaves out, for the best candidates from `first` on that gain anything on the base.
  void finish(std::size_t first);
  // Where fits may have stuck: all once more by strides (strides.hpp), so many of them by derivatives, and the best that are better than
  // they were to the end. False: none is.
  bool fit_again_by_strides(const std::vector<FitTask>&, std::size_t by_derivatives, std::size_t finals, const Effort&);
  // Place of the candidate that the fit is better than, or of a new one.
  std::optional<std::size_t> improved(ModelFit& fit);
  const Candidate& best() const;
  // By the noise of floor and sensors, and friction as it scatters where that was found.
  Judge judge_of(const ModelFit&) const;
  void judge();
  // Is it enough? Its misfit against data from itself; of the base with effects but for what goes with deviations from what the laboratory
  // states, which beside the bare base are candidates of their own.
  Chance chance_of_misfit_of(const ModelFit&) const;
  // What the laboratory states, as suits a fit best, and the judge by what the floor's noise does there, which a width that is off would tell
  // wrongly.
  struct Deviated {
    AsStated stated;
    Judge judge;
  };
  Deviated stated_beside(const ModelFit&) const;
  AsStated what_suits(const ModelFit&) const;  // the same without the judge, which takes its time each time
  // A model in which all that is stated is free, at these numbers.
  ModelFit fit_beside(const ModelFit&) const;
  // Looks for it as for an effect, by fits with one of these numbers free. False: it was looked for, or none changes anything.
  bool look_for_deviations(const Candidate&);
  // The same from another place of theirs, which adds to what was found. False: nothing that is stated changes anything.
  bool look_for_deviations_from(const std::vector<std::string>& effects, const ModelFit&);
  // A fit of these effects with something that is stated free.
  void add_deviation(const std::vector<std::string>& effects, ModelFit found);
  // With nothing that is stated off.
  Chance chance_as_stated(const Judge&, const ModelFit&) const;
  // Does one more effect help beside those of a candidate? Of all that may join it, beyond such deviations.
  Chance chance_of_another(const Candidate&) const;
  // Of these fits. All numbers are fitted together with the tests' frictions for the few that come closest with their own held.
  OwnFriction closest_with_own_friction(const std::vector<const ModelFit*>&) const;
  std::vector<Values> starts_of(const dynamics::Effect&, const ModelSpec&) const;
  const dynamics::Effect& of_catalogue(const std::string& name) const;
  // Of peaks each test tells one number, whose others follow from it: with as many numbers as tests nothing could be left out. A history tells
  // thousands. (Several effects together have fewer numbers than tests all the same: they would be joined without end.)
  bool tests_can_fix(const dynamics::Effect& alone) const {
    return kind_of_set(bench_) == Kind::history || fewer_numbers_than(tests_, base_, alone);
  }
  Catalogue untried() const;  // what goes with the base and has more numbers than so few tests can fix

  const Bench& bench_;
  const ModelSpec& base_;
  const Catalogue& catalogue_;
  const DiagnosisOptions& options_;
  const Jobs& jobs_;
  std::size_t tests_;
  Diagnosis out_;

 private:
  Judge judge_of(const ModelSpec&, const Values& x) const;
  std::map<std::vector<std::string>, std::vector<ModelFit>> deviated_;  // what that found beside which effects
  // What stated_beside() found, each once, of effects, numbers, and how friction scatters: by the fit's own judge, where the judge that it
  // returns stands, and by that one.
  mutable std::map<std::tuple<std::vector<std::string>, Values, double>, std::pair<AsStated, AsStated>> beside_;
};

}  // namespace freestand::measurement
