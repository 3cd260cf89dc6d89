// Checks the shipped studies of Park's figures (2016): transmission errors over a planet turn,
// their orders and features, quasi-static and with inertia.
#include "tests/mc/liang_signals.hpp"
#include "tests/test.hpp"

namespace gearpod::test_park_studies {

using namespace gearpod::test;

constexpr int kPlanetTeeth = 26;
constexpr double kSunTeeth = 16, kRingTeeth = 68;

// Averaged TE of one planet turn, in rad, with the mean removed.
std::vector<double> te_turn(const mc::Scene& scene, std::uint64_t number = 0) {
    const auto tile = run_one(scene, false, number);
    REQUIRE(tile.integration.status[0] == lockstep::LaneStatus::ok);
    return {tile.te_turn.begin(), tile.te_turn.end()};
}

// Largest amplitude at orders that are not multiples of `step`, relative to the largest of all.
double off_multiples(const std::vector<double>& amplitudes, std::size_t step) {
    double off = 0.0, largest = 0.0;
    for (std::size_t i = 1; i < amplitudes.size(); ++i) {
        double& of = i % step == 0 ? largest : off;
        of = std::max(of, amplitudes[i]);
    }
    return off / largest;
}

// Stiffness of a pair at a phase of the planet turn, including a faulty tooth during its passage.
double pair_stiffness(const mc::Scene& scene, double size, int pair, double phase) {
    for (const auto& passage : scene.gearbox().fault().pattern().passages) {
        double since = phase - passage.start;
        since += since < 0.0 ? kPlanetTeeth : 0.0;
        const auto& healthy = scene.gearbox().pairs().curve(PairId{pair});
        if (size > 0.0 && passage.pair == pair && since < healthy.contact_ratio()) {
            return stiffness::total_at(*scene.gearbox().fault().mesh(passage.curve, size),
                                       healthy.transitions(), since);
        }
    }
    return scene.gearbox().pairs().total(PairId{pair}, phase);
}

// Each planet is two springs in series; the planets are parallel.
double train_stiffness(const mc::Scene& scene, double size, double phase) {
    double sum = 0.0;
    for (int n = 0; n < 3; ++n) {
        const double sun = pair_stiffness(scene, size, n, phase),
                     ring = pair_stiffness(scene, size, n + 3, phase);
        sum += sun * ring / (sun + ring);
    }
    return sum;
}

double sun_base_m(const mc::Study& study) {
    return 0.5 * study.gearbox.module_m.value() * kSunTeeth *
           std::cos(study.gearbox.pressure_angle_rad);
}

// Force on the sun for 180 kN m on the carrier.
double sun_force_N(const mc::Study& study) {
    return 180e3 * kSunTeeth / (kSunTeeth + kRingTeeth) / sun_base_m(study);
}

struct FeatureTable {
    std::vector<double> rms, kurtosis, fc, fm0;  // of the test gearboxes
};

FeatureTable feature_table(const mc::Study& study) {
    const mc::Results results = run(study);
    for (const auto status : results.status) {
        REQUIRE(status == 0);
    }
    const auto test = [&](const char* name) {
        const auto& values = results.features[feature_index(results, name)].values;
        return std::vector<double>(values.begin() + 1, values.end());  // 0: for the threshold
    };
    return {test("te_rms"), test("te_kurtosis"), test("te_fc"), test("te_fm0")};
}

bool rises(const std::vector<double>& values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

bool falls(const std::vector<double>& values) {
    return std::adjacent_find(values.begin(), values.end(), std::less_equal<>()) == values.end();
}

// Rise of the faulty TE above the healthy one, and centre of the rise in meshes, around the contact
// with the sun [0] and with the ring half a planet turn later [1].
struct Spikes {
    double height[2] = {}, centre[2] = {};
};

Spikes spikes(const mc::Scene& scene, std::uint64_t number) {
    const auto healthy = te_turn(scene, 0), faulty = te_turn(scene, number);
    const double samples = scene.record().te_samples;
    const auto quarter = healthy.size() / 4;
    const double level = faulty[quarter] - healthy[quarter];  // their means were removed
    Spikes found;
    double sum[2] = {};
    for (std::size_t i = 0; i < healthy.size(); ++i) {
        const double rise = faulty[i] - healthy[i] - level;
        const std::size_t half = i < quarter || i >= 3 * quarter ? 0 : 1;
        const double meshes =
            static_cast<double>(i) / samples - (i < 3 * quarter ? 0.0 : kPlanetTeeth);
        found.height[half] = std::max(found.height[half], rise);
        found.centre[half] += rise * meshes;
        sum[half] += rise;
    }
    for (std::size_t half = 0; half < 2; ++half) {
        found.centre[half] /= sum[half];
    }
    return found;
}

TEST_CASE(
    "The planets' phases: 2/3 and 4/3 of a mesh relative to both gears, 5/8 from sun to ring") {
    const mc::Scene scene(shipped_study("published/park-fig-10.toml"));
    const auto phase = [&](int pair) {
        return lockstep::phase_in_period(scene.gearbox().pairs().pitch_phase(PairId{pair}));
    };
    for (int n = 0; n < 3; ++n) {
        const double expected = lockstep::phase_in_period(n * 2.0 / 3.0 + 1e-9);
        CHECK(lockstep::phase_in_period(phase(n) + 1e-9) == Approx(expected).margin(1e-12));
        CHECK(lockstep::phase_in_period(phase(n + 3) - 0.625 + 1e-9) ==
              Approx(expected).margin(1e-12));
    }
}

TEST_CASE("Figs. 9, 10: multiples of 26 in phase; out of phase multiples of 78 only, and smaller") {
    const mc::Scene in_phase(shipped_study("published/park-fig-9.toml"));
    const mc::Scene phased(shipped_study("published/park-fig-10.toml"));
    const auto together = te_turn(in_phase), apart = te_turn(phased);
    CHECK(off_multiples(lines(together), 26) < 1e-10);
    CHECK(off_multiples(lines(apart), 78) < 1e-10);
    CHECK(off_multiples(lines(together), 78) > 0.5);
    const auto amplitudes = lines(together);
    CHECK(std::max_element(amplitudes.begin() + 1, amplitudes.end()) - amplitudes.begin() == 26);
    CHECK(rms_of(apart) < 0.5 * rms_of(together));
}

TEST_CASE("Fig. 11: two unequal spikes half a planet turn apart, low orders and sidebands") {
    const mc::Scene scene(shipped_study("published/park-fig-11.toml"));
    // Both rises grow with the fault, and the sun's is higher than the ring's.
    Spikes before;
    for (std::uint64_t number = 1; number < 4; ++number) {
        const Spikes now = spikes(scene, number);
        CHECK(now.height[0] > 1.05 * now.height[1]);
        for (std::size_t half = 0; half < 2; ++half) {
            CHECK(now.height[half] > 1.5 * before.height[half]);
        }
        // Opposite flanks of the tooth touch sun and ring: half a turn apart within a mesh.
        CHECK(now.centre[1] - now.centre[0] == Approx(13.0).margin(1.0));
        before = now;
    }
    const auto healthy = lines(te_turn(scene, 0)), faulty = lines(te_turn(scene, 3));
    CHECK(off_multiples(healthy, 78) < 1e-10);
    CHECK(faulty[78] == Approx(healthy[78]).epsilon(0.02));
    const auto largest = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
        return *std::max_element(faulty.begin() + from, faulty.begin() + to) / healthy[78];
    };
    CHECK(largest(1, 13) > 0.2);
    for (const std::ptrdiff_t harmonic : {78, 156}) {  // one mesh order on both sides
        CHECK(largest(harmonic - 26, harmonic) > 0.005);
        CHECK(largest(harmonic + 1, harmonic + 27) > 0.005);
    }
}

TEST_CASE("The TE of every sample is the sun's force over the train's stiffness") {
    const mc::Study study = shipped_study("published/park-fig-11.toml");
    const mc::Scene scene(study);
    const double support = 1.0 / study.gearbox.support_stiffness_N_m;
    const double sizes[] = {0.0, 0.1, 0.2, 0.3};
    for (std::uint64_t number = 0; number < 4; ++number) {
        const auto tile = run_one(scene, false, number);
        const int samples = scene.record().samples;
        double worst = 0.0;
        for (int i = 0; i < kPlanetTeeth * samples; ++i) {
            const auto mesh = static_cast<std::size_t>(i / samples);
            const int id = tile.integration.content[mesh % tile.integration.content.size()];
            const double te = tile.integration.records[static_cast<std::size_t>(id)]
                                  .te[static_cast<std::size_t>(i % samples)];
            const double expected =
                sun_force_N(study) / sun_base_m(study) *
                (1.0 / train_stiffness(scene, sizes[number], static_cast<double>(i) / samples) +
                 support);
            worst = std::max(worst, std::abs(std::abs(te) / expected - 1.0));
        }
        CHECK(worst < 1e-10);
    }
}

TEST_CASE("All six working conditions: the TE follows from the output's radius and direction") {
    using mc::Member;
    const double ratio = (kRingTeeth + kSunTeeth) / kSunTeeth;
    // Ratio of the output member's TE to the sun's under the same torques (Eq. 8): conditions 1, 3,
    // 5 are 2, 4, 6 with input and output exchanged.
    const struct {
        Member fixed, input;
        double scale;
    } conditions[] = {
        {Member::sun, Member::ring, kSunTeeth / (kRingTeeth + kSunTeeth)},
        {Member::sun, Member::carrier, kSunTeeth / kRingTeeth},
        {Member::ring, Member::sun, 1.0 / ratio},
        {Member::ring, Member::carrier, 1.0},
        {Member::carrier, Member::sun, kSunTeeth / kRingTeeth},
        {Member::carrier, Member::ring, 1.0},
    };
    for (const auto& condition : conditions) {
        mc::Study study = shipped_study("published/park-fig-11.toml");
        study.operation.fixed = condition.fixed;
        study.operation.input = condition.input;
        if (condition.fixed == Member::carrier) {
            study.operation.carrier_speed_rad_s.reset();
            study.operation.sun_speed_rad_s = 1.0;
        }
        const mc::Scene scene(study);
        const auto turn = te_turn(scene, 3);
        const double samples = scene.record().te_samples;
        std::vector<double> expected;
        double mean = 0.0;
        for (std::size_t i = 0; i < turn.size(); ++i) {
            expected.push_back(condition.scale * sun_force_N(study) / sun_base_m(study) /
                               train_stiffness(scene, 0.3, static_cast<double>(i) / samples));
            mean += expected.back() / static_cast<double>(turn.size());
        }
        const double sign = (expected[0] - mean) * turn[0] > 0.0 ? 1.0 : -1.0;
        double worst = 0.0;
        for (std::size_t i = 0; i < turn.size(); ++i) {
            worst = std::max(worst, std::abs(sign * turn[i] - (expected[i] - mean)));
        }
        INFO("fixed " << static_cast<int>(condition.fixed) << ", input "
                      << static_cast<int>(condition.input));
        CHECK(worst < 1e-8 * rms_of(expected));
        CHECK(off_multiples(lines(te_turn(scene, 0)), 78) < 1e-10);
    }
}

TEST_CASE(
    "Fig. 12: RMS follows the torque; kurtosis, FC and FM0 separate 90 % equally at every torque") {
    const FeatureTable table = feature_table(shipped_study("published/park-fig-12.toml"));
    // Rows are ordered by torque (30, 60, 120, 180, 240 kN m), alternating healthy and 90 %.
    const double torque[] = {1, 2, 4, 6, 8};
    REQUIRE(table.rms.size() == 10);
    for (std::size_t i = 0; i < 5; ++i) {
        const std::size_t healthy = 2 * i, faulty = 2 * i + 1;
        CHECK(table.rms[healthy] == Approx(torque[i] * table.rms[0]).epsilon(1e-9));
        CHECK(table.rms[faulty] == Approx(torque[i] * table.rms[1]).epsilon(1e-9));
        CHECK(table.rms[faulty] > table.rms[healthy]);
        CHECK(table.rms[faulty] < 1.02 * table.rms[healthy]);  // "slightly"
        CHECK(table.kurtosis[faulty] > 1.01 * table.kurtosis[healthy]);
        CHECK(table.fm0[faulty] > 1.1 * table.fm0[healthy]);
        CHECK(table.fc[faulty] < 0.9 * table.fc[healthy]);
        for (const auto* feature : {&table.kurtosis, &table.fm0, &table.fc}) {
            CHECK((*feature)[healthy] == Approx((*feature)[0]).epsilon(1e-9));
            CHECK((*feature)[faulty] == Approx((*feature)[1]).epsilon(1e-9));
        }
    }
}

TEST_CASE("Fig. 13: RMS, kurtosis and FM0 rise and FC falls with the fault") {
    const FeatureTable table = feature_table(shipped_study("published/park-fig-13.toml"));
    REQUIRE(table.rms.size() == 4);
    CHECK(rises(table.rms));
    CHECK(rises(table.kurtosis));
    CHECK(rises(table.fm0));
    CHECK(falls(table.fc));
}

TEST_CASE(
    "With inertia the TE oscillates after each step; with a damping ratio of 0.07 kurtosis rises "
    "less") {
    const mc::Study study = shipped_study("published/park-dynamic.toml");
    const FeatureTable ringing = feature_table(study),
                       still = feature_table(shipped_study("published/park-fig-13.toml"));
    CHECK(rises(ringing.rms));
    CHECK(rises(ringing.fm0));
    CHECK(falls(ringing.fc));
    // The healthy TE's kurtosis grows by half, and a loss of 10 % does not change it.
    CHECK(ringing.kurtosis[0] > 1.4 * still.kurtosis[0]);
    CHECK(ringing.kurtosis[1] == Approx(ringing.kurtosis[0]).epsilon(1e-3));
    CHECK(still.kurtosis[1] > 1.01 * still.kurtosis[0]);
    CHECK(ringing.fm0[0] > 1.5 * still.fm0[0]);

    // The ratios depend on torque as little as without inertia: the equations are linear.
    mc::Study light = study;
    light.operation.torque_N_m = 30e3;
    const FeatureTable sixth = feature_table(light);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(sixth.rms[i] == Approx(ringing.rms[i] / 6.0).epsilon(1e-6));
        CHECK(sixth.kurtosis[i] == Approx(ringing.kurtosis[i]).epsilon(1e-6));
        CHECK(sixth.fc[i] == Approx(ringing.fc[i]).epsilon(1e-6));
        CHECK(sixth.fm0[i] == Approx(ringing.fm0[i]).epsilon(1e-6));
    }
    // FC with hardly any damping no longer falls with the first 10 %, as it does in Fig. 13.
    mc::Study undamped = study;
    undamped.gearbox.mesh_damping[mc::MeshDamping::ratio] = 0.01;
    const FeatureTable loud = feature_table(undamped);
    CHECK(loud.fc[1] > loud.fc[0]);
    // All trends are those of Fig. 13 once damping suppresses the oscillation.
    mc::Study damped = study;
    damped.gearbox.mesh_damping[mc::MeshDamping::ratio] = 0.6;
    const FeatureTable quiet = feature_table(damped);
    CHECK(rises(quiet.kurtosis));
    CHECK(quiet.kurtosis[0] == Approx(still.kurtosis[0]).epsilon(0.05));
}

}  // namespace gearpod::test_park_studies
