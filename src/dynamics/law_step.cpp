#include "dynamics/law_step.hpp"

namespace freestand::dynamics {

template const LawArc<1>& LawStep<1>::run();
template const LawArc<1>& LawStep<1>::accelerations();
template const LawArc<2>& LawStep<2>::run();
template const LawArc<3>& LawStep<3>::run();
template const LawArc<7>& LawStep<7>::run();
template const LawArc<8>& LawStep<8>::run();
template const LawArc<10>& LawStep<10>::run();

}  // namespace freestand::dynamics
