// The verbs that hold the model against measurements.
//
// comparison.json
//   format "freestand-comparison/2", study, measurements, specimen_model (effects of the model), error_unit ("noise units",
//   "ln ratio", "Brier"), method (of the calibration, a sentence)
//   tests: [{id, role, kind (history|peaks|outcome), floor_peak_g, error_noise_units, error_relative,
//     error_floor_noise_allowed (error_noise_units with the floor's noise allowed for, sample by sample, and where friction scatters
//     with own_friction, a factor on that of this test, else null), error_expected
//     (what noise alone would make), channels: [{name, error_noise_units, error_relative, bias, autocorrelation}],
//     ln_ratio (of peaks: root of the score, with the sign of what is missed), peaks: [{name, measured, model, compared}],
//     overturned_measured, overturned_probability, outcome, error_of_mean
//     (error_noise_units of the mean of the predictions of many draws, or null), within_band (share of the readings that lie where
//     90 of 100 are predicted)}]
//   calibration, holdout: {error_noise_units, error_relative, error, error_expected, error_floor_noise_allowed, error_of_mean,
//     tests}; error in error_unit; error_expected of outcomes: the score that chance alone would make, were the model's probabilities
//     right; null where there are no such tests
//   parameters: [{name, unit, value, lower, upper, interval: [l, u] or null, no_interval (why, where it is null),
//     calibrated (by this run), interval_90 (of the joint draws, or null)}]
//   posterior: null where there are no draws, else {table, draws, dispersion (of the tests' pulls on the numbers, over what
//     noise makes), degrees_of_freedom, friction_scatter (standard deviation of ln mu from test to test), slip_bias_ln and
//     slip_scatter_ln (of peaks: ln(measured/model) of another test), share_counted}
//   peak_ratio: {count, bias_ln, scatter_ln, ratio}: predicted over measured peak slips
//   findings: [sentence]
//   histories: of the five worst: [{id, dt_s, time_s: [], floor_acceleration_mps2: [], CHANNEL: {measured: [], model: [],
//     residual: [], noise, spread: [] (standard deviation that the floor's noise makes),
//     band: {lower, mean, upper} (where 90 of 100 readings are predicted, and the mean of the predictions, or null)}}], at most 2000 points each
//   error_tables: {calibration: [{variable, unit, label, edge, centre, count, error_noise_units, growth_noise_units,
//     bias_noise_units, growth_slip_m, growth_rotation_rad}], holdout: [...]}; variables phase, speed_mps, path_m,
//     position_m, direction (where slip was measured), normal_g, time_s, floor_g; growth: change of the residual within
//     0.1 s, of the channel that changes more, or of one (0: not measured)
//   ladder: [{step, error_calibration, error_holdout, noise_floor (of the calibration tests), noise_floor_holdout,
//     explained_holdout, explained_calibration (error_floor_noise_allowed of these tests)}] of the study
//
// diagnosis.json
//   format "freestand-diagnosis/2", study, measurements, fingerprint (of all that it follows from), error_unit, verdict, effects, sentences, findings
//   decided_by: the key by which the verdict was reached: tests_of_chance, friction_scatter, findings; where no chance was
//     computed chi_square_left_out (histories) or score_left_out_above_best (peaks) of the candidates
//   enough_if: of none, with what stated otherwise, within its tolerance, the model is enough; null: as it stands
//   friction_scatter.odd_test: where friction differs from test to test, the one test that alone does; or null
//   reason: of bad_data: "data" (they look wrong in a sign, a clock or a unit, or a dimension or a gain is not as stated);
//     of the verdict unknown: "none_helps" (no effect lowers
//     the error by more than chance), "none_suffices" (one does, and more is left than noise makes), "one_law" (several
//     together would be enough, and one law of no catalogue does with fewer numbers); else null
//   best: the candidate that the verdict and `law` speak of, as its `effect`; null where there is none
//   base, candidates: [{effect (two joined by "+"), effects: [], visible, parameters: {NAME: {value, interval, no_interval,
//     unit}},
//     error_calibration, error_left_out, error_left_out_se, error_left_out_floor_noise_allowed (sqrt of chi_square_left_out
//     over samples: 1 where sensor and floor noise explain all), chi_square_left_out, chi_square_fit (of the fit to all
//     tests), delta_bic, score_left_out_above_best (in the mean, paired), score_left_out_above_best_se, as_good_as_best
//     (chance does not part it from `best`; of `best` too), numbers_as_met_in_practice, left_out_refitted (else all that is of
//     tests left out is null), remark (why it is not named though it misses them by less, or, of outcomes, was not fitted to
//     the end; or null)}]: the best, those as good, others that were fitted to the end by left-out
//     error, the rest; of
//     `base` no effect
//   noise_floor: error that sensor and floor noise alone would make; of outcomes the score that chance alone would make,
//     were the base's probabilities right
//   recovered_force: {samples, mean_mu, sample_noise_mu, base_mu, tables: [{variable, unit, edge, centre, count, mu, mu_deviation,
//     mu_lower, mu_upper, force_mps2, force_lower_mps2, force_upper_mps2, share_explained (of the scatter of mu),
//     share_of_force_explained, law: {effects, mu, force_mps2,
//     follows (whether it changes with this variable alone)}}]}; `law`: that of `best` through the same samples, as
//     friction and as the force that the base lacks, where it has one
//   suggested_motion: where the verdict is ambiguous, else null: {between: [], motion: {pulse, period_s,
//     peak_acceleration_g}, specimen (a sentence; null: the same), separation_noise_units, sentence}; of outcomes motion:
//     {test, scale}, and probabilities of overturning with each rival, repeats
// Both end with created_utc, version, git_commit, command, compiler, host, ranks.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "measurement/tell/compare.hpp"
#include "measurement/verdict/diagnose.hpp"
#include "parallel/communicator.hpp"
#include "study/read_validation.hpp"
#include "study/run_folder.hpp"

namespace freestand::study {

struct ValidationRun {
  std::string study;         // file
  std::string measurements;  // file in place of the study's; empty: the study's
  std::string command;       // command line
  bool quiet = false;
};

// The three, whole: read, work on all ranks, the document on every rank. Collective. Throw Error.
struct Compared {
  nlohmann::ordered_json json;
  std::string fitted;  // the study with the numbers that were fitted, for a file in `folder`: a sweep takes it as it is
  std::string draws;   // the table of their joint draws beside it, posterior_table; empty: none
};
Compared compare(const parallel::Communicator&, const ValidationRun&, const std::filesystem::path& folder);
// What its fits have found is kept in the folder, from which the same diagnosis goes on after an interruption.
nlohmann::ordered_json diagnose(const parallel::Communicator&, const ValidationRun&, RunFolder&);

// The study with the effect in it, fitted, as YAML text for a file in `folder`. effect: a name of the catalogue, a mapping in YAML
// ("{name: bumps, friction: ..., parameters: {a: {calibrate: [0, 1]}}}"), or a file that holds one.
std::string add(const parallel::Communicator&, const ValidationRun&, const std::string& effect,
                const std::filesystem::path& folder);

}  // namespace freestand::study
