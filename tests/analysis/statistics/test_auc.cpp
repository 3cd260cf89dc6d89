#include "analysis/statistics/rank_statistics.hpp"
#include "tests/analysis/reference_data.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_auc {

struct Sample {
    std::vector<double> healthy, faulty;
};

Sample feature(std::size_t column) {
    const auto columns = reference_columns("features_40");
    Sample sample;
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        (columns[0][i] != 0.0 ? sample.faulty : sample.healthy).push_back(columns[column][i]);
    }
    return sample;
}

AucComponents interpolation_weights(const Sample& sample) {
    return auc_components(sample.healthy, sample.faulty);
}

TEST_CASE("Areas, their variances and paired differences agree with pROC, ties included") {
    // Reference: reference/reference_R.txt, method "delong".
    const double area[] = {0.62625, 0.6125, 0.715};
    const double variance[] = {0.008141282895, 0.008259868421, 0.007759210526};
    const AucComponents a = interpolation_weights(feature(1)),
                        b = interpolation_weights(feature(2)),
                        c = interpolation_weights(feature(3));
    const AucComponents* all[] = {&a, &b, &c};
    for (int f = 0; f < 3; ++f) {
        CHECK(all[f]->auc == Approx(area[f]).epsilon(1e-12));
        CHECK(auc_covariance(*all[f], *all[f]) == Approx(variance[f]).epsilon(1e-9));
    }
    const auto z = [](const AucComponents& x, const AucComponents& y) {
        return (x.auc - y.auc) /
               std::sqrt(auc_covariance(x, x) + auc_covariance(y, y) - 2.0 * auc_covariance(x, y));
    };
    CHECK(z(a, b) == Approx(0.1207950828).epsilon(1e-8));
    CHECK(z(a, c) == Approx(-0.8220962021).epsilon(1e-8));
    CHECK(z(b, c) == Approx(-0.8960643217).epsilon(1e-8));
}

TEST_CASE("Midranks give the same shares as a comparison of all pairs") {
    std::mt19937_64 engine(3);
    std::uniform_int_distribution<int> draw(0, 12);  // many ties
    Sample sample;
    for (int i = 0; i < 57; ++i) {
        sample.healthy.push_back(draw(engine));
    }
    for (int i = 0; i < 83; ++i) {
        sample.faulty.push_back(draw(engine) + 2);
    }
    const AucComponents fast = interpolation_weights(sample);
    const auto beyond = [](double x, double y) { return x > y ? 1.0 : x == y ? 0.5 : 0.0; };
    for (std::size_t i = 0; i < sample.healthy.size(); ++i) {
        double sum = 0.0;
        for (const double value : sample.faulty) {
            sum += beyond(value, sample.healthy[i]);
        }
        CHECK(fast.healthy[i] == Approx(sum / 83.0).margin(1e-13));
    }
    for (std::size_t j = 0; j < sample.faulty.size(); ++j) {
        double sum = 0.0;
        for (const double value : sample.healthy) {
            sum += beyond(sample.faulty[j], value);
        }
        CHECK(fast.faulty[j] == Approx(sum / 57.0).margin(1e-13));
    }
}

TEST_CASE("The area of two normal laws is Phi(d / sqrt 2), and its interval covers it") {
    std::mt19937_64 engine(11);
    std::normal_distribution<double> draw;
    const double truth = 0.5 * std::erfc(-1.2 / 2.0);
    int covered = 0;
    constexpr int kStudies = 2000;
    for (int s = 0; s < kStudies; ++s) {
        Sample sample{std::vector<double>(60), std::vector<double>(40)};
        std::ranges::generate(sample.healthy, [&] { return draw(engine); });
        std::ranges::generate(sample.faulty, [&] { return draw(engine) + 1.2; });
        const Auc result = auc(sample.healthy, sample.faulty, true, 0.95);
        covered += result.bounds.lower <= truth && truth <= result.bounds.upper ? 1 : 0;
    }
    CHECK(covered / static_cast<double>(kStudies) == Approx(0.95).margin(0.015));
}

TEST_CASE("Areas of separated, constant, empty and invalid samples are reported as such") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> low(10, 1.0), high{2.0, 3.0, 4.0, 5.0, nan};
    const Auc complete = auc(low, high, true, 0.95);
    CHECK(complete.auc == 1.0);
    CHECK(complete.faulty == 4);
    CHECK(complete.bounds.upper == 1.0);
    CHECK(complete.bounds.lower == Approx(std::pow(0.025, 0.25)));  // four pairs of four
    CHECK(auc(low, high, false, 0.95).auc == 0.0);
    const Auc constant = auc(low, low, true, 0.95);
    CHECK(constant.auc == Approx(0.5));
    CHECK(std::isnan(constant.bounds.lower));
    CHECK(std::isnan(auc({}, high, true, 0.95).auc));
    CHECK(std::isnan(auc(low, std::vector<double>{nan}, true, 0.95).auc));
    CHECK(std::isnan(auc(low, std::vector<double>{2.0}, true, 0.95).bounds.lower));
}

}  // namespace gearpod::analysis::test_auc
