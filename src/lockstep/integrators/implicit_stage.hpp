// Stages of an implicit integrator for W gearboxes in lockstep: motion in matrices, contact of the
// meshes, and the solution of a stage.
#pragma once

#include <algorithm>
#include <cmath>

#include "dynamics/effects/inertial_terms.hpp"
#include "dynamics/effects/mesh_law.hpp"
#include "lockstep/integrators/implicit_lanes.hpp"
#include "lockstep/integrators/integration_steps.hpp"
#include "lockstep/integrators/method.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::lockstep {

// Model for implicit integrators: the matrices of any gearbox kind, and a mesh law.
template <class MeshLaw, int W>
struct MatrixMotion {
    static constexpr int kWidth = W;
    static constexpr int kMaxDegrees = ImplicitLanes<W>::kMaxDegrees;
    static constexpr int kMaxPairs = dynamics::kMaxPairs;
    static constexpr int kMaxSources = dynamics::kMaxSources;
    using Lanes = ImplicitLanes<W>;
    using Mesh = MeshLaw;
    using Pairs = typename Mesh::template Pairs<kMaxPairs, W>;

    static GEARPOD_INLINE const auto& mesh_damping(const Lanes& p, int pair) {
        return p.mesh_damping[pair];
    }

    // Absolute acceleration of the sources along the frame's axes: [source][x, y][lane].
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

// Factors of a stage's own acceleration A: V = v + a A, Q = x + b A (s and s^2).
template <int W>
struct alignas(64) StageSpan {
    double a[W] = {}, b[W] = {};
};

// Workspace of a stage; [pair][lane] except g and the matrix. `pairs` is input, `force` is output.
template <class Model, int W = Model::kWidth>
struct alignas(64) StageScratch {
    static constexpr int kRows = Model::kMaxPairs * W;
    typename Model::Pairs pairs;
    double g[Model::kMaxDegrees * W];     // forces except those of the meshes, N
    double force[kRows];                  // mesh forces, N
    double d[kRows], r[kRows], y[kRows];  // R x, R v, R y
    double in_contact[kRows],
        back[kRows];  // state of a separating mesh: see update_flank_contact()
    double active_stiffness[kRows],
        preload[kRows];  // state of unilateral contact: see update_unilateral_contact()
    double s[kRows];     // S
    double matrix[Model::kMaxPairs * kRows];  // remainder of G during the elimination
};

// Hides the address of a row from the compiler. It then vectorizes over the lanes of one entry,
// instead of gathering from several entries.
GEARPOD_INLINE const double* opaque_row(const double* row) {
    asm("" : "+r"(row));
    return row;
}

template <int W>
GEARPOD_INLINE void copy_rows(const double* __restrict from, int rows, double* __restrict to) {
    for (int i = 0; i < rows * W; i += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            to[i + l] = from[i + l];
        }
    }
}

// to -= factor from, W numbers.
template <int W>
GEARPOD_INLINE void subtract_product(const double* factor, const double* from, double* to) {
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        to[l] = std::fma(-factor[l], from[l], to[l]);
    }
}

// g = f - C_0 v - K_0 x.
template <int W>
GEARPOD_INLINE void free_forces(const ImplicitLanes<W>& p, const double* __restrict x,
                                const double* __restrict v, double* __restrict g) {
    copy_rows<W>(p.force.data(), p.degrees, g);
    const int* __restrict to = p.coupling.to.data();
    const int* __restrict from = p.coupling.from.data();
    const double* __restrict c_k = p.c_k.data();
    for (int e = 0; e < p.coupling.size(); ++e) {
        const double* __restrict entry = opaque_row(c_k + 2 * e * W);
        const double* __restrict xj = opaque_row(x + from[e] * W);
        const double* __restrict vj = opaque_row(v + from[e] * W);
        double* __restrict sum = g + to[e] * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            sum[l] = std::fma(-entry[l], vj[l], std::fma(-entry[W + l], xj[l], sum[l]));
        }
    }
}

// y -= (triangular factor without its diagonal) y, entry by entry.
template <int W>
GEARPOD_INLINE void substitute(const SparseEntries& entries, const double* factor, double* y) {
    const int* __restrict to = entries.to.data();
    const int* __restrict from = entries.from.data();
    for (int e = 0; e < entries.size(); ++e) {
        subtract_product<W>(opaque_row(factor + e * W), opaque_row(y + from[e] * W), y + to[e] * W);
    }
}

// Solves H y = g: forward substitution with L, scaling by D, backward substitution with U.
template <int W>
GEARPOD_INLINE void solve_constant_part(const ImplicitLanes<W>& p, const double* __restrict block,
                                        const double* __restrict g, double* y) {
    copy_rows<W>(g, p.degrees, y);
    substitute<W>(p.lu.lower, block + p.lower, y);
    for (int i = 0; i < p.degrees * W; i += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            y[i + l] *= block[i + l];
        }
    }
    substitute<W>(p.lu.upper, block + p.upper, y);
}

// out = R values: [pair][lane] from [degree of freedom][lane].
template <int W>
GEARPOD_INLINE void deflections(const ImplicitLanes<W>& p, const double* __restrict values,
                                double* __restrict out) {
    for (int i = 0; i < p.pairs * W; i += W) {
        broadcast<W>(0.0, out + i);
    }
    for (int e = 0; e < p.row_entries; ++e) {
        for (int pair = 0; pair < p.pairs; ++pair) {
            const double* __restrict value = opaque_row(values + p.row_degree[pair][e] * W);
            const double weight = p.row_weight[pair][e];
            double* __restrict sum = out + pair * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                sum[l] = std::fma(weight, value[l], sum[l]);
            }
        }
    }
}

// g -= R^T force.
template <int W>
GEARPOD_INLINE void subtract_mesh_forces(const ImplicitLanes<W>& p, const double* __restrict force,
                                         double* __restrict g) {
    for (int pair = 0; pair < p.pairs; ++pair) {
        for (int e = 0; e < p.row_entries; ++e) {
            double* __restrict sum = g + p.row_degree[pair][e] * W;
            const double* __restrict load = opaque_row(force + pair * W);
            const double weight = p.row_weight[pair][e];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                sum[l] = std::fma(-weight, load[l], sum[l]);
            }
        }
    }
}

// force = k R x + c R v + S R y, S = a c + b k.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void mesh_loads(const ImplicitLanes<W>& p, const StageSpan<W>& span,
                               StageScratch<Model>& t) {
    for (int i = 0; i < p.pairs * W; i += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            double k = t.pairs.k[i + l], c = t.pairs.c[i + l], d = t.d[i + l], r = t.r[i + l];
            if constexpr (Model::Mesh::kSeparates) {
                k *= t.in_contact[i + l];
                c *= t.in_contact[i + l];
                d += t.back[i + l];
            }
            if constexpr (Model::Mesh::kHasTeeth) {
                k = t.active_stiffness[i + l];
            }
            if constexpr (Model::Mesh::kHasError) {
                d -= t.pairs.e[i + l];
                r -= t.pairs.de[i + l];
            }
            t.s[i + l] = std::fma(span.a[l], c, span.b[l] * k);
            t.force[i + l] = std::fma(k, d, std::fma(c, r, t.s[i + l] * t.y[i + l]));
            if constexpr (Model::Mesh::kHasTeeth) {
                t.force[i + l] -= t.preload[i + l];
            }
        }
    }
}

// Solves (1 + S G) F = force in place by elimination of S^-1 + G. The inverted pivots e_i = s_i /
// (1 + s_i g_ii) exist even for s_i = 0. Pivoting is unnecessary: 1 + s_i g_ii is at least 1,
// because G is positive definite and nearly symmetric. `matrix` is workspace.
template <int W>
GEARPOD_INLINE void solve_meshes(int pairs, const double* __restrict g, const double* __restrict s,
                                 double* __restrict matrix, double* __restrict force) {
    alignas(64) double e[dynamics::kMaxPairs * W];
    alignas(64) double sum[dynamics::kMaxPairs * W];  // of G F over the eliminated pairs
    alignas(64) double factor[W];
    for (int i = 0; i < pairs * W; i += W) {
        broadcast<W>(0.0, sum + i);
    }
    for (int i = 0; i < pairs; ++i) {
        const double* left = i == 0 ? g : matrix;  // remainder of G; all of it for the first pivot
        const double* row = left + i * pairs * W;
        const int first = i * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double inverse = 1.0 / std::fma(s[first + l], row[first + l], 1.0);
            e[first + l] = s[first + l] * inverse;
            force[first + l] = inverse * std::fma(-s[first + l], sum[first + l], force[first + l]);
        }
        for (int r = i + 1; r < pairs; ++r) {
            const double* other = left + r * pairs * W;
            double* rest = matrix + r * pairs * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                sum[r * W + l] = std::fma(other[first + l], force[first + l], sum[r * W + l]);
                factor[l] = other[first + l] * e[first + l];
            }
            for (int c = first + W; c < pairs * W; c += W) {
                const double* pivot_row = opaque_row(row + c);
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    rest[c + l] = std::fma(-factor[l], pivot_row[l], other[c + l]);
                }
            }
        }
    }
    for (int i = 0; i < pairs * W; i += W) {
        broadcast<W>(0.0, sum + i);
    }
    for (int i = pairs - 1; i >= 0; --i) {
        const int first = i * W;
        subtract_product<W>(e + first, sum + first, force + first);
        for (int r = i - 1; r >= 0; --r) {
            const double* row = opaque_row((r == 0 ? g : matrix + r * pairs * W) + first);
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                sum[r * W + l] = std::fma(row[l], force[first + l], sum[r * W + l]);
            }
        }
    }
}

// Determines which flanks of a separating mesh touch if it deflects by `front` beyond its error.
// t.in_contact is 1 or 0; t.back is the backlash if the back flanks touch. Returns 1 if any lane
// changed.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE int update_flank_contact(int i, const double* __restrict front,
                                        StageScratch<Model>& t) {
    int changes = 0;
#pragma omp simd reduction(| : changes)
    for (int l = 0; l < W; ++l) {
        const bool on_back = front[l] + t.pairs.backlash[l] < 0.0;
        const double in_contact = front[l] > 0.0 || on_back ? 1.0 : 0.0;
        const double back = on_back ? t.pairs.backlash[l] : 0.0;
        changes |= in_contact != t.in_contact[i + l] || back != t.back[i + l] ? 1 : 0;
        t.in_contact[i + l] = in_contact;
        t.back[i + l] = back;
    }
    return changes;
}

// Same for unilateral contact. The springs in contact combine to one spring t.active_stiffness with
// a preload t.preload (N) at the mesh's error. t.in_contact is 1 if any spring is in contact.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE int update_unilateral_contact(int i, const double* __restrict front,
                                             StageScratch<Model>& t) {
    constexpr int kRows = StageScratch<Model>::kRows;
    alignas(64) double active_stiffness[W], preload[W];
#pragma omp simd
    for (int l = 0; l < W; ++l) {
        const bool on_back = front[l] + t.pairs.backlash[l] < 0.0;
        active_stiffness[l] = on_back ? t.pairs.k[i + l] : 0.0;
        preload[l] = on_back ? -t.pairs.k[i + l] * t.pairs.backlash[l] : 0.0;
    }
    for (int j = 0; j < t.pairs.contacts; ++j) {
        const double* __restrict k = t.pairs.tooth_k + j * kRows + i;
        const double* __restrict e = t.pairs.tooth_e + j * kRows + i;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double stiffness = front[l] > e[l] ? k[l] : 0.0;
            active_stiffness[l] += stiffness;
            preload[l] = std::fma(stiffness, e[l], preload[l]);
        }
    }
    int changes = 0;
#pragma omp simd reduction(| : changes)
    for (int l = 0; l < W; ++l) {
        const double in_contact = active_stiffness[l] > 0.0 ? 1.0 : 0.0;
        changes |=
            active_stiffness[l] != t.active_stiffness[i + l] || preload[l] != t.preload[i + l] ? 1
                                                                                               : 0;
        t.active_stiffness[i + l] = active_stiffness[l];
        t.preload[i + l] = preload[l];
        t.in_contact[i + l] = in_contact;
    }
    return changes;
}

// Updates the contacts at the stage's end. There a mesh deflects by R Q = d + b (y - G F) with F =
// t.force (0 if `first`). Returns true if any lane changed.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE bool update_contacts(const ImplicitLanes<W>& p, const double* __restrict matrix,
                                    const StageSpan<W>& span, bool first, StageScratch<Model>& t) {
    int changes = 0;
    alignas(64) double rest[W];
    for (int pair = 0; pair < p.pairs; ++pair) {
        const int i = pair * W;
        const double* __restrict g = matrix + i * p.pairs;
        for (int l = 0; l < W; ++l) {
            rest[l] = t.y[i + l];
        }
        for (int other = 0; other < p.pairs && !first; ++other) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                rest[l] = std::fma(-g[other * W + l], t.force[other * W + l], rest[l]);
            }
        }
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            rest[l] = std::fma(span.b[l], rest[l], t.d[i + l]) - t.pairs.e[i + l];
        }
        if constexpr (Model::Mesh::kHasTeeth) {
            changes |= update_unilateral_contact<Model>(i, rest, t);
        } else {
            changes |= update_flank_contact<Model>(i, rest, t);
        }
    }
    return changes != 0;
}

// Iteration limit of the contact search of separating meshes. Nearly all stages need two or three;
// a converged lane does not change in further iterations. Occasionally no solution exists: the
// damper of flanks that just meet would separate them, and without it they meet. The last iterate
// is then used for this one step of an impact.
inline constexpr int kMaxContactIterations = 6;

// Computes the forces of separating meshes.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void separating_meshes(const ImplicitLanes<W>& p, const double* __restrict g,
                                      const StageSpan<W>& span, StageScratch<Model>& t) {
    update_contacts<Model>(p, g, span, true, t);
    for (int round = 0; round < kMaxContactIterations; ++round) {
        mesh_loads<Model>(p, span, t);
        solve_meshes<W>(p.pairs, g, t.s, t.matrix, t.force);
        if (!update_contacts<Model>(p, g, span, false, t)) {
            return;
        }
    }
}

// Computes the acceleration A of a stage from x and v; t.pairs holds the meshes. All are [degree of
// freedom][lane].
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void implicit_stage(const typename Model::Lanes& p, const double* __restrict block,
                                   const StageSpan<W>& span, const double* __restrict x,
                                   const double* __restrict v, double* __restrict acceleration,
                                   StageScratch<Model>& t) {
    free_forces<W>(p, x, v, t.g);
    if constexpr (requires { Model::add_forces(p, t.pairs, t.g); }) {
        Model::add_forces(p, t.pairs, t.g);
    }
    solve_constant_part<W>(p, block, t.g, acceleration);
    deflections<W>(p, x, t.d);
    deflections<W>(p, v, t.r);
    deflections<W>(p, acceleration, t.y);
    const double* g = block + p.capacitance;
    if constexpr (Model::Mesh::kSeparates) {
        separating_meshes<Model>(p, g, span, t);
    } else {
        mesh_loads<Model>(p, span, t);
        solve_meshes<W>(p.pairs, g, t.s, t.matrix, t.force);
    }
    subtract_mesh_forces<W>(p, t.force, t.g);
    solve_constant_part<W>(p, block, t.g, acceleration);
}

// Stages of implicit integrators whose own acceleration A enters with one coefficient a (s): the
// velocity is V = v + a A and the position Q = x + a (a A).

// Computes the stage at a node of step i: its acceleration, velocities, positions and the sensor's
// input. x and v are positions and velocities without the stage's own acceleration; span.a is the
// coefficient and span.b its square.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void diagonal_stage(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                   const MeshOverrides& overrides, int i, int node,
                                   const StageSpan<W>& span, const double* x, const double* v,
                                   double* __restrict acceleration, double* __restrict velocities,
                                   double* __restrict positions, double* __restrict input,
                                   StageScratch<Model>& meshes) {
    const int kind = plan.grid.steps[static_cast<std::size_t>(i)].kind;
    load_pairs<Model>(plan, lanes, overrides, i, node, meshes.pairs);
    implicit_stage<Model>(lanes, lanes.block(kind), span, x, v, acceleration, meshes);
    for (int j = 0; j < lanes.degrees * W; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double rise = span.a[l] * acceleration[j + l];
            velocities[j + l] = v[j + l] + rise;
            positions[j + l] = std::fma(span.a[l], rise, x[j + l]);
        }
    }
    Model::source_accelerations(lanes, positions, velocities, acceleration, input);
}

}  // namespace gearpod::lockstep
