// Checks gearboxes with worn flanks: quasi-static contact against springs with given gaps, kernels
// against gaps of the same size, and the independence of lanes.
#include "gears/flank_gaps.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"
#include "stiffness/gapped_mesh.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_wear {

using test::LiangTrain;
using test::TianGearbox;

constexpr double kReach = 60e-6;
const std::vector<double> kDepths{0.0, 2e-6, 20e-6, 0.0, 5e-6, 1e-6, 10e-6, 40e-6};

stiffness::GappedMesh worn_mesh(const gears::MeshGeometry& geometry,
                                const stiffness::Material& steel, stiffness::Profile profile,
                                int worn_gear) {
    stiffness::FlankGaps gaps{geometry, {}, {}, kReach};
    gaps.wear.emplace(geometry, worn_gear);
    return {std::make_unique<stiffness::AdditiveMesh>(geometry, steel, profile), 0, gaps, 4e3, 1};
}

IntegrationPlan with_teeth(IntegrationPlan plan, const PairSet& pairs,
                           const std::vector<int>& worn) {
    plan.mesh_law = dynamics::MeshLaw::unilateral;
    plan.nodes = tabulate(pairs, plan.grid, dynamics::mesh_damping(plan.layout));
    add_tooth_pairs(pairs, plan.grid, plan.nodes, worn);
    return plan;
}

// Liang's train with worn sun or planets: the flanks between sun and planets have gaps.
struct WornTrain {
    const LiangTrain& base = LiangTrain::instance();
    stiffness::GappedMesh sun_planet =
        worn_mesh(base.sun_mesh, base.steel, stiffness::Profile::root_circle, 1);
    PairSet pairs = base.pairs;

    WornTrain() {
        for (std::size_t n = 0; n < 4; ++n) {
            const double start = base.pairs.pitch_phase(PairId{n}) - sun_planet.pitch_position();
            pairs.mesh[n] = &sun_planet;
            pairs.start[n] = phase_in_period(start);
        }
    }

    IntegrationPlan plan(Integrator integrator, int steps,
                         const std::vector<int>& worn = {0, 1, 2, 3}) const {
        IntegrationPlan plan = base.plan(24, steps, dynamics::Motion::translational_torsional);
        plan.integrator = integrator;
        plan.grid = make_phase_grid(24, steps, contact_transitions(pairs));
        plan.grid.stage_nodes = stage_nodes(integrator);
        return with_teeth(std::move(plan), pairs, worn);
    }

    FaultCurves healthy() const { return {&pairs, {}, {}}; }
    FaultCurves worn(const std::vector<double>& depths) const {
        return {&pairs, {}, {}, machine::AlignedVector(depths.begin(), depths.end())};
    }
};

ToothErrors small_errors(const PairSet& pairs, std::size_t lanes, std::size_t first) {
    const auto of_eight = [=](std::size_t i) {
        return static_cast<double>(i / lanes * 8 + first + i % lanes);
    };
    return LiangTrain::tooth_errors(
        pairs, lanes,
        [=](std::size_t, std::size_t i) { return 1e-6 * std::sin(7.0 * of_eight(i)); },
        [=](std::size_t, std::size_t i) { return 1e-6 * std::cos(5.0 * of_eight(i)); });
}

constexpr int kMeshes = 2;

// Positions after some mesh periods from the equilibrium, [degree of freedom][lane].
template <int W>
machine::AlignedVector end_of(const IntegrationPlan& plan,
                              const std::vector<dynamics::GearboxInputs>& inputs,
                              const FaultCurves& faults) {
    TileState state = equilibrium_state(plan, inputs);
    MeshRecord record = make_record(plan, W, false);
    const auto integrate = make_mesh_integrator<W>(plan, inputs);
    for (int k = 0; k < kMeshes; ++k) {
        (*integrate)(FaultSchedule(plan, faults).all_overrides(k), state, record);
    }
    return state.q;
}

// Largest difference of a lane's positions, relative to the largest position.
double largest_difference(const machine::AlignedVector& a, std::size_t width_a,
                          const machine::AlignedVector& b, std::size_t width_b, std::size_t lane) {
    REQUIRE(a.size() / width_a == b.size() / width_b);
    double difference = 0.0, size = 0.0;
    for (std::size_t i = 0; i < a.size() / width_a; ++i) {
        const double own = b[i * width_b + lane];
        difference = std::max(difference, std::abs(a[i * width_a + lane] - own));
        size = std::max(size, std::abs(own));
    }
    return difference / size;
}

// Number of values of lane `a` of one tile that differ from those of lane `b` of another.
int differences(const TileResult& one, std::size_t a, std::size_t width_a, const TileResult& other,
                std::size_t b, std::size_t width_b) {
    int different = 0;
    const auto compare = [&](const machine::AlignedVector& x, const machine::AlignedVector& y) {
        REQUIRE(x.size() / width_a == y.size() / width_b);
        for (std::size_t i = 0; i < x.size() / width_a; ++i) {
            const bool same = x[i * width_a + a] == y[i * width_b + b];
            different += same ? 0 : 1;
        }
    };
    REQUIRE(one.content.size() == other.content.size());
    for (std::size_t k = 0; k < one.content.size(); ++k) {
        const auto record = [k](const TileResult& tile) -> const MeshRecord& {
            return tile.records[static_cast<std::size_t>(tile.content[k])];
        };
        compare(record(one).te, record(other).te);
        compare(record(one).acceleration, record(other).acceleration);
    }
    compare(one.contact_loss, other.contact_loss);
    return different;
}

// The loaded tooth pairs are springs with the gap of the corner contact and of the wear, which is
// proportional to the specific sliding; bisection finds the approach at which they carry the force.
TEST_CASE("Worn pinions and gears approach each other as springs with the gaps of their wear") {
    const TianGearbox& base = TianGearbox::instance();
    for (const int worn : {1, 2}) {
        const stiffness::GappedMesh mesh =
            worn_mesh(base.mesh, base.steel, stiffness::Profile::base_circle, worn);
        const PairSet pairs{{&mesh}, {0.31}, false};
        IntegrationPlan plan = base.plan(48, 48, Integrator::rk4);
        plan.grid = make_phase_grid(48, 48, contact_transitions(pairs));
        plan.grid.stage_nodes = stage_nodes(Integrator::rk4);
        plan = with_teeth(std::move(plan), pairs, {0});
        auto in = base.inputs();
        in.motor_torque_N_m = 100.0;
        in.load_torque_N_m = in.motor_torque_N_m * 48 / 19;
        const double force = in.motor_torque_N_m / base.pinion.base_radius();

        const double slope = std::tan(TianGearbox::kAngle), pitch = base.mesh.base_pitch(),
                     ratio = base.mesh.contact_ratio();
        const auto sliding = [&](double tau) {
            const double past = (tau - base.mesh.pitch_position()) * pitch;
            const double roll_1 = slope + past / base.pinion.base_radius(),
                         roll_2 = slope - past / base.gear.base_radius();
            return std::abs(roll_1 - roll_2) / (worn == 1 ? roll_1 : roll_2);
        };
        const double largest = std::max(sliding(0.0), sliding(ratio));
        const std::vector<dynamics::GearboxInputs> inputs(8, in);
        const FaultCurves faults{
            &pairs, {}, {}, machine::AlignedVector(kDepths.begin(), kDepths.end())};
        const TileResult tile = run_tile<8>(plan, inputs, faults, QuasiStaticSolution{});
        REQUIRE(tile.records.size() == 1);
        for (std::size_t l = 0; l < 8; ++l) {
            double engaged = 0.0, apart = 0.0;
            for (int sample = 0; sample < 48; ++sample) {
                struct Spring {
                    double k, gap;
                    bool on_path;
                };
                std::vector<Spring> springs;
                const double first = phase_in_period(sample / 48.0 - 0.31);
                for (double tau = first; tau < mesh.contact_ratio(); ++tau) {
                    double k = 0.0;
                    mesh.slice_stiffness(0, {&tau, 1}, tau, {&k, 1});
                    const double on_path = tau - mesh.path_begin();
                    const double shape = sliding(std::clamp(on_path, 0.0, ratio)) / largest;
                    springs.push_back({k,
                                       gears::corner_gap(base.mesh, on_path) + kDepths[l] * shape,
                                       on_path > 0.0 && on_path < ratio});
                }
                double low = 0.0, high = 1e-3;
                for (int i = 0; i < 200; ++i) {
                    const double d = 0.5 * (low + high);
                    double carried = 0.0;
                    for (const Spring& spring : springs) {
                        carried += spring.k * std::max(0.0, d - spring.gap);
                    }
                    (carried < force ? low : high) = d;
                }
                for (const Spring& spring : springs) {
                    engaged += spring.on_path ? 1.0 : 0.0;
                    apart += spring.on_path && low <= spring.gap ? 1.0 : 0.0;
                }
                const double expected = (low + 2.0 * force / 6.56e7) / base.pinion.base_radius();
                INFO("gear " << worn << ", lane " << l << ", sample " << sample);
                CHECK(tile.records[0].te[static_cast<std::size_t>(sample) * 8 + l] ==
                      Approx(expected).epsilon(1e-9));
            }
            CHECK(tile.contact_loss[l] == Approx(apart / engaged).margin(1e-12));
        }
        CHECK(tile.contact_loss[7] > 0.05);
    }
}

TEST_CASE("Wear acts in every kernel as gaps of the same size in all tooth pairs") {
    const WornTrain train;
    const auto inputs = LiangTrain::instance().spread(10.0);
    const FaultCurves worn = train.worn(kDepths);
    const auto in_gaps = [](IntegrationPlan plan, double depth) {
        for (std::size_t i = 0; i < plan.nodes.tooth_gap.size(); ++i) {
            plan.nodes.tooth_gap[i] += depth * plan.nodes.tooth_wear[i];
        }
        return plan;
    };
    const auto check = [&](const IntegrationPlan& plan, double tolerance) {
        const auto all = end_of<8>(plan, inputs, worn);
        const auto healthy = end_of<8>(plan, inputs, train.healthy());
        for (const std::size_t l : {0U, 2U, 7U}) {
            const auto expected = end_of<8>(in_gaps(plan, kDepths[l]), inputs, train.healthy());
            INFO(name(plan.integrator) << ", lane " << l);
            CHECK(largest_difference(all, 8, expected, 8, l) < tolerance);
            CHECK((largest_difference(all, 8, healthy, 8, l) == 0.0) == (kDepths[l] == 0.0));
        }
    };
    for (const Integrator integrator : all_integrators()) {
        check(train.plan(integrator, 2400), 1e-8);
    }
    const IntegrationPlan plan = train.plan(Integrator::rk4, 2400);
    const auto expected = end_of<8>(plan, inputs, worn);
    // Sixteen singles: the eight gearboxes twice.
    IntegrationPlan single = plan;
    single.precision = Precision::single_precision;
    auto twice = inputs;
    twice.insert(twice.end(), inputs.begin(), inputs.end());
    auto depths = kDepths;
    depths.insert(depths.end(), kDepths.begin(), kDepths.end());
    const auto singles = end_of<16>(single, twice, train.worn(depths));
    for (std::size_t l = 0; l < 8; ++l) {
        CHECK(largest_difference(singles, 16, expected, 8, l) < 1e-4);
    }
    // Constant excitation in a kernel for variable speed.
    Excitation speed;
    const machine::AlignedVector none(8, 0.0), one(8, 1.0);
    speed.speed = Fluctuation{none, one, none, none, {}, {}, {}};
    speed.input_degree =
        std::get<dynamics::PlanetaryLayout>(plan.layout).rotation_index(dynamics::sun);
    speed.rotation_m_s = one;
    TileState state = equilibrium_state(plan, inputs);
    MeshRecord record = make_record(plan, 8, false);
    const auto variable = make_excited_integrator<8>(plan, speed, inputs);
    for (int k = 0; k < kMeshes; ++k) {
        (*variable)(k, FaultSchedule(plan, worn).all_overrides(k), state, record);
    }
    for (std::size_t l = 0; l < 8; ++l) {
        CHECK(largest_difference(state.q, 8, expected, 8, l) < 1e-9);
    }
}

TEST_CASE("Worn gearboxes have the same bits alone and in a tile; wear of depth 0 changes none") {
    const WornTrain train;
    const auto inputs = LiangTrain::instance().spread(10.0);
    const IntegrationPlan plan = train.plan(Integrator::rk4, 1200);
    const Convergence rough{1e-4, 12};
    const ToothErrors errors = small_errors(train.pairs, 8, 0);
    const RecordedSpan span{.meshes = 4, .run_in_meshes = 1};
    const StaticSpan static_span{.meshes = 4, .motion_meshes = 4};
    const auto check = [&](const auto& with_errors) {
        const auto& solution = with_errors(&errors);
        const TileResult worn = run_tile<8>(plan, inputs, train.worn(kDepths), solution),
                         healthy = run_tile<8>(plan, inputs, train.healthy(), solution);
        for (std::size_t l = 0; l < 8; ++l) {
            INFO("lane " << l);
            CHECK((differences(worn, l, 8, healthy, l, 8) == 0) == (kDepths[l] == 0.0));
            if (l == 0 || l == 6) {
                const ToothErrors own = small_errors(train.pairs, 1, l);
                const TileResult alone = run_tile<1>(plan, std::span(inputs).subspan(l, 1),
                                                     train.worn({kDepths[l]}), with_errors(&own));
                CHECK(differences(worn, l, 8, alone, 0, 1) == 0);
            }
        }
    };
    check([&](const ToothErrors*) { return PeriodicSolution{rough}; });
    check([&](const ToothErrors* own) { return FullSolution{rough, span, own}; });
    check([&](const ToothErrors*) { return QuasiStaticSolution{}; });
    check([&](const ToothErrors* own) {
        StaticSpan with = static_span;
        with.tooth_errors = own;
        return QuasiStaticSolution{with};
    });
}

TEST_CASE("Only the pairs of a worn planet have gaps by wear") {
    const WornTrain train;
    const IntegrationPlan plan = train.plan(Integrator::rk4, 240, {2});
    double largest = 0.0;
    for (std::size_t i = 0; i < plan.nodes.tooth_wear.size(); ++i) {
        if (i % 8 == 2) {
            largest = std::max(largest, plan.nodes.tooth_wear[i]);
        } else {
            CHECK(plan.nodes.tooth_wear[i] == 0.0);
        }
    }
    CHECK(largest > 0.9);
    CHECK(train.plan(Integrator::rk4, 240, {}).nodes.tooth_wear.empty());
}

TEST_CASE("Strategies that need unchanged mesh periods refuse wear") {
    const WornTrain train;
    const auto inputs = LiangTrain::instance().spread(10.0);
    const IntegrationPlan plan = train.plan(Integrator::rk4, 1200);
    const ToothErrors errors = small_errors(train.pairs, 8, 0);
    const SpanStates states;
    const FaultCurves worn = train.worn(kDepths);
    CHECK_THROWS_AS(run_tile<8>(plan, inputs, worn, SuperposedSolution{errors, {}, {}}),
                    std::invalid_argument);
    CHECK_THROWS_AS(run_tile<8>(plan, inputs, worn, FaultPerturbation{states}),
                    std::invalid_argument);
    CHECK_THROWS_AS(
        run_tile<8>(train.plan(Integrator::rk4, 1200, {}), inputs, worn, PeriodicSolution{}),
        std::invalid_argument);
}

}  // namespace gearpod::lockstep::test_wear
