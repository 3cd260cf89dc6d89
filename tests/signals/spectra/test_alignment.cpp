// Checks the alignment of one record in another: known shifts are recovered, and noise and other
// signals lower the correlation.
#include "signals/spectra/alignment.hpp"
#include "tests/numbers.hpp"

namespace gearpod::signals::test_alignment {

// A period of n samples of some lines, with a delay of `shift` samples.
std::vector<double> lines(std::size_t n, double shift) {
    std::vector<double> signal(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double turn =
            2.0 * std::numbers::pi * (static_cast<double>(i) + shift) / static_cast<double>(n);
        signal[i] = 3.0 + std::cos(turn) + 0.7 * std::sin(5.0 * turn + 0.4) +
                    0.4 * std::cos(31.0 * turn + 1.1);
    }
    return signal;
}

TEST_CASE("An integer or fractional shift is found and removed") {
    for (const std::size_t n : {279U, 512U, 31U * 27U}) {
        for (const double shift : {0.0, 17.0, 100.37, static_cast<double>(n) - 0.25}) {
            const auto signal = lines(n, 0.0), other = lines(n, -shift);
            const Alignment found = align(signal, other);
            CHECK(found.correlation == Approx(1.0).margin(1e-9));
            CHECK(std::remainder(found.shift.total() - shift, static_cast<double>(n)) ==
                  Approx(0.0).margin(1e-6));
            CHECK(test::largest_difference(shifted(other, found.shift), signal) < 1e-5);
        }
    }
}

TEST_CASE("Noise lowers the correlation according to its energy, and changes the shift little") {
    std::mt19937 engine(4);
    std::normal_distribution<double> normal;
    auto signal = lines(2790, 0.0);
    const auto other = lines(2790, -41.6);
    const double energy = 0.5 * (1.0 + 0.49 + 0.16);
    for (double& value : signal) {
        value += std::sqrt(energy) * normal(engine);
    }
    const Alignment found = align(signal, other);
    CHECK(found.correlation == Approx(std::sqrt(0.5)).margin(0.03));
    CHECK(found.shift.total() == Approx(41.6).margin(1.5));
    CHECK(correlation(signal, shifted(other, found.shift)) ==
          Approx(found.correlation).margin(1e-9));
}

TEST_CASE("Signals that cannot be aligned have no correlation") {
    const std::vector<double> constant(100, 2.0), ramp{1, 2, 3};
    CHECK(align(constant, lines(100, 0.0)).correlation == 0.0);
    CHECK(correlation(constant, constant) == 0.0);
    CHECK_THROWS_AS(align(ramp, constant), std::invalid_argument);
    CHECK_THROWS_AS(align({}, {}), std::invalid_argument);
}

}  // namespace gearpod::signals::test_alignment
