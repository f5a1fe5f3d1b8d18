// Pulses in closed form, with unit peak |acceleration| (1 m/s2) and unit period (1 s).
//
// A sample scales and stretches them: acceleration(t) = a_p * unit(t / T), so velocities go with a_p T and
// displacements with a_p T^2. One table per kind of pulse therefore serves every amplitude and period.
#pragma once

#include <freestand/floor_motion.hpp>
#include <functional>
#include <string>
#include <vector>

namespace freestand::motion {

// Floor acceleration [m/s2], velocity [m/s] and displacement [m] at one time; the floor starts from rest at 0.
struct PulseState {
  double acceleration = 0, velocity = 0, displacement = 0;
};

struct Pulse {
  std::string name;               // "A", "B", "C1", "C2" ..., "rectangular" ...
  std::string summary;            // one line
  std::string source;             // where the formula stands
  double duration = 1;            // in periods: at the end the acceleration is gone for good
  double phase_rad = 0;           // phi of the C pulses [KM05 5.5], else 0
  double velocity_amplitude = 0;  // v_p of [KM05 ch. 5] for a_p = 1, T = 1 (a_p = 2 pi v_p / T for B and C, pi v_p / T
                                  // for A); peak_velocity for pulses that are not of that family
  double peak_velocity = 0;       // true max |velocity| for a_p = 1, T = 1: (1 + sin phi) v_p for the C pulses
  double peak_displacement = 0;   // true max |displacement| for a_p = 1, T = 1
  int segments_per_period = 32;   // of the polynomial table, and its degree
  int table_degree = 7;
  std::vector<double> breaks = {};            // times [periods] of jumps and kinks, 0 and duration among them
  std::function<PulseState(double)> at = {};  // closed form, time in periods within [0, duration]
};

// The pulse of that name; "C7" and the like for any n >= 1. Upper or lower case. Throws Error that lists the known
// names.
Pulse find_pulse(const std::string& name);

// Names that find_pulse knows, with "Cn" for the family, and the other names that pulses go by ("sine" for A).
std::vector<std::string> pulse_names();

// Piecewise polynomial of degree 7 through the closed form: knots at all breaks, agreement better than 2e-13.
FloorMotion pulse_motion(const Pulse& pulse);

// Peak acceleration [m/s2] of a pulse of that period [s] whose true peak velocity, or whose v_p of [KM05 ch. 5], is
// velocity_mps. The two differ for the C pulses only.
double acceleration_of_peak_velocity(const Pulse& pulse, double velocity_mps, double period_s);
double acceleration_of_velocity_amplitude(const Pulse& pulse, double velocity_mps, double period_s);

// Phase of the pulse Cn: cos(phi) + (phi - (n + 1/2) pi) sin(phi) = 0, so that it ends without displacement [KM05 5.5].
double c_pulse_phase_rad(int n);

}  // namespace freestand::motion
