#include "dynamics/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dynamics/batch.hpp"
#include "dynamics/plane_slide.hpp"

namespace freestand {
namespace dynamics {

bool moves_in_plane(const FloorMotion& motion) {
  return !motion.cross_mps2.empty() && std::isnan(motion.cross_over_horizontal);
}

namespace {

// Friction that differs between directions leads a block off the line along which its floor moves.
bool goes_in_plane(const Specimen& specimen, const FloorMotion& motion) {
  return moves_in_plane(motion) || specimen.friction.ratio_across != 1;
}

bool has_cross(const Shaking& shaking) { return shaking.motion && !shaking.motion->cross_mps2.empty(); }

// A floor whose two channels are proportional moves along a line: as this motion along it, to the bit where the second channel
// is zero.
Shaking along_line(const Shaking& shaking) {
  Shaking line = shaking;
  line.scale *= std::hypot(1.0, shaking.motion->cross_over_horizontal);
  return line;
}

// Its response in the directions of the two channels.
void turn_from_line(const Shaking& shaking, Response& response, History* history) {
  const double ratio = shaking.motion->cross_over_horizontal, along = 1 / std::hypot(1.0, ratio);
  const double across = ratio * along;
  response.residual_cross_slip_m = across * response.residual_slip_m;
  response.residual_slip_m *= along;
  if (!history) return;
  history->cross = true;
  for (HistoryPoint& point : history->points) {
    point.cross_slip_m = across * point.slip_m;
    point.cross_slip_velocity_mps = across * point.slip_velocity_mps;
    point.floor_cross_acceleration_mps2 = across * point.floor_acceleration_mps2;
    point.slip_m *= along;
    point.slip_velocity_mps *= along;
    point.floor_acceleration_mps2 *= along;
  }
}

using Respond = Response (*)(const Specimen&, const Shaking&, const Settings&, History*);

Response respond_with_cross(const Specimen& specimen, const Shaking& shaking, const Settings& settings,
                            History* history, Respond on_line) {
  if (!refusal_in_plane(specimen).empty()) return Response{.outcome = Outcome::not_finite};
  if (goes_in_plane(specimen, *shaking.motion)) {
    if (on_line != respond_on_line) return Response{.outcome = Outcome::not_finite};
    return respond_in_plane(set_up(specimen, shaking), settings, history);
  }
  Response response = on_line(specimen, along_line(shaking), settings, history);
  turn_from_line(shaking, response, history);
  return response;
}

// Those in the plane, and those that move along a line all the same.
void respond_batch_with_cross(std::span<const Specimen> specimens, std::span<const Shaking> shakings,
                              const Settings& settings, std::span<Response> responses) {
  std::vector<Specimen> blocks;
  std::vector<Shaking> lines;
  std::vector<std::size_t> at, in_plane;
  for (std::size_t i = 0; i < shakings.size(); ++i) {
    const bool cross = has_cross(shakings[i]);
    if (cross && (goes_in_plane(specimens[i], *shakings[i].motion) || !refusal_in_plane(specimens[i]).empty())) {
      if (refusal_in_plane(specimens[i]).empty())
        in_plane.push_back(i);
      else
        responses[i] = {.outcome = Outcome::not_finite};
      continue;
    }
    blocks.push_back(specimens[i]);
    lines.push_back(cross ? along_line(shakings[i]) : shakings[i]);
    at.push_back(i);
  }
  respond_in_plane(specimens, shakings, settings, in_plane, responses);
  std::vector<Response> answers(at.size());
  respond_and_count(blocks, lines, settings, answers);
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (has_cross(lines[k])) turn_from_line(lines[k], answers[k], nullptr);
    responses[at[k]] = answers[k];
  }
}

}  // namespace
}  // namespace dynamics

Response respond(const Specimen& specimen, const Shaking& shaking, const Settings& settings, History* history) {
  if (history) history->cross = false;
  if (!dynamics::has_cross(shaking)) return dynamics::respond_on_line(specimen, shaking, settings, history);
  return dynamics::respond_with_cross(specimen, shaking, settings, history, dynamics::respond_on_line);
}

Response respond_reference(const Specimen& specimen, const Shaking& shaking, const Settings& settings,
                           History* history) {
  if (history) history->cross = false;
  if (!dynamics::has_cross(shaking)) return dynamics::respond_reference_on_line(specimen, shaking, settings, history);
  return dynamics::respond_with_cross(specimen, shaking, settings, history, dynamics::respond_reference_on_line);
}

void respond_batch(std::span<const Specimen> specimens, std::span<const Shaking> shakings, const Settings& settings,
                   std::span<Response> responses) {
  for (const Shaking& shaking : shakings)
    if (dynamics::has_cross(shaking))
      return dynamics::respond_batch_with_cross(specimens, shakings, settings, responses);
  dynamics::respond_and_count(specimens, shakings, settings, responses);
}

void respond_batch(std::span<const Specimen> specimens, std::span<const Shaking> shakings, const Settings& settings,
                   std::span<Response> responses, std::span<History> histories) {
  if (std::any_of(shakings.begin(), shakings.end(), dynamics::has_cross)) {
    for (std::size_t i = 0; i < specimens.size(); ++i)
      responses[i] = respond(specimens[i], shakings[i], settings, &histories[i]);
    return;
  }
  for (History& history : histories) history.cross = false;
  dynamics::respond_and_count(specimens, shakings, settings, responses, histories);
}

}  // namespace freestand
