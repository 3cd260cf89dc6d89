// Checks additional sensors of a run: signals, features, baselines and records of given length.
#include "analysis/statistics/distributions.hpp"
#include "mc/report/run_sections.hpp"
#include "mc/results/result_rows.hpp"
#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_additional_sensors {

using namespace test;

std::string sensors(const std::string& list) {
    return " --set 'sensor.additional=[" + list + "]' ";
}

mc::Results run(const Folder& folder, const std::string& name, const std::string& options) {
    return run_small(folder, name, "--set sensor.noise_levels=[0,1] " + options);
}

// Values of a feature at one of the two noise levels.
std::vector<double> at_level(const mc::FeatureResult& feature, std::size_t level) {
    return every(2, feature.values, level);
}

const mc::FeatureResult& named(const std::vector<mc::FeatureResult>& features,
                               const std::string& name) {
    return *std::ranges::find(features, name, &mc::FeatureResult::name);
}

TEST_CASE("A second sensor at the place of the first one differs in its noise only") {
    const Folder folder;
    const mc::Results plain = run(folder, "plain.h5", ""),
                      twin = run(folder, "twin.h5", sensors("{name=\"twin\", angle_deg=0}"));
    REQUIRE(twin.variants.size() == 1);
    CHECK(twin.variants[0].name == "sensor_twin");
    for (std::size_t f = 0; f < plain.features.size(); ++f) {
        INFO(plain.features[f].name);
        const mc::FeatureResult& own = twin.variants[0].features[f];
        CHECK(bits_of(twin.features[f].values) == bits_of(plain.features[f].values));
        CHECK(bits_of(at_level(own, 0)) == bits_of(at_level(plain.features[f], 0)));
        const bool of_te = plain.features[f].name.starts_with("te_");
        CHECK((bits_of(at_level(own, 1)) == bits_of(at_level(plain.features[f], 1))) == of_te);
    }
}

TEST_CASE("Gain and noise of an additional sensor are relative to the first one's") {
    const Folder folder;
    const mc::Results results = run(folder, "gain.h5",
                                    sensors("{name=\"loud\", angle_deg=0, gain=2}, "
                                            "{name=\"quiet\", angle_deg=0, noise=0}"));
    const auto first = at_level(named(results.features, "sensor_rms"), 0),
               loud = at_level(named(results.variants[0].features, "sensor_rms"), 0),
               quiet = at_level(named(results.variants[1].features, "sensor_rms"), 1);
    for (std::size_t row = 0; row < first.size(); ++row) {
        CHECK(loud[row] == Approx(2.0 * first[row]).epsilon(1e-12));
    }
    CHECK(quiet == first);
}

TEST_CASE("Baselines and records of given length belong to each sensor") {
    const Folder folder;
    const std::string options =
        " --set sensor.record_s=9 --set 'features.use=[\"sensor_rms\", \"own_window_ratio\", "
        "\"change_window_ratio\", \"change_fm4\", \"na4\"]' --set features.baseline_records=2"
        " --set features.baseline_torque_scatter=0.02";
    const mc::Results results =
        run(folder, "baseline.h5",
            options + sensors("{name=\"twin\", angle_deg=0}, {name=\"side\", angle_deg=77}"));
    for (std::size_t f = 0; f < results.features.size(); ++f) {
        INFO(results.features[f].name);
        const auto first = at_level(results.features[f], 0);
        CHECK(at_level(results.variants[0].features[f], 0) == first);
        CHECK(at_level(results.variants[1].features[f], 0) != first);
    }
}

TEST_CASE("Cross-axis sensitivity adds that part of the acceleration at right angles") {
    const Folder folder;
    const std::string options = " --set sensor.noise_levels=[0] " +
                                sensors("{name=\"side\", angle_deg=0, direction=\"tangential\"}");
    const auto pure = signals_of_small(folder, options),
               mixed = signals_of_small(folder, options + "--set sensor.cross_axis_percent=5 ");
    const std::vector<double>&radial = pure.at("sensor"), &tangential = pure.at("sensor_side");
    for (std::size_t i = 0; i < radial.size(); ++i) {
        REQUIRE(mixed.at("sensor")[i] == Approx(radial[i] + 0.05 * tangential[i]).margin(1e-5));
        REQUIRE(mixed.at("sensor_side")[i] ==
                Approx(tangential[i] + 0.05 * radial[i]).margin(1e-5));
    }
}

// Two sensors with independent normal noise: a fault that shifts each by d standard deviations
// shifts their mean by d sqrt(2) of its own. The area under the ROC is Phi(d / sqrt(2)) alone and
// Phi(d) together.
TEST_CASE("The mean of two sensors has the area under the ROC that theory gives") {
    mc::Results results;
    constexpr int kHealthy = 4000, kFaulty = 4000;
    constexpr double kShift = 1.2;
    results.parameters = {{"fault_size", "1", {}}};
    results.noise_levels = {1.0};
    results.features = {{"sensor_rms", "m/s^2", analysis::Alarm::high, {}}};
    results.variants = {{"sensor_side", "", results.features}};
    results.request.noise_levels = {1.0};
    results.request.groups = {{0.5, 0.5}};
    results.request.size = {"fault_size", "1"};
    std::mt19937_64 engine(17);
    std::normal_distribution<double> unit;
    for (int i = 0; i < kHealthy + kFaulty; ++i) {
        const bool faulty = i >= kHealthy;
        results.group.push_back(faulty ? 1 : 0);
        results.status.push_back(0);
        results.parameters[0].values.push_back(faulty ? 0.5 : 0.0);
        const double shift = faulty ? kShift : 0.0;
        results.features[0].values.push_back(10.0 + unit(engine) + shift);
        results.variants[0].features[0].values.push_back(3.0 + 0.2 * (unit(engine) + shift));
    }
    const auto found = sensor_detections(results, mc::ColumnRows(results));
    const char* const names[] = {"first", "side", "mean of all", "largest of all"};
    REQUIRE(std::ranges::equal(found, names, {}, [](const auto& one) { return one.name; }));
    REQUIRE(found[2].change);
    const double alone = analysis::normal_cdf(kShift / std::sqrt(2.0)),
                 together = analysis::normal_cdf(kShift);
    CHECK(found[2].change->auc.a == Approx(alone).margin(0.015));
    CHECK(found[2].change->auc.b == Approx(together).margin(0.015));
    CHECK(found[2].change->auc.bounds.lower > 0.0);
    CHECK(std::abs(found[1].change->auc.difference()) < 0.02);

    // At a second noise level the other sensor sees more: the comparison is made there.
    results.noise_levels = results.request.noise_levels = {1.0, 0.5};
    for (mc::FeatureResult* feature : {&results.features[0], &results.variants[0].features[0]}) {
        const std::vector<double> first = feature->values;
        feature->values.clear();
        for (std::size_t row = 0; row < first.size(); ++row) {
            const bool more = feature != &results.features[0] && results.group[row] == 1;
            feature->values.insert(feature->values.end(),
                                   {first[row], first[row] + (more ? 0.2 * kShift : 0.0)});
        }
    }
    const auto differing = sensor_detections(results, mc::ColumnRows(results));
    CHECK(differing[1].noise_level == 0.5);
    CHECK(differing[1].change->auc.difference() > 0.1);
    CHECK(found[1].noise_level == 1.0);
}

TEST_CASE("Problems of additional sensors are all reported") {
    check_refused(
        "describe " + kSmall +
            sensors("{name=\"Side 1\", angle_deg=400}, {name=\"a\", angle_deg=1, gain=0}, "
                    "{name=\"a\", angle_deg=2, direction=\"up\"}"),
        {"sensor 1: name must have lower-case letters", "sensor 1: angle_deg must be",
         "sensor 2: gain must be > 0", "sensor 3: another one has the name \"a\"",
         "sensor 3: direction: unknown value \"up\""});
    CHECK(program("describe " + kSmall + sensors("{name=\"side\", angle_deg=90}"))
              .mentions("\"side\": 90 degrees from the first one, radial"));
}

}  // namespace gearpod::test_additional_sensors
