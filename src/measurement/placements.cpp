#include "measurement/placements.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>

namespace freestand::measurement {
namespace {

constexpr double reach = 2.5;  // of the scatter
constexpr int most_places = 64;
constexpr double steepest = 1.5;  // rad; a slenderness lies below pi/2

const std::optional<Number>& placed(const ModelSpec& model) {
  return model.slenderness && model.size ? model.slenderness : model.width;
}

// E[(Z - s)+] of Z normal about the middle.
double mean_excess(double s, double middle, double scatter) {
  const double u = (s - middle) / scatter;
  return scatter * (gsl_ran_ugaussian_pdf(u) - u * gsl_cdf_ugaussian_Q(u));
}

ModelSpec at_place(const ModelSpec& model, double place) {
  ModelSpec out = model;
  if (model.slenderness && model.size)
    out.slenderness = Number{.value = std::min(std::exp(place), steepest)};
  else
    out.width = Number{.value = std::exp(place)};
  return out;
}

// Samples at places, computed together.
class Batch {
 public:
  Batch(const Bench& bench, const ModelSpec& model, std::span<const double> x, const Places& places)
      : bench_(bench), model_(model), x_(x), places_(places) {
    for (int k = 0; k < places.count && placed(model); ++k) at_.push_back(at_place(model, places.at(k)));
  }

  void add(std::size_t test, int place) {
    shakings_.push_back(bench_.test(test).shaking());
    if (!at_.empty())
      return specimens_.push_back(specimen(at_[static_cast<std::size_t>(place)], bench_.test(test), x_));
    Dimensions own = bench_.test(test).specimen;
    own.width_m = *own.width_m * std::exp(places_.at(place));
    specimens_.push_back(specimen(model_, own, x_));
  }

  // Which of the samples overturn; empty again after that.
  std::vector<bool> run() {
    std::vector<Response> responses(specimens_.size());
    respond_batch(specimens_, shakings_, {.tolerance = 1e-8}, responses);
    std::vector<bool> overturned;
    for (const Response& r : responses) overturned.push_back(r.outcome == Outcome::overturned);
    specimens_.clear();
    shakings_.clear();
    return overturned;
  }

 private:
  const Bench& bench_;
  const ModelSpec& model_;
  std::span<const double> x_;
  const Places& places_;
  std::vector<ModelSpec> at_;
  std::vector<Specimen> specimens_;
  std::vector<Shaking> shakings_;
};

}  // namespace

double placement_middle(const ModelSpec& model, std::span<const double> x) {
  return placed(model) ? std::log(placed(model)->of(x)) : 0;
}

double placement_scatter(const ModelSpec& model, std::span<const double> x) {
  return model.placement_scatter ? model.placement_scatter->of(x) : 0;
}

int placement_number(const ModelSpec& model) { return placed(model) ? placed(model)->free : -1; }

double place_step(double scatter) { return std::exp2(std::floor(std::log2(std::max(scatter, 1e-4) / 2.5))); }

Places places_between(double low, double high, double step) {
  while ((high - low) / step > most_places - 3) step *= 2;
  const double first = std::floor(low / step), last = std::ceil(high / step);
  return {first * step, step, static_cast<int>(last - first) + 1};
}

Places places_about(double middle, double scatter) {
  if (scatter <= 0) return {.first = middle};
  return places_between(middle - reach * scatter, middle + reach * scatter, place_step(scatter));
}

std::vector<double> place_shares(const Places& places, double middle, double scatter) {
  if (places.count == 1) return {1.0};
  std::vector<double> above, shares;  // above: E[clamp((Z - s_k)/step, 0, 1)]
  double excess = mean_excess(places.at(0), middle, scatter);
  for (int k = 0; k + 1 < places.count; ++k) {
    const double next = mean_excess(places.at(k + 1), middle, scatter);
    above.push_back((excess - next) / places.step);
    excess = next;
  }
  shares.push_back(1 - above.front());
  for (std::size_t k = 1; k < above.size(); ++k) shares.push_back(above[k - 1] - above[k]);
  shares.push_back(above.back());
  return shares;
}

std::vector<std::uint64_t> outcomes(const Bench& bench, const std::vector<std::size_t>& tests, const ModelSpec& model,
                                    std::span<const double> x, const Places& places) {
  Batch batch(bench, model, x, places);
  const int last = places.count - 1;
  std::vector<std::uint64_t> words(tests.size(), 0);
  const auto run = [&](const std::vector<std::size_t>& which, int from, int to) {
    for (const std::size_t t : which)
      for (int k = from; k <= to; ++k) batch.add(tests[t], k);
    const std::vector<bool> overturned = batch.run();
    std::size_t at = 0;
    for (const std::size_t t : which)
      for (int k = from; k <= to; ++k)
        if (overturned[at++]) words[t] |= std::uint64_t{1} << k;
  };
  std::vector<std::size_t> open;
  for (std::size_t t = 0; t < tests.size(); ++t) open.push_back(t);
  run(open, 0, 0);
  std::erase_if(open, [&](std::size_t t) { return words[t] == 0; });
  if (last == 0) return words;
  run(open, last, last);
  std::erase_if(open, [&](std::size_t t) {
    const bool always = words[t] >> last & 1;
    if (always) words[t] = ~std::uint64_t{0} >> (63 - last);
    return always;
  });
  run(open, 1, last - 1);
  return words;
}

double overturning_share(std::uint64_t outcomes, const std::vector<double>& shares) {
  double sum = 0;
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (outcomes >> k & 1) sum += shares[k];
  return sum;
}

std::vector<double> overturning_probabilities(const Bench& bench, const std::vector<std::size_t>& tests,
                                              const ModelSpec& model, std::span<const double> x) {
  const double middle = placement_middle(model, x), scatter = placement_scatter(model, x);
  const Places places = places_about(middle, scatter);
  const std::vector<double> shares = place_shares(places, middle, scatter);
  std::vector<double> probabilities;
  for (const std::uint64_t word : outcomes(bench, tests, model, x, places))
    probabilities.push_back(std::clamp(overturning_share(word, shares), 0.0, 1.0));
  return probabilities;
}

}  // namespace freestand::measurement
