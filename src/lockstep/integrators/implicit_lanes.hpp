// Matrices of an implicit integrator for W gearboxes, with their sparsity pattern and elimination
// order.
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "lockstep/integrators/method.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

// Sparsity pattern of a matrix and of its triangular factors, computed once and shared by all
// matrices with that pattern. A gearbox couples its planets only through the carrier, the ring and
// the sun, so a good elimination order causes almost no fill-in.

// Positions of nonzero entries: entry e is in row `to[e]` and column `from[e]`. A product with a
// vector adds value e times element `from[e]` to element `to[e]`. Entries are sorted by column, so
// that few consecutive additions depend on each other.
struct SparseEntries {
    std::vector<int> to, from;
    int size() const { return static_cast<int>(to.size()); }
};

// Entries of `matrix` that differ from zero.
SparseEntries nonzero_entries(const Eigen::MatrixXd& matrix);

// Pattern of the factors A = L D U (unit diagonals of L and U) of matrices with the nonzeros of
// `pattern` (square; its transpose counts too). Elimination follows `order` without row exchanges.
// The entries are sorted so that L y = g and then U x = y can be solved in place.
struct SparseLu {
    std::vector<int> order;
    SparseEntries lower, upper;
};
SparseLu eliminate(const Eigen::MatrixXd& pattern);

// Factors with L below, D on and U above the diagonal, in the row and column order of A. The matrix
// must not need row exchanges; symmetric positive definite matrices do not.
Eigen::MatrixXd factors(const SparseLu& lu, const Eigen::MatrixXd& matrix);

// Data of W gearboxes of any kind for the implicit integrators: all matrices that do not change
// from step to step, factored in advance.
//
// A stage solves for the acceleration A in
//   M A + C V + K Q = f,   V = v + a A,   Q = x + b A,
// where a is proportional to the step, and b to its square. With one row r_p per pair,
//   C = C_0 + sum c_p r_p r_p^T,   K = K_0 + sum k_p r_p r_p^T,
// so only the mesh terms change. With
//   H = M + a C_0 + b K_0,   g = f - C_0 v - K_0 x,   y = H^-1 g,
// the mesh forces F and the acceleration follow from the small system
//   (1 + S G) F = k R x + c R v + S R y,   H A = g - R^T F,
//   S = diag(a c_p + b k_p),   R = rows r_p,   G = R H^-1 R^T.
// This is the Woodbury identity in mechanical terms. Since S >= 0, a mesh without load causes no
// singularity. C_0, K_0 and the factors of H are sparse, so a tile's block of them
// fits the first-level cache.
template <int W>
struct ImplicitLanes {
    static constexpr int kMaxDegrees = 9 + 3 * dynamics::kMaxPlanets;
    static constexpr int kMaxRowEntries = 6;  // degrees of freedom in a mesh deflection

    int degrees = 0, pairs = 0, sources = 0;

    // Data common to all lanes. Rows r_p are lists of `row_entries` entries, padded with weight 0.
    // The x (2n) and y (2n + 1) of source n are a weighted degree of freedom each.
    int row_entries = 0;
    int row_degree[dynamics::kMaxPairs][kMaxRowEntries] = {};
    double row_weight[dynamics::kMaxPairs][kMaxRowEntries] = {};
    int source_degree[2 * dynamics::kMaxSources] = {};
    double source_weight[2 * dynamics::kMaxSources] = {};

    alignas(64) double mesh_period[W] = {};  // s
    alignas(64) double backlash[W] = {};     // m
    alignas(64) double frame_speed[W] = {};  // rad/s
    alignas(64) dynamics::DampingLanes<W> mesh_damping[dynamics::kMaxPairs] = {};

    machine::AlignedVector force;  // f, [degree of freedom][lane]
    SparseEntries coupling;        // entries of C_0 and K_0
    machine::AlignedVector c_k;    // [entry][C, K][lane]
    SparseLu lu;                   // entries of the factors of H

    // One block for each step kind, and a last one for a = b = 0. Contents of a block, by offset:
    // inverse of D [degree of freedom][lane]; L and U [entry][lane]; G [pair][pair][lane].
    machine::AlignedVector blocks;
    std::size_t block_size = 0;
    int lower = 0, upper = 0, capacitance = 0;  // offsets in a block

    const double* block(int kind) const {
        return blocks.data() + static_cast<std::size_t>(kind) * block_size;
    }
    const double* block_at_rest() const {
        return blocks.data() + (blocks.size() / block_size - 1) * block_size;
    }
};

// Makes the lanes for the plan's grid and an integrator with the given diagonal coefficient (a over
// the step). `inputs` holds W gearboxes of the plan's kind.
template <int W>
ImplicitLanes<W> make_implicit_lanes(const IntegrationPlan& plan, double diagonal,
                                     std::span<const dynamics::GearboxInputs> inputs);

}  // namespace gearpod::lockstep
