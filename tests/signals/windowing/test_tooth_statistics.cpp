#include "signals/spectra/synchronous_average.hpp"
#include "signals/windowing/tooth_statistics.hpp"
#include "signals/windowing/windowing.hpp"
#include "tests/numbers.hpp"

namespace gearpod::signals::test_tooth_signals {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

using test::normal_values;

TEST_CASE("The turns of a gear fill whole turns of the carrier") {
    // Liang's 19/31/81 with the ring fixed: 81 meshes per carrier turn.
    const GearTurns sun = turns_of_span(19, 81, 31 * 81);
    CHECK(sun.turns == 81);
    CHECK(turns_of_span(81, 81, 31 * 81).turns == 31);
    CHECK(turns_of_span(31, 81, 31 * 81).turns == 81);
    CHECK(turns_of_span(40, 81, 31 * 81).turns == 0);  // 3240 meshes do not fit
    CHECK(fewest_turns(40, 81).meshes() == 40 * 81);
    CHECK(fewest_turns(36, 81).turns == 9);
    CHECK(turns_of_span(19, 1, 100).turns == 5);  // fixed carrier
}

TEST_CASE("A tooth's RMS matches the folded squares") {
    const int phases = 12;
    const GearTurns gear{7, 5};
    const auto samples = normal_values(gear.meshes() * phases + 40, 1);  // and some more
    const auto span = std::span(samples).first(gear.meshes() * phases);
    Windowing windowing(gear.layout(), phases, 0.3);
    std::vector<double> rms(7);
    windowing.load(fold_of_squares(span, 7 * phases));
    const int offset = windowing.search(0.0, rms);
    const auto teeth = tooth_statistics(samples, gear, tukey_window(phases, 0.3), offset);
    for (std::size_t j = 0; j < 7; ++j) {
        CHECK(teeth.rms[j] == Approx(rms[j]).epsilon(1e-13));
    }
}

TEST_CASE("A shock once per turn of a gear affects one tooth of that gear only") {
    // Teeth 13/11/35. The sun's tooth 4 has a shock once in 13 meshes, over 13 x 35 meshes.
    const int phases = 16;
    auto samples = normal_values(13 * 35 * phases, 2);
    for (int k = 4; k < 13 * 35; k += 13) {
        samples[k * phases + 5] += 12.0;
    }
    const auto window = tukey_window(phases, 0.1);
    const auto sun = tooth_statistics(samples, {13, 35}, window, 0);
    const auto planet = tooth_statistics(samples, {11, 35}, window, 0);
    for (std::size_t j = 0; j < 13; ++j) {
        CHECK((sun.rms[j] > 2.0) == (j == 4));
        CHECK((sun.kurtosis[j] > 6.0) == (j == 4));
    }
    const auto worst = [](const std::vector<double>& teeth) {
        return std::max_element(teeth.begin(), teeth.end()) - teeth.begin();
    };
    CHECK(worst(sun.m8a) == 4);
    // The shocks are distributed over the planet's teeth: two in 35 windows, or three.
    for (const double rms : planet.rms) {
        CHECK(rms > 1.1);
        CHECK(rms < 1.45);
    }
}

TEST_CASE("Statistics of a tooth's signal match its samples") {
    // Sine sampled at eight phases with a rectangular window: crest sqrt 2, kurtosis 1.5, M8A 35/8
    // (eighth moment 35/128 over (1/2)^4).
    const std::vector<double> samples = test::sine(1.0, 3 * 4, 3 * 4 * 8);
    for (const int offset : {0, 3}) {
        const auto teeth = tooth_statistics(samples, {4, 3}, std::vector<double>(8, 1.0), offset);
        CHECK(teeth.rms.size() == 4);
        CHECK(teeth.rms[2] == Approx(std::sqrt(0.5)));
        CHECK(teeth.crest[2] == Approx(std::sqrt(2.0)));
        CHECK(teeth.kurtosis[2] == Approx(1.5));
        // Eight samples of sin^8: 4 x (1/16) + 2 x 1 of 8, over (1/2)^4.
        CHECK(teeth.m8a[2] == Approx((4.0 / 16.0 + 2.0) / 8.0 * 16.0));
    }
    CHECK_THROWS_AS(tooth_statistics(samples, {4, 4}, std::vector<double>(8, 1.0), 0),
                    std::invalid_argument);
    CHECK_THROWS_AS(tooth_statistics(samples, {4, 3}, std::vector<double>(8, 1.0), 8),
                    std::invalid_argument);
}

TEST_CASE("Smooth variation along the path is removed, a single tooth remains") {
    std::vector<double> values(81);
    for (std::size_t j = 0; j < values.size(); ++j) {
        const double x = kTwoPi * static_cast<double>(j) / 81.0;
        values[j] = 3.0 + std::cos(x + 0.2) + 0.5 * std::sin(4 * x);
    }
    auto smooth = values;
    remove_path_trend(smooth, 4);
    for (const double ratio : smooth) {
        CHECK(ratio == Approx(1.0).epsilon(1e-13));
    }
    values[17] *= 1.3;
    remove_path_trend(values, 4);
    for (std::size_t j = 0; j < values.size(); ++j) {
        CHECK((values[j] > 1.15) == (j == 17));
    }
}

TEST_CASE("The average over turns keeps the repeating part, the rest is the residual") {
    const int bins = 30, turns = 400;
    auto samples = normal_values(bins * turns + 11, 5);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] += 4.0 * std::sin(kTwoPi * static_cast<double>(i) / bins);
    }
    const auto mean = synchronous_average(samples, bins);
    for (int b = 0; b < bins; ++b) {
        CHECK(mean[static_cast<std::size_t>(b)] ==
              Approx(4.0 * std::sin(kTwoPi * static_cast<double>(b) / bins)).margin(0.2));
    }
    CHECK(rms_without_average(samples, bins) == Approx(1.0).epsilon(0.02));
    CHECK(fold_of_squares(std::vector<double>{1, 2, 3, 4, 5}, 2) == std::vector<double>{10, 20});
    CHECK(synchronous_average(std::vector<double>{1, 2, 3, 4, 5}, 2) == std::vector<double>{2, 3});
    CHECK_THROWS_AS(synchronous_average(samples, 0), std::invalid_argument);
    CHECK_THROWS_AS(fold_of_squares(std::vector<double>{1}, 2), std::invalid_argument);
}

}  // namespace gearpod::signals::test_tooth_signals
