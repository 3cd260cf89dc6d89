#include "lockstep/instability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "lockstep/step_limit.hpp"

namespace gearpod::lockstep {
namespace {

// Stiffness of all pairs, steps [first, last) of the grid, weighted by their lengths.
struct Piece {
    std::vector<double> stiffness;  // N/m
    double length = 0.0;            // mesh periods
};

Piece mean_piece(const MarchPlan& plan, std::size_t first, std::size_t last) {
    const auto pairs = static_cast<std::size_t>(plan.nodes.pairs);
    const std::size_t nodes = plan.grid.stage_nodes.size();
    Piece piece{std::vector<double>(pairs, 0.0), 0.0};
    for (std::size_t step = first; step < last; ++step) {
        const double length = plan.grid.steps[step].length;
        for (std::size_t i = 0; i < nodes * pairs; ++i) {
            piece.stiffness[i % pairs] += length / static_cast<double>(nodes) *
                                          plan.nodes.stiffness[step * nodes * pairs + i];
        }
        piece.length += length;
    }
    for (double& k : piece.stiffness) {
        k /= piece.length;
    }
    return piece;
}

std::vector<Piece> pieces_of_mesh(const MarchPlan& plan, int least) {
    const std::size_t steps = plan.grid.steps.size();
    const std::size_t together = std::max<std::size_t>(1, steps / static_cast<std::size_t>(least));
    std::vector<Piece> pieces;
    for (std::size_t first = 0; first < steps; first += together) {
        pieces.push_back(mean_piece(plan, first, std::min(steps, first + together)));
    }
    return pieces;
}

std::vector<double> stiffest_nodes(const MarchPlan& plan) {
    const auto pairs = static_cast<std::size_t>(plan.nodes.pairs);
    std::vector<double> stiffest(pairs, 0.0);
    for (std::size_t i = 0; i < plan.nodes.stiffness.size(); ++i) {
        stiffest[i % pairs] = std::max(stiffest[i % pairs], plan.nodes.stiffness[i]);
    }
    return stiffest;
}

bool step_too_long(const MarchPlan& plan, const dynamics::GearboxInputs& inputs) {
    if (plan.integrator != Integrator::rk4) {
        return false;  // the implicit methods are stable at any step
    }
    const double longest = *std::max_element(plan.grid.lengths.begin(), plan.grid.lengths.end());
    const auto matrices = dynamics::assemble(plan.layout, inputs, stiffest_nodes(plan));
    return longest * dynamics::mesh_period_s(inputs) > runge_kutta_limit(matrices).step_s;
}

// Takes the rigid rotation out of displacements and of velocities.
Eigen::MatrixXd without_rigid_rotation(const MarchPlan& plan, const Eigen::MatrixXd& mass) {
    const Eigen::VectorXd turn = dynamics::rigid_rotation(plan.layout);
    const Eigen::VectorXd weighted = mass * turn;
    const Eigen::Index n = turn.size();
    const Eigen::MatrixXd keep =
        Eigen::MatrixXd::Identity(n, n) - turn * (weighted / weighted.dot(turn)).transpose();
    Eigen::MatrixXd both = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = keep;
    return both;
}

// (q, v) over a piece. Displacements are scaled to velocities by the stiffest spring's rate: the
// exponential of the bare matrix would lose as many digits as that rate has.
Eigen::MatrixXd propagator(const dynamics::GearboxMatrices& matrices, double time_s) {
    const Eigen::Index n = matrices.mass.rows();
    const double rate = std::sqrt(
        (matrices.stiffness.diagonal().array() / matrices.mass.diagonal().array()).maxCoeff());
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(2 * n);
    scale.head(n).setConstant(rate > 0.0 ? rate : 1.0);
    const Eigen::MatrixXd scaled =
        scale.asDiagonal() * state_matrix(matrices) * scale.cwiseInverse().asDiagonal();
    return scale.cwiseInverse().asDiagonal() * (time_s * scaled).exp() * scale.asDiagonal();
}

constexpr double kNoGrowth = 1.0 + 1e-5;
constexpr int kPieces = 96;

}  // namespace

double growth_per_mesh(const MarchPlan& plan, const dynamics::GearboxInputs& inputs, int pieces) {
    const Eigen::Index n = dynamics::degrees_of_freedom(plan.layout);
    Eigen::MatrixXd over_mesh = Eigen::MatrixXd::Identity(2 * n, 2 * n);
    Eigen::MatrixXd mass;
    for (const Piece& piece : pieces_of_mesh(plan, pieces)) {
        const auto matrices = dynamics::assemble(plan.layout, inputs, piece.stiffness);
        const double time = piece.length * dynamics::mesh_period_s(inputs);
        over_mesh = (propagator(matrices, time) * over_mesh).eval();
        mass = matrices.mass;
    }
    over_mesh = without_rigid_rotation(plan, mass) * over_mesh;
    return Eigen::EigenSolver<Eigen::MatrixXd>(over_mesh, false)
        .eigenvalues()
        .cwiseAbs()
        .maxCoeff();
}

Instability find_instability(const MarchPlan& plan, const dynamics::GearboxInputs& inputs) {
    if (growth_per_mesh(plan, inputs, 1) > kNoGrowth) {
        return Instability::turning_frame;
    }
    if (step_too_long(plan, inputs)) {
        return Instability::step;
    }
    const bool linear = plan.mesh_law != dynamics::MeshLaw::separating;
    return linear && growth_per_mesh(plan, inputs, kPieces) > kNoGrowth ? Instability::parametric
                                                                        : Instability::none;
}

}  // namespace gearpod::lockstep
