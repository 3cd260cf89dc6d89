#include <boost/math/distributions/normal.hpp>

#include "signals/noise/normals.hpp"
#include "tests/numbers.hpp"
#include "tests/signals/noise/kolmogorov.hpp"

namespace gearpod::signals::test_normals {

// Random words, with extreme words in both positions of the pairs.
std::vector<std::uint64_t> some_words() {
    std::mt19937_64 engine(3);
    std::vector<std::uint64_t> words =
        test::tabulated(kNormalBlock * 4000, [&](auto) { return engine(); });
    constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
    std::size_t block = 0;
    for (const std::uint64_t word :
         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, kAll, kAll - 1, kAll / 2,
          kAll / 2 + 1, kAll - 1023, kAll - 2047, std::uint64_t{1} << 52, std::uint64_t{1} << 32,
          std::uint64_t{0xb504f333f9de6484}, std::uint64_t{0xfff}, ~std::uint64_t{0xfff}}) {
        words[block * kNormalBlock] = word;
        words[block * kNormalBlock + kNormalBlock - 1] = word;
        ++block;
    }
    return words;
}

std::vector<double> normals(const std::vector<std::uint64_t>& words) {
    std::vector<double> values(words.size());
    normals_from_words(words, values);
    return values;
}

std::vector<double> drawn(std::size_t count, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::vector<double> values(count);
    draw_normals(engine, values);
    return values;
}

TEST_CASE("Normal values match Box and Muller's formula in 80 bits") {
    const auto words = some_words();
    const auto values = normals(words);
    long double worst = 0.0L;
    double largest = 0.0;
    for (std::size_t block = 0; block < words.size(); block += kNormalBlock) {
        for (std::size_t first = block; first < block + kNormalBlock / 2; ++first) {
            const std::size_t second = first + kNormalBlock / 2;
            const auto rounded = static_cast<double>(words[first] | 1);
            const long double radius =
                std::sqrt(-2.0L * std::log(static_cast<long double>(rounded) * 0x1p-64L));
            // Steps of a quarter turn in the word's upper 52 bits; two more bits give the quadrant,
            // so that every step of a whole turn has its words.
            const std::uint64_t word = words[second];
            const long double quarter =
                (static_cast<long double>(word >> 12) + 0.5L) * 0x1p-52L - 0.5L;
            long double turn = 0.25L * quarter;
            turn = (word & 1) != 0 ? 0.5L - turn : turn;
            turn = (word & 2) != 0 ? 0.25L - turn : turn;
            const long double angle = 2.0L * std::numbers::pi_v<long double> * turn;
            const auto error = [&](double value, long double expected) {
                const long double slack = 2e-19L * radius;  // rounding of the angle
                return std::max(0.0L, std::abs(value - expected) - slack) / std::abs(expected);
            };
            if (radius > 0.0L) {
                worst = std::max({worst, error(values[first], radius * std::cos(angle)),
                                  error(values[second], radius * std::sin(angle))});
            } else {
                CHECK(values[first] == 0.0);
                CHECK(values[second] == 0.0);
            }
            largest = std::max({largest, std::abs(values[first]), std::abs(values[second])});
        }
    }
    INFO("worst " << static_cast<double>(worst) << ", largest " << largest);
    CHECK(worst < 2e-15L);
    CHECK(largest > 9.42 / std::numbers::sqrt2);  // for the word 0, sqrt(128 ln 2) from the axes
    CHECK(largest < 9.42);
}

TEST_CASE("Normal values have the same bits on every instruction set") {
    const auto words = some_words();
    const auto reference = normals(words);
    test::for_each_instruction_set([&] { CHECK(normals(words) == reference); });
    std::vector<double> few(kNormalBlock - 1);
    CHECK_THROWS_AS(normals_from_words(std::span(words).first(few.size()), few),
                    std::invalid_argument);
    CHECK_THROWS_AS(normals_from_words(words, few), std::invalid_argument);
}

TEST_CASE("Fewer normal values are the first of a longer sequence") {
    const auto many = drawn(3000, 8);
    for (const int count : {0, 1, 15, 16, 17, 511, 512, 513, 2999}) {
        CHECK(drawn(count, 8) == std::vector<double>(many.begin(), many.begin() + count));
    }
}

TEST_CASE("Normal values have the moments, the distribution and the tails of the normal law") {
    const std::size_t n = 1 << 21;
    const auto values = drawn(n, 21);
    const boost::math::normal standard;
    CHECK(kolmogorov(values, [&](double x) { return cdf(standard, x); }) < 1.95);
    const double one = 1.0 / std::sqrt(static_cast<double>(n));  // standard error of the mean
    double power[5] = {};
    for (const double z : values) {
        for (int k = 1; k <= 4; ++k) {
            power[k] += std::pow(z, k) / static_cast<double>(n);
        }
    }
    CHECK(std::abs(power[1]) < 4.0 * one);
    CHECK(std::abs(power[2] - 1.0) < 4.0 * one * std::sqrt(2.0));
    CHECK(std::abs(power[3]) < 4.0 * one * std::sqrt(15.0));
    CHECK(std::abs(power[4] - 3.0) < 4.0 * one * std::sqrt(96.0));
    for (const double limit : {2.0, 3.0, 4.0, 4.5}) {
        for (const double side : {-1.0, 1.0}) {
            const double expected = static_cast<double>(n) * cdf(standard, -limit);
            const auto seen = static_cast<double>(
                std::ranges::count_if(values, [&](double z) { return side * z > limit; }));
            INFO(seen << " values beyond " << side * limit << ", expected " << expected);
            CHECK(std::abs(seen - expected) < 4.0 * std::sqrt(expected));
        }
    }
    // The two values of a pair share their radius; neighbours and blocks are independent: neither
    // the values nor their squares are correlated.
    for (const std::size_t lag : {std::size_t{1}, kNormalBlock / 2, kNormalBlock}) {
        double sum = 0.0;
        double squares = 0.0;
        for (std::size_t i = 0; i + lag < n; ++i) {
            const double a = values[i];
            const double b = values[i + lag];
            sum += a * b / static_cast<double>(n);
            squares += (a * a - 1.0) * (b * b - 1.0) / static_cast<double>(n);
        }
        CHECK(std::abs(sum) < 4.0 * one);
        CHECK(std::abs(squares) < 4.0 * one * 2.0);
    }
}

}  // namespace gearpod::signals::test_normals
