// The lognormal of demands of which the small ones are only counted: what lies at or below a threshold (0.1 mm of slip,
// say) is "still", whether the block never moved or moved by less than anyone can tell.
//
// Of those that stood, a share `never` has no demand at all, the others are lognormal, and below the threshold c only
// their number is known. Maximum likelihood of
//   (never + (1 - never) Phi(z))^still  prod (1 - never) phi((ln x - lambda)/omega)/(omega x),   z = (ln c - lambda)/omega:
// where more are still than the lognormal has below c, lambda and omega are those of the truncated lognormal (A. C.
// Cohen, Ann. Math. Stat. 21, 1950) and `never` makes up the count; else never = 0, and they are those of the
// left-censored one (Cohen, Technometrics 1, 1959), found in the parameters 1/omega and lambda/omega, in which the
// likelihood has one maximum (R. Olsen, Econometrica 46, 1978).
#pragma once

namespace freestand::fragility {

struct ThresholdFit {
  double lambda, omega;
  double never;  // share, of those that stood, that has no demand at all
  double below;  // Phi(z): the lognormal's own share at or below the threshold
};

// moved: number of samples above the threshold, with the sums of ln x and ln^2 x over them; still: number at or below
// (reals, since resampled sums are weighted). threshold 0: lambda and omega by their plain moments, and never =
// still/(still + moved). Everything is NaN with fewer than two above, with no spread, or where they spread so far above
// the threshold that no lognormal's tail does (squared ln(x/c) of twice the mean's square or more).
ThresholdFit fit_above(double moved, double sum_ln, double sum_ln2, double still, double threshold);

// The truncated normal from the mean of y - c and of (y - c)^2 over y > c: {mean, standard deviation}, NaN as above.
struct TruncatedNormal {
  double mean, deviation;
};
TruncatedNormal fit_truncated(double c, double first, double second);

}  // namespace freestand::fragility
