// Explicit method of Butcher with six stages, order 5 (J. C. Butcher, On Runge-Kutta processes of
// high order, 1964).
#pragma once

#include <array>
#include <utility>

#include "lockstep/integrators/explicit_stage.hpp"

namespace gearpod::lockstep {

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
        auto at = z;
        for (int stage = 0; stage <= kStages; ++stage) {
            at = z;
            for (int from = 0; from < stage; ++from) {
                at += kTable[stage][from] * k[static_cast<std::size_t>(from)];
            }
            if (stage < kStages) {
                k[static_cast<std::size_t>(stage)] = s.slope(at, stage);
            }
        }
        return s.map(at);
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
                const int at = j + l;
                x.q[at] = advance(x.q[at], x.h[l], slope<kStages>(x, s, at, l), x.q_rounding, at);
                x.v[at] = std::fma(x.h[l], rise<kStages>(s, at), x.v[at]);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0], s.input[1], s.input[2],
                       s.input[3], s.input[4], s.input[5]);
    }

  private:
    // Weighted sum of the accelerations of the stages before `Row`. The weights of rise() are from
    // kTable, those of slope() from its square.
    template <int Row, class Stages>
    static GEARPOD_INLINE auto rise(const Stages& s, int at) {
        using Real = std::remove_cvref_t<decltype(s.q[0])>;
        Real total = Real(kTable[Row][Row - 1]) * s.a[Row - 1][at];
        for (int from = Row - 2; from >= 0; --from) {
            if (kTable[Row][from] != 0.0) {
                total = std::fma(Real(kTable[Row][from]), s.a[from][at], total);
            }
        }
        return total;
    }
    template <int Row, class Step, class Stages>
    static GEARPOD_INLINE auto slope(const Step& x, const Stages& s, int at, int l) {
        using Real = std::remove_cvref_t<decltype(s.q[0])>;
        Real total = Real(0);
        for (int from = Row - 2; from >= 0; --from) {
            if (kSquare[Row][static_cast<std::size_t>(from)] != 0.0) {
                total = std::fma(Real(kSquare[Row][static_cast<std::size_t>(from)]), s.a[from][at],
                                 total);
            }
        }
        return std::fma(x.h[l], total, Real(kSquare[Row][kStages]) * x.v[at]);
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
                const int at = j + l;
                s.q[at] = std::fma(x.h[l], slope<Stage>(x, s, at, l), x.q[at]);
                s.v[at] = std::fma(x.h[l], rise<Stage>(s, at), x.v[at]);
            }
        }
    }
};

}  // namespace gearpod::lockstep
