// Ranks in a build with MPI.
#include <fmt/format.h>

#include "mc/ensemble/ranks.hpp"
#define OMPI_SKIP_MPICXX 1  // only the C interface
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <array>
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

// Text of the first of some ranks, in each of them, in pieces that MPI can count.
std::string broadcast(MPI_Comm ranks, std::string text) {
    const auto send = [&](void* data, std::size_t bytes) {
        MPI_Request request;
        MPI_Ibcast(data, static_cast<int>(bytes), MPI_BYTE, 0, ranks, &request);
        wait_for(request);
    };
    std::size_t length = text.size();
    send(&length, sizeof length);
    text.resize(length);
    constexpr std::size_t kPiece = std::size_t{1} << 30;
    for (std::size_t at = 0; at < length; at += kPiece) {
        send(text.data() + at, std::min(kPiece, length - at));
    }
    return text;
}

MPI_Comm first_ranks = MPI_COMM_NULL;  // the first rank of each machine

}  // namespace

bool Ranks::built_with_mpi() {
    return true;
}

std::string Ranks::library() {
    char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
    int length = 0;
    MPI_Get_library_version(text, &length);
    const std::string all(text, static_cast<std::size_t>(length));
    return all.substr(0, all.find_first_of(",\n"));
}

Ranks::Ranks() {
    // Variables of Open MPI's mpirun, PMIx (srun, prun) and PMI-1/2 (srun, mpiexec).
    const bool launched =
        std::ranges::any_of(std::array{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"},
                            [](const char* name) { return std::getenv(name) != nullptr; });
    if (!launched) {
        require_connected();
        return;
    }
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    started_ = true;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    require_connected();
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &on_this_machine_);
    int place = 0;
    MPI_Comm_rank(machine, &place);
    MPI_Comm_free(&machine);
    MPI_Comm_split(MPI_COMM_WORLD, place == 0 ? 0 : MPI_UNDEFINED, 0, &first_ranks);
    machines_ = 0;
    if (first_ranks != MPI_COMM_NULL) {
        MPI_Comm_size(first_ranks, &machines_);
        MPI_Comm_rank(first_ranks, &machine_);
    }
    if (provided < MPI_THREAD_FUNNELED && leads()) {
        fmt::print(stderr, "gearpod: this MPI library does not support threads\n");
        abort(2);
    }
}

Ranks::~Ranks() {
    if (started_) {
        if (first_ranks != MPI_COMM_NULL) {
            MPI_Comm_free(&first_ranks);
        }
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
    return size_ == 1 ? text : broadcast(MPI_COMM_WORLD, text);
}

std::string Ranks::from_leader_to_machines(std::string text) const {
    return machines_ == 1 ? text : broadcast(first_ranks, std::move(text));
}

void Ranks::send(int to, int kind, const std::string& bytes) const {
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
                    std::string(static_cast<std::size_t>(count), '\0')};
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
