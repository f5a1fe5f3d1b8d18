#include "dynamics/plane_slide.hpp"

#include <memory>
#include <optional>

#include "dynamics/batch.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/plane_rows.hpp"
#include "dynamics/plane_sample.hpp"

namespace freestand::dynamics {
namespace {

bool sound(const Setup& setup, const Settings& settings) {
  const FloorMotion& motion = *setup.shaking.motion;
  return motion.degree == 1 && motion.cross_mps2.size() == motion.horizontal_mps2.size() &&
         !motion.cross_run_mps2.empty() && setup.specimen.model == Model::slide && !has_laws(setup.specimen) &&
         setup.floor.push_mps2 == 0 && setup.floor.gravity_factor == 1 && admissible(setup, settings);
}

// Samples of one kind of friction and floor.
class PlanePool {
 public:
  PlanePool(PlaneMarch steps, int lanes, std::span<Response> responses, const Settings& settings)
      : march_(steps), most_lanes_(lanes), responses_(responses), settings_(settings) {
    rows_.tolerance = settings.tolerance;
  }

  void add(const Setup& setup, std::size_t sample) {
    while (rows_.lanes == most_lanes_) march();
    const int slot = rows_.lanes;
    lanes_[slot] = {sample, std::make_unique<PlaneSample>(setup, settings_, nullptr)};
    if (!walks_on(*lanes_[slot].sample)) return end(slot);
    ++rows_.lanes;
    write(slot);
  }
  void finish() {
    while (rows_.lanes > 0) march();
  }

 private:
  struct Lane {
    std::size_t number = 0;
    std::unique_ptr<PlaneSample> sample = {};
  };

  // Step by step, until it can march. False: it has ended.
  static bool walks_on(PlaneSample& sample) {
    while (sample.goes_on()) {
      if (sample.marches()) return true;
      sample.turn();
    }
    return false;
  }

  void end(int slot) { responses_[lanes_[slot].number] = lanes_[slot].sample->result(); }

  void write(int slot) {
    rows_.samples[slot] = lanes_[slot].sample.get();
    rows_.steps[slot] = rows_.samples[slot]->steps();
    const auto* from = reinterpret_cast<const double*>(&rows_.samples[slot]->state());
    for (int k = 0; k < plane_numbers; ++k) rows_.numbers[k][slot] = from[k];
  }
  void read(int slot) {
    auto* to = reinterpret_cast<double*>(&rows_.samples[slot]->state());
    for (int k = 0; k < plane_numbers; ++k) to[k] = rows_.numbers[k][slot];
    rows_.samples[slot]->marched(rows_.steps[slot]);
  }

  void march() {
    const unsigned stopped = march_(rows_);
    // From the last one on, since the last one of all takes the place of one that ends.
    for (int slot = rows_.lanes; slot-- > 0;) {
      if (!(stopped >> slot & 1U)) continue;
      read(slot);
      PlaneSample& sample = *lanes_[slot].sample;
      if (!sample.motion_over()) sample.turn();
      if (walks_on(sample)) {
        write(slot);
        continue;
      }
      end(slot);
      const int last = --rows_.lanes;
      std::swap(lanes_[slot], lanes_[last]);
      for (auto& row : rows_.numbers) row[slot] = row[last];
      rows_.steps[slot] = rows_.steps[last];
      rows_.samples[slot] = rows_.samples[last];
    }
  }

  const PlaneMarch march_;
  const int most_lanes_;
  const std::span<Response> responses_;
  const Settings settings_;
  PlaneRows rows_;
  Lane lanes_[plane_slots];
};

}  // namespace

bool PlaneRows::next_segment(int slot) {
  samples[slot]->next_segment();
  const auto* from = reinterpret_cast<const double*>(&samples[slot]->state());
  for (int k = 0; k < numbers_of_segment; ++k) numbers[k][slot] = from[k];
  steps[slot] = 0;
  return !samples[slot]->motion_over();
}

std::string refusal_in_plane(const Specimen& specimen) {
  if (specimen.model != Model::slide) return "a block is followed in both horizontal directions where it only slides";
  if (!specimen.start.upright_at_rest()) return "in the plane a block begins at rest where it is counted from";
  if (specimen.neighbour) return "two blocks side by side are followed along one line";
  if (specimen.legs) return "a block on legs that give way is followed along one line";
  for (const EffectUse& use : specimen.effects) {
    FloorInput floor;
    if (use.effect->floor) use.effect->floor(floor, use.parameters);
    if (use.effect->dynamic() || floor.push_mps2 != 0 || floor.gravity_factor != 1)
      return "the law of effect " + use.effect->name + " is along one line, and not known in the plane";
  }
  return "";
}

Response respond_in_plane(const Setup& setup, const Settings& settings, History* history) {
  if (!sound(setup, settings)) return Response{.outcome = Outcome::not_finite};
  PlaneSample sample(setup, settings, history);
  while (sample.goes_on()) sample.turn();
  return sample.result();
}

void respond_in_plane(std::span<const Specimen> specimens, std::span<const Shaking> shakings, const Settings& settings,
                      const std::vector<std::size_t>& which, std::span<Response> responses) {
  const BatchKernels* kernels = batch_kernels();
  std::unique_ptr<PlanePool> pools[2][2];  // [elliptic][shaken]
  for (const std::size_t i : which) {
    const Setup setup = set_up(specimens[i], shakings[i]);
    if (!kernels || !sound(setup, settings)) {
      responses[i] = respond_in_plane(setup, settings, nullptr);
      continue;
    }
    const bool elliptic = setup.specimen.friction.ratio_across != 1,
               shaken = setup.shaking.vertical_scale != 0 && !setup.shaking.motion->vertical_mps2.empty();
    std::unique_ptr<PlanePool>& pool = pools[elliptic][shaken];
    if (!pool)
      pool = std::make_unique<PlanePool>(kernels->in_plane[elliptic][shaken], 2 * kernels->lanes, responses, settings);
    pool->add(setup, i);
  }
  for (auto& kind : pools)
    for (auto& pool : kind)
      if (pool) pool->finish();
}

}  // namespace freestand::dynamics
