#include "machine/instruction_sets.hpp"
#include "signals/sensor/sensor_signal.hpp"
#include "signals/windowing/folded_signal.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/direct_signal.hpp"
#include "tests/signals/random_tile.hpp"

namespace gearpod::signals::test_folded_signal {

const std::vector<double> kExponents{0.1, 0.0, -0.1, 0.25, 0.9, -1.0, 0.13, 0.07};

// Largest relative difference between the folded squares of the tile and the sample-by-sample sum.
double fold_error(const RandomTile& tile, const Timeline& timeline, const SpanLayout& layout,
                  const char* window) {
    const int phases = tile.signals.phases;
    const PathGrid path(path_window(window), tile.signals.planets, phases, layout);
    machine::AlignedVector folded;
    fold_squares(tile.signals, FoldPlan(timeline, layout), path, kExponents, folded);
    const std::size_t bins = static_cast<std::size_t>(layout.planet_teeth) * phases;
    std::vector<double> errors;
    for (int lane = 0; lane < 8; ++lane) {
        const std::vector<double> expected =
            test::folded_squares(direct_signal(tile.signals, lane, timeline, layout,
                                               path_window(window), kExponents[lane]),
                                 bins);
        errors.push_back(test::largest_error(lanes_of(folded, lane, 1), expected));
    }
    return test::largest_magnitude(errors);
}

TEST_CASE("Folded squares equal the sums over all samples of the span, for any cracked member") {
    const RandomTile tile(8, 4, 6, 5);
    const SpanLayout ring_fixed{31, 81, 81};
    CHECK(fold_error(tile, event_timeline(31, 12, 4), ring_fixed, "hamming") < 1e-12);
    CHECK(fold_error(tile, event_timeline(19, 17, 4), ring_fixed, "hann") < 1e-12);
    CHECK(fold_error(tile, event_timeline(81, 40, 4), ring_fixed, "rectangular") < 1e-12);
    CHECK(fold_error(tile, {0}, ring_fixed, "hamming") < 1e-12);
}

TEST_CASE("Folded squares are right for any fixed member and number of planets") {
    const RandomTile three(8, 3, 4, 3, 7);
    const RandomTile five(8, 5, 4, 3, 8);
    CHECK(fold_error(three, event_timeline(31, 0, 2), {31, 81, 19}, "hamming") < 1e-12);
    CHECK(fold_error(five, event_timeline(31, 30, 2), {31, 81, 1}, "hamming") < 1e-12);
    // Common factor of Z_p and M_c: the planet's teeth meet different carrier angles.
    CHECK(fold_error(three, event_timeline(30, 3, 2), {30, 84, 84}, "hamming") < 1e-12);
}

TEST_CASE("Folded squares of a span without any repetition equal the sums over its samples") {
    const SpanLayout layout{7, 9, 9};
    const RandomTile tile(8, 4, 5, layout.meshes());
    Timeline timeline(layout.meshes());
    for (int k = 0; k < layout.meshes(); ++k) {
        timeline[k] = k;
    }
    CHECK(fold_error(tile, timeline, layout, "hamming") < 1e-12);
}

TEST_CASE(
    "A gearbox folds to the same bits alone, among four or eight and on every instruction set") {
    const RandomTile tile(8, 4, 12, 5);
    const SpanLayout layout{31, 81, 81};
    const Timeline timeline = event_timeline(31, 2, 4);
    const FoldPlan plan(timeline, layout);
    const PathGrid path(path_window("hamming"), 4, 12, layout);
    machine::AlignedVector reference;
    fold_squares(tile.signals, plan, path, kExponents, reference);

    test::for_each_instruction_set([&] {
        machine::AlignedVector folded;
        fold_squares(tile.signals, plan, path, kExponents, folded);
        CHECK(folded == reference);
        for (const auto& [first, count] : {std::pair{0, 4}, {4, 4}, {0, 1}, {5, 1}}) {
            const RandomTile part(tile, first, count);
            fold_squares(part.signals, plan, path, std::span(kExponents).subspan(first, count),
                         folded);
            CHECK(folded == lanes_of(reference, first, count));
        }
    });
}

// Tile whose other lanes converge more slowly: places of the timeline that are equal for this lane
// have separate records, numbered in another order.
TEST_CASE("A gearbox folds to the same bits regardless of duplicate records of its mesh periods") {
    const RandomTile tile(8, 4, 6, 5);
    RandomTile twice(8, 4, 6, 12);
    const std::vector<int> original{0, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0, 0};
    for (std::size_t record = 0; record < original.size(); ++record) {
        std::ranges::copy(tile.accel[static_cast<std::size_t>(original[record])],
                          twice.accel[record].begin());
    }
    for (const SpanLayout layout : {SpanLayout{31, 81, 81}, {30, 84, 84}, {31, 81, 19}}) {
        const PathGrid path(path_window("hamming"), 4, 6, layout);
        for (const int length : {31, 30, 19, 81, 84}) {
            INFO(layout.planet_teeth << " planet teeth, a pattern of " << length);
            const Timeline timeline = event_timeline(length, 3, 4);
            Timeline other = event_timeline(length, 3, 11);
            for (int e = 0; e < 4; ++e) {
                other[static_cast<std::size_t>(3 + e)] = 4 - e;
            }
            machine::AlignedVector folded, refolded;
            fold_squares(tile.signals, FoldPlan(timeline, layout), path, kExponents, folded);
            fold_squares(twice.signals, FoldPlan(other, layout), path, kExponents, refolded);
            CHECK(folded == refolded);
        }
    }
}

TEST_CASE(
    "The synthesized time signal satisfies the path equation and folds to the folded squares") {
    const RandomTile tile(8, 4, 6, 5);
    const SpanLayout layout{31, 81, 81};
    const Timeline timeline = event_timeline(19, 4, 4);
    const PathGrid path(path_window("hamming"), 4, 6, layout);
    const int lane = 3;
    const std::vector<double> signal = synthesize(tile.signals, LaneId{lane}, timeline, layout,
                                                  path, kExponents[lane], 0, layout.meshes());
    const std::vector<double> expected = direct_signal(tile.signals, lane, timeline, layout,
                                                       path_window("hamming"), kExponents[lane]);
    CHECK(test::largest_difference(signal, expected) < 1e-12);

    const std::vector<double> part =
        synthesize(tile.signals, LaneId{lane}, timeline, layout, path, kExponents[lane], 100, 7);
    CHECK(std::equal(part.begin(), part.end(), signal.begin() + 600));

    machine::AlignedVector folded;
    fold_squares(tile.signals, FoldPlan(timeline, layout), path, kExponents, folded);
    std::vector<double> bins(folded.size() / 8);
    copy_lane(folded, 8, LaneId{lane}, bins);
    CHECK(std::accumulate(bins.begin(), bins.end(), 0.0) ==
          Approx(test::sum_of_squares(signal)).epsilon(1e-12));
}

TEST_CASE(
    "A planet crack costs one sum per distinct mesh; a ring crack affects no single planet tooth") {
    const SpanLayout layout{31, 81, 81};
    CHECK(FoldPlan(event_timeline(31, 3, 4), layout).sums().first.size() == 5 + 1);
    const FoldPlan ring(event_timeline(81, 3, 4), layout);
    CHECK(ring.sums().first.size() == 1 + 1);
    CHECK(ring.pairs().carrier.size() == 81);
}

TEST_CASE("Tile, plan and path of different shapes are refused") {
    const RandomTile tile(8, 4, 6, 2);
    const SpanLayout layout{31, 81, 81};
    const PathGrid path(path_window("hamming"), 4, 6, layout);
    const PathGrid other(path_window("hamming"), 3, 6, layout);
    machine::AlignedVector folded;
    const FoldPlan plan(event_timeline(31, 0, 1), layout);
    CHECK_THROWS_AS(fold_squares(tile.signals, plan, other, kExponents, folded),
                    std::invalid_argument);
    CHECK_THROWS_AS(fold_squares(tile.signals, plan, path, std::vector{0.1}, folded),
                    std::invalid_argument);
    const FoldPlan beyond(event_timeline(31, 0, 2), layout);
    CHECK_THROWS_AS(fold_squares(tile.signals, beyond, path, kExponents, folded),
                    std::invalid_argument);
    CHECK_THROWS_AS(FoldPlan({}, layout), std::invalid_argument);
}

}  // namespace gearpod::signals::test_folded_signal
