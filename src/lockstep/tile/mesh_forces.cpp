#include "lockstep/tile/mesh_forces.hpp"

#include <Eigen/Core>
#include <memory>

#include "dynamics/effects/mesh_law.hpp"
#include "lockstep/integrators/integration_steps.hpp"

namespace gearpod::lockstep {

// Members of a model that load_pairs uses.
template <int W>
template <class Law>
struct MeshForces<W>::Model {
    static constexpr int kWidth = W;
    using Lanes = MeshForces<W>::Lanes;
    using Mesh = Law;
    using Pairs = typename Law::template Pairs<dynamics::kMaxPairs, W, double>;
    static const auto& mesh_damping(const Lanes& lanes, int pair) {
        return lanes.mesh_damping[pair];
    }
};

template <int W>
MeshForces<W>::MeshForces(const IntegrationPlan& plan,
                          std::span<const dynamics::GearboxInputs> inputs)
    : plan_(plan), lanes_{} {
    for (std::size_t l = 0; l < W; ++l) {
        lanes_.mesh_period[l] = dynamics::mesh_period_s(inputs[l]);
        lanes_.backlash[l] = dynamics::backlash_m(inputs[l]);
    }
    for (PairId pair{0}; pair < plan.nodes.pairs; ++pair) {
        for (LaneId l{0}; l < W; ++l) {
            lanes_.mesh_damping[pair].factor[l] =
                dynamics::mesh_damping_factor(plan.layout, inputs[l], pair);
        }
        const Eigen::VectorXd row = dynamics::mesh_row(plan.layout, pair);
        row_.emplace_back(row.begin(), row.end());
    }
}

template <int W>
template <class Law>
void MeshForces<W>::with_law(int step, const MeshOverrides& overrides, std::span<const double> q,
                             std::span<const double> v, double* force) const {
    using Pairs = typename Model<Law>::Pairs;
    const auto pairs = std::make_unique_for_overwrite<Pairs>();
    load_pairs<Model<Law>>(plan_, lanes_, overrides, step, 0, *pairs);
    for (PairId pair{0}; pair < plan_.nodes.pairs; ++pair) {
        alignas(64) double d[W] = {}, r[W] = {};
        const std::vector<double>& row = row_[pair];
        for (std::size_t i = 0; i < row.size(); ++i) {
            for (std::size_t l = 0; l < W; ++l) {
                d[l] += row[i] * q[i * W + l];
                r[l] += row[i] * v[i * W + l];
            }
        }
        double* const pair_force = force + pair * W;
        if constexpr (Law::kHasTeeth) {
            Law::template forces<W>(*pairs, pair, d, r, pair_force);
        } else {
            for (LaneId l{0}; l < W; ++l) {
                pair_force[l] = Law::force(*pairs, pair * W + l, l, d[l], r[l]);
            }
        }
    }
}

template <int W>
void MeshForces<W>::at(int step, const MeshOverrides& overrides, std::span<const double> q,
                       std::span<const double> v, double* force) const {
    switch (plan_.mesh_law) {
#define GEARPOD_MESH_LAW(NAME, TYPE, ...) \
    case dynamics::MeshLaw::NAME:         \
        return with_law<dynamics::TYPE>(step, overrides, q, v, force);
#include "dynamics/effects/mesh_laws.def"
#undef GEARPOD_MESH_LAW
    }
}

template <int W>
void MeshForces<W>::write(const MeshOverrides& overrides, MeshRecord& record) const {
    const std::size_t steps = plan_.grid.steps.size();
    const std::size_t size = record.step_states.size() / (2 * (steps + 1));
    const std::size_t forces = static_cast<std::size_t>(plan_.nodes.pairs) * W;
    const double part = plan_.grid.stage_nodes.front();
    std::vector<double> q(size);
    record.mesh_force.resize(plan_.samples() * forces);
    for (std::size_t i = 0; i < steps; ++i) {
        const Step& step = plan_.grid.steps[i];
        if (step.sample < 0 && step.inside == 0) {
            continue;
        }
        const auto states = std::span(record.step_states).subspan(2 * i * size, 2 * size);
        const auto v = states.subspan(size);
        for (std::size_t j = 0; j < size; ++j) {
            q[j] = states[j] + part * step.length * lanes_.mesh_period[j % W] * v[j];
        }
        const auto write_sample = [&](int sample) {
            at(static_cast<int>(i), overrides, q, v,
               record.mesh_force.data() + static_cast<std::size_t>(sample) * forces);
        };
        if (step.sample >= 0) {
            write_sample(step.sample);
        }
        for (int n = 0; n < step.inside; ++n) {
            write_sample(step.first_inside + n);
        }
    }
}

template class MeshForces<1>;
template class MeshForces<4>;
template class MeshForces<8>;
template class MeshForces<16>;

}  // namespace gearpod::lockstep
