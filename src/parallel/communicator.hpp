// The ranks of a run. The only folder that sees MPI; started without mpirun there is one rank.
#pragma once

#include <cstdint>
#include <freestand/error.hpp>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace freestand::parallel {

using Words = std::vector<std::int64_t>;

// All ranks of the run, as a small value. Calls marked "collective" must be made by every rank, in the same order;
// while they wait they leave the core to others.
class Communicator {
 public:
  Communicator() = default;  // one rank, no MPI

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }

  void barrier() const;  // collective

  // The root's value on every rank. Collective.
  std::string broadcast(std::string value) const;
  Words broadcast(Words value) const;
  std::vector<double> broadcast(std::vector<double> value) const;

  // Every rank's words, in rank order, on the root; empty on the others. Collective.
  std::vector<Words> gather(const Words& mine) const;

  // Sums by position, exact, on every rank. The lengths must agree. Collective.
  void sum_in_place(Words& values) const;

  // Is it true on any rank? Collective.
  bool any(bool value) const;

  // Merges one object of every rank into one, on the root; empty on the others. The objects travel as words;
  // merge(into, from) adds `from`, of higher ranks, to `into`, of lower ones. A binomial tree: a rank holds its own
  // object and one message at a time. For results that do not depend on the number of ranks, merging must be
  // associative and exact (integers, ExactSum). Collective.
  using Merge = std::function<void(Words& into, const Words& from)>;
  Words merge(Words mine, const Merge& merge) const;

  // Runs `work` on the root alone. What it throws is thrown on every rank, as an Error that the ranks share.
  // Collective.
  void on_root(const std::function<void()>& work) const;

 private:
  friend class Session;
  Communicator(int rank, int size) : rank_(rank), size_(size) {}
  int rank_ = 0, size_ = 1;
};

// An Error that every rank has thrown, at the same point: it can be told once, and all ranks can leave in order.
class SharedError : public Error {
 public:
  using Error::Error;
};

// MPI from here to the end of the object's life, where a launcher (mpirun, srun) started the program; without one there
// is one rank and MPI stays untouched. One per program, made in main. SIGXFSZ is ignored from here on, so that a file
// size limit shows as a failed write. Throws Error (Exit::usage) if MPI does not start, or if the launcher started
// several processes that MPI does not bring together: each would do the whole work, into the same files.
class Session {
 public:
  Session(int* argc, char*** argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Communicator world() const { return world_; }

 private:
  void start(int* argc, char*** argv);
  Communicator world_;
};

// For main, when an exception ends the run: tells `text` once on stderr and ends all ranks with this exit code. Returns
// the code where main can return it (one rank, or an error that all ranks share); otherwise it does not return: an
// error that several ranks meet by themselves is told by the lowest of them, the others are ended before they speak.
int end_run(const Communicator&, const Error&);
int end_run(const Communicator&, const std::string& text, int exit_code, bool shared = false);

}  // namespace freestand::parallel
