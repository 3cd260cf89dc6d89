// Checks ensembles: the same bits for any way of computation, reuse against full integration, and
// plausible detection rates.
#include "mc/study/schema/sizes.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test_ensemble {

using namespace test;

const std::vector<std::string> kSmall{"ensemble.instances=11", "ensemble.threshold_instances=6"};

std::vector<std::string> with(std::vector<std::string> overrides, const std::string& more) {
    overrides.push_back(more);
    return overrides;
}

// Results of the small ensemble, computed once.
const mc::Results& small_results() {
    static const mc::Results results = run(shipped_study("planet-crack-ideal.toml", kSmall));
    return results;
}

TEST_CASE("One lane, four or eight, one thread or two, any instruction set: the same bits") {
    const auto reference = bits(small_results());
    for (const char* change :
         {"numerics.lanes=1", "numerics.lanes=4", "numerics.threads=1", "numerics.threads=2"}) {
        INFO(change);
        CHECK(bits(run(shipped_study("planet-crack-ideal.toml", with(kSmall, change)))) ==
              reference);
    }
    for_each_instruction_set(
        [&] { CHECK(bits(run(shipped_study("planet-crack-ideal.toml", kSmall))) == reference); });
}

TEST_CASE("Single precision: the same bits for any lanes and threads, features as in double") {
    const std::string integrator =
        GENERATE("numerics.integrator=rk4", "numerics.integrator=central-difference");
    const auto doubles = with(kSmall, integrator);
    const auto single = with(doubles, "numerics.precision=single");
    const auto reference = run(shipped_study("planet-crack-ideal.toml", single));
    CHECK(shipped_study("planet-crack-ideal.toml", single).numerics.lanes == 16);
    for (const char* change : {"numerics.lanes=8", "numerics.lanes=1", "numerics.threads=1"}) {
        INFO(change);
        CHECK(bits(run(shipped_study("planet-crack-ideal.toml", with(single, change)))) ==
              bits(reference));
    }
    const auto exact = run(shipped_study("planet-crack-ideal.toml", doubles));
    REQUIRE(exact.features.size() == reference.features.size());
    for (std::size_t f = 0; f < exact.features.size(); ++f) {
        INFO(exact.features[f].name);
        // Feature window_z divides by the teeth's scatter: with little noise a few thousandths of
        // their RMS, without noise rounding.
        const bool rounding = exact.features[f].name == "window_z";
        const double tolerance = rounding ? 5e-3 : 1e-3;
        for (std::size_t i = 0; i < exact.features[f].values.size(); ++i) {
            if (!(rounding && i % exact.noise_levels.size() == 0)) {
                CHECK(reference.features[f].values[i] ==
                      Approx(exact.features[f].values[i]).epsilon(tolerance));
            }
        }
    }
}

TEST_CASE("Features by central differences and Runge-Kutta agree within the error of the steps") {
    const auto& exact = small_results();
    const auto central = run(shipped_study("planet-crack-ideal.toml",
                                           with(kSmall, "numerics.integrator=central-difference")));
    const std::size_t levels = exact.noise_levels.size();
    for (std::size_t f = 0; f < exact.features.size(); ++f) {
        INFO(exact.features[f].name);
        double deviation = 0.0, own = 0.0;
        for (std::size_t i = 0; i < exact.features[f].values.size(); ++i) {
            // Feature window_z without noise divides by the scatter of equal teeth.
            if (i % levels != 0) {
                const double value = exact.features[f].values[i];
                deviation += std::pow(central.features[f].values[i] - value, 2);
                own += value * value;
            }
        }
        CHECK(std::sqrt(deviation / own) < 2e-3);
        CHECK(deviation > 0.0);  // the methods differ
    }
}

TEST_CASE("A larger ensemble begins with the gearboxes of the smaller one") {
    const auto& small = small_results();
    const auto large = run(shipped_study(
        "planet-crack-ideal.toml", {"ensemble.instances=16", "ensemble.threshold_instances=6"}));
    const std::size_t levels = small.noise_levels.size();
    for (std::size_t f = 0; f < small.features.size(); ++f) {
        for (std::size_t i = 0; i < small.status.size() * levels; ++i) {
            CHECK(small.features[f].values[i] == large.features[f].values[i]);
        }
    }
}

TEST_CASE("Reused mesh periods and full integration agree to 1e-6 in every noise-free feature") {
    // Feature window_z is left out: it divides by the scatter of teeth that are equal except for
    // rounding. A fast carrier needs fewer steps per mesh.
    const mc::Study planet = shipped_study(
        "published/liang-fig-5-8.toml",
        {R"(features.use=["te_rms","te_kurtosis","te_fc","te_fm0","sensor_rms","window_ratio"])",
         "operation.carrier_speed_rpm=45"});
    mc::Study sun = planet;
    sun.fault.member = mc::Member::sun;
    sun.random.clear();
    mc::set_fault_size(sun, 2.34e-3);
    for (mc::Study study : {planet, sun}) {
        const auto reuse = run(study);
        study.numerics.horizon = mc::Horizon::full;
        const auto full_integration = run(study);
        for (std::size_t f = 0; f < reuse.features.size(); ++f) {
            INFO(reuse.features[f].name);
            test::check_close(reuse.features[f].values, full_integration.features[f].values, 1e-6);
        }
    }
}

TEST_CASE("Detection rates: false alarms at size 0, more with size, never more with noise") {
    const mc::Study study = shipped_study(
        "planet-crack-ideal.toml", {"ensemble.instances=1050", "ensemble.threshold_instances=600",
                                    "sensor.noise_levels=[0.5, 1, 2, 5]"});
    const mc::Results results = run(study);
    const auto detection = mc::detect_all(results);
    const double alpha = study.detection.false_alarm_rate;
    for (const auto& feature : detection) {
        for (std::size_t level = 0; level < feature.levels.size(); ++level) {
            const auto& cells = feature.levels[level].cells;
            INFO(feature.feature << ", noise level " << feature.levels[level].noise_level);
            // Scatter of the rate's sample and of the threshold; 4.5 standard deviations.
            const double n = static_cast<double>(cells[0].tested);
            const double sd = std::sqrt(alpha * (1 - alpha) * (1 / n + 1.0 / 600));
            CHECK(std::abs(cells[0].pd - alpha) < 4.5 * sd);
            for (const auto& cell : cells) {
                CHECK(cell.failed == 0);
                CHECK(cell.lower <= cell.pd);
                CHECK(cell.pd <= cell.upper);
                CHECK(cell.tested == 150);
            }
        }
    }
    // The windowing detector is monotone in size and noise up to the scatter of 150 gearboxes.
    const auto& window = detection[feature_index(results, "window_ratio")];
    for (std::size_t level = 0; level < window.levels.size(); ++level) {
        const auto& cells = window.levels[level].cells;
        for (std::size_t size = 1; size < cells.size(); ++size) {
            CHECK(cells[size].upper >= cells[size - 1].lower);
            CHECK(cells.back().pd >= cells[size - 1].pd);
        }
        if (level > 0) {
            for (std::size_t size = 1; size < cells.size(); ++size) {
                CHECK(cells[size].lower <= window.levels[level - 1].cells[size].upper);
            }
        }
    }
    CHECK(window.levels[0].cells.back().pd == 1.0);
    CHECK(window.levels.back().cells[1].pd < 0.2);
}

}  // namespace gearpod::test_ensemble
