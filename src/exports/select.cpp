#include "exports/select.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "exports/forms.hpp"
#include "fragility/fragility_function.hpp"

namespace freestand::exports {
namespace {

using fragility::EdpResult;
using fragility::Result;

Fitted fitted_of(const Wanted& wanted) {
  if (wanted.capacity >= wanted.edp->functions.size()) return {};
  const fragility::FragilityFunction& f = wanted.edp->functions[wanted.capacity];
  if (!(f.dispersion > 0)) return {};
  return {f.median,   f.median_se,    f.dispersion,   f.dispersion_se, f.off_by,
          f.adequate, not_refuted(f), f.extrapolated, rates_differ(f)};
}

// The rows of the surface. Empty ones are left out or refused.
std::vector<Bin> bins_of(const Result& result, const Intensity& im, const Wanted& wanted, const Request& request,
                         bool table) {
  const EdpResult& edp = *wanted.edp;
  const fragility::Surface& surface = edp.surface;
  std::vector<Bin> bins;
  for (std::size_t b = 0; b < edp.bins.size(); ++b) {
    const std::size_t at = b * edp.capacity.size() + wanted.capacity;
    const double p = request.counted ? surface.empirical[at] : surface.probability[at];
    if (p < 0 || p > 1)
      throw Error(fmt::format("the probability of {} at {} {:.4g} is {} (it must lie within 0 and 1): fit again",
                              label(wanted), im.name, result.im[b], p),
                  Exit::data);
    if (std::isnan(p) && !request.skip_empty && !table)
      throw Error(
          fmt::format("the surface of {} has an empty row at {} {:.4g} ({} samples there are too few): make the bins "
                      "wider and fit again, or add --skip-empty, which leaves the row out",
                      label(wanted), im.name, result.im[b], edp.bins[b].n));
    if (!std::isnan(p) && (table || result.im[b] > 0))
      bins.push_back({b, result.im[b], p, (request.counted ? surface.empirical_lower : surface.lower)[at],
                      (request.counted ? surface.empirical_upper : surface.upper)[at], surface.empirical[at],
                      edp.bins[b].n});
  }
  if (bins.empty())
    throw Error(fmt::format(
        "{} has no bin with enough samples above {} 0 (nothing is known of it): sweep more samples, or choose "
        "another intensity",
        label(wanted), im.name));
  if (bins.size() == 1 && !table)
    throw Error(
        fmt::format("{} is known at one intensity only, {} {:.4g} (a curve takes two at least): sweep a range of "
                    "intensities, or give "
                    "narrower bins and fit again",
                    label(wanted), im.name, bins.front().im));
  return bins;
}

LimitState state_of(const Result& result, const Intensity& im, const Wanted& wanted, const Request& request,
                    bool table) {
  LimitState state;
  state.name = wanted.name;
  state.demand = wanted.edp->name;
  state.unit = wanted.edp->unit;
  if (!wanted.edp->binary) state.capacity = wanted.edp->capacity[wanted.capacity];
  state.fitted = fitted_of(wanted);
  state.bins = bins_of(result, im, wanted, request, table);
  return state;
}

// From the lowest to the highest intensity that samples had.
void take_range(Model& model, const std::vector<Wanted>& wanted) {
  model.im_least = model.states.front().bins.front().im;
  model.im_most = model.states.front().bins.back().im;
  const auto include = [&](double least, double most) {
    if (least > 0) model.im_least = std::min(model.im_least, least);
    if (most > 0) model.im_most = std::max(model.im_most, most);
  };
  for (const LimitState& state : model.states) include(state.bins.front().im, state.bins.back().im);
  for (const Wanted& one : wanted)
    if (one.capacity < one.edp->functions.size())
      include(one.edp->functions[one.capacity].im_least, one.edp->functions[one.capacity].im_most);
}

// Where limit states cross below the highest intensity swept: a more severe one must not be likelier. Lognormals are
// followed down to where each is below 1e-9.
Refusal crossing(const Model& model) {
  double low = model.im_least;
  for (const LimitState& state : model.states)
    if (state.curve.form == Form::lognormal)
      low = std::min(low, state.curve.median * std::exp(-6 * state.curve.dispersion));
  std::vector<double> places;
  for (int i = 0; i <= 400; ++i) places.push_back(low * std::pow(model.im_most / low, i / 400.0));
  for (const LimitState& state : model.states)
    for (const Bin& bin : state.bins) places.push_back(bin.im);
  for (std::size_t s = 1; s < model.states.size(); ++s)
    for (const double im : places) {
      const LimitState &milder = model.states[s - 1], &graver = model.states[s];
      const double a = probability(milder.curve, im), b = probability(graver.curve, im);
      if (b > a + tolerance)
        return fmt::format(
            "limit states cross at {} {:.4g} ({} has {:.3g} there and {}, which stands behind it, {:.3g}; targets set "
            "such a state to 0 without a word): give them least severe first{}, or export them one by one",
            model.im.name, im, milder.name, a, graver.name, b,
            milder.curve.form == Form::lognormal ? ", use --form discrete" : "");
    }
  return {};
}

void measure_surface(LimitState& state) {
  for (const Bin& bin : state.bins) {
    const double off = std::fabs(probability(state.curve, bin.im) - bin.probability);
    if (std::isnan(state.off_surface_at) || off > state.off_surface) {
      state.off_surface = off;
      state.off_surface_at = bin.im;
    }
  }
}

// Warnings begin with the demand that they are of, where they are of one.
bool of_another_demand(const std::string& warning, const Model& model, const Result& result) {
  const auto goes_out = [&](const EdpResult& edp) {
    return std::any_of(model.states.begin(), model.states.end(),
                       [&](const LimitState& s) { return s.demand == edp.name; });
  };
  return std::any_of(result.edps.begin(), result.edps.end(),
                     [&](const EdpResult& edp) { return warning.starts_with(edp.name + ": ") && !goes_out(edp); });
}

// Straight lines that bend less than the curve which risks are computed by have other annual rates: told from a twentieth on.
void tell_rates_by_lines(Model& model) {
  for (const LimitState& state : model.states) {
    const auto* worst =
        std::max_element(std::begin(state.rate_by_lines), std::end(state.rate_by_lines),
                         [](double a, double b) { return std::fabs(std::log(a)) < std::fabs(std::log(b)); });
    if (*worst >= 0.95 && *worst <= 1.05) continue;
    model.notes.push_back(
        fmt::format("{}: annual rates by these straight lines are {:.2g} times those that `freestand risk` gives by "
                    "its {}, where the hazard "
                    "falls by im^-{}: {}",
                    state.name, *worst, state.fitted.adequate ? "lognormal" : "counts", worst - state.rate_by_lines + 1,
                    state.fitted.adequate
                        ? "exported alone, the lognormal itself goes out"
                        : "over narrower bins, or out of a database from the folder of its sweep, they are nearer"));
  }
}

// A list of states says that each holds the next, and its users subtract: what overturns exceeds every capacity of a continuous demand, but other
// demands are exceeded by samples of their own.
void tell_other_demands(Model& model) {
  for (std::size_t s = 1; s < model.states.size(); ++s) {
    const LimitState &milder = model.states[s - 1], &graver = model.states[s];
    if (milder.demand == graver.demand || (!std::isnan(milder.capacity) && graver.demand == "overturned")) continue;
    model.notes.push_back(fmt::format(
        "{} is of another demand than {}: a list of states is read as if each held the next, so that P({} and not {}) "
        "is the "
        "difference of the two, which is too little where samples reach the second without the first: export "
        "them one by one where that matters",
        graver.name, milder.name, milder.name, graver.name));
  }
}

void take_notes(Model& model, const Result& result, Form form, bool table) {
  const std::string unit = model.im.unit == "1" ? "" : " " + model.im.unit;
  const std::vector<Bin>& bins = model.states.front().bins;
  if (form == Form::lognormal)
    model.notes.push_back(fmt::format("swept from {:.4g} to {:.4g}{}: outside of that a lognormal is an extrapolation",
                                      model.im_least, model.im_most, unit));
  else if (!table && form == Form::discrete) {
    const std::vector<Point>& points = model.states.front().curve.points;
    double off = 0;
    for (const LimitState& state : model.states) off = std::max(off, state.off_lines);
    model.notes.push_back(
        fmt::format("straight lines between {} points of the curve through {} bins, off that of the counts by at most "
                    "{:.2g}; below "
                    "the lowest, at {:.4g}{}, to 0 at 0; above the highest, at {:.4g}{}, probabilities stay",
                    points.size() - 1, bins.size(), off, points[1].im, unit, points.back().im, unit));
    tell_rates_by_lines(model);
  } else if (!table)
    model.notes.push_back(
        fmt::format("straight lines between {} bins; below the lowest, at {:.4g}{}, to 0 at 0; above the highest, at "
                    "{:.4g}{}, probabilities stay",
                    bins.size(), bins.front().im, unit, bins.back().im, unit));
  if (!table) tell_other_demands(model);
  for (const LimitState& state : model.states) {
    if (state.pooled > tolerance)
      model.notes.push_back(fmt::format("{}: bins that fell within their bands were pooled, by {:.2g} at most",
                                        state.name, state.pooled));
    if (form == Form::lognormal && state.fitted.extrapolated)
      model.notes.push_back(fmt::format("{}: the median, {:.4g}{}, lies outside of what was swept", state.name,
                                        state.fitted.median, unit));
    if (form == Form::lognormal)
      model.notes.push_back(fmt::format("{}: the lognormal and the surface differ by up to {:.2g}, at {:.4g}{}",
                                        state.name, state.off_surface, state.off_surface_at, unit));
  }
  for (const std::string& warning : result.warnings)
    if (!of_another_demand(warning, model, result)) model.notes.push_back(warning);
}

// Where nobody said what is wanted.
void tell_what_is_left_out(Model& model, const Result& result, const std::vector<std::string>& told) {
  std::vector<std::string> left_out;
  for (const EdpResult& edp : result.edps)
    if (std::none_of(model.states.begin(), model.states.end(), [&](const auto& s) { return s.demand == edp.name; }) &&
        std::none_of(told.begin(), told.end(), [&](const auto& name) { return name.starts_with(edp.name); }))
      left_out.push_back(edp.name);
  if (!left_out.empty())
    model.notes.push_back(fmt::format("left out: {} (--limit-state takes them)", fmt::join(left_out, ", ")));
}

bool never_happened(const LimitState& state) {
  return std::all_of(state.bins.begin(), state.bins.end(), [](const Bin& bin) { return bin.counted == 0; });
}

bool always_happened(const LimitState& state) {
  return std::all_of(state.bins.begin(), state.bins.end(), [](const Bin& bin) { return bin.counted == 1; });
}

// Where all states of a target always happened its file would say nothing but that shaking does it: refused. A table holds what is there.
void refuse_what_says_nothing(const Model& model) {
  if (!std::all_of(model.states.begin(), model.states.end(), always_happened)) return;
  const LimitState& state = model.states.front();
  throw Error(fmt::format(
      "{} happened in every sample at every intensity swept, {} {:.4g} to {:.4g} (its probability would be 1 "
      "throughout): name a larger capacity, or sweep lower intensities",
      state.name, model.im.name, model.im_least, model.im_most));
}

// Of states that nobody asked for those that never happened are left out: of them it is known that they need more than was swept, and no
// more. If that is all of them, none is.
std::vector<std::string> leave_out_what_never_happened(Model& model, std::vector<Wanted>& wanted) {
  std::vector<std::string> names;
  if (std::all_of(model.states.begin(), model.states.end(), never_happened)) return names;
  for (std::size_t s = model.states.size(); s-- > 0;)
    if (never_happened(model.states[s])) {
      names.insert(names.begin(), model.states[s].name);
      model.states.erase(model.states.begin() + static_cast<std::ptrdiff_t>(s));
      wanted.erase(wanted.begin() + static_cast<std::ptrdiff_t>(s));
    }
  return names;
}

// Those that were left out, and those that stay as zeros, or as ones.
void tell_what_never_happened(Model& model, const std::vector<std::string>& left_out) {
  const std::string unit = model.im.unit == "1" ? "" : " " + model.im.unit;
  if (!left_out.empty())
    model.notes.push_back(
        fmt::format("left out: {} never happened up to {:.4g}{} (--limit-state takes it all the same)",
                    fmt::join(left_out, ", "), model.im_most, unit));
  for (const LimitState& state : model.states)
    if (never_happened(state))
      model.notes.push_back(fmt::format("{} never happened up to {:.4g}{}: its probability is 0 throughout", state.name,
                                        model.im_most, unit));
    else if (always_happened(state))
      model.notes.push_back(
          fmt::format("{} happened in every sample, from {:.4g}{} on: its probability is 1 at every "
                      "intensity swept, and nothing is known of where it begins",
                      state.name, model.im_least, unit));
}

// Gives all limit states that form, or says why not.
Refusal take_form(Model& model, const Result& result, const std::vector<Wanted>& wanted, Form form, bool table,
                  const Request& request) {
  for (std::size_t s = 0; s < wanted.size(); ++s) {
    LimitState& state = model.states[s];
    const Refusal refusal = table                     ? make_table(state)
                            : form == Form::lognormal ? make_lognormal(state, wanted[s])
                            : form == Form::discrete
                                ? make_discrete(state, wanted[s], result, model.im, request.counted, request.straight)
                                : make_parts(state, wanted[s], result, model.im);
    if (!refusal.empty()) return refusal;
  }
  if (!table && form == Form::discrete) put_points(model.states);
  for (LimitState& state : model.states) measure_surface(state);
  return table ? Refusal{} : crossing(model);
}

// "problem (why)" of "problem (why): what to do".
std::string without_advice(const Refusal& refusal) { return refusal.substr(0, refusal.rfind("): ") + 1); }

}  // namespace

const char* name(Form form) {
  constexpr const char* names[] = {"lognormal", "discrete", "parts"};
  return names[static_cast<int>(form)];
}

Model select(const Result& result, const Intensity& im, const Request& request, const Format& format) {
  if (request.form && std::find(format.forms.begin(), format.forms.end(), *request.form) == format.forms.end())
    throw Error(fmt::format("{} has no {} (it cannot hold that form): leave --form out, or use --form discrete",
                            format.name, *request.form == Form::parts ? "formulas for the three parts" : "lognormals"));
  std::vector<Wanted> wanted = wanted_states(result, request.states, format.table);
  if (format.last_only) wanted = {wanted.back()};
  Model fresh{request.id, request.description, request.asset_category, request.loss_category, im, unknown, unknown, {},
              {}};
  for (const Wanted& one : wanted) fresh.states.push_back(state_of(result, im, one, request, format.table));
  std::vector<std::string> left_out;
  if (request.states.empty() && !format.table && !format.fixed_number)
    left_out = leave_out_what_never_happened(fresh, wanted);
  if (fresh.asset_category.empty()) fresh.asset_category = format.usual_category;
  take_range(fresh, wanted);
  if (!format.table) refuse_what_says_nothing(fresh);
  std::string passed_over;
  Refusal refusal;
  for (const Form form : request.form ? std::vector<Form>{*request.form} : format.forms) {
    Model model = fresh;
    refusal = take_form(model, result, wanted, form, format.table, request);
    if (refusal.empty()) {
      take_notes(model, result, form, format.table);
      if (!passed_over.empty()) model.notes.push_back(passed_over);
      if (!format.table) tell_what_never_happened(model, left_out);
      if (request.states.empty()) tell_what_is_left_out(model, result, left_out);
      if (!format.note.empty()) model.notes.push_back(format.note);
      if (!format.bands)
        model.notes.push_back(fmt::format(
            "{} files hold the best estimate alone: the bands ({:.3g} % confidence) have no place there, and "
            "are in fragility.h5 and in --format csv",
            format.name, 100 * result.confidence));
      if (format.notes_on)
        for (std::string& note : format.notes_on(model)) model.notes.push_back(std::move(note));
      return model;
    }
    passed_over +=
        fmt::format("{}no {} form: {}", passed_over.empty() ? "" : "; ", name(form), without_advice(refusal));
  }
  throw Error(refusal);
}

namespace {

// What is known of it over another intensity: the shares of cells. A lognormal over the one is none over the other.
fragility::FragilityFunction by_cells(const fragility::FragilityFunction& f, const Result& result) {
  fragility::FragilityFunction known;
  known.median = f.median;
  known.im_least = f.im_least, known.im_most = f.im_most;
  known.cell_im = f.cell_im, known.cell_n = f.cell_n, known.cell_share = f.cell_share;
  if (!known.cell_share.empty() || !(f.dispersion > 0)) return known;
  const Curve fitted = lognormal(f.median, f.dispersion);
  for (std::size_t i = 0; i < result.cell_im.size(); ++i) {
    if (result.cell_n[i] == 0) continue;
    known.cell_im.push_back(result.cell_im[i]);
    known.cell_n.push_back(static_cast<double>(result.cell_n[i]));
    known.cell_share.push_back(result.cell_im[i] > 0 ? probability(fitted, result.cell_im[i]) : 0);
  }
  return known;
}

}  // namespace

Result as_pta(Result result, double mu) {
  const auto convert = [&](double& im) { im = mu * (im + 1); };
  for (EdpResult& edp : result.edps)
    for (fragility::FragilityFunction& f : edp.functions) {
      f = by_cells(f, result);
      for (double* im : {&f.median, &f.im_least, &f.im_most}) convert(*im);
      std::for_each(f.cell_im.begin(), f.cell_im.end(), convert);
    }
  std::for_each(result.im_edge.begin(), result.im_edge.end(), convert);
  std::for_each(result.im.begin(), result.im.end(), convert);
  std::for_each(result.cell_im.begin(), result.cell_im.end(), convert);
  result.im_name = std::string("pta_g");
  result.im_unit = std::string("g");
  return result;
}

}  // namespace freestand::exports
