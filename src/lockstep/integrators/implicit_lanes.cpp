#include "lockstep/integrators/implicit_lanes.hpp"

#include <algorithm>

#include "dynamics/gearbox_matrices.hpp"
#include "machine/contracts.hpp"

namespace gearpod::lockstep {
namespace {

using Pattern = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;

// Row with the fewest neighbours among the remaining ones; this greedy order (minimum degree)
// causes little fill-in.
int minimum_degree_row(const Pattern& filled, const std::vector<int>& left) {
    const auto neighbours = [&](int row) {
        return std::count_if(left.begin(), left.end(),
                             [&](int other) { return other != row && filled(row, other); });
    };
    return *std::min_element(left.begin(), left.end(),
                             [&](int a, int b) { return neighbours(a) < neighbours(b); });
}

}  // namespace

SparseEntries nonzero_entries(const Eigen::MatrixXd& matrix) {
    SparseEntries entries;
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
            if (matrix(row, column) != 0.0) {
                entries.to.push_back(static_cast<int>(row));
                entries.from.push_back(static_cast<int>(column));
            }
        }
    }
    return entries;
}

SparseLu eliminate(const Eigen::MatrixXd& pattern) {
    Pattern filled = pattern.array() != 0.0 || pattern.transpose().array() != 0.0;
    std::vector<int> left(static_cast<std::size_t>(pattern.rows()));
    for (std::size_t i = 0; i < left.size(); ++i) {
        left[i] = static_cast<int>(i);
    }
    SparseLu lu;
    while (!left.empty()) {
        const int pivot = minimum_degree_row(filled, left);
        lu.order.push_back(pivot);
        left.erase(std::find(left.begin(), left.end(), pivot));
        for (const int row : left) {
            for (const int column : left) {
                filled(row, column) =
                    filled(row, column) || (filled(row, pivot) && filled(pivot, column));
            }
        }
    }
    const auto add = [&](SparseEntries& entries, std::size_t row, std::size_t column) {
        if (filled(lu.order[row], lu.order[column])) {
            entries.to.push_back(lu.order[row]);
            entries.from.push_back(lu.order[column]);
        }
    };
    const std::size_t n = lu.order.size();
    for (std::size_t column = 0; column < n; ++column) {
        for (std::size_t row = column + 1; row < n; ++row) {
            add(lu.lower, row, column);
        }
    }
    for (std::size_t column = n; column-- > 0;) {
        for (std::size_t row = 0; row < column; ++row) {
            add(lu.upper, row, column);
        }
    }
    return lu;
}

Eigen::MatrixXd factors(const SparseLu& lu, const Eigen::MatrixXd& matrix) {
    Eigen::MatrixXd f = matrix(lu.order, lu.order);
    for (Eigen::Index i = 0; i < f.rows(); ++i) {
        const Eigen::Index rest = f.rows() - i - 1;
        f.col(i).tail(rest) /= f(i, i);
        f.bottomRightCorner(rest, rest).noalias() -= f.col(i).tail(rest) * f.row(i).tail(rest);
        f.row(i).tail(rest) /= f(i, i);
    }
    Eigen::MatrixXd result(f.rows(), f.cols());
    result(lu.order, lu.order) = f;
    return result;
}

namespace {

// Deflection rows of the meshes, [pair][degree of freedom].
Eigen::MatrixXd mesh_rows(const dynamics::GearboxLayout& layout) {
    Eigen::MatrixXd rows(dynamics::pairs(layout), dynamics::degrees_of_freedom(layout));
    for (int pair = 0; pair < rows.rows(); ++pair) {
        rows.row(pair) = dynamics::mesh_row(layout, PairId{pair}).transpose();
    }
    return rows;
}

template <int W>
void set_rows(ImplicitLanes<W>& lanes, const Eigen::MatrixXd& rows) {
    for (int pair = 0; pair < lanes.pairs; ++pair) {
        int entries = 0;
        for (int d = 0; d < lanes.degrees; ++d) {
            if (rows(pair, d) != 0.0) {
                EXPECTS(entries < ImplicitLanes<W>::kMaxRowEntries);
                lanes.row_degree[pair][entries] = d;
                lanes.row_weight[pair][entries] = rows(pair, d);
                ++entries;
            }
        }
        lanes.row_entries = std::max(lanes.row_entries, entries);
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

dynamics::GearboxMatrices without_meshes(const dynamics::GearboxLayout& layout,
                                         const dynamics::GearboxInputs& in) {
    // A constant damping would remain for meshes without stiffness; the steps add mesh damping
    // themselves.
    dynamics::GearboxInputs bare = in;
    std::visit([](auto& kind) { kind.mesh_damping = 0.0; }, bare);
    const std::vector<double> none(static_cast<std::size_t>(dynamics::pairs(layout)), 0.0);
    return dynamics::assemble(layout, bare, none);
}

// Sparsity pattern of C_0 and K_0 (`forces`), and with M (`all`), over all gearboxes of the layout:
// that of a gearbox with all parameters 1. It is the same for every tile, so that all tiles compute
// in the same order.
struct Coupling {
    Eigen::MatrixXd forces, all;
};
Coupling coupled(const dynamics::GearboxLayout& layout) {
    dynamics::PlanetaryInputs train;
    for (int body = 0; body < dynamics::body_count; ++body) {
        train.mass_kg[body] = train.inertia_over_r2_kg[body] = 1.0;
        train.bearing_stiffness_N_m[body] = train.bearing_damping_N_s_m[body] = 1.0;
    }
    train.support_stiffness_N_m = train.support_damping_N_s_m = train.carrier_speed_rad_s = 1.0;
    dynamics::FixedShaftInputs stage;
    for (int g = 0; g < dynamics::fixed_shaft_gear_count; ++g) {
        stage.mass_kg[g] = stage.inertia_kg_m2[g] = 1.0;
        stage.bearing_stiffness_N_m[g] = stage.bearing_damping_N_s_m[g] = 1.0;
        stage.coupling_stiffness_N_m_rad[g] = stage.coupling_damping_N_m_s_rad[g] = 1.0;
    }
    stage.motor_inertia_kg_m2 = stage.load_inertia_kg_m2 = 1.0;
    const bool planetary = std::holds_alternative<dynamics::PlanetaryLayout>(layout);
    const dynamics::GearboxMatrices m = without_meshes(
        layout, planetary ? dynamics::GearboxInputs(train) : dynamics::GearboxInputs(stage));
    const Eigen::MatrixXd forces = m.damping.cwiseAbs() + m.gyroscopic.cwiseAbs() +
                                   m.stiffness.cwiseAbs() + m.centrifugal.cwiseAbs();
    return {forces, forces + m.mass.cwiseAbs()};
}

// Sets one lane of a block: the matrices for the implicit spans a (s) and b (s^2).
template <int W>
void set_block(const ImplicitLanes<W>& lanes, const dynamics::GearboxMatrices& m,
               const Eigen::MatrixXd& rows, double a, double b, double* block) {
    const Eigen::MatrixXd h =
        m.mass + a * (m.damping + m.gyroscopic) + b * (m.stiffness + m.centrifugal);
    const Eigen::MatrixXd f = factors(lanes.lu, h);
    for (int i = 0; i < lanes.degrees; ++i) {
        block[i * W] = 1.0 / f(i, i);
    }
    const auto store = [&](const SparseEntries& entries, double* column) {
        for (std::size_t e = 0; e < entries.to.size(); ++e) {
            column[e * W] = f(entries.to[e], entries.from[e]);
        }
    };
    store(lanes.lu.lower, block + lanes.lower);
    store(lanes.lu.upper, block + lanes.upper);
    const Eigen::MatrixXd g = rows * h.partialPivLu().solve(rows.transpose());
    for (int row = 0; row < lanes.pairs; ++row) {
        for (int column = 0; column < lanes.pairs; ++column) {
            block[lanes.capacitance + (row * lanes.pairs + column) * W] = g(row, column);
        }
    }
}

template <int W>
void set_sizes(ImplicitLanes<W>& lanes, std::size_t kinds) {
    lanes.force.assign(static_cast<std::size_t>(lanes.degrees * W), 0.0);
    lanes.c_k.assign(static_cast<std::size_t>(lanes.coupling.size() * 2 * W), 0.0);
    lanes.lower = lanes.degrees * W;
    lanes.upper = lanes.lower + lanes.lu.lower.size() * W;
    lanes.capacitance = lanes.upper + lanes.lu.upper.size() * W;
    const int size = lanes.capacitance + lanes.pairs * lanes.pairs * W;
    lanes.block_size = static_cast<std::size_t>((size + 7) / 8 * 8);
    lanes.blocks.assign((kinds + 1) * lanes.block_size, 0.0);
}

// Sets lane l of f, C_0 and K_0.
template <int W>
void set_constants(ImplicitLanes<W>& lanes, const dynamics::GearboxMatrices& m, int l) {
    for (int i = 0; i < lanes.degrees; ++i) {
        lanes.force[static_cast<std::size_t>(i * W + l)] = m.force(i);
    }
    double* coefficient = lanes.c_k.data() + l;
    for (std::size_t e = 0; e < lanes.coupling.to.size(); ++e) {
        const int i = lanes.coupling.to[e], j = lanes.coupling.from[e];
        coefficient[0] = m.damping(i, j) + m.gyroscopic(i, j);
        coefficient[W] = m.stiffness(i, j) + m.centrifugal(i, j);
        coefficient += 2 * W;
    }
}

}  // namespace

template <int W>
ImplicitLanes<W> make_implicit_lanes(const IntegrationPlan& plan, double diagonal,
                                     std::span<const dynamics::GearboxInputs> inputs) {
    EXPECTS(inputs.size() == W);
    ImplicitLanes<W> lanes;
    lanes.degrees = dynamics::degrees_of_freedom(plan.layout);
    lanes.pairs = dynamics::pairs(plan.layout);
    lanes.sources = dynamics::sources(plan.layout);
    const Eigen::MatrixXd rows = mesh_rows(plan.layout);
    set_rows(lanes, rows);
    set_sources(lanes, plan.layout);
    const Coupling pattern = coupled(plan.layout);
    lanes.coupling = nonzero_entries(pattern.forces);
    lanes.lu = eliminate(pattern.all);
    set_sizes(lanes, plan.grid.lengths.size());

    for (int l = 0; l < W; ++l) {
        const auto& in = inputs[static_cast<std::size_t>(l)];
        lanes.mesh_period[l] = dynamics::mesh_period_s(in);
        lanes.backlash[l] = dynamics::backlash_m(in);
        lanes.frame_speed[l] = dynamics::frame_speed_rad_s(in);
        for (int pair = 0; pair < lanes.pairs; ++pair) {
            lanes.mesh_damping[pair].factor[l] =
                dynamics::mesh_damping_factor(plan.layout, in, PairId{pair});
        }
        const dynamics::GearboxMatrices m = without_meshes(plan.layout, in);
        set_constants(lanes, m, l);
        double* block = lanes.blocks.data() + l;
        for (const double length : plan.grid.lengths) {
            const double h = length * lanes.mesh_period[l];
            set_block(lanes, m, rows, diagonal * h, diagonal * diagonal * h * h, block);
            block += lanes.block_size;
        }
        set_block(lanes, m, rows, 0.0, 0.0, block);
    }
    return lanes;
}

#define GEARPOD_IMPLICIT_LANES(W, REAL)                                              \
    template ImplicitLanes<W> make_implicit_lanes<W>(const IntegrationPlan&, double, \
                                                     std::span<const dynamics::GearboxInputs>);
GEARPOD_FOR_DOUBLE_WIDTHS(GEARPOD_IMPLICIT_LANES)
#undef GEARPOD_IMPLICIT_LANES

}  // namespace gearpod::lockstep
