// Checks tip and root relief in a study: the springs of the integration, and refused values.
#include "lockstep/plan/tooth_pairs.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/plan/scene.hpp"
#include "mc/study/gears.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_relief {

using mc::Scene;

const std::vector<std::string> kRelief{
    "gearbox.sun.tip_relief_um=4", "gearbox.sun.tip_relief_length_mm=3",
    "gearbox.planet.tip_relief_um=5", "gearbox.planet.tip_relief_length_mm=4"};

mc::StudyReading reading_of(const std::vector<std::string>& more) {
    return mc::read_study_text(tests::kExampleStudy, "study.toml", test::joined(kRelief, more));
}

mc::Study study_of(const std::vector<std::string>& more) {
    return test::valid_study(reading_of(more));
}

// Quasi-static equilibrium at the loaded approach: the springs of the integration together carry
// the nominal force of their pair.
TEST_CASE("The springs of relieved teeth carry the force at the loaded approach") {
    for (const std::vector<std::string>& input_overrides :
         {std::vector<std::string>{}, {"operation.fixed='sun'", "operation.input='ring'"}}) {
        std::vector<std::string> extended = input_overrides;
        extended.push_back("effects.contact_onset='extended'");
        for (const auto& more : {input_overrides, extended}) {
            const Scene scene(study_of(more));
            const lockstep::IntegrationPlan& plan = scene.solve().integration();
            CHECK(plan.mesh_law == dynamics::MeshLaw::unilateral);
            CHECK(scene.gearbox().pairs().reversed == !input_overrides.empty());
            double largest = 0;
            for (std::size_t step = 0; step < plan.grid.steps.size(); step += 7) {
                const lockstep::Step& at = plan.grid.steps[step];
                const double phase = at.phase + plan.grid.stage_nodes[0] * at.length;
                for (int pair = 0; pair < plan.nodes.pairs; ++pair) {
                    const double d =
                        mc::loaded_approach(*scene.gearbox().stiffness, PairId{pair}, phase);
                    double force = 0;
                    for (int contact = 0; contact < plan.nodes.contacts(); ++contact) {
                        const double gap = lockstep::tooth_gap(
                            plan, {}, PairId{pair}, static_cast<int>(step), 0, contact, LaneId{0});
                        const std::size_t i = lockstep::tooth_pair_at(plan, static_cast<int>(step),
                                                                      0, contact, PairId{pair});
                        force += plan.nodes.tooth_stiffness[i] * std::max(0.0, d - gap);
                        largest = std::max(largest, gap);
                    }
                    const int mesh = pair / scene.gearbox().drivetrain->pairs_per_mesh();
                    const double nominal = scene.gearbox()
                                               .stiffness->meshes()[static_cast<std::size_t>(mesh)]
                                               .loaded->force_N();
                    CHECK(force == Approx(nominal).epsilon(1e-6));
                }
            }
            CHECK(largest > 1e-6);
        }
    }
}

TEST_CASE("Relief without an amount or a length within the contact is refused") {
    using test::has_problem;
    CHECK(has_problem(reading_of({"gearbox.sun.tip_relief_length_mm=40"}).problems,
                      "gearbox.sun.tip_relief_length_mm", "more than the length of contact, 15."));
    CHECK(has_problem(reading_of({"gearbox.ring.tip_relief_um=3"}).problems,
                      "gearbox.ring.tip_relief_length_mm", "gearbox.ring.tip_relief_um is given"));
    CHECK(has_problem(reading_of({"gearbox.ring.tip_relief_length_mm=3"}).problems,
                      "gearbox.ring.tip_relief_length_mm", "only with gearbox.ring.tip_relief_um"));
    CHECK(has_problem(reading_of({"gearbox.relief_shape='parabolic'"}).problems,
                      "gearbox.relief_shape", "was removed"));
    CHECK(reading_of({"gearbox.sun.tip_relief_um=0"}).study.has_value());
}

// Statement of the study's heading: most level at the design load, not below it; short relief costs
// less at light load.
TEST_CASE("Long relief levels the transmission error of the FZG gears at its design load") {
    const auto varies = [](const std::string& amount, const std::string& length,
                           const std::string& torque) {
        const Scene scene(test::shipped_study(
            "tip-relief.toml",
            {"gearbox.pinion.tip_relief_um=" + amount, "gearbox.gear.tip_relief_um=" + amount,
             "gearbox.pinion.tip_relief_length_mm=" + length,
             "gearbox.gear.tip_relief_length_mm=" + length, "operation.torque_N_m=" + torque,
             "operation.load_torque_N_m=" + std::to_string(1.5 * std::stod(torque))}));
        return scene.gearbox().stiffness->meshes()[0].loaded->range().peak_to_peak();
    };
    const double design = varies("32", "5.814", "302");
    CHECK(design < 0.41 * varies("0", "5.814", "302"));
    CHECK(design < varies("28", "5.814", "302"));
    CHECK(design < varies("36", "5.814", "302"));
    CHECK(varies("32", "5.814", "75") > 2 * varies("0", "5.814", "75"));
    CHECK(varies("32", "2.907", "75") < 0.6 * varies("32", "5.814", "75"));
}

TEST_CASE("Long relief lowers the transmission error of teeth of grade 6 as well") {
    // The study without its sensor: quasi-static motion has no accelerations.
    std::ifstream file(test::study_path("tip-relief.toml"));
    std::string text, line;
    while (std::getline(file, line)) {
        const bool sensor = line.starts_with("position") || line.starts_with("sampling_Hz") ||
                            line.starts_with("low_pass_Hz");
        text += sensor ? "" : line + "\n";
    }
    // Mean peak to peak of a mesh period, rad.
    const auto varies = [&](const std::string& amount) {
        const Scene scene(test::study_of_text(
            text, {"gearbox.pinion.tip_relief_um=" + amount, "gearbox.gear.tip_relief_um=" + amount,
                   "gearbox.tooth_quality=6", "effects.motion='quasi-static'"}));
        constexpr int kMeshes = 96;
        const auto all = mc::simulate(scene.tile(), scene.draw().rows.id_of(0), kMeshes);
        const auto te = std::ranges::find(all.columns, "te", &mc::SignalColumn::name)->values;
        const auto samples = static_cast<std::ptrdiff_t>(te.size() / kMeshes);
        double sum = 0.0;
        for (auto mesh = te.begin(); mesh != te.end(); mesh += samples) {
            const auto [low, high] = std::minmax_element(mesh, mesh + samples);
            sum += (*high - *low) / kMeshes;
        }
        return sum;
    };
    CHECK(varies("32") < 0.5 * varies("0"));
}

}  // namespace gearpod::test_relief
