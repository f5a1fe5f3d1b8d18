// Which effect does the model lack?
//
//   1. The base model is fitted. Every effect of the catalogue that changes any predicted history is fitted with the
//      base parameters, and judged by the error of the calibration tests left out.
//   2. Where the best of them leaves an error above the noise, or may hide a second one, pairs are fitted: each of the
//      best few with every other. Where even these leave an error above the noise, singles and all pairs are fitted
//      once more by strides (strides.hpp).
//   3. Histories: models are compared by their misfit G = r^T C^-1 r of the tests left out (judge.hpp), and by chance that
//      is computed (chance.hpp): may the largest gain of all effects tried be chance, may the lead of the best over a
//      rival? Beside the effects stand faults of the laboratory (laboratory.hpp), and a friction of its own in each test
//      (own_numbers.hpp).
//
// Tests that say only whether the specimen overturned go their own way (diagnose_outcomes.hpp).
//
//   none       no model beats the base by more than chance, or nothing but friction that differs from test to test
//   missing    one does and is at the noise, and every rival misses the tests left out by more, beyond chance
//   ambiguous  one does and is at the noise, and rivals cannot be told from it
//   unknown    the base is worse than the noise and so is everything else
//   bad_data   a dimension or a gain that is not as stated explains the tests as no effect does; or the data are wrong in
//              a sign, a clock or a unit
//
// A rival that needs a parameter far from where its effect is met (three times beyond the catalogue's range) to imitate
// another is not held to be one.
#pragma once

#include <limits>
#include <optional>

#include "measurement/fit/judge.hpp"
#include "measurement/fit/model_fit.hpp"
#include "measurement/fit/own_numbers.hpp"
#include "measurement/laboratory/quality.hpp"
#include "measurement/verdict/chance.hpp"

namespace freestand::measurement {

enum class Verdict { none, missing, ambiguous, unknown, bad_data };
const char* name(Verdict);

// Why the verdict names no effect: the data are wrong; no effect helps; effects help, and the best leaves more than noise makes; several
// together would be enough, and one law of no catalogue does with fewer numbers.
enum class Reason { none, data, none_helps, none_suffices, one_law };
const char* name(Reason);

inline constexpr double unjudged = std::numeric_limits<double>::quiet_NaN();

struct Candidate {
  std::vector<std::string> effects;  // joined to the base, in order
  ModelFit fit;
  bool visible = true;                      // the data can see it
  bool practical = true;                    // its parameters lie where it is met
  std::vector<double> misfits = {};         // G, of each test left out
  double misfit = unjudged;                 // their sum; nan: not judged
  std::vector<double> misfits_of_fit = {};  // the same of each test with the fit to all tests
  double misfit_of_fit = unjudged;          // their sum
  double explained = unjudged;              // sqrt(G/samples): 1 where sensor and floor noise explain all
  double delta_bic = std::numeric_limits<double>::quiet_NaN();  // against the base; negative: better; of peaks none
  double difference = 0, difference_se = 0;  // of the left-out score to the best one's, paired over the tests
  bool rival = false;                        // cannot be told from the best
  // Why it is not named though it misses by less; of outcomes also why it was not fitted to the end; of the named one, what is off beside it.
  std::string remark = {};
  bool laboratory = false;  // no effect, but something that the laboratory states wrongly
};

struct Diagnosis {
  Verdict verdict = Verdict::none;
  Reason reason = Reason::none;
  std::vector<std::string> effects;  // to add, in order; ambiguous: the rivals
  Candidate base;
  std::vector<Candidate> candidates;       // the best, its rivals, others that were fitted to the end, the rest
  std::optional<std::size_t> best;         // of the candidates: the one that the verdict speaks of
  std::vector<double> noise_floor;         // error that the best model itself would show, of each calibration test
  std::vector<double> samples;             // of each calibration test
  std::vector<double> strays;              // Judge::strays() of the base
  std::vector<Chance> chances;             // each that decided
  std::optional<OwnNumbers> own_friction;  // of the base, or of the best effect, where it leaves more than chance
  bool friction_of_base = true;            // whose
  // Of verdict none: with what stated otherwise, within its tolerance, the model is enough that is not as it stands: "the width is 0.06 % larger
  // than stated"; empty: as it stands.
  std::string enough_if = {};
  bool deviations_sought = false;  // were effects fitted beside what is stated, off within its tolerances?
  // Standard deviation of ln friction from test to test that is allowed for, so that misfits count what it does not explain;
  // 0: as it makes no difference.
  double friction_scatter = 0;
  Quality quality;
  std::vector<std::string> sentences;
  std::optional<Candidate>
      proposal;  // a law of no catalogue (law_search.hpp), where nothing suffices and one does better
};

struct DiagnosisOptions {
  Effort effort;
  std::size_t finals = 7;      // best single effects that are fitted to the end, with tests left out
  std::size_t pair_seeds = 3;  // best single effects that others are joined to
  std::size_t pair_finals = 4;
  std::size_t fault_seeds = 2;     // best faults of the laboratory that effects are joined to
  std::size_t stride_finals = 12;  // models fitted by strides that are fitted to the end
  Values start;                    // of the base's free numbers; empty: screened
};

Diagnosis diagnose(const Bench&, const ModelSpec& base, const std::vector<const dynamics::Effect*>& catalogue,
                   const DiagnosisOptions&, const Jobs&);

}  // namespace freestand::measurement
