// Ranks in a build with MPI.
#include <fmt/format.h>

#include "mc/ensemble/ranks.hpp"
#define OMPI_SKIP_MPICXX 1  // only the C interface
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace gearpod::mc {
namespace {

// Polls with pauses. MPI's own waiting would keep a processor busy that other threads and rank 0
// need.
void wait_for(MPI_Request& request) {
    for (int done = 0;;) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done != 0) {
            return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

// Sends data from rank 0 to all ranks.
void broadcast(void* data, int count, MPI_Datatype type) {
    MPI_Request request;
    MPI_Ibcast(data, count, type, 0, MPI_COMM_WORLD, &request);
    wait_for(request);
}

}  // namespace

bool Ranks::built_with_mpi() {
    return true;
}

// Checks the environment variables that Open MPI's mpirun, PMIx (srun, prun) and PMI-1/2 (srun,
// mpiexec) set.
bool Ranks::launched() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}) {
        if (std::getenv(name) != nullptr) {
            return true;
        }
    }
    return false;
}

Ranks::Ranks() {
    if (!launched()) {
        return;
    }
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    started_ = true;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &on_this_machine_);
    MPI_Comm_free(&machine);
    if (provided < MPI_THREAD_FUNNELED && leads()) {
        fmt::print(stderr, "gearpod: this MPI library does not support threads\n");
        abort(2);
    }
}

Ranks::~Ranks() {
    if (started_) {
        MPI_Finalize();
    }
}

std::vector<std::string> Ranks::gather(const std::string& text) const {
    if (size_ == 1) {
        return {text};
    }
    const auto ranks = static_cast<std::size_t>(size_);
    const int length = static_cast<int>(text.size());
    std::vector<int> lengths(ranks), places(ranks);
    MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
    int total = 0;
    for (std::size_t r = 0; r < ranks; ++r) {
        places[r] = total;
        total += lengths[r];
    }
    std::string all(static_cast<std::size_t>(total), '\0');
    MPI_Allgatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), places.data(),
                   MPI_CHAR, MPI_COMM_WORLD);
    std::vector<std::string> texts;
    for (std::size_t r = 0; r < ranks; ++r) {
        texts.push_back(
            all.substr(static_cast<std::size_t>(places[r]), static_cast<std::size_t>(lengths[r])));
    }
    return texts;
}

std::string Ranks::from_leader(const std::string& text) const {
    if (size_ == 1) {
        return text;
    }
    int length = static_cast<int>(text.size());
    broadcast(&length, 1, MPI_INT);
    std::string copy = text;
    copy.resize(static_cast<std::size_t>(length));
    broadcast(copy.data(), length, MPI_CHAR);
    return copy;
}

void Ranks::send(int to, int kind, std::span<const std::byte> bytes) const {
    MPI_Request request;
    MPI_Isend(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, kind, MPI_COMM_WORLD,
              &request);
    wait_for(request);
}

std::optional<Ranks::Message> Ranks::receive() const {
    if (size_ == 1) {
        return std::nullopt;
    }
    int arrived = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
    if (arrived == 0) {
        return std::nullopt;
    }
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    Message message{status.MPI_SOURCE, status.MPI_TAG,
                    std::vector<std::byte>(static_cast<std::size_t>(count))};
    MPI_Request request;
    MPI_Irecv(message.bytes.data(), count, MPI_BYTE, message.from, message.kind, MPI_COMM_WORLD,
              &request);
    wait_for(request);
    return message;
}

void Ranks::abort(int code) const {
    std::fflush(nullptr);
    if (started_) {
        MPI_Abort(MPI_COMM_WORLD, code);
    }
    std::_Exit(code);
}

}  // namespace gearpod::mc
