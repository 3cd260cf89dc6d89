// Checks sensor signals recorded mesh by mesh against those computed from stored meshes.
#include "machine/instruction_sets.hpp"
#include "signals/sensor/sensor_signal.hpp"
#include "signals/spectra/synchronous_average.hpp"
#include "signals/windowing/folded_signal.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/random_tile.hpp"

namespace gearpod::signals::test_sensor_response {

const std::vector<double> kExponents{0.1, 0.0, -0.1, 0.25, 0.9, -1.0, 0.13, 0.07};
constexpr int kPlanets = 4, kPhases = 6, kTePhases = 3;
constexpr SpanLayout kLayout{7, 9, 9};
constexpr int kBeyond = 5;  // meshes of the signal after the span
constexpr int kMeshes = 7 * 9 + kBeyond;

Timeline every_mesh() {
    Timeline timeline(kMeshes);
    std::iota(timeline.begin(), timeline.end(), 0);
    return timeline;
}

PathGrid path_to_sensor() {
    return {path_window("hamming"), kPlanets, kPhases, kLayout};
}

// Tones that differ between lanes.
Tones tones_of(int first, int lanes) {
    Tones tones;
    for (int lane = first; lane < first + lanes; ++lane) {
        tones.mesh_period_s.push_back(1.0 / (11.97 + 0.01 * lane));
        tones.frequency_Hz.push_back(118.2);
        tones.amplitude_m_s2.push_back(0.3 + 0.1 * lane);
        tones.phase_rad.push_back(0.7 * lane);
    }
    return tones;
}

SensorResponse recorded_response(const RandomTile& tile, const PathGrid& path,
                                 std::span<const double> exponents, const Tones& tones,
                                 int kept_meshes) {
    SensorResponse span(path, kLayout,
                        {tile.signals.lanes, exponents, &tones, kTePhases, kMeshes, kept_meshes});
    for (int k = 0; k < kMeshes; ++k) {
        const auto mesh = static_cast<std::size_t>(k);
        span.record_mesh(k, tile.accel[mesh].data(), tile.te[mesh].data());
    }
    return span;
}

TEST_CASE(
    "Meshes recorded one by one give the samples and averaged transmission error of stored ones") {
    const RandomTile tile(8, kPlanets, kPhases, kMeshes);
    const PathGrid path = path_to_sensor();
    for (const Tones& tones : {Tones{}, tones_of(0, 8)}) {
        INFO((tones.empty() ? "without tones" : "with tones"));
        const SensorResponse span = recorded_response(tile, path, kExponents, tones, kMeshes);
        const auto expected =
            synthesize(tile.signals, every_mesh(), kLayout, path, kExponents, 0, kMeshes, tones);
        CHECK(span.signals(8, kMeshes) == expected);
        CHECK(span.signal(LaneId{3}, kMeshes) == expected[3]);
        machine::AlignedVector te;
        Timeline in_span = every_mesh();
        in_span.resize(kMeshes - kBeyond);
        average_te(tile.signals, in_span, kLayout, kTePhases, te);
        CHECK(span.averaged_te() == te);

        machine::AlignedVector folded;
        fold_squares(tile.signals, FoldPlan(in_span, kLayout), path, kExponents, tones, folded);
        CHECK(test::largest_error(span.folded(), folded) < 1e-14);
    }
}

TEST_CASE("A gearbox's signals have the same bits alone, among others and on every processor") {
    const RandomTile tile(8, kPlanets, kPhases, kMeshes);
    const PathGrid path = path_to_sensor();
    const SensorResponse all = recorded_response(tile, path, kExponents, tones_of(0, 8), kMeshes);
    test::for_each_instruction_set([&] {
        for (const auto& [first, count] : {std::pair{0, 4}, {4, 4}, {5, 1}}) {
            const RandomTile part(tile, first, count);
            const SensorResponse some =
                recorded_response(part, path, std::span(kExponents).subspan(first, count),
                                  tones_of(first, count), kMeshes);
            CHECK(some.folded() == lanes_of(all.folded(), first, count));
            CHECK(some.averaged_te() == lanes_of(all.averaged_te(), first, count));
            CHECK(some.signal(LaneId{0}, kMeshes) == all.signal(LaneId{first}, kMeshes));
        }
    });
}

TEST_CASE("Samples that are not requested are not stored") {
    const RandomTile tile(8, kPlanets, kPhases, kMeshes);
    const PathGrid path = path_to_sensor();
    const SensorResponse none = recorded_response(tile, path, kExponents, {}, 0),
                         some = recorded_response(tile, path, kExponents, {}, 2);
    CHECK(none.folded() == some.folded());
    CHECK_THROWS_AS(none.signal(LaneId{0}, 1), std::invalid_argument);
    CHECK_THROWS_AS(some.signals(8, 3), std::invalid_argument);
    CHECK(some.signal(LaneId{1}, 2).size() == 2 * kPhases);
    CHECK_THROWS_AS(SensorResponse(path, kLayout, {8, kExponents, nullptr, 4, kMeshes, 0}),
                    std::invalid_argument);
    CHECK_THROWS_AS(SensorResponse(path, kLayout, {8, kExponents, nullptr, kTePhases, 62, 0}),
                    std::invalid_argument);
}

}  // namespace gearpod::signals::test_sensor_response
