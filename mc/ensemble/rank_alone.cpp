// The one rank of a build without MPI.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "mc/ensemble/ranks.hpp"

namespace gearpod::mc {

namespace {

// As many as a launcher started.
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

bool Ranks::of_mpi() {
    return false;
}

bool Ranks::launched() {
    return copies() != nullptr;
}

// Copies that do not know of each other would all compute the same and write over each other.
Ranks::Ranks() {
    if (launched()) {
        throw std::runtime_error("started as one of " + std::string(copies()) +
                                 " processes, but built without MPI; start one, or build it "
                                 "with -DGEARPOD_MPI=ON");
    }
}

Ranks::~Ranks() = default;

std::vector<std::string> Ranks::gather(const std::string& text) const {
    return {text};
}

std::string Ranks::from_leader(const std::string& text) const {
    return text;
}

void Ranks::send(int, int, std::span<const std::byte>) const {
    throw std::logic_error("one rank has nobody to send to");
}

std::optional<Ranks::Message> Ranks::receive() const {
    return std::nullopt;
}

void Ranks::abort(int code) const {
    std::fflush(nullptr);
    std::_Exit(code);
}

}  // namespace gearpod::mc
