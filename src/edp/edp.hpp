// Engineering demand parameters: ONE FILE PER PARAMETER in this folder. A file declares its parameter once:
//
//   const Register here{{.name = "peak_slip_m", .unit = "m", ..., .value = [](const Input& in) { ... }}};
//
// and from that come the study's names, the columns of samples.h5, the surfaces and the labels of the pictures.
#pragma once

#include <freestand/response.hpp>
#include <freestand/specimen.hpp>
#include <string>
#include <vector>

namespace freestand::edp {

// What a demand parameter may look at.
struct Input {
  const Response& response;
  const Specimen& specimen;
  double pta_mps2;               // peak of the floor's horizontal acceleration
  double pulse_frequency_radps;  // w_p of the motion's pulse; nan where it has none
};

// What a study must have for the parameter to say anything: elsewhere it is nan (sides, height, forces), or 0 for every sample.
enum class Wants { nothing, sides, wall, chain, height, forces, chain_force, contents, legs };

struct Edp {
  std::string name;     // as in the study file, with unit suffix where it has one
  std::string unit;     // "1" for pure numbers
  std::string symbol;   // as on an axis
  std::string summary;  // one line
  std::string source;
  bool binary = false;           // 0 or 1: its mean is a probability, it takes no capacities
  bool censored = true;          // without meaning once the block has overturned
  Wants wants = Wants::nothing;  // sides: Settings::slip_by_side; height: acceleration_height_m; forces:
                                 // contact_forces, and chain_force: with a chain, contents: with moving_contents, legs: with flexible_legs
  bool by_default = true;        // among those that a study takes which names none
  double still =
      0;  // at or below it (0.1 mm, a thousandth of alpha ...) the block stood still, as far as anyone can tell
  std::vector<double> default_capacities = {};  // where the study names none
  double (*value)(const Input&) = nullptr;
};

// All parameters, sorted by name.
const std::vector<Edp>& all();

// The parameter of that name, or throws Error that lists the names there are.
const Edp& find(const std::string& name);

// Puts a parameter into the registry; used once in each parameter's file.
struct Register {
  explicit Register(Edp edp);
};

}  // namespace freestand::edp
