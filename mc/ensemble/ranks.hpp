// The processes of one run: one, or as many as mpirun or srun has started.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gearpod::mc {

// MPI is started only where a launcher is at work, so that the program runs alone without it, and
// may be missing when the program is built (ranks_of_mpi.cpp or rank_alone.cpp): then there is one
// rank, and a launcher that starts several copies is an error. All
// calls come from the thread that made the object, of which there is one in a process; failures of
// MPI end all ranks.
class Ranks {
  public:
    // Whether the program was built with MPI.
    static bool of_mpi();
    // Whether a launcher of ranks has started this process.
    static bool launched();

    Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    ~Ranks();

    int rank() const { return rank_; }
    int size() const { return size_; }
    bool leads() const { return rank_ == 0; }
    // Ranks on this machine.
    int on_this_machine() const { return on_this_machine_; }

    // Every rank's text, in all ranks. All call it together.
    std::vector<std::string> gather(const std::string& text) const;
    // Rank 0's text, in all ranks.
    std::string from_leader(const std::string& text) const;

    struct Message {
        int from = 0;
        int kind = 0;
        std::vector<std::byte> bytes;
    };
    void send(int to, int kind, std::span<const std::byte> bytes) const;
    // A message that has arrived, if any.
    std::optional<Message> receive() const;

    // Ends all ranks with this exit code, without waiting for them.
    [[noreturn]] void abort(int code) const;

  private:
    int rank_ = 0;
    int size_ = 1;
    int on_this_machine_ = 1;
    bool started_ = false;
};

// "rank 2 on node17".
std::string rank_name(const Ranks& ranks);

}  // namespace gearpod::mc
