#include <algorithm>
#include <cmath>

#include "dynamics/effects/inertial_terms.hpp"
#include "dynamics/torsional_motion.hpp"
#include "dynamics/translational_motion.hpp"
#include "lockstep/march.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::lockstep {
namespace {

using dynamics::kMaxPairs;
using dynamics::kMaxPlanets;
using dynamics::PlanetaryLanes;

constexpr int kMaxDegrees = 9 + 3 * kMaxPlanets;

// Scratch of one tile; small enough to stay in the first-level cache.
template <int W>
struct alignas(64) Stages {
    double q[kMaxDegrees * W], v[kMaxDegrees * W];
    double a1[kMaxDegrees * W], a2[kMaxDegrees * W], a3[kMaxDegrees * W];
    double k[kMaxPairs * W], c[kMaxPairs * W];
    double input[3][2 * kMaxPlanets * W];  // planet accelerations at the step's nodes
};

// Stiffness and damping of all pairs at a stage node, shared values spread over the lanes.
template <int W>
GEARPOD_INLINE void load_pairs(const MarchPlan& plan, const PlanetaryLanes<W>& lanes,
                               const std::vector<PairOverride>& overrides, int step, int node,
                               Stages<W>& s) {
    const int pairs = plan.nodes.pairs;
    const double* k = plan.nodes.stiffness.data() + (step * kStageNodes + node) * pairs;
    const double* shape = plan.nodes.damping_shape.data() + (step * kStageNodes + node) * pairs;
    for (int pair = 0; pair < pairs; ++pair) {
        const double* factor = lanes.mesh_damping_factor[pair < lanes.planets ? 0 : 1];
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            s.k[pair * W + l] = k[pair];
            s.c[pair * W + l] = factor[l] * shape[pair];
        }
    }
    for (const PairOverride& o : overrides) {
        if (step < o.first_step || step >= o.last_step) {
            continue;
        }
        const double* factor = lanes.mesh_damping_factor[o.pair < lanes.planets ? 0 : 1];
        const int at = ((step - o.first_step) * kStageNodes + node) * W;
        const double* ko = o.stiffness.data() + at;
        const double* co = o.damping_shape.data() + at;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            s.k[o.pair * W + l] = ko[l];
            s.c[o.pair * W + l] = factor[l] * co[l];
        }
    }
}

// Absolute acceleration of the planets along the carrier frame's axes: PHYSICS of a turning frame,
// (x'' - 2 W y' - W^2 x, y'' + 2 W x' - W^2 y).
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void planet_accelerations(const PlanetaryLanes<W>& lanes, const double* q,
                                         const double* v, const double* a, double* __restrict out) {
    for (int n = 0; n < lanes.planets; ++n) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const auto m = Model::planet_motion(lanes, n, l, q, v, a);
            const double w = lanes.speed[l];
            out[2 * n * W + l] = std::fma(-w, std::fma(w, m.x, 2.0 * m.vy), m.ax);
            out[(2 * n + 1) * W + l] = std::fma(-w, std::fma(w, m.y, -2.0 * m.vx), m.ay);
        }
    }
}

// What the input at the step's start, middle and end adds to filter state `i`; m is one lane's
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

template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void write_sample(const MarchPlan& plan, const TileState& state, int sample,
                                 MeshRecord& record) {
    const int channels = plan.channels();
    double* out = record.acceleration.data() + sample * channels * W;
    const double* f = state.filter.data();
    for (int channel = 0; channel < channels; ++channel) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            out[channel * W + l] = f[(channel * kFilterStates + kFilterOutput) * W + l];
        }
    }
    const int degrees = Model::degrees_of_freedom(plan.layout.planets);
    const int stride = degrees == 3 + plan.layout.planets ? 1 : 3;  // between the u of two bodies
    const double* __restrict u = state.q.data() + (stride - 1) * W;
    const double carrier = plan.te_weight[0], ring = plan.te_weight[1], sun = plan.te_weight[2];
    double* __restrict te = record.te.data() + sample * W;
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        te[l] =
            std::fma(carrier, u[l], std::fma(ring, u[stride * W + l], sun * u[2 * stride * W + l]));
    }
    if (!record.motion.empty()) {
        std::copy_n(state.q.data(), degrees * W, record.motion.data() + sample * degrees * W);
    }
}

// Classical Runge-Kutta for q'' = a(q, q'): the stage positions and velocities follow from the
// stage accelerations, so only those are kept.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void runge_kutta_step(const MarchPlan& plan, const PlanetaryLanes<W>& lanes,
                                     const machine::AlignedVector& filter,
                                     const std::vector<PairOverride>& overrides, int i,
                                     TileState& state, Stages<W>& s) {
    const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
    const int size = Model::degrees_of_freedom(lanes.planets) * W;
    double* __restrict q = state.q.data();
    double* __restrict v = state.v.data();
    alignas(64) double h[W], half[W], sixth[W];
    for (int l = 0; l < W; ++l) {
        h[l] = step.length * lanes.mesh_period[l];
        half[l] = 0.5 * h[l];
        sixth[l] = h[l] / 6.0;
    }

    load_pairs(plan, lanes, overrides, i, 0, s);
    Model::accelerations(lanes, q, v, s.k, s.c, s.a1);
    planet_accelerations<Model>(lanes, q, v, s.a1, s.input[0]);
    for (int j = 0; j < size; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            s.q[j + l] = std::fma(half[l], v[j + l], q[j + l]);
            s.v[j + l] = std::fma(half[l], s.a1[j + l], v[j + l]);
        }
    }
    load_pairs(plan, lanes, overrides, i, 1, s);
    Model::accelerations(lanes, s.q, s.v, s.k, s.c, s.a2);
    planet_accelerations<Model>(lanes, s.q, s.v, s.a2, s.input[1]);
    for (int j = 0; j < size; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            s.q[j + l] = std::fma(half[l], s.v[j + l], q[j + l]);
            s.v[j + l] = std::fma(half[l], s.a2[j + l], v[j + l]);
        }
    }
    Model::accelerations(lanes, s.q, s.v, s.k, s.c, s.a3);
    planet_accelerations<Model>(lanes, s.q, s.v, s.a3, s.input[2]);
    for (int j = 0; j < 2 * lanes.planets * W; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            s.input[1][j + l] = 0.5 * (s.input[1][j + l] + s.input[2][j + l]);
        }
    }
    for (int j = 0; j < size; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double sum = s.a2[j + l] + s.a3[j + l];
            s.q[j + l] = std::fma(h[l], s.v[j + l], q[j + l]);
            s.v[j + l] = std::fma(h[l], s.a3[j + l], v[j + l]);
            // New position, and the part of the new velocity that is known before the last stage.
            q[j + l] = std::fma(h[l], std::fma(sixth[l], s.a1[j + l] + sum, v[j + l]), q[j + l]);
            v[j + l] = std::fma(sixth[l], std::fma(2.0, sum, s.a1[j + l]), v[j + l]);
        }
    }
    load_pairs(plan, lanes, overrides, i, 2, s);
    Model::accelerations(lanes, s.q, s.v, s.k, s.c, s.a1);
    planet_accelerations<Model>(lanes, s.q, s.v, s.a1, s.input[2]);
    for (int j = 0; j < size; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            v[j + l] = std::fma(sixth[l], s.a1[j + l], v[j + l]);
        }
    }
    const double* coefficients = filter.data() + step.kind * kFilterCoefficients * W;
    for (int channel = 0; channel < plan.channels(); ++channel) {
        const int at = channel * W;
        filter_channel<W>(coefficients, s.input[0] + at, s.input[1] + at, s.input[2] + at,
                          state.filter.data() + at * kFilterStates);
    }
}

template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void march(const MarchPlan& plan, const PlanetaryLanes<W>& lanes,
                          const machine::AlignedVector& filter,
                          const std::vector<PairOverride>& overrides, TileState& state,
                          MeshRecord& record) {
    Stages<W> stages;
    const int steps = static_cast<int>(plan.grid.steps.size());
    for (int i = 0; i < steps; ++i) {
        const int sample = plan.grid.steps[static_cast<std::size_t>(i)].sample;
        if (sample >= 0) {
            write_sample<Model>(plan, state, sample, record);
        }
        runge_kutta_step<Model>(plan, lanes, filter, overrides, i, state, stages);
    }
}

}  // namespace

// One kernel for each composition of effects and each width.
#define GEARPOD_MARCH(NAME, W, ...)                                                        \
    GEARPOD_KERNEL(                                                                        \
        NAME,                                                                              \
        (const MarchPlan& plan, const PlanetaryLanes<W>& lanes,                            \
         const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides, \
         TileState& state, MeshRecord& record),                                            \
        (plan, lanes, filter, overrides, state, record),                                   \
        march<__VA_ARGS__>(plan, lanes, filter, overrides, state, record))

namespace kernels {
GEARPOD_MARCH(translational_inertial_8, 8,
              dynamics::TranslationalMotion<dynamics::WithInertialTerms, 8>)
GEARPOD_MARCH(translational_inertial_1, 1,
              dynamics::TranslationalMotion<dynamics::WithInertialTerms, 1>)
GEARPOD_MARCH(translational_8, 8, dynamics::TranslationalMotion<dynamics::WithoutInertialTerms, 8>)
GEARPOD_MARCH(translational_1, 1, dynamics::TranslationalMotion<dynamics::WithoutInertialTerms, 1>)
GEARPOD_MARCH(torsional_8, 8, dynamics::TorsionalMotion<8>)
GEARPOD_MARCH(torsional_1, 1, dynamics::TorsionalMotion<1>)
}  // namespace kernels

#undef GEARPOD_MARCH

void march_mesh_1(const MarchPlan& plan, const PlanetaryLanes<1>& lanes,
                  const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides,
                  TileState& state, MeshRecord& record) {
    if (plan.layout.motion == dynamics::Motion::torsional) {
        kernels::torsional_1(plan, lanes, filter, overrides, state, record);
    } else if (plan.layout.inertial_terms) {
        kernels::translational_inertial_1(plan, lanes, filter, overrides, state, record);
    } else {
        kernels::translational_1(plan, lanes, filter, overrides, state, record);
    }
}

void march_mesh_8(const MarchPlan& plan, const PlanetaryLanes<8>& lanes,
                  const machine::AlignedVector& filter, const std::vector<PairOverride>& overrides,
                  TileState& state, MeshRecord& record) {
    if (plan.layout.motion == dynamics::Motion::torsional) {
        kernels::torsional_8(plan, lanes, filter, overrides, state, record);
    } else if (plan.layout.inertial_terms) {
        kernels::translational_inertial_8(plan, lanes, filter, overrides, state, record);
    } else {
        kernels::translational_8(plan, lanes, filter, overrides, state, record);
    }
}

}  // namespace gearpod::lockstep
