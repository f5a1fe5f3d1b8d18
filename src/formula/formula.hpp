// A law written in a study file: parsed once, put on the tape of each sample. The effect that needs no compiler.
//
//   friction: "mu*(1 + a*sin(2*pi*u/l))"       the friction coefficient
//   force:    "-k*u - c*v"                     horizontal force per mass through the centre of mass [m/s2]
//
// Variables: u v theta omega t path normal side sigma speed rest (dynamics/tape.hpp says what they are and in which units),
// mu (kinetic coefficient), g, pi, and the parameters of the effect, with or without their unit suffix.
// Operators: + - * / ^ and comparisons < > (1 or 0).  Functions: exp log sqrt sin cos tanh abs min max step if.
// step(x), and if(x, yes, no), ask whether x > 0. A law may leap, but not against the speed, nor where the block tips (study/leaping_laws.cpp).
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/effect.hpp"

namespace freestand::formula {

// What is wrong in a formula, and where: position counts characters from 0.
class FormulaError : public std::runtime_error {
 public:
  FormulaError(const std::string& problem, std::size_t position) : std::runtime_error(problem), position_(position) {}
  std::size_t position() const { return position_; }

 private:
  std::size_t position_;
};

// u v theta omega t path normal side sigma speed rest
using Inputs = std::array<double, 11>;

class Formula {
 public:
  // Throws FormulaError. parameters: names of the effect's parameters, e.g. a, l_m.
  Formula(const std::string& text, const std::vector<std::string>& parameters);

  dynamics::Value record(const dynamics::At& at, const std::vector<double>& parameters) const;

  // The number it gives.
  double value(const Inputs& inputs, double mu, const std::vector<double>& parameters) const;
  bool uses(std::size_t parameter) const;
  bool looks_at(const std::string& variable) const;
  // Does a condition, or what else has a kink (abs, min, max), look at sigma together with something that changes while the block is stuck?
  // It turns at another time for a slip to the left than for one to the right.
  bool turns_by_direction() const;

 private:
  struct Operation {
    int kind;
    double number;
    std::vector<int> operands;
  };
  friend struct Recorder;
  bool looks_at(int known) const;
  std::vector<Operation> operations_;
  int result_ = 0;
};

// A name that every formula knows.
bool is_variable(const std::string& name);

// The effect of one entry of a study: friction, force, or both (empty: without).
dynamics::Effect effect(const std::string& name, const std::string& friction, const std::string& force,
                        const std::vector<std::string>& parameters);

}  // namespace freestand::formula
