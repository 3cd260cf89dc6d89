#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "machine/dispatch.hpp"
#include "signals/windowing.hpp"

namespace gearpod::signals {
namespace {

constexpr double kPi = std::numbers::pi;

// The window as printed in Liang (2016), section 5.3.1.
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

// Liang (2016), section 5.3, step by step on a time signal of Z_p Z_r meshes that repeats: cut the
// windows of tooth S every Z_p meshes, put the n-th on ring tooth mod((n-1) Z_p + 1, Z_r), and take
// the RMS of the assembled tooth signal.
std::vector<double> window_and_map(const std::vector<double>& signal, const SpanLayout& layout,
                                   int phases, double taper, int offset) {
    std::vector<double> rms;
    for (int s = 0; s < layout.planet_teeth; ++s) {
        std::vector<std::vector<double>> of_ring_tooth(layout.ring_teeth);
        for (int n = 1; n <= layout.ring_teeth; ++n) {
            const long first =
                (static_cast<long>(n - 1) * layout.planet_teeth + s) * phases + offset;
            std::vector<double> segment;
            for (int m = 0; m < phases; ++m) {
                segment.push_back(printed_tukey(m, phases, taper) *
                                  signal[(first + m) % static_cast<long>(signal.size())]);
            }
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

std::vector<double> fold(const std::vector<double>& signal, std::size_t bins) {
    std::vector<double> folded(bins, 0.0);
    for (std::size_t i = 0; i < signal.size(); ++i) {
        folded[i % bins] += signal[i] * signal[i];
    }
    return folded;
}

TEST_CASE("The Tukey window is the printed one and ends in the rectangular and the Hann window") {
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

TEST_CASE("Tooth RMS from the folded squares equals windowing and mapping of the time signal") {
    std::mt19937_64 engine(9);
    std::normal_distribution<double> normal;
    const SpanLayout layout{7, 12, 12};
    const int phases = 22;
    for (const double taper : {0.0, 0.1, 0.4, 1.0}) {
        std::vector<double> signal(static_cast<std::size_t>(layout.meshes()) * phases);
        for (double& y : signal) {
            y = normal(engine);
        }
        Windowing windowing(layout, phases, taper);
        std::vector<double> rms(layout.planet_teeth);
        const int offset = windowing.search(fold(signal, 7 * 22), rms);

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
        for (int j = 0; j < layout.planet_teeth; ++j) {
            CHECK(rms[j] == Approx(expected[j]).epsilon(1e-12));
        }
    }
}

TEST_CASE("Equal teeth have bit-equal RMS and the earliest of equal offsets is taken") {
    const SpanLayout layout{31, 81, 81};
    const int phases = 50;
    std::mt19937_64 engine(4);
    std::uniform_real_distribution<double> uniform;
    std::vector<double> folded(31 * phases);
    for (int p = 0; p < phases; ++p) {
        folded[p] = uniform(engine);
    }
    for (int j = 1; j < 31; ++j) {
        std::copy_n(folded.begin(), phases, folded.begin() + j * phases);
    }
    Windowing windowing(layout, phases, 0.2);
    std::vector<double> rms(31);
    windowing.search(folded, rms);
    CHECK(rms == std::vector<double>(31, rms[0]));

    Windowing flat(layout, phases, 0.2);
    CHECK(flat.search(std::vector<double>(31 * phases, 2.0), rms) == 0);
}

TEST_CASE("The window search gives the same bits on every instruction set") {
    const SpanLayout layout{31, 81, 81};
    std::mt19937_64 engine(6);
    std::uniform_real_distribution<double> uniform;
    std::vector<double> folded(31 * 432);
    for (double& value : folded) {
        value = uniform(engine);
    }
    Windowing windowing(layout, 432, 0.1);
    const auto best = machine::best_instruction_set();
    std::vector<double> reference(31);
    const int offset = windowing.search(folded, reference);
    for (int set = 0; set <= static_cast<int>(best); ++set) {
        machine::use_instruction_set(static_cast<machine::InstructionSet>(set));
        std::vector<double> rms(31);
        CHECK(windowing.search(folded, rms) == offset);
        CHECK(rms == reference);
    }
    machine::use_instruction_set(best);
}

}  // namespace
}  // namespace gearpod::signals
