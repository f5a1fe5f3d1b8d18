#include <map>
#include <string>

#include "law_sample.hpp"
#include "peers.hpp"

namespace freestand::bench {
namespace {

template <class Law>
PeerResponse sample(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps) {
  const std::vector<double> none(3);
  const LawBlock<Law> block(specimen, specimen.effects.empty() ? none : specimen.effects[0].parameters, 1e-9);
  double vertical = 0;
  if constexpr (Law::is_shaken) vertical = block.law.scale * std::abs(shaking.scale);
  const RecordFloor floor(shaking, block.law.push, block.law.gravity, vertical, steps.per_knot);
  return LawSample<Law>(block, floor, steps.root_s).run();
}

}  // namespace

Peer law_peer(const std::string& effect) {
  static const std::map<std::string, Peer> peers = {{"none", sample<NoLaw>},
                                                    {"floor_tilt", sample<FloorTilt>},
                                                    {"vertical_shaking", sample<VerticalShaking>},
                                                    {"directional_friction", sample<DirectionalFriction>},
                                                    {"friction_wear", sample<FrictionWear>},
                                                    {"pressure_friction", sample<PressureFriction>},
                                                    {"viscous_drag", sample<ViscousDrag>},
                                                    {"centering_spring", sample<CenteringSpring>},
                                                    {"quadratic_drag", sample<QuadraticDrag>},
                                                    {"slack_tether", sample<SlackTether>},
                                                    {"moving_contents", sample<MovingContents>}};
  if (effect == "static_friction" || effect == "impact_loss" || effect == "rate_weakening") return dopri5_peer;
  const auto peer = peers.find(effect);
  return peer == peers.end() ? nullptr : peer->second;
}

}  // namespace freestand::bench
