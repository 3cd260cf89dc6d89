// Checks what all settings of the sensors together must keep: bits over threads, parts, merging and
// lanes, features of exported samples, signals recorded during integration, and the study's text.
#include <fmt/format.h>

#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_sensor_settings {

using namespace test;

const std::string kModes =
    "sensor.housing_modes=[{frequency_Hz=70, damping=0.03, participation=0.8, "
    "sun_bearing_per_kg=0.02}, {frequency_Hz=90, damping=0.02, participation=0.5, "
    "nodal_diameters=2, carrier_bearing_per_kg=-0.03}]";
const std::string kSide =
    "sensor.additional=[{name=\"side\", angle_deg=77, direction=\"tangential\", noise=3, "
    "low_pass_Hz=50, mounting_Hz=70, mounting_damping=0.05, delay_s=0.004, "
    "quantisation_m_s2=0.01, sampling_Hz=110}]";
const std::string kBaselines =
    "features.use=[\"sensor_rms\", \"own_window_ratio\", \"crest_factor\", \"na4\"]";

// Every part of the chain, with a bearing in this role. Some samples are beyond the range.
std::vector<std::string> everything(const std::string& role) {
    return {kModes,
            kSide,
            "sensor.tones=[{frequency_Hz=31, amplitude_m_s2=0.1}]",
            "sensor.noise_density_m_s2_per_sqrt_Hz=0.001",
            "sensor.background_Hz=[10, 60]",
            "sensor.background_density_m_s2_per_sqrt_Hz=[0.005, 0.005]",
            "sensor.bearings=[{fault=\"inner\", shaft=\"sun\", elements=9, diameter_ratio=0.2, "
            "amplitude_m_s2=0.05, resonance_Hz=90, role=\"" +
                role + "\"}]",
            "sensor.range_m_s2=0.35"};
}

std::string options(const std::vector<std::string>& settings) {
    return set_options(settings) + " ";
}

TEST_CASE("Rows keep their bits over threads, parts and merging") {
    check_equal_bits_over_parts(options(everything("other_fault")));
    check_equal_bits_over_parts(options(
        joined(everything("other_fault"), {kBaselines, "features.baseline_torque_scatter=0.02",
                                           "sensor.record_s=9", "sensor.noise_levels=[0, 1, 2]"})));
}

TEST_CASE("Rows keep their bits over lanes") {
    const auto rows = [](int lanes) {
        const auto settings =
            joined(everything("other_fault"),
                   {"ensemble.threshold_instances=5", "ensemble.instances=6",
                    "numerics.precision=\"double\"", fmt::format("numerics.lanes={}", lanes)});
        return bits(test::run(valid_study(mc::read_study(kSmall, settings))));
    };
    const auto eight = rows(8);
    CHECK(rows(1) == eight);
    CHECK(rows(4) == eight);
}

TEST_CASE("Exported samples have the features of the run") {
    const Folder folder;
    // `features` refuses many clipped samples. test_sensor_range.cpp exports few.
    auto unclipped = everything("background");
    unclipped.pop_back();
    const std::string settings = options(unclipped);
    const mc::Results results = run_small(folder, "run.h5", settings);
    const auto check = [&](const std::vector<mc::FeatureResult>& features,
                           const std::string& sensor) {
        const auto measured = features_of_export(folder, sensor + "_noise_1", settings);
        for (const char* name : {"sensor_rms", "window_ratio", "window_z", "window_kurtosis", "fm4",
                                 "crest_factor", "kurtogram_peak"}) {
            INFO(sensor << " " << name);
            CHECK(values(features, name)[25] ==
                  Approx(printed_value(measured, name)).epsilon(kMean));
        }
    };
    check(results.features, "sensor");
    check(results.variants[0].features, "sensor_side");
}

TEST_CASE("Signals recorded during integration equal those of the kept motion") {
    const Folder folder;
    const std::string settings =
        options({kModes, kSide, "features.baseline_torque_scatter=0.02", "sensor.record_s=9",
                 "sensor.noise_levels=[0]",
                 "features.use=[\"sensor_rms\", \"window_ratio\", \"change_window_ratio\", "
                 "\"crest_factor\"]"});
    const mc::Results kept = run_small(folder, "kept.h5", settings),
                      recorded =
                          run_small(folder, "full.h5", settings + "--set numerics.horizon=full");
    for (std::size_t f = 0; f < kept.features.size(); ++f) {
        INFO(kept.features[f].name);
        check_close(kept.features[f].values, recorded.features[f].values, 2e-3);
        check_close(kept.variants[0].features[f].values, recorded.variants[0].features[f].values,
                    2e-3);
    }
}

TEST_CASE("A study with settings of the sensors reads back from its resolved text") {
    for (const std::vector<std::string>& settings :
         {everything("other_fault"),
          {"sensor.housing_modes=[{frequency_Hz=70.5, damping=0.03, participation=-0.8, "
           "sun_bearing_per_kg=0.02, carrier_bearing_per_kg=-1e-3}, {frequency_Hz=90, "
           "damping=0.02, participation=0.1, nodal_diameters=2}]",
           "sensor.additional=[{name='b', angle_deg=-33.3, direction='tangential', gain=1.7, "
           "noise=0.3, participation=[0.1, 1e-3], sun_bearing_per_kg=[0.1, 0], "
           "carrier_bearing_per_kg=[2, 0]}, {name='c', angle_deg=30, sampling_Hz=150, "
           "low_pass_Hz=50.5, mounting_Hz=70, mounting_damping=0.1, delay_s=-1e-3, "
           "quantisation_m_s2=0, range_m_s2=20}, {name='d', angle_deg=1, mounting_Hz=1e4}]",
           "sensor.bearings=[{fault='roller', shaft_Hz=12.3, elements=11, diameter_ratio=0.17, "
           "contact_angle_deg=13.7, amplitude_m_s2=0.3, resonance_Hz=101.7, damping=0.03, "
           "slip=0.013, load_zone_deg=133.3, role='other_fault'}]",
           "sensor.tones=[{shaft='carrier', order=7, amplitude_m_s2=0.1}]"},
          {"sensor.response_Hz=[1, 2]", "sensor.response_gain=[1, 2]",
           "sensor.response_phase_deg=[0, 30]", "sensor.sun_response_gain=[0.1, 0.2]",
           "sensor.sun_response_phase_deg=[10, 20]",
           "sensor.additional=[{name='b', angle_deg=30, carrier_response_gain=[1, 2], "
           "carrier_response_phase_deg=[3, 4.5]}]"}}) {
        check_reads_back(valid_study(mc::read_study(kSmall, settings)));
    }
}

}  // namespace gearpod::test_sensor_settings
