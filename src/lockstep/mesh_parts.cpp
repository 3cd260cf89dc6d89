#include "lockstep/mesh_parts.hpp"

#include <algorithm>
#include <stdexcept>

namespace gearpod::lockstep {
namespace {

// Rows [first, last) of values that stand so many a step.
std::vector<double> rows(const std::vector<double>& values, std::size_t steps, int first,
                         int last) {
    const auto row = static_cast<std::ptrdiff_t>(values.size() / steps);
    return {values.begin() + first * row, values.begin() + last * row};
}

MarchPlan part_of(const MarchPlan& plan, int first, int last) {
    const std::size_t steps = plan.grid.steps.size();
    MarchPlan part;
    part.layout = plan.layout;
    part.integrator = plan.integrator;
    part.precision = plan.precision;
    part.mesh_law = plan.mesh_law;
    part.low_pass_rad_s = plan.low_pass_rad_s;
    part.te_weight = plan.te_weight;
    part.grid.samples = plan.grid.samples;
    part.grid.lengths = plan.grid.lengths;  // all of them: a step's kind is its place there
    part.grid.stage_nodes = plan.grid.stage_nodes;
    part.grid.steps.assign(plan.grid.steps.begin() + first, plan.grid.steps.begin() + last);
    part.nodes.pairs = plan.nodes.pairs;
    part.nodes.stiffness = rows(plan.nodes.stiffness, steps, first, last);
    part.nodes.damping_shape = rows(plan.nodes.damping_shape, steps, first, last);
    part.nodes.error = rows(plan.nodes.error, steps, first, last);
    part.nodes.error_rate = rows(plan.nodes.error_rate, steps, first, last);
    return part;
}

int samples_of(const PhaseGrid& grid) {
    int samples = 0;
    for (const Step& step : grid.steps) {
        samples += (step.sample >= 0 ? 1 : 0) + step.inside;
    }
    return samples;
}

}  // namespace

std::vector<MeshPart> mesh_parts(const MarchPlan& plan, int count) {
    if (count < 1) {
        throw std::invalid_argument("a mesh period has at least one part");
    }
    const auto steps = static_cast<long>(plan.grid.steps.size());
    const long parts = std::min<long>(count, steps);
    std::vector<MeshPart> all;
    int sample = 0;
    for (long i = 0; i < parts; ++i) {
        MeshPart part;
        part.first_step = static_cast<int>(steps * i / parts);
        part.last_step = static_cast<int>(steps * (i + 1) / parts);
        part.plan = part_of(plan, part.first_step, part.last_step);
        part.first_sample = sample;
        part.last_sample = sample += samples_of(part.plan.grid);
        all.push_back(std::move(part));
    }
    return all;
}

}  // namespace gearpod::lockstep
