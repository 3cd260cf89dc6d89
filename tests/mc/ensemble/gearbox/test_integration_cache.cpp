// Checks that studies that vary only path, noise and a few sizes integrate their gearboxes once.
#include "mc/ensemble/batch_workers.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_integration_cache {

// Liang's train at high speed, with only the random inputs in `kept`.
Study study_with(const std::vector<std::string>& kept, const std::vector<std::string>& more = {}) {
    Study study = test::shipped_study(
        "planet-crack-ideal.toml",
        test::joined({"operation.carrier_speed_rpm=60", "sensor.sampling_Hz=20000",
                      "sensor.encoder_sampling_Hz=20000", "numerics.threads=1"},
                     more));
    std::erase_if(study.random, [&](const RandomInput& input) {
        return std::find(kept.begin(), kept.end(), input.key) == kept.end();
    });
    return study;
}

const std::vector<std::string> kSensorOnly{"sensor.path_exponent", "sensor.noise_m_s2",
                                           "sensor.encoder_noise_arcsec", "fault.depth_mm"};

std::vector<std::uint64_t> bits(const BatchRows& rows) {
    std::vector<std::uint64_t> all(rows.status.begin(), rows.status.end());
    for (const double value : rows.values) {
        all.push_back(std::bit_cast<std::uint64_t>(value));
    }
    return all;
}

std::vector<Batch> test_tiles(std::size_t count) {
    return test::tabulated(count, [&](std::size_t t) { return Batch{Group::test, 8 * t, 0, 8}; });
}

TEST_CASE("Cached responses are not integrated again, and give the same bits") {
    const Scene scene(study_with(kSensorOnly));
    CHECK(scene.solve().settings.distinct_integrations == 7);  // the sizes, including 0
    const BatchTask shared(scene.tile(), scene.ensemble());
    BatchWorker worker(shared);
    Seconds seconds;
    for (const Batch& tile : test_tiles(16)) {
        const BatchRows again = worker.compute(tile, seconds);
        REQUIRE(again.count() == 8);
        const BatchTask fresh(scene.tile(), scene.ensemble());
        CHECK(bits(again) == bits(BatchWorker(fresh).compute(tile, seconds)));
        CHECK(fresh.cache.kept() == 1);
    }
    // Eight consecutive gearboxes begin at any of seven sizes.
    CHECK(shared.cache.kept() == 7);
    worker.compute({Group::threshold, 0, 0, 8}, seconds);
    worker.compute({Group::threshold, 8, 0, 8}, seconds);
    CHECK(shared.cache.kept() == 8);
}

TEST_CASE("Nothing is cached where every gearbox has a different response") {
    const Scene scene(study_with({"sensor.path_exponent", "gearbox.planet.bearing_stiffness_N_m"}));
    CHECK_FALSE(scene.solve().settings.distinct_integrations.has_value());
    const BatchTask task(scene.tile(), scene.ensemble());
    Seconds seconds;
    BatchWorker(task).compute({Group::test, 0, 0, 8}, seconds);
    CHECK(task.cache.kept() == 0);
    const Scene errors(
        study_with(kSensorOnly, {"gearbox.pitch_error_um=1", "numerics.horizon=full"}));
    CHECK_FALSE(errors.solve().settings.distinct_integrations.has_value());
}

}  // namespace gearpod::mc::test_integration_cache
