// Checks single tooth pairs: they add up to the total of their gear pair, forwards and backwards,
// healthy and faulty.
#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/strategies/solution.hpp"
#include "stiffness/coupled_mesh.hpp"
#include "stiffness/faults/losses.hpp"
#include "stiffness/faults/pitting.hpp"
#include "stiffness/square_wave_mesh.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/lockstep/tian_gearbox.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_tooth_pairs {

using test::LiangTrain;

PhaseGrid grid_for(const PairSet& pairs) {
    return make_phase_grid(10, 40, contact_transitions(pairs));
}

// Checks the faulty tooth pairs of the first passage at all stages of meshes 0..3 against the
// totals.
void check_sum(const PairSet& pairs, const stiffness::FaultyMesh& faulty) {
    const PhaseGrid grid = grid_for(pairs);
    double least = 1e300, most = 0.0;
    for (int k = 0; k < 4; ++k) {
        const double start = pairs.start[0];
        const StepPositions steps = overlapping_steps(grid, k, start, faulty.duration());
        if (steps.middle.empty()) {
            continue;
        }
        const auto total = faulty_totals(pairs.curve(PairId{0}), faulty, pairs.reversed, steps).all;
        const auto each = faulty_tooth_pairs(pairs, faulty, {PairId{0}, k, start}, steps, 3);
        REQUIRE(each.size() == 3 * total.size());
        for (std::size_t i = 0; i < total.size(); ++i) {
            const double sum = each[3 * i] + each[3 * i + 1] + each[3 * i + 2];
            CHECK(sum == Approx(total[i]).epsilon(1e-7).margin(10.0));
            least = std::min(least, total[i]);
            most = std::max(most, total[i]);
        }
    }
    CHECK(most > least);
}

TEST_CASE(
    "Tooth pairs share their gear pair's stiffness and are in contact during their engagement") {
    const auto& train = LiangTrain::instance();
    for (const bool reversed : {false, true}) {
        PairSet pairs = train.pairs;
        pairs.reversed = reversed;
        const PhaseGrid grid = grid_for(pairs);
        StiffnessNodes nodes = tabulate(pairs, grid, dynamics::MeshDamping::ratio);
        add_tooth_pairs(pairs, grid, nodes);
        REQUIRE(nodes.tooth_pairs == 2);
        std::size_t at = 0;
        for (const Step& step : grid.steps) {
            for (std::size_t node = 0; node < grid.stage_nodes.size(); ++node, ++at) {
                for (std::size_t pair = 0; pair < 8; ++pair) {
                    const double* own = &nodes.tooth_stiffness[at * 2 * 8 + pair];
                    CHECK(own[0] + own[8] == Approx(nodes.stiffness[at * 8 + pair]).epsilon(1e-12));
                    // Expected stiffness of the latest tooth pair, from the curve of a single tooth
                    // pair.
                    const double middle = step.phase + 0.5 * step.length;
                    const double ratio = pairs.curve(PairId{pair}).contact_ratio();
                    double begun = pairs.start[pair];
                    begun -= begun > middle ? 1.0 : 0.0;
                    const double since = step.phase + grid.stage_nodes[node] * step.length - begun;
                    const auto& mesh = pair < 4 ? train.sun_planet : train.ring_planet;
                    const double tau = std::clamp(reversed ? ratio - since : since, 0.0, ratio);
                    CHECK(own[0] == Approx(mesh.tooth_pair(tau)).epsilon(1e-9));
                    CHECK((own[8] > 0.0) == (middle - begun < ratio - 1.0));
                }
            }
        }
    }
}

TEST_CASE("Faulty tooth pairs add up to the faulty mesh, on one and on three neighbouring teeth") {
    const auto& train = LiangTrain::instance();
    const auto broken = stiffness::BrokenTooth().at(0.6);
    const auto reduced = stiffness::Reduction().at(0.3);
    const auto square = stiffness::SquareWaveMesh(2e8, 3e8, 1.6);
    stiffness::CoupledMeshOptions options;
    options.foundation = stiffness::FoundationModel::elastic_ring;
    options.body_radius_1_m = 0.013;
    options.body_radius_2_m = 0.020;
    const stiffness::CoupledMesh coupled(train.sun_mesh, train.steel,
                                         stiffness::Profile::root_circle, options);
    const stiffness::ToothPitting pits(train.sun_mesh, train.steel, stiffness::Profile::root_circle,
                                       1, {train.sun.pitch_radius(), 2e-3, 0.0, 3});
    const auto pitted = pits.at(pits.largest_size() / 2);
    const gears::Gear tall{60, false, 2e-3, LiangTrain::kAngle, 1.4, 1.65};
    const gears::MeshGeometry tall_mesh(tall, tall);  // three tooth pairs in contact
    options.body_radius_1_m = options.body_radius_2_m = 0.020;
    const stiffness::CoupledMesh three(tall_mesh, train.steel, stiffness::Profile::root_circle,
                                       options);
    REQUIRE(tall_mesh.contact_ratio() > 2.1);
    for (const bool reversed : {false, true}) {
        for (const double start : {0.0, 0.37}) {
            const auto check = [&](const stiffness::MeshStiffness& mesh,
                                   const stiffness::ToothFault& fault) {
                check_sum({{&mesh}, {start}, reversed}, *mesh.with_fault(fault));
            };
            for (const auto* fault : {broken.get(), reduced.get()}) {
                check(train.sun_planet, *fault);
                check(square, *fault);
                check(coupled, *fault);
                check(three, *fault);
            }
            check(train.sun_planet, *pitted);
            check(coupled, *pitted);
        }
    }
}

TEST_CASE("More simultaneous tooth pairs than supported are refused with their number") {
    struct Many : stiffness::MeshStiffness {
        double contact_ratio() const override { return 8.4; }
        double pitch_position() const override { return 4.2; }
        void total(std::span<const double>, double, std::span<double> k) const override {
            std::fill(k.begin(), k.end(), 1e8);
        }
        void share(std::span<const double>, double, std::span<double> share) const override {
            std::fill(share.begin(), share.end(), 0.1);
        }
        std::vector<double> transitions() const override { return {0.0, 0.4}; }
        std::unique_ptr<const stiffness::FaultyMesh> with_fault(
            const stiffness::ToothFault&) const override {
            return nullptr;
        }
    } many;
    const PairSet pairs{{&many}, {0.2}, false};
    const PhaseGrid grid = grid_for(pairs);
    StiffnessNodes nodes = tabulate(pairs, grid, dynamics::MeshDamping::ratio);
    CHECK_THROWS_WITH(add_tooth_pairs(pairs, grid, nodes),
                      Catch::Contains("9 tooth pairs of a gear pair touch at once"));
}

}  // namespace gearpod::lockstep::test_tooth_pairs

// Checks errors of single teeth: which teeth meet, and the resulting deflection under load.

namespace gearpod::lockstep::test_tooth_errors {

using test::LiangTrain;

// All gears of the train without errors: sun, ring, and both sides of each planet.
ToothErrors no_errors(const PairSet& pairs, std::size_t lanes) {
    return LiangTrain::tooth_errors(pairs, lanes, [](std::size_t, std::size_t) { return 0.0; });
}

IntegrationPlan error_plan(int samples, int steps, dynamics::Motion motion) {
    IntegrationPlan plan = LiangTrain::instance().plan(samples, steps, motion);
    plan.mesh_law = dynamics::MeshLaw::unilateral;
    add_tooth_pairs(LiangTrain::instance().pairs, plan.grid, plan.nodes);
    return plan;
}

TEST_CASE(
    "Equal errors of all teeth act as one error while a tooth pair is in contact, for both gears") {
    const auto& pairs = LiangTrain::instance().pairs;
    const IntegrationPlan plan = error_plan(24, 240, dynamics::Motion::torsional);
    ToothErrors errors = no_errors(pairs, 1);
    for (auto& gear : errors.gears) {
        std::fill(gear.error_m.begin(), gear.error_m.end(), 2e-6);
    }
    for (const int k : {-3, 0, 1000}) {
        for (const PairGaps& g : tooth_gaps(plan, errors, k)) {
            CHECK(g.gap == machine::AlignedVector(2, 4e-6));
            CHECK(g.growth == machine::AlignedVector(2, 0.0));
        }
    }
}

TEST_CASE("A tooth's error acts while it is in contact, and follows its slope along the flank") {
    const auto& train = LiangTrain::instance();
    const auto& pairs = train.pairs;
    const IntegrationPlan plan = error_plan(24, 240, dynamics::Motion::torsional);
    const double ratio = train.sun_planet.contact_ratio();
    const int tooth = 7;
    for (const bool on_sun : {false, true}) {
        ToothErrors errors = no_errors(pairs, 1);
        // Sun side of planet 2, or the sun.
        GearErrors& gear = errors.gears[on_sun ? 0 : 4];
        gear.error_m[tooth] = 3e-6;
        gear.slope_m.assign(gear.error_m.size(), 0.0);
        gear.slope_m[tooth] = 2e-6;
        const int first = errors.pairs[1].first[on_sun ? 0 : 1];
        for (int k = 0; k < 2 * gear.teeth; ++k) {
            const auto all = tooth_gaps(plan, errors, k);
            for (std::size_t s = 0; s < plan.grid.steps.size(); ++s) {
                const Step& step = plan.grid.steps[s];
                const double middle = k + step.phase + 0.5 * step.length;
                const double since = std::fmod(
                    middle - (tooth + first + pairs.start[1]) + 10.0 * gear.teeth, gear.teeth);
                double sum = 0.0;
                for (std::size_t j = 0; j < 2; ++j) {
                    const auto k_j = plan.nodes.tooth_stiffness[((3 * s + 1) * 2 + j) * 8 + 1];
                    const double gap = tooth_gap(plan, all, PairId{1}, static_cast<int>(s), 1,
                                                 static_cast<int>(j), LaneId{0});
                    sum += k_j > 0.0 ? gap : 0.0;
                }
                // The sun drives: contact on its flank moves from the root to the tip.
                const double place = (on_sun ? 1.0 : -1.0) * (since / ratio - 0.5);
                CHECK(sum == Approx(since < ratio ? 3e-6 + place * 2e-6 : 0.0).margin(1e-15));
            }
        }
    }
}

TEST_CASE(
    "A sun tooth's error acts at one planet after the other, a ring tooth's in reverse order") {
    const auto& pairs = LiangTrain::instance().pairs;
    const IntegrationPlan plan = error_plan(24, 24, dynamics::Motion::torsional);
    for (const bool on_sun : {true, false}) {
        ToothErrors errors = no_errors(pairs, 1);
        errors.gears[on_sun ? 0 : 1].error_m[0] = 1e-6;
        const int teeth = on_sun ? 19 : 81;
        std::vector<double> met(4, -1.0);  // phase at which the contact of the tooth begins
        for (int k = 0; k < teeth; ++k) {
            const auto all = tooth_gaps(plan, errors, k);
            const auto before = tooth_gaps(plan, errors, k - 1);
            const int last_step = static_cast<int>(plan.grid.steps.size()) - 1;
            for (std::size_t n = 0; n < 4; ++n) {
                const auto pair = n + (on_sun ? 0 : 4);
                // Latest tooth pair of the last node.
                const auto youngest = [&](const auto& overrides) {
                    return tooth_gap(plan, overrides, PairId{pair}, last_step, 2, 0, LaneId{0});
                };
                if (youngest(before) == 0.0 && youngest(all) > 0.0) {
                    met[n] = k + pairs.start[pair];
                }
            }
        }
        // Planets a quarter turn apart: Z / 4 meshes from one to the next.
        for (std::size_t n = 1; n < 4; ++n) {
            const double turn =
                on_sun ? static_cast<double>(n) / 4.0 : 1.0 - static_cast<double>(n) / 4.0;
            CHECK(met[n] - met[0] == Approx(turn * teeth));
        }
    }
}

TEST_CASE(
    "At low speed a train follows its tooth errors by the stiffness of the planets' load paths") {
    const auto& train = LiangTrain::instance();
    const auto sun_mesh = stiffness::SquareWaveMesh::constant(3e8);
    const auto ring_mesh = stiffness::SquareWaveMesh::constant(5e8);
    PairSet pairs = train.pairs;
    for (std::size_t pair = 0; pair < 8; ++pair) {
        pairs.mesh[pair] = pair < 4 ? &sun_mesh : &ring_mesh;
    }
    IntegrationPlan plan = error_plan(12, 12, dynamics::Motion::torsional);
    plan.grid = make_phase_grid(12, 12, contact_transitions(pairs));
    plan.nodes = tabulate(pairs, plan.grid, dynamics::MeshDamping::ratio);
    add_tooth_pairs(pairs, plan.grid, plan.nodes);
    ToothErrors errors = no_errors(pairs, 1);
    errors.gears[2].error_m[5] = 4e-6;  // planet 1, sun side
    FaultCurves faults;
    faults.pairs = &pairs;
    const dynamics::GearboxInputs in = train.inputs();
    const QuasiStaticSolution solution{StaticSpan{.meshes = 31, .tooth_errors = &errors}};
    const TileResult tile = run_tile<1>(plan, std::span(&in, 1), faults, solution);
    const double rise = 4e-6 / 4.0 / train.sun.base_radius();  // one path of four equal ones
    for (int k = 0; k < 31; ++k) {
        const auto& te =
            tile.records[static_cast<std::size_t>(tile.content[static_cast<std::size_t>(k)])].te;
        for (int i = 0; i < 12; ++i) {
            const double since = k + i / 12.0 - (5 + pairs.start[0]);
            const bool touches = since > -1e-9 && since < 1.0 - 1e-9;
            CHECK(te[static_cast<std::size_t>(i)] - tile.records[0].te[0] ==
                  Approx(touches ? rise : 0.0).margin(1e-9 * rise));
        }
    }
    plan.nodes.tooth_pairs = 0;
    CHECK_THROWS_AS(run_tile<1>(plan, std::span(&in, 1), faults, solution), std::invalid_argument);
}

TEST_CASE("Integrated with tooth errors, lanes keep their bits; without errors nothing changes") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = error_plan(12, 1200, dynamics::Motion::torsional);
    ToothErrors errors = no_errors(train.pairs, 8);
    const FaultCurves faults =
        train.ring_side_cracks({0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 3.5e-3, 4e-3, 4.28e-3});
    const std::vector<dynamics::GearboxInputs> inputs(8, train.inputs(10.0));
    FullSolution solution{.span = {.meshes = 4}};
    const TileResult plain = run_tile<8>(plan, inputs, faults, solution);
    solution.tooth_errors = &errors;
    const TileResult none = run_tile<8>(plan, inputs, faults, solution);
    solution.span.run_in_meshes = 3;
    for (std::size_t g = 0; g < errors.gears.size(); ++g) {
        for (std::size_t i = 0; i < errors.gears[g].error_m.size(); ++i) {
            errors.gears[g].error_m[i] = 1e-6 * std::sin(static_cast<double>(13 * g + i));
        }
    }
    const TileResult wide = run_tile<8>(plan, inputs, faults, solution);
    for (std::size_t r = 0; r < plain.records.size(); ++r) {
        CHECK(none.records[r].te == plain.records[r].te);
        CHECK(none.records[r].acceleration == plain.records[r].acceleration);
    }
    for (const std::size_t l : {0U, 5U}) {
        ToothErrors own = no_errors(train.pairs, 1);
        for (std::size_t g = 0; g < own.gears.size(); ++g) {
            for (std::size_t i = 0; i < own.gears[g].error_m.size(); ++i) {
                own.gears[g].error_m[i] = errors.gears[g].error_m[8 * i + l];
            }
        }
        FaultCurves one = train.no_fault(1);
        one.pattern = faults.pattern;
        one.curve[0][0] = faults.curve[0][l];
        solution.tooth_errors = &own;
        const TileResult narrow = run_tile<1>(plan, std::span(inputs).first(1), one, solution);
        for (std::size_t r = 1; r < narrow.records.size(); ++r) {
            for (std::size_t i = 0; i < 12; ++i) {
                CHECK(narrow.records[r].te[i] == wide.records[r].te[8 * i + l]);
                CHECK(wide.records[r].te[8 * i + l] != plain.records[r].te[8 * i + l]);
            }
        }
    }
}

TEST_CASE(
    "Two tooth pairs share a static load by their gaps, and the pair with the larger gap can lose "
    "contact") {
    const auto& gearbox = test::TianGearbox::instance();
    constexpr double k = 3e8, kRatio = 1.5;
    const stiffness::SquareWaveMesh mesh(k, 2.0 * k, kRatio);
    const PairSet pairs{{&mesh}, {0.0}, false};
    IntegrationPlan plan = gearbox.plan(16, 16, Integrator::rk4);
    plan.mesh_law = dynamics::MeshLaw::unilateral;
    plan.grid = make_phase_grid(16, 16, contact_transitions(pairs));
    plan.nodes = tabulate(pairs, plan.grid, dynamics::MeshDamping::proportional);
    add_tooth_pairs(pairs, plan.grid, plan.nodes);
    const Eigen::VectorXd row = dynamics::mesh_row(plan.layout, PairId{0});
    plan.te_weight.assign(row.begin(), row.end());  // the deflection itself

    auto in = gearbox.inputs();
    in.load_torque_N_m = in.motor_torque_N_m * 48 / 19;
    const double force = in.motor_torque_N_m / gearbox.pinion.base_radius();
    const std::vector<dynamics::GearboxInputs> inputs(8, in);
    // Pinion tooth 3 has a gap in lanes 1 to 7; the largest is more than the pair's deflection.
    ToothErrors errors{
        {{19, machine::AlignedVector(19 * 8, 0.0)}, {48, machine::AlignedVector(48 * 8, 0.0)}},
        fixed_shaft_teeth()};
    for (std::size_t l = 0; l < 8; ++l) {
        errors.gears[0].error_m[3 * 8 + l] = 0.3 * static_cast<double>(l) * force / k;
    }
    // The tooth has also lost half of its stiffness in lanes 2 and 6.
    const stiffness::BrokenTooth family;
    FaultCurves faults{&pairs, shaft_fault_pattern(pairs, 19), {{}}};
    faults.curve[0].resize(8);
    for (FaultPassage& passage : faults.pattern.passages) {
        passage.start += 3.0;
    }
    for (const std::size_t l : {2U, 6U}) {
        faults.curve[0][l] = stiffness::faulty_mesh(mesh, family.at(0.5));
    }
    const TileResult tile =
        run_tile<8>(plan, inputs, faults,
                    QuasiStaticSolution{StaticSpan{.meshes = 7, .tooth_errors = &errors}});
    int alone = 0;
    for (int mesh_period = 2; mesh_period < 6; ++mesh_period) {
        const auto& te = tile.records[static_cast<std::size_t>(
                                          tile.content[static_cast<std::size_t>(mesh_period)])]
                             .te;
        for (int i = 1; i < 16; ++i) {
            const double since = mesh_period + i / 16.0 - 3.0;  // of tooth 3
            if (std::abs(since - std::round(2.0 * since) / 2.0) < 1e-9) {
                continue;  // exactly at a transition
            }
            for (std::size_t l = 0; l < 8; ++l) {
                const bool touches = since > 0.0 && since < kRatio;
                const bool two = i < 8;
                const double own = faults.curve[0][l] ? 0.5 * k : k;
                const double gap = errors.gears[0].error_m[3 * 8 + l];
                double expected = force / (two ? 2.0 * k : k);
                if (touches && !two) {
                    expected = gap + force / own;
                } else if (touches) {
                    const double both = (force + own * gap) / (own + k);
                    expected = both > gap ? both : force / k;
                    alone += both > gap ? 0 : 1;
                }
                INFO("since " << since << ", lane " << l);
                CHECK(te[static_cast<std::size_t>(i) * 8 + l] == Approx(expected).epsilon(1e-9));
            }
        }
    }
    CHECK(alone > 10);
}

}  // namespace gearpod::lockstep::test_tooth_errors
