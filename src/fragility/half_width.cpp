#include "fragility/half_width.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace freestand::fragility {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// One point of any surface.
struct Place {
  const EdpResult* edp;
  const AxisSurface* axis;  // null: of the surface over IM and capacity
  std::size_t bin, cell, capacity;
  std::int64_t n;
  double probability, half;  // NaN: no band
};

// Calls each(place) for all points that are wanted, and rare(cell) for cells that are not for their rarity.
void for_each_place(const Result& result, const Wanted& wanted, const std::function<void(const Place&)>& each,
                    const std::function<void()>& rare) {
  const auto half = [](double lower, double upper) { return (upper - lower) / 2; };
  for (const EdpResult& edp : result.edps) {
    const std::size_t capacities = edp.capacity.size();
    for (std::size_t i = 0; i < edp.surface.probability.size(); ++i)
      if (const std::size_t bin = i / capacities; edp.bins[bin].n > 0)
        each({&edp, nullptr, bin, 0, i % capacities, edp.bins[bin].n, edp.surface.probability[i],
              half(edp.surface.lower[i], edp.surface.upper[i])});
    for (const AxisSurface& axis : edp.axes)
      for (std::size_t cell = 0; cell < axis.n.size(); ++cell) {
        const auto n = static_cast<double>(axis.n[cell]);
        if (n == 0) continue;
        if (n * wanted.at_most < wanted.minimum_samples * static_cast<double>(result.samples)) {
          rare();
          continue;
        }
        for (std::size_t c = 0; c < capacities; ++c) {
          const std::size_t i = cell * capacities + c;
          each({&edp, &axis, cell / axis.centre.size(), cell % axis.centre.size(), c, axis.n[cell], axis.probability[i],
                half(axis.lower[i], axis.upper[i])});
        }
      }
  }
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

}  // namespace

HalfWidth half_width(const Result& result, const Wanted& wanted) {
  HalfWidth width;
  double largest = -1;
  for_each_place(
      result, wanted,
      [&](const Place& place) {
        ++(std::isnan(place.half) ? width.empty_points : width.points);
        const double half = std::isnan(place.half) ? 0.5 : place.half;
        if (half <= largest) return;
        largest = half;
        width.edp = place.edp->name;
        width.im = result.im[place.bin];
        width.capacity = place.edp->capacity[place.capacity];
        width.axis = place.axis ? place.axis->name : "";
        width.on_axis = place.axis ? place.axis->centre[place.cell] : unknown;
      },
      [&] { ++width.rare_cells; });
  if (largest >= 0 && width.points > 0) width.largest = largest;
  return width;
}

Outlook outlook(const Result& result, const Wanted& wanted) {
  Outlook found;
  const double all = static_cast<double>(result.samples);
  for_each_place(
      result, wanted,
      [&](const Place& place) {
        const auto n = static_cast<double>(place.n);
        if (std::isnan(place.half)) {
          found.samples = std::max(found.samples, all * std::max(1.0, wanted.minimum_samples / n));
          return;
        }
        const double square = place.half * place.half;
        const BinFit& bin = place.edp->bins[place.bin];
        double falls = square;
        if (result.left_out_records > 0 && bin.motions < bin.n) {
          const double t = gsl_cdf_tdist_Pinv((1 + result.confidence) / 2, std::max(1, bin.motions - 1));
          falls = std::min(square, t * t * variance_of_one(place) / n);
        }
        const double stays = square - falls, room = wanted.half_width * wanted.half_width - stays;
        found.stays = std::max(found.stays, std::sqrt(stays));
        found.samples = std::max(found.samples, room > 0 ? all * falls / room : infinite);
      },
      [] {});
  return found;
}

}  // namespace freestand::fragility
