// Checks that written times are recognized as even by the precision of their format, and that a
// missing sample is found in every format.
#include <fmt/format.h>

#include "mc/recordings/recording_columns.hpp"
#include "mc/recordings/sample_faults.hpp"
#include "tests/numbers.hpp"

namespace gearpod::mc::test_sample_times {

constexpr double kStep = 1.0 / 5120.0;

// How a format writes a time.
struct Format {
    const char* name;
    std::function<double(double)> written;
    double start = 0.0, unit;  // unit: of the rounding at the last time
};

double text(const char* format, double value) {
    return std::stod(fmt::format(fmt::runtime(format), value));
}

const std::vector<Format>& formats() {
    static const std::vector<Format> all{
        {"doubles", [](double t) { return t; }, 3.0, 1e-15},
        {"nine decimals", [](double t) { return text("{:.9f}", t); }, 0.0, 1e-9},
        {"four decimals", [](double t) { return text("{:.4f}", t); }, 20.0, 1e-4},
        {"six significant digits", [](double t) { return text("{:.6g}", t); }, 9.5, 1e-4},
        {"E13.5 of a universal file", [](double t) { return text("{:.5e}", t); }, 9.5, 1e-4},
        {"single precision", [](double t) { return double(static_cast<float>(t)); }, 64.0, 7.7e-6},
        {"single precision, nine digits",
         [](double t) { return text("{:.9g}", static_cast<float>(t)); }, 64.0, 7.7e-6},
        {"single precision, shortest",
         [](double t) { return std::stod(fmt::format("{}", static_cast<float>(t))); }, 64.0,
         7.7e-6},
        {"single precision, eight decimals",
         [](double t) { return text("{:.8f}", static_cast<float>(t)); }, 300.0, 3.1e-5},
        {"Unix time in doubles", [](double t) { return t; }, 1.7e9, 2.4e-7},
        {"Unix time with microseconds", [](double t) { return text("{:.6f}", t); }, 1.7e9, 1.3e-6},
        {"milliseconds", [](double t) { return text("{:.4f}", 1e3 * t); }, 0.0, 1e-7},
    };
    return all;
}

std::vector<double> written(const Format& format, std::size_t count, double step = kStep) {
    return test::tabulated(count, [&](std::size_t i) {
        return format.written(format.start + static_cast<double>(i) * step);
    });
}

double factor(const Format& format) {
    return std::string(format.name) == "milliseconds" ? 1e-3 : 1.0;
}

TEST_CASE("even times are recognized in every format, and the rate is exact") {
    for (const Format& format : formats()) {
        for (const std::size_t count : {50UL, 5120UL}) {
            INFO(format.name << " " << count);
            const mc::SampleTimes times = mc::sample_times(written(format, count), factor(format));
            CHECK(times.problem == "");
            REQUIRE(times.seconds.size() == count);
            const double n = static_cast<double>(count - 1);
            const double step = (times.seconds.back() - times.seconds.front()) / n;
            CHECK(std::abs(step - kStep) * n < 2.0 * format.unit);
            for (std::size_t i = 1; i < count; ++i) {
                CHECK(std::abs(times.seconds[i] - times.seconds[i - 1] - step) <= 2.5e-3 * kStep);
            }
        }
    }
}

TEST_CASE("one missing sample is found in every format, wherever it is") {
    for (const Format& format : formats()) {
        for (const std::size_t lost : {3UL, 1000UL, 2500UL, 5000UL, 5116UL}) {
            INFO(format.name << " " << lost);
            std::vector<double> times = written(format, 5120);
            times.erase(times.begin() + static_cast<std::ptrdiff_t>(lost));
            const std::string problem = mc::sample_times(times, factor(format)).problem;
            CHECK_THAT(problem, Catch::Contains("1 sample(s) are missing"));
            CHECK_THAT(problem, Catch::Contains(fmt::format("between sample {} and", lost)));
        }
    }
}

TEST_CASE("several missing samples, repeated samples and steps back are found in every format") {
    for (const Format& format : formats()) {
        INFO(format.name);
        std::vector<double> times = written(format, 3000);
        times.erase(times.begin() + 700, times.begin() + 705);
        CHECK_THAT(mc::sample_times(times, factor(format)).problem,
                   Catch::Contains("5 sample(s) are missing"));
        times = written(format, 3000);
        times.insert(times.begin() + 700, times[700]);
        CHECK_THAT(mc::sample_times(times, factor(format)).problem,
                   Catch::Contains("evenly spaced"));
        times = written(format, 3000);
        std::swap(times[700], times[703]);
        CHECK_THAT(mc::sample_times(times, factor(format)).problem,
                   Catch::Contains("evenly spaced"));
    }
}

TEST_CASE("times that are uneven by more than the rounding are refused") {
    std::vector<double> jittered, drifting;
    for (int i = 0; i < 4000; ++i) {
        jittered.push_back(i * kStep + 0.05 * kStep * std::sin(1.7 * i * i));
        drifting.push_back(i * kStep * (1.0 + 1e-6 * i));
    }
    CHECK_THAT(mc::sample_times(jittered).problem, Catch::Contains("evenly spaced"));
    CHECK_THAT(mc::sample_times(drifting).problem, Catch::Contains("evenly spaced"));
}

TEST_CASE("times that are too coarse to show a missing sample are refused as such") {
    const auto rounded = [](double t) { return text("{:.3f}", t); };
    for (const double step : {1.024e-3, 1.3e-3, 0.3e-3}) {
        INFO(step);
        const auto times = written({"", rounded, 0.0, 1e-3}, 2000, step);
        CHECK_THAT(mc::sample_times(times).problem, Catch::Contains("too coarse"));
    }
    CHECK_THAT(mc::sample_times(written({"", [](double t) { return double(static_cast<float>(t)); },
                                         1.7e9, 128.0},
                                        2000))
                   .problem,
               Catch::Contains("is 1700000000 at all samples"));
    // Steps of exactly one unit are even.
    CHECK(mc::sample_times(written({"", rounded, 0.0, 1e-3}, 2000, 1e-3)).problem == "");
}

// Checks that samples which are no vibration are found, with their numbers, and that noise is not.

std::vector<double> vibration(std::size_t samples, double rounding = 1e-4) {
    std::mt19937 engine(11);
    std::normal_distribution<double> normal;
    std::vector<double> signal;
    for (std::size_t i = 0; i < samples; ++i) {
        const double value = std::sin(0.31 * static_cast<double>(i)) + 0.3 * normal(engine);
        signal.push_back(rounding * std::round(value / rounding));
    }
    return signal;
}

TEST_CASE("Constant stretches, tails of zeros and copied blocks are found with their samples") {
    const std::vector<double> good = vibration(6000);
    CHECK(stretches_text(good).empty());
    CHECK(stretches_text(vibration(6000, 0.5)).empty());  // five levels
    CHECK(stretches_text(std::vector<double>(500, 0.0)).empty());
    auto held = good;
    std::fill(held.begin() + 1200, held.begin() + 1240, held[1199]);
    CHECK(test::contains(stretches_text(held), "samples 1200 to 1240 are all"));
    auto tail = good;
    std::fill(tail.end() - 900, tail.end(), 0.0);
    CHECK(test::contains(stretches_text(tail),
                         "samples 5101 to 6000 are all 0: the recording ends before"));
    auto copied = good;
    std::copy_n(copied.begin() + 2000, 256, copied.begin() + 2256);
    CHECK(test::contains(stretches_text(copied), "samples 2257 to 2512 repeat those from 2001 on"));
}

TEST_CASE("Spikes and steps of level are found, and the mean is removed to rounding") {
    const std::vector<double> good = vibration(8000);
    CHECK(spikes_text(good).empty());
    CHECK(level_step_text(good).empty());
    auto spiked = good;
    spiked[777] = -400.0;
    CHECK(test::contains(spikes_text(spiked),
                         "1 isolated spike(s) far outside the signal (sample 778)"));
    auto stepped = good;
    for (std::size_t i = 5000; i < stepped.size(); ++i) {
        stepped[i] += 2.0;
    }
    CHECK(test::contains(level_step_text(stepped), "its mean steps by"));
    auto moved = good, plain = good;
    for (double& value : moved) {
        value += 70.0;
    }
    CHECK(subtract_mean(moved) - subtract_mean(plain) == Approx(70.0));
    for (std::size_t i = 0; i < plain.size(); ++i) {
        REQUIRE(std::abs(moved[i] - plain[i]) < 1e-12);
    }
}

}  // namespace gearpod::mc::test_sample_times
