// Common parts of all integrators in lockstep: the stiffness of the pairs at a stage node, the
// sensor's filter, the samples, and the loop over the steps of a mesh period.
//
// A model (dynamics/*_motion.hpp) provides its lanes, sizes and accelerations for kWidth gearboxes.
// An integrator provides its workspace, Stages<Model>, and step<Model>().
#pragma once

#include <algorithm>
#include <cmath>

#include "lockstep/integrators/contact_rows.hpp"
#include "lockstep/integrators/integration_state.hpp"
#include "lockstep/integrators/sensor_filter.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::lockstep {

// Loads the static transmission error of all pairs at a stage node.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void load_errors(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                int step, int node, typename Model::Pairs& m) {
    using Real = RealOf<Model>;
    const int pairs = plan.nodes.pairs;
    if (plan.nodes.error.empty()) {
        clear_errors<Model>(m);
        return;
    }
    const int nodes = static_cast<int>(plan.grid.stage_nodes.size());
    const int first = (step * nodes + node) * pairs;
    alignas(64) Real rate[W];
    for (int pair = 0; pair < pairs; ++pair) {
        broadcast<W>(plan.nodes.error.data()[first + pair], m.e + pair * W);
        broadcast<W>(plan.nodes.error_rate.data()[first + pair], rate);
        divide<W>(rate, lanes.mesh_period, m.de + pair * W);
    }
}

// Loads the data of the mesh law for all pairs at a stage node; shared values are copied to all
// lanes. Also sets the row of the time-varying forces (forced_motion.hpp).
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void load_pairs(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                               const MeshOverrides& overrides, int step, int node,
                               typename Model::Pairs& m) {
    using Real = RealOf<Model>;
    const int pairs = plan.nodes.pairs;
    const int nodes = static_cast<int>(plan.grid.stage_nodes.size());
    const double* shared = plan.nodes.stiffness.data() + (step * nodes + node) * pairs;
    const double* shape = plan.nodes.damping_shape.data() + (step * nodes + node) * pairs;
    Real* __restrict k = m.k, * __restrict c = m.c;
    for (int pair = 0; pair < pairs; ++pair) {
        const auto& law = Model::mesh_damping(lanes, pair);
        const Real stiffness = static_cast<Real>(shared[pair]);
        const Real damping = static_cast<Real>(shape[pair]);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            k[pair * W + l] = stiffness;
            c[pair * W + l] = law.factor[l] * damping;
        }
    }
    for (const PairOverride& o : overrides.faults) {
        if (step < o.first_step || step >= o.last_step) {
            continue;
        }
        const auto& law = Model::mesh_damping(lanes, o.pair);
        const int first = ((step - o.first_step) * nodes + node) * W;
        const double* ko = o.stiffness.data() + first;
        const double* co = o.damping_shape.data() + first;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            k[o.pair * W + l] = static_cast<Real>(ko[l]);
            c[o.pair * W + l] = law.factor[l] * static_cast<Real>(co[l]);
        }
    }
    if constexpr (Model::Mesh::kHasTeeth) {
        if (step < m.constant_from || step >= m.constant_until) {
            set_constant_rows<Model>(plan, overrides, step, m);
        }
    }
    if constexpr (Model::Mesh::kHasError) {
        if (!Model::Mesh::kHasTeeth || !plan.nodes.error.empty()) {  // otherwise already cleared
            load_errors<Model>(plan, lanes, step, node, m);
        }
    }
    if constexpr (Model::Mesh::kSeparates) {
        std::copy_n(lanes.backlash, W, m.backlash);
    }
    if constexpr (Model::Mesh::kHasTeeth) {
        load_contacts<Model>(plan, overrides, step, node, m);
    }
    if constexpr (requires { m.row; }) {
        m.row = lanes.excitation_forces.row(step, node);
    }
}

// Contribution of the input at the step's nodes to a filter state. m points to the coefficients of
// this state in one lane; those of successive nodes are 4 W apart.
template <int W, class Real>
GEARPOD_INLINE Real filter_input(const Real* m, Real u) {
    return m[0] * u;
}
template <int W, class Real, class... Later>
GEARPOD_INLINE Real filter_input(const Real* m, Real u, Later... later) {
    return std::fma(m[0], u, filter_input<W>(m + 4 * W, later...));
}

// sum + m[at] p + m[at + 1] dp.
template <int W, class Real>
GEARPOD_INLINE Real filter_row(const Real* m, int index, Real p, Real dp, Real sum) {
    return std::fma(m[index * W], p, std::fma(m[(index + 1) * W], dp, sum));
}

// Advances one channel's filter `f` by one step from its inputs at the step's nodes.
template <int W, class Real, class... Inputs>
GEARPOD_INLINE void filter_channel(const Real* __restrict m, Real* __restrict f,
                                   const Inputs* __restrict... inputs) {
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        const Real x = f[l], dx = f[W + l], y = f[2 * W + l], dy = f[3 * W + l];
        const Real* lane = m + l;
        const Real* by_input = lane + kFilterInput * W;
        f[l] = filter_row<W>(lane, kFilterXX, x, dx, filter_input<W>(by_input, inputs[l]...));
        f[W + l] =
            filter_row<W>(lane, kFilterXX + 2, x, dx, filter_input<W>(by_input + W, inputs[l]...));
        f[2 * W + l] = filter_row<W>(
            lane, kFilterYX, x, dx,
            filter_row<W>(lane, kFilterYY, y, dy, filter_input<W>(by_input + 2 * W, inputs[l]...)));
        f[3 * W + l] =
            filter_row<W>(lane, kFilterYX + 2, x, dx,
                          filter_row<W>(lane, kFilterYY + 2, y, dy,
                                        filter_input<W>(by_input + 3 * W, inputs[l]...)));
    }
}

// Advances the filters of all channels by one step from the inputs at its nodes.
template <int W, class Filter, class State, class... Inputs>
GEARPOD_INLINE void step_filter(const Filter& filter, const Step& step, int channels, State& state,
                                const Inputs*... inputs) {
    const auto* coefficients = filter.data() + step.kind * kFilterCoefficients * W;
    for (int channel = 0; channel < channels; ++channel) {
        const int first = channel * W;
        filter_channel<W>(coefficients, state.filter.data() + first * kFilterStates,
                          (inputs + first)...);
    }
}

template <int W, class State>
GEARPOD_INLINE void write_sample(const IntegrationPlan& plan, const State& state, int sample,
                                 MeshRecord& record) {
    const int channels = static_cast<int>(state.filter.size()) / (kFilterStates * W);
    double* out = record.acceleration.data() + sample * channels * W;
    const auto* f = state.filter.data();
    for (int channel = 0; channel < channels; ++channel) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            out[channel * W + l] = f[(channel * kFilterStates + kFilterOutput) * W + l];
        }
    }
    const int degrees = static_cast<int>(plan.te_weight.size());
    double* __restrict te = record.te.data() + sample * W;
    std::fill_n(te, W, 0.0);
    for (int d = degrees - 1; d >= 0; --d) {
        const double weight = plan.te_weight[static_cast<std::size_t>(d)];
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            te[l] = std::fma(weight, position(state, d * W + l), te[l]);
        }
    }
    if (!record.motion.empty()) {
        double* __restrict motion = record.motion.data() + sample * degrees * W;
        for (int i = 0; i < degrees * W; ++i) {
            motion[i] = position(state, i);
        }
    }
}

// Cubic Hermite interpolation within a step: weights of the end values, and of the end rates times
// the step length. Its error is of order 4, comparable to that of a step.
struct HermiteWeights {
    double start, end, start_rate, end_rate;

    explicit HermiteWeights(double part)
        : start((1.0 + 2.0 * part) * (1.0 - part) * (1.0 - part)),
          end(part * part * (3.0 - 2.0 * part)),
          start_rate(part * (1.0 - part) * (1.0 - part)),
          end_rate(-part * part * (1.0 - part)) {}

    GEARPOD_INLINE double operator()(double x, double dx, double y, double dy, double h) const {
        const double values = std::fma(start, x, end * y);
        return std::fma(h, std::fma(start_rate, dx, end_rate * dy), values);
    }
};

// Writes the samples inside a step from state `before` to state `after`.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void write_interpolated_samples(const IntegrationPlan& plan,
                                               const typename Model::Lanes& lanes, const Step& step,
                                               const TileState& before, const TileState& after,
                                               MeshRecord& record) {
    const int channels = static_cast<int>(after.filter.size()) / (kFilterStates * W);
    const int degrees = static_cast<int>(plan.te_weight.size());
    alignas(64) double h[W], q[W];
    for (int l = 0; l < W; ++l) {
        h[l] = step.length * lanes.mesh_period[l];
    }
    for (int n = 0; n < step.inside; ++n) {
        const int sample = step.first_inside + n;
        const double phase = static_cast<double>(sample) / plan.grid.samples;
        const HermiteWeights between((phase - step.phase) / step.length);
        double* __restrict out = record.acceleration.data() + sample * channels * W;
        for (int channel = 0; channel < channels; ++channel) {
            const int output = (channel * kFilterStates + kFilterOutput) * W;
            const double* __restrict f = before.filter.data() + output;
            const double* __restrict g = after.filter.data() + output;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                out[channel * W + l] = between(f[l], f[W + l], g[l], g[W + l], h[l]);
            }
        }
        double* __restrict te = record.te.data() + sample * W;
        std::fill_n(te, W, 0.0);
        for (int d = degrees - 1; d >= 0; --d) {
            const double weight = plan.te_weight[static_cast<std::size_t>(d)];
            const double *q0 = before.q.data() + d * W, *v0 = before.v.data() + d * W;
            const double *q1 = after.q.data() + d * W, *v1 = after.v.data() + d * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                q[l] = between(q0[l], v0[l], q1[l], v1[l], h[l]);
                te[l] = std::fma(weight, q[l], te[l]);
            }
            if (!record.motion.empty()) {
                std::copy_n(q, W, record.motion.data() + (sample * degrees + d) * W);
            }
        }
    }
}

// Prefetches the plan's rows of a later step. A mesh period reads each row once, from tables larger
// than a core's cache. A prefetch beyond a table's end has no effect.
GEARPOD_INLINE void prefetch_row(const std::vector<double>& table, std::size_t first,
                                 std::size_t count) {
    constexpr std::size_t kLine = 64 / sizeof(double);
    for (std::size_t offset = 0; offset < count && !table.empty(); offset += kLine) {
        __builtin_prefetch(table.data() + first + offset);
    }
}

GEARPOD_INLINE void prefetch_step(const IntegrationPlan& plan, int step) {
    const StiffnessNodes& table = plan.nodes;
    const auto row = static_cast<std::size_t>(step);
    const std::size_t pairs = plan.grid.stage_nodes.size() * static_cast<std::size_t>(table.pairs);
    const std::size_t contacts = pairs * static_cast<std::size_t>(table.contacts());
    __builtin_prefetch(plan.grid.steps.data() + row);
    for (const auto* all :
         {&table.stiffness, &table.damping_shape, &table.error, &table.error_rate}) {
        prefetch_row(*all, row * pairs, pairs);
    }
    for (const auto* all :
         {&table.tooth_stiffness, &table.tooth_position, &table.tooth_gap, &table.tooth_wear}) {
        prefetch_row(*all, row * contacts, contacts);
    }
}

// Loop over the steps of a mesh period, or of a part of it (MeshPart). In single precision the grid
// must have a step boundary on every sample.
template <class Integrator, class Model, class State, class Filter>
GEARPOD_INLINE void integrate_steps(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter, const MeshOverrides& overrides,
                                    State& state, MeshRecord& record) {
    using Stages = typename Integrator::template Stages<Model>;
    constexpr bool kInterpolates = std::is_same_v<State, TileState>;
    Stages of_call;
    Stages* kept = &of_call;
    TileState before;
    const int steps = static_cast<int>(plan.grid.steps.size());
    int first = 0, last = steps;
    if constexpr (requires { lanes.part; }) {
        if (lanes.part.last > 0) {
            first = lanes.part.first;
            last = lanes.part.last;
            if (first == 0) {
                if (lanes.part.workspace != nullptr) {
                    lanes.part.release(lanes.part.workspace);
                }
                lanes.part.workspace = new Stages;
                lanes.part.release = [](void* workspace) {
                    delete static_cast<Stages*>(workspace);
                };
            }
            kept = static_cast<Stages*>(lanes.part.workspace);
        }
    }
    Stages& stages = *kept;
    for (int i = first; i < last; ++i) {
        const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
        prefetch_step(plan, std::min(i + 4, steps - 1));
        if (step.sample >= 0) {
            write_sample<Model::kWidth>(plan, state, step.sample, record);
        }
        if (!record.step_states.empty()) {
            write_step_state<Integrator, Model>(plan, lanes, i, state, record);
        }
        if constexpr (kInterpolates) {
            if (step.inside > 0) {
                before = state;
            }
        }
        Integrator::template step<Model>(plan, lanes, filter, overrides, i, state, stages);
        if constexpr (kInterpolates) {
            if (step.inside > 0) {
                write_interpolated_samples<Model>(plan, lanes, step, before, state, record);
            }
        }
    }
    if (last == steps && !record.step_states.empty()) {
        write_step_state<Integrator, Model>(plan, lanes, steps, state, record);
    }
}

template <class Integrator, class Model>
GEARPOD_INLINE void integrate_mesh(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                   const machine::AlignedVector& filter,
                                   const MeshOverrides& overrides, TileState& state,
                                   MeshRecord& record) {
    if constexpr (std::is_same_v<RealOf<Model>, float>) {
        const machine::AlignedArray<float> coefficients(filter.begin(), filter.end());
        SingleState single(state);
        integrate_steps<Integrator, Model>(plan, lanes, coefficients, overrides, single, record);
        single.copy_to(state);
    } else {
        integrate_steps<Integrator, Model>(plan, lanes, filter, overrides, state, record);
    }
}

}  // namespace gearpod::lockstep
