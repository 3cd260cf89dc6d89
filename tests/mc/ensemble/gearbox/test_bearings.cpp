// Checks faulty bearings in studies: as background, and as another fault in healthy gearboxes.
#include <fmt/format.h>

#include "mc/ensemble/gearbox/other_sources.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/result_rows.hpp"
#include "mc/study/sensor_signal.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_bearings {

using namespace test;

std::string inner_ring(const std::string& role) {
    return "--set 'sensor.bearings=[{fault=\"inner\", shaft=\"sun\", elements=9, "
           "diameter_ratio=0.2, amplitude_m_s2=0.05, resonance_Hz=90, role=\"" +
           role + "\"}]' ";
}

// Runs the small study with a few gearboxes; returns its results.
mc::Results run(const Folder& folder, const std::string& name, const std::string& options) {
    const std::string path = folder.file(name);
    require_success("run " + kSmall +
                    " --set ensemble.threshold_instances=40 --set "
                    "ensemble.instances=20 --out " +
                    path + " " + options);
    return mc::read_results(path);
}

// A run with another fault, computed once.
struct OtherFaultRun {
    Folder folder;
    std::string path = folder.file("r.h5");
    mc::Results results = run(folder, "r.h5", inner_ring("other_fault"));
};
const OtherFaultRun& with_other_fault() {
    static const OtherFaultRun once;
    return once;
}

// Values of a feature in the rows of the threshold group.
std::vector<double> healthy(const mc::Results& results, const mc::FeatureResult& feature) {
    const auto rows = std::ranges::count(results.group, static_cast<int>(mc::Group::threshold)) *
                      static_cast<std::ptrdiff_t>(results.noise_levels.size());
    return {feature.values.begin(), feature.values.begin() + rows};
}

std::vector<double> column(const std::string& path, const std::string& name) {
    return columns_of(path).at(name);
}

mc::Bearing bearing_6205(mc::BearingFault fault) {
    mc::Bearing bearing;
    bearing.fault = fault;
    bearing.elements = 9;
    bearing.diameter_ratio = 7.94 / 39.04;  // mm
    return bearing;
}

// Frequencies of the drive-end bearing SKF 6205-2RS, per turn, as the bearing data centre of Case
// Western Reserve University gives them.
TEST_CASE("Impulses per turn are those published for a bearing 6205") {
    using mc::BearingFault;
    CHECK(impulses_per_turn(bearing_6205(BearingFault::inner)) == Approx(5.4152).epsilon(1e-4));
    CHECK(impulses_per_turn(bearing_6205(BearingFault::outer)) == Approx(3.5848).epsilon(1e-4));
    CHECK(impulses_per_turn(bearing_6205(BearingFault::cage)) == Approx(0.39828).epsilon(1e-4));
    CHECK(impulses_per_turn(bearing_6205(BearingFault::roller)) == Approx(4.7135).epsilon(1e-4));
    CHECK(load_turns_per_turn(bearing_6205(BearingFault::inner)) == 1.0);
    CHECK(load_turns_per_turn(bearing_6205(BearingFault::outer)) == 0.0);
}

TEST_CASE("A bearing in the background is added to the sensor's signal") {
    const Folder folder;
    const auto simulate = [&](const std::string& name, const std::string& options) {
        return require_success("simulate " + kSmall + " --instance 2 --meshes 455 --out " +
                               folder.file(name) + " " + options);
    };
    simulate("without.csv", "");
    const auto with = simulate("with.csv", inner_ring("background"));
    const auto measured = program("features " + folder.file("with.csv") +
                                  " --sensor sensor_noise_1 --study " + kSmall);
    for (const char* name : {"sensor_rms", "window_ratio", "fm4", "kurtogram_peak"}) {
        INFO(name << "\n" << with.output << measured.output);
        CHECK(printed_value(with, name) != 0.0);
        CHECK(printed_value(with, name) == Approx(printed_value(measured, name)).epsilon(kMean));
    }
    simulate("quiet.csv", inner_ring("background") + "--set sensor.bearing_level=0");
    CHECK(bytes_of(folder.file("without.csv")) == bytes_of(folder.file("quiet.csv")));
    CHECK(column(folder.file("without.csv"), "te") == column(folder.file("with.csv"), "te"));
    CHECK(column(folder.file("without.csv"), "sensor") !=
          column(folder.file("with.csv"), "sensor"));
}

// The same gearboxes with the bearing in all records, which another code path computes.
TEST_CASE("Another fault changes the healthy gearboxes as a background would") {
    const Folder folder;
    const mc::Results plain = run(folder, "plain.h5", ""), &other = with_other_fault().results,
                      background = run(folder, "background.h5", inner_ring("background"));
    REQUIRE(other.variants.size() == 1);
    CHECK(plain.variants.empty());
    CHECK(background.variants.empty());
    CHECK(other.variants[0].name == mc::kOtherFault);
    for (std::size_t f = 0; f < plain.features.size(); ++f) {
        const std::string& name = plain.features[f].name;
        INFO(name);
        CHECK(bits_of(healthy(other, other.features[f])) ==
              bits_of(healthy(plain, plain.features[f])));
        if (name != "na4") {
            CHECK(bits_of(healthy(other, other.variants[0].features[f])) ==
                  bits_of(healthy(background, background.features[f])));
        }
    }
    const std::size_t rows = plain.group.size() - 20;
    const auto& values = other.variants[0].features[0].values;
    CHECK(std::all_of(values.begin() + static_cast<std::ptrdiff_t>(rows), values.end(),
                      [](double value) { return std::isnan(value); }));
}

TEST_CASE("Alarms of another fault are counted at the thresholds of the healthy gearboxes") {
    const mc::Results& results = with_other_fault().results;
    const auto alarms = other_fault_alarms(results, mc::ColumnRows(results));
    // The transmission error does not change with a bearing.
    REQUIRE(alarms.size() == static_cast<std::size_t>(std::ranges::count_if(
                                 results.features, [](const mc::FeatureResult& feature) {
                                     return !feature.name.starts_with("te_");
                                 })));
    bool any = false;
    for (const mc::OtherFaultAlarms& one : alarms) {
        const mc::FeatureResult& feature = results.features[one.feature];
        const double threshold = results.detection[one.feature].levels[0].threshold;
        long expected = 0;
        for (const double value : healthy(results, results.variants[0].features[one.feature])) {
            expected +=
                feature.alarm == analysis::Alarm::high ? value > threshold : value < threshold;
        }
        CHECK(one.alarms == expected);
        CHECK(one.tested == 40);
        any |= one.alarms > one.without;
    }
    CHECK(any);
    check_mentions(program("report " + with_other_fault().path + " --full"),
                   {"a fault of the inner ring of a bearing of the sun"});
    CHECK(program("describe " + kSmall + " " + inner_ring("other_fault"))
              .mentions("5.400 impulses per shaft turn"));
}

TEST_CASE("The signal of the other fault is exported on its own") {
    const Folder folder;
    const auto other = signals_of_small(folder, inner_ring("other_fault"), 30),
               background = signals_of_small(folder, inner_ring("background"), 30);
    auto sum = other.at("sensor");
    std::ranges::transform(sum, other.at("other_fault"), sum.begin(), std::plus<>());
    CHECK(largest_difference(sum, background.at("sensor")) < 1e-9);
}

TEST_CASE("Results whose variants were renamed are refused") {
    const Folder folder;
    std::filesystem::copy_file(with_other_fault().path, folder.file("r.h5"));
    const std::string script = "import h5py; f = h5py.File('" + folder.file("r.h5") +
                               "', 'r+'); f.move('variants/other_fault', 'variants/sensor_side')";
    if (shell("/usr/bin/python3 -c \"" + script + "\"").code != 0) {
        WARN("h5py is not there");
        return;
    }
    check_refused("repair " + folder.file("r.h5"),
                  {"member 1 is sensor_side, but in the study it is other_fault"});
}

TEST_CASE("A tone of a shaft has its order times the shaft's speed") {
    const Folder folder;
    const auto signal = [&](const std::string& tone) {
        return signals_of_small(folder, "--set 'sensor.tones=[{" + tone + ", amplitude_m_s2=0.5}]'",
                                20)
            .at("sensor");
    };
    // The sun turns (13 + 35) / 13 times as fast as the carrier, at 1 Hz.
    CHECK(largest_difference(signal("shaft=\"sun\", order=2.5"),
                             signal(fmt::format("frequency_Hz={:.17g}", 2.5 * 48.0 / 13.0))) <
          1e-9);
}

TEST_CASE("Problems of bearings and tones are all reported at once") {
    check_refused(
        "describe " + kSmall +
            " --set 'sensor.bearings=[{fault=\"outr\", shaft=\"ring\", elements=2.5, "
            "amplitude_m_s2=-1, resonance_Hz=90}, 3, {fault=\"cage\", shaft=\"sun\", shaft_Hz=3, "
            "elements=9, diameter_ratio=0.2, amplitude_m_s2=1, resonance_Hz=90, ball=4}]'"
            " --set 'sensor.tones=[{shaft=\"pinion\", order=1, amplitude_m_s2=1}, "
            "{shaft=\"sun\", frequency_Hz=3, amplitude_m_s2=1}]'",
        {"bearing 1: fault: unknown value \"outr\"", "bearing 1: elements must be an integer",
         "bearing 1 has no diameter_ratio", "bearing 1: amplitude_m_s2 must be > 0",
         "bearing 2 must be a table, but is an integer", "bearing 3: unknown key ball",
         "tone 2: has both shaft and frequency_Hz"});
    check_refused("describe " + kSmall +
                      " --set 'sensor.bearings=[{fault=\"outer\", shaft=\"ring\", elements=9, "
                      "diameter_ratio=0.2, amplitude_m_s2=1, resonance_Hz=90}]'"
                      " --set 'sensor.tones=[{shaft=\"pinion\", order=1, amplitude_m_s2=1}]'"
                      " --set ensemble.threshold_records=2",
                  {"the ring stands still", "this kind of gearbox has no pinion",
                   "all records of a gearbox would have the same vibration"});
}

}  // namespace gearpod::test_bearings
