// Several records of each gearbox that sets thresholds: the same motion, other noise.
#include "mc/gearbox/simulation.hpp"
#include "mc/results/batch_rows.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"

using namespace gearpod;
using test::bits;
using test::shipped_study;

namespace {

constexpr int kGearboxes = 18, kRecords = 3, kGraded = 5;

mc::Study study_of(int records, const std::string& lanes = "8") {
    return shipped_study("planet-crack-ideal.toml",
                         {"ensemble.threshold_instances=" + std::to_string(kGearboxes),
                          "ensemble.instances=" + std::to_string(kGraded),
                          "ensemble.threshold_records=" + std::to_string(records),
                          "sensor.noise_levels=[0,1]", "numerics.lanes=" + lanes});
}

}  // namespace

TEST_CASE("Records of a gearbox differ in their noise alone, and the first is as without others") {
    const mc::Results single = test::run(study_of(1)), several = test::run(study_of(kRecords));
    REQUIRE(several.status.size() == kGearboxes * kRecords + kGraded);
    for (std::size_t row = 0; row < several.status.size(); ++row) {
        const bool graded = row >= kGearboxes * kRecords;
        const std::size_t alone = graded ? row - kGearboxes * (kRecords - 1) : row / kRecords;
        const bool first = graded || row % kRecords == 0;
        CHECK(several.group[row] == single.group[alone]);
        for (std::size_t p = 0; p < single.parameters.size(); ++p) {
            CHECK(several.parameters[p].values[row] == single.parameters[p].values[alone]);
        }
        for (std::size_t f = 0; f < single.features.size(); ++f) {
            const auto value = [&](const mc::Results& results, std::size_t at, std::size_t level) {
                return results.features[f].values[2 * at + level];
            };
            INFO(single.features[f].name << " " << row);
            // Without noise but for rounding: spectra of both are had at once.
            CHECK(value(several, row, 0) == Approx(value(single, alone, 0)).epsilon(1e-11));
            CHECK((value(several, row, 0) == value(single, alone, 0) || !first));
            CHECK((value(several, row, 1) == value(single, alone, 1)) == first);
        }
    }
    for (const analysis::FeatureDetection& feature : mc::detect_all(several)) {
        CHECK(feature.levels[1].threshold_sample == kGearboxes * kRecords);
    }
}

TEST_CASE("Records of a gearbox are the same bits by any lanes, and when simulated alone") {
    const mc::Results results = test::run(study_of(kRecords));
    CHECK(bits(test::run(study_of(kRecords, "1"))) == bits(results));
    const mc::Study study = study_of(kRecords);
    const mc::Scene scene(study);
    const long row = 4 * kRecords + 2;
    const mc::GearboxId id = mc::id_of_row(study, row);
    CHECK(id.index == 4);
    CHECK(id.repeat == 2);
    CHECK(mc::id_of_row(study, kGearboxes * kRecords).group == mc::Group::graded);
    const mc::Simulation alone = mc::simulate(scene, id, 1);
    for (std::size_t f = 0; f < results.features.size(); ++f) {
        for (std::size_t level = 0; level < 2; ++level) {
            CHECK(alone.features[2 * f + level] ==
                  results.features[f].values[2 * static_cast<std::size_t>(row) + level]);
        }
    }
}
