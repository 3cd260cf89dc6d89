#include "machine/instruction_sets.hpp"
#include "signals/sensor/sensor_signal.hpp"
#include "signals/windowing/folded_signal.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/direct_signal.hpp"
#include "tests/signals/random_tile.hpp"

namespace gearpod::signals::test_tones {

const std::vector<double> kExponents{0.1, 0.0, -0.1, 0.25, 0.9, -1.0, 0.13, 0.07};

// Two of Liang's tones (2016, Table 5.1) and one of low frequency, on gearboxes of different
// speeds.
Tones rig_tones() {
    Tones tones;
    for (int lane = 0; lane < 8; ++lane) {
        tones.mesh_period_s.push_back(1.0 / (11.97 + 0.01 * lane));
    }
    for (const double frequency : {118.2, 360.0, 1.9}) {
        for (int lane = 0; lane < 8; ++lane) {
            tones.frequency_Hz.push_back(frequency);
            tones.amplitude_m_s2.push_back(0.3 + 0.1 * lane);
            tones.phase_rad.push_back(0.7 * lane + frequency);
        }
    }
    return tones;
}

double tone_at(const Tones& tones, int lane, long k, int p, int phases) {
    const long double time = (k + static_cast<long double>(p) / phases) * tones.mesh_period_s[lane];
    long double sum = 0.0L;
    for (std::size_t i = static_cast<std::size_t>(lane); i < tones.frequency_Hz.size(); i += 8) {
        sum += tones.amplitude_m_s2[i] *
               std::sin(2.0L * std::numbers::pi_v<long double> * tones.frequency_Hz[i] * time +
                        tones.phase_rad[i]);
    }
    return static_cast<double>(sum);
}

std::vector<double> direct_signal_with_tones(const RandomTile& tile, int lane,
                                             const Timeline& timeline, const SpanLayout& layout,
                                             const Tones& tones) {
    const int phases = tile.signals.phases;
    auto signal = direct_signal(tile.signals, lane, timeline, layout, path_window("hamming"),
                                kExponents[lane]);
    for (std::size_t i = 0; i < signal.size(); ++i) {
        signal[i] += tone_at(tones, lane, static_cast<long>(i) / phases,
                             static_cast<int>(i) % phases, phases);
    }
    return signal;
}

TEST_CASE("Folded squares with tones equal the sums over all samples of the span") {
    const RandomTile tile(8, 4, 6, 5);
    const Tones tones = rig_tones();
    const struct {
        Timeline timeline;
        SpanLayout layout;
    } cases[] = {{event_timeline(31, 12, 4), {31, 81, 81}},
                 {event_timeline(19, 17, 4), {31, 81, 81}},
                 {{0}, {31, 81, 81}},
                 {event_timeline(31, 0, 4), {31, 81, 19}},
                 {event_timeline(31, 30, 4), {31, 81, 1}}};
    for (const auto& [timeline, layout] : cases) {
        const PathGrid path(path_window("hamming"), 4, 6, layout);
        machine::AlignedVector folded;
        fold_squares(tile.signals, FoldPlan(timeline, layout), path, kExponents, tones, folded);
        const std::size_t bins = 31 * 6;
        REQUIRE(folded.size() == bins * 8);
        for (int lane = 0; lane < 8; ++lane) {
            const auto signal = direct_signal_with_tones(tile, lane, timeline, layout, tones);
            const std::vector<double> expected = test::folded_squares(signal, bins);
            // A tone of 360 Hz over 2511 meshes is 75,000 periods: the product f T_m alone is
            // rounded to 1e-11.
            CHECK(test::largest_error(lanes_of(folded, lane, 1), expected) < 1e-10);
        }
    }
}

TEST_CASE("A tone alone folds to the closed form of its sum of squared sines") {
    // Closed form: sum over i < n of sin^2(a + i b) = n/2 - sin(n b) cos(2 a + (n - 1) b) / (2 sin
    // b).
    RandomTile tile(1, 4, 6, 1);
    std::fill(tile.accel[0].begin(), tile.accel[0].end(), 0.0);
    const SpanLayout layout{31, 81, 81};
    const double frequency = 118.2, period = 1.0 / 11.97, amplitude = 2.5, phase = 0.4;
    machine::AlignedVector folded;
    fold_squares(tile.signals, FoldPlan({0}, layout),
                 PathGrid(path_window("hamming"), 4, 6, layout), std::vector{0.1},
                 {{period}, {frequency}, {amplitude}, {phase}}, folded);
    const double turn = 2.0 * std::numbers::pi * frequency * period;
    const double b = 31 * turn;
    for (int bin = 0; bin < 31 * 6; ++bin) {
        const double a = turn * bin / 6.0 + phase;
        const double squares =
            81 / 2.0 - std::sin(81 * b) * std::cos(2 * a + 80 * b) / (2 * std::sin(b));
        CHECK(folded[bin] == Approx(amplitude * amplitude * squares).epsilon(1e-10));
    }
}

TEST_CASE("Without tones the folded squares keep their bits") {
    const RandomTile tile(8, 4, 6, 5);
    const SpanLayout layout{31, 81, 81};
    const FoldPlan plan(event_timeline(31, 2, 4), layout);
    const PathGrid path(path_window("hamming"), 4, 6, layout);
    machine::AlignedVector plain, none;
    fold_squares(tile.signals, plan, path, kExponents, plain);
    fold_squares(tile.signals, plan, path, kExponents, Tones{}, none);
    CHECK(plain == none);
}

TEST_CASE(
    "A gearbox with tones folds to the same bits alone, among four or eight and on every "
    "instruction set") {
    const RandomTile tile(8, 4, 12, 5);
    const SpanLayout layout{31, 81, 81};
    const FoldPlan plan(event_timeline(31, 2, 4), layout);
    const PathGrid path(path_window("hamming"), 4, 12, layout);
    const Tones tones = rig_tones();
    machine::AlignedVector reference;
    fold_squares(tile.signals, plan, path, kExponents, tones, reference);
    test::for_each_instruction_set([&] {
        machine::AlignedVector folded;
        fold_squares(tile.signals, plan, path, kExponents, tones, folded);
        CHECK(folded == reference);
        for (const auto& [first, count] : {std::pair{0, 4}, {4, 4}, {5, 1}}) {
            const RandomTile part(tile, first, count);
            const Tones own{lanes_of(tones.mesh_period_s, first, count),
                            lanes_of(tones.frequency_Hz, first, count),
                            lanes_of(tones.amplitude_m_s2, first, count),
                            lanes_of(tones.phase_rad, first, count)};
            fold_squares(part.signals, plan, path, std::span(kExponents).subspan(first, count), own,
                         folded);
            CHECK(folded == lanes_of(reference, first, count));
        }
    });
}

TEST_CASE(
    "The synthesized time signal contains the tones, whole and in parts, and folds to the same "
    "bits") {
    const RandomTile tile(8, 4, 6, 5);
    const SpanLayout layout{31, 81, 81};
    const Timeline timeline = event_timeline(31, 4, 4);
    const PathGrid path(path_window("hamming"), 4, 6, layout);
    const Tones tones = rig_tones();
    const int lane = 3;
    const auto signal = synthesize(tile.signals, LaneId{lane}, timeline, layout, path,
                                   kExponents[lane], 0, layout.meshes(), tones);
    const auto expected = direct_signal_with_tones(tile, lane, timeline, layout, tones);
    CHECK(test::largest_difference(signal, expected) < 1e-10);
    const auto part = synthesize(tile.signals, LaneId{lane}, timeline, layout, path,
                                 kExponents[lane], 1000, 70, tones);
    CHECK(std::equal(part.begin(), part.end(), signal.begin() + 6000));

    machine::AlignedVector folded;
    fold_squares(tile.signals, FoldPlan(timeline, layout), path, kExponents, tones, folded);
    machine::AlignedVector bins(31 * 6, 0.0);
    for (std::size_t i = 0; i < signal.size(); ++i) {
        bins[i % bins.size()] = std::fma(signal[i], signal[i], bins[i % bins.size()]);
    }
    CHECK(lanes_of(folded, lane, 1) == bins);
}

TEST_CASE("Tones of another shape than the tile are refused") {
    const RandomTile tile(8, 4, 6, 2);
    const SpanLayout layout{31, 81, 81};
    const FoldPlan plan({0}, layout);
    const PathGrid path(path_window("hamming"), 4, 6, layout);
    machine::AlignedVector folded;
    Tones tones = rig_tones();
    tones.phase_rad.pop_back();
    CHECK_THROWS_AS(fold_squares(tile.signals, plan, path, kExponents, tones, folded),
                    std::invalid_argument);
    tones = rig_tones();
    tones.mesh_period_s.pop_back();
    CHECK_THROWS_AS(fold_squares(tile.signals, plan, path, kExponents, tones, folded),
                    std::invalid_argument);
}

}  // namespace gearpod::signals::test_tones
