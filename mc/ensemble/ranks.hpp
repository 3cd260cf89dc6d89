// Processes of one run: one, or as many as mpirun or srun started.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/plan/ensemble_plan.hpp"

namespace gearpod::mc {

// Access to the MPI ranks. MPI is initialized only if a launcher is present, so that the program
// also runs without it. Without MPI in the build (single_rank.cpp instead of mpi_ranks.cpp) there
// is one rank. A launcher that started more processes than are connected is an error. Each process
// has one object; all calls come from the thread that created it. MPI failures end all ranks.
class Ranks {
  public:
    // True if the program was built with MPI.
    static bool built_with_mpi();
    // Name and version of the MPI library, or "none".
    static std::string library();

    Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    ~Ranks();

    int rank() const { return rank_; }
    int size() const { return size_; }
    bool leads() const { return rank_ == 0; }
    int on_this_machine() const { return on_this_machine_; }
    // True for the lowest rank of each machine. Only these ranks have the number of machines, and
    // the number of their own machine; rank 0 is on machine 0.
    bool first_on_machine() const { return machines_ > 0; }
    int machines() const { return machines_; }
    int machine() const { return machine_; }

    // Texts of all ranks, in every rank. All ranks must call it together.
    std::vector<std::string> gather(const std::string& text) const;
    // Text of rank 0, in every rank. All ranks must call it together.
    std::string from_leader(const std::string& text) const;
    // Text of rank 0, in the first rank of every machine. All of these must call it together.
    std::string from_leader_to_machines(std::string text) const;

    struct Message {
        int from = 0;
        int kind = 0;
        std::string bytes;
    };
    void send(int to, int kind, const std::string& bytes) const;
    // Next message that has arrived, if any.
    std::optional<Message> receive() const;

    // Ends all ranks with this exit code, without waiting for them.
    [[noreturn]] void abort(int code) const;

  private:
    // Throws std::runtime_error if a launcher started more processes than size().
    void require_connected() const;

    int rank_ = 0;
    int size_ = 1;
    int on_this_machine_ = 1;
    int machines_ = 1, machine_ = 0;
    bool started_ = false;
};

// For example "rank 2 on node17".
std::string rank_name(const Ranks& ranks);

// Number of threads of one process.

// OMP_NUM_THREADS, or else the processors of this process divided by the ranks on this machine. At
// most OMP_THREAD_LIMIT.
int thread_count(int ranks_on_this_machine = 1);

// The same, unless the plan gives a number of threads.
int thread_count(const EnsemblePlan& plan, int ranks_on_this_machine = 1);

}  // namespace gearpod::mc
