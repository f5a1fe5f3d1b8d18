// Independent simulator of a block that only slides, on the elastoplastic contact of Bouc and Wen [KM05 6.27-6.30].
//
// It shares nothing with src/dynamics. The law as it is printed, beside the laws of contact_laws.hpp:
//   u_y z' = u' - gamma |u'| z |z|^(n-1) - beta u' |z|^n
//   M (u'' + a) = X - mu_k F g'+ z,   g'+ = max(g', 0)
// F sees the speed |u'|, the direction sgn(z), and the path of what remains of a slip, u - u_y z. mu_s plays no part.
//
// Runge-Kutta steps of order 5 (Dormand & Prince 1980) that their error alone makes short. Nothing is looked for: at a turn,
// where z or g' passes zero, where a tether comes taut the error calls for steps as short as that asks. Where z has come
// so near to the strength that 1 - (beta + gamma)|z|^n is round-off, z is held, else the equation would be stiff for no gain.
#pragma once

#include <array>
#include <vector>

#include "support/contact_laws.hpp"
#include "support/floor_line.hpp"

namespace freestand::test {

struct BoucWenRule {
  double yield_m = 0, exponent = 1, gamma = 0.5, beta = 0.5;
};

class BoucWenStepper {
 public:
  // tolerance: of one step, over u_y and the speed at which the contact rings.
  BoucWenStepper(const BoucWenRule& rule, const ContactLaws& laws, double longest_step_s, double tolerance);

  // Goes on to `end`, on a floor that is one line until then. False: its steps get no shorter.
  bool go_to(double end, const FloorLine& floor);

  double slip() const { return y_[u]; }
  double speed() const { return y_[v]; }
  double path() const { return y_[path_of_slip]; }
  double remaining() const { return y_[u] - rule_.yield_m * y_[z]; }  // of the slip, if the contact were let go
  double acceleration() const { return acceleration_; }               // horizontal, of the block
  // Since the last call of go_to().
  double felt() const { return felt_; }  // largest total acceleration, without gravity
  double furthest() const { return furthest_; }
  double share_plastic() const { return share_plastic_; }  // largest (beta + gamma)|z|^n in loading
  bool chain_broken() const { return chain_broken_; }
  struct Turn {
    double time_s, slip_m;
  };
  const std::vector<Turn>& turns() const { return turns_; }  // all of them so far

 private:
  enum : std::size_t { u, v, z, path_of_slip, contents, contents_v, size };
  using State = std::array<double, size>;

  State rates(double t, const State& y, const FloorLine& floor) const;
  double plastic(const State& y) const;  // (beta + gamma sgn(u' z))|z|^n
  void note(double t, const FloorLine& floor);

  BoucWenRule rule_;
  ContactLaws laws_;
  double longest_step_s_, tolerance_, time_ = 0, step_;
  State y_{}, scale_{};
  bool chain_broken_ = false;
  double acceleration_ = 0, felt_ = 0, furthest_ = 0, share_plastic_ = 0;
  std::vector<Turn> turns_;
};

}  // namespace freestand::test
