#include "fragility/line_above.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "fragility/normal.hpp"

namespace freestand::fragility {
namespace {

// Of two or three numbers, without a claim of memory: a surface is fitted in every resample.
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double farthest = 20;  // as fit_truncated(): a tail beyond it is exponential to a 400th

// In p = (a, a (lambda - ln c)[, a slope]): e = z p and eta = q p are linear in p.
class Likelihood {
 public:
  Likelihood(const LineSums& above, std::span<const LineCell> cells, double ln_c, std::optional<double> slope)
      : n_(above.n), middle_(above.x / above.n), slope_(slope.value_or(0)), free_(!slope), cells_(cells) {
    const double y = above.y - ln_c * n_ - slope_ * above.x, xy = above.xy - ln_c * above.x - slope_ * above.xx;
    const double yy = above.yy - 2 * ln_c * above.y + ln_c * ln_c * n_ - slope_ * (above.xy - ln_c * above.x + xy);
    squares_.resize(3, 3);
    squares_ << yy, -y, -xy, -y, n_, above.x, -xy, above.x, above.xx;
    squares_.conservativeResize(size(), size());
  }
  Eigen::Index size() const { return free_ ? 3 : 2; }
  // Least squares of all that lies above, as if nothing were cut off.
  Vector start() const {
    const Eigen::Index rest = size() - 1;
    const Vector line = squares_.bottomRightCorner(rest, rest).ldlt().solve(squares_.bottomLeftCorner(rest, 1).col(0));
    const double left = squares_(0, 0) - squares_.bottomLeftCorner(rest, 1).col(0).dot(line);
    Vector p(size());
    p << 1, -line;
    return p * std::sqrt(n_ / left);
  }
  double eta(const Vector& p, double x) const { return q(x).dot(p); }
  double below(const Vector& p) const {
    double sum = 0, count = 0;
    for (const LineCell& cell : cells_) {
      sum += (cell.above + cell.still) * normal_cdf(-eta(p, cell.x));
      count += cell.above + cell.still;
    }
    return sum / count;
  }
  LineFit fit(const Vector& p, double share, double ln_c) const {
    const double under = below(p);
    return {{ln_c + p[1] / p[0], 1 / p[0], std::max(0.0, (share - under) / (1 - under)), under},
            free_ ? p[2] / p[0] : slope_};
  }

  // By Newton's steps, held uphill where the likelihood is not concave. Empty: there is no maximum within `farthest`.
  std::optional<Vector> maximum(bool truncated) const {
    Vector p = start();
    constexpr int most_steps = 200;
    for (int step = 0; step < most_steps; ++step) {
      if (!p.allFinite() || eta(p, middle_) < -farthest) return {};
      Vector slopes(size());
      Matrix bend(size(), size());
      derivatives(p, truncated, slopes, bend);
      Vector by = uphill(bend, slopes);
      const double promised = slopes.dot(by), here = value(p, truncated);
      if (!(promised > 1e-14 * n_)) return p;
      double part = 1;
      const auto rises = [&] {
        const Vector there = p + part * by;
        return there[0] > 0 && value(there, truncated) >= here + 1e-4 * part * promised;
      };
      while (!rises() && part > 1e-9) part /= 2;
      if (part <= 1e-9) return p;  // as far as round-off lets see
      p += part * by;
    }
    return {};
  }

 private:
  Vector q(double x) const {
    Vector of(size());
    if (free_)
      of << 0, 1, x;
    else
      of << slope_ * x, 1;
    return of;
  }
  double value(const Vector& p, bool truncated) const {
    double sum = n_ * std::log(p[0]) - p.dot(squares_ * p) / 2;
    for (const LineCell& cell : cells_) {
      if (truncated && cell.above > 0) sum -= cell.above * ln_normal_cdf(eta(p, cell.x));
      if (!truncated && cell.still > 0) sum += cell.still * ln_normal_cdf(-eta(p, cell.x));
    }
    return sum;
  }
  void derivatives(const Vector& p, bool truncated, Vector& slopes, Matrix& bend) const {
    slopes = -squares_ * p;
    slopes[0] += n_ / p[0];
    bend = -squares_;
    bend(0, 0) -= n_ / (p[0] * p[0]);
    for (const LineCell& cell : cells_) {
      const Vector of = q(cell.x);
      const double weight = truncated ? cell.above : cell.still, h = of.dot(p),
                   hazard = normal_hazard(truncated ? -h : h);
      slopes -= weight * hazard * of;
      bend += weight * (truncated ? hazard * (hazard + h) : -hazard * (hazard - h)) * of * of.transpose();
    }
  }
  static Vector uphill(const Matrix& bend, const Vector& slopes) {
    for (double ridge = 0;; ridge = ridge > 0 ? 10 * ridge : 1e-6 * bend.diagonal().cwiseAbs().maxCoeff()) {
      const Eigen::LLT<Matrix> solved(ridge * Matrix::Identity(bend.rows(), bend.cols()) - bend);
      if (solved.info() == Eigen::Success) return solved.solve(slopes);
    }
  }

  double n_, middle_, slope_;
  bool free_;
  std::span<const LineCell> cells_;
  Matrix squares_;  // sum of z z^T
};

}  // namespace

LineFit fit_line_above(const LineSums& above, std::span<const LineCell> cells, double threshold,
                       std::optional<double> slope) {
  double still = 0;
  for (const LineCell& cell : cells) still += cell.still;
  const double share = still / (still + above.n), ln_c = std::log(threshold);
  const LineFit none{{undefined, undefined, share, undefined}, undefined};
  if (!(above.n >= 2)) return none;
  const Likelihood likelihood(above, cells, ln_c, slope);
  const auto free = likelihood.maximum(true);
  if (!free) return none;
  if (share >= likelihood.below(*free)) return likelihood.fit(*free, share, ln_c);
  const auto whole = likelihood.maximum(false);
  return whole ? likelihood.fit(*whole, share, ln_c) : none;
}

}  // namespace freestand::fragility
