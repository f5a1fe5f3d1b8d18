#include "measurement/predict/bench.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "measurement/data/floor_readings.hpp"
#include "measurement/data/resolution.hpp"
#include "measurement/noise/quiet.hpp"
#include "measurement/noise/third_differences.hpp"

namespace freestand::measurement {
namespace {

FloorMotion with_noise(FloorReadings floor, double horizontal, double vertical, std::uint64_t replay,
                       std::uint64_t stream) {
  auto &a = floor.horizontal_mps2, &v = floor.vertical_mps2;
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += horizontal * random::standard_normal(1 + replay, i, stream);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += vertical * random::standard_normal(1 + replay, i, ~stream);
  return motion_through(floor);
}

// The motion at so many steps from its beginning: between two points by the cubic through the values and rates of both,
// accelerations by the line. Before it and after it as it begins and ends.
HistoryPoint at_step(const std::vector<HistoryPoint>& points, double step, double dt_s) {
  if (points.empty()) return {};
  const double within = std::clamp(step, 0.0, static_cast<double>(points.size() - 1));
  const auto i = static_cast<std::size_t>(within);
  const double part = within - static_cast<double>(i);
  HistoryPoint point = points[i];
  if (part == 0) return point;
  const HistoryPoint& next = points[i + 1];
  const auto line = [&](double& from, double to) { from += part * (to - from); };
  const auto cubic = [&](double& from, double rate, double to, double next_rate) {
    const double rest = 1 - part;
    from = rest * rest * (from * (1 + 2 * part) + rate * part * dt_s) +
           part * part * (to * (3 - 2 * part) - next_rate * rest * dt_s);
  };
  cubic(point.slip_m, point.slip_velocity_mps, next.slip_m, next.slip_velocity_mps);
  cubic(point.rotation_rad, point.rotation_rate_radps, next.rotation_rad, next.rotation_rate_radps);
  line(point.slip_velocity_mps, next.slip_velocity_mps);
  line(point.acceleration_mps2, next.acceleration_mps2);
  return point;
}

constexpr double predicted_to = 1e-8;  // tolerance

Reach reach_of(const Test& test) {
  Reach reach;
  for (const double slip : test.slip_m) {
    reach.least_m = std::min(reach.least_m, slip);
    reach.greatest_m = std::max(reach.greatest_m, slip);
  }
  if (const auto peak = test.peaks.peak_slip_m) {
    reach.least_m = std::min(reach.least_m, -*peak);
    reach.greatest_m = std::max(reach.greatest_m, *peak);
  }
  return reach;
}

}  // namespace

const std::vector<double>& Prediction::channel(Channel which) const {
  if (which == Channel::slip) return slip_m;
  return which == Channel::rotation ? rotation_rad : block_acceleration_mps2;
}

namespace {

Shaking shaking_of(const Asked& asked) {
  Shaking shaking = asked.test.shaking();
  if (asked.other) shaking.motion = asked.other;
  shaking.scale *= asked.model.floor_gain.of(asked.x);
  return shaking;
}

// The history on the time steps of the measured ones.
Prediction at_steps_of(const Asked& asked, const Response& response, const History& history) {
  Prediction out{.response = response};
  const Test& test = asked.test;
  const std::size_t n = test.points();
  const double steps_behind = asked.model.clock_behind.of(asked.x) / test.dt_s;
  for (std::vector<double>* channel : {&out.slip_m, &out.rotation_rad, &out.slip_velocity_mps}) channel->reserve(n);
  out.mode.reserve(n);
  if (history.forces) out.block_acceleration_mps2.reserve(n);
  const auto add = [&](const HistoryPoint& point) {
    out.slip_m.push_back(point.slip_m);
    out.rotation_rad.push_back(point.rotation_rad);
    out.slip_velocity_mps.push_back(point.slip_velocity_mps);
    out.mode.push_back(point.mode);
    if (history.forces) out.block_acceleration_mps2.push_back(point.acceleration_mps2);
  };
  for (std::size_t i = 0; i < n; ++i)
    if (steps_behind == 0 && i < history.points.size())
      add(history.points[i]);
    else
      add(at_step(history.points, static_cast<double>(i) - steps_behind, test.dt_s));
  return out;
}

constexpr std::size_t at_once = 32, points_at_once = 200000;  // whose histories are held; 24 MB if all are alike

// How many of those from i on have histories and are computed together.
std::size_t count_together(const std::vector<Asked>& asked, std::size_t i) {
  std::size_t count = 0, points = 0;
  for (; count < at_once && i + count < asked.size() && asked[i + count].test.has_history(); ++count) {
    points += asked[i + count].test.points();
    if (count > 0 && points > points_at_once) break;
  }
  return count;
}

void predict_some(std::span<const Asked> asked, std::size_t first,
                  const std::function<void(std::size_t, Prediction)>& use) {
  thread_local std::vector<History> histories(at_once);
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (const Asked& one : asked) {
    specimens.push_back(specimen(one.model, one.test, one.x));
    shakings.push_back(shaking_of(one));
    History& history = histories[specimens.size() - 1];
    history.step_s = one.test.dt_s;
    history.forces = !one.test.block_acceleration_mps2.empty();
  }
  std::vector<Response> responses(asked.size());
  respond_batch(specimens, shakings, {.tolerance = predicted_to, .free_vibration_s = 0}, responses,
                std::span(histories).first(asked.size()));
  std::vector<Prediction> all;  // first, since who uses one may ask for others
  for (std::size_t i = 0; i < asked.size(); ++i) all.push_back(at_steps_of(asked[i], responses[i], histories[i]));
  for (std::size_t i = 0; i < asked.size(); ++i) use(first + i, std::move(all[i]));
}

std::vector<Asked> asked_under(const std::vector<FloorMotion>& motions, const ModelSpec& model, const Test& test,
                               std::span<const double> x) {
  std::vector<Asked> asked;
  for (const FloorMotion& motion : motions) asked.push_back({model, test, Values(x.begin(), x.end()), &motion});
  return asked;
}

}  // namespace

void predict(const std::vector<Asked>& asked, const std::function<void(std::size_t i, Prediction)>& use) {
  for (std::size_t i = 0; i < asked.size();) {
    if (const std::size_t count = count_together(asked, i)) {
      predict_some(std::span(asked).subspan(i, count), i, use);
      i += count;
      continue;
    }
    const Asked& one = asked[i];
    use(i++, {.response = respond(specimen(one.model, one.test, one.x), shaking_of(one), {.tolerance = predicted_to})});
  }
}

std::vector<Prediction> predict(const std::vector<Asked>& asked) {
  std::vector<Prediction> all(asked.size());
  predict(asked, [&](std::size_t i, Prediction one) { all[i] = std::move(one); });
  return all;
}

void predict(const ModelSpec& model, const std::vector<const Test*>& tests, const std::vector<Values>& points,
             const std::function<void(std::size_t point, std::size_t test, const Prediction&)>& use) {
  std::vector<Asked> asked;
  for (const Values& x : points)
    for (const Test* test : tests) asked.push_back({model, *test, x});
  predict(asked, [&](std::size_t i, const Prediction& p) { use(i / tests.size(), i % tests.size(), p); });
}

Prediction predict(const ModelSpec& model, const Test& test, std::span<const double> x, const FloorMotion* other) {
  return std::move(predict(std::vector<Asked>{{model, test, Values(x.begin(), x.end()), other}}).front());
}

Bench::Bench(const Dataset& data, int replays) : data_(data), replays_(data.tests.size()) {
  for (std::size_t i = 0; i < data.tests.size(); ++i) {
    const Test& test = data.tests[i];
    reach_.push_back(reach_of(test));
    const bool recorded = test.has_history() && test.motion.degree == 1;
    const FloorReadings floor = recorded ? readings_of(test) : FloorReadings{};
    const double horizontal = measurement::floor_noise_mps2(data, test);
    const double vertical = sensor_noise(floor.vertical_mps2);
    floor_noise_mps2_.push_back(horizontal);
    between_readings_.push_back(recorded && replays > 0 ? measurement::between_readings(floor, horizontal)
                                                        : BetweenReadings{});
    const std::uint64_t stream = random::stable_hash(test.id);
    for (int k = 0; recorded && k < replays; ++k)
      replays_[i].push_back(with_noise(floor, horizontal, vertical, static_cast<std::uint64_t>(k), stream));
  }
}

Reach Bench::reach() const {
  std::vector<std::size_t> tests;
  for (std::size_t i = 0; i < size(); ++i)
    if (test(i).role == Role::calibration) tests.push_back(i);
  return reach(tests);
}

Reach Bench::reach(const std::vector<std::size_t>& tests) const {
  Reach all;
  for (const std::size_t i : tests) {
    all.least_m = std::min(all.least_m, reach_[i].least_m);
    all.greatest_m = std::max(all.greatest_m, reach_[i].greatest_m);
  }
  return all;
}

double Bench::noise(Channel channel) const { return measurement::noise(data_.noise, channel); }

void Bench::estimate_sensors() {
  for (int c = 0; c < channel_count; ++c) {
    const auto channel = static_cast<Channel>(c);
    double rounded = 0;
    for (const Test& test : data_.tests)
      if (test.role == Role::calibration) rounded = std::max(rounded, rounding(readings(test, channel)));
    sensors_[c] = sensor_of(quiet_stretches(data_, channel), noise(channel) > 0 ? rounded / noise(channel) : 0);
    if (channel == Channel::block_acceleration) leave_out_floor(sensors_[c]);
  }
}

// A block that stands still shows the floor: what is left over the floor's channel is the noise of both.
void Bench::leave_out_floor(Sensor& both) const {
  double square = 0, tests = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (test(i).role == Role::calibration && !test(i).block_acceleration_mps2.empty())
      square += std::pow(floor_noise_mps2_[i] / noise(Channel::block_acceleration), 2), tests += 1;
  if (tests == 0) return;
  const double of_floor = square / tests, scale = std::sqrt(1 + of_floor);
  constexpr double least = 0.01;  // sensor_of() looks no lower
  if (both.size() > 1) both.white = std::sqrt(std::max(std::pow(scale * both.white, 2) - of_floor, least * least));
  both.coloured *= scale;
}

std::vector<Asked> Bench::replays_asked(const ModelSpec& model, std::size_t i, std::span<const double> x) const {
  return asked_under(replays_[i], model, test(i), x);
}

Spread Bench::spread(const ModelSpec& model, std::size_t i, std::span<const double> x,
                     const Prediction& nominal) const {
  return changes(model, i, x, nominal, replays_[i]);
}

Spread Bench::unread_spread(const ModelSpec& model, std::size_t i, std::span<const double> x,
                            const Prediction& nominal) const {
  return changes(model, i, x, nominal, between_readings_[i].strayed);
}

Spread Bench::changes(const ModelSpec& model, std::size_t i, std::span<const double> x, const Prediction& nominal,
                      const std::vector<FloorMotion>& motions) const {
  Spread spread(channel_count);
  const double share = 1 / static_cast<double>(std::max<std::size_t>(motions.size(), 1));
  for (int c = 0; c < channel_count; ++c)
    spread[static_cast<std::size_t>(c)].assign(history(test(i), static_cast<Channel>(c)).size(), 0.0);
  predict(asked_under(motions, model, test(i), x), [&](std::size_t, const Prediction& other) {
    for (int c = 0; c < channel_count; ++c) {
      auto& variance = spread[static_cast<std::size_t>(c)];
      const auto& a = other.channel(static_cast<Channel>(c));
      const auto& b = nominal.channel(static_cast<Channel>(c));
      for (std::size_t k = 0; k < variance.size(); ++k) variance[k] += share * (a[k] - b[k]) * (a[k] - b[k]);
    }
  });
  return spread;
}

}  // namespace freestand::measurement
