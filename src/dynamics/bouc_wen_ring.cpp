#include "dynamics/bouc_wen_ring.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace freestand::dynamics {
namespace {

constexpr double round_off = 1e-17;

// sum_{j >= first} x^j/(j n + base)
double sum_over(double x, double n, double base, int first) {
  double sum = 0, power = first == 0 ? 1 : x;
  for (int j = first; j < 400; ++j, power *= x) {
    const double term = power / (j * n + base);
    sum += term;
    if (std::abs(term) < round_off) break;
  }
  return sum;
}

constexpr int order = 8;
using Powers = std::array<double, order + 1>;  // coefficients of a power series in q

Powers product(const Powers& a, const Powers& b) {
  Powers c{};
  for (int i = 0; i <= order; ++i)
    for (int j = 0; i + j <= order; ++j) c[i + j] += a[i] * b[j];
  return c;
}

// exp(factor * l), l[0] = 0.
Powers exponential(double factor, const Powers& l) {
  Powers e{};
  e[0] = 1;
  for (int k = 1; k <= order; ++k) {
    for (int j = 1; j <= k; ++j) e[k] += j * l[j] * e[k - j];
    e[k] *= factor / k;
  }
  return e;
}

// ln of sum_j q^j 2/(j n + 2).
Powers log_energy(double n) {
  Powers a{}, b{};
  for (int j = 0; j <= order; ++j) a[j] = 2 / (j * n + 2);
  for (int k = 1; k <= order; ++k) {
    double sum = k * a[k];
    for (int j = 1; j < k; ++j) sum -= j * b[j] * a[k - j];
    b[k] = sum / k;
  }
  return b;
}

// ln(m'/m) = l(q):  2 l(q) = B(kappa q) - B(q e^(n l)),  B = log_energy. Each pass makes one more coefficient right.
Powers log_decay(const BoucWenContact& contact) {
  const Powers b = log_energy(contact.n);
  Powers l{};
  for (int pass = 1; pass <= order; ++pass) {
    const Powers growth = exponential(contact.n, l);
    Powers next{}, power = growth;
    for (int j = 1; j <= pass; ++j) {
      for (int i = 0; i + j <= order; ++i) next[i + j] -= 0.5 * b[j] * power[i];
      power = product(power, growth);
    }
    double unload = 1;
    for (int j = 1; j <= order; ++j) next[j] += 0.5 * b[j] * (unload *= contact.kappa);
    l = next;
  }
  return l;
}

// Coefficients of S over y m.
Powers sum_of_swings(const BoucWenContact& contact) {
  const Powers l = log_decay(contact);
  std::array<Powers, order + 1> later;  // m' q'^j = m q^j later[j]
  for (int j = 0; j <= order; ++j) later[j] = exponential(1 + j * contact.n, l);

  Powers one{};
  double unload = 1;
  for (int j = 1; j <= order; ++j) {
    const double over = 1 / (j * contact.n + 1);
    unload *= contact.kappa;
    one[j] += unload * over;
    for (int i = 0; i + j <= order; ++i) one[i + j] += over * later[j][i];
  }
  Powers all{};
  for (int j = 1; j <= order; ++j) {
    double rest = one[j];
    for (int i = 1; i < j; ++i) rest -= all[i] * later[i][j - i];
    all[j] = 0.5 * rest;
  }
  return all;
}

double value(const Powers& series, double q) {
  double sum = 0;
  for (int j = order; j >= 0; --j) sum = sum * q + series[j];
  return sum;
}

constexpr double small_q = 0.06;  // below, the series are good to 1e-11

}  // namespace

bool can_ring_out(const BoucWenContact& contact, double q) { return q * std::max(1.0, -contact.kappa) <= 0.75; }

Swing next_swing(const BoucWenContact& contact, double turn) {
  const double n = contact.n, q = contact.q(turn);
  const double energy = turn * turn * sum_over(contact.kappa * q, n, 2, 0);
  double next = std::sqrt(2 * energy / (1 + 2 * q / (n + 2)));
  for (int i = 0; i < 50; ++i) {
    const double q1 = contact.q(next);
    const double step = (next * next * sum_over(q1, n, 2, 0) - energy) * (1 - q1) / next;
    next -= step;
    if (std::abs(step) <= 4e-16 * next) break;
  }
  const double returning = turn * sum_over(contact.kappa * q, n, 1, 1);
  const double loading = next * sum_over(contact.q(next), n, 1, 1);
  return {next, returning + loading};
}

RingOut ring_out(const BoucWenContact& contact, double turn) {
  RingOut out;
  double sign = 1;
  for (int swing = 0; turn > 0; ++swing, sign = -sign) {
    const double q = contact.q(turn);
    if (swing >= 2 && q * std::max(1.0, -contact.kappa) <= small_q) {
      out.slip_m += sign * turn * value(sum_of_swings(contact), q);
      break;
    }
    const Swing half = next_swing(contact, turn);
    out.slip_m += sign * half.slip;
    turn = half.turn;
    if (swing == 0) out.reach_m = out.slip_m + turn;
    if (swing == 1) out.second_reach_m = -out.slip_m + turn;
  }
  for (double* length : {&out.slip_m, &out.reach_m, &out.second_reach_m}) *length *= contact.yield;
  return out;
}

}  // namespace freestand::dynamics
