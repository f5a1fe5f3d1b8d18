#include "decision/annual_rate.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace freestand::decision {
namespace {

// Where Phi(z) is 0 or 1 to the last bit.
constexpr double flat = 9;
constexpr std::size_t nodes = 16;

using Piece = HazardPiece;

// Integral of f(ln im) slope rate(im) d ln im, in `panels` panels.
template <class F>
double quadrature(const Piece& piece, double from, double to, double panels, const F& f) {
  static const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)> table(
      gsl_integration_glfixed_table_alloc(nodes), gsl_integration_glfixed_table_free);
  const double a = std::log(from), width = (std::log(to) - a) / panels, start = std::log(piece.from);
  double sum = 0;
  for (double panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < nodes; ++i) {
      double at, weight;
      gsl_integration_glfixed_point(a + panel * width, a + (panel + 1) * width, i, &at, &weight, table.get());
      sum += weight * f(at) * piece.slope * piece.rate_from * std::exp(-piece.slope * (at - start));
    }
  return sum;
}

double rate_of(const Piece& piece, double im) { return piece.rate_from * std::pow(im / piece.from, -piece.slope); }

// Panels no wider than a dispersion, nor than the hazard needs to fall by a factor of e.
double panels(const Piece& piece, double from, double to, double dispersion) {
  return std::max(1.0, std::ceil(std::log(to / from) * std::max(1 / dispersion, piece.slope)));
}

double of_piece(const Piece& piece, const LognormalFragility& fragility) {
  // Far below the median P falls as a normal density, the hazard rises: their product is largest `slope` dispersions lower.
  const double low = fragility.median * std::exp(-(flat + piece.slope * fragility.dispersion) * fragility.dispersion),
               high = fragility.median * std::exp(flat * fragility.dispersion);
  double sum = 0;
  if (piece.to > high) sum += rate_of(piece, std::max(piece.from, high)) - piece.rate_to;  // P is 1
  const double from = std::max(piece.from, low), to = std::min(piece.to, high);
  if (!(from < to)) return sum;
  const double median = std::log(fragility.median);
  return sum + quadrature(piece, from, to, panels(piece, from, to, fragility.dispersion),
                          [&](double at) { return gsl_cdf_ugaussian_P((at - median) / fragility.dispersion); });
}

}  // namespace

double LognormalFragility::operator()(double im) const {
  return gsl_cdf_ugaussian_P(std::log(im / median) / dispersion);
}

std::vector<HazardPiece> pieces(const HazardCurve& hazard, const Range& range) {
  std::vector<Piece> found;
  for (std::size_t i = 0; i + 1 < hazard.im.size(); ++i) {
    const double from = std::max(hazard.im[i], range.from), to = std::min(hazard.im[i + 1], range.to);
    if (!(from < to)) continue;
    const double slope =
        -std::log(hazard.annual_rate[i + 1] / hazard.annual_rate[i]) / std::log(hazard.im[i + 1] / hazard.im[i]);
    const auto rate = [&](double im) { return hazard.annual_rate[i] * std::pow(im / hazard.im[i], -slope); };
    found.push_back({from, to, rate(from), rate(to), slope});
  }
  return found;
}

double annual_rate(const HazardCurve& hazard, const LognormalFragility& fragility, const Range& range) {
  return annual_rate(pieces(hazard, range), fragility);
}

double annual_rate(const std::vector<HazardPiece>& hazard, const LognormalFragility& fragility) {
  if (!(fragility.median > 0) || !(fragility.dispersion > 0)) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (const Piece& piece : hazard) sum += of_piece(piece, fragility);
  return sum;
}

std::vector<double> rate_weights(const HazardCurve& hazard, const TabulatedFragility& table, const Range& range) {
  std::vector<double> weight(table.im.size(), 0);
  const auto add = [&](std::size_t i, const Range& part, const auto& share) {
    const Range cut{std::max({part.from, table.known.from, range.from}), std::min({part.to, table.known.to, range.to})};
    if (!(cut.from < cut.to)) return;
    for (const Piece& piece : pieces(hazard, cut))
      weight[i] += quadrature(piece, piece.from, piece.to, panels(piece, piece.from, piece.to, 1), share);
  };
  const auto whole = [](double) { return 1.0; };
  for (std::size_t i = 0; i < table.im.size(); ++i) {
    if (i == 0) add(i, {table.known.from, table.im[i]}, whole);
    if (i + 1 == table.im.size()) {
      add(i, {table.im[i], table.known.to}, whole);
      break;
    }
    const double low = std::log(table.im[i]), high = std::log(table.im[i + 1]);
    const Range between{table.im[i], table.im[i + 1]};
    add(i, between, [&](double at) { return (high - at) / (high - low); });
    add(i + 1, between, [&](double at) { return (at - low) / (high - low); });
  }
  return weight;
}

double probability_in_years(double annual_rate, double years) { return -std::expm1(-annual_rate * years); }

}  // namespace freestand::decision
