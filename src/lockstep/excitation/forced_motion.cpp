#include "lockstep/excitation/forced_motion.hpp"

#include "dynamics/gearbox.hpp"
#include "machine/contracts.hpp"

namespace gearpod::lockstep {
namespace {

// Generalised forces per unit of each varying value (torque, gravity, rotation, shafts): one
// column per value, in the order of ExcitationRows.
Eigen::MatrixXd columns_of(const IntegrationPlan& plan, const Excitation& excitation,
                           const dynamics::GearboxInputs& in) {
    const int degrees = dynamics::degrees_of_freedom(plan.layout);
    Eigen::MatrixXd columns(degrees, columns_in(excitation));
    int c = 0;
    if (excitation.torque) {
        columns.col(c++) = dynamics::torque_force(plan.layout, in);
    }
    if (excitation.gravity) {
        columns.middleCols(c, 2) = dynamics::weight_force(plan.layout, in);
        c += 2;
    }
    if (excitation.speed) {
        columns.col(c++) =
            dynamics::angular_acceleration_force(plan.layout, in, excitation.input_degree);
    }
    for (const ShaftEnd& shaft : excitation.shafts) {
        columns.col(c).setZero();
        columns(shaft.degree, c++) = shaft.turn_per_m;
    }
    return columns;
}

}  // namespace

template <int W>
ExcitationForces<W> make_excitation_forces(const IntegrationPlan& plan,
                                           const Excitation& excitation,
                                           std::span<const dynamics::GearboxInputs> inputs,
                                           bool over_mass) {
    EXPECTS(inputs.size() == W);
    const std::vector<double> none(static_cast<std::size_t>(dynamics::pairs(plan.layout)), 0.0);
    std::vector<Eigen::MatrixXd> lane;
    Eigen::MatrixXd size;  // largest absolute entries over the lanes; zero entries are omitted
    for (const auto& in : inputs) {
        Eigen::MatrixXd columns = columns_of(plan, excitation, in);
        if (over_mass) {
            const Eigen::VectorXd mass = dynamics::assemble(plan.layout, in, none).mass.diagonal();
            columns = mass.cwiseInverse().asDiagonal() * columns;
        }
        size = lane.empty() ? Eigen::MatrixXd(columns.cwiseAbs())
                            : Eigen::MatrixXd(size.cwiseMax(columns.cwiseAbs()));
        lane.push_back(std::move(columns));
    }
    ExcitationForces<W> forces;
    forces.columns = static_cast<int>(size.cols());
    forces.nodes_per_step = distinct_nodes_per_step(plan.grid);
    forces.values = values_in_row(excitation);
    int entries = 0;
    for (int c = 0; c < forces.columns; ++c) {
        for (int d = 0; d < size.rows(); ++d) {
            if (size(d, c) == 0.0) {
                continue;
            }
            forces.degree[entries] = d;
            for (std::size_t l = 0; l < W; ++l) {
                forces.pattern[entries][l] = lane[l](d, c);
            }
            ++entries;
        }
        forces.first[c + 1] = entries;
    }
    return forces;
}

#define GEARPOD_EXCITATION_FORCES(W, REAL)                                                   \
    template ExcitationForces<W> make_excitation_forces<W>(                                  \
        const IntegrationPlan&, const Excitation&, std::span<const dynamics::GearboxInputs>, \
        bool);
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_EXCITATION_FORCES)
#undef GEARPOD_EXCITATION_FORCES

}  // namespace gearpod::lockstep
