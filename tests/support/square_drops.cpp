#include "support/square_drops.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

#include "support/medians.hpp"

namespace freestand::test {
namespace {

constexpr double g = 9.80665, h = drop_half_side_m;
constexpr double quarter = std::numbers::pi / 2;
constexpr int resting_frames = 15, window = 12, least_frames = 6, blow_frames = 8;
constexpr Triple on_the_arc{1.5e-4, 2.5e-4, 0.012};  // four times the noise and more: beyond it a frame left the arc

Drop read_drop(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with("x,z,th"))
    throw std::runtime_error(path.string() + ": first line is not x,z,th,...");
  Drop drop;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    Triple pose{};
    char comma = 0;
    if (!(row >> pose[0] >> comma >> pose[1] >> comma >> pose[2]))
      throw std::runtime_error(path.string() + ": not three numbers in '" + line + "'");
    drop.push_back(pose);
  }
  return drop;
}

Resting resting_angle(const std::vector<Drop>& drops) {
  std::vector<double> angles, away;
  for (const Drop& drop : drops) {
    double sum = 0;
    for (std::size_t i = drop.size() - resting_frames; i < drop.size(); ++i) sum += drop[i][2];
    angles.push_back(tilt(sum / resting_frames));
  }
  const double middle = median(angles);
  for (const double angle : angles) away.push_back(std::abs(angle - middle));
  return {middle, 1.4826 * median(away)};
}

double clearance(const Triple& pose) {
  return pose[1] - h * (std::abs(std::sin(pose[2])) + std::abs(std::cos(pose[2])));
}

bool flies(const Drop& drop, int first, int last) {
  const Arc arc = fit_arc(drop, first, last, first);
  for (int i = first; i < last; ++i) {
    const double t = (i - first) * drop_step_s;
    for (std::size_t k = 0; k < 3; ++k) {
      const double fallen = k == 1 ? 0.5 * g * t * t : 0.0;
      if (std::abs(drop[static_cast<std::size_t>(i)][k] - arc.place[k] - arc.rate[k] * t + fallen) > on_the_arc[k])
        return false;
    }
  }
  return true;
}

// By least squares through values at frames from, from + 1, ...
struct Parabola {
  double value, slope, curve;  // at 0, per frame and frame^2
  double worst;                // largest deviation
  double scatter;
};

Parabola fit_line(const std::vector<double>& y, double from) {
  const auto n = static_cast<double>(y.size());
  double mean = 0, slope = 0, spread = 0;
  const double middle = from + 0.5 * (n - 1);
  for (const double v : y) mean += v / n;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double t = from + static_cast<double>(i) - middle;
    slope += t * y[i];
    spread += t * t;
  }
  slope /= spread;
  Parabola fit{mean - slope * middle, slope, 0, 0, 0};
  double sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double away = y[i] - fit.value - slope * (from + static_cast<double>(i));
    fit.worst = std::max(fit.worst, std::abs(away));
    sum += away * away;
  }
  fit.scatter = std::sqrt(sum / (n - 2));
  return fit;
}

Parabola fit_parabola(const std::vector<double>& y, double from) {
  const auto n = static_cast<double>(y.size());
  const double middle = from + 0.5 * (n - 1);
  double mean_square = 0, curve = 0, spread = 0;
  for (std::size_t i = 0; i < y.size(); ++i) mean_square += std::pow(from + static_cast<double>(i) - middle, 2) / n;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double u = std::pow(from + static_cast<double>(i) - middle, 2) - mean_square;
    curve += u * y[i];
    spread += u * u;
  }
  curve /= spread;
  std::vector<double> straight = y;
  for (std::size_t i = 0; i < y.size(); ++i) straight[i] -= curve * std::pow(from + static_cast<double>(i) - middle, 2);
  Parabola fit = fit_line(straight, from);
  fit.value += curve * middle * middle;
  fit.slope -= 2 * curve * middle;
  fit.curve = curve;
  fit.scatter *= std::sqrt((n - 2) / (n - 3));
  return fit;
}

// When line and parabola meet, in frames; NaN unless exactly once between the frames of one and of the other.
double meeting(const Parabola& before, const Parabola& after) {
  const double a = before.curve, b = before.slope - after.slope, c = before.value - after.value;
  const double root = b * b - 4 * a * c;
  double found = NAN;
  int count = 0;
  if (root < 0) return NAN;
  const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
  for (const double t : {q / a, c / q})
    if (t > -0.3 && t < 2.1) {
      found = t;
      ++count;
    }
  return count == 1 ? found : NAN;
}

}  // namespace

double tilt(double theta) { return theta - quarter * std::round(theta / quarter); }

Drops read_square_drops(const std::filesystem::path& folder) {
  Drops read;
  for (int number = 1;; ++number) {
    const auto path = folder / ("traj_" + std::to_string(number) + ".csv");
    if (!std::filesystem::exists(path)) break;
    read.drops.push_back(read_drop(path));
    if (read.drops.back().size() < 50) throw std::runtime_error(path.string() + ": fewer than 50 frames");
  }
  if (read.drops.empty()) throw std::runtime_error(folder.string() + ": no traj_1.csv");
  read.resting = resting_angle(read.drops);
  for (Drop& drop : read.drops)
    for (Triple& pose : drop) pose[2] = read.resting.th_rad - pose[2];
  return read;
}

Arc fit_arc(const Drop& drop, int first, int last, double at_frame) {
  Arc arc{first, last, at_frame, {}, {}, {}, {}};
  const int n = last - first;
  const double middle = (0.5 * (first + last - 1) - at_frame) * drop_step_s;
  double spread = 0;
  for (int i = first; i < last; ++i) spread += std::pow((i - at_frame) * drop_step_s - middle, 2);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto lifted = [&](int i) {
      const double t = (i - at_frame) * drop_step_s;
      return drop[static_cast<std::size_t>(i)][k] + (k == 1 ? 0.5 * g * t * t : 0.0);
    };
    double mean = 0, slope = 0, squares = 0;
    for (int i = first; i < last; ++i) {
      mean += lifted(i) / n;
      slope += lifted(i) * ((i - at_frame) * drop_step_s - middle) / spread;
    }
    for (int i = first; i < last; ++i)
      squares += std::pow(lifted(i) - mean - slope * ((i - at_frame) * drop_step_s - middle), 2);
    arc.place[k] = mean - slope * middle;
    arc.rate[k] = slope;
    arc.scatter[k] = std::sqrt(squares / (n - 2));
    arc.rate_deviation[k] = arc.scatter[k] / std::sqrt(spread);
  }
  return arc;
}

std::vector<std::array<int, 2>> free_flights(const Drop& drop) {
  std::vector<std::array<int, 2>> found;
  const int frames = static_cast<int>(drop.size());
  for (int first = 0; first + least_frames <= frames;) {
    int last = first + least_frames;
    if (!flies(drop, first, last)) {
      ++first;
      continue;
    }
    while (last < frames && flies(drop, std::max(first, last + 1 - window), last + 1)) ++last;
    double highest = 0;
    for (int i = first; i < last; ++i) highest = std::max(highest, clearance(drop[static_cast<std::size_t>(i)]));
    if (highest > 0.0035) found.push_back({first, last});
    first = last;
  }
  return found;
}

std::vector<Blow> clean_blows(const Drops& all) {
  std::vector<Blow> blows;
  for (std::size_t d = 0; d < all.drops.size(); ++d) {
    const Drop& drop = all.drops[d];
    const auto flights = free_flights(drop);
    for (std::size_t f = 0; f + 1 < flights.size(); ++f) {
      const auto [first, end] = flights[f];
      const auto [start, last] = flights[f + 1];
      if (start - end > 3) continue;
      const double at = 0.5 * (end - 1 + start);
      const Arc before = fit_arc(drop, std::max(first, end - blow_frames), end, at);
      const Arc after = fit_arc(drop, start, std::min(last, start + blow_frames), at);
      const double push = after.rate[1] - before.rate[1];
      if (push < 0.3) continue;
      const double tau = (before.place[1] - after.place[1]) / push;
      const double dx = after.place[0] - before.place[0] + tau * (after.rate[0] - before.rate[0]);
      const double turn = after.place[2] - before.place[2] + tau * (after.rate[2] - before.rate[2]);
      if (std::abs(dx) > 2e-4 || std::abs(turn) > 0.02) continue;
      Blow blow{static_cast<int>(d), {}, before.rate, after.rate, before.rate_deviation, after.rate_deviation};
      for (std::size_t k = 0; k < 3; ++k)
        blow.place[k] = 0.5 * (before.place[k] + after.place[k] + tau * (before.rate[k] + after.rate[k]));
      blow.place[1] -= 0.5 * g * tau * tau;
      blow.place[2] = tilt(blow.place[2]);
      blow.before[1] -= g * tau;
      blow.after[1] -= g * tau;
      blows.push_back(blow);
    }
  }
  return blows;
}

namespace {

std::vector<double> column(const Drop& drop, int first, int last, const auto& value) {
  std::vector<double> out;
  for (int i = first; i <= last; ++i) out.push_back(value(drop[static_cast<std::size_t>(i)]));
  return out;
}

// A strike just after frame b: rocking seen in frames b-5..b, what came of it in b+2..b+5.
bool strike_at(const Drop& drop, int b, Strike& strike) {
  const double flat = drop[static_cast<std::size_t>(b)][2] - tilt(drop[static_cast<std::size_t>(b)][2]);
  const auto turned = [&](const Triple& pose) { return pose[2] - flat; };
  const Parabola before = fit_parabola(column(drop, b - 5, b, turned), -5);
  const Parabola after = fit_line(column(drop, b + 2, b + 5, turned), 2);
  if (before.worst > 0.006 || after.worst > 0.006) return false;
  const double t = meeting(before, after);
  if (std::isnan(t)) return false;
  strike.rate_before = (before.slope + 2 * before.curve * t) / drop_step_s;
  strike.rate_after = after.slope / drop_step_s;
  const double jump = std::abs(strike.rate_after - strike.rate_before), rate = std::abs(strike.rate_before);
  const double angle = before.value + before.slope * t + before.curve * t * t;
  if (rate < 3 || std::abs(angle) > 0.06 || jump < std::max(1.0, 0.25 * rate)) return false;
  strike.pivot = strike.rate_before < 0 ? 1 : -1;
  if (turned(drop[static_cast<std::size_t>(b - 5)]) * strike.pivot < 0.05) return false;
  const double c = strike.pivot * h;
  const auto corner_x = [&](const Triple& p) { return p[0] - h * std::sin(p[2] - flat) + c * std::cos(p[2] - flat); };
  const auto corner_y = [&](const Triple& p) { return p[1] - c * std::sin(p[2] - flat) - h * std::cos(p[2] - flat); };
  const double sinks = fit_line(column(drop, b - 5, b, corner_y), -5).slope / drop_step_s;
  if (std::abs(sinks) > 0.12 * 2 * h * rate) return false;
  strike.slip_before = fit_line(column(drop, b - 5, b, corner_x), -5).slope / drop_step_s;
  strike.speed_after =
      fit_line(column(drop, b + 2, b + 5, [](const Triple& p) { return p[0]; }), 2).slope / drop_step_s;
  const double ratio = strike.rate_after / strike.rate_before;
  strike.misfit = std::hypot(before.scatter, after.scatter);
  // slope of a parabola through 6 frames, one beyond its end: 1.17 of a frame's scatter; slope of a line through 4: 0.45
  strike.ratio_deviation = std::hypot(0.45 * after.scatter, 1.17 * ratio * before.scatter) / (drop_step_s * rate);
  return true;
}

}  // namespace

std::vector<Strike> strikes(const Drops& all) {
  constexpr int apart = 8;  // frames: of a strike and its echo only the strike counts
  std::vector<Strike> found;
  for (std::size_t d = 0; d < all.drops.size(); ++d) {
    const int frames = static_cast<int>(all.drops[d].size());
    for (int b = 6; b + 7 < frames; ++b) {
      Strike strike{}, later{};
      if (!strike_at(all.drops[d], b, strike)) continue;
      // A frame still before the strike may pass for one after it: the later cut counts where it fits better.
      if (strike_at(all.drops[d], b + 1, later) && later.misfit < strike.misfit) strike = later;
      strike.drop = static_cast<int>(d);
      found.push_back(strike);
      b += apart;
    }
  }
  return found;
}

Lever lever(double tilt) {
  const double c = tilt > 0 ? h : -h;
  return {h * std::sin(tilt) - c * std::cos(tilt), c * std::sin(tilt) + h * std::cos(tilt)};
}

}  // namespace freestand::test
