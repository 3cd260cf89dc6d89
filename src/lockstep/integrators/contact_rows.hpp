// Rows of W values for one stage node: stiffness and gaps of the springs of unilateral contact.
#pragma once

#include <algorithm>
#include <cmath>

#include "lockstep/integrators/integration_state.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::lockstep {

// Fills a row with one value for all lanes.
template <int W, class Real>
GEARPOD_INLINE void broadcast(double value, Real* __restrict row) {
    const Real rounded = static_cast<Real>(value);
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        row[l] = rounded;
    }
}

// row = values / divisor, lane by lane.
template <int W, class Real>
GEARPOD_INLINE void divide(const Real* __restrict values, const Real* __restrict divisor,
                           Real* __restrict row) {
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        row[l] = values[l] / divisor[l];
    }
}

// Converts a row of the plan's doubles to the precision of the integration.
template <int W, class Real>
GEARPOD_INLINE void round_row(const double* __restrict values, Real* __restrict row) {
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        row[l] = static_cast<Real>(values[l]);
    }
}

template <class Model>
GEARPOD_INLINE void clear_errors(typename Model::Pairs& m) {
    using Real = RealOf<Model>;
    std::fill(std::begin(m.e), std::end(m.e), Real(0));
    std::fill(std::begin(m.de), std::end(m.de), Real(0));
}

// Sets the rows that stay constant from this step until other teeth engage.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void set_constant_rows(const IntegrationPlan& plan, const MeshOverrides& overrides,
                                      int step, typename Model::Pairs& m) {
    using Real = RealOf<Model>;
    constexpr int kRows = Model::Pairs::kRows;
    const int teeth = std::max(1, plan.nodes.tooth_pairs);
    m.contacts = teeth * plan.nodes.slices;
    clear_errors<Model>(m);
    std::fill_n(m.tooth_k, m.contacts * kRows, Real(0));
    std::fill_n(m.tooth_e, m.contacts * kRows, Real(0));
    std::fill_n(m.gap, teeth * kRows, Real(0));
    std::fill_n(m.growth, teeth * kRows, Real(0));
    m.constant_from = step;
    m.constant_until = static_cast<int>(plan.grid.steps.size());
    for (const PairGaps& g : overrides.gaps) {
        if (step < g.last_step) {
            m.constant_until =
                std::min(m.constant_until, step < g.first_step ? g.first_step : g.last_step);
        }
        if (step < g.first_step || step >= g.last_step) {
            continue;
        }
        for (int j = 0; j < plan.nodes.tooth_pairs; ++j) {
            const int row = j * kRows + g.pair * W;
            round_row<W>(g.gap.data() + j * W, m.gap + row);
            round_row<W>(g.growth.data() + j * W, m.growth + row);
        }
    }
}

// Sets stiffness and gap of a spring at a position on the flank; `shared` is the gap common to all
// lanes, m.
template <int W, class Real>
GEARPOD_INLINE void load_contact(double stiffness, double position, double shared,
                                 const Real* __restrict gap, const Real* __restrict growth,
                                 Real* __restrict k, Real* __restrict e) {
    const Real pair_stiffness = static_cast<Real>(stiffness), at = static_cast<Real>(position);
    const Real all = static_cast<Real>(shared);
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        k[l] = pair_stiffness;
        e[l] = std::fma(at, growth[l], gap[l]) + all;
    }
}

// Adds wear of unit depth times its depth, [lane], to the gaps of a spring.
template <int W, class Real>
GEARPOD_INLINE void add_wear(double unit_gap, const double* __restrict depth, Real* __restrict e) {
    const Real shape = static_cast<Real>(unit_gap);
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        e[l] = std::fma(shape, static_cast<Real>(depth[l]), e[l]);
    }
}

// Loads stiffness and gaps of all pairs' springs at a stage node; call it after loading the pairs.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void load_contacts(const IntegrationPlan& plan, const MeshOverrides& overrides,
                                  int step, int node, typename Model::Pairs& m) {
    constexpr int kRows = Model::Pairs::kRows;
    const StiffnessNodes& table = plan.nodes;
    const int pairs = table.pairs, slices = table.slices, known = table.contacts();
    const int nodes = static_cast<int>(plan.grid.stage_nodes.size());
    const int first = (step * nodes + node) * known * pairs;
    const double* shared = table.tooth_stiffness.data() + first;
    const double* positions = table.tooth_position.data() + first;
    const double* gaps = table.tooth_gap.empty() ? nullptr : table.tooth_gap.data() + first;
    for (int j = 0; j < known; ++j) {
        const int tooth = j / slices * kRows;
        for (int pair = 0; pair < pairs; ++pair) {
            const int row = j * kRows + pair * W, i = j * pairs + pair;
            load_contact<W>(shared[i], positions[i], gaps == nullptr ? 0.0 : gaps[i],
                            m.gap + tooth + pair * W, m.growth + tooth + pair * W, m.tooth_k + row,
                            m.tooth_e + row);
        }
    }
    if (known == 0) {  // one spring carries the whole load
        std::copy_n(m.k, pairs * W, m.tooth_k);
    }
    if (!overrides.wear.empty()) {
        const double* worn = table.tooth_wear.data() + first;
        for (int j = 0; j < known; ++j) {
            for (int pair = 0; pair < pairs; ++pair) {
                add_wear<W>(worn[j * pairs + pair], overrides.wear.data(),
                            m.tooth_e + j * kRows + pair * W);
            }
        }
    }
    for (const PairOverride& o : overrides.faults) {
        if (step < o.first_step || step >= o.last_step || o.tooth_stiffness.empty()) {
            continue;
        }
        const int from = ((step - o.first_step) * nodes + node) * known * W;
        for (int j = 0; j < known; ++j) {
            round_row<W>(o.tooth_stiffness.data() + from + j * W,
                         m.tooth_k + j * kRows + o.pair * W);
        }
    }
}

}  // namespace gearpod::lockstep
