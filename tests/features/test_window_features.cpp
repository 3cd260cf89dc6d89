#include "features/statistics/signal_statistics.hpp"
#include "features/tooth_windows.hpp"
#include "features/vibration_statistics.hpp"
#include "tests/test.hpp"

namespace gearpod::features::test_window_features {

ToothRms<gears::Member::planet> teeth(const std::vector<double>& rms) {
    return {rms};
}

TEST_CASE("The median is the middle value, or the mean of the middle two") {
    CHECK(median({3.0, 1.0, 2.0}) == 2.0);
    CHECK(median({4.0, 1.0, 3.0, 2.0}) == 2.5);
    CHECK(median({7.0}) == 7.0);
    CHECK(std::isnan(median({})));
}

TEST_CASE("The window ratio of Liang's tooth RMS values of Fig. 5.8 is 76/39") {
    std::vector<double> rms(31, 39.0);
    rms[8] = 76.0;
    CHECK(window_ratio(teeth(rms)) == Approx(76.0 / 39.0));
    CHECK(window_ratio(teeth(std::vector<double>(31, 39.0))) == 1.0);
}

TEST_CASE("The window score compares the worst tooth with the spread of the others") {
    // The others are 1..5: median 3, absolute deviations 2 1 0 1 2, MAD 1.
    CHECK(window_z(teeth({1.0, 2.0, 10.0, 3.0, 4.0, 5.0})) == Approx(7.0 / 1.4826));
    // The worst tooth does not enter the spread, however large it is.
    CHECK(window_z(teeth({1.0, 2.0, 1e6, 3.0, 4.0, 5.0})) == Approx((1e6 - 3.0) / 1.4826));
}

TEST_CASE("The window score of normal teeth is in standard deviations") {
    std::mt19937_64 engine(12);
    std::normal_distribution<double> normal(100.0, 2.0);
    std::vector<double> rms(100000);
    for (double& value : rms) {
        value = normal(engine);
    }
    rms[77] = 120.0;
    CHECK(window_z(teeth(rms)) == Approx(10.0).epsilon(0.02));
}

TEST_CASE("Teeth equal to the last bit give a finite score") {
    CHECK(window_z(teeth(std::vector<double>(31, 39.0))) == 0.0);
    std::vector<double> rms(31, 39.0);
    rms[3] = 39.0 * (1.0 + 1e-15);
    CHECK(window_z(teeth(rms)) < 1e-8);
    rms[3] = 39.0 * 1.5;
    CHECK(window_z(teeth(rms)) == Approx(0.5e6 / 1.4826));
    CHECK(std::isnan(window_z(teeth({}))));
    CHECK(std::isnan(window_ratio(teeth({}))));
}

TEST_CASE("The sensor's rms is the root of its mean square") {
    CHECK(sensor_rms({6.25}) == 2.5);
}

}  // namespace gearpod::features::test_window_features
