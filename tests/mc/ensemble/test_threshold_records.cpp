// Checks several records of each gearbox in the threshold group: same vibration, other noise.
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/results/result_rows.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test_threshold_records {

using namespace test;

constexpr int kGearboxes = 18, kRecords = 3, kGraded = 5;

mc::Study study_of(int records, const std::string& lanes = "8",
                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> keys{"ensemble.threshold_instances=" + std::to_string(kGearboxes),
                                  "ensemble.instances=" + std::to_string(kGraded),
                                  "ensemble.threshold_records=" + std::to_string(records),
                                  "sensor.noise_levels=[0,1]", "numerics.lanes=" + lanes};
    keys.insert(keys.end(), more.begin(), more.end());
    return shipped_study("planet-crack-ideal.toml", keys);
}

const std::vector<std::string> kImportanceSampling{"ensemble.threshold_tilt=true"};

// Values of a parameter or of a feature's level.
const std::vector<double>& parameter(const mc::Results& results, const std::string& name) {
    return std::find_if(results.parameters.begin(), results.parameters.end(),
                        [&](const auto& p) { return p.name == name; })
        ->values;
}
double value_of(const mc::Results& results, const std::string& feature, std::size_t row,
                std::size_t level = 1) {
    return std::find_if(results.features.begin(), results.features.end(),
                        [&](const auto& f) { return f.name == feature; })
        ->values[2 * row + level];
}

TEST_CASE(
    "Records of a gearbox differ in their noise alone, and the first equals a single record") {
    const mc::Results single = run(study_of(1)), several = run(study_of(kRecords));
    REQUIRE(several.status.size() == kGearboxes * kRecords + kGraded);
    for (std::size_t row = 0; row < several.status.size(); ++row) {
        const bool test = row >= kGearboxes * kRecords;
        const std::size_t alone = test ? row - kGearboxes * (kRecords - 1) : row / kRecords;
        const bool first = test || row % kRecords == 0;
        CHECK(several.group[row] == single.group[alone]);
        for (std::size_t p = 0; p < single.parameters.size(); ++p) {
            CHECK(several.parameters[p].values[row] == single.parameters[p].values[alone]);
        }
        for (std::size_t f = 0; f < single.features.size(); ++f) {
            const auto value = [&](const mc::Results& results, std::size_t at, std::size_t level) {
                return results.features[f].values[2 * at + level];
            };
            INFO(single.features[f].name << " " << row);
            // Values without noise agree except for rounding: spectra of both are computed
            // together.
            CHECK(value(several, row, 0) == Approx(value(single, alone, 0)).epsilon(1e-11));
            CHECK((value(several, row, 0) == value(single, alone, 0) || !first));
            CHECK((value(several, row, 1) == value(single, alone, 1)) == first);
        }
    }
    for (const analysis::FeatureDetection& feature : mc::detect_all(several)) {
        CHECK(feature.levels[1].threshold_sample == kGearboxes * kRecords);
    }
}

TEST_CASE("Every record of a gearbox has a baseline of the same vibration with independent noise") {
    const mc::Results results = run(
        study_of(kRecords, "8",
                 {"features.use=[\"te_rms\",\"own_te_rms\",\"sensor_rms\",\"own_sensor_rms\"]"}));
    for (const std::string feature : {"te_rms", "sensor_rms"}) {
        const auto baseline = [&](std::size_t row, std::size_t level) {
            return value_of(results, feature, row, level) /
                   value_of(results, "own_" + feature, row, level);
        };
        for (std::size_t row = 0; row < kGearboxes * kRecords; ++row) {
            const std::size_t first = row - row % kRecords;
            INFO(feature << " " << row);
            CHECK(baseline(row, 0) == Approx(baseline(first, 0)).epsilon(1e-9));
            CHECK((std::abs(baseline(row, 1) / baseline(first, 1) - 1.0) > 1e-9) == (row != first));
        }
    }
}

TEST_CASE("Records of a gearbox have the same bits for any lanes, and when simulated alone") {
    const mc::Results results = run(study_of(kRecords));
    CHECK(bits(run(study_of(kRecords, "1"))) == bits(results));
    const mc::Study study = study_of(kRecords);
    const mc::Scene scene(study);
    const mc::RowOrder& rows = scene.draw().rows;
    const long row = 4 * kRecords + 2;
    const mc::GearboxId id = rows.id_of(row);
    CHECK(id.index == 4);
    CHECK(id.repeat == 2);
    CHECK(rows.id_of(kGearboxes * kRecords).group == mc::Group::test);
    const mc::Simulation alone = mc::simulate(scene.tile(), id, 1);
    for (std::size_t f = 0; f < results.features.size(); ++f) {
        for (std::size_t level = 0; level < 2; ++level) {
            CHECK(alone.features[2 * f + level] ==
                  results.features[f].values[2 * static_cast<std::size_t>(row) + level]);
        }
    }
}

TEST_CASE(
    "Exponentially tilted records are plain ones with stretches of shifted noise, and have "
    "weights") {
    constexpr int kWeightedRecords = 8;
    const mc::Results plain = run(study_of(kWeightedRecords)),
                      importance_sampled =
                          run(study_of(kWeightedRecords, "8", kImportanceSampling));
    const std::vector<double>& weight = parameter(importance_sampled, mc::kNoiseWeight);
    REQUIRE(weight.size() == kGearboxes * kWeightedRecords + kGraded);
    double sum = 0.0;
    for (std::size_t row = 0; row < weight.size(); ++row) {
        const bool test = row >= kGearboxes * kWeightedRecords;
        const bool plain_noise = test || row % 4 == 0;
        INFO(row << " " << weight[row]);
        CHECK((value_of(importance_sampled, "sensor_rms", row) ==
               value_of(plain, "sensor_rms", row)) == plain_noise);
        // A stretch that is not the loudest does not change the ratio.
        CHECK((value_of(importance_sampled, "window_ratio", row) ==
                   value_of(plain, "window_ratio", row) ||
               !plain_noise));
        CHECK(value_of(importance_sampled, "te_rms", row) == value_of(plain, "te_rms", row));
        CHECK((test ? weight[row] == 1.0 : weight[row] > 0.0 && weight[row] <= 4.0));
        sum += test ? 0.0 : weight[row] / (kGearboxes * kWeightedRecords);
    }
    CHECK(sum == Approx(1.0).margin(0.4));
    CHECK(importance_sampled.request.importance_sampling);
}

TEST_CASE(
    "Exponentially tilted records have the same bits for any lanes, and when simulated alone") {
    const mc::Results results = run(study_of(4, "8", kImportanceSampling));
    CHECK(bits(run(study_of(4, "1", kImportanceSampling))) == bits(results));
    const mc::Study study = study_of(4, "8", kImportanceSampling);
    const mc::Scene scene(study);
    const mc::Simulation alone = mc::simulate(scene.tile(), scene.draw().rows.id_of(4 * 5 + 3), 1);
    for (std::size_t f = 0; f < results.features.size(); ++f) {
        CHECK(alone.features[2 * f + 1] == results.features[f].values[2 * (4 * 5 + 3) + 1]);
    }
}

TEST_CASE(
    "Few gearboxes of exponentially tilted records give a threshold for 1e-3 where noise causes "
    "alarms") {
    const mc::Results results =
        run(study_of(16, "8",
                     {"ensemble.threshold_tilt=true", "ensemble.threshold_instances=200",
                      "sensor.noise_levels=[0,5]", "detection.false_alarm_rate=1e-3",
                      "features.use=[\"window_ratio\"]"}));
    const analysis::FeatureDetection found = mc::detect_all(results).front();
    const analysis::LevelDetection& level = found.levels[1];
    REQUIRE(level.importance_sampled);
    CHECK(level.importance_sampled->gearboxes == 200);
    CHECK(level.importance_sampled->extrapolation == Approx(1.0 / (200 * 1e-3)));
    CHECK(level.threshold_rate.lower < 1e-3);
    CHECK(level.threshold_rate.upper > 1e-3);
    CHECK(level.threshold_rate.upper / level.threshold_rate.lower < 3.0);
}

TEST_CASE("Tilting without records, with other counts or with coloured noise is refused") {
    const auto problem = [](const std::vector<std::string>& keys) {
        return mc::format(mc::read_study(test::study("planet-crack-ideal.toml"), keys).problems);
    };
    CHECK_THAT(problem({"ensemble.threshold_tilt=true"}),
               Catch::Contains("only with ensemble.threshold_records") &&
                   !Catch::Contains("not a multiple"));
    CHECK_THAT(problem({"ensemble.threshold_tilt=true", "ensemble.threshold_records=6"}),
               Catch::Contains("6 is not a multiple of 4") && Catch::Contains("use 8"));
    const auto coloured =
        mc::format(mc::read_study(test::study("noise-density.toml"),
                                  {"ensemble.threshold_tilt=true", "ensemble.threshold_records=8"})
                       .problems);
    CHECK_THAT(coloured, Catch::Contains("tilting needs white noise"));
    CHECK_THAT(problem({"ensemble.threshold_tilt=true", "ensemble.threshold_records=8",
                        "sensor.background_Hz=[10,500]",
                        "sensor.background_density_m_s2_per_sqrt_Hz=[0.01,0.01]"}),
               Catch::Contains("tilting needs white noise: background_Hz colours it"));
}

}  // namespace gearpod::test_threshold_records
