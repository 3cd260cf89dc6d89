// Tables of keys that make up the schema.
#pragma once

#include <span>

#include "mc/study/keys/key.hpp"

namespace gearpod::mc {

// Tables in the order in which their keys are shown.
std::span<const Key> gearbox_keys();  // without the following two
std::span<const Key> mesh_damping_keys();
std::span<const Key> mesh_keys();
std::span<const Key> operation_keys();
std::span<const Key> fault_keys();
std::span<const Key> run_keys();

}  // namespace gearpod::mc
