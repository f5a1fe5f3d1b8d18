#include "fragility/half_width.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace freestand::fragility {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double hardly = 0.1;  // of h^2

double drawn(const Result& result, const Wanted& wanted) {
  return wanted.drawn > 0 ? wanted.drawn : static_cast<double>(result.samples);
}

double quantile(double confidence) { return gsl_cdf_ugaussian_Pinv((1 + confidence) / 2); }

// Of the band of a point, whatever the others.
double wanted_by_itself(const Wanted& wanted, double z, double probability) {
  if (std::isinf(wanted.relative_error)) return infinite;
  return z * wanted.relative_error * std::max(std::isnan(probability) ? 0 : probability, wanted.down_to);
}

bool is_empty(const Result& result, std::size_t bin) {
  return std::any_of(result.edps.begin(), result.edps.end(),
                     [&](const EdpResult& edp) { return edp.bins[bin].n == 0; });
}

// May a bin that has no sample get as many as are wanted of one?
bool may_fill(const Result& result, const Wanted& wanted) {
  return std::exp(-drawn(result, wanted) * wanted.minimum_samples / wanted.at_most) > 1 - result.confidence;
}

// One point of any surface.
struct Place {
  const EdpResult* edp;
  const AxisSurface* axis;  // null: of the surface over IM and capacity
  std::size_t bin, cell, capacity;
  std::int64_t n;
  double probability;
  double half, longer;          // half of its own band, and its longer side; NaN: no band
  double at_once = 1;           // the half width that counts, in halves of its own band
  double half_width = 0.5;      // wanted of that one,
  double by_itself = infinite;  // and of its own band

  double counts() const { return std::isnan(half) ? 0.5 : std::min(0.5, at_once * half); }
  double times_wanted() const { return std::max(counts() / half_width, (std::isnan(half) ? 0.5 : half) / by_itself); }
  double wanted() const { return std::min(half_width / at_once, by_itself); }  // all, of its own band
  bool known() const { return half <= wanted(); }
};

// Calls each(place) for all points that are wanted, without what is wanted of them, and rare(cell) for cells that are not for their rarity.
void visit_places(const Result& result, const Wanted& wanted, const std::function<void(const Place&)>& each,
                  const std::function<void()>& rare) {
  const auto half = [](double lower, double upper) { return (upper - lower) / 2; };
  const auto longer = [](double lower, double p, double upper) { return std::max(upper - p, p - lower); };
  for (const EdpResult& edp : result.edps) {
    const std::size_t capacities = edp.capacity.size();
    for (std::size_t i = 0; i < edp.surface.probability.size(); ++i)
      if (const std::size_t bin = i / capacities; edp.bins[bin].n > 0)
        each({&edp, nullptr, bin, 0, i % capacities, edp.bins[bin].n, edp.surface.probability[i],
              half(edp.surface.lower[i], edp.surface.upper[i]),
              longer(edp.surface.lower[i], edp.surface.probability[i], edp.surface.upper[i])});
    for (const AxisSurface& axis : edp.axes)
      for (std::size_t cell = 0; cell < axis.n.size(); ++cell) {
        const auto n = static_cast<double>(axis.n[cell]);
        if (n == 0) continue;
        if (n * wanted.at_most < wanted.minimum_samples * drawn(result, wanted)) {
          rare();
          continue;
        }
        for (std::size_t c = 0; c < capacities; ++c) {
          const std::size_t i = cell * capacities + c;
          each({&edp, &axis, cell / axis.centre.size(), cell % axis.centre.size(), c, axis.n[cell], axis.probability[i],
                half(axis.lower[i], axis.upper[i]), longer(axis.lower[i], axis.probability[i], axis.upper[i])});
        }
      }
  }
}

// Of Student's t by which a band goes, those of records at most; infinite: the normal distribution.
double degrees_of_freedom(const Result& result, const Place& place) {
  const BinFit& bin = place.edp->bins[place.bin];
  if (result.left_out_records > 0) return std::max(1, std::min(bin.motions, result.left_out_records) - 1);
  const bool fitted = !place.axis && bin.status == BinStatus::fitted;
  return fitted ? std::max(1, bin.motions - 1) : infinite;
}

// Half width that holds at `points` points at once, in half widths of one.
double times_at_once(double confidence, int points, double freedom) {
  const auto reach = [&](double tail) {
    return std::isinf(freedom) ? gsl_cdf_ugaussian_Qinv(tail) : gsl_cdf_tdist_Qinv(tail, freedom);
  };
  const double tail = (1 - confidence) / 2;
  return reach(tail / points) / reach(tail);
}

// The same with what is wanted of them.
void for_each_place(const Result& result, const Wanted& wanted, const std::function<void(const Place&)>& each,
                    const std::function<void()>& rare) {
  int points = 0;
  visit_places(
      result, wanted, [&](const Place&) { ++points; }, [] {});
  const double z = quantile(result.confidence);
  std::map<double, double> times;  // by degrees of freedom
  visit_places(
      result, wanted,
      [&](Place place) {
        place.half_width = wanted.half_width;
        place.by_itself = wanted_by_itself(wanted, z, place.probability);
        if (wanted.at_once() && !std::isnan(place.half)) {
          const double freedom = degrees_of_freedom(result, place);
          const auto [found, is_new] = times.try_emplace(freedom);
          if (is_new) found->second = times_at_once(result.confidence, points, freedom);
          place.at_once = found->second * (place.half > 0 ? place.longer / place.half : 1);
        }
        each(place);
      },
      rare);
}

// Of one sample, among n of a point.
double variance_of_one(const Place& place) {
  const BinFit& bin = place.edp->bins[place.bin];
  if (place.axis || bin.status != BinStatus::fitted || !(bin.omega > 0) || bin.n_moved == 0)
    return place.probability * (1 - place.probability);
  const auto n = static_cast<double>(bin.n), moved = static_cast<double>(bin.n_moved);
  const double y = (std::log(place.edp->capacity[place.capacity]) - bin.lambda) / bin.omega;
  const double q = gsl_cdf_ugaussian_Q(y), density = gsl_ran_ugaussian_pdf(y);
  const double over = bin.p_over, never = bin.p_never, stand = 1 - over;
  const double by_over = 1 - (1 - never) * q, by_never = stand * q, by_law = stand * (1 - never) * density;
  return by_over * by_over * over * stand + by_never * by_never * never * (1 - never) / std::max(stand, 1 / n) +
         by_law * by_law * (1 + y * y / 2) * n / moved;
}

// Of h^2 of a point that has a band: what more samples of these motions would take off, t^2 v/n.
double falling(const Result& result, const Place& place) {
  const double square = place.half * place.half;
  const BinFit& bin = place.edp->bins[place.bin];
  if (result.left_out_records == 0 || bin.motions >= bin.n) return square;
  const double t = gsl_cdf_tdist_Pinv((1 + result.confidence) / 2, std::max(1, bin.motions - 1));
  return std::min(square, t * t * variance_of_one(place) / static_cast<double>(place.n));
}

}  // namespace

HalfWidth half_width(const Result& result, const Wanted& wanted) {
  HalfWidth width;
  double most = -1, largest = 0;
  bool any_band = false;
  for_each_place(
      result, wanted,
      [&](const Place& place) {
        ++width.points;
        any_band |= !std::isnan(place.half);
        largest = std::max(largest, place.counts());
        if (place.times_wanted() <= most) return;
        most = place.times_wanted();
        width.farthest = place.counts();
        width.edp = place.edp->name;
        width.im = result.im[place.bin];
        width.capacity = place.edp->capacity[place.capacity];
        width.axis = place.axis ? place.axis->name : "";
        width.on_axis = place.axis ? place.axis->centre[place.cell] : unknown;
      },
      [&] { ++width.rare_cells; });
  for (std::size_t bin = 0; bin < result.im.size(); ++bin)
    if (is_empty(result, bin) && !may_fill(result, wanted)) width.empty_bins.push_back(result.im[bin]);
  if (any_band) width.largest = largest, width.times_wanted = most;
  return width;
}

double least_wanted(const Wanted& wanted, double confidence) {
  return std::min(wanted.half_width, wanted_by_itself(wanted, quantile(confidence), 0));
}

Outlook outlook(const Result& result, const Wanted& wanted) {
  Outlook found;
  double most = 0;  // of what stays, in what is wanted
  const double all = drawn(result, wanted);
  for_each_place(
      result, wanted,
      [&](const Place& place) {
        if (std::isnan(place.half)) {
          const double more = wanted.minimum_samples / static_cast<double>(place.n);
          found.samples = std::max(found.samples, all * std::max(1.0, more));
          found.at_least = true;
          return;
        }
        const double falls = falling(result, place), stays = place.half * place.half - falls,
                     room = place.wanted() * place.wanted() - stays;
        if (std::sqrt(stays) > most * place.wanted()) {
          most = std::sqrt(stays) / place.wanted();
          found.stays = std::min(0.5, place.at_once * std::sqrt(stays));
        }
        found.samples = std::max(found.samples, room > 0 ? all * falls / room : infinite);
      },
      [] {});
  return found;
}

std::vector<bool> bins_that_want(const Result& result, const Wanted& wanted) {
  std::vector<bool> want(result.im.size(), false);
  for (std::size_t bin = 0; bin < want.size(); ++bin) want[bin] = is_empty(result, bin) && may_fill(result, wanted);
  for_each_place(
      result, wanted,
      [&](const Place& place) {
        if (place.known()) return;
        const double square = place.half * place.half, falls = std::isnan(place.half) ? square : falling(result, place);
        const bool helps = !(falls < hardly * square) || square - falls <= place.wanted() * place.wanted();
        if (helps) want[place.bin] = true;
      },
      [] {});
  return want;
}

}  // namespace freestand::fragility
