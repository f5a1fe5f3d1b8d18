// The constants on which a verdict rests. All else is computed: from the sensors' noise as it is
// heard (sensor.hpp), from replays of the floor's noise (judge.hpp), and from data that are made and fitted again
// (chance.hpp). How hard is searched (Effort, DiagnosisOptions) decides what is found, not what is said of it.
//
//   constant          decides                                     derivation
//   chance_level      every other p value: help, lead, enough     custom: one set in twenty without an effect may be
//                                                                  said to have one, as a laboratory that publishes
//                                                                  at 5 % agrees to
//   further_level     does one more help                          of sets with one effect that is enough at most 3 in
//                                                                  100 may be given a wrong name: 1 by this question, the
//                                                                  rest by leads
//   adequate          enough, though G is more than chance         a model's own error e beside noise of 1 leaves
//                                                                  sqrt(1 + e^2); at e = 1 it is as large as what one
//                                                                  reading strays by. (With 10^4 readings a test of
//                                                                  chance alone rejects errors that nobody can see.)
//                                                                  So in each test, and on those left out in the mean
//   beyond_practice   which rivals with odd numbers are named      the catalogue's ranges are met in practice and given
//                                                                  to one digit; half a decade further, sqrt(10), is
//                                                                  another order of magnitude
//   fault_deviations  how far a dimension or a gain is sought      of normal deviates one in 370 lies further off
//   longest_lag_s     how far a clock is sought                    a strong motion swings to and fro in 0.3 s and more; half
//                                                                  of that away a response turned round looks like one
//                                                                  that is late
//   longest_lag_of_known_sign_s                                    as far as recorders are started apart by hand
#pragma once

namespace freestand::measurement {

inline constexpr double chance_level = 0.05;
inline constexpr double further_level = 0.01;
inline constexpr double adequate = 1.4142135623730951;
inline constexpr double beyond_practice = 3.1622776601683795;
inline constexpr double fault_deviations = 3;
inline constexpr double longest_lag_s = 0.15;
inline constexpr double longest_lag_of_known_sign_s = 1;

}  // namespace freestand::measurement
