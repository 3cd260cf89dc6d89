// Checks baselines of another assembly and averaged baseline records: inputs that they share, tooth
// errors shifted by whole teeth, and the noise of means.
#include "mc/ensemble/gearbox/tile_random_inputs.hpp"
#include "mc/study/assumptions.hpp"
#include "tests/mc/ensemble/gearbox/computed.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::mc::test_reassembly {

using namespace test;

const std::string kChange =
    "features.use=[\"change_sensor_rms\",\"sensor_rms\",\"own_sensor_rms\"]";

Study study_with(const std::vector<std::string>& overrides) {
    return ideal_crack_study(joined({kChange}, overrides));
}

GearboxId baseline(std::uint64_t number) {
    GearboxId id{Group::test, 4, Record::baseline};
    id.baseline = number;
    return id;
}
const GearboxId kTest{Group::test, 4};

std::vector<double> sensor_of(const Scene& scene, const GearboxId& id) {
    const Realization one = scene.sampler().draw(id);
    const GearboxTile tile = run_realizations(scene.tile(), {one}, 8);
    return lane_signals(scene.tile(), tile, LaneId{0}, scene.record().span.meshes()).sensor;
}

TEST_CASE("An assembly keeps its inputs in all records, and a record has its own") {
    const Sampler sampler(DrawPlan{study_with(
        {"features.baseline_records=3",
         "random.sensor.path_exponent={distribution=\"uniform\",low=-0.1,high=0.1,per="
         "\"assembly\"}",
         "random.sensor.gain={distribution=\"lognormal\",median=1,cv=0.1,per=\"record\"}"})});
    const InstanceInputs now = sampler.draw(kTest).inputs;
    const InstanceInputs first = sampler.draw(baseline(0)).inputs,
                         second = sampler.draw(baseline(1)).inputs;
    CHECK(first.path_exponent != now.path_exponent);
    CHECK(first.path_exponent == second.path_exponent);
    CHECK(first.gain != now.gain);
    CHECK(first.gain != second.gain);
    for (const Member member : {Member::sun, Member::planet, Member::ring}) {
        CHECK(first.bodies[member].bearing_stiffness_N_m ==
              now.bodies[member].bearing_stiffness_N_m);
    }
}

TEST_CASE("Inputs of an assembly have their distribution in the baseline") {
    const Sampler sampler(DrawPlan{study_with(
        {"random.sensor.gain={distribution=\"uniform\",low=0.5,high=1.5,per=\"assembly\"}"})});
    double sum = 0.0, product = 0.0;
    constexpr int kGearboxes = 4000;
    for (std::uint64_t i = 0; i < kGearboxes; ++i) {
        const double now = sampler.draw({Group::test, i}).inputs.gain - 1.0;
        const double then = sampler.draw({Group::test, i, Record::baseline}).inputs.gain - 1.0;
        sum += then;
        product += now * then;
    }
    const double sd = 1.0 / std::sqrt(12.0);
    CHECK(std::abs(sum / kGearboxes) < 4.0 * sd / std::sqrt(kGearboxes));
    CHECK(std::abs(product / kGearboxes) < 4.0 * sd * sd / std::sqrt(kGearboxes));
}

TEST_CASE("Redrawn teeth are the gearbox's own errors, shifted by whole teeth") {
    const auto errors_of = [](const std::vector<std::string>& more) {
        const Scene scene(shipped_study(
            "planet-crack-ideal.toml",
            joined({kChange, "gearbox.tooth_quality=6", "numerics.horizon=full"}, more)));
        const std::vector<Realization> both{
            scene.sampler().draw(kTest), scene.sampler().draw(baseline(0)),
            scene.sampler().draw(baseline(1)), scene.sampler().draw(baseline(0))};
        return draw_tooth_errors(*scene.gearbox().tooth_errors, scene.draw(), both);
    };
    const auto lane = [](const machine::AlignedVector& values, std::size_t which) {
        return every(4, values, which);
    };
    const lockstep::ToothErrors same = errors_of({}),
                                other = errors_of({"features.baseline_redraws=[\"teeth\"]"});
    bool any = false;
    for (std::size_t g = 0; g < same.gears.size(); ++g) {
        const auto now = lane(same.gears[g].error_m, 0), slope = lane(same.gears[g].slope_m, 0);
        CHECK(lane(same.gears[g].error_m, 1) == now);
        CHECK(lane(other.gears[g].error_m, 0) == now);
        auto then = lane(other.gears[g].error_m, 1), then_slope = lane(other.gears[g].slope_m, 1);
        CHECK(lane(other.gears[g].error_m, 2) == then);
        any = any || then != now;
        const auto begin = std::ranges::find(then, now.front());
        REQUIRE(begin != then.end());
        std::ranges::rotate(then_slope, then_slope.begin() + (begin - then.begin()));
        std::ranges::rotate(then, begin);
        CHECK(then == now);
        CHECK(then_slope == slope);
    }
    CHECK(any);
}

TEST_CASE("Redrawn pins have other positions, the same in all baseline records") {
    const auto planets = [](const std::vector<std::string>& more, const GearboxId& id) {
        return Sampler(DrawPlan(study_with(joined({"gearbox.pin_tangential_rms_um=20"}, more))))
            .draw(id)
            .inputs.planets;
    };
    const auto pin = [](const auto& planet) { return std::pair(planet.pin_x_m, planet.pin_y_m); };
    const std::vector<std::string> redrawn{"features.baseline_redraws=[\"pins\"]"};
    const Planets now = planets(redrawn, kTest), then = planets(redrawn, baseline(0)),
                  again = planets(redrawn, baseline(2)), same = planets({}, baseline(0));
    for (std::size_t n = 0; n < 4; ++n) {
        CHECK(pin(then[n]) != pin(now[n]));
        CHECK(pin(again[n]) == pin(then[n]));
        CHECK(pin(same[n]) == pin(now[n]));
    }
}

TEST_CASE("The noise of a mean of baseline records falls with the root of their number") {
    for (const int records : {1, 4}) {
        const Study study = study_with(
            {"features.baseline_records=" + std::to_string(records), "sensor.noise_levels=[100]"});
        const auto values = Computed(study, {{Group::threshold, 4}}).values()[0];
        const double noise =
            100.0 * Scene(study).sampler().draw({Group::threshold, 4}).inputs.noise_m_s2;
        // About a million samples: 1e-3 of the mean square is one standard deviation.
        CHECK(values[0] == Approx(std::sqrt(1.0 + 1.0 / records) * noise).epsilon(3e-3));
        CHECK(values[2] == Approx(1.0).epsilon(1e-2));
    }
}

TEST_CASE("The change is measured from the mean of the baseline records' signals") {
    const Study study = study_with({"features.baseline_records=3", "sensor.noise_levels=[0]",
                                    "features.baseline_torque_scatter=0.05"});
    const Scene scene(study);
    std::vector<double> change = sensor_of(scene, kTest);
    double before = 0.0;
    for (std::uint64_t k = 0; k < 3; ++k) {
        const std::vector<double> one = sensor_of(scene, baseline(k));
        before += rms(one) / 3.0;
        for (std::size_t i = 0; i < change.size(); ++i) {
            change[i] -= one[i] / 3.0;
        }
    }
    const auto values = Computed(study, {kTest}).values()[0];
    CHECK(values[0] == Approx(rms(change)).epsilon(1e-9));
    CHECK(values[2] == Approx(values[1] / before).epsilon(1e-9));
}

TEST_CASE("Reports state the baseline, and impossible ones are refused") {
    const auto conditions = [](const std::vector<std::string>& keys) {
        return assumptions(study_with(keys), false);
    };
    CHECK_THAT(conditions({}), Catch::Contains("the same assembly, path and sensor mounting"));
    CHECK_THAT(conditions({"features.baseline_records=5",
                           "random.sensor.gain={distribution=\"uniform\",low=0.5,high=1.5,per="
                           "\"assembly\"}"}),
               Catch::Contains("the mean of 5 healthy records") &&
                   Catch::Contains("that differs in sensor.gain"));
    const auto refused = [](const std::string& more) {
        return test::program("describe " + test::study("planet-crack-ideal.toml") + " --set '" +
                             kChange + "'" + more);
    };
    CHECK(
        refused(" --set 'features.baseline_redraws=[\"teeth\"]'").mentions("all teeth are alike"));
    CHECK(refused(" --set 'features.baseline_redraws=[\"pins\"]'").mentions("no pin has a random"));
    CHECK(refused(" --set 'features.baseline_redraws=[\"pin\"]'").mentions("unknown property"));
    CHECK(refused(" --set features.baseline_records=0").code == 2);
    CHECK(test::program("describe " + test::study("planet-crack-ideal.toml") +
                        " --set features.baseline_records=2")
              .mentions("only with features that use a baseline record"));
}

}  // namespace gearpod::mc::test_reassembly
