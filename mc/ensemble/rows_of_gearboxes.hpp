// Result rows of single gearboxes, outside of an ensemble run.
#pragma once

#include <span>

#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/results/batch_rows.hpp"

namespace gearpod::mc {

// Rows of the given gearboxes, in their order, one record each, computed on the threads of this
// process. They have the bits of a run with these numerics.
BatchRows rows_of_gearboxes(const Scene& scene, std::span<const GearboxId> gearboxes);

}  // namespace gearpod::mc
