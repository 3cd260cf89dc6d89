#include "analysis/pod/signal_response_pod.hpp"
#include "analysis/statistics/link.hpp"
#include "tests/analysis/reference_data.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_signal_response_pod {

using Where = SizeEstimate::Where;

std::vector<double> logs(std::vector<double> values) {
    for (double& value : values) {
        value = std::log(value);
    }
    return values;
}

TEST_CASE("Lines and checks agree with statsmodels on the standard's a-hat example") {
    struct Row {
        bool log_size, log_response;
        double intercept, slope, sigma, linearity[2], variance[2], normality[2];
    };
    // Reference: reference/reference_py.txt.
    const Row rows[] = {{false,
                         false,
                         88.7428555,
                         23.79108344,
                         152.5826295,
                         {14.19231722, 0.0002960206939},
                         {1.377663819, 0.240499485},
                         {0.6383147355, 0.09316263149}},
                        {false,
                         true,
                         5.248419383,
                         0.04347123351,
                         0.5295625012,
                         {21.20956632, 1.363987221e-05},
                         {2.522251768, 0.1122501933},
                         {3.986506173, 5.310017882e-10}},
                        {true,
                         false,
                         -960.1338106,
                         535.5248428,
                         149.9190106,
                         {9.27596437, 0.003054348564},
                         {0.1045116203, 0.7464812527},
                         {0.6115025097, 0.1086435576}},
                        {true,
                         true,
                         3.098874297,
                         1.058930639,
                         0.476439357,
                         {1.111504673, 0.294608836},
                         {3.98890609, 0.04580079021},
                         {4.686209623, 1.060484516e-11}}};
    const auto columns = reference_columns("ahat_92");
    for (const Row& row : rows) {
        const auto x = row.log_size ? logs(columns[0]) : columns[0];
        const auto y = row.log_response ? logs(columns[1]) : columns[1];
        const RegressionLine line = regression_line(x, y);
        CHECK(line.intercept == Approx(row.intercept).epsilon(1e-8));
        CHECK(line.slope == Approx(row.slope).epsilon(1e-8));
        CHECK(line.sigma == Approx(row.sigma).epsilon(1e-8));
        const auto agrees = [](const CheckResult& check, const double(&expected)[2]) {
            INFO(check.test);
            CHECK(check.statistic == Approx(expected[0]).epsilon(1e-7));
            CHECK(check.p_value == Approx(expected[1]).epsilon(1e-6));
        };
        agrees(linearity_check(x, y, line), row.linearity);
        agrees(constant_variance_check(x, y, line), row.variance);
        agrees(normality_check(x, y, line), row.normality);
    }
}

TEST_CASE("A POD from a line with normal scatter agrees with statsmodels and the delta method") {
    const auto columns = reference_columns("line_60");
    const SignalResponsePod pod =
        signal_response_pod(columns[0], columns[1], {2.0, Alarm::high, 0.95});
    CHECK(pod.refusal == "");
    REQUIRE(pod.candidates.size() == 4);
    const SignalResponseFit& fit = pod.candidates[pod.chosen];
    CHECK((fit.scale.log_size && fit.scale.power == 0.0));
    // Reference: reference/reference_py.txt.
    CHECK(pod.a50.lower.size == Approx(1.201482904).epsilon(1e-6));
    CHECK(pod.a50.estimate.size == Approx(1.316336108).epsilon(1e-6));
    CHECK(pod.a50.upper.size == Approx(1.420518259).epsilon(1e-6));
    CHECK(pod.a90.lower.size == Approx(1.673116691).epsilon(1e-6));
    CHECK(pod.a90.estimate.size == Approx(1.799548883).epsilon(1e-6));
    CHECK(pod.a90.upper.size == Approx(1.952244324).epsilon(1e-6));
}

TEST_CASE("A low alarm on the reciprocal gives the same detector") {
    const auto columns = reference_columns("line_60");
    std::vector<double> reciprocal =
        test::mapped(columns[1], [&](const double value) { return 1.0 / value; });
    const auto high = signal_response_pod(columns[0], columns[1], {2.0, Alarm::high, 0.95});
    const auto low = signal_response_pod(columns[0], reciprocal, {0.5, Alarm::low, 0.95});
    REQUIRE(low.refusal == "");
    CHECK(low.a90.upper.size == Approx(high.a90.upper.size));
    CHECK(low.band[10].lower == Approx(high.band[10].lower));
}

TEST_CASE("Responses that break an assumption are refused, each with its reason") {
    std::vector<double> size, curved, spreading, skewed;
    for (int i = 0; i < 300; ++i) {
        const double a = 1.0 + i / 100.0;
        // Normal scores in a fixed shuffled order.
        const double share = std::fmod(0.5 + i * 0.6180339887498949, 1.0);
        const double z = link_quantile(Link::probit, share);
        size.push_back(a);
        curved.push_back(10.0 + std::pow(a - 1.5, 2) + 0.1 * z);
        spreading.push_back(20.0 + a + 0.3 * a * a * z);
        skewed.push_back(20.0 + a - std::log(share));
    }
    const auto reasons = [&](const std::vector<double>& values) {
        const auto pod = signal_response_pod(size, values, {21.0, Alarm::high, 0.95});
        CHECK(pod.a90.estimate.where == Where::not_reached);
        return pod.refusal;
    };
    CHECK_THAT(reasons(curved), Catch::Contains("not linear (quadratic term (F): p ="));
    CHECK_THAT(reasons(spreading), Catch::Contains("variance not constant (Breusch-Pagan"));
    CHECK_THAT(reasons(skewed), Catch::Contains("residuals not normal (Anderson-Darling"));
}

TEST_CASE("Responses without scatter, sizes or values are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> size, constant, none;
    for (int i = 0; i < 40; ++i) {
        size.push_back(1.0 + i % 4);
        constant.push_back(3.0);
        none.push_back(nan);
    }
    const auto refusal = [](const std::vector<double>& a, const std::vector<double>& y, double t) {
        return signal_response_pod(a, y, {t, Alarm::high, 0.95}).refusal;
    };
    CHECK_THAT(refusal(size, constant, 2.0), Catch::Contains("the values have no scatter"));
    CHECK_THAT(refusal(size, none, 2.0), Catch::Contains("0 faulty gearboxes with a value"));
    CHECK(refusal(size, constant, nan) == "no threshold");
    const std::vector<double> one_size(40, 1.0);
    CHECK_THAT(refusal(one_size, constant, 2.0), Catch::Contains("linearity check needs three"));
}

}  // namespace gearpod::analysis::test_signal_response_pod
