// Checks the ROC against a small hand-drawn one and against the area from ranks (auc()).
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "analysis/ranking/roc.hpp"
#include "analysis/statistics/auc.hpp"

namespace test_roc {

using namespace gearpod::analysis;

namespace {

double area_below(const std::vector<RocPoint>& points) {
    double area = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        area += 0.5 * (points[i].false_alarm_rate - points[i - 1].false_alarm_rate) *
                (points[i].detection_rate + points[i - 1].detection_rate);
    }
    return area;
}

// Integer values, so that ties are frequent.
std::vector<double> sample(std::size_t count, double mean, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(mean, 8.0);
    std::vector<double> values(count);
    for (double& value : values) {
        value = std::round(normal(engine));
    }
    return values;
}

}  // namespace

TEST_CASE("A ROC has one corner per threshold; equal values share a corner") {
    // Thresholds 4, 3, 2, 1 detect 1, 2, 2, 3 of three faulty and give 0, 1, 2, 2 false alarms of
    // two healthy.
    const std::vector<double> healthy{2, 3}, faulty{4, 3, 1};
    const auto points = roc_curve(healthy, faulty, true);
    REQUIRE(points.size() == 5);
    const double expected[][2] = {{0, 0}, {0, 1.0 / 3}, {0.5, 2.0 / 3}, {1, 2.0 / 3}, {1, 1}};
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK(points[i].false_alarm_rate == Approx(expected[i][0]));
        CHECK(points[i].detection_rate == Approx(expected[i][1]));
    }
}

TEST_CASE("The area below a ROC is the Mann-Whitney area, for either side of the alarm") {
    const auto healthy = sample(300, 0.0, 1), faulty = sample(200, 5.0, 2);
    for (const bool high : {true, false}) {
        const auto points = roc_curve(healthy, faulty, high, 100000);
        CHECK(area_below(points) == Approx(auc(healthy, faulty, high, 0.95).auc).epsilon(1e-12));
    }
}

TEST_CASE("A thinned ROC keeps corners of the whole one, its ends and nearly its area") {
    const auto healthy = sample(30000, 0.0, 3);
    std::vector<double> faulty;
    std::mt19937_64 engine(4);
    for (int i = 0; i < 20000; ++i) {
        faulty.push_back(std::normal_distribution<double>(6.0, 9.0)(engine));
    }
    const auto whole = roc_curve(healthy, faulty, true, 100000);
    const auto thin = roc_curve(healthy, faulty, true, 51);
    REQUIRE(thin.size() <= 51);
    CHECK(thin.size() > 40);
    CHECK(thin.front().detection_rate == 0.0);
    CHECK(thin.back().false_alarm_rate == 1.0);
    CHECK(thin.back().detection_rate == 1.0);
    CHECK(area_below(thin) == Approx(area_below(whole)).margin(2e-3));
    std::size_t at = 0;
    for (const RocPoint& point : thin) {
        while (at < whole.size() && (whole[at].false_alarm_rate != point.false_alarm_rate ||
                                     whole[at].detection_rate != point.detection_rate)) {
            ++at;
        }
        CHECK(at < whole.size());  // in the same order
    }
}

TEST_CASE("Values that are not finite are left out; with one class only there is no ROC") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(roc_curve(std::vector<double>{nan}, std::vector<double>{1.0}, true).empty());
    CHECK(roc_curve(std::vector<double>{1.0}, std::vector<double>{}, true).empty());
    const auto points =
        roc_curve(std::vector<double>{1.0, nan}, std::vector<double>{1.0, HUGE_VAL}, true);
    REQUIRE(points.size() == 2);  // a constant feature: the diagonal
    CHECK(points[1].detection_rate == 1.0);
}

}  // namespace test_roc
