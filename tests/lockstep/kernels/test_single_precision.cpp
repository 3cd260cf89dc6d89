// Checks single precision: its loss of accuracy, and equal bits for any number of lanes.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/numbers.hpp"

namespace gearpod::lockstep::test_single_precision {

using test::LiangTrain;

constexpr auto kFull = dynamics::Motion::translational_torsional;
const std::vector<double> kDepths{0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 4.28e-3, 6e-3, 8.5e-3,
                                  0.0, 1.5e-3, 2e-3, 4e-3, 3e-3, 4.28e-3, 5e-3, 7e-3};

IntegrationPlan by(Integrator integrator, IntegrationPlan plan) {
    plan.integrator = integrator;
    plan.grid.stage_nodes = stage_nodes(integrator);
    plan.nodes =
        tabulate(LiangTrain::instance().pairs, plan.grid, dynamics::mesh_damping(plan.layout));
    return plan;
}

IntegrationPlan single(IntegrationPlan plan) {
    plan.precision = Precision::single_precision;
    return plan;
}

constexpr PeriodicSolution kSolution{.convergence = {.tolerance = 1e-5}};

template <int W>
TileResult tile(const IntegrationPlan& plan, const std::vector<dynamics::GearboxInputs>& inputs,
                std::size_t first, const Solution& solution = kSolution) {
    const auto depth = kDepths.begin() + static_cast<std::ptrdiff_t>(first);
    return run_tile<W>(plan, std::span(inputs).subspan(first, W),
                       LiangTrain::instance().ring_side_cracks({depth, depth + W}), solution);
}

// Lane `lane` of all records, in the order of the pattern.
std::vector<double> unrolled(const TileResult& tile, machine::AlignedVector MeshRecord::*member,
                             std::size_t lane, std::size_t width) {
    std::vector<double> all;
    for (const int id : tile.content) {
        const auto own =
            test::every(width, tile.records[static_cast<std::size_t>(id)].*member, lane);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

template <int W>
void check_width(const IntegrationPlan& plan, const std::vector<dynamics::GearboxInputs>& inputs,
                 const TileResult& wide) {
    for (std::size_t first = 0; first < 16; first += W) {
        const TileResult narrow = tile<W>(plan, inputs, first);
        for (std::size_t l = 0; l < W; ++l) {
            for (const auto member : {&MeshRecord::acceleration, &MeshRecord::te}) {
                CHECK(unrolled(narrow, member, l, W) == unrolled(wide, member, first + l, 16));
            }
        }
    }
}

// Root mean square of a - b over that of b about its mean.
double relative_rms(const std::vector<double>& a, const std::vector<double>& b) {
    const std::vector<double> mean(b.size(), test::mean_of(b));
    return test::rms_of(test::difference(a, b)) / test::rms_of(test::difference(b, mean));
}

TEST_CASE("Sixteen singles, eight, four and one give the same bits, on every instruction set") {
    const auto integrator = GENERATE(Integrator::rk4, Integrator::central_difference);
    const IntegrationPlan plan =
        single(by(integrator, LiangTrain::instance().plan(24, 1200, kFull)));
    const auto inputs = LiangTrain::instance().spread(10.0, 16, 0.025);
    const TileResult wide = tile<16>(plan, inputs, 0);
    CHECK(wide.status == std::vector(16, LaneStatus::ok));
    check_width<8>(plan, inputs, wide);
    check_width<4>(plan, inputs, wide);
    check_width<1>(plan, inputs, wide);
    test::for_each_instruction_set([&] {
        const TileResult other = tile<16>(plan, inputs, 0);
        for (std::size_t l = 0; l < 16; ++l) {
            CHECK(unrolled(other, &MeshRecord::te, l, 16) ==
                  unrolled(wide, &MeshRecord::te, l, 16));
            CHECK(unrolled(other, &MeshRecord::acceleration, l, 16) ==
                  unrolled(wide, &MeshRecord::acceleration, l, 16));
        }
    });
}

TEST_CASE("Single precision keeps sensor signal and transmission error close to double precision") {
    // Liang's own speed, where a step changes a displacement by 1e-4 of itself, and ten times it,
    // where a mesh period reduces the distance to the periodic orbit less. The convergence
    // tolerance of 1e-5 then has the largest effect.
    const auto integrator = GENERATE(Integrator::rk4, Integrator::central_difference);
    const int steps = integrator == Integrator::rk4 ? 5200 : 10400;
    for (const auto& [speedup, allowed] : {std::pair{1.0, 1e-4}, std::pair{10.0, 5e-4}}) {
        const IntegrationPlan plan =
            by(integrator, LiangTrain::instance().plan(48, speedup > 1.0 ? 1200 : steps, kFull));
        const auto inputs = LiangTrain::instance().spread(speedup, 16, 0.025);
        const TileResult exact = tile<8>(plan, inputs, 0, PeriodicSolution{});
        const TileResult rounded = tile<8>(single(plan), inputs, 0);
        CHECK(rounded.status == std::vector(8, LaneStatus::ok));
        for (std::size_t l = 0; l < 8; ++l) {
            for (const auto member : {&MeshRecord::acceleration, &MeshRecord::te}) {
                const double error =
                    relative_rms(unrolled(rounded, member, l, 8), unrolled(exact, member, l, 8));
                CHECK(error < allowed);
                CHECK(error > 1e-9);  // they are not the doubles
            }
        }
    }
}

TEST_CASE(
    "Small steps are not lost in single-precision rounding: an undamped mode follows its cosine") {
    const auto& train = LiangTrain::instance();
    dynamics::PlanetaryInputs in = train.inputs();
    std::fill(std::begin(in.bearing_damping_N_s_m), std::end(in.bearing_damping_N_s_m), 0.0);
    std::fill(std::begin(in.force_N), std::end(in.force_N), 0.0);
    in.support_damping_N_s_m = in.mesh_damping = 0.0;
    in.mesh_period_s = 2e-3;
    const auto integrator = GENERATE(Integrator::rk4, Integrator::central_difference);
    IntegrationPlan plan = single(by(integrator, train.plan(10, 40000, kFull, false)));
    std::fill(plan.nodes.stiffness.begin(), plan.nodes.stiffness.end(), 1.5e9);
    const auto matrices = dynamics::assemble(plan.layout, in, std::vector<double>(8, 1.5e9));
    const dynamics::Modes modes = dynamics::modes(matrices.stiffness, matrices.mass);
    const dynamics::GearboxInputs inputs = in;
    for (const Eigen::Index mode : {1, 5}) {
        const Eigen::VectorXd shape = 1e-6 * modes.shapes.col(mode);
        TileState state = equilibrium_state(plan, std::span(&inputs, 1));
        std::copy(shape.begin(), shape.end(), state.q.begin());
        MeshRecord record = make_record(plan, 1, false);
        (*make_mesh_integrator<1>(plan, std::span(&inputs, 1)))({}, state, record);
        const double w = std::sqrt(modes.squares(mode));
        for (std::size_t d = 0; d < state.q.size(); ++d) {
            const double expected =
                shape(static_cast<Eigen::Index>(d)) * std::cos(w * in.mesh_period_s);
            CHECK(state.q[d] == Approx(expected).margin(2e-6 * shape.cwiseAbs().maxCoeff()));
        }
    }
}

TEST_CASE("Two methods alone support single precision, and doubles have at most eight lanes") {
    const auto& train = LiangTrain::instance();
    const auto inputs = LiangTrain::instance().spread(10.0, 16, 0.025);
    IntegrationPlan plan = train.plan(24, 1200, kFull);
    CHECK_THROWS_AS(make_mesh_integrator<16>(plan, inputs), std::invalid_argument);
    for (const Integrator other : {Integrator::newmark, Integrator::sdirk3, Integrator::rk5}) {
        plan.integrator = other;
        CHECK_THROWS_AS(make_mesh_integrator<16>(single(plan), inputs), std::invalid_argument);
    }
}

}  // namespace gearpod::lockstep::test_single_precision
