// Checks the kurtogram of tones, impulses, modulated signals and noise against closed forms.
#include "signals/demodulation/kurtogram.hpp"
#include "tests/numbers.hpp"

namespace gearpod::test_kurtogram {

using signals::Kurtogram;
using signals::KurtogramBand;

std::vector<double> noise(std::size_t points, double rms) {
    return test::normal_values(points, 33, 0.0, rms);
}

// Impulses every `period` samples, filtered ideally to the orders of a band that are multiples of
// the impulses' order: each has the amplitude 1.
std::vector<double> impulse_train(std::size_t points, std::size_t period,
                                  const KurtogramBand& band) {
    std::vector<double> one(period, 0.0), train;
    const std::size_t impulses = points / period;
    for (std::size_t k = band.first; k < band.first + band.orders; ++k) {
        for (std::size_t i = 0; k % impulses == 0 && i < period; ++i) {
            one[i] += std::cos(2.0 * std::numbers::pi * static_cast<double>(k / impulses * i) /
                               static_cast<double>(period));
        }
    }
    for (std::size_t i = 0; i < points; ++i) {
        train.push_back(one[i % period]);
    }
    return train;
}

// Kurtosis of an impulse whose band has this many lines of equal amplitude.
double impulse_kurtosis(double lines) {
    return (2.0 * lines + 1.0 / lines) / 3.0 - 2.0;
}

TEST_CASE("The levels have 1, 2, 3, 4, 6, 8, 12 and 16 bands side by side") {
    for (const std::size_t points : {4000U, 4001U, 4002U}) {
        const std::vector<double> x = noise(points, 1.0);
        const Kurtogram kurtogram(x, 17);
        const auto bands = kurtogram.bands();
        REQUIRE(bands.size() == 1 + 2 + 3 + 4 + 6 + 8 + 12 + 16);
        std::size_t at = 0;
        for (const std::size_t n : {1U, 2U, 3U, 4U, 6U, 8U, 12U, 16U}) {
            std::size_t next = 1;
            for (std::size_t i = 0; i < n; ++i, ++at) {
                CHECK(bands[at].first == next);
                CHECK(static_cast<double>(bands[at].orders) ==
                      Approx(static_cast<double>(points) / (2.0 * static_cast<double>(n)))
                          .margin(1.5));
                next += bands[at].orders;
            }
            CHECK(next == (points + 1) / 2);  // the orders below the Nyquist order
        }
    }
}

TEST_CASE("White noise has a kurtosis of 0 in every band, within its scatter") {
    const std::vector<double> x = noise(240'000, 3.0);
    const Kurtogram kurtogram(x, 16);
    for (const KurtogramBand& band : kurtogram.bands()) {
        INFO(band.first << " " << band.orders);
        CHECK(std::abs(band.kurtosis) < 4.5 * 2.0 / std::sqrt(static_cast<double>(band.orders)));
    }
}

TEST_CASE("An impulse has the kurtosis of its lines in every band, and most in the widest one") {
    std::vector<double> x(3000, 0.0);
    x[700] = -5.0;
    const Kurtogram kurtogram(x, 12);
    for (const KurtogramBand& band : kurtogram.bands()) {
        CHECK(band.kurtosis == Approx(impulse_kurtosis(static_cast<double>(band.orders))));
    }
    CHECK(kurtogram.peak() == kurtogram.bands().data());
}

TEST_CASE("A tone has a kurtosis of -1 in its band; bands of rounding errors are left out") {
    const auto x = test::tabulated(1200, [](int i) {
        return 1e-3 * std::cos(2.0 * std::numbers::pi * 110.0 * i / 1200.0 + 0.3);
    });
    const Kurtogram kurtogram(x, 8);
    REQUIRE(kurtogram.bands().size() == 6);  // one per level
    for (const KurtogramBand& band : kurtogram.bands()) {
        CHECK(band.kurtosis == Approx(-1.0));
        CHECK(band.first <= 110);
        CHECK(band.first + band.orders > 110);
    }
    const std::vector<double> zero(1200, 0.0);
    CHECK(Kurtogram(zero, 8).peak() == nullptr);
}

TEST_CASE("An impulse train in white noise is found in the band that it excites") {
    constexpr std::size_t kPoints = 96'000, kImpulses = 40;
    const std::vector<double> background = noise(kPoints, 1.0);
    const Kurtogram tree(background, 12);
    // Bands of the levels with 3, 4, 8 and 12 bands.
    for (const std::size_t at : {3U + 1U, 6U + 2U, 16U + 5U, 24U + 7U}) {
        const KurtogramBand band = tree.bands()[at];
        const std::vector<double> train = impulse_train(kPoints, kPoints / kImpulses, band);
        double lines = 0.0;
        for (std::size_t k = band.first; k < band.first + band.orders; ++k) {
            lines += k % kImpulses == 0 ? 1.0 : 0.0;
        }
        // The train and the noise have equal power in the band.
        const double scale = std::sqrt(4.0 * static_cast<double>(band.orders) /
                                       static_cast<double>(kPoints) / lines);
        std::vector<double> x = background;
        for (std::size_t i = 0; i < kPoints; ++i) {
            x[i] += scale * train[i];
        }
        const Kurtogram kurtogram(x, 12);
        REQUIRE(kurtogram.peak() != nullptr);
        CHECK(kurtogram.peak()->first == band.first);
        CHECK(kurtogram.peak()->orders == band.orders);
        // This noise divides the kurtosis by (1 + 1)^2.
        CHECK(kurtogram.peak()->kurtosis == Approx(impulse_kurtosis(lines) / 4.0).epsilon(0.15));
    }
}

TEST_CASE("An amplitude-modulated tone has the kurtosis of its modulation") {
    constexpr double kDepth = 0.6;
    std::vector<double> x;
    for (int i = 0; i < 900; ++i) {
        const double t = 2.0 * std::numbers::pi * i / 900.0;
        x.push_back((1.0 + kDepth * std::cos(3.0 * t)) * std::cos(100.0 * t));
    }
    const Kurtogram kurtogram(x, 1);
    const double power = kDepth * kDepth;
    CHECK(
        kurtogram.peak()->kurtosis ==
        Approx((1.0 + 3.0 * power + 0.375 * power * power) / std::pow(1.0 + 0.5 * power, 2) - 2.0));
}

}  // namespace gearpod::test_kurtogram
