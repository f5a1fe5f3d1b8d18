#include "dynamics/law_step.hpp"

namespace freestand::dynamics {

template class LawStep<1>;
template class LawStep<2>;
template class LawStep<3>;
template class LawStep<7>;
template class LawStep<8>;
template class LawStep<10>;

}  // namespace freestand::dynamics
