// Checks gearboxes that fill the ranges of their inputs evenly: Sobol's points against published
// ones, the scramble against closed forms, and the resulting inputs of a study.
#include "mc/plan/sampling.hpp"
#include "mc/study/random/scrambled_sobol.hpp"
#include "tests/mc/plan/random_samples.hpp"
#include "tests/mc/study_example.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::mc::test_sampling_plan {

using namespace tests;

constexpr double kWhole = 0x1p-32;

Study sobol_study(std::vector<std::string> overrides = {}) {
    overrides.push_back("ensemble.sampling=sobol");
    return gearpod::test::valid_study(read_study_text(kExampleStudy, "study.toml", overrides));
}

// Position in its range of a gearbox's path exponent, uniform in this study.
const std::vector<std::string> kUniform = {
    "random.sensor.path_exponent={distribution='uniform',low=0.0,high=1.0}"};
double share_of(const Sampler& sampler, Group group, std::uint64_t index) {
    return sampler.draw({group, index}).inputs.path_exponent;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST_CASE("Sobol points match those printed by Joe and Kuo") {
    // Source: S. Joe, F. Y. Kuo, Notes on generating Sobol sequences (2008), the first ten points
    // in three dimensions, in Gray code order.
    constexpr std::array<std::array<double, 3>, 10> kPrinted{{{0, 0, 0},
                                                              {0.5, 0.5, 0.5},
                                                              {0.75, 0.25, 0.25},
                                                              {0.25, 0.75, 0.75},
                                                              {0.375, 0.375, 0.625},
                                                              {0.875, 0.875, 0.125},
                                                              {0.625, 0.125, 0.875},
                                                              {0.125, 0.625, 0.375},
                                                              {0.1875, 0.3125, 0.9375},
                                                              {0.6875, 0.8125, 0.4375}}};
    const Sobol sobol(3);
    for (std::uint32_t n = 0; n < kPrinted.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            CHECK(kWhole * sobol.coordinate(n ^ (n >> 1), d) == kPrinted[n][d]);
        }
    }
}

TEST_CASE("Every dyadic interval of every coordinate has its share of scrambled points") {
    const Sobol sobol(20);
    for (const std::uint64_t seed : {1U, 2U}) {
        for (std::size_t d = 0; d < 20; ++d) {
            const Philox tree(seed, Group::test, 0, StreamPurpose{d});
            std::set<std::uint32_t> intervals;
            for (std::uint32_t n = 0; n < 256; ++n) {
                intervals.insert(owen_scrambled(sobol.coordinate(n, d), tree) >> 24);
            }
            CHECK(intervals.size() == 256);
        }
    }
}

TEST_CASE("The first two coordinates are equidistributed over all rectangles of a net") {
    // Sobol's first two dimensions are a (0, m, 2)-net, which nested permutations preserve.
    const Sobol sobol(2);
    for (const unsigned first : {0U, 2U, 5U, 8U}) {
        std::set<std::uint64_t> cells;
        for (std::uint32_t n = 0; n < 256; ++n) {
            const std::uint64_t x =
                owen_scrambled(sobol.coordinate(n, 0), {5, Group::test, 0, StreamPurpose{0}});
            const std::uint64_t y =
                owen_scrambled(sobol.coordinate(n, 1), {5, Group::test, 0, StreamPurpose{1}});
            cells.insert((x >> (32 - first)) << 8 | y >> (24 + first));
        }
        CHECK(cells.size() == 256);
    }
}

TEST_CASE("A scrambled point is uniform over the seeds") {
    const Sobol sobol(3);
    std::vector<double> point_coordinates;
    for (std::uint64_t seed = 0; seed < 5000; ++seed) {
        point_coordinates.push_back(
            kWhole *
            owen_scrambled(sobol.coordinate(5, 2), {seed, Group::threshold, 0, StreamPurpose{3}}));
    }
    CHECK(kolmogorov_smirnov(point_coordinates, [](double x) { return x; }) < kKsLimit);
}

TEST_CASE("A mean over evenly distributed gearboxes has the variance of stratified ones") {
    // For n = 2^m values, one uniform in each n-th of (0, 1), the mean of x has variance 1 / (12
    // n^3); that of independent values is 1 / (12 n).
    constexpr int kSeeds = 400;
    constexpr std::uint64_t kGearboxes = 32, kSizes = 5;
    Study study = sobol_study(kUniform);
    double squares = 0.0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        study.ensemble.seed = seed;
        const Sampler sampler(DrawPlan{study});
        std::vector<double> shares;
        for (std::uint64_t i = 0; i < kGearboxes; ++i) {
            shares.push_back(share_of(sampler, Group::test, 2 + kSizes * i));
        }
        const double off = mean(shares) - 0.5;
        squares += off * off;
    }
    const double n = kGearboxes;
    const double ratio = squares / kSeeds * 12.0 * n * n * n;
    CHECK(ratio > 0.7);  // chi-squared with 400 degrees of freedom: 0.7 to 1.35 in all but 1e-4
    CHECK(ratio < 1.35);
}

TEST_CASE("Evenly distributed inputs keep their distributions and are mutually independent") {
    constexpr std::uint64_t kSizes = 5, kRounds = 4096;
    const Sampler sampler(DrawPlan{sobol_study(kUniform)});
    double product = 0.0;
    std::vector<double> stiffness;
    for (std::uint64_t i = 0; i < kRounds; ++i) {
        const InstanceInputs inputs = sampler.draw({Group::test, kSizes * i}).inputs;
        const double z = std::log(inputs.bodies[Member::planet].bearing_stiffness_N_m / 1.1e8) /
                         std::sqrt(std::log1p(0.04));
        stiffness.push_back(0.5 * std::erfc(-z / std::sqrt(2.0)));
        product += (stiffness.back() - 0.5) * (inputs.path_exponent - 0.5) * 12.0 / kRounds;
    }
    // Stratified to 1 / 4096, ten times closer than independent values are to their law.
    CHECK(kolmogorov_smirnov(stiffness, [](double x) { return x; }) < 0.05);
    CHECK(std::abs(product) < 0.01);  // independent values: 0.016 rms
}

TEST_CASE("Each fault size and each group has its own scramble") {
    // Over the seeds: within one, two scrambles of a sequence have equal or opposite first bits.
    constexpr int kSeeds = 600;
    Study study = sobol_study(kUniform);
    double between_sizes = 0.0, between_groups = 0.0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        study.ensemble.seed = seed;
        const Sampler sampler(DrawPlan{study});
        const double first = share_of(sampler, Group::test, 15) - 0.5;  // round 3, first size
        const double other = share_of(sampler, Group::test, 16) - 0.5;
        const double healthy = share_of(sampler, Group::threshold, 3) - 0.5;
        between_sizes += 12.0 * first * other / kSeeds;
        between_groups += 12.0 * first * healthy / kSeeds;
    }
    CHECK(std::abs(between_sizes) < 4.0 / std::sqrt(kSeeds));
    CHECK(std::abs(between_groups) < 4.0 / std::sqrt(kSeeds));
}

TEST_CASE("Healthy gearboxes are one sequence, regardless of the order of the sizes") {
    const Sampler sampler(DrawPlan{sobol_study(kUniform)});
    std::set<int> strata;
    for (std::uint64_t i = 0; i < 1024; ++i) {
        strata.insert(static_cast<int>(1024 * share_of(sampler, Group::threshold, i)));
    }
    CHECK(strata.size() == 1024);
}

TEST_CASE(
    "A larger ensemble begins with the gearboxes of a smaller one, also if evenly distributed") {
    const auto values_of = [](const Sampler& sampler, std::uint64_t index) {
        Realization drawn = sampler.draw({Group::test, index});
        drawn.random_values.push_back(drawn.inputs.fault_size);
        return drawn.random_values;
    };
    const Sampler small(DrawPlan{sobol_study()}),
        large(DrawPlan{sobol_study({"ensemble.instances=1000"})});
    for (std::uint64_t i = 0; i < 100; ++i) {
        CHECK(values_of(small, i) == values_of(large, i));
    }
    const Sampler other(DrawPlan{sobol_study({"ensemble.seed=8"})});
    CHECK(values_of(small, 3) != values_of(other, 3));
}

TEST_CASE("Correlated inputs stay correlated in evenly distributed gearboxes") {
    // Normals with correlation r agree in sign with probability 1/2 + asin(r) / pi (Sheppard 1899).
    const double rank = 0.6, r = 2.0 * std::sin(M_PI / 6.0 * rank);
    const Sampler sampler(
        DrawPlan{sobol_study({"random.operation.torque_N_m={distribution='normal',mean=400,sd=20}",
                              "random.gearbox.planet.mass_kg={distribution='normal',mean=2,sd=0.1}",
                              "random.correlations=[{between=['operation.torque_N_m',"
                              "'gearbox.planet.mass_kg'],rank=0.6}]"})});
    constexpr std::uint64_t kCount = 4096;
    int agree = 0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        const InstanceInputs inputs = sampler.draw({Group::threshold, i}).inputs;
        agree += (inputs.torque_N_m > 400) == (inputs.bodies[Member::planet].mass_kg > 2) ? 1 : 0;
    }
    CHECK(agree / static_cast<double>(kCount) ==
          Approx(0.5 + std::asin(r) / M_PI).margin(0.005));  // independent values: 0.007 rms
}

TEST_CASE("An unknown sampling plan is refused with the known ones") {
    const StudyReading reading =
        read_study_text(kExampleStudy, "study.toml", {"ensemble.sampling=latin"});
    REQUIRE_FALSE(reading.study);
    const std::string text = format(reading.problems);
    CHECK(text.find("ensemble.sampling") != std::string::npos);
    CHECK(text.find("one of \"plain\", \"sobol\"") != std::string::npos);
}

}  // namespace gearpod::mc::test_sampling_plan
