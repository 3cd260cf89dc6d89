// W gearboxes of any kind for the implicit integrators: every matrix that does not change from
// step to step, inverted in advance.
//
// A stage asks for the acceleration A with
//   M A + C V + K Q = f,   V = v + a A,   Q = x + a^2 A,   x = q + a v,
// where a is a share of the step. C = C_0 + sum c_p r_p r_p^T and K = K_0 + sum k_p r_p r_p^T: only
// the meshes, one row r_p a pair, change. With B = (M + a C_0 + a^2 K_0)^-1 and
// y = B (f - C_0 v - K_0 x), the mesh forces F and the acceleration follow from the small system
//   (1 + S G) F = k R x + c R v + S R y,   A = y - Z F,
//   S = diag(a c_p + a^2 k_p),   R = rows r_p,   Z = B R^T,   G = R Z,
// the Woodbury identity in mechanical terms. S >= 0, so a mesh that carries nothing does no harm.
#pragma once

#include <span>

#include "lockstep/march.hpp"

namespace gearpod::lockstep {

template <int W>
struct ImplicitLanes {
    static constexpr int kMaxDegrees = 9 + 3 * dynamics::kMaxPlanets;
    static constexpr int kMaxRowEntries = 6;  // motions that a mesh deflects by

    int degrees = 0, pairs = 0, sources = 0;

    // Shared by all lanes: rows r_p as lists, and the degree of freedom (and its weight) that a
    // source's x (2n) and y (2n + 1) follow.
    int row_entries[dynamics::kMaxPairs] = {};
    int row_degree[dynamics::kMaxPairs][kMaxRowEntries] = {};
    double row_weight[dynamics::kMaxPairs][kMaxRowEntries] = {};
    int source_degree[2 * dynamics::kMaxPlanets] = {};
    double source_weight[2 * dynamics::kMaxPlanets] = {};

    alignas(64) double mesh_period[W] = {};                               // s
    alignas(64) double backlash[W] = {};                                  // m
    alignas(64) double frame_speed[W] = {};                               // rad/s
    alignas(64) double mesh_damping_factor[dynamics::kMaxPairs][W] = {};  // times the shape

    // One block for each step kind and, last, one for a = 0. In a block, by its offsets:
    // constants B f [degree][lane]; products -B C_0 and -B K_0, [rows of four][degree][C, K][row]
    // [lane]; Z [degree][pair][lane]; G [pair][pair][lane].
    machine::AlignedVector blocks;
    std::size_t block_size = 0;
    int products = 0, reactions = 0, capacitance = 0;  // offsets in a block

    int padded_degrees() const { return (degrees + 3) / 4 * 4; }
    const double* block(int kind) const {
        return blocks.data() + static_cast<std::size_t>(kind) * block_size;
    }
    int blocks_at_rest() const { return static_cast<int>(blocks.size() / block_size) - 1; }
};

// `share` is a over the step: how much of a step the implicit part spans. `inputs` holds W
// gearboxes of the plan's kind.
template <int W>
ImplicitLanes<W> make_implicit_lanes(const MarchPlan& plan, double share,
                                     std::span<const dynamics::GearboxInputs> inputs);

extern template ImplicitLanes<1> make_implicit_lanes<1>(const MarchPlan&, double,
                                                        std::span<const dynamics::GearboxInputs>);
extern template ImplicitLanes<4> make_implicit_lanes<4>(const MarchPlan&, double,
                                                        std::span<const dynamics::GearboxInputs>);
extern template ImplicitLanes<8> make_implicit_lanes<8>(const MarchPlan&, double,
                                                        std::span<const dynamics::GearboxInputs>);

}  // namespace gearpod::lockstep
