// Tiles that may stop inside a mesh period: the same motion with less of it marched.
#include <catch2/catch.hpp>

#include "liang_train.hpp"
#include "lockstep/mesh_march.hpp"
#include "lockstep/rigid_rotation.hpp"

using namespace gearpod;
using namespace gearpod::lockstep;
using test::LiangTrain;

namespace {

constexpr auto kFull = dynamics::Motion::translational_torsional;
const std::vector<double> kDepths{0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 4.28e-3, 6e-3, 8.5e-3};

std::vector<dynamics::GearboxInputs> spread_inputs(double speedup) {
    std::vector<dynamics::GearboxInputs> inputs;
    for (int l = 0; l < 8; ++l) {
        inputs.push_back(LiangTrain::instance().inputs(speedup, 1e8 * (0.8 + 0.05 * l)));
    }
    return inputs;
}

TileResult tile_in_parts(const MarchPlan& plan, double speedup, int parts, double tolerance) {
    const std::vector<MeshPart> all = mesh_parts(plan, parts);
    TileSettings settings;
    settings.tolerance = tolerance;
    settings.max_meshes = 2000;
    settings.parts = all;
    return run_tile<8>(plan, spread_inputs(speedup),
                       LiangTrain::instance().ring_side_cracks(kDepths), settings);
}

// The largest difference of two tiles' TE over the pattern, relative to its largest value.
double te_difference(const TileResult& a, const TileResult& b) {
    double difference = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < a.content.size(); ++k) {
        const auto& x = a.records[static_cast<std::size_t>(a.content[k])].te;
        const auto& y = b.records[static_cast<std::size_t>(b.content[k])].te;
        for (std::size_t i = 0; i < x.size(); ++i) {
            difference = std::max(difference, std::abs(x[i] - y[i]));
            largest = std::max(largest, std::abs(y[i]));
        }
    }
    return difference / largest;
}

}  // namespace

TEST_CASE("Parts of a mesh period march like the whole, to the bit") {
    const auto& train = LiangTrain::instance();
    for (const Integrator integrator :
         {Integrator::rk4, Integrator::bs3, Integrator::newmark, Integrator::sdirk3}) {
        MarchPlan plan = train.plan(24, 1200, kFull);
        plan.integrator = integrator;
        plan.grid.stage_nodes = stage_nodes(integrator);
        plan.nodes = tabulate(train.pairs, plan.grid, dynamics::MeshDamping::ratio);
        const std::vector<MeshPart> parts = mesh_parts(plan, 5);
        REQUIRE(parts.size() == 5);
        const auto inputs = spread_inputs(10.0);
        const auto march = make_mesh_march<8>(plan, inputs);
        TileState whole = rest_state(plan, inputs), pieces = whole;
        MeshRecord one = make_record(plan, 8, true), other = make_record(plan, 8, true);
        (*march)({}, whole, one);
        for (const MeshPart& part : parts) {
            march->march_part(part.plan, {}, pieces, other);
        }
        CHECK(whole.q == pieces.q);
        CHECK(whole.v == pieces.v);
        CHECK(whole.filter == pieces.filter);
        CHECK(one.acceleration == other.acceleration);
        CHECK(one.te == other.te);
        CHECK(one.motion == other.motion);
        CHECK(parts.front().first_step == 0);
        CHECK(parts.back().last_step == static_cast<int>(plan.grid.steps.size()));
        CHECK(parts.back().last_sample == plan.grid.samples);
    }
}

TEST_CASE("A tile that stops between parts finds the same orbit and passage and marches less") {
    const auto& train = LiangTrain::instance();
    const MarchPlan plan = train.plan(24, 1200, kFull);
    // Decay within a few mesh periods, and a disturbance that outlives the pattern.
    for (const double speedup : {10.0, 60.0}) {
        const TileResult whole = tile_in_parts(plan, speedup, 1, 1e-10);
        const TileResult parts = tile_in_parts(plan, speedup, 8, 1e-10);
        CHECK(whole.status == std::vector(8, LaneStatus::ok));
        CHECK(parts.status == whole.status);
        CHECK(te_difference(parts, whole) < 2e-9);
        CHECK(parts.marched < whole.marched);
        // Looser, it is still within what was asked for, over the decay in a mesh period.
        const TileResult loose = tile_in_parts(plan, speedup, 8, 1e-4);
        CHECK(te_difference(loose, whole) < 1e-2);
        CHECK(loose.marched < parts.marched);
    }
}

TEST_CASE("A mesh period has at least one part and no more than it has steps") {
    const MarchPlan plan = LiangTrain::instance().plan(4, 4, kFull);
    CHECK(mesh_parts(plan, 1000).size() == plan.grid.steps.size());
    CHECK_THROWS_AS(mesh_parts(plan, 0), std::invalid_argument);
}
