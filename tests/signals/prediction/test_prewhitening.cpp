// Checks cepstral pre-whitening.
#include "signals/prediction/prewhitening.hpp"
#include "tests/test.hpp"

namespace gearpod::signals::test_prewhitening {

TEST_CASE("Pre-whitening keeps an impulse and makes tones as weak as every other order") {
    // An impulse has equal magnitudes; without its mean it is 1 - 1/n there and -1/n elsewhere.
    constexpr std::size_t kPoints = 420;
    const auto n = static_cast<double>(kPoints);
    Prewhitening prewhitening(kPoints);
    std::vector<double> x(kPoints, 0.0);
    x[37] = 0.02;
    std::vector<double> white = prewhitening.whitened(x);
    for (std::size_t i = 0; i < kPoints; ++i) {
        CHECK(white[i] == Approx((i == 37 ? 1.0 : 0.0) - 1.0 / n).margin(1e-12));
    }
    for (std::size_t i = 0; i < kPoints; ++i) {
        x[i] += 50.0 * std::cos(2.0 * std::numbers::pi * 20.0 * static_cast<double>(i) / n);
    }
    // The tone changes the phases of order 20 and its mirror only, by at most 2 each.
    white = prewhitening.whitened(x);
    CHECK(white[37] == Approx(1.0 - 1.0 / n).margin(4.0 / n + 1e-9));
    CHECK(std::abs(white[36]) < 6.0 / n);
    for (const double value : prewhitening.whitened(std::vector<double>(kPoints, 2.0))) {
        CHECK(value == 0.0);
    }
}

}  // namespace gearpod::signals::test_prewhitening
