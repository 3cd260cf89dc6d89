// Checks a90 over the false-alarm rate where both are known: a normal feature whose mean
// grows with the size.
#include "analysis/detection/threshold.hpp"
#include "analysis/false_alarm_curve.hpp"
#include "tests/analysis/detection/gearbox_laws.hpp"

namespace gearpod::analysis::test_false_alarm_curve {

const boost::math::normal kNormal;

// Features of 1 + size / mm +- 1, healthy ones around 0: the POD is exactly a probit of the size.
struct Study {
    std::vector<double> healthy, size, value;

    Study(int healthy_ones, int faulty, std::uint64_t seed, double sign = 1.0) {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise;
        std::uniform_real_distribution<double> sizes(0.0, 8.0);
        for (int i = 0; i < healthy_ones; ++i) {
            healthy.push_back(sign * noise(engine));
        }
        for (int i = 0; i < faulty; ++i) {
            size.push_back(sizes(engine));
            value.push_back(sign * (size.back() + noise(engine)));
        }
    }
    TestValues values(Alarm alarm = Alarm::high) const { return {alarm, {healthy}, size, value}; }
};

double true_a90(double rate) {
    return quantile(complement(kNormal, rate)) + quantile(kNormal, 0.9);
}

const PodForm kProbit{Link::probit, false, 0.0, false};

TEST_CASE(
    "a90 over the false-alarm rate matches the normal law, down to the lowest supported rate") {
    const Study study(2000, 3000, 4);
    const FalseAlarmCurve curve = false_alarm_curve(study.values(), {&kProbit, 1}, 0.95);
    REQUIRE(curve.refusal.empty());
    CHECK(curve.points.size() == 10);
    CHECK(curve.points.back().false_alarm_rate == 1e-4);
    CHECK(curve.points.back().extrapolation == Approx(5.0));
    CHECK(curve.points[6].extrapolation == 0.0);
    double before = 0.0;
    for (const RatePoint& point : curve.points) {
        const double truth = true_a90(point.false_alarm_rate);
        INFO(point.false_alarm_rate << " " << truth);
        REQUIRE(point.a90.estimate.where == SizeEstimate::Where::reached);
        // The a90 may stay equal at 2e-4, where the tail replaces the sample's largest value.
        CHECK((point.a90.estimate.size > before || point.false_alarm_rate == 2e-4));
        CHECK(point.a90.estimate.size >= before);
        before = point.a90.estimate.size;
        CHECK(point.a90.estimate.size == Approx(truth).margin(0.6));
        CHECK(point.threshold_bounds.lower < point.threshold);
        CHECK(point.threshold_bounds.upper > point.threshold);
    }
    // A low alarm on the negative feature gives the same result.
    const FalseAlarmCurve low =
        false_alarm_curve(Study(2000, 3000, 4, -1.0).values(Alarm::low), {&kProbit, 1}, 0.95);
    REQUIRE(low.points.size() == curve.points.size());
    CHECK(low.points[9].a90.upper.size == Approx(curve.points[9].a90.upper.size));
    CHECK(low.points[9].threshold == Approx(-curve.points[9].threshold));
}

TEST_CASE("Bounds of a90 include the threshold's scatter over 100 studies") {
    int covered[3] = {}, narrow = 0;
    constexpr int kStudies = 100;
    for (int s = 0; s < kStudies; ++s) {
        const Study study(1000, 200, 100 + s);
        const FalseAlarmCurve curve = false_alarm_curve(study.values(), {&kProbit, 1}, 0.95);
        REQUIRE(curve.points.size() == 9);
        int k = 0;
        for (const std::size_t at : {1, 6, 8}) {  // 0.05, 0.001 and twice beyond the sample
            const RatePoint& point = curve.points[at];
            const double truth = true_a90(point.false_alarm_rate);
            const bool above = point.a90.lower.where != SizeEstimate::Where::reached ||
                               point.a90.lower.size <= truth;
            const bool below = point.a90.upper.where != SizeEstimate::Where::reached ||
                               truth <= point.a90.upper.size;
            covered[k++] += above && below ? 1 : 0;
        }
        narrow += curve.points[8].a90.upper.where == SizeEstimate::Where::reached ? 1 : 0;
    }
    // Coverage is at least nominal, whatever the correlation of the two parts of the error.
    for (const int count : covered) {
        CHECK(count >= 0.95 * kStudies - 2.0 * std::sqrt(0.05 * 0.95 * kStudies));
    }
    CHECK(narrow > kStudies / 2);  // and not because it is open
}

TEST_CASE("Rates that a sample cannot determine leave the bounds of a90 at others unchanged") {
    // Forty recordings each of 50 gearboxes: the rarest threshold may be lower than the first.
    const Study study(2000, 3000, 4);
    std::vector<std::size_t> gearbox =
        test::tabulated(study.healthy.size(), [&](std::size_t i) { return i / 40; });
    const TestValues values{Alarm::high, {study.healthy, gearbox}, study.size, study.value};
    const auto points = false_alarm_curve(values, {&kProbit, 1}, 0.95).points;
    REQUIRE(points.size() > 5);
    REQUIRE(points.back().threshold_bounds.lower < points.front().threshold_bounds.lower);
    for (const RatePoint& point : points) {
        INFO(point.false_alarm_rate);
        REQUIRE(point.a90.lower.where == SizeEstimate::Where::reached);
        CHECK(point.a90.lower.size > true_a90(0.1) - 0.4);
        CHECK(point.a90.lower.size < true_a90(point.false_alarm_rate));
    }
}

}  // namespace gearpod::analysis::test_false_alarm_curve
