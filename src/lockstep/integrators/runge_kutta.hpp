// Explicit Runge-Kutta methods: the classical one and Butcher's.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "lockstep/integrators/explicit_stage.hpp"

namespace gearpod::lockstep {

// Classical explicit Runge-Kutta method, order 4: q'' = a(q, q') with the stiffness at the step's
// start, middle and end. The same method integrates the sensor's low-pass filter together with the
// motion.
struct RungeKutta4 {
    static constexpr const char* kName = "rk4";
    static constexpr int kOrder = 4;
    static constexpr double kStageNodes[] = {0.0, 0.5, 1.0};
    static constexpr double kStepsInBand = 20.0;
    static constexpr StepCost kCost{1.0, 1.0, 1.0};

    template <class Complex>
    static Complex growth(Complex z) {
        return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)));
    }

    template <class System>
    static auto filter(const System& s) {
        const auto one = s.one();
        const auto a2 = (s.a * s.a).eval();
        const auto a3 = (a2 * s.a).eval();
        typename System::Map map;
        map.transition = one + s.a + a2 / 2.0 + a3 / 6.0 + a3 * s.a / 24.0;
        map.inputs.col(0) = s.h / 6.0 * (one + s.a + a2 / 2.0 + a3 / 4.0) * s.b;
        map.inputs.col(1) = s.h / 6.0 * (4.0 * one + 2.0 * s.a + a2 / 2.0) * s.b;
        map.inputs.col(2) = s.h / 6.0 * s.b;
        return map;
    }

    template <class Model>
    using Stages = ExplicitStages<Model, 3>;

    // The stage positions and velocities follow from the stage accelerations, so only those are
    // stored.
    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter, const MeshOverrides& overrides, int i,
                                    State& state, Stages<Model>& s) {
        using Real = RealOf<Model>;
        const ExplicitStep<Model, State> x(plan, lanes, i, state);
        alignas(64) Real sixth[W];
        for (int l = 0; l < W; ++l) {
            sixth[l] = x.h[l] / Real(6);
        }

        // A loop makes the compiler emit the accelerations only once.
        for (int stage = 0; stage < 4; ++stage) {
            if (stage != 2) {
                load_pairs<Model>(plan, lanes, overrides, i, (stage + 1) / 2, s.pairs);
            }
            const Real* const from_q = stage == 0 ? x.q : s.q;
            const Real* const from_v = stage == 0 ? x.v : s.v;
            Real* const a = s.a[stage % 3];
            accelerate<Model>(lanes, from_q, from_v, s.pairs, a, s.input[std::min(stage, 2)]);
            if (stage < 2) {
                move<W>(x.size, x.half, x.q, from_v, x.v, a, s.q, s.v);
            } else if (stage == 2) {
                advance_before_last_stage<Model>(x, sixth, s);
            }
        }
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                x.v[j + l] = std::fma(sixth[l], s.a[0][j + l], x.v[j + l]);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0], s.input[1], s.input[2]);
    }

  private:
    // Adds all but the last stage's contribution to the velocity; sets s.q and s.v to the last
    // stage's arguments.
    template <class Model, class Step, class Real, int W = Model::kWidth>
    static GEARPOD_INLINE void advance_before_last_stage(const Step& x, const Real* sixth,
                                                         Stages<Model>& s) {
        for (int j = 0; j < x.channels * W; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                s.input[1][j + l] = Real(0.5) * (s.input[1][j + l] + s.input[2][j + l]);
            }
        }
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const int index = j + l;
                const Real sum = s.a[1][index] + s.a[2][index];
                s.q[index] = std::fma(x.h[l], s.v[index], x.q[index]);
                s.v[index] = std::fma(x.h[l], s.a[2][index], x.v[index]);
                // New position, and the part of the new velocity known before the last stage.
                x.q[index] =
                    advance(x.q[index], x.h[l], std::fma(sixth[l], s.a[0][index] + sum, x.v[index]),
                            x.q_rounding, index);
                x.v[index] = std::fma(sixth[l], std::fma(Real(2), sum, s.a[0][index]), x.v[index]);
            }
        }
    }
};

// Explicit method of Butcher with six stages, order 5 (J. C. Butcher, On Runge-Kutta processes of
// high order, 1964).
struct Butcher {
    static constexpr const char* kName = "rk5";
    static constexpr int kOrder = 5;
    static constexpr double kStageNodes[] = {0.0, 0.25, 0.5, 0.75, 1.0};
    static constexpr double kStepsInBand = 12.0;
    static constexpr StepCost kCost{1.7, 1.7, 1.7};

    static constexpr int kStages = 6;
    static constexpr std::array<int, kStages> kNodeOfStage{0, 1, 1, 2, 3, 4};
    static constexpr double kTable[kStages + 1][kStages]{
        {},
        {1.0 / 4},
        {1.0 / 8, 1.0 / 8},
        {0.0, -1.0 / 2, 1.0},
        {3.0 / 16, 0.0, 0.0, 9.0 / 16},
        {-3.0 / 7, 2.0 / 7, 12.0 / 7, -12.0 / 7, 8.0 / 7},
        {7.0 / 90, 0.0, 32.0 / 90, 12.0 / 90, 32.0 / 90, 7.0 / 90}};  // the full step

    // Square of the Butcher tableau kTable. It gives the positions from the accelerations, as the
    // tableau gives the velocities, so only accelerations are stored. The last column holds the
    // node of each stage, which is the sum of the tableau's row.
    static constexpr auto kSquare = [] {
        std::array<std::array<double, kStages + 1>, kStages + 1> square{};
        for (std::size_t row = 0; row <= kStages; ++row) {
            for (std::size_t by = 0; by < kStages; ++by) {
                square[row][kStages] += kTable[row][by];
                for (std::size_t from = 0; from < kStages; ++from) {
                    square[row][from] += kTable[row][by] * kTable[by][from];
                }
            }
        }
        return square;
    }();

    template <class Complex>
    static Complex growth(Complex z) {
        return 1.0 +
               z * (1.0 +
                    z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0 + z * z * 0.0375))));
    }

    template <class System>
    static auto filter(const System& s) {
        std::array<typename System::Parts, kStages> k;
        const auto z = s.start();
        auto end = z;
        for (int stage = 0; stage <= kStages; ++stage) {
            end = z;
            for (int from = 0; from < stage; ++from) {
                end += kTable[stage][from] * k[static_cast<std::size_t>(from)];
            }
            if (stage < kStages) {
                k[static_cast<std::size_t>(stage)] = s.slope(end, stage);
            }
        }
        return s.map(end);
    }

    template <class Model>
    using Stages = ExplicitStages<Model, kStages>;

    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter, const MeshOverrides& overrides, int i,
                                    State& state, Stages<Model>& s) {
        const ExplicitStep<Model, State> x(plan, lanes, i, state);
        // A loop makes the compiler emit the accelerations only once.
        for (int stage = 0; stage < kStages; ++stage) {
            const bool first = stage == 0;
            if (first || kNodeOfStage[stage] != kNodeOfStage[stage - 1]) {
                load_pairs<Model>(plan, lanes, overrides, i, kNodeOfStage[stage], s.pairs);
            }
            accelerate<Model>(lanes, first ? x.q : s.q, first ? x.v : s.v, s.pairs, s.a[stage],
                              s.input[stage]);
            move_to<Model>(stage + 1, x, s, std::make_integer_sequence<int, kStages - 1>());
        }
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const int index = j + l;
                x.q[index] = advance(x.q[index], x.h[l], slope<kStages>(x, s, index, l),
                                     x.q_rounding, index);
                x.v[index] = std::fma(x.h[l], rise<kStages>(s, index), x.v[index]);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0], s.input[1], s.input[2],
                       s.input[3], s.input[4], s.input[5]);
    }

  private:
    // Weighted sum of the accelerations of the stages before `Row`. The weights of rise() are from
    // kTable, those of slope() from its square.
    template <int Row, class Stages>
    static GEARPOD_INLINE auto rise(const Stages& s, int index) {
        using Real = std::remove_cvref_t<decltype(s.q[0])>;
        Real total = Real(kTable[Row][Row - 1]) * s.a[Row - 1][index];
        for (int from = Row - 2; from >= 0; --from) {
            if (kTable[Row][from] != 0.0) {
                total = std::fma(Real(kTable[Row][from]), s.a[from][index], total);
            }
        }
        return total;
    }
    template <int Row, class Step, class Stages>
    static GEARPOD_INLINE auto slope(const Step& x, const Stages& s, int index, int l) {
        using Real = std::remove_cvref_t<decltype(s.q[0])>;
        Real total = Real(0);
        for (int from = Row - 2; from >= 0; --from) {
            if (kSquare[Row][static_cast<std::size_t>(from)] != 0.0) {
                total = std::fma(Real(kSquare[Row][static_cast<std::size_t>(from)]),
                                 s.a[from][index], total);
            }
        }
        return std::fma(x.h[l], total, Real(kSquare[Row][kStages]) * x.v[index]);
    }

    // Sets s.q and s.v to the arguments of a stage after the first.
    template <class Model, class Step, int... Before>
    static GEARPOD_INLINE void move_to(int stage, const Step& x, Stages<Model>& s,
                                       std::integer_sequence<int, Before...>) {
        (void)((stage == Before + 1 && (place<Before + 1, Model>(x, s), true)) || ...);
    }

    template <int Stage, class Model, class Step, int W = Model::kWidth>
    static GEARPOD_INLINE void place(const Step& x, Stages<Model>& s) {
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const int index = j + l;
                s.q[index] = std::fma(x.h[l], slope<Stage>(x, s, index, l), x.q[index]);
                s.v[index] = std::fma(x.h[l], rise<Stage>(s, index), x.v[index]);
            }
        }
    }
};

}  // namespace gearpod::lockstep
