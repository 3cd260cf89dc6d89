// One stage of an implicit integrator for W gearboxes in lockstep (implicit_lanes.hpp).
#pragma once

#include <cmath>

#include "dynamics/effects/inertial_terms.hpp"
#include "dynamics/effects/mesh_law.hpp"
#include "lockstep/implicit_lanes.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::lockstep {

// The model that implicit integrators march: matrices of any gearbox kind, and a mesh law.
template <class MeshLaw, int W>
struct MatrixMotion {
    static constexpr int kWidth = W;
    static constexpr int kMaxDegrees = ImplicitLanes<W>::kMaxDegrees;
    static constexpr int kMaxPairs = dynamics::kMaxPairs;
    static constexpr int kMaxSources = dynamics::kMaxPlanets;
    using Lanes = ImplicitLanes<W>;
    using Mesh = MeshLaw;
    using Pairs = typename Mesh::template Pairs<kMaxPairs, W>;

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

// Scratch of a stage; [pair][lane] but for the matrix. `pairs` goes in, `force` comes out.
template <class Model, int W = Model::kWidth>
struct alignas(64) StageScratch {
    static constexpr int kRows = Model::kMaxPairs * W;
    typename Model::Pairs pairs;
    double force[kRows];                      // mesh forces, N
    double d[kRows], r[kRows], y[kRows];      // R x, R v, R y
    double touching[kRows], back[kRows];      // of a separating mesh: see touch()
    double s[kRows];                          // S
    double matrix[Model::kMaxPairs * kRows];  // 1 + S G
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

// Deflections and rates of the meshes: t.d, t.r and t.y.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void deflections(const ImplicitLanes<W>& p, const double* __restrict x,
                                const double* __restrict v, const double* __restrict y,
                                StageScratch<Model>& t) {
    for (int pair = 0; pair < p.pairs; ++pair) {
        const int row = pair * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            t.d[row + l] = t.r[row + l] = t.y[row + l] = 0.0;
        }
        for (int e = 0; e < p.row_entries[pair]; ++e) {
            const int d = p.row_degree[pair][e] * W;
            const double weight = p.row_weight[pair][e];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                t.d[row + l] = std::fma(weight, x[d + l], t.d[row + l]);
                t.r[row + l] = std::fma(weight, v[d + l], t.r[row + l]);
                t.y[row + l] = std::fma(weight, y[d + l], t.y[row + l]);
            }
        }
    }
}

// force = k R x + c R v + S R y and matrix = 1 + S G, S = a c + a^2 k.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void mesh_system(const ImplicitLanes<W>& p, const double* __restrict block,
                                const double* __restrict a, StageScratch<Model>& t) {
    for (int pair = 0; pair < p.pairs; ++pair) {
        const int i = pair * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            double k = t.pairs.k[i + l], c = t.pairs.c[i + l], d = t.d[i + l], r = t.r[i + l];
            if constexpr (Model::Mesh::kSeparates) {
                k *= t.touching[i + l];
                c *= t.touching[i + l];
                d += t.back[i + l];
            }
            if constexpr (Model::Mesh::kHasError) {
                d -= t.pairs.e[i + l];
                r -= t.pairs.de[i + l];
            }
            t.s[i + l] = a[l] * std::fma(a[l], k, c);
            t.force[i + l] = std::fma(k, d, std::fma(c, r, t.s[i + l] * t.y[i + l]));
        }
        const double* __restrict g = block + p.capacitance + i * p.pairs;
        double* __restrict row = t.matrix + i * p.pairs;
        for (int other = 0; other < p.pairs; ++other) {
            const double diagonal = other == pair ? 1.0 : 0.0;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                row[other * W + l] = std::fma(t.s[i + l], g[other * W + l], diagonal);
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

// Which flanks of the separating meshes touch at the stage's end, where a mesh deflects by
// R Q = d + a^2 (y - G F), F being t.force (none at first). t.touching is 1 or 0; t.back is the
// backlash if the back flanks touch. Returns whether any lane changed.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE bool touch(const ImplicitLanes<W>& p, const double* __restrict block,
                          const double* __restrict a, bool first, StageScratch<Model>& t) {
    int changes = 0;
    alignas(64) double rest[W];
    for (int pair = 0; pair < p.pairs; ++pair) {
        const int i = pair * W;
        const double* __restrict g = block + p.capacitance + i * p.pairs;
        for (int l = 0; l < W; ++l) {
            rest[l] = t.y[i + l];
        }
        for (int other = 0; other < p.pairs && !first; ++other) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                rest[l] = std::fma(-g[other * W + l], t.force[other * W + l], rest[l]);
            }
        }
#pragma omp simd reduction(| : changes)
        for (int l = 0; l < W; ++l) {
            const double front = std::fma(a[l] * a[l], rest[l], t.d[i + l]) - t.pairs.e[i + l];
            const bool behind = front + t.pairs.backlash[l] < 0.0;
            const double touching = front > 0.0 || behind ? 1.0 : 0.0;
            const double back = behind ? t.pairs.backlash[l] : 0.0;
            changes |= touching != t.touching[i + l] || back != t.back[i + l] ? 1 : 0;
            t.touching[i + l] = touching;
            t.back[i + l] = back;
        }
    }
    return changes != 0;
}

// Rounds in which separating meshes find who touches; one more than most stages need. A lane that
// has found it is the same in every further round.
inline constexpr int kMostRounds = 6;

// The acceleration A of a stage from x = q + a v and v; t.pairs holds the meshes. All [degree of
// freedom][lane], rounded up to four degrees.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void implicit_stage(const ImplicitLanes<W>& p, const double* __restrict block,
                                   const double* __restrict a, const double* __restrict x,
                                   const double* __restrict v, double* __restrict acceleration,
                                   StageScratch<Model>& t) {
    free_acceleration<W>(p, block, x, v, acceleration);
    deflections<Model>(p, x, v, acceleration, t);
    if constexpr (Model::Mesh::kSeparates) {
        touch<Model>(p, block, a, true, t);
        for (int round = 0; round < kMostRounds; ++round) {
            mesh_system<Model>(p, block, a, t);
            solve_meshes<W>(p.pairs, t.matrix, t.force);
            if (!touch<Model>(p, block, a, false, t)) {
                break;
            }
        }
    } else {
        mesh_system<Model>(p, block, a, t);
        solve_meshes<W>(p.pairs, t.matrix, t.force);
    }
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
