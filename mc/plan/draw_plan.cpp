#include "mc/plan/draw_plan.hpp"

namespace gearpod::mc {

DrawPlan make_draw_plan(const Study& study) {
    return {static_cast<std::uint64_t>(study.ensemble.seed), RowOrder(study.ensemble)};
}

}  // namespace gearpod::mc
