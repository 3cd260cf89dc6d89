// Forces of a time-varying excitation on W gearboxes. Each is a pattern over the degrees of
// freedom, constant for a tile, times a value at every stage node of a mesh period
// (excitation_rows.hpp).
#pragma once

#include <cmath>
#include <span>

#include "lockstep/excitation/row_layout.hpp"
#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::lockstep {

template <int W>
struct ExcitationForces {
    // torque, gravity along x and y, angular acceleration, shafts
    static constexpr int kMaxColumns = 4 + kMostShafts;
    static constexpr int kMaxEntries = 4 * (9 + 3 * dynamics::kMaxPlanets) + kMostShafts;

    int columns = 0;
    int first[kMaxColumns + 1] = {};  // entries of column c: first[c] <= e < first[c + 1]
    int degree[kMaxEntries] = {};
    alignas(64) double pattern[kMaxEntries][W] = {};

    // Rows of values, [distinct stage node][value][lane]. A node shared by two steps has one row.
    const double* rows = nullptr;
    int nodes_per_step = 0, values = 0;

    GEARPOD_INLINE const double* row(int step, int node) const {
        return rows + (step * nodes_per_step + node) * values * W;
    }
    GEARPOD_INLINE const double* speed_value(const double* row, SpeedValue value) const {
        return row + (columns + value) * W;
    }

    // sums[degree of freedom][lane] += sum over the columns of pattern times value.
    GEARPOD_INLINE void add(const double* row, double* __restrict sums) const {
        for (int c = 0; c < columns; ++c) {
            const double* __restrict value = row + c * W;
            for (int e = first[c]; e < first[c + 1]; ++e) {
                const double* __restrict part = pattern[e];
                double* __restrict sum = sums + degree[e] * W;
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    sum[l] = std::fma(part[l], value[l], sum[l]);
                }
            }
        }
    }
};

// Computes the patterns in N, or in m/s^2 if `over_mass`. Leaves `rows` null. `inputs` holds W
// gearboxes.
template <int W>
ExcitationForces<W> make_excitation_forces(const IntegrationPlan& plan,
                                           const Excitation& excitation,
                                           std::span<const dynamics::GearboxInputs> inputs,
                                           bool over_mass);

}  // namespace gearpod::lockstep
