// Compares random values of a distribution with its distribution function.
#pragma once

#include "mc/files/input/document.hpp"
#include "mc/study/distributions/distribution.hpp"
#include "mc/study/random/philox.hpp"
#include "tests/test.hpp"

namespace gearpod::tests {

using namespace gearpod::mc;

inline Distribution distribution_of(const std::string& toml) {
    Problems problems;
    const Value document = parse_document("x = " + toml, "test.toml", problems);
    const auto distribution = Distribution::read(document.find("x")->value, "x", problems);
    INFO(format(problems));
    REQUIRE(distribution);
    return *distribution;
}

// Random values from the Sampler for that many instances, of a distribution given as TOML.
inline std::vector<double> samples_of(const std::string& toml, int count) {
    const Distribution distribution = distribution_of(toml);
    std::vector<double> samples;
    for (int i = 0; i < count; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        Philox engine(7, Group::test, index,
                      with_suffix(StreamPurpose::random_input, "operation.torque_N_m"));
        samples.push_back(distribution.draw(engine, index));
    }
    return samples;
}

// Largest distance between the empirical and the exact distribution function, times sqrt(n).
inline double kolmogorov_smirnov(std::vector<double> samples,
                                 const std::function<double(double)>& cdf) {
    std::sort(samples.begin(), samples.end());
    const double n = static_cast<double>(samples.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double exact = cdf(samples[i]);
        distance = std::max(
            {distance, exact - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - exact});
    }
    return distance * std::sqrt(n);
}

// Limit that is exceeded by chance once in ten thousand: 2 exp(-2 x^2) = 1e-4.
inline constexpr double kKsLimit = 2.23;
inline constexpr int kSamples = 20000;

}  // namespace gearpod::tests
