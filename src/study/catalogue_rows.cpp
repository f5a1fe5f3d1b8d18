#include "study/catalogue_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "edp/edp.hpp"
#include "fragility/fragility_function.hpp"
#include "intensity/intensity.hpp"
#include "sampling/distribution.hpp"
#include "study/study.hpp"

namespace freestand::study {
namespace {

using database::Curve;
using database::Word;
using fragility::EdpResult;
using fragility::Result;

std::vector<database::Point> points_of(const Result& result, const EdpResult& edp, std::size_t capacity) {
  std::vector<database::Point> points;
  for (std::size_t i = 0; i < edp.bins.size(); ++i) {
    const std::size_t at = i * edp.capacity.size() + capacity;
    if (!std::isfinite(edp.surface.probability[at])) continue;  // too few samples
    points.push_back(
        {result.im[i], edp.surface.probability[at], edp.surface.lower[at], edp.surface.upper[at], edp.bins[i].n});
  }
  return points;
}

void take_function(const fragility::FragilityFunction& function, Curve& curve) {
  curve.im_least = function.im_least;
  curve.im_most = function.im_most;
  curve.median = function.median;
  curve.dispersion = function.dispersion;
  curve.median_se = function.median_se;
  curve.dispersion_se = function.dispersion_se;
  curve.extrapolated = function.extrapolated;
  curve.misfit = function.misfit;
  curve.misfit_im = function.misfit_im;
  curve.misfit_p = function.misfit_p;
  curve.off_by = function.off_by;
  if (!std::isfinite(function.median)) return;
  if (function.adequate) curve.family = database::lognormal_family;
  if (not_refuted(function)) curve.family = database::not_refuted_family;
}

template <class Find>
std::vector<Word> words_of(const std::vector<Curve>& curves, std::string Curve::*member, Find find) {
  std::vector<Word> words;
  for (const Curve& curve : curves) {
    const bool there = std::any_of(words.begin(), words.end(), [&](const Word& w) { return w.name == curve.*member; });
    if (!there) words.push_back(find(curve.*member));
  }
  return words;
}

// "peak_slip_m > capacity, capacity: {lognormal: ...} m"
std::string text_of(const DamagePart& part) {
  std::string text = part.when;
  for (const Quantity& parameter : part.parameters)
    text += fmt::format(", {}: {}{}", parameter.name.substr(parameter.name.rfind('.') + 1), to_string(parameter.value),
                        parameter.unit.empty() || parameter.unit == "1" ? "" : " " + parameter.unit);
  return text;
}

// Damage states are no entries of a registry: what they are stands in the study of each entry, kept ones too.
class StatesOfEntries {
 public:
  explicit StatesOfEntries(const database::Database& db) {
    for (const database::Entry& entry : db.entries)
      for (const DamagePart& part : parse_stored(entry.study, entry.id).fragility.damage) {
        std::vector<Meaning>& meanings = states_[part.name];
        const std::string text = text_of(part);
        const auto same =
            std::find_if(meanings.begin(), meanings.end(), [&](const Meaning& one) { return one.text == text; });
        if (same == meanings.end())
          meanings.push_back({text, entry.id});
        else
          same->entries += ", " + entry.id;
      }
  }

  // One name may stand for several conditions: then each is told with its entries.
  Word word(const std::string& name) const {
    std::string symbol = name, summary;
    std::replace(symbol.begin(), symbol.end(), '_', ' ');
    const auto found = states_.find(name);
    if (found != states_.end())
      for (const Meaning& one : found->second) {
        if (found->second.size() == 1) return {name, "1", symbol, one.text, true};
        summary += fmt::format("{}{} ({})", summary.empty() ? "" : "; ", one.text, one.entries);
      }
    return {name, "1", symbol, summary, true};
  }

 private:
  struct Meaning {
    std::string text, entries;
  };
  std::map<std::string, std::vector<Meaning>> states_;
};

}  // namespace

std::vector<Curve> curves_of(const Result& result, std::size_t entry, const std::string& im) {
  std::vector<Curve> curves;
  for (const EdpResult& edp : result.edps)
    for (std::size_t k = 0; k < edp.capacity.size(); ++k) {
      Curve curve{.entry = entry, .im = im, .demand = edp.name, .capacity = edp.capacity[k]};
      take_function(edp.functions.at(k), curve);
      for (const fragility::BinFit& bin : edp.bins) curve.n += bin.n;
      curve.points = points_of(result, edp, k);
      curves.push_back(std::move(curve));
    }
  return curves;
}

std::vector<Word> demand_words(const database::Database& db) {
  std::optional<StatesOfEntries> states;  // their studies are read only if some state is there
  return words_of(db.curves, &Curve::demand, [&](const std::string& name) {
    for (const edp::Edp& edp : edp::all())
      if (edp.name == name) return Word{edp.name, edp.unit, edp.symbol, edp.summary, edp.binary};
    if (!states) states.emplace(db);
    return states->word(name);
  });
}

std::vector<Word> intensity_words(const std::vector<Curve>& curves) {
  return words_of(curves, &Curve::im, [](const std::string& name) {
    const std::size_t colon = name.find(':');
    const intensity::Measure& measure = intensity::find(name.substr(0, colon));
    const std::string period = colon == std::string::npos ? "" : " at " + name.substr(colon + 1) + " s";
    return Word{name, measure.unit, measure.symbol + period, measure.summary + period, false};
  });
}

}  // namespace freestand::study
