// Checks tiles: the healthy periodic orbit, the passage of a crack, and lanes that are independent
// of their neighbours.
#include "lockstep/integrators/facts.hpp"
#include "tests/lockstep/liang_train.hpp"
#include "tests/numbers.hpp"

namespace gearpod::lockstep::test_solution {

using test::every;
using test::LiangTrain;

constexpr auto kFull = dynamics::Motion::translational_torsional;

// Ten times the speed keeps the mesh period short; the disturbance then spans several periods.
constexpr double kSpeedup = 10.0;

// Acceleration and TE of lane `lane` over the whole pattern.
std::vector<double> unrolled(const TileResult& tile, std::size_t lane, std::size_t width) {
    std::vector<double> all;
    for (const int id : tile.content) {
        const MeshRecord& record = tile.records[static_cast<std::size_t>(id)];
        for (const auto* values : {&record.acceleration, &record.te}) {
            const auto one = every(width, *values, lane);
            all.insert(all.end(), one.begin(), one.end());
        }
    }
    return all;
}

const std::vector<double> kDepths{0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 4.28e-3, 6e-3, 8.5e-3};

// The realizations of a tile of eight, recomputed W at a time.
template <int W>
void check_lanes(const IntegrationPlan& plan, const std::vector<dynamics::GearboxInputs>& inputs,
                 const TileResult& eight) {
    for (std::size_t first = 0; first < 8; first += W) {
        const auto depth = kDepths.begin() + static_cast<std::ptrdiff_t>(first);
        const TileResult tile = run_tile<W>(
            plan, std::span(inputs).subspan(first, W),
            LiangTrain::instance().ring_side_cracks({depth, depth + W}), PeriodicSolution{});
        for (std::size_t l = 0; l < W; ++l) {
            CHECK(unrolled(tile, l, W) == unrolled(eight, first + l, 8));
        }
    }
}

TEST_CASE("Eight lanes, four and one give the same bits, on every instruction set") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(24, 1200, kFull);
    const auto inputs = LiangTrain::instance().spread(kSpeedup);
    const TileResult wide =
        run_tile<8>(plan, inputs, train.ring_side_cracks(kDepths), PeriodicSolution{});
    CHECK(wide.status == std::vector(8, LaneStatus::ok));
    check_lanes<4>(plan, inputs, wide);
    check_lanes<1>(plan, inputs, wide);
    test::for_each_instruction_set([&] {
        const TileResult other =
            run_tile<8>(plan, inputs, train.ring_side_cracks(kDepths), PeriodicSolution{});
        check_lanes<4>(plan, inputs, wide);
        for (std::size_t l = 0; l < 8; ++l) {
            CHECK(unrolled(other, l, 8) == unrolled(wide, l, 8));
        }
    });
}

constexpr int kSpan = 93;  // three passages of the faulty tooth

// Perturbation of the first W gearboxes from `first` on by cracks of these depths.
template <int W>
TileResult perturbation(const IntegrationPlan& plan,
                        const std::vector<dynamics::GearboxInputs>& inputs, std::size_t first) {
    const auto& train = LiangTrain::instance();
    const std::span<const dynamics::GearboxInputs> own = std::span(inputs).subspan(first, W);
    const Convergence convergence{1e-5, 5000};
    RecordedSpan span;
    span.meshes = kSpan;
    span.run_in_meshes = 8;
    span.options.states = true;
    const TileResult healthy =
        run_tile<W>(plan, own, train.no_fault(W), FullSolution{convergence, span});
    const auto depth = kDepths.begin() + static_cast<std::ptrdiff_t>(first);
    return run_tile<W>(plan, own, train.ring_side_cracks({depth, depth + W}),
                       FaultPerturbation{healthy.states, convergence});
}

// Acceleration and TE of the mesh periods that change in a lane, each after its number.
template <int W>
std::vector<double> changes(const TileResult& tile, std::size_t lane) {
    std::vector<double> all;
    for (std::size_t k = 0; k < tile.content.size(); ++k) {
        if (tile.content[k] == kUnchanged) {
            continue;
        }
        const MeshRecord& record = tile.records[static_cast<std::size_t>(tile.content[k])];
        if (std::isnan(record.te[lane])) {
            continue;
        }
        all.push_back(static_cast<double>(k));
        for (const auto* values : {&record.acceleration, &record.te}) {
            const auto one = every(W, *values, lane);
            all.insert(all.end(), one.begin(), one.end());
        }
    }
    return all;
}

// The perturbations by deeper cracks last longer. A gearbox without a crack has none.
TEST_CASE("The perturbation by a fault ends in each lane by itself") {
    const IntegrationPlan plan = LiangTrain::instance().plan(24, 1200, kFull);
    const auto inputs = LiangTrain::instance().spread(kSpeedup);
    const TileResult eight = perturbation<8>(plan, inputs, 0);
    CHECK(eight.status == std::vector(8, LaneStatus::ok));
    CHECK(changes<8>(eight, 0).empty());
    CHECK(changes<8>(eight, 7).size() > changes<8>(eight, 1).size());
    for (const std::size_t first : {0, 4}) {
        const TileResult four = perturbation<4>(plan, inputs, first);
        for (std::size_t l = 0; l < 4; ++l) {
            INFO(first + l);
            CHECK((changes<4>(four, l) == changes<8>(eight, first + l)));
        }
    }
    for (const std::size_t lane : {1, 4, 7}) {
        INFO(lane);
        CHECK((changes<1>(perturbation<1>(plan, inputs, lane), 0) == changes<8>(eight, lane)));
    }
}

TEST_CASE("A diverging lane is reported and its neighbours keep their bits") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(24, 1200, kFull);
    auto inputs = LiangTrain::instance().spread(kSpeedup);
    const auto faults = train.ring_side_cracks(kDepths);
    const TileResult before = run_tile<8>(plan, inputs, faults, PeriodicSolution{});
    std::get<dynamics::PlanetaryInputs>(inputs[3]).mass_kg[dynamics::sun] =
        1e-7;  // far too light for this step
    const TileResult after = run_tile<8>(plan, inputs, faults, PeriodicSolution{});
    for (std::size_t l = 0; l < 8; ++l) {
        if (l == 3) {
            CHECK(after.status[l] == LaneStatus::diverged);
            CHECK(std::isnan(after.records[0].te[l]));
        } else {
            CHECK(after.status[l] == LaneStatus::ok);
            CHECK(unrolled(after, l, 8) == unrolled(before, l, 8));
        }
    }
}

TEST_CASE("Reused periodic orbits and passages agree with integration of every mesh period") {
    const auto& train = LiangTrain::instance();
    const auto inputs = LiangTrain::instance().spread(kSpeedup);
    // One disturbance decays within a few periods, the other outlasts the pattern.
    for (const double speedup : {kSpeedup, 60.0}) {
        const IntegrationPlan plan = train.plan(24, 1200, kFull);
        const std::vector<dynamics::GearboxInputs> one{train.inputs(speedup)};
        const auto faults = train.ring_side_cracks({4.28e-3});
        const Convergence convergence{.max_meshes = 2000};
        const TileResult a = run_tile<1>(plan, one, faults, PeriodicSolution{convergence});
        const TileResult b =
            run_tile<1>(plan, one, faults, FullSolution{convergence, {.meshes = 31 * 12}});
        REQUIRE(a.status[0] == LaneStatus::ok);
        double difference = 0.0, scale = 0.0;
        // Compares after full integration has converged as well.
        for (std::size_t k = 31 * 11; k < 31 * 12; ++k) {
            const auto& ra = a.records[static_cast<std::size_t>(a.content[k % 31])];
            const auto& rb = b.records[static_cast<std::size_t>(b.content[k])];
            for (std::size_t i = 0; i < ra.acceleration.size(); ++i) {
                difference =
                    std::max(difference, std::abs(ra.acceleration[i] - rb.acceleration[i]));
                scale = std::max(scale, std::abs(rb.acceleration[i]));
            }
        }
        INFO("speedup " << speedup << ", records " << a.records.size());
        CHECK(difference < 1e-6 * scale);
    }
}

TEST_CASE("A gearbox without a fault has one mesh period, with zero mean displacement") {
    const auto& train = LiangTrain::instance();
    const IntegrationPlan plan = train.plan(24, 1200, kFull);
    const std::vector<dynamics::GearboxInputs> one{train.inputs(kSpeedup)};
    const TileResult tile = run_tile<1>(plan, one, train.no_fault(1), PeriodicSolution{});
    CHECK(tile.records.size() == 1);
    CHECK(tile.content == std::vector<int>{0});
    // The periodic orbit repeats, so the vibration's mean acceleration is that of the frame alone:
    // W^2 x.
    for (std::size_t channel = 0; channel < 8; ++channel) {
        double mean = 0.0, rms = 0.0;
        for (std::size_t i = 0; i < 24; ++i) {
            const double a = tile.records[0].acceleration[i * 8 + channel];
            mean += a / 24;
            rms += a * a / 24;
        }
        CHECK(std::abs(mean) < 0.05 * std::sqrt(rms));
    }
}

TEST_CASE("Mean mesh forces carry the torque from the sun to the ring") {
    const auto& train = LiangTrain::instance();
    for (const auto law : {dynamics::MeshLaw::linear, dynamics::MeshLaw::unilateral}) {
        for (const auto integrator : {Integrator::rk4, Integrator::central_difference}) {
            IntegrationPlan plan = train.plan(400, 6000, kFull);
            plan.mesh_law = law;
            plan.integrator = integrator;
            plan.grid.stage_nodes = facts(integrator).stage_nodes;
            plan.nodes = tabulate(train.pairs, plan.grid, dynamics::MeshDamping::ratio);
            const std::vector<dynamics::GearboxInputs> one{train.inputs(kSpeedup)};
            const TileResult tile =
                run_tile<1>(plan, one, train.no_fault(1), PeriodicSolution{.with_motion = true});
            const machine::AlignedVector& force = tile.records[0].mesh_force;
            REQUIRE(force.size() == 400 * 8);
            double sun = 0.0, ring = 0.0;  // the planets' sums, means over the period
            for (std::size_t i = 0; i < force.size(); ++i) {
                (i % 8 < 4 ? sun : ring) += force[i] / 400;
            }
            const double carried = 429.0 / train.sun.base_radius();
            CHECK(sun == Approx(carried).epsilon(1e-3));
            CHECK(ring == Approx(carried).epsilon(1e-3));
        }
    }
}

}  // namespace gearpod::lockstep::test_solution
