// One stage of an implicit integrator for W gearboxes in lockstep (implicit_lanes.hpp).
#pragma once

#include <cmath>

#include "dynamics/effects/inertial_terms.hpp"
#include "lockstep/implicit_lanes.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::lockstep {

// The model that implicit integrators march: matrices of any gearbox kind.
template <int W>
struct LinearMotion {
    static constexpr int kWidth = W;
    static constexpr int kMaxDegrees = ImplicitLanes<W>::kMaxDegrees;
    static constexpr int kMaxPairs = dynamics::kMaxPairs;
    static constexpr int kMaxSources = dynamics::kMaxPlanets;
    using Lanes = ImplicitLanes<W>;

    static GEARPOD_INLINE const double* mesh_damping_factor(const Lanes& p, int pair) {
        return p.mesh_damping_factor[pair];
    }

    // Absolute acceleration of the sources along the axes of the frame: [source][x, y][lane].
    static GEARPOD_INLINE void source_accelerations(const Lanes& p, const double* __restrict q,
                                                    const double* __restrict v,
                                                    const double* __restrict a,
                                                    double* __restrict out) {
        for (int n = 0; n < p.sources; ++n) {
            const int ix = p.source_degree[2 * n] * W, iy = p.source_degree[2 * n + 1] * W;
            const double x = p.source_weight[2 * n], y = p.source_weight[2 * n + 1];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double w = p.frame_speed[l];
                out[2 * n * W + l] =
                    dynamics::absolute_x(x * a[ix + l], x * q[ix + l], y * v[iy + l], w);
                out[(2 * n + 1) * W + l] =
                    dynamics::absolute_y(y * a[iy + l], y * q[iy + l], x * v[ix + l], w);
            }
        }
    }
};

// Scratch of a stage. k, c: [pair][lane] in; the rest is its own.
template <int W>
struct alignas(64) StageScratch {
    double k[dynamics::kMaxPairs * W], c[dynamics::kMaxPairs * W];
    double s[dynamics::kMaxPairs * W], force[dynamics::kMaxPairs * W];
    double matrix[dynamics::kMaxPairs * dynamics::kMaxPairs * W];
};

// y = B f - B C_0 v - B K_0 x; four rows at a time.
template <int W>
GEARPOD_INLINE void free_acceleration(const ImplicitLanes<W>& p, const double* __restrict block,
                                      const double* __restrict x, const double* __restrict v,
                                      double* __restrict y) {
    const int n = p.degrees;
    for (int i = 0; i < n; i += 4) {
        const double* __restrict constants = block + i * W;
        const double* __restrict m = block + p.products + 2 * i * n * W;
        alignas(64) double sum[4][W];
        for (int r = 0; r < 4; ++r) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                sum[r][l] = constants[r * W + l];
            }
        }
        for (int j = 0; j < n; ++j) {
            const double* __restrict e = m + 8 * j * W;
            for (int r = 0; r < 4; ++r) {
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    sum[r][l] = std::fma(e[r * W + l], v[j * W + l],
                                         std::fma(e[(4 + r) * W + l], x[j * W + l], sum[r][l]));
                }
            }
        }
        for (int r = 0; r < 4; ++r) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                y[(i + r) * W + l] = sum[r][l];
            }
        }
    }
}

// force = k R x + c R v + S R y and matrix = 1 + S G, S = a c + a^2 k.
template <int W>
GEARPOD_INLINE void mesh_system(const ImplicitLanes<W>& p, const double* __restrict block,
                                const double* __restrict a, const double* __restrict x,
                                const double* __restrict v, const double* __restrict y,
                                StageScratch<W>& t) {
    for (int pair = 0; pair < p.pairs; ++pair) {
        double* __restrict force = t.force + pair * W;
        double* __restrict s = t.s + pair * W;
        const double* __restrict k = t.k + pair * W;
        const double* __restrict c = t.c + pair * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            s[l] = a[l] * std::fma(a[l], k[l], c[l]);
            force[l] = 0.0;
        }
        for (int e = 0; e < p.row_entries[pair]; ++e) {
            const int d = p.row_degree[pair][e] * W;
            const double weight = p.row_weight[pair][e];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double sum =
                    std::fma(k[l], x[d + l], std::fma(c[l], v[d + l], s[l] * y[d + l]));
                force[l] = std::fma(weight, sum, force[l]);
            }
        }
        const double* __restrict g = block + p.capacitance + pair * p.pairs * W;
        double* __restrict row = t.matrix + pair * p.pairs * W;
        for (int other = 0; other < p.pairs; ++other) {
            const double diagonal = other == pair ? 1.0 : 0.0;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                row[other * W + l] = std::fma(s[l], g[other * W + l], diagonal);
            }
        }
    }
}

// Solves matrix * force = force in place by elimination; diagonals are kept inverted. No pivoting:
// every pivot is at least 1, since a diagonal scaling makes 1 + S G the sum of 1 and a positive
// matrix.
template <int W>
GEARPOD_INLINE void solve_meshes(int pairs, double* __restrict matrix, double* __restrict force) {
    alignas(64) double factor[W];
    for (int i = 0; i < pairs; ++i) {
        double* __restrict pivot = matrix + i * pairs * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            pivot[i * W + l] = 1.0 / pivot[i * W + l];
        }
        for (int r = i + 1; r < pairs; ++r) {
            double* __restrict row = matrix + r * pairs * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                factor[l] = -row[i * W + l] * pivot[i * W + l];
                force[r * W + l] = std::fma(factor[l], force[i * W + l], force[r * W + l]);
            }
            for (int c = i + 1; c < pairs; ++c) {
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    row[c * W + l] = std::fma(factor[l], pivot[c * W + l], row[c * W + l]);
                }
            }
        }
    }
    for (int i = pairs - 1; i >= 0; --i) {
        const double* __restrict row = matrix + i * pairs * W;
        for (int c = i + 1; c < pairs; ++c) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                force[i * W + l] = std::fma(-row[c * W + l], force[c * W + l], force[i * W + l]);
            }
        }
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            force[i * W + l] *= row[i * W + l];
        }
    }
}

// The acceleration A of a stage from x = q + a v and v; t.k and t.c hold the meshes. On return
// t.force holds the mesh forces, N. All [degree of freedom][lane], rounded up to four degrees.
template <int W>
GEARPOD_INLINE void implicit_stage(const ImplicitLanes<W>& p, const double* __restrict block,
                                   const double* __restrict a, const double* __restrict x,
                                   const double* __restrict v, double* __restrict acceleration,
                                   StageScratch<W>& t) {
    free_acceleration<W>(p, block, x, v, acceleration);
    mesh_system<W>(p, block, a, x, v, acceleration, t);
    solve_meshes<W>(p.pairs, t.matrix, t.force);
    for (int i = 0; i < p.degrees; ++i) {
        const double* __restrict z = block + p.reactions + i * p.pairs * W;
        double* __restrict sum = acceleration + i * W;
        for (int pair = 0; pair < p.pairs; ++pair) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                sum[l] = std::fma(-z[pair * W + l], t.force[pair * W + l], sum[l]);
            }
        }
    }
}

}  // namespace gearpod::lockstep
