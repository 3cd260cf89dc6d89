// Checks the response of the housing in runs: modes, measured responses, additional sensors, tones
// and baselines. The closed forms are in tests/signals/path/test_frequency_response.cpp.
#include "mc/study/study.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_housing {

using namespace test;

const std::string kModes =
    " --set 'sensor.housing_modes=[{frequency_Hz=70, damping=0.03, participation=0.8}, "
    "{frequency_Hz=90, damping=0.02, participation=0.5, nodal_diameters=2}]' ";

// Measured response with this gain at all frequencies.
std::string flat(double gain) {
    return " --set 'sensor.response_Hz=[0, 1000]' --set 'sensor.response_phase_deg=[0, 0]'"
           " --set 'sensor.response_gain=[" +
           std::to_string(gain) + ", " + std::to_string(gain) + "]' ";
}

TEST_CASE("Modes without participation and a gain of 1 leave all features unchanged") {
    const Folder folder;
    const mc::Results& plain = plain_small_run();
    const std::string none =
        " --set 'sensor.housing_modes=[{frequency_Hz=70, damping=0.03, participation=0}, "
        "{frequency_Hz=90, damping=0.02, participation=0, nodal_diameters=3}]'";
    const mc::Results modes = run_small(folder, "modes.h5", none),
                      measured = run_small(folder, "measured.h5", flat(1.0));
    for (std::size_t f = 0; f < plain.features.size(); ++f) {
        INFO(plain.features[f].name);
        check_close(modes.features[f].values, plain.features[f].values, 1e-8);
        check_close(measured.features[f].values, plain.features[f].values, 1e-8);
    }
}

TEST_CASE("The housing amplifies the gearbox, but neither tones nor noise") {
    const Folder folder;
    const std::string quiet = " --set sensor.noise_levels=[0,1]",
                      tone = " --set 'sensor.tones=[{frequency_Hz=31, amplitude_m_s2=0.7}]'";
    const mc::Results plain = run_small(folder, "plain.h5", quiet),
                      doubled = run_small(folder, "doubled.h5", quiet + flat(2.0)),
                      silent = run_small(folder, "silent.h5", quiet + flat(0.0) + tone);
    const auto &before = values(plain.features, "sensor_rms"),
               &after = values(doubled.features, "sensor_rms"),
               &only_tone = values(silent.features, "sensor_rms");
    for (std::size_t i = 0; i < before.size(); i += 2) {
        CHECK(after[i] == Approx(2.0 * before[i]).epsilon(1e-10));
        CHECK(only_tone[i] == Approx(0.7 / std::sqrt(2.0)).epsilon(2e-3));
        // The noise, 0.002 m/s^2, adds in quadrature as before.
        CHECK(std::abs(after[i + 1] - after[i]) < 0.0005);
    }
}

TEST_CASE("Modes change the signal, and each gearbox may have its own natural frequencies") {
    const Folder folder;
    const std::string scatter =
        " --set 'sensor.housing_frequency_factor={distribution=\"uniform\", low=0.8, high=1.2}'";
    const mc::Results &plain = plain_small_run(), modes = run_small(folder, "modes.h5", kModes),
                      random = run_small(folder, "random.h5", kModes + scatter);
    const auto &before = values(plain.features, "sensor_rms"),
               &after = values(modes.features, "sensor_rms"),
               &scattered = values(random.features, "sensor_rms");
    int differ = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after[i] > 1.1 * before[i]);
        differ += std::abs(scattered[i] / after[i] - 1.0) > 1e-3;
    }
    CHECK(differ > 30);
    check_close(values(modes.features, "te_rms"), values(plain.features, "te_rms"), 1e-12);
}

TEST_CASE("A sensor with the first one's participation and place has its signal") {
    const Folder folder;
    const std::string quiet = " --set sensor.noise_levels=[0]";
    const std::string sensors =
        " --set 'sensor.additional=[{name=\"twin\", angle_deg=0}, {name=\"same\", angle_deg=0, "
        "participation=[0.8, 0.5]}, {name=\"other\", angle_deg=0, participation=[-0.4, 2]}]'";
    const mc::Results results = run_small(folder, "r.h5", kModes + sensors + quiet);
    for (std::size_t f = 0; f < results.features.size(); ++f) {
        INFO(results.features[f].name);
        const auto first = bits_of(results.features[f].values);
        CHECK(bits_of(results.variants[0].features[f].values) == first);
        CHECK(bits_of(results.variants[1].features[f].values) == first);
        const bool of_te = results.features[f].name.starts_with("te_");
        CHECK((bits_of(results.variants[2].features[f].values) == first) == of_te);
    }
}

TEST_CASE("A measured response is read from columns of a file, for each sensor") {
    const Folder folder;
    write_bytes(folder.file("frf.csv"), "f,top,phase,side\n0,1,0,3\n50,1,0,3\n1000,1,0,3\n");
    const auto column = [&](const std::string& name) {
        return "{file=\"" + folder.file("frf.csv") + "\", column=\"" + name + "\"}";
    };
    const std::string set = " --set 'sensor.response_Hz=" + column("f") +
                            "' --set 'sensor.response_gain=" + column("top") +
                            "' --set 'sensor.response_phase_deg=" + column("phase") +
                            "' --set 'sensor.additional=[{name=\"side\", angle_deg=0, "
                            "response_gain=" +
                            column("side") + ", response_phase_deg=" + column("phase") +
                            "}]' --set sensor.noise_levels=[0]";
    const mc::Results results = run_small(folder, "r.h5", set);
    const auto& first = values(results.features, "sensor_rms");
    const auto& side =
        std::ranges::find(results.variants[0].features, "sensor_rms", &mc::FeatureResult::name)
            ->values;
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK(side[i] == Approx(3.0 * first[i]).epsilon(1e-10));
    }
    // The stored study has the numbers, and needs the file no more.
    std::filesystem::remove(folder.file("frf.csv"));
    require_success("report " + folder.file("r.h5"));
}

TEST_CASE("Problems of the housing are all reported") {
    check_refused(
        "describe " + kSmall +
            " --set 'sensor.housing_modes=[{frequency_Hz=0, damping=2, participation=1}, "
            "{frequency_Hz=90, damping=0.1, participation=\"a\", nodal_diameters=1.5}, "
            "{damping=0.1}]'",
        {"mode 1: frequency_Hz must be", "mode 1: damping must be",
         "mode 2: participation must be a number", "mode 2: nodal_diameters must be an integer",
         "mode 3 has no frequency_Hz", "mode 3 has no participation"});
    check_refused("describe " + kSmall + kModes +
                      " --set 'sensor.additional=[{name=\"a\", angle_deg=1, participation=[1]}]'",
                  {"sensor 1: participation has 1 values, but sensor.housing_modes has 2"});
    check_refused("describe " + kSmall + kModes + flat(1.0),
                  {"a measured response contains the modes"});
    check_refused("describe " + kSmall +
                      " --set sensor.response_Hz=[1,2] --set sensor.response_gain=[1]"
                      " --set sensor.response_phase_deg=[0,0,0]",
                  {"has 1 values, but sensor.response_Hz has 2",
                   "has 3 values, but sensor.response_Hz has 2"});
    CHECK(program("describe " + kSmall +
                  " --set sensor.response_Hz=[5] --set sensor.response_gain=[1]"
                  " --set sensor.response_phase_deg=[0]")
              .mentions("has one frequency"));
    CHECK(program("describe " + kSmall + kModes)
              .mentions("70 Hz, damping 0.03, participation 0.8: 13.3 times the vibration"));
}

}  // namespace gearpod::test_housing
