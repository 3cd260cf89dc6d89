// Plan of what is drawn for each gearbox.
#pragma once

#include <cstdint>

#include "mc/plan/gearbox_streams.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct DrawPlan {
    std::uint64_t seed = 0;
    RowOrder rows;
};

DrawPlan make_draw_plan(const Study& study);

}  // namespace gearpod::mc
