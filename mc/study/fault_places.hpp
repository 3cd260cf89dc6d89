// Meshes in which a fault acts.
#pragma once

#include <cstddef>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Mesh of meshes_of(kind) in which the faulty tooth acts, and its gear in that mesh, 1 or 2.
struct FaultPlace {
    std::size_t mesh;
    int gear;
};
std::vector<FaultPlace> fault_places(const Fault& fault);

}  // namespace gearpod::mc
