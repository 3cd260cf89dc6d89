// Ranks in a build without MPI: there is only one.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "mc/ensemble/ranks.hpp"

namespace gearpod::mc {

namespace {

// Number of processes that a launcher started; null if there is no launcher or only one.
const char* copies() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
        const char* count = std::getenv(name);
        if (count != nullptr && std::atoi(count) > 1) {
            return count;
        }
    }
    return nullptr;
}

}  // namespace

bool Ranks::built_with_mpi() {
    return false;
}

bool Ranks::launched() {
    return copies() != nullptr;
}

// Several processes that do not communicate would all compute the same and overwrite each other's
// output.
Ranks::Ranks() {
    if (launched()) {
        throw std::runtime_error("started as one of " + std::string(copies()) +
                                 " processes, but this program was built without MPI; start a "
                                 "single process, or rebuild it with -DGEARPOD_MPI=ON");
    }
}

Ranks::~Ranks() = default;

std::vector<std::string> Ranks::gather(const std::string& text) const {
    return {text};
}

std::string Ranks::from_leader(const std::string& text) const {
    return text;
}

std::string Ranks::from_leader_to_machines(std::string text) const {
    return text;
}

void Ranks::send(int, int, const std::string&) const {
    throw std::logic_error("a single rank cannot send messages");
}

std::optional<Ranks::Message> Ranks::receive() const {
    return std::nullopt;
}

void Ranks::abort(int code) const {
    std::fflush(nullptr);
    std::_Exit(code);
}

}  // namespace gearpod::mc
