// Checks quasi-static tiles against closed forms of the planets' load paths and a dense solver.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/strategies/solution.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_quasi_static_solution {

using test::LiangTrain;

constexpr auto kTorsional = dynamics::Motion::torsional;
constexpr auto kFull = dynamics::Motion::translational_torsional;

std::vector<dynamics::GearboxInputs> lanes_of(const dynamics::PlanetaryInputs& in, int lanes) {
    return std::vector<dynamics::GearboxInputs>(static_cast<std::size_t>(lanes), in);
}

// The realizations of a tile of eight, recomputed W at a time.
template <int W>
void check_lanes(const IntegrationPlan& plan, const std::vector<dynamics::GearboxInputs>& inputs,
                 const std::vector<double>& depths, const TileResult& eight) {
    for (std::size_t first = 0; first < 8; first += W) {
        const auto depth = depths.begin() + static_cast<std::ptrdiff_t>(first);
        const TileResult tile = run_tile<W>(
            plan, std::span(inputs).subspan(first, W),
            LiangTrain::instance().ring_side_cracks({depth, depth + W}), QuasiStaticSolution{});
        for (std::size_t k = 0; k < 31; ++k) {
            const auto& own = tile.records[static_cast<std::size_t>(tile.content[k])].te;
            const auto& all = eight.records[static_cast<std::size_t>(eight.content[k])].te;
            for (std::size_t i = 0; i < own.size(); ++i) {
                CHECK(own[i] == all[8 * (i / W) + first + i % W]);
            }
        }
    }
}

// Stiffness of all pairs at a sample.
std::vector<double> at_sample(const IntegrationPlan& plan, int sample) {
    for (std::size_t i = 0; i < plan.grid.steps.size(); ++i) {
        if (plan.grid.steps[i].sample == sample) {
            const auto from =
                plan.nodes.stiffness.begin() +
                static_cast<std::ptrdiff_t>(i * 3 * static_cast<std::size_t>(plan.nodes.pairs));
            return {from, from + plan.nodes.pairs};
        }
    }
    return {};
}

// Approach of sun and carrier along the line of action. Each planet is a path of two springs in
// series; the paths are parallel, in series with the ring's support.
double path_stiffness(double sun_mesh, double ring_mesh) {
    return sun_mesh == 0.0 || ring_mesh == 0.0 ? 0.0 : 1.0 / (1.0 / sun_mesh + 1.0 / ring_mesh);
}

double transmission_error(const std::vector<double>& k, double support_N_m) {
    const auto& train = LiangTrain::instance();
    const double force = 429.0 / train.sun.base_radius();
    double paths = 0.0;
    for (std::size_t n = 0; n < 4; ++n) {
        paths += path_stiffness(k[n], k[4 + n]);
    }
    return (force / paths + force / support_N_m) / train.sun.base_radius();
}

void set_pair(IntegrationPlan& plan, int pair, double stiffness) {
    for (std::size_t i = static_cast<std::size_t>(pair); i < plan.nodes.stiffness.size();
         i += static_cast<std::size_t>(plan.nodes.pairs)) {
        plan.nodes.stiffness[i] = stiffness;
    }
}

void set_error(IntegrationPlan& plan, int pair, double error) {
    plan.nodes.error.resize(plan.nodes.stiffness.size());
    plan.nodes.error_rate.resize(plan.nodes.stiffness.size());
    for (std::size_t i = static_cast<std::size_t>(pair); i < plan.nodes.error.size();
         i += static_cast<std::size_t>(plan.nodes.pairs)) {
        plan.nodes.error[i] = error;
    }
}

TEST_CASE("The torsional TE is that of springs in series and parallel at every phase") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(24, 24, kTorsional);
    const TileResult tile =
        run_tile<1>(plan, lanes_of(train.inputs(), 1), train.no_fault(1), QuasiStaticSolution{});
    REQUIRE(tile.records.size() == 1);
    CHECK(tile.records[0].acceleration.empty());
    CHECK(tile.content == std::vector<int>{0});
    for (int sample = 0; sample < 24; ++sample) {
        CHECK(tile.records[0].te[static_cast<std::size_t>(sample)] ==
              Approx(transmission_error(at_sample(plan, sample), 1e8)).epsilon(1e-11));
    }
}

TEST_CASE("The full model's equilibrium matches a dense orthogonal decomposition") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(12, 12, kFull, false);
    const auto inputs = LiangTrain::instance().spread(1.0);
    const TileResult tile = run_tile<8>(plan, inputs, train.no_fault(8),
                                        QuasiStaticSolution{StaticPattern{.with_motion = true}});
    const std::size_t degrees = 21;
    for (int sample = 0; sample < 12; ++sample) {
        for (std::size_t l = 0; l < 8; ++l) {
            const Eigen::VectorXd q = dynamics::static_equilibrium(
                dynamics::assemble(plan.layout, inputs[l], at_sample(plan, sample)));
            for (std::size_t d = 0; d < degrees; ++d) {
                const std::size_t at = (static_cast<std::size_t>(sample) * degrees + d) * 8 + l;
                CHECK(tile.records[0].motion[at] ==
                      Approx(q(static_cast<Eigen::Index>(d))).margin(1e-10 * q.norm()));
            }
        }
    }
}

TEST_CASE(
    "The twist of a fixed-shaft gearbox is that of its mesh, its bearings and its couplings") {
    dynamics::FixedShaftLayout layout;
    layout.base_radius_m[dynamics::pinion] = 0.0283;
    layout.base_radius_m[dynamics::gear] = 0.0716;
    dynamics::FixedShaftInputs in;
    for (const auto g : {dynamics::pinion, dynamics::gear}) {
        in.mass_kg[g] = in.inertia_kg_m2[g] = 1.0;
        in.bearing_stiffness_N_m[g] = 6.56e7;
        in.coupling_stiffness_N_m_rad[g] = 4.4e4;
    }
    in.motor_inertia_kg_m2 = in.load_inertia_kg_m2 = 0.01;
    in.motor_torque_N_m = 11.9;
    in.load_torque_N_m = 11.9 * 0.0716 / 0.0283;
    in.mesh_period_s = 1e-3;
    IntegrationPlan plan;
    plan.layout = layout;
    plan.grid = make_phase_grid(4, 4, {});
    plan.nodes.pairs = 1;
    plan.nodes.stiffness.assign(12, 6e8);
    plan.nodes.damping_shape.assign(12, 0.0);
    plan.te_weight.assign(8, 0.0);
    plan.te_weight[dynamics::u_m] = 1.0;
    plan.te_weight[dynamics::u_b] = -1.0;
    const std::vector<dynamics::GearboxInputs> inputs{in};
    const TileResult tile =
        run_tile<1>(plan, inputs, LiangTrain::instance().no_fault(1), QuasiStaticSolution{});
    const double force = 11.9 / 0.0283;
    const double compliance =
        1.0 / 6e8 + 2.0 / 6.56e7 + 0.0283 * 0.0283 / 4.4e4 + 0.0716 * 0.0716 / 4.4e4;
    for (const double te : tile.records[0].te) {
        CHECK(te == Approx(force * compliance).epsilon(1e-11));
    }
}

TEST_CASE(
    "A planet whose mesh is broken carries no load; a train without teeth has no equilibrium") {
    const auto& train = LiangTrain::instance();
    IntegrationPlan plan = train.plan(6, 6, kTorsional);
    set_pair(plan, 1, 0.0);  // one side of planet 2: its other side supports it
    set_pair(plan, 2, 0.0);  // both sides of planet 3: without support and without load
    set_pair(plan, 6, 0.0);
    const auto inputs = lanes_of(train.inputs(), 1);
    const TileResult broken = run_tile<1>(plan, inputs, train.no_fault(1), QuasiStaticSolution{});
    CHECK(broken.status[0] == LaneStatus::ok);
    for (int sample = 0; sample < 6; ++sample) {
        CHECK(broken.records[0].te[static_cast<std::size_t>(sample)] ==
              Approx(transmission_error(at_sample(plan, sample), 1e8)).epsilon(1e-10));
    }
    for (const int pair : {0, 3}) {
        set_pair(plan, pair, 0.0);
    }
    const TileResult none = run_tile<1>(plan, inputs, train.no_fault(1), QuasiStaticSolution{});
    CHECK(none.status[0] == LaneStatus::diverged);
    CHECK(std::isnan(none.records[0].te[0]));
}

TEST_CASE(
    "A lane without equilibrium leaves its neighbours' bits unchanged, for any number of lanes") {
    const auto& train = LiangTrain::instance();
    const std::vector<double> depths{0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 4.28e-3, 6e-3, 8.5e-3};
    for (const auto motion : {kTorsional, kFull}) {
        const IntegrationPlan plan = train.plan(24, 24, motion, false);
        auto inputs = LiangTrain::instance().spread(1.0);
        const auto faults = train.ring_side_cracks(depths);
        const TileResult wide = run_tile<8>(plan, inputs, faults, QuasiStaticSolution{});
        CHECK(wide.content.size() == 31);
        CHECK(wide.status == std::vector(8, LaneStatus::ok));
        check_lanes<4>(plan, inputs, depths, wide);
        check_lanes<1>(plan, inputs, depths, wide);
        std::get<dynamics::PlanetaryInputs>(inputs[3]).support_stiffness_N_m = 0.0;
        const TileResult unsupported = run_tile<8>(plan, inputs, faults, QuasiStaticSolution{});
        for (std::size_t r = 0; r < wide.records.size(); ++r) {
            for (std::size_t i = 0; i < wide.records[r].te.size(); ++i) {
                if (i % 8 == 3) {
                    CHECK(std::isnan(unsupported.records[r].te[i]));
                } else {
                    CHECK(unsupported.records[r].te[i] == wide.records[r].te[i]);
                }
            }
        }
        CHECK(unsupported.status[3] == LaneStatus::diverged);
    }
}

TEST_CASE("A crack increases the twist of the train while its tooth carries load, and only then") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(24, 24, kTorsional);
    const TileResult tile =
        run_tile<8>(plan, lanes_of(train.inputs(), 8),
                    train.ring_side_cracks({0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 3.5e-3, 4e-3, 4.28e-3}),
                    QuasiStaticSolution{});
    REQUIRE(tile.records.size() > 1);
    const auto& healthy = tile.records[0].te;
    double before = 0.0;
    for (std::size_t l = 0; l < 8; ++l) {
        double more = 0.0;
        for (const int id : tile.content) {
            const auto& te = tile.records[static_cast<std::size_t>(id)].te;
            for (std::size_t i = l; i < te.size(); i += 8) {
                CHECK(te[i] >= healthy[i]);
                more = std::max(more, te[i] - healthy[i]);
            }
        }
        CHECK((l == 0 ? more == 0.0 : more > before));
        before = more;
    }
    // Meshes 0 and 1, which a contact ratio of 1.9 covers, and at most a third.
    CHECK(std::count(tile.content.begin(), tile.content.end(), 0) >= 28);
}

TEST_CASE("Static errors redistribute the load, separate meshes and load back flanks") {
    // By bisection: the load of path n is K_n (x - e_n) if positive, and with backlash K_n (x - e_n
    // + 4 b) if negative, for an approach x and the sum e_n of its two meshes' errors.
    const auto& train = LiangTrain::instance();
    const double force = 429.0 / train.sun.base_radius();
    const auto paths_force = [&](const std::vector<double>& k, const std::vector<double>& e,
                                 double gaps, double x) {
        double sum = 0.0;
        for (std::size_t n = 0; n < 4; ++n) {
            const double front = x - e[n], back = front + gaps;
            sum += path_stiffness(k[n], k[4 + n]) * (front > 0.0 ? front : std::min(back, 0.0));
        }
        return sum;
    };
    const double backlash = 20e-6;
    for (const double size : {0.5e-6, 30e-6, 200e-6}) {
        for (const bool two_sided : {false, true}) {
            IntegrationPlan plan = train.plan(6, 6, kTorsional);
            plan.mesh_law = dynamics::MeshLaw::separating;
            set_error(plan, 1, size);
            set_error(plan, 5, 0.5 * size);
            set_error(plan, 2, -0.3 * size);
            const std::vector<double> e{0.0, 1.5 * size, -0.3 * size, 0.0};
            auto in = train.inputs();
            in.backlash_m = two_sided ? backlash : dynamics::kNoBackContact;
            const TileResult tile =
                run_tile<1>(plan, lanes_of(in, 1), train.no_fault(1), QuasiStaticSolution{});
            REQUIRE(tile.status[0] == LaneStatus::ok);
            for (int sample = 0; sample < 6; ++sample) {
                const auto k = at_sample(plan, sample);
                double low = -1e-3, high = 1e-3;
                for (int i = 0; i < 100; ++i) {
                    const double x = 0.5 * (low + high);
                    const double gaps = two_sided ? 2.0 * backlash : INFINITY;
                    (paths_force(k, e, gaps, x) < force ? low : high) = x;
                }
                const double expected = (low + force / 1e8) / train.sun.base_radius();
                INFO("error " << size << ", two-sided " << two_sided);
                CHECK(tile.records[0].te[static_cast<std::size_t>(sample)] ==
                      Approx(expected).epsilon(1e-7));
            }
        }
    }
}

}  // namespace gearpod::lockstep::test_quasi_static_solution
