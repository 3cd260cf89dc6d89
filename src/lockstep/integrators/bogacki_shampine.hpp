// Explicit method of Bogacki and Shampine (1989), order 3, with three stages. The fourth stage, of
// the embedded method of order 2, is omitted. Because the stiffness may jump between steps, it
// cannot serve as the first stage of the next step.
#pragma once

#include "lockstep/integrators/explicit_stage.hpp"

namespace gearpod::lockstep {

struct BogackiShampine {
    static constexpr const char* kName = "bs3";
    static constexpr int kOrder = 3;
    static constexpr double kStageNodes[] = {0.0, 0.5, 0.75};
    static constexpr double kStepsInBand = 20.0;
    static constexpr StepCost kCost{0.9, 0.9, 0.9};

    template <class Complex>
    static Complex growth(Complex z) {
        return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0));
    }

    template <class System>
    static auto filter(const System& s) {
        const auto z = s.start();
        const auto k1 = s.slope(z, 0);
        const auto k2 = s.slope(z + k1 / 2.0, 1);
        const auto k3 = s.slope(z + 0.75 * k2, 2);
        return s.map(z + (2.0 * k1 + 3.0 * k2 + 4.0 * k3) / 9.0);
    }

    template <class Model>
    using Stages = ExplicitStages<Model, 3>;

    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter, const MeshOverrides& overrides, int i,
                                    State& state, Stages<Model>& s) {
        using Real = RealOf<Model>;
        const ExplicitStep<Model, State> x(plan, lanes, i, state);
        alignas(64) Real most[W], ninth[W], sixth[W];
        for (int l = 0; l < W; ++l) {
            most[l] = Real(0.75) * x.h[l];
            ninth[l] = x.h[l] / Real(9);
            sixth[l] = x.h[l] / Real(6);
        }

        // A loop makes the compiler emit the accelerations only once.
        for (int stage = 0; stage < 3; ++stage) {
            const Real* const from_q = stage == 0 ? x.q : s.q;
            const Real* const from_v = stage == 0 ? x.v : s.v;
            load_pairs<Model>(plan, lanes, overrides, i, stage, s.pairs);
            accelerate<Model>(lanes, from_q, from_v, s.pairs, s.a[stage], s.input[stage]);
            if (stage < 2) {
                move<W>(x.size, stage == 0 ? x.half : most, x.q, from_v, x.v, s.a[stage], s.q, s.v);
            }
        }
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                // The stage slopes have the weights 2/9, 3/9 and 4/9. The velocity slopes follow
                // from the first two accelerations.
                const int at = j + l;
                const Real a1 = s.a[0][at], a2 = s.a[1][at], a3 = s.a[2][at];
                const Real slope = std::fma(sixth[l], std::fma(Real(2), a2, a1), x.v[at]);
                const Real rise = std::fma(Real(2), a1, std::fma(Real(3), a2, Real(4) * a3));
                x.q[at] = advance(x.q[at], x.h[l], slope, x.q_rounding, at);
                x.v[at] = std::fma(ninth[l], rise, x.v[at]);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0], s.input[1], s.input[2]);
    }
};

}  // namespace gearpod::lockstep
