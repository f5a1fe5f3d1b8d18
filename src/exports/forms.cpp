#include "exports/forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fragility/rising.hpp"

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
  values = fragility::risen(fallen, weights);
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

// Is the second within the first at each bin?
bool nested(const LimitState& milder, const LimitState& graver) {
  if (milder.bins.size() != graver.bins.size()) return false;
  for (std::size_t i = 0; i < milder.bins.size(); ++i)
    if (milder.bins[i].im != graver.bins[i].im || graver.bins[i].probability > milder.bins[i].probability + tolerance)
      return false;
  return true;
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

// How far straight lines between the points are off the counts, within these places, and annual rates by them off those by the curve that
// `risk` goes by: the lognormal where that is adequate.
void measure_lines(LimitState& state, const std::vector<double>& places) {
  constexpr int checked = 400;
  const Curve fitted = lognormal(state.fitted.median, state.fitted.dispersion);
  double of_lines[3] = {}, of_curve[3] = {};
  for (int i = 0; i <= checked; ++i) {
    const double im = places.front() * std::pow(places.back() / places.front(), i / static_cast<double>(checked));
    const double line = probability(state.curve, im), curve = (*state.counted)(im);
    state.off_lines = std::max(state.off_lines, std::fabs(line - curve));
    for (int k = 0; k < 3; ++k) {
      const double events = std::pow(im / places.front(), -(k + 1));
      of_lines[k] += line * events;
      of_curve[k] += (state.fitted.adequate ? probability(fitted, im) : curve) * events;
    }
  }
  for (int k = 0; k < 3; ++k)
    if (of_curve[k] > 0) state.rate_by_lines[k] = of_lines[k] / of_curve[k];
}

// With the intensity, by its fragility function.
bool grows(const Wanted& wanted) {
  const auto& functions = wanted.edp->functions;
  return wanted.capacity < functions.size() && std::isfinite(functions[wanted.capacity].median);
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
    return fmt::format("{} has no fitted lognormal ({}): use --form discrete", label(wanted),
                       grows(wanted) ? "one over another intensity is none over this" : "nothing to fit one to");
  if (fitted.not_refuted && std::isnan(fitted.off_by))
    return fmt::format(
        "the lognormal of {} is not known to be adequate (two bins or less have shares, and a lognormal meets any "
        "two): "
        "use --form discrete",
        label(wanted));
  if (fitted.not_refuted)
    return fmt::format(
        "the lognormal of {} is not known to be adequate (it is not refuted, but may be off by {:.2g}: more motions "
        "would tell): use --form discrete",
        label(wanted), fitted.off_by);
  if (fitted.rates_differ)
    return fmt::format(
        "the lognormal of {} gives other annual rates than the counts by more than chance explains (where shares are "
        "small; in probability it is off by {:.2g} at most): use --form discrete",
        label(wanted), fitted.off_by);
  if (!fitted.adequate)
    return fmt::format("the lognormal of {} is not adequate (it may be off by {:.2g}): use --form discrete",
                       label(wanted), fitted.off_by);
  state.curve = lognormal(fitted.median, fitted.dispersion);
  state.why = fmt::format("the fitted lognormal is off the shares of bins by at most {:.2g}", fitted.off_by);
  return {};
}

Refusal make_discrete(LimitState& state, const Wanted& wanted, const fragility::Result& result, const Intensity& im,
                      bool counted, bool straight) {
  const EdpResult& edp = *wanted.edp;
  std::vector<double> values;
  if (const Refusal refusal = rise(state, im, wanted, values); !refusal.empty()) return refusal;
  std::vector<fragility::CountedBin> bins, shares;
  std::size_t lognormals = 0;
  double off_by = 0;  // most of these
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Bin& bin = state.bins[i];
    const bool by_law = !counted && !edp.binary && edp.bins[bin.index].status == BinStatus::fitted;
    state.pooled = std::max(state.pooled, std::fabs(values[i] - bin.probability));
    bins.push_back(fragility::counted_bin(result, bin.index, values[i]));
    bins.back().by_law = by_law;
    shares.push_back(fragility::counted_bin(result, bin.index, bin.counted));
    if (!by_law) continue;
    ++lognormals;
    off_by = std::max(off_by, edp.bins[bin.index].off_by);
  }
  state.curve.form = Form::discrete;
  using Shape = fragility::CountedCurve::Shape;
  // What grows with no intensity is handed on as one that never falls: by its pooled bins, not by cells that rise and fall.
  const Shape shape = grows(wanted) ? Shape(edp.functions[wanted.capacity]) : Shape();
  state.counted.emplace(shares, shape);
  state.drawn.emplace(bins, straight ? Shape{} : shape);
  double least = bins.front().im, most = bins.back().im;
  if (!straight && grows(wanted)) {
    const fragility::FragilityFunction& f = edp.functions[wanted.capacity];
    least = f.im_least, most = f.im_most;
  }
  state.places = fragility::places_to_follow(*state.drawn, bins, least, most);
  state.why = "the counted shares";
  if (lognormals > 0)
    state.why = fmt::format("the {}lognormals of {} bins, off by at most {:.2g}",
                            lognormals == bins.size() ? "" : "counted shares and the ", lognormals, off_by);
  return {};
}

void put_points(std::vector<LimitState>& states) {
  std::vector<double> places;
  for (const LimitState& state : states) places.insert(places.end(), state.places.begin(), state.places.end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end(), [](double a, double b) { return b - a <= 1e-9 * b; }),
               places.end());
  for (std::size_t s = 0; s < states.size(); ++s) {
    LimitState& state = states[s];
    state.curve.points = {{0, 0}};
    for (const double im : places)
      state.curve.points.push_back({im, std::max(state.curve.points.back().probability, (*state.drawn)(im))});
    if (s > 0 && nested(states[s - 1], state))
      for (std::size_t i = 0; i < state.curve.points.size(); ++i) {
        double& p = state.curve.points[i].probability;
        p = std::min(p, states[s - 1].curve.points[i].probability);
      }
  }
  for (LimitState& state : states) measure_lines(state, places);
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
      return fmt::format("{} has no three parts at {} {:.4g} ({}): use --form discrete", label(wanted), im.name,
                         result.im[bin.index],
                         std::isnan(fit.off_by) ? "its lognormal there is not fitted"
                                                : fmt::format("its lognormal there may be off by {:.2g}", fit.off_by));
    parts.push_back(parts_of(edp, bin.index, bin.im));
  }
  if (!borrow_lognormals(parts))
    return fmt::format("{} has no three parts (nothing moved in any bin): use --form discrete", label(wanted));
  state.why = "the three parts of each bin";
  return {};
}

}  // namespace freestand::exports
