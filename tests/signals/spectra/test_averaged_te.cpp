#include "signals/noise/sensor_noise.hpp"
#include "signals/spectra/synchronous_average.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/random_tile.hpp"

namespace gearpod::signals::test_averaged_te {

// Average over turns of the whole signal, sample by sample, with its mean removed.
std::vector<double> direct_average(const RandomTile& tile, int lane, const Timeline& timeline,
                                   const SpanLayout& layout, int te_phases) {
    const int stride = tile.signals.phases / te_phases;
    std::vector<double> turn(static_cast<std::size_t>(layout.planet_teeth) * te_phases, 0.0);
    for (int k = 0; k < layout.meshes(); ++k) {
        for (int p = 0; p < te_phases; ++p) {
            turn[(k % layout.planet_teeth) * te_phases + p] +=
                tile.te[timeline[k % timeline.size()]][p * stride * tile.signals.lanes + lane] /
                layout.ring_teeth;
        }
    }
    return test::difference(turn, std::vector<double>(turn.size(), test::mean_of(turn)));
}

TEST_CASE("The averaged transmission error is the mean over all turns of the span") {
    const RandomTile tile(8, 4, 12, 5);
    const SpanLayout layout{31, 81, 81};
    for (const int length : {1, 31, 19, 81}) {
        const Timeline timeline = event_timeline(length, 3, length == 1 ? 0 : 4);
        machine::AlignedVector turn;
        average_te(tile.signals, timeline, layout, 4, turn);
        for (const int lane : {0, 7}) {
            const auto expected = direct_average(tile, lane, timeline, layout, 4);
            CHECK(test::largest_difference(lanes_of(turn, lane, 1), expected) <
                  1e-19);  // relative to 1e-5 rad
        }
    }
}

TEST_CASE(
    "A gearbox's averaged transmission error does not depend on which mesh periods share a "
    "record") {
    const RandomTile tile(8, 4, 12, 5);
    RandomTile twice(8, 4, 12, 12);
    for (std::size_t record = 0; record < twice.te.size(); ++record) {
        std::ranges::copy(tile.te[record < 5 ? record : 0], twice.te[record].begin());
    }
    for (const int length : {31, 19, 81}) {
        machine::AlignedVector turn, other;
        average_te(tile.signals, event_timeline(length, 3, 4), {31, 81, 81}, 4, turn);
        average_te(twice.signals, event_timeline(length, 3, 11), {31, 81, 81}, 4, other);
        CHECK(turn == other);
    }
}

TEST_CASE("Encoders must divide the samples of a mesh") {
    const RandomTile tile(8, 4, 12, 1);
    machine::AlignedVector turn;
    CHECK_THROWS_AS(average_te(tile.signals, {0}, {31, 81, 81}, 5, turn), std::invalid_argument);
}

TEST_CASE("Encoder noise decreases with the root of the number of averaged turns") {
    std::mt19937_64 engine(11);
    std::vector<double> noise(200000);
    draw_encoder_noise(engine, 81, noise);
    double sum = 0.0;
    double square = 0.0;
    for (const double value : noise) {
        sum += value;
        square += value * value;
    }
    CHECK(std::abs(sum) < 1e-9);
    // The relative standard error of a variance is sqrt(2/n), 0.3 %.
    CHECK(square / 200000.0 == Approx(1.0 / 81.0).epsilon(0.015));
}

}  // namespace gearpod::signals::test_averaged_te
