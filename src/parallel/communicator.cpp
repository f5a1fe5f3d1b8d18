#include "parallel/communicator.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>

#include "base/shown_text.hpp"
#include "parallel/progress.hpp"
#include "parallel/requests.hpp"
#include "parallel/stop.hpp"

namespace freestand::parallel {
namespace {

template <class Container>
Container broadcast_any(Container value, MPI_Datatype type, int size) {
  if (size == 1) return value;
  std::uint64_t length = value.size();
  wait([&](MPI_Request* request) { return MPI_Ibcast(&length, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD, request); });
  value.resize(length);
  in_parts(length, [&](std::size_t first, int count) {
    wait([&](MPI_Request* request) {
      return MPI_Ibcast(value.data() + first, count, type, 0, MPI_COMM_WORLD, request);
    });
  });
  return value;
}

constexpr int message_tag = 1;

// Set by mpirun (Open MPI, MPICH, Intel) and by Slurm's srun.
bool has_launcher() {
  for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "MPI_LOCALRANKID"})
    if (std::getenv(variable)) return true;
  return false;
}

// As the launcher says; 0 where there is none.
int launched_processes() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* text = std::getenv(variable)) return std::atoi(text);
  return 0;
}

void send_words(const Words& words, int to) {
  const std::uint64_t length = words.size();
  wait([&](MPI_Request* request) {
    return MPI_Isend(&length, 1, MPI_UINT64_T, to, message_tag, MPI_COMM_WORLD, request);
  });
  in_parts(length, [&](std::size_t first, int count) {
    wait([&](MPI_Request* request) {
      return MPI_Isend(words.data() + first, count, MPI_INT64_T, to, message_tag, MPI_COMM_WORLD, request);
    });
  });
}

Words receive_words(int from) {
  std::uint64_t length = 0;
  wait([&](MPI_Request* request) {
    return MPI_Irecv(&length, 1, MPI_UINT64_T, from, message_tag, MPI_COMM_WORLD, request);
  });
  Words words(length);
  in_parts(length, [&](std::size_t first, int count) {
    wait([&](MPI_Request* request) {
      return MPI_Irecv(words.data() + first, count, MPI_INT64_T, from, message_tag, MPI_COMM_WORLD, request);
    });
  });
  return words;
}

}  // namespace

void Communicator::barrier() const {
  if (size_ > 1) wait([](MPI_Request* request) { return MPI_Ibarrier(MPI_COMM_WORLD, request); });
}

std::string Communicator::broadcast(std::string value) const {
  return broadcast_any(std::move(value), MPI_CHAR, size_);
}
Words Communicator::broadcast(Words value) const { return broadcast_any(std::move(value), MPI_INT64_T, size_); }
std::vector<double> Communicator::broadcast(std::vector<double> value) const {
  return broadcast_any(std::move(value), MPI_DOUBLE, size_);
}

std::vector<Words> Communicator::gather(const Words& mine) const {
  if (!is_root()) {
    send_words(mine, 0);
    return {};
  }
  std::vector<Words> all{mine};
  for (int from = 1; from < size_; ++from) all.push_back(receive_words(from));
  return all;
}

void Communicator::sum_in_place(Words& values) const {
  if (size_ == 1) return;
  in_parts(values.size(), [&](std::size_t first, int count) {
    wait([&](MPI_Request* request) {
      return MPI_Iallreduce(MPI_IN_PLACE, values.data() + first, count, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD, request);
    });
  });
}

bool Communicator::any(bool value) const {
  Words flag{value ? 1 : 0};
  sum_in_place(flag);
  return flag[0] != 0;
}

Words Communicator::merge(Words mine, const Merge& merge) const {
  for (int step = 1; step < size_; step *= 2) {
    if (rank_ & step) {
      send_words(mine, rank_ - step);
      return {};
    }
    if (rank_ + step < size_) merge(mine, receive_words(rank_ + step));
  }
  return mine;
}

void Communicator::on_root(const std::function<void()>& work) const {
  std::string text;
  Words exit_code{-1};
  if (is_root()) {
    try {
      work();
    } catch (const Error& error) {
      text = error.what();
      exit_code[0] = static_cast<int>(error.exit());
    }
  }
  exit_code = broadcast(std::move(exit_code));
  if (exit_code[0] >= 0) throw SharedError(broadcast(std::move(text)), static_cast<Exit>(exit_code[0]));
}

Session::Session(int* argc, char*** argv) {
  std::signal(SIGXFSZ, SIG_IGN);
  if (has_launcher()) start(argc, argv);
  const int processes = launched_processes();
  if (processes > 1 && world_.size() == 1)
    throw Error(
        fmt::format("{} processes were started, each alone (the launcher does not fit this MPI): use mpirun, or "
                    "srun --mpi=pmix (`srun --mpi=list` shows what there is)",
                    processes));
}

void Session::start(int* argc, char*** argv) {
  int provided = 0;
  if (MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
    throw Error("MPI does not start (MPI_Init failed): check the MPI installation, or run without mpirun");
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  world_ = Communicator(rank, size);
}

Session::~Session() {
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  if (initialized && !finalized) MPI_Finalize();
}

int end_run(const Communicator& world, const Error& error) {
  return end_run(world, error.what(), static_cast<int>(error.exit()), dynamic_cast<const SharedError*>(&error));
}

int end_run(const Communicator& world, const std::string& text, int exit_code, bool shared) {
  const std::string shown = printable(text, Lines::keep) + "\n";
  // Where a disk is full HDF5 cannot close a file that the ranks share, and breaks when MPI ends: so MPI is not ended.
  if (world.size() == 1 || (shared && exit_code != static_cast<int>(Exit::cure))) {
    if (world.is_root()) tell(shown);
    return exit_code;
  }
  // The lowest rank that failed speaks; it ends the others while they wait for their turn.
  // An abort takes a while to reach them: on a busy machine more than a third of a second.
  const auto turn = std::chrono::milliseconds(world.is_root() ? 0 : std::min(1500 + 20 * world.rank(), 4000));
  const auto start = std::chrono::steady_clock::now();
  const bool stopped_before = stop_requested();
  while (std::chrono::steady_clock::now() - start < turn) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (!stopped_before && stop_requested()) _exit(exit_code);
  }
  tell(shown);
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  _exit(exit_code);
}

}  // namespace freestand::parallel
