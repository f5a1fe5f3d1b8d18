#include "measurement/predict/placements.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace freestand::measurement {

double placed_at(const ModelSpec& model, double place) {
  return model.slenderness && model.size ? std::min(std::exp(place), steepest_rad) : std::exp(place);
}

namespace {

constexpr int most_places = 64;

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
  (model.slenderness && model.size ? out.slenderness : out.width) = Number{.value = placed_at(model, place)};
  return out;
}

}  // namespace

double placement_middle(const ModelSpec& model, std::span<const double> x) {
  return placed(model) ? std::log(placed(model)->of(x)) : 0;
}

double placement_scatter(const ModelSpec& model, std::span<const double> x) {
  return model.placement_scatter ? model.placement_scatter->of(x) : 0;
}

int placement_number(const ModelSpec& model) { return placed(model) ? placed(model)->free : -1; }

int scatter_number(const ModelSpec& model) { return model.placement_scatter ? model.placement_scatter->free : -1; }

std::vector<std::size_t> other_numbers(const ModelSpec& model) {
  const int scatter = scatter_number(model);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < model.free.size(); ++i)
    if (static_cast<int>(i) != placement_number(model) && static_cast<int>(i) != scatter) numbers.push_back(i);
  return numbers;
}

double place_step(double scatter) { return std::exp2(std::floor(std::log2(std::max(scatter, 1e-4) / 2.5))); }

Places places_between(double low, double high, double step) {
  while ((high - low) / step > most_places - 3) step *= 2;
  const double first = std::floor(low / step), last = std::ceil(high / step);
  return {first * step, step, static_cast<int>(last - first) + 1};
}

std::vector<double> Places::all() const {
  std::vector<double> places;
  for (int k = 0; k < count; ++k) places.push_back(at(k));
  return places;
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
                                    std::span<const double> x, std::span<const double> places) {
  std::vector<ModelSpec> at;
  if (placed(model))
    for (const double place : places) at.push_back(at_place(model, place));
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (const std::size_t i : tests)
    for (std::size_t k = 0; k < places.size(); ++k) {
      shakings.push_back(bench.test(i).shaking());
      if (!at.empty()) {
        specimens.push_back(specimen(at[k], bench.test(i), x));
        continue;
      }
      Dimensions own = bench.test(i).specimen;
      own.width_m = *own.width_m * std::exp(places[k]);
      specimens.push_back(specimen(model, own, x));
      specimens.back().start = bench.test(i).start;
    }
  std::vector<Response> responses(specimens.size());
  respond_batch(specimens, shakings, {.tolerance = 1e-8}, responses);
  std::vector<std::uint64_t> words(tests.size(), 0);
  const std::size_t count = places.size();
  for (std::size_t i = 0; i < responses.size(); ++i)
    if (responses[i].outcome == Outcome::overturned) words[i / count] |= std::uint64_t{1} << (i % count);
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
  const int count = scatter > 0 ? most_places : 1;
  std::vector<double> places, probabilities;
  for (int k = 0; k < count; ++k) places.push_back(middle + scatter * gsl_cdf_ugaussian_Pinv((k + 0.5) / count));
  for (const std::uint64_t word : outcomes(bench, tests, model, x, places))
    probabilities.push_back(static_cast<double>(std::popcount(word)) / count);
  return probabilities;
}

}  // namespace freestand::measurement
