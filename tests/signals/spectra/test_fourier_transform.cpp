#include <thread>

#include "signals/spectra/fourier_transform.hpp"
#include "tests/numbers.hpp"

namespace gearpod::signals::test_fourier_transform {

using Complex = std::complex<double>;

std::vector<Complex> random_signal(int points) {
    std::mt19937_64 engine(static_cast<unsigned>(points));
    std::normal_distribution<double> normal;
    return test::tabulated(points, [&](auto) { return Complex{normal(engine), normal(engine)}; });
}

std::vector<Complex> transformed(const std::vector<Complex>& signal,
                                 FourierTransform::Direction way) {
    std::vector<Complex> out(signal.size());
    FourierTransform(static_cast<int>(signal.size()), way).transform(signal, out);
    return out;
}

// Definition of the transform, in 80 bits.
std::complex<long double> direct(const std::vector<Complex>& signal, std::size_t k, int sign) {
    const std::size_t n = signal.size();
    std::complex<long double> sum = 0.0L;
    for (std::size_t i = 0; i < n; ++i) {
        const long double angle = sign * 2.0L * std::numbers::pi_v<long double> *
                                  static_cast<long double>(i * k % n) / static_cast<long double>(n);
        sum += std::complex<long double>(signal[i]) *
               std::complex<long double>(std::cos(angle), std::sin(angle));
    }
    return sum;
}

TEST_CASE("Fourier transforms of any length are the sums that define them, both ways") {
    for (const int points :
         {1, 2, 5, 7, 31, 36, 62, 7 * 7, 7 * 31, 13 * 8, 31 * 108, 97 * 20, 2 * 1009}) {
        const auto signal = random_signal(points);
        // Results have a magnitude of some sqrt(2 n).
        const double limit = 1e-14 * std::sqrt(points);
        for (const auto way :
             {FourierTransform::Direction::forward, FourierTransform::Direction::back}) {
            const int sign = way == FourierTransform::Direction::back ? 1 : -1;
            const auto spectrum = transformed(signal, way);
            double worst = 0.0;
            for (std::size_t k = 0; k < spectrum.size(); k += 1 + spectrum.size() / 300) {
                const auto difference =
                    std::complex<long double>(spectrum[k]) - direct(signal, k, sign);
                worst = std::max(worst, static_cast<double>(std::abs(difference)));
            }
            INFO(points << " points, worst " << worst);
            CHECK(worst < limit);
        }
    }
}

TEST_CASE("The transform and its inverse give the signal times its length") {
    const auto signal = random_signal(31 * 432);
    const auto again = transformed(transformed(signal, FourierTransform::Direction::forward),
                                   FourierTransform::Direction::back);
    const auto scaled = test::mapped(again, [](Complex x) { return x / (31.0 * 432.0); });
    CHECK(test::largest_difference(scaled, signal) < 1e-13);
}

TEST_CASE("Fourier transforms have the same bits on every instruction set") {
    const auto signal = random_signal(31 * 108);
    const auto reference = transformed(signal, FourierTransform::Direction::forward);
    test::for_each_instruction_set(
        [&] { CHECK(transformed(signal, FourierTransform::Direction::forward) == reference); });
}

TEST_CASE("Transforms that share the factors of a length have the bits of another thread's first") {
    const auto signal = random_signal(31 * 36);
    for (const auto way :
         {FourierTransform::Direction::forward, FourierTransform::Direction::back}) {
        std::vector<Complex> first;
        std::thread([&] { first = transformed(signal, way); }).join();
        for (int points = 1; points < 40; ++points) {
            CHECK(transformed(signal, way) == first);
            transformed(random_signal(points), way);
        }
    }
}

TEST_CASE("A Fourier transform refuses other lengths than its own") {
    FourierTransform transform(62);
    std::vector<Complex> right(62);
    std::vector<Complex> wrong(61);
    CHECK_THROWS_AS(transform.transform(wrong, right), std::invalid_argument);
    CHECK_THROWS_AS(transform.transform(right, wrong), std::invalid_argument);
    CHECK_THROWS_AS(FourierTransform(0), std::invalid_argument);
}

}  // namespace gearpod::signals::test_fourier_transform
