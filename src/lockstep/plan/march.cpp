#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

MarchPlan in_doubles(MarchPlan plan) {
    plan.precision = Precision::double_precision;
    return plan;
}

MeshRecord make_record(const MarchPlan& plan, int lanes, bool with_motion) {
    const std::size_t rows = plan.samples() * static_cast<std::size_t>(lanes);
    MeshRecord record;
    record.acceleration.resize(rows * static_cast<std::size_t>(plan.channels()));
    record.te.resize(rows);
    if (with_motion) {
        record.motion.resize(rows *
                             static_cast<std::size_t>(dynamics::degrees_of_freedom(plan.layout)));
    }
    return record;
}

}  // namespace gearpod::lockstep
