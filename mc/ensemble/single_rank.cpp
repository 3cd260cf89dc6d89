// Ranks in a build without MPI: there is only one.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "mc/ensemble/ranks.hpp"

namespace gearpod::mc {

bool Ranks::built_with_mpi() {
    return false;
}

std::string Ranks::library() {
    return "none";
}

// Several processes that do not communicate would all compute the same and overwrite each other's
// output.
Ranks::Ranks() {
    require_connected();
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
