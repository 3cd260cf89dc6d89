// The parts of a lockstep march that all integrators share: the pairs' stiffness at a stage node,
// the sensor's filter, the samples, and the loop over the steps of a mesh period.
//
// A model (dynamics/*_motion.hpp) gives its lanes, sizes and accelerations for kWidth gearboxes; an
// integrator gives its scratch, Stages<Model>, and step<Model>().
#pragma once

#include <algorithm>
#include <cmath>

#include "lockstep/march.hpp"
#include "lockstep/sensor_filter.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::lockstep {

// One row of values, the same for all lanes.
template <int W>
GEARPOD_INLINE void spread(double value, double* __restrict row) {
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        row[l] = value;
    }
}

// row = values / divisor, lane by lane.
template <int W>
GEARPOD_INLINE void divide(const double* __restrict values, const double* __restrict divisor,
                           double* __restrict row) {
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        row[l] = values[l] / divisor[l];
    }
}

// Static transmission error of all pairs at a stage node.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void load_errors(const MarchPlan& plan, const typename Model::Lanes& lanes,
                                const std::vector<PairOverride>& overrides, int step, int node,
                                typename Model::Pairs& m) {
    const int pairs = plan.nodes.pairs;
    const int nodes = static_cast<int>(plan.grid.stage_nodes.size());
    const int at = (step * nodes + node) * pairs;
    alignas(64) double rate[W];
    for (int pair = 0; pair < pairs; ++pair) {
        const bool none = plan.nodes.error.empty();
        spread<W>(none ? 0.0 : plan.nodes.error.data()[at + pair], m.e + pair * W);
        spread<W>(none ? 0.0 : plan.nodes.error_rate.data()[at + pair], rate);
        divide<W>(rate, lanes.mesh_period, m.de + pair * W);
    }
    for (const PairOverride& o : overrides) {
        if (step < o.first_step || step >= o.last_step || o.error.empty()) {
            continue;
        }
        const int row = ((step - o.first_step) * nodes + node) * W;
        std::copy_n(o.error.data() + row, W, m.e + o.pair * W);
        divide<W>(o.error_rate.data() + row, lanes.mesh_period, m.de + o.pair * W);
    }
}

// What the mesh law needs of all pairs at a stage node, shared values spread over the lanes.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void load_pairs(const MarchPlan& plan, const typename Model::Lanes& lanes,
                               const std::vector<PairOverride>& overrides, int step, int node,
                               typename Model::Pairs& m) {
    const int pairs = plan.nodes.pairs;
    const int nodes = static_cast<int>(plan.grid.stage_nodes.size());
    const double* shared = plan.nodes.stiffness.data() + (step * nodes + node) * pairs;
    const double* shape = plan.nodes.damping_shape.data() + (step * nodes + node) * pairs;
    double* __restrict k = m.k, * __restrict c = m.c;
    for (int pair = 0; pair < pairs; ++pair) {
        const double* factor = Model::mesh_damping_factor(lanes, pair);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            k[pair * W + l] = shared[pair];
            c[pair * W + l] = factor[l] * shape[pair];
        }
    }
    for (const PairOverride& o : overrides) {
        if (step < o.first_step || step >= o.last_step || o.stiffness.empty()) {
            continue;
        }
        const double* factor = Model::mesh_damping_factor(lanes, o.pair);
        const int at = ((step - o.first_step) * nodes + node) * W;
        const double* ko = o.stiffness.data() + at;
        const double* co = o.damping_shape.data() + at;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            k[o.pair * W + l] = ko[l];
            c[o.pair * W + l] = factor[l] * co[l];
        }
    }
    if constexpr (Model::Mesh::kHasError) {
        load_errors<Model>(plan, lanes, overrides, step, node, m);
    }
    if constexpr (Model::Mesh::kSeparates) {
        std::copy_n(lanes.backlash, W, m.backlash);
    }
}

// What the input at the step's three nodes adds to filter state `i`; m is one lane's
// column of coefficients, W apart.
template <int W>
GEARPOD_INLINE double filter_input(const double* m, int i, double u0, double u1, double u2) {
    return std::fma(
        m[(kFilterInput + i) * W], u0,
        std::fma(m[(kFilterInput + 4 + i) * W], u1, m[(kFilterInput + 8 + i) * W] * u2));
}

// sum + m[at] p + m[at + 1] dp.
template <int W>
GEARPOD_INLINE double filter_row(const double* m, int at, double p, double dp, double sum) {
    return std::fma(m[at * W], p, std::fma(m[(at + 1) * W], dp, sum));
}

template <int W>
GEARPOD_INLINE void filter_channel(const double* __restrict m, const double* __restrict u0,
                                   const double* __restrict u1, const double* __restrict u2,
                                   double* __restrict f) {
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        const double x = f[l], dx = f[W + l], y = f[2 * W + l], dy = f[3 * W + l];
        const double a = u0[l], b = u1[l], c = u2[l];
        const double* lane = m + l;
        f[l] = filter_row<W>(lane, kFilterXX, x, dx, filter_input<W>(lane, 0, a, b, c));
        f[W + l] = filter_row<W>(lane, kFilterXX + 2, x, dx, filter_input<W>(lane, 1, a, b, c));
        f[2 * W + l] =
            filter_row<W>(lane, kFilterYX, x, dx,
                          filter_row<W>(lane, kFilterYY, y, dy, filter_input<W>(lane, 2, a, b, c)));
        f[3 * W + l] = filter_row<W>(
            lane, kFilterYX + 2, x, dx,
            filter_row<W>(lane, kFilterYY + 2, y, dy, filter_input<W>(lane, 3, a, b, c)));
    }
}

template <int W>
GEARPOD_INLINE void write_sample(const MarchPlan& plan, const TileState& state, int sample,
                                 MeshRecord& record) {
    const int channels = static_cast<int>(state.filter.size()) / (kFilterStates * W);
    double* out = record.acceleration.data() + sample * channels * W;
    const double* f = state.filter.data();
    for (int channel = 0; channel < channels; ++channel) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            out[channel * W + l] = f[(channel * kFilterStates + kFilterOutput) * W + l];
        }
    }
    const int degrees = static_cast<int>(plan.te_weight.size());
    const double* __restrict q = state.q.data();
    double* __restrict te = record.te.data() + sample * W;
    std::fill_n(te, W, 0.0);
    for (int d = degrees - 1; d >= 0; --d) {
        const double weight = plan.te_weight[static_cast<std::size_t>(d)];
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            te[l] = std::fma(weight, q[d * W + l], te[l]);
        }
    }
    if (!record.motion.empty()) {
        std::copy_n(q, degrees * W, record.motion.data() + sample * degrees * W);
    }
}

template <class Integrator, class Model>
GEARPOD_INLINE void march(const MarchPlan& plan, const typename Model::Lanes& lanes,
                          const machine::AlignedVector& filter,
                          const std::vector<PairOverride>& overrides, TileState& state,
                          MeshRecord& record) {
    typename Integrator::template Stages<Model> stages;
    const int steps = static_cast<int>(plan.grid.steps.size());
    for (int i = 0; i < steps; ++i) {
        const int sample = plan.grid.steps[static_cast<std::size_t>(i)].sample;
        if (sample >= 0) {
            write_sample<Model::kWidth>(plan, state, sample, record);
        }
        Integrator::template step<Model>(plan, lanes, filter, overrides, i, state, stages);
    }
}

}  // namespace gearpod::lockstep
