#include "fragility/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fragility/fragility_function.hpp"
#include "fragility/goodness.hpp"

namespace freestand::fragility {
namespace {

// Of n motions a standard error is known to 1/sqrt(2 (n - 1)): of ten to a quarter.
constexpr int few_motions = 10;

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}", value, unit == "1" ? "" : " " + unit);
}

// "0.0623 to 2.88 g": the mean intensities of the outermost fine cells.
std::string range(const FragilityFunction& curve, const std::string& unit) {
  return fmt::format("{:.3g} to {}", curve.im_least, with_unit(curve.im_most, unit));
}

void about_outcomes(const Tally& tally, const Result& result, std::vector<std::string>& out) {
  for (const Outcome outcome : {Outcome::painleve, Outcome::step_limit, Outcome::not_finite}) {
    const std::int64_t count = tally.count_of(outcome);
    if (count > 0)
      out.push_back(fmt::format("{} of {} samples ended as {} ({}); they enter no fit and no surface.", count,
                                result.samples, name(outcome), failure(outcome)));
  }
  if (result.outside_im > 0)
    out.push_back(fmt::format(
        "{} of {} samples have an IM ({}) outside the edges that were given, {:.3g} to {:.3g}, and are left "
        "out of bins and curves: edges that reach further take them.",
        result.outside_im, result.samples, result.im_name, result.im_edge.front(), result.im_edge.back()));
  for (std::size_t e = 0; e < tally.options().edps.size(); ++e)
    if (tally.missing(e) > 0)
      out.push_back(fmt::format("{} samples have no value of {} and are left out of it.", tally.missing(e),
                                tally.options().edps[e].name));
}

constexpr const char *one_record = "The motions are those of only one record, or of one group",
                     *few_records = "The samples come from only ";

void about_motions(const Tally& tally, const Result& result, std::vector<std::string>& out) {
  const int records = tally.groups().records(), motions = std::min(records, result.motions);
  if (records == 1)
    out.push_back(fmt::format(
        "{}: the bands say how well the answer for these motions is known, and nothing about how much those of "
        "another would differ.",
        one_record));
  else if (records > 0 && motions < few_motions)
    out.push_back(fmt::format("{}{} motions: bands from resampling so few are rough.", few_records, motions));
}

void about_bins(const EdpResult& edp, const Options& options, std::vector<std::string>& out) {
  int too_few = 0, rejected = 0, adequate = 0, unproven = 0, failed = 0;
  double worst = 0, most_off = 0, most_unproven = 0, most_failed = 0;
  for (const BinFit& bin : edp.bins) {
    if (bin.status == BinStatus::too_few) ++too_few;
    if (bin.n_failed > 0) {
      ++failed;
      most_failed =
          std::max(most_failed, static_cast<double>(bin.n_failed) / static_cast<double>(bin.n + bin.n_failed));
    }
    if (bin.status == BinStatus::fitted && bin.fdr_rejected) {
      ++adequate;
      most_off = std::max(most_off, bin.off_by);
    }
    if (bin.status == BinStatus::not_refuted) {
      ++unproven;
      if (std::isfinite(bin.off_by)) most_unproven = std::max(most_unproven, bin.off_by);
    }
    if (bin.status != BinStatus::rejected) continue;
    ++rejected;
    worst = std::max(worst, bin.ks_statistic);
  }
  if (too_few > 0)
    out.push_back(fmt::format("{}: {} of {} bins hold fewer than {} samples and are left empty.", edp.name, too_few,
                              edp.bins.size(), options.minimum_samples));
  if (failed > 0)
    out.push_back(
        fmt::format("{}: samples failed in {} of {} bins, up to {:.2g} of a bin; the columns least and most of "
                    "surface.csv tell what they could change.",
                    edp.name, failed, edp.bins.size(), most_failed));
  if (adequate > 0)
    out.push_back(
        fmt::format("{}: the lognormal is not exact in {} of {} bins, but off by at most {:.3f} there, and is "
                    "used.",
                    edp.name, adequate, edp.bins.size(), most_off));
  const char* rows = options.empirical_fallback ? "these rows are the empirical ones" : "these rows are still the fit";
  if (unproven > 0)
    out.push_back(
        fmt::format("{}: the lognormal is not refuted in {} of {} bins, but may be off by up to {:.2f} there (more "
                    "motions would tell); {}.",
                    edp.name, unproven, edp.bins.size(), most_unproven, rows));
  if (rejected > 0)
    out.push_back(
        fmt::format("{}: the lognormal fails goodness of fit in {} of {} bins (its probabilities are off by up to "
                    "{:.3f}); {}.",
                    edp.name, rejected, edp.bins.size(), worst, rows));
}

// "slip > 0.1 m (0.62), slip > 0.5 m (145)" of the capacities that are meant; "" of none.
template <class Meant, class Number>
std::string capacities(const EdpResult& edp, const Meant& meant, const Number& number) {
  std::string text;
  for (std::size_t c = 0; c < edp.functions.size(); ++c) {
    if (!meant(edp.functions[c])) continue;
    const std::string what =
        edp.binary ? edp.name
                   : fmt::format("{} > {}{}", edp.name, edp.capacity[c], edp.unit == "1" ? "" : " " + edp.unit);
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", what, number(edp.functions[c]));
  }
  return text;
}

// The fitted curves of one demand over all bins, by capacity.
void about_functions(const EdpResult& edp, const Options& options, const Result& result,
                     std::vector<std::string>& out) {
  const auto median = [&](const FragilityFunction& f) { return with_unit(f.median, result.im_unit); };
  const auto off_by = [](const FragilityFunction& f) {
    return std::isnan(f.off_by) ? "by how much two bins or less do not tell" : fmt::format("by {:.2g}", f.off_by);
  };
  const auto told = [&](const std::string& concerned, const std::string& sentence) {
    if (!concerned.empty())
      out.push_back(fmt::format("{}: {}", edp.name, fmt::format(fmt::runtime(sentence), concerned)));
  };
  if (edp.functions.empty()) return;
  told(
      capacities(
          edp, [](const FragilityFunction& f) { return f.extrapolated; }, median),
      fmt::format(
          "the median of the fitted curve lies outside the intensities {}, {} (but for a few samples), for {{}}: it is "
          "an extrapolation.",
          result.outside_im > 0 ? "taken" : "swept", range(edp.functions[0], result.im_unit)));
  told(capacities(
           edp, [](const FragilityFunction& f) { return !f.adequate && f.misfit_p <= test_level; }, off_by),
       "one lognormal curve is too simple, and may be off the true shares, for {}.");
  told(capacities(
           edp,
           [&](const FragilityFunction& f) {
             return rates_differ(f) && (f.misfit_p > test_level || f.off_by <= options.adequate);
           },
           [](const FragilityFunction& f) { return fmt::format("p = {:.2g}", f.rate_p); }),
       "where shares are small the fitted curve is not that of the counts, and gives other annual rates than these by "
       "more than chance explains: exports and risks take the counts, for {}.");
  told(capacities(
           edp, [](const FragilityFunction& f) { return not_refuted(f) && std::isnan(f.off_by); }, median),
       "shares are known in two bins or less, which a lognormal always meets: exports and risks take the counts, for "
       "{}; more bins, or other edges, would tell.");
  told(capacities(
           edp, [](const FragilityFunction& f) { return not_refuted(f) && !std::isnan(f.off_by); }, off_by),
       fmt::format(
           "the fitted curve is not refuted, but may be off the true shares by more than {:g}, for {{}}: exports and "
           "risks take the counts; more motions would tell.",
           options.adequate));
  told(capacities(
           edp, [](const FragilityFunction& f) { return f.penalised && !std::isnan(f.median); }, median),
       "one intensity parts all samples above from all below: the fitted curve is a penalised estimate for {}.");
}

void about_overturning(const Tally& tally, const Result& result, std::vector<std::string>& out) {
  const std::int64_t over = tally.count_of(Outcome::overturned);
  if (over == 0) return;
  const FragilityFunction& curve = result.overturning;
  if (curve.extrapolated)
    out.push_back(
        fmt::format("The median of the overturning curve ({}) lies outside the intensities {}, {} (but for a few "
                    "samples): it is an extrapolation.",
                    with_unit(curve.median, result.im_unit), result.outside_im > 0 ? "taken" : "swept",
                    range(curve, result.im_unit)));
  if (not_refuted(curve) && std::isnan(curve.off_by))
    out.push_back(
        "Shares of overturning are known in two bins or less, which a lognormal always meets: exports and risks take "
        "the counts; more bins, or other edges, would tell.");
  else if (not_refuted(curve))
    out.push_back(
        fmt::format("The overturning curve is not refuted, but may be off the true shares by {:.2f}: exports and risks "
                    "take the counts; more motions would tell.",
                    curve.off_by));
  if (rates_differ(curve) && (curve.misfit_p > test_level || curve.off_by <= tally.options().adequate))
    out.push_back(
        fmt::format("Where shares are small the overturning curve is not that of the counts, and gives other annual "
                    "rates than these by more than chance explains (p = {:.2g}): exports and risks take the counts.",
                    curve.rate_p));
  if (curve.misfit_p <= test_level && !curve.adequate && !(curve.off_by <= tally.options().adequate))
    out.push_back(fmt::format(
        "The overturning curve misses the counted shares by up to {:.2g}, at an IM of {:.3g} (p = {:.2g}): one "
        "lognormal curve is too simple{}.",
        curve.misfit, curve.misfit_im, curve.misfit_p,
        std::isnan(curve.off_by) ? "" : fmt::format(", and may be off by {:.2f}", curve.off_by)));
  if (curve.penalised && !std::isnan(curve.median))
    out.push_back(
        "One intensity parts all samples that overturned from all that stood: the overturning curve is a penalised "
        "estimate.");
  if (std::isnan(curve.median))
    out.push_back(
        "Samples overturned, but not more often at higher intensity, or all of them did: there is no overturning "
        "curve.");
}

}  // namespace

std::vector<std::string> warnings(const Tally& tally, const Result& result) {
  std::vector<std::string> out;
  about_outcomes(tally, result, out);
  about_motions(tally, result, out);
  // Demand by demand as the study names them, so that what concerns the first one is read first.
  const auto overturned = [](const EdpResult& edp) { return edp.name == "overturned"; };
  for (const EdpResult& edp : result.edps) {
    about_bins(edp, tally.options(), out);
    overturned(edp) ? about_overturning(tally, result, out) : about_functions(edp, tally.options(), result, out);
  }
  if (std::none_of(result.edps.begin(), result.edps.end(), overturned)) about_overturning(tally, result, out);
  return out;
}

std::string told_of_motions(const Result& result) {
  for (const std::string& warning : result.warnings)
    if (warning.starts_with(one_record) || warning.starts_with(few_records)) return warning;
  return "";
}

}  // namespace freestand::fragility
