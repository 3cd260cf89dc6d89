// Checks features relative to the gearbox's record before the fault: ratios, changes, and inputs
// that both records share.
#include "tests/mc/ensemble/gearbox/computed.hpp"

namespace gearpod::mc::test_baseline {

using namespace test;

const std::string kCompared =
    "features.use=[\"sensor_rms\",\"window_ratio\",\"te_rms\",\"own_sensor_rms\","
    "\"own_window_ratio\",\"own_te_rms\",\"change_sensor_rms\",\"change_window_ratio\"]";
enum : std::size_t { kRms, kRatio, kTe, kOwnRms, kOwnRatio, kOwnTe, kChangeRms, kChangeRatio };

const GearboxId kHealthy{Group::threshold, 4}, kFaulty{Group::test, 4};

TEST_CASE("Without noise and at the same torque a healthy gearbox equals its baseline") {
    const Computed own(ideal_crack_study({kCompared, "sensor.noise_levels=[0]"}), {kHealthy});
    CHECK(own.value(kOwnRms) == 1.0);
    CHECK(own.value(kOwnRatio) == 1.0);
    CHECK(own.value(kOwnTe) == 1.0);
    CHECK(own.value(kChangeRms) == 0.0);
    CHECK(std::isnan(own.value(kChangeRatio)));  // no tooth differs from a zero change
}

TEST_CASE("Relative features compare the gearbox with its state before the fault") {
    const Study study = ideal_crack_study(
        {kCompared, "sensor.noise_levels=[0, 1]", "features.baseline_torque_scatter=0.03"});
    const Computed faulty(study, {kFaulty});
    GearboxId before = kFaulty;
    before.record = Record::baseline;
    const Computed healthy(study, {before});
    for (const std::size_t level : {0, 1}) {
        for (const auto& [feature, own] :
             {std::pair{kRms, kOwnRms}, {kRatio, kOwnRatio}, {kTe, kOwnTe}}) {
            CHECK(faulty.value(own, level) ==
                  faulty.value(feature, level) / healthy.value(feature, level));
        }
    }
    CHECK(healthy.value(kRatio) == Approx(1.0).margin(1e-6));
    // The difference is due to crack and torque; the crack's part is localized at its tooth.
    const LaneSignals now = faulty.signals(0), then = healthy.signals(0);
    const double change = rms_of(difference(now.sensor, then.sensor));
    CHECK(faulty.value(kChangeRms) == Approx(change).epsilon(1e-12));
    CHECK(faulty.value(kChangeRatio) > 2.0 * faulty.value(kRatio));
}

TEST_CASE("The two records have independent noise") {
    const Computed own(ideal_crack_study({kCompared, "sensor.noise_levels=[0, 100]"}), {kHealthy});
    const double noise = 100.0 * own.noise_m_s2();
    // About a million samples: 1e-3 of the mean square is one standard deviation.
    CHECK(own.value(kChangeRms, 1) == Approx(std::sqrt(2.0) * noise).epsilon(3e-3));
    CHECK(own.value(kRms, 1) == Approx(noise).epsilon(3e-3));
    CHECK(own.value(kOwnRms, 1) != 1.0);
}

TEST_CASE("A baseline's values do not depend on the other gearboxes of its tile") {
    const Study study = ideal_crack_study({kCompared, "features.baseline_torque_scatter=0.03"});
    const std::vector<GearboxId> ids{kHealthy, kFaulty, {Group::test, 5}};
    const Computed together(study, ids);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        CHECK(Computed(study, {ids[i]}).values()[0] == together.values()[i]);
    }
}

TEST_CASE("A baseline is the same in the tile of its record as in an earlier tile") {
    const Study study = ideal_crack_study({kCompared, "features.baseline_torque_scatter=0.03"});
    const std::vector<GearboxId> ids{
        kHealthy, kFaulty, {Group::test, 5}, {Group::test, 6}, {Group::threshold, 7}};
    // With five of eight lanes taken there is no room for the baselines, with four there is.
    const Computed before(study, ids), fewer(study, {ids.begin(), ids.end() - 1});
    REQUIRE(fewer.values().size() == 4);
    for (std::size_t i = 0; i < fewer.values().size(); ++i) {
        CHECK(fewer.values()[i] == before.values()[i]);
        CHECK(fewer.signals(static_cast<int>(i)).baseline->sensor ==
              before.signals(static_cast<int>(i)).baseline->sensor);
    }
    CHECK(fewer.meshes() < before.meshes());
}

TEST_CASE("The torque of baseline records has the requested scatter on both shafts") {
    const Study study = test::shipped_study(
        "published/tian-fig-4-9.toml",
        {"features.use=[\"own_te_rms\"]", "features.baseline_torque_scatter=0.05"});
    const Sampler sampler(DrawPlan{study});
    double sum = 0.0, squares = 0.0;
    constexpr int kGearboxes = 4000;
    for (std::uint64_t i = 0; i < kGearboxes; ++i) {
        const Realization drawn = sampler.draw({Group::test, i});
        const InstanceInputs& now = drawn.inputs;
        const InstanceInputs then = sampler.draw({Group::test, i, Record::baseline}).inputs;
        CHECK(then.fault_size == 0.0);
        CHECK(drawn.random_values.back() ==
              Approx(std::abs(then.torque_N_m / now.torque_N_m - 1.0)).margin(1e-12));
        const double share = std::log(then.torque_N_m / now.torque_N_m);
        CHECK(std::log(then.fixed_shaft.load_torque_N_m / now.fixed_shaft.load_torque_N_m) ==
              Approx(share).margin(1e-12));
        sum += share;
        squares += share * share;
    }
    CHECK(sum / kGearboxes == Approx(0.0).margin(4.0 * 0.05 / std::sqrt(kGearboxes)));
    CHECK(std::sqrt(squares / kGearboxes) == Approx(0.05).epsilon(0.05));
}

TEST_CASE("A baseline torque is refused where no feature uses it") {
    const auto reading = read_study(test::study_path("planet-crack-ideal.toml"),
                                    {"features.baseline_torque_scatter=0.05"});
    REQUIRE_FALSE(reading.study);
    CHECK(contains(format(reading.problems), "features.baseline_torque_scatter"));
    CHECK(contains(format(reading.problems), "change_"));
}

}  // namespace gearpod::mc::test_baseline
