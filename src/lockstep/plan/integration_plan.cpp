#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

IntegrationPlan in_double_precision(IntegrationPlan plan) {
    plan.precision = Precision::double_precision;
    return plan;
}

MeshRecord make_record(const IntegrationPlan& plan, int lanes, bool with_motion) {
    const std::size_t rows = plan.samples() * static_cast<std::size_t>(lanes);
    MeshRecord record;
    record.acceleration.resize(rows * static_cast<std::size_t>(plan.channels()));
    record.te.resize(rows);
    if (with_motion) {
        record.motion.resize(rows *
                             static_cast<std::size_t>(dynamics::degrees_of_freedom(plan.layout)));
        record.mesh_force.resize(rows * static_cast<std::size_t>(plan.nodes.pairs));
    }
    return record;
}

void size_step_states(const IntegrationPlan& plan, int lanes, MeshRecord& record) {
    record.step_states.resize(2 * (plan.grid.steps.size() + 1) *
                              static_cast<std::size_t>(dynamics::degrees_of_freedom(plan.layout)) *
                              static_cast<std::size_t>(lanes));
}

}  // namespace gearpod::lockstep
