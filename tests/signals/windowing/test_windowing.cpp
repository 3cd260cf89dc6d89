#include "signals/windowing/windowing.hpp"
#include "tests/numbers.hpp"

namespace gearpod::signals::test_windowing {

constexpr double kPi = std::numbers::pi;

// Window as printed in Liang (2016), section 5.3.1.
double printed_tukey(int n, int points, double alpha) {
    const double last = points - 1;
    if (n < alpha * last / 2.0) {
        return 0.5 * (1.0 + std::cos(kPi * (2.0 * n / (alpha * last) - 1.0)));
    }
    if (n <= last * (1.0 - alpha / 2.0)) {
        return 1.0;
    }
    return 0.5 * (1.0 + std::cos(kPi * (2.0 * n / (alpha * last) - 2.0 / alpha + 1.0)));
}

// Liang (2016), section 5.3, step by step on a repeating time signal of Z_p Z_r meshes. Cuts the
// windows of tooth S every Z_p meshes, puts the n-th on ring tooth mod((n-1) Z_p + 1, Z_r), and
// takes the RMS of the assembled tooth signal.
std::vector<double> window_and_map(const std::vector<double>& signal, const SpanLayout& layout,
                                   int phases, double taper, int offset) {
    std::vector<double> rms;
    for (int s = 0; s < layout.planet_teeth; ++s) {
        std::vector<std::vector<double>> of_ring_tooth(layout.ring_teeth);
        for (int n = 1; n <= layout.ring_teeth; ++n) {
            const long first =
                (static_cast<long>(n - 1) * layout.planet_teeth + s) * phases + offset;
            std::vector<double> segment = test::tabulated(phases, [&](int m) {
                return printed_tukey(m, phases, taper) *
                       signal[(first + m) % static_cast<long>(signal.size())];
            });
            const int ring_tooth = ((n - 1) * layout.planet_teeth + 1) % layout.ring_teeth;
            of_ring_tooth[ring_tooth == 0 ? layout.ring_teeth - 1 : ring_tooth - 1] = segment;
        }
        double sum = 0.0;
        long samples = 0;
        for (const auto& segment : of_ring_tooth) {
            REQUIRE(!segment.empty());  // every ring tooth has its segment
            for (const double y : segment) {
                sum += y * y;
                ++samples;
            }
        }
        rms.push_back(std::sqrt(sum / static_cast<double>(samples)));
    }
    return rms;
}

TEST_CASE(
    "The Tukey window matches the printed one and its limits are the rectangular and the Hann "
    "window") {
    for (const double taper : {0.1, 0.35, 1.0}) {
        for (const int points : {17, 432}) {
            const std::vector<double> window = tukey_window(points, taper);
            for (int n = 0; n < points; ++n) {
                CHECK(window[n] == Approx(printed_tukey(n, points, taper)).margin(1e-14));
            }
        }
    }
    CHECK(tukey_window(5, 0.0) == std::vector<double>(5, 1.0));
    CHECK(tukey_window(5, 1.0)[1] == Approx(0.5));
    CHECK_THROWS_AS(tukey_window(5, 1.1), std::invalid_argument);
}

std::vector<double> random_values(std::size_t count, unsigned seed, double low, double high) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> uniform(low, high);
    return test::tabulated(count, [&](auto) { return uniform(engine); });
}

// Sums the noisy bins one by one for each window as printed, in 80 bits.
struct DirectWindows {
    int offset = 0;
    std::vector<double> rms;
    double mean_square = 0.0;
};

DirectWindows direct_windows(const std::vector<double>& folded, const NoiseVariates& noise,
                             double sigma, const SpanLayout& layout, int phases, double taper) {
    std::vector<long double> bins;
    long double total = 0.0L;
    for (std::size_t b = 0; b < folded.size(); ++b) {
        const long double along = static_cast<long double>(sigma) * noise.along[b] +
                                  std::sqrt(static_cast<long double>(folded[b]));
        bins.push_back(along * along + static_cast<long double>(sigma) * sigma * noise.across[b]);
        total += bins.back();
    }
    const std::vector<double> window = tukey_window(phases, taper);
    std::vector<long double> energy(bins.size(), 0.0L);
    for (std::size_t b = 0; b < bins.size(); ++b) {
        for (int m = 0; m < phases; ++m) {
            const long double w = window[m];
            energy[b] += w * w * bins[(b + m) % bins.size()];
        }
    }
    const auto most = std::max_element(energy.begin(), energy.end()) - energy.begin();
    DirectWindows out{static_cast<int>(most % phases), {}, 0.0};
    const long double samples = static_cast<long double>(phases) * layout.ring_teeth;
    for (int j = 0; j < layout.planet_teeth; ++j) {
        out.rms.push_back(static_cast<double>(
            std::sqrt(energy[static_cast<std::size_t>(j) * phases + out.offset] / samples)));
    }
    out.mean_square = static_cast<double>(total / (samples * layout.planet_teeth));
    return out;
}

TEST_CASE("Tooth RMS from the folded squares equals windowing and mapping of the time signal") {
    std::mt19937_64 engine(9);
    std::normal_distribution<double> normal;
    const SpanLayout layout{7, 12, 12};
    const int phases = 22;
    for (const double taper : {0.0, 0.1, 0.4, 1.0}) {
        std::vector<double> signal(static_cast<std::size_t>(layout.meshes()) * phases);
        std::ranges::generate(signal, [&] { return normal(engine); });
        Windowing windowing(layout, phases, taper);
        std::vector<double> rms(layout.planet_teeth);
        windowing.load(test::folded_squares(signal, 7 * 22));
        const int offset = windowing.search(0.0, rms);

        int best = 0;
        double largest = 0.0;
        for (int o = 0; o < phases; ++o) {
            const auto teeth = window_and_map(signal, layout, phases, taper, o);
            const double worst = *std::max_element(teeth.begin(), teeth.end());
            if (worst > largest * (1.0 + 1e-12)) {
                largest = worst;
                best = o;
            }
        }
        CHECK(offset == best);
        const auto expected = window_and_map(signal, layout, phases, taper, best);
        test::check_close(rms, expected, 1e-12);
    }
}

TEST_CASE("Every noise level's windows match its noisy bins, for faint noise or faint signal") {
    for (const int teeth : {2, 7, 8, 9, 16, 31}) {
        for (const int phases : {2, 13, 40}) {
            const SpanLayout layout{teeth, 12, 12};
            const std::size_t bins = static_cast<std::size_t>(teeth) * phases;
            const std::vector<double> folded = random_values(bins, 5, 0.0, 8.0);
            const NoiseVariates noise{random_values(bins, 6, -2.0, 2.0),
                                      random_values(bins, 7, 4.0, 20.0)};
            for (const double taper : {0.0, 0.1, 0.35, 0.8, 1.0}) {
                Windowing windowing(layout, phases, taper);
                windowing.load(folded, noise);
                for (const double sigma : {0.0, 1e-9, 1e-4, 0.1, 1.0, 30.0, 1e8}) {
                    const auto expected =
                        direct_windows(folded, noise, sigma, layout, phases, taper);
                    std::vector<double> rms(layout.planet_teeth);
                    INFO(teeth << " teeth, " << phases << " phases, taper " << taper << ", noise "
                               << sigma);
                    CHECK(windowing.search(sigma, rms) == expected.offset);
                    test::check_close(rms, expected.rms, 1e-14);
                    CHECK(windowing.mean_square(sigma) ==
                          Approx(expected.mean_square).epsilon(1e-14));
                }
            }
        }
    }
}

TEST_CASE("Noise that cancels the signal leaves zero, not less") {
    const SpanLayout layout{9, 12, 12};
    const int phases = 20;
    const double sigma = 0.7;
    const std::vector<double> folded = random_values(9 * 20, 8, 1.0, 8.0);
    NoiseVariates noise{{}, std::vector<double>(folded.size(), 0.0)};
    for (const double f : folded) {
        noise.along.push_back(-std::sqrt(f) / sigma);
    }
    Windowing windowing(layout, phases, 0.2);
    windowing.load(folded, noise);
    std::vector<double> rms(9), clean(9);
    windowing.search(sigma, rms);
    windowing.search(0.0, clean);
    for (int j = 0; j < 9; ++j) {
        CHECK(rms[j] >= 0.0);
        CHECK(rms[j] < 1e-7 * clean[j]);  // root of the rounding error
    }
    CHECK(windowing.mean_square(sigma) >= 0.0);
}

TEST_CASE("Without noise the windows do not depend on previously loaded noise") {
    const SpanLayout layout{31, 81, 81};
    const std::vector<double> folded = random_values(31 * 50, 3, 0.0, 1.0);
    const NoiseVariates noise{random_values(folded.size(), 6, -2.0, 2.0),
                              random_values(folded.size(), 7, 60.0, 90.0)};
    Windowing windowing(layout, 50, 0.1);
    std::vector<double> rms(31), alone(31);
    windowing.load(folded, noise);
    const int offset = windowing.search(0.0, rms);
    const double square = windowing.mean_square(0.0);
    windowing.load(folded);
    CHECK(windowing.search(0.0, alone) == offset);
    CHECK(rms == alone);
    CHECK(windowing.mean_square(0.0) == square);
    CHECK_THROWS_AS(windowing.search(1.0, rms), std::invalid_argument);
    CHECK_THROWS_AS(windowing.mean_square(1.0), std::invalid_argument);
    std::vector<double> few(30);
    CHECK_THROWS_AS(windowing.search(0.0, few), std::invalid_argument);
    CHECK_THROWS_AS(windowing.load(few), std::invalid_argument);
    CHECK_THROWS_AS(windowing.load(folded, NoiseVariates{few, few}), std::invalid_argument);
}

TEST_CASE("Equal teeth have bit-equal RMS and the earliest of equal offsets is used") {
    const SpanLayout layout{31, 81, 81};
    const int phases = 50;
    std::vector<double> folded = random_values(31 * phases, 4, 0.0, 1.0);
    for (int j = 1; j < 31; ++j) {
        std::copy_n(folded.begin(), phases, folded.begin() + j * phases);
    }
    for (const double taper : {0.0, 0.2, 0.7}) {
        Windowing windowing(layout, phases, taper);
        std::vector<double> rms(31);
        windowing.load(folded);
        windowing.search(0.0, rms);
        CHECK(rms == std::vector<double>(31, rms[0]));

        windowing.load(std::vector<double>(31 * phases, 2.0));
        CHECK(windowing.search(0.0, rms) == 0);
    }
}

TEST_CASE("The window search gives the same bits on every instruction set") {
    const SpanLayout layout{31, 81, 81};
    const std::vector<double> folded = random_values(31 * 432, 6, 0.0, 1.0);
    const NoiseVariates noise{random_values(folded.size(), 7, -2.0, 2.0),
                              random_values(folded.size(), 8, 60.0, 90.0)};
    Windowing windowing(layout, 432, 0.1);
    for (const double sigma : {0.0, 0.3}) {
        std::vector<double> reference(31);
        windowing.load(folded, noise);
        const int offset = windowing.search(sigma, reference);
        const double square = windowing.mean_square(sigma);
        test::for_each_instruction_set([&] {
            std::vector<double> rms(31);
            windowing.load(folded, noise);
            CHECK(windowing.search(sigma, rms) == offset);
            CHECK(rms == reference);
            CHECK(windowing.mean_square(sigma) == square);
        });
    }
}

}  // namespace gearpod::signals::test_windowing
