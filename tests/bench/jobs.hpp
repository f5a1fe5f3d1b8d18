// The standard jobs of the benchmark: specimens and floor motions drawn from a fixed seed, so that everybody measures
// the same samples. No file is read.
//
//   P1 sliding      block that only slides, constant mu_s >= mu_k
//   P2 rocking      block that only rocks, Housner's impacts
//   P3 slide-rock   both, mu_s and mu_k close to the slenderness, Housner's impacts
//   P4 Bouc-Wen     slides on an elastoplastic contact, n = 20, u_y = 0.1 in; P4s: 1e-5 in, a few samples only, because
//                   of the peers
//   P5 effects      P3 with static_friction, rate_weakening and impact_loss
//   P6, P7, P8      P1, P2 and P3 under pulses: A, B, C1, C2 and ricker in turn, of 0.2 to 2 s, instead of records
//
// The motions are 20 records of 20 s at 0.005 s: noise through the filters of Kanai & Tajimi and of Clough & Penzien
// under an envelope of build-up, plateau and decay; every second one carries a velocity pulse. A sample scales its
// record to a peak drawn relative to what moves its block, so that some samples never move and some overturn.
#pragma once

#include <freestand/floor_motion.hpp>
#include <freestand/response.hpp>
#include <freestand/simulate.hpp>
#include <freestand/specimen.hpp>
#include <string>
#include <vector>

namespace freestand::bench {

struct Job {
  std::string name;   // "P1"
  std::string title;  // "sliding"
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  std::vector<std::string> demands;   // the demands whose error counts: "slip", "rotation"
  std::size_t for_cvode, for_odeint;  // samples that are enough to time the peers: the first ones
  bool pulses = false;

  std::size_t samples() const { return specimens.size(); }
};

// The records that the jobs share, and the pulses; they must outlive the jobs. vertical_share > 0: with a vertical channel, so much of
// another record.
std::vector<FloorMotion> benchmark_records(double vertical_share = 0);
std::vector<FloorMotion> benchmark_pulses();
std::vector<Job> benchmark_jobs(const std::vector<FloorMotion>& records, const std::vector<FloorMotion>& pulses,
                                std::size_t samples);

}  // namespace freestand::bench
