#include "lockstep/implicit_lanes.hpp"

#include <cassert>

namespace gearpod::lockstep {
namespace {

// Rows of the meshes, [pair][degree].
Eigen::MatrixXd mesh_rows(const dynamics::GearboxLayout& layout) {
    Eigen::MatrixXd rows(dynamics::pairs(layout), dynamics::degrees_of_freedom(layout));
    for (int pair = 0; pair < rows.rows(); ++pair) {
        rows.row(pair) = dynamics::mesh_row(layout, pair).transpose();
    }
    return rows;
}

template <int W>
void set_rows(ImplicitLanes<W>& lanes, const Eigen::MatrixXd& rows) {
    for (int pair = 0; pair < lanes.pairs; ++pair) {
        int& entries = lanes.row_entries[pair];
        for (int d = 0; d < lanes.degrees; ++d) {
            if (rows(pair, d) != 0.0) {
                assert(entries < ImplicitLanes<W>::kMaxRowEntries);
                lanes.row_degree[pair][entries] = d;
                lanes.row_weight[pair][entries] = rows(pair, d);
                ++entries;
            }
        }
    }
}

template <int W>
void set_sources(ImplicitLanes<W>& lanes, const dynamics::GearboxLayout& layout) {
    for (int channel = 0; channel < 2 * lanes.sources; ++channel) {
        const Eigen::VectorXd row = dynamics::source_row(layout, channel / 2, channel % 2);
        Eigen::Index degree = 0;
        row.cwiseAbs().maxCoeff(&degree);
        lanes.source_degree[channel] = static_cast<int>(degree);
        lanes.source_weight[channel] = row(degree);
    }
}

// One lane's column of a block: the matrices for the implicit span `a`, s.
template <int W>
void set_block(const ImplicitLanes<W>& lanes, const dynamics::GearboxMatrices& m,
               const Eigen::MatrixXd& rows, double a, double* block) {
    const Eigen::MatrixXd c = m.damping + m.gyroscopic;
    const Eigen::MatrixXd k = m.stiffness + m.centrifugal;
    const Eigen::PartialPivLU<Eigen::MatrixXd> solver(m.mass + a * c + a * a * k);
    const Eigen::VectorXd constants = solver.solve(m.force);
    const Eigen::MatrixXd from_c = -solver.solve(c), from_k = -solver.solve(k);
    const Eigen::MatrixXd z = solver.solve(rows.transpose());
    const Eigen::MatrixXd g = rows * z;
    const int n = lanes.degrees;
    for (int i = 0; i < n; ++i) {
        block[i * W] = constants(i);
        for (int j = 0; j < n; ++j) {
            double* product = block + lanes.products + (((i / 4) * n + j) * 8 + i % 4) * W;
            product[0] = from_c(i, j);
            product[4 * W] = from_k(i, j);
        }
        for (int pair = 0; pair < lanes.pairs; ++pair) {
            block[lanes.reactions + (i * lanes.pairs + pair) * W] = z(i, pair);
        }
    }
    for (int row = 0; row < lanes.pairs; ++row) {
        for (int column = 0; column < lanes.pairs; ++column) {
            block[lanes.capacitance + (row * lanes.pairs + column) * W] = g(row, column);
        }
    }
}

}  // namespace

template <int W>
ImplicitLanes<W> make_implicit_lanes(const MarchPlan& plan, double share,
                                     std::span<const dynamics::GearboxInputs> inputs) {
    assert(inputs.size() == W);
    ImplicitLanes<W> lanes;
    lanes.degrees = dynamics::degrees_of_freedom(plan.layout);
    lanes.pairs = dynamics::pairs(plan.layout);
    lanes.sources = dynamics::sources(plan.layout);
    const Eigen::MatrixXd rows = mesh_rows(plan.layout);
    set_rows(lanes, rows);
    set_sources(lanes, plan.layout);

    const int n = lanes.degrees, padded = lanes.padded_degrees();
    lanes.products = padded * W;
    lanes.reactions = lanes.products + 2 * padded * n * W;
    lanes.capacitance = lanes.reactions + n * lanes.pairs * W;
    const int size = lanes.capacitance + lanes.pairs * lanes.pairs * W;
    lanes.block_size = static_cast<std::size_t>((size + 7) / 8 * 8);
    lanes.blocks.assign((plan.grid.lengths.size() + 1) * lanes.block_size, 0.0);

    const std::vector<double> no_mesh(static_cast<std::size_t>(lanes.pairs), 0.0);
    for (int l = 0; l < W; ++l) {
        const auto& in = inputs[static_cast<std::size_t>(l)];
        lanes.mesh_period[l] = dynamics::mesh_period_s(in);
        lanes.backlash[l] = dynamics::backlash_m(in);
        lanes.frame_speed[l] = dynamics::frame_speed_rad_s(in);
        for (int pair = 0; pair < lanes.pairs; ++pair) {
            lanes.mesh_damping_factor[pair][l] =
                dynamics::mesh_damping_factor(plan.layout, in, pair);
        }
        // A constant damping would stay with meshes of no stiffness; the steps bring it.
        dynamics::GearboxInputs bare = in;
        std::visit([](auto& kind) { kind.mesh_damping = 0.0; }, bare);
        const dynamics::GearboxMatrices m = dynamics::assemble(plan.layout, bare, no_mesh);
        for (std::size_t kind = 0; kind <= plan.grid.lengths.size(); ++kind) {
            const double a = kind < plan.grid.lengths.size()
                                 ? share * plan.grid.lengths[kind] * lanes.mesh_period[l]
                                 : 0.0;
            set_block(lanes, m, rows, a, lanes.blocks.data() + kind * lanes.block_size + l);
        }
    }
    return lanes;
}

template ImplicitLanes<1> make_implicit_lanes<1>(const MarchPlan&, double,
                                                 std::span<const dynamics::GearboxInputs>);
template ImplicitLanes<4> make_implicit_lanes<4>(const MarchPlan&, double,
                                                 std::span<const dynamics::GearboxInputs>);
template ImplicitLanes<8> make_implicit_lanes<8>(const MarchPlan&, double,
                                                 std::span<const dynamics::GearboxInputs>);

}  // namespace gearpod::lockstep
