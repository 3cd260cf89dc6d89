// Checks the correction by gearboxes computed twice against differences that are known.
#include "mc/numerics/numerical_error.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "tests/test.hpp"

namespace gearpod::mc::test_paired_correction {

constexpr double kOffset = 0.1, kByValue = 0.02, kBySize = 150.0;

double fine_of(double own, double size) {
    return own + kOffset + kByValue * own + kBySize * size;
}

// Gearboxes whose feature grows with the fault, with the run's steps and with fine ones.
// `residual`: standard deviation of the difference that is not fitted.
struct Population {
    PairedValues all;

    Population(std::uint32_t seed, std::size_t each, double residual) {
        std::mt19937 engine(seed);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> uniform(0.2e-3, 4e-3);
        for (std::size_t i = 0; i < 2 * each; ++i) {
            const double size = i < each ? 0.0 : uniform(engine);
            const double own = 5.0 + normal(engine) + 1500.0 * size;
            all.own.push_back(own);
            all.fine.push_back(fine_of(own, size) + residual * normal(engine));
            all.size.push_back(size);
        }
    }

    // Every `stride`-th gearbox.
    PairedValues pairs(std::size_t stride) const {
        PairedValues some;
        for (std::size_t i = 0; i < all.own.size(); i += stride) {
            some.own.push_back(all.own[i]);
            some.fine.push_back(all.fine[i]);
            some.size.push_back(all.size[i]);
        }
        return some;
    }

    Results results(const std::vector<double>& values) const {
        Results r;
        r.parameters = {{"fault_depth_m", "m", all.size}};
        r.noise_levels = {1.0};
        r.features = {{"te_rms", "rad", analysis::Alarm::high, values}};
        r.request = {0.05, 0.95, {1.0}, {{0.0, 5e-3}}, {"fault_depth_m", "m"}};
        for (const double size : all.size) {
            r.group.push_back(static_cast<int>(size > 0.0 ? Group::test : Group::threshold));
        }
        r.status.assign(r.group.size(), 0);
        r.detection = detect_all(r, ColumnRows(r));
        return r;
    }
};

double a90_of(const Results& r) {
    const auto reliability = reliability_of(r, ColumnRows(r), "", 1);
    REQUIRE(reliability);
    return reliability->features[0].levels[0].hit_miss.a90.estimate.size;
}

TEST_CASE("The correction recovers a difference that grows with the value and the fault") {
    PairedValues pairs = Population(1, 100, 0.0).all;
    pairs.own[3] = std::numeric_limits<double>::quiet_NaN();
    const PairedCorrection found = fit_correction(pairs);
    CHECK(found.offset == Approx(kOffset));
    CHECK(found.by_value == Approx(kByValue));
    CHECK(found.by_size == Approx(kBySize));
    CHECK(found.by_size_error < 1e-9);
    CHECK(found.healthy_bias < 0.0);
    CHECK(found.faulty_bias < found.healthy_bias);
    CHECK(found.scatter_ratio == Approx(1.0 / (1.0 + kByValue)));
}

TEST_CASE("The standard error of the correction is that of repeated samples") {
    double sum = 0.0, squares = 0.0, stated = 0.0;
    constexpr int kSamples = 200;
    for (std::uint32_t seed = 0; seed < kSamples; ++seed) {
        const PairedCorrection found = fit_correction(Population(seed, 40, 0.2).all);
        sum += found.by_size;
        squares += found.by_size * found.by_size;
        stated += found.by_size_error / kSamples;
    }
    const double mean = sum / kSamples;
    const double deviation = std::sqrt(squares / kSamples - mean * mean);
    CHECK(mean == Approx(kBySize).margin(4.0 * deviation / std::sqrt(kSamples)));
    CHECK(stated == Approx(deviation).epsilon(0.15));
}

TEST_CASE("Fewer than eight pairs of a group give no correction") {
    CHECK(std::isnan(fit_correction(Population(1, 7, 0.1).all).by_size));
    CHECK(std::isfinite(fit_correction(Population(1, 8, 0.1).all).by_size));
}

TEST_CASE("a90 with the correction agrees with that of fine steps within its stated error") {
    int within = 0, without = 0;
    constexpr int kSeeds = 20;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        const Population population(seed, 800, 0.05);
        const double fine = a90_of(population.results(population.all.fine));
        Results own = population.results(population.all.own);
        own.numerical = NumericalError{"own", "fine", 80, {0.0},
                                       {0.0}, 80,     80, {fit_correction(population.pairs(10))}};
        const CorrectedDetection corrected = corrected_detection(own, ColumnRows(own)).at(0);
        // The fitted curves differ by more than the interval where single gearboxes change sides.
        const double resolution = 0.01 * fine;
        CHECK(corrected.a90_lower <= corrected.a90);
        CHECK(corrected.a90 <= corrected.a90_upper);
        within +=
            corrected.a90_lower - resolution <= fine && fine <= corrected.a90_upper + resolution;
        const double before = a90_of(own);
        without += corrected.a90_lower - resolution <= before &&
                   before <= corrected.a90_upper + resolution;
    }
    CHECK(within >= 18);
    CHECK(without <= 4);
}

TEST_CASE("Results without pairs have no corrected detection") {
    const Population population(1, 20, 0.1);
    Results own = population.results(population.all.own);
    CHECK(corrected_detection(own, ColumnRows(own)).empty());
    own.numerical = NumericalError{"own", "fine", 8, {0.0}, {0.0}};
    CHECK(corrected_detection(own, ColumnRows(own)).empty());
}

}  // namespace gearpod::mc::test_paired_correction
