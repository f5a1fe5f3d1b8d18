// chance.hpp for tests that say their peaks alone. How far a peak strays is not known beforehand: what counts is by which share the sum S
// of the squared ln ratios falls, each in units of how such peaks scatter (fit/peak_scatter.hpp), and data are made from a model with that scatter.
#pragma once

#include "measurement/fit/peak_scatter.hpp"
#include "measurement/verdict/chance.hpp"

namespace freestand::measurement {

// How the peaks of the calibration tests scatter about a model.
PeakScatter scatter_of_peaks(const Bench&, const ModelFit&, const Jobs&);

// Does any effect help? observed: the largest share of S that a change of the peaks takes away, which an effect makes at one of many
// strengths or as it was fitted, beyond what the base's own numbers can. Where the base misses peaks by no more than they are read to, none need help.
Chance chance_of_gain_of_peaks(const Bench&, const ModelFit& base, const std::vector<const ModelFit*>& tried,
                               const Jobs&);

// Can the best be told from a rival? observed: by which share S of the best is below that of the rival.
Chance chance_of_lead_of_peaks(const Bench&, const ModelFit& best, const ModelFit& rival, const Jobs&);

// How far another test of the calibration set is from each, in the mean over all the others: what one knows of a test without a model.
std::vector<TestError> errors_of_another_test(const Bench&);

// Is a model enough? By how much peaks scatter about the truth is not known. But if they scatter about a prediction m that is their median, then
// of two tests one lies on each side of m half the time, and there they are further apart than either is from m: the squared miss r^2, with its
// limit (score.hpp), has E r^2(y, y') >= (1/2) E max(r^2(y, m), r^2(y', m)) >= (1/2) E r^2(y, m), and tests of different motions lie further
// apart still. So the truth misses by no more than twice what another test does in the mean square, whatever the scatter, falls and standing
// still included. observed: by how much more than that the model does. Where both are as good, the difference of each test is as likely
// the other way round: signs are drawn. (n tests that all say so have p = 2^-n: fewer than five refute no model.)
Chance chance_of_misfit_of_peaks(const Bench&, const ModelFit&);

}  // namespace freestand::measurement
