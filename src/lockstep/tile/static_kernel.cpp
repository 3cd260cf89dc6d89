#include <cmath>

#include "dynamics/effects/mesh_law.hpp"
#include "lockstep/tile/static_lanes.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::lockstep {
namespace {

// A smaller pivot, relative to its diagonal, is rounding error: no stiffness constrains that
// motion.
constexpr double kNoPivot = 1e-12;
// A smaller load, relative to the largest one, is rounding error.
constexpr double kNoLoad = 1e-6;
// Fraction of the stiffness that a mesh keeps when out of contact. A planet between two gaps then
// rests between them, and its contacts close when the gaps do. The resulting force is a billionth
// of a contact force.
constexpr double kOpenMesh = 1e-9;
// Larger than any gap, m.
constexpr double kNoGap = 1.0;
// Iteration limit; contacts usually change only a few times before they match the load.
constexpr int kMaxIterations = 60;

// Starts with all meshes in contact on their front flanks, as springs on d - preload.
template <int W>
GEARPOD_INLINE void close_contacts(StaticState<W>& s) {
    const int size = static_cast<int>(s.k.size());
    for (int i = 0; i < size; ++i) {
        s.active_stiffness[i] = s.k[i];
        s.preload[i] = s.e[i];
    }
}

// Assembles K with the current contacts, and f with their preloads.
template <int W>
GEARPOD_INLINE void assemble_equations(const StaticLanes<W>& lanes, StaticState<W>& s) {
    std::copy(lanes.stiffness.begin(), lanes.stiffness.end(), s.factor.begin());
    std::copy(lanes.force.begin(), lanes.force.end(), s.right_hand.begin());
    for (int pair = 0; pair < lanes.pairs; ++pair) {
        const double* __restrict k = s.active_stiffness.data() + pair * W;
        const double* __restrict preload = s.preload.data() + pair * W;
        for (int i = lanes.first[pair]; i < lanes.first[pair + 1]; ++i) {
            const int row = lanes.motion[i];
            const double weight = lanes.weight[i];
            double* __restrict f = s.right_hand.data() + row * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                f[l] = std::fma(k[l] * preload[l], weight, f[l]);
            }
            for (int j = lanes.first[pair]; j <= i; ++j) {
                const double product = weight * lanes.weight[j];
                double* __restrict a =
                    s.factor.data() + (row * (row + 1) / 2 + lanes.motion[j]) * W;
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    a[l] = std::fma(k[l], product, a[l]);
                }
            }
        }
    }
}

// Factors K = L D L^T in place (rows of L below the diagonal). `inverse` is 1 / D, or 0 for an
// unconstrained motion.
template <int W>
GEARPOD_INLINE void factorise(int n, double* __restrict factor, double* __restrict inverse) {
    for (int i = 0; i < n; ++i) {
        double* __restrict row = factor + i * (i + 1) / 2 * W;
        alignas(64) double pivot[W], least[W];
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            pivot[l] = row[i * W + l];
            least[l] = kNoPivot * pivot[l];
        }
        for (int j = 0; j < i; ++j) {
            const double* __restrict above = factor + j * (j + 1) / 2 * W;
            alignas(64) double sum[W];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                sum[l] = row[j * W + l];
            }
            for (int k = 0; k < j; ++k) {
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    sum[l] = std::fma(-row[k * W + l], above[k * W + l], sum[l]);
                }
            }
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                row[j * W + l] = sum[l];
            }
        }
        for (int k = 0; k < i; ++k) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double scaled = row[k * W + l] * inverse[k * W + l];
                pivot[l] = std::fma(-row[k * W + l], scaled, pivot[l]);
                row[k * W + l] = scaled;
            }
        }
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            inverse[i * W + l] = pivot[l] > least[l] ? 1.0 / pivot[l] : 0.0;
        }
    }
}

template <int W>
GEARPOD_INLINE void substitute(const StaticLanes<W>& lanes, StaticState<W>& s) {
    const int n = lanes.degrees;
    const double* __restrict size = lanes.force_size.data();
    double* __restrict unsupported = s.unsupported.data();
    double* __restrict y = s.right_hand.data();
    double* __restrict q = s.q.data();
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        unsupported[l] = 0.0;
    }
    for (int i = 0; i < n; ++i) {
        const double* __restrict row = s.factor.data() + i * (i + 1) / 2 * W;
        const double* __restrict inverse = s.inverse.data() + i * W;
        for (int k = 0; k < i; ++k) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                y[i * W + l] = std::fma(-row[k * W + l], y[k * W + l], y[i * W + l]);
            }
        }
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const bool resting = std::fabs(y[i * W + l]) <= kNoLoad * size[l];
            unsupported[l] = inverse[l] != 0.0 || resting ? unsupported[l] : 1.0;
            q[i * W + l] = y[i * W + l] * inverse[l];
        }
    }
    for (int i = n - 1; i > 0; --i) {
        const double* __restrict row = s.factor.data() + i * (i + 1) / 2 * W;
        for (int k = 0; k < i; ++k) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                q[k * W + l] = std::fma(-row[k * W + l], q[i * W + l], q[k * W + l]);
            }
        }
    }
}

// Updates a pair that touches on its front flank, on its back flank, or not at all.
template <int W>
GEARPOD_INLINE void change_contact(const double* __restrict d, const StaticLanes<W>& lanes,
                                   int pair, StaticState<W>& s) {
    const double* __restrict backlash = lanes.backlash.data();
    double* __restrict contacts_changed = s.contacts_changed.data();
    const double* __restrict k = s.k.data() + pair * W;
    const double* __restrict e = s.e.data() + pair * W;
    double* __restrict active_stiffness = s.active_stiffness.data() + pair * W;
    double* __restrict preload = s.preload.data() + pair * W;
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        const double front = d[l] - e[l];
        const bool on_back = front + backlash[l] < 0.0;
        const double new_held = front > 0.0 || on_back ? k[l] : kOpenMesh * k[l];
        const double new_preload = on_back ? e[l] - backlash[l] : e[l];
        const bool same = new_held == active_stiffness[l] && new_preload == preload[l];
        contacts_changed[l] = same ? contacts_changed[l] : 1.0;
        active_stiffness[l] = new_held;
        preload[l] = new_preload;
    }
}

// Updates a pair with unilateral contact. A pair out of contact gets the smallest gap of its
// springs as preload.
template <int W>
GEARPOD_INLINE void change_teeth(const double* __restrict d, const StaticLanes<W>& lanes, int pair,
                                 StaticState<W>& s) {
    const int rows = static_cast<int>(s.k.size());
    const double* __restrict backlash = lanes.backlash.data();
    double* __restrict contacts_changed = s.contacts_changed.data();
    const double* __restrict k = s.k.data() + pair * W;
    const double* __restrict e = s.e.data() + pair * W;
    double* __restrict active_stiffness = s.active_stiffness.data() + pair * W;
    double* __restrict preload = s.preload.data() + pair * W;
    alignas(64) double sum[W], pull[W], gap[W];
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        const bool on_back = d[l] - e[l] + backlash[l] < 0.0;
        sum[l] = on_back ? k[l] : 0.0;
        pull[l] = on_back ? -k[l] * backlash[l] : 0.0;
        gap[l] = kNoGap;
    }
    for (int j = 0; j < static_cast<int>(s.tooth_k.size()) / rows; ++j) {
        const double* __restrict tooth_k = s.tooth_k.data() + j * rows + pair * W;
        const double* __restrict tooth_e = s.tooth_e.data() + j * rows + pair * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double active_k = d[l] - e[l] > tooth_e[l] ? tooth_k[l] : 0.0;
            sum[l] += active_k;
            pull[l] = std::fma(active_k, tooth_e[l], pull[l]);
            gap[l] = tooth_k[l] > 0.0 && tooth_e[l] < gap[l] ? tooth_e[l] : gap[l];
        }
    }
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        const double new_held = sum[l] > 0.0 ? sum[l] : kOpenMesh * k[l];
        const double rest = gap[l] < kNoGap ? gap[l] : 0.0;
        const double new_preload = e[l] + (sum[l] > 0.0 ? pull[l] / sum[l] : rest);
        const bool same = new_held == active_stiffness[l] && new_preload == preload[l];
        contacts_changed[l] = same ? contacts_changed[l] : 1.0;
        active_stiffness[l] = new_held;
        preload[l] = new_preload;
    }
}

// Opens and closes contacts according to the deflections; marks the lanes that changed.
template <int W>
GEARPOD_INLINE void change_contacts(const StaticLanes<W>& lanes, StaticState<W>& s) {
    double* __restrict contacts_changed = s.contacts_changed.data();
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        contacts_changed[l] = 0.0;
    }
    for (int pair = 0; pair < lanes.pairs; ++pair) {
        alignas(64) double d[W] = {};
        for (int i = lanes.first[pair]; i < lanes.first[pair + 1]; ++i) {
            const double* __restrict q = s.q.data() + lanes.motion[i] * W;
            const double weight = lanes.weight[i];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                d[l] = std::fma(weight, q[l], d[l]);
            }
        }
        if (lanes.contacts > 0) {
            change_teeth(d, lanes, pair, s);
        } else {
            change_contact(d, lanes, pair, s);
        }
    }
}

template <int W>
GEARPOD_INLINE void solve(const StaticLanes<W>& lanes, StaticState<W>& s) {
    close_contacts(s);
    for (int change = 0; change < kMaxIterations; ++change) {
        assemble_equations(lanes, s);
        factorise<W>(lanes.degrees, s.factor.data(), s.inverse.data());
        substitute(lanes, s);
        if (!lanes.separating) {
            break;
        }
        change_contacts(lanes, s);
        bool any = false;
        for (int l = 0; l < W; ++l) {
            any = any || s.contacts_changed[l] != 0.0;
        }
        if (!any) {
            break;
        }
    }
}

}  // namespace

template <int W>
void solve_static(const StaticLanes<W>& lanes, StaticState<W>& state) {
    machine::run_kernel<solve<W>>(lanes, state);
}

template void solve_static<1>(const StaticLanes<1>&, StaticState<1>&);
template void solve_static<4>(const StaticLanes<4>&, StaticState<4>&);
template void solve_static<8>(const StaticLanes<8>&, StaticState<8>&);

}  // namespace gearpod::lockstep
