// Checks studies with worn flanks: the pairs that wear, in all kinds of gearbox, and the records of
// their gearboxes.
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/scene_examples.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_worn_study {

using namespace tests;

const std::string kCrack = "kind = \"crack\"\nmember = \"planet\"\nside = \"ring\"\n";
const std::string kDepths =
    "fault.depth_mm = { distribution = \"levels\", values = [0, 1, 2, 3, 4.3] }\n";

// The planetary example with this member worn.
std::string worn_example(const std::string& member) {
    return replaced(
        replaced(example_with(kCrack, "kind = \"wear\"\nwear_um = 20\nmember = " + member + "\n"),
                 kDepths, ""),
        "[fault]", "[effects]\ncontact_onset = \"extended\"\n[fault]");
}

std::string worn_pinion() {
    return replaced(replaced(kFixedShaftStudy,
                             "kind = \"chip\"\nmember = \"pinion\"\nchip_mm = 8\nchip_height_mm = "
                             "2\n",
                             "kind = \"wear\"\nwear_um = 20\nmember = \"gear\"\n"),
                    "[effects]\n", "[effects]\ncontact_onset = \"extended\"\n");
}

// The shape is zero where a tooth pair of a worn gear passes its pitch point, and 1 at an end of
// its path of contact; the other pairs have none.
TEST_CASE("The pairs of the worn gear have gaps that grow from the pitch point") {
    struct Case {
        std::string text;
        std::vector<std::string> more;
        std::vector<int> worn;
    };
    for (const auto& [text, more, worn] :
         {Case{worn_example("\"sun\""), {}, {0, 1, 2, 3}},
          {worn_example("\"sun\""),
           {"operation.fixed='sun'", "operation.input='ring'"},
           {0, 1, 2, 3}},
          {worn_example("\"planet\"\nside = \"sun\"\nplanet = 3"), {}, {2}},
          {worn_example("\"planet\"\nside = \"ring\""), {}, {4}},
          {worn_example("\"ring\""), {"gearbox.helix_angle_deg=8"}, {4, 5, 6, 7}},
          {worn_example("\"ring\""), {}, {4, 5, 6, 7}},
          {worn_pinion(), {}, {0}}}) {
        const Study study = test::study_of_text(text, more);
        const Scene scene(study);
        CHECK(scene.gearbox().fault().worn_pairs() == worn);
        const lockstep::IntegrationPlan& plan = scene.solve().integration();
        const lockstep::StiffnessNodes& nodes = plan.nodes;
        const bool spur = study.gearbox.helix_angle_rad == 0.0;
        for (int pair = 0; pair < nodes.pairs; ++pair) {
            const double pitch =
                lockstep::phase_in_period(scene.gearbox().pairs().pitch_phase(PairId{pair}));
            double least_at_pitch = 1.0, largest = 0.0;
            for (std::size_t step = 0; step < plan.grid.steps.size(); ++step) {
                const bool at_pitch = std::abs(plan.grid.steps[step].phase - pitch) < 1e-9;
                for (int contact = 0; contact < nodes.contacts(); ++contact) {
                    const std::size_t i = lockstep::tooth_pair_at(plan, static_cast<int>(step), 0,
                                                                  contact, PairId{pair});
                    if (nodes.tooth_stiffness[i] > 0.0) {
                        const double wear = nodes.tooth_wear[i];
                        largest = std::max(largest, wear);
                        least_at_pitch = at_pitch ? std::min(least_at_pitch, wear) : least_at_pitch;
                    }
                }
            }
            INFO(scene.gearbox().drivetrain->pair_name(PairId{pair}));
            const bool wears = std::ranges::count(worn, pair) > 0;
            CHECK(largest == Approx(wears ? 1.0 : 0.0).margin(spur ? 0.05 : 0.2));
            // Steps of worn spur teeth end at the pitch point; some integrators do not evaluate
            // forces there.
            CHECK((!wears || !spur || least_at_pitch < 0.02));
            if (plan.grid.stage_nodes[0] == 0.0) {
                CHECK((!wears || !spur || least_at_pitch < 1e-9));
            }
        }
    }
}

// A lightly loaded pair follows its flanks, which leave each other on both sides of the pitch
// point.
TEST_CASE("The transmission error of a pair varies the more the deeper its flanks are worn") {
    const Scene scene(test::study_of_text(
        worn_pinion(), {"random.fault.wear_um={distribution='levels',values=[0,5,20]}"}));
    std::vector<double> spread;
    for (std::uint64_t i = 0; i < 3; ++i) {
        const auto all = simulate(scene.tile(), {Group::test, i}, 1);
        const auto te = std::ranges::find(all.columns, "te", &SignalColumn::name)->values;
        const auto [low, high] = std::ranges::minmax(te);
        spread.push_back(high - low);
    }
    CHECK(spread[1] > 1.5 * spread[0]);
    CHECK(spread[2] > 2.0 * spread[1]);
}

TEST_CASE("The baseline record of a worn gearbox is that of the gearbox without wear") {
    const auto tile_of = [](const std::string& depth) {
        std::vector<std::string> settings = kFast;
        settings.insert(settings.end(),
                        {"fault.wear_um=20",
                         "random.fault.wear_um={distribution='levels',values=[" + depth + ",20]}",
                         "features.use=['change_sensor_rms','own_sensor_rms']"});
        const Scene scene(test::study_of_text(worn_example("\"sun\""), settings));
        const GearboxId first{Group::test, 0};
        return run_gearboxes(scene.tile(), std::span(&first, 1), 1, {});
    };
    const GearboxTile healthy = tile_of("0"), worn = tile_of("10");
    REQUIRE(healthy.baseline.size() == 1);
    CHECK(healthy.baseline[0].te_turn == worn.baseline[0].te_turn);
    CHECK(healthy.te_turn != worn.te_turn);
}

}  // namespace gearpod::mc::test_worn_study
