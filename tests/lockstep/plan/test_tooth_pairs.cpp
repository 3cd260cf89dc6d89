// Checks single tooth pairs: they add up to the total of their gear pair, forwards and backwards,
// healthy and faulty.
#include <algorithm>
#include <catch2/catch.hpp>

#include "lockstep/plan/tooth_pairs.hpp"
#include "stiffness/coupled_mesh.hpp"
#include "stiffness/faults/losses.hpp"
#include "stiffness/faults/pitting.hpp"
#include "stiffness/square_wave_mesh.hpp"
#include "tests/lockstep/liang_train.hpp"

namespace test_tooth_pairs {

using namespace gearpod;
using namespace gearpod::lockstep;
using test::LiangTrain;

namespace {

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
        const auto total = faulty_totals(pairs.curve(0), faulty, pairs.reversed, steps).all;
        const auto each = faulty_tooth_pairs(pairs, faulty, {0, k, start}, steps, 3);
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

}  // namespace

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
                    const double ratio = pairs.curve(static_cast<int>(pair)).contact_ratio();
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

}  // namespace test_tooth_pairs
