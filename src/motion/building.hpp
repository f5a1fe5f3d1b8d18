// A building that stays elastic, as a shear building: each storey is a spring between the floor below and the floor above it,
// each floor a mass. Its modes.
//
// Floors are counted from the ground: 0 is the ground, i the floor that storeys 1 to i carry. With u the displacements of
// floors 1 ... n relative to the ground, under the acceleration a of the ground
//   M u'' + C u' + K u = -M 1 a,    K phi = w^2 M phi,    u = sum_m G_m phi_m q_m,    q_m'' + 2 z_m w_m q_m' + w_m^2 q_m = -a
// where G_m = phi_m^T M 1 / phi_m^T M phi_m (Chopra, Dynamics of Structures, 4th ed., sections 12.8 and 13.1). All modes are kept.
// Left out: yielding, torsion, rocking of the foundation, and vertical motion, in which the building is rigid.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace freestand::motion {

// One storey and the floor that it carries.
struct Storey {
  std::optional<double> mass_kg;        // of that floor
  std::optional<double> height_m;       // of the storey
  std::optional<double> stiffness_npm;  // of the storey, shear force over drift
};

// What an engineer knows of a building. Either stiffness and mass of every storey, or the period of the first mode: the
// stiffnesses are then equal, or such that the first mode is a straight line over the height, and scaled to that period;
// masses may then be left out, all or none, and are equal.
struct Building {
  enum class Stiffness { equal, straight_first_mode };

  std::string name;
  std::vector<Storey> storeys;     // the lowest first
  std::optional<double> period_s;  // of the first mode
  Stiffness stiffness = Stiffness::equal;
  double damping = 0.05;                                   // of critical: of every mode, or
  std::optional<std::pair<int, int>> rayleigh_modes = {};  // of these two, C = alpha M + beta K; the first is number 1

  int floors() const { return static_cast<int>(storeys.size()); }
  // Of the floor over the ground; nothing where a height below it is not given.
  std::optional<double> height_m(int floor) const;
};

struct Mode {
  double w_radps = 0, damping = 0;
  double mass_share = 0;  // effective modal mass over the mass of the building; all modes sum to 1
  std::vector<double>
      floors;  // G phi of floor 0 (always 0), 1 ... n; each floor above the ground sums to 1 over the modes

  double period_s() const;
};

// In order of falling period, one a floor. Throws Error (Exit::usage) with the reason: no storeys, masses or stiffnesses or a period
// that are not positive or do not go together, damping outside (0, 1), Rayleigh modes that are not there or damp another mode
// critically.
std::vector<Mode> modes(const Building&);

}  // namespace freestand::motion
