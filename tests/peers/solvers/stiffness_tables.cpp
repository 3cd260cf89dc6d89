#include "stiffness_tables.hpp"

#include <algorithm>
#include <cmath>

namespace gearpod::peers {

GearboxInputs8 inputs_of_gearboxes(const mc::Scene& scene) {
    GearboxInputs8 gearboxes;
    gearboxes.faults = {&scene.gearbox().pairs(), scene.gearbox().fault().pattern(), {}};
    gearboxes.faults.curve.resize(static_cast<std::size_t>(scene.gearbox().fault().curves()));
    for (std::uint64_t i = 0; i < kGearboxes; ++i) {
        const mc::InstanceInputs instance = scene.sampler().draw({mc::Group::test, i}).inputs;
        gearboxes.instances.push_back(instance);
        gearboxes.inputs.push_back(scene.gearbox().inputs(instance));
        for (std::size_t c = 0; c < gearboxes.faults.curve.size(); ++c) {
            gearboxes.faults.curve[c].push_back(
                scene.gearbox().fault().mesh(static_cast<int>(c), instance.fault_size));
        }
    }
    return gearboxes;
}

StiffnessTables::StiffnessTables(const mc::Scene& scene, const lockstep::IntegrationPlan& plan,
                                 const GearboxInputs8& gearboxes)
    : plan_(plan) {
    const lockstep::FaultSchedule schedule(plan, gearboxes.faults);
    for (int k = 0; k < scene.gearbox().fault().pattern().length; ++k) {
        overrides_.push_back(schedule.overrides(k));
    }
    for (int l = 0; l < kGearboxes; ++l) {
        for (const int pair : {0, kPlanets}) {
            factor_[side(pair)][l] = dynamics::mesh_damping_factor(
                plan.layout, gearboxes.inputs[static_cast<std::size_t>(l)], PairId{pair});
        }
    }
    const auto& steps = plan.grid.steps;
    const std::vector<double> transitions = scene.gearbox().stiffness->transitions();
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const bool jump = std::any_of(transitions.begin(), transitions.end(), [&](double phase) {
            return std::abs(phase - steps[i].phase) < 1e-9;
        });
        if (i == 0 || jump) {
            stretches_.push_back(static_cast<int>(i));
        }
    }
    stretches_.push_back(static_cast<int>(steps.size()));
    const std::size_t cells = steps.size();
    int step = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const double phase = static_cast<double>(cell) / static_cast<double>(cells);
        while (step + 1 < static_cast<int>(cells) &&
               steps[static_cast<std::size_t>(step) + 1].phase <= phase) {
            ++step;
        }
        first_of_cell_.push_back(step);
    }
}

void StiffnessTables::at_node(int mesh, int step, int node, int gearbox, Meshes<double>& m) const {
    const double* k = plan_.nodes.stiffness.data() + row_of(step, node);
    const double* shape = plan_.nodes.damping_shape.data() + row_of(step, node);
    for (int pair = 0; pair < kPairs; ++pair) {
        m.k[pair] = k[pair];
        m.c[pair] = factor_[side(pair)][gearbox] * shape[pair];
    }
    for (const lockstep::PairOverride& o : overrides_[static_cast<std::size_t>(mesh)]) {
        if (step >= o.first_step && step < o.last_step) {
            const std::size_t at = lane_row(o, step, node) + static_cast<std::size_t>(gearbox);
            m.k[o.pair] = o.stiffness[at];
            m.c[o.pair] = factor_[side(o.pair)][gearbox] * o.damping_shape[at];
        }
    }
}

int StiffnessTables::step_at(double phase, int first, int last) const {
    const auto& steps = plan_.grid.steps;
    const auto cells = static_cast<double>(first_of_cell_.size());
    const auto cell = static_cast<std::size_t>(std::clamp(phase * cells, 0.0, cells - 1.0));
    int step = std::clamp(first_of_cell_[cell], first, last - 1);
    while (step + 1 < last && steps[static_cast<std::size_t>(step) + 1].phase <= phase) {
        ++step;
    }
    return step;
}

void StiffnessTables::at_phase(int mesh, double phase, int first, int last, int gearbox,
                               Meshes<double>& m) const {
    const int step = step_at(phase, first, last);
    const lockstep::Step& here = plan_.grid.steps[static_cast<std::size_t>(step)];
    const double part = 2.0 * std::clamp((phase - here.phase) / here.length, 0.0, 1.0);
    const int node = part < 1.0 ? 0 : 1;
    const double after = part - node;
    Meshes<double> next;
    at_node(mesh, step, node, gearbox, m);
    at_node(mesh, step, node + 1, gearbox, next);
    for (int pair = 0; pair < kPairs; ++pair) {
        m.k[pair] += after * (next.k[pair] - m.k[pair]);
        m.c[pair] += after * (next.c[pair] - m.c[pair]);
    }
}

}  // namespace gearpod::peers
