// Checks deviations of later records from a baseline of the gearbox's first records.
#include <boost/math/distributions/students_t.hpp>

#include "analysis/monitoring/baseline_deviations.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_baseline_deviations {

// Share of deviations of one further healthy record beyond the upper 5 % point of Student's t.
double share_beyond(std::size_t baseline, bool with_condition, double freedom) {
    constexpr int kGearboxes = 40'000;
    const double limit =
        boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), 0.05));
    std::mt19937_64 engine(11);
    std::normal_distribution<double> normal;
    int beyond = 0;
    for (int g = 0; g < kGearboxes; ++g) {
        const double level = 50.0 * normal(engine), slope = with_condition ? normal(engine) : 0.0;
        std::vector<double> values, condition;
        for (std::size_t i = 0; i <= baseline; ++i) {
            const double torque = 400.0 + 20.0 * normal(engine);
            values.push_back(level + slope * torque + 3.0 * normal(engine));
            condition.push_back(torque);
        }
        if (!with_condition) {
            condition.clear();
        }
        beyond +=
            baseline_deviations(values, condition, baseline, Alarm::high).back() > limit ? 1 : 0;
    }
    return static_cast<double>(beyond) / kGearboxes;
}

TEST_CASE("Deviations from a gearbox's baseline records follow Student's t") {
    // Three standard errors of a share of 5 % are 0.33 %.
    CHECK(share_beyond(5, false, 4.0) == Approx(0.05).margin(0.0033));
    CHECK(share_beyond(20, false, 19.0) == Approx(0.05).margin(0.0033));
    CHECK(share_beyond(6, true, 4.0) == Approx(0.05).margin(0.0033));
    CHECK(share_beyond(20, true, 18.0) == Approx(0.05).margin(0.0033));
}

TEST_CASE("Without scatter, values or records there is no baseline") {
    const auto all_nan = [](const std::vector<double>& values) {
        return std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
    };
    CHECK(all_nan(baseline_deviations(std::vector<double>{1, 1, 1, 1, 9}, {}, 4, Alarm::high)));
    CHECK(all_nan(baseline_deviations(std::vector<double>{1, 2, 9}, {}, 2, Alarm::high)));
    CHECK(all_nan(baseline_deviations(std::vector<double>{1, 2, 3}, {}, 20, Alarm::high)));
    const double nan = std::nan("");
    const std::vector<double> gaps{1, nan, 2, 3, nan, 5};
    const auto seen = baseline_deviations(gaps, {}, 4, Alarm::low);
    CHECK(std::isnan(seen[3]));
    CHECK(std::isnan(seen[4]));
    CHECK(seen[5] == Approx(-3.0 / std::sqrt(1.0 + 1.0 / 3.0)));
    CHECK(baseline_deviations(gaps, {}, 0, Alarm::low)[3] == -3.0);
}

// The mean of equal numbers need not equal that number in floating point: the mean of five 1.1 is
// not 1.1.
TEST_CASE("A baseline at one torque is valid at that torque alone, however many records it has") {
    for (std::size_t baseline = 4; baseline <= 25; ++baseline) {
        std::vector<double> values, torque(baseline + 2, 1.1);
        for (std::size_t i = 0; i < baseline; ++i) {
            values.push_back(i % 2 == 0 ? 9.0 : 11.0);
        }
        values.insert(values.end(), {30.0, 30.0});
        torque.back() = 1.2;
        INFO(baseline);
        const auto seen = baseline_deviations(values, torque, baseline, Alarm::high);
        CHECK(seen[baseline] > 10.0);
        CHECK(std::isnan(seen[baseline + 1]));
    }
}

TEST_CASE("A condition that does not vary costs no degree of freedom") {
    const std::vector<double> values{9, 11, 8, 12, 30}, same(5, 400.0);
    CHECK(baseline_deviations(values, same, 4, Alarm::high).back() ==
          Approx(baseline_deviations(values, {}, 4, Alarm::high).back()));
    const Alarm alarms[] = {Alarm::high, Alarm::high};
    CHECK_THROWS_AS(fused_deviations({values, {1, 2, 3, 4}}, {}, 3, alarms), std::invalid_argument);
}

TEST_CASE("Fused features have unit variance and detect a common shift sooner") {
    constexpr std::size_t kBaseline = 2000, kRecords = 40'000;
    const double shared = 0.6;  // correlation 0.36
    std::mt19937_64 engine(7);
    std::normal_distribution<double> normal;
    std::vector<std::vector<double>> values(2, std::vector<double>(kRecords));
    for (std::size_t i = 0; i < kRecords; ++i) {
        const double common = shared * normal(engine);
        const double own = std::sqrt(1.0 - shared * shared);
        const double moved = i >= kRecords / 2 ? 1.0 : 0.0;
        values[0][i] = 7.0 + 2.0 * (common + own * normal(engine) + moved);
        values[1][i] = 1.0 - 5.0 * (common + own * normal(engine) + moved);  // alarms low
    }
    const Alarm alarms[] = {Alarm::high, Alarm::low};
    const auto fused = fused_deviations(values, {}, kBaseline, alarms);
    double mean = 0.0, square = 0.0, later = 0.0;
    for (std::size_t i = kBaseline; i < kRecords / 2; ++i) {
        mean += fused[i] / (kRecords / 2.0 - kBaseline);
        square += fused[i] * fused[i] / (kRecords / 2.0 - kBaseline);
    }
    for (std::size_t i = kRecords / 2; i < kRecords; ++i) {
        later += fused[i] / (kRecords / 2.0);
    }
    CHECK(square - mean * mean == Approx(1.0).epsilon(0.05));
    CHECK(later - mean == Approx(2.0 / std::sqrt(2.0 + 2.0 * shared * shared)).epsilon(0.05));
    CHECK(std::isnan(fused[kBaseline - 1]));
    // A single feature is returned unchanged; a feature that never varies is left out.
    const auto alone = baseline_deviations(values[0], {}, kBaseline, Alarm::high);
    const auto with_constant =
        fused_deviations({values[0], std::vector<double>(kRecords, 3.0)}, {}, kBaseline, alarms);
    CHECK(with_constant.back() == Approx(alone.back()).epsilon(1e-12));
}

}  // namespace gearpod::analysis::test_baseline_deviations
