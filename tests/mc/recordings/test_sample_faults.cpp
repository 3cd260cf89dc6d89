// Checks that samples which are no vibration are found, with their numbers, and that noise is not.
#include "mc/recordings/sample_faults.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_sample_faults {

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

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_CASE("Constant stretches, tails of zeros and copied blocks are found with their samples") {
    const std::vector<double> good = vibration(6000);
    CHECK(stretches_text(good).empty());
    CHECK(stretches_text(vibration(6000, 0.5)).empty());  // five levels
    CHECK(stretches_text(std::vector<double>(500, 0.0)).empty());
    auto held = good;
    std::fill(held.begin() + 1200, held.begin() + 1240, held[1199]);
    CHECK(says(stretches_text(held), "samples 1200 to 1240 are all"));
    auto tail = good;
    std::fill(tail.end() - 900, tail.end(), 0.0);
    CHECK(says(stretches_text(tail), "samples 5101 to 6000 are all 0: the recording ends before"));
    auto copied = good;
    std::copy_n(copied.begin() + 2000, 256, copied.begin() + 2256);
    CHECK(says(stretches_text(copied), "samples 2257 to 2512 repeat those from 2001 on"));
}

TEST_CASE("Spikes and steps of level are found, and the mean is removed to rounding") {
    const std::vector<double> good = vibration(8000);
    CHECK(spikes_text(good).empty());
    CHECK(level_step_text(good).empty());
    auto spiked = good;
    spiked[777] = -400.0;
    CHECK(says(spikes_text(spiked), "1 isolated spike(s) far outside the signal (sample 778)"));
    auto stepped = good;
    for (std::size_t i = 5000; i < stepped.size(); ++i) {
        stepped[i] += 2.0;
    }
    CHECK(says(level_step_text(stepped), "its mean steps by"));
    auto moved = good, plain = good;
    for (double& value : moved) {
        value += 70.0;
    }
    CHECK(subtract_mean(moved) - subtract_mean(plain) == Approx(70.0));
    for (std::size_t i = 0; i < plain.size(); ++i) {
        REQUIRE(std::abs(moved[i] - plain[i]) < 1e-12);
    }
}

}  // namespace gearpod::mc::test_sample_faults
