#include "judge/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <freestand/simulate.hpp>

#include "hidden_effect/kernel_specimen.hpp"

namespace freestand::test {
namespace {

constexpr double step_s = 1e-4, accuracy = 1e-6, accuracy_on_contact = 1e-9, free_vibration_s = 1, margin = 6,
                 fanned_out = 1e-4, edge = 1e-7, finest = finest_step_s / step_s;

using Integrator = Response (*)(const Specimen&, const freestand::Shaking&, const Settings&, History*);

struct Answer {
  const char* who;
  Response response;
  History history;
};

// The tolerance also ends the endless rows of hops, with an error in speed that goes with its root: the judge looks at the tightest,
// and the reference says where it cannot keep it. At that of a sweep the rows must be felt as well, which its largest accelerations tell.
constexpr double tightest = 1e-12, usual = Settings{}.tolerance;

Answer answer(const JudgedCase& c, const char* who, Integrator integrate, double tolerance = tightest) {
  const FloorMotion motion = motion_of(c.floor);
  const freestand::Shaking shaking{&motion, 1, 1, 0};
  Settings settings;
  settings.free_vibration_s = free_vibration_s;
  for (settings.tolerance = tolerance;; settings.tolerance *= 10) {
    Answer a{who, {}, {}};
    a.history.step_s = c.floor.dt_s;
    try {
      a.response = integrate(specimen_of(c.truth), shaking, settings, &a.history);
      return a;
    } catch (const Error&) {
      if (settings.tolerance > 1e-10) throw;
    }
  }
}

// The stepper's history, and how far off it may be at each sample.
struct Evidence {
  TruthHistory history;
  double own_path_m = 0, own_acceleration_mps2 = 0;  // of the path slid and of the largest acceleration
  double own_peak_m = 0;                             // of the largest slip
  bool one_outcome = true;
  std::vector<double> own = {};  // up to where it has fanned out
};

double distance(const TruthHistory& a, const TruthHistory& b, std::size_t i) {
  return std::max(std::abs(a.slip_m[i] - b.slip_m[i]), std::abs(a.rotation_rad[i] - b.rotation_rad[i]));
}

void doubt(Evidence& evidence, const TruthHistory& other) {
  const TruthHistory& h = evidence.history;
  evidence.own_path_m = std::max(evidence.own_path_m, std::abs(h.slid_path_m - other.slid_path_m));
  evidence.own_acceleration_mps2 =
      std::max(evidence.own_acceleration_mps2, std::abs(h.peak_acceleration_mps2 - other.peak_acceleration_mps2));
  evidence.own_peak_m = std::max(evidence.own_peak_m, std::abs(h.peak_slip_m - other.peak_slip_m));
  evidence.one_outcome = evidence.one_outcome && h.outcome == other.outcome;
  double own = 0;
  for (std::size_t i = 0; i < evidence.own.size(); ++i) {
    own = std::max(own, distance(evidence.history, other, i));
    evidence.own[i] = std::max(own, evidence.own[i]);
    if (evidence.own[i] > fanned_out) evidence.own.resize(i);
  }
}

Evidence evidence(const JudgedCase& c, double step) {
  Evidence e{simulate(c.truth, c.floor, 0.5 * step)};
  e.own.assign(c.floor.horizontal_mps2.size(), 0);
  doubt(e, simulate(c.truth, c.floor, step));
  return e;
}

// The same on floors a little weaker and stronger, and with a wall that touches the block a nanometre off it, which move
// the history as little unless it stands on an edge.
void doubt_edges(Evidence& evidence, const JudgedCase& c, double step) {
  for (const double factor : {1 - edge, 1 + edge}) {
    FloorSamples floor = c.floor;
    for (double& a : floor.horizontal_mps2) a *= factor;
    for (double& v : floor.vertical_mps2) v *= factor;
    doubt(evidence, simulate(c.truth, floor, 0.5 * step));
  }
  constexpr double off_m = 1e-9;
  Truth truth = c.truth;
  bool touches = false;
  for (TruthEffect& effect : truth.effects)
    if (effect.name == "wall_impact")
      for (const char* gap : {"gap_m", "other_gap_m"})
        if (effect.parameters.count(gap) && effect.parameters.at(gap) == 0)
          touches = true, effect.parameters[gap] = off_m;
  if (touches) doubt(evidence, simulate(truth, c.floor, 0.5 * step));
}

// First time at which it came down from flight so flat that which corner came first is below what anyone computes [s].
double landing_nearly_flat(const Evidence& e, const Answer& a) {
  constexpr double at_once = 1e-4;  // [s]
  double first = 1e300;
  for (std::size_t i = 0; i < e.history.deeds.size() && first > 1e299; ++i)
    if (e.history.deeds[i] & landed_nearly_flat) first = (static_cast<double>(i) - 1) * e.history.dt_s;
  const auto& events = a.history.events;
  for (std::size_t i = 0; i + 1 < events.size(); ++i)
    if (events[i].from == Mode::flight && events[i].impact && events[i + 1].impact &&
        events[i + 1].time_s - events[i].time_s < at_once)
      return std::min(first, events[i].time_s);
  return first;
}

bool broke_off(const Response& response) { return *failure(response.outcome) != '\0'; }

// The block has come to rest, and no later than its motion.
bool stands_at_the_end(const Evidence& e, const Answer& a, double allowed_m) {
  constexpr std::size_t quiet = 20;
  const TruthHistory& h = e.history;
  return h.deeds.size() >= quiet &&
         std::all_of(h.deeds.end() - quiet, h.deeds.end(), [](unsigned deed) { return deed == 0; }) &&
         std::abs(a.response.residual_slip_m - h.slip_m.back()) <= allowed_m;
}

// Where a row of hops is cut off the block is felt as the floor moved then: by how much the floor's acceleration has changed while the
// stepper's block rattled on.
double unfelt_in_hops(const JudgedCase& c, const Evidence& e, const Answer& a) {
  const auto& points = a.history.points;
  const auto& x = c.floor.horizontal_mps2;
  const auto& y = c.floor.vertical_mps2;
  const std::size_t end = std::min({points.size(), e.history.deeds.size(), x.size()});
  double most = 0;
  for (std::size_t i = 0, cut = 0; i < end; ++i) {
    const bool rattles_on = points[i].mode == Mode::rest && (e.history.deeds[i] & (rocked | slide_rocked)) != 0;
    if (!rattles_on) cut = i;
    most = std::max(most, std::hypot(x[i] - x[cut], y.empty() ? 0 : y[i] - y[cut]));
  }
  return most;
}

// Of the largest acceleration. Accelerations are those in the middle of steps: between two of them they change by no more
// than a floor and a rattling block do in a step.
std::string difference_of_accelerations(const JudgedCase& c, const Evidence& e, const Answer& a) {
  constexpr double unseen_mps2 = 0.02;
  const TruthHistory& h = e.history;
  const double told = a.response.peak_acceleration_mps2;
  // What is brief beside a wall the stepper feels, and the kernel leaves out.
  const bool rattled = std::any_of(h.deeds.begin(), h.deeds.end(), [](unsigned deed) {
    return (deed & (struck_by_face | struck_by_lower_edge | struck_by_upper_edge)) != 0;
  });
  if (rattled && told < h.peak_acceleration_mps2) return "";
  const double allowed = unseen_mps2 + unfelt_in_hops(c, e, a) + margin * e.own_acceleration_mps2;
  if (std::abs(told - h.peak_acceleration_mps2) <= allowed) return "";
  return fmt::format("{}: peak acceleration {:.4f} against {:.4f} m/s2, own {:.1e}", a.who, told,
                     h.peak_acceleration_mps2, e.own_acceleration_mps2);
}

// Of the path and of the largest acceleration.
std::string difference_at_the_end(const JudgedCase& c, const Evidence& e, const Answer& a) {
  if (!stands_at_the_end(e, a, accuracy)) return "";
  const double told = a.response.slid_path_m, path = e.history.slid_path_m;
  if (std::abs(told - path) > 10 * accuracy + margin * e.own_path_m)
    return fmt::format("{}: slid path {:.7f} against {:.7f} m, own {:.1e}", a.who, told, path, e.own_path_m);
  return difference_of_accelerations(c, e, a);
}

// On a Bouc-Wen contact it rings for ever: the stepper goes on for as long as the kernel may.
JudgedCase rung_out(JudgedCase c) {
  const std::size_t samples =
      c.floor.horizontal_mps2.size() + static_cast<std::size_t>(free_vibration_s / c.floor.dt_s);
  c.floor.horizontal_mps2.resize(samples);
  c.floor.vertical_mps2.resize(samples);
  return c;
}

// The slip at which it rings out, where that has shown: between its last two turns, or where it is if time is up.
std::string difference_of_residuals(const Evidence& e, const Answer& a, double yield_m) {
  constexpr std::size_t quiet = 100, enough = 3;  // samples at the end; middles of swings in them
  constexpr double unseen_m = 1e-7;
  const TruthHistory& h = e.history;
  const double given = a.response.residual_slip_m, last_s = static_cast<double>(h.slip_m.size() - 1) * h.dt_s;
  if (a.response.end_time_s > last_s - 1e-9) {
    if (std::abs(given - h.residual_slip_m) <= unseen_m + margin * e.own.back()) return "";
    return fmt::format("{}: residual slip {:.8f} against {:.8f} m", a.who, given, h.residual_slip_m);
  }
  // The middles of its last swings, which contents that hang inside move to and fro.
  std::vector<double> middles;
  for (std::size_t i = 1; i < h.turns_m.size(); ++i)
    if (h.turns_s[i - 1] > last_s - static_cast<double>(quiet) * h.dt_s)
      middles.push_back(0.5 * (h.turns_m[i - 1] + h.turns_m[i]));
  if (middles.size() < enough) return "";
  const auto [least, most] = std::minmax_element(h.remaining_m.end() - quiet, h.remaining_m.end());
  const auto [first, last] = std::minmax_element(middles.begin(), middles.end());
  const double slips_on = *most - *least, sways = *last - *first;
  if (slips_on + sways > 0.01 * yield_m) return "";
  const auto [low, high] = std::minmax({h.turns_m.back(), h.turns_m[h.turns_m.size() - 2]});
  if (std::max(low - given, given - high) <= unseen_m + slips_on + sways + margin * e.own.back()) return "";
  return fmt::format("{}: residual slip {:.8f} m, but it swings from {:.8f} to {:.8f} m", a.who, given, low, high);
}

// On a Bouc-Wen contact: of what is told of the whole sample.
std::string difference_on_contact(const Evidence& e, const Answer& a, double yield_m) {
  constexpr double unseen_mps2 = 0.02, unseen_m = 1e-7;
  const TruthHistory& h = e.history;
  const Response& r = a.response;
  if (broke_off(r) || (e.one_outcome && h.outcome != name(r.outcome)))
    return fmt::format("{}: outcome {} against {}", a.who, name(r.outcome), h.outcome);
  if (std::abs(r.peak_slip_m - h.peak_slip_m) > unseen_m + margin * e.own_peak_m)
    return fmt::format("{}: peak slip {:.8f} against {:.8f} m, own {:.1e}", a.who, r.peak_slip_m, h.peak_slip_m,
                       e.own_peak_m);
  const std::size_t before = std::min(static_cast<std::size_t>(r.end_time_s / h.dt_s), h.path_m.size() - 1),
                    after = std::min(before + 1, h.path_m.size() - 1);
  const double path_error = unseen_m + margin * e.own_path_m;
  if (r.slid_path_m < h.path_m[before] - path_error || r.slid_path_m > h.path_m[after] + path_error)
    return fmt::format("{}: slid path {:.8f} against {:.8f} to {:.8f} m, own {:.1e}", a.who, r.slid_path_m,
                       h.path_m[before], h.path_m[after], e.own_path_m);
  if (std::abs(r.peak_acceleration_mps2 - h.peak_acceleration_mps2) > unseen_mps2 + margin * e.own_acceleration_mps2)
    return fmt::format("{}: peak acceleration {:.4f} against {:.4f} m/s2, own {:.1e}", a.who, r.peak_acceleration_mps2,
                       h.peak_acceleration_mps2, e.own_acceleration_mps2);
  return difference_of_residuals(e, a, yield_m);
}

// Empty: within what is allowed. parted_s: when they do, if that can be told.
std::string difference(const JudgedCase& c, const Evidence& e, const Answer& a, double& parted_s) {
  const bool on_contact = c.family == Family::bouc_wen;
  const double allowed = on_contact ? accuracy_on_contact : accuracy;
  const TruthHistory& h = e.history;
  const double undecided_s = landing_nearly_flat(e, a);
  for (std::size_t i = 0; i < e.own.size(); ++i) {
    if (static_cast<double>(i) * h.dt_s > undecided_s) return "";
    if (i >= a.history.points.size()) {
      if (on_contact) break;
      if (!broke_off(a.response) || h.outcome == "painleve" || e.own[i] > accuracy) return "";
      return fmt::format("{} broke off ({}) at {:.4f} s, the stepper goes on", a.who, name(a.response.outcome),
                         a.response.end_time_s);
    }
    const HistoryPoint& p = a.history.points[i];
    if (h.outcome == "overturned" && a.response.outcome == Outcome::overturned && std::abs(h.rotation_rad[i]) > pi / 2)
      return "";  // both lie
    const double off = std::max(std::abs(h.slip_m[i] - p.slip_m), std::abs(h.rotation_rad[i] - p.rotation_rad));
    if (!(off <= allowed + margin * e.own[i])) {
      parted_s = p.time_s;
      return fmt::format(
          "{} ({}) at {:.3f} s: slip {:.7f} against {:.7f} m, rotation {:.7f} against {:.7f} rad, own {:.1e}", a.who,
          name(p.mode), p.time_s, p.slip_m, h.slip_m[i], p.rotation_rad, h.rotation_rad[i], e.own[i]);
    }
  }
  if (on_contact) return e.own.size() < h.slip_m.size() ? "" : difference_on_contact(e, a, c.truth.contact.yield_m);
  if (e.own.size() < h.slip_m.size() || undecided_s < a.response.end_time_s || h.outcome != "moved") return "";
  if (broke_off(a.response)) return fmt::format("{}: outcome {} against moved", a.who, name(a.response.outcome));
  return difference_at_the_end(c, e, a);
}

// At the tolerance of a sweep the errors that end its rows of hops go with the root of it, and rocking makes them grow: where it
// comes to rest as the stepper does, it has felt the same.
std::string difference_of_a_sweep(const JudgedCase& c, const Evidence& e, const Answer& a) {
  const double allowed = accuracy * std::sqrt(usual / tightest);
  const TruthHistory& h = e.history;
  const bool to_its_end = e.own.size() == h.slip_m.size() && h.outcome == "moved" &&
                          landing_nearly_flat(e, a) >= a.response.end_time_s && !broke_off(a.response);
  return to_its_end && stands_at_the_end(e, a, allowed) ? difference_of_accelerations(c, e, a) : "";
}

}  // namespace

Judgement judge(const JudgedCase& judged) try {
  const bool on_contact = judged.family == Family::bouc_wen;
  const Answer answers[] = {answer(judged, "respond", respond), answer(judged, "respond_reference", respond_reference)};
  const Answer sweep = on_contact ? Answer{} : answer(judged, "respond, tolerance of a sweep", respond, usual);
  const JudgedCase c = on_contact ? rung_out(judged) : judged;
  Judgement result;
  const auto first_difference = [&](const Evidence& e) {
    for (const Answer& a : answers)
      if (std::string text = difference(c, e, a, result.parted_s); !text.empty()) return text;
    return on_contact ? std::string() : difference_of_a_sweep(c, e, sweep);
  };
  Evidence e = evidence(c, step_s);
  for (const double part : {1.0, 1.0 / 4, finest}) {
    if (part < 1) {
      e = evidence(c, part * step_s);
      doubt(e, simulate(c.truth, c.floor, 0.7 * part * step_s));
    }
    result.what = first_difference(e);
    result.finding = result.what.empty() ? Finding::agrees : Finding::disagrees;
    if (result.what.empty()) break;
    if (part == 1) continue;
    doubt_edges(e, c, part * step_s);
    if (first_difference(e).empty()) result.finding = Finding::on_an_edge;
    if (result.finding == Finding::on_an_edge) break;
  }
  result.compared = e.own.size();
  result.samples = e.history.slip_m.size();
  for (std::size_t i = 0; i < e.own.size(); ++i) result.deeds |= e.history.deeds[i];
  return result;
} catch (const Error& error) {  // no answer at all
  Judgement result;
  result.finding = Finding::disagrees;
  result.what = error.what();
  return result;
}

// The same floor, its lines cut into ten pieces each.
JudgedCase finer(const JudgedCase& c) {
  constexpr std::size_t pieces = 10;
  JudgedCase result = c;
  result.floor.dt_s /= pieces;
  const auto cut = [](std::vector<double>& samples) {
    std::vector<double> all;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
      for (std::size_t k = 0; k < pieces; ++k)
        all.push_back(samples[i] + (samples[i + 1] - samples[i]) * static_cast<double>(k) / pieces);
    samples = all;
  };
  cut(result.floor.horizontal_mps2);
  cut(result.floor.vertical_mps2);
  return result;
}

std::string side_by_side(const JudgedCase& coarse, double from_s, double to_s) {
  const JudgedCase c = finer(coarse);
  const auto sample = [&](double t) { return static_cast<std::size_t>(t / c.floor.dt_s); };
  const std::size_t from = sample(from_s), to = sample(to_s);
  const Answer fast = answer(c, "respond", respond);
  const Evidence e = evidence(c, 0.25 * step_s);
  std::string text = fmt::format(
      "time_s a v | respond: slip rotation mode | stepper: slip rotation deeds own; respond ends {} at {:.5f}, stepper "
      "{}\n",
      name(fast.response.outcome), fast.response.end_time_s, e.history.outcome);
  for (std::size_t i = from; i < std::min(to, e.history.slip_m.size()); ++i) {
    text += fmt::format("{:.4f} {:8.4f} {:8.4f} | ", static_cast<double>(i) * c.floor.dt_s, c.floor.horizontal_mps2[i],
                        c.floor.vertical_mps2.empty() ? 0.0 : c.floor.vertical_mps2[i]);
    if (i < fast.history.points.size()) {
      const HistoryPoint& p = fast.history.points[i];
      text += fmt::format("{:12.9f} {:12.5e} {:10} | ", p.slip_m, p.rotation_rad, name(p.mode));
    }
    text += fmt::format("{:12.9f} {:12.5e} {:4x} {:.1e}\n", e.history.slip_m[i], e.history.rotation_rad[i],
                        e.history.deeds[i], i < e.own.size() ? e.own[i] : -1.0);
  }
  for (const Event& event : fast.history.events)
    if (event.time_s > from_s && event.time_s < to_s)
      text += fmt::format("event {:.7f} {} -> {} pivot {}{}\n", event.time_s, name(event.from), name(event.to),
                          event.pivot, event.impact ? " impact" : "");
  return text;
}

}  // namespace freestand::test
