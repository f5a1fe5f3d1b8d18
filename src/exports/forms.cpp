#include "exports/forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exports/rising.hpp"

namespace freestand::exports {
namespace {

using fragility::BinFit;
using fragility::BinStatus;
using fragility::EdpResult;

// Sets `values` to the bins so that none lies below the one before it.
Refusal rise(const LimitState& state, const Intensity& im, const Wanted& wanted, std::vector<double>& values) {
  std::vector<double> fallen, weights;
  for (const Bin& bin : state.bins) {
    fallen.push_back(bin.probability);
    weights.push_back(static_cast<double>(bin.n));
  }
  values = risen(fallen, weights);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Bin& bin = state.bins[i];
    const double change = std::fabs(values[i] - bin.probability);
    if (change > tolerance && !(change <= (bin.upper - bin.lower) / 2))
      return fmt::format(
          "the probability of {} falls near {} {:.4g} (a curve that rises would be off by {:.3g} there, more than its "
          "band from {:.3g} to {:.3g} explains, and targets take curves to rise): choose another intensity, or wider "
          "bins",
          label(wanted), im.name, bin.im, change, bin.lower, bin.upper);
  }
  return {};
}

// The three parts of one bin; the lognormal is NaN where nothing moved.
PartsPoint parts_of(const EdpResult& edp, std::size_t bin, double im) {
  const BinFit& fit = edp.bins[bin];
  if (edp.binary) return {im, edp.surface.probability[bin], 1, 0, 1};
  if (fit.n_moved > 0) return {im, fit.p_over, fit.p_never, fit.lambda, fit.omega};
  return {im, fit.p_over, 1, unknown, unknown};
}

// Gives bins without a lognormal that of the nearest before them, or else behind; false: none has one.
bool borrow_lognormals(std::vector<PartsPoint>& parts) {
  const auto known =
      std::find_if(parts.begin(), parts.end(), [](const PartsPoint& p) { return !std::isnan(p.lambda); });
  if (known == parts.end()) return false;
  PartsPoint last = *known;
  for (PartsPoint& part : parts) {
    if (std::isnan(part.lambda)) {
      part.lambda = last.lambda;
      part.omega = last.omega;
    }
    last = part;
  }
  return true;
}

}  // namespace

std::string label(const Wanted& wanted) {
  const EdpResult& edp = *wanted.edp;
  return edp.binary
             ? edp.name
             : fmt::format("{} > {}{}", edp.name, edp.capacity[wanted.capacity], edp.unit == "1" ? "" : " " + edp.unit);
}

Refusal make_lognormal(LimitState& state, const Wanted& wanted) {
  const Fitted& fitted = state.fitted;
  if (!std::isfinite(fitted.median) || !(fitted.dispersion > 0))
    return fmt::format("{} has no fitted lognormal (nothing to fit one to): use --form discrete", label(wanted));
  if (fitted.not_refuted)
    return fmt::format(
        "the lognormal of {} is not known to be adequate (it is not refuted, but may be off by {:.2g}: more motions "
        "would "
        "tell): use --form discrete",
        label(wanted), fitted.off_by);
  if (!fitted.adequate)
    return fmt::format("the lognormal of {} is not adequate (it may be off by {:.2g}): use --form discrete",
                       label(wanted), fitted.off_by);
  state.curve.form = Form::lognormal;
  state.curve.median = fitted.median;
  state.curve.dispersion = fitted.dispersion;
  state.why = fmt::format("the fitted lognormal is off by at most {:.2g}", fitted.off_by);
  return {};
}

Refusal make_discrete(LimitState& state, const Wanted& wanted, const Intensity& im) {
  std::vector<double> values;
  if (const Refusal refusal = rise(state, im, wanted, values); !refusal.empty()) return refusal;
  state.curve.form = Form::discrete;
  state.curve.points = {{0, 0}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    state.curve.points.push_back({state.bins[i].im, values[i]});
    state.pooled = std::max(state.pooled, std::fabs(values[i] - state.bins[i].probability));
  }
  state.why = "bin by bin";
  return {};
}

Refusal make_table(LimitState& state) {
  state.curve.form = Form::discrete;
  state.curve.points.clear();
  for (const Bin& bin : state.bins) state.curve.points.push_back({bin.im, bin.probability});
  state.why = "a table holds all that is known";
  return {};
}

Refusal make_parts(LimitState& state, const Wanted& wanted, const fragility::Result& result, const Intensity& im) {
  const EdpResult& edp = *wanted.edp;
  std::vector<double> values;
  if (const Refusal refusal = rise(state, im, wanted, values); !refusal.empty()) return refusal;
  state.curve.form = Form::parts;
  state.curve.ln_capacity = edp.binary ? 0 : std::log(state.capacity);
  std::vector<PartsPoint>& parts = state.curve.parts;
  parts.assign(1, {0, 0, 1, NAN, NAN});  // without shaking
  for (const Bin& bin : state.bins) {
    const BinFit& fit = edp.bins[bin.index];
    if (!edp.binary && fit.n_moved > 0 && fit.status != BinStatus::fitted)
      return fmt::format(
          "{} has no three parts at {} {:.4g} (its lognormal there is not fitted, or fails its test): use "
          "--form discrete",
          label(wanted), im.name, result.im[bin.index]);
    parts.push_back(parts_of(edp, bin.index, bin.im));
  }
  if (!borrow_lognormals(parts))
    return fmt::format("{} has no three parts (nothing moved in any bin): use --form discrete", label(wanted));
  state.why = "the three parts of each bin";
  return {};
}

}  // namespace freestand::exports
