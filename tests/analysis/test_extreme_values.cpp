// Checks that the analysis of any finite values ends with numbers or with a reason.
#include "analysis/detection/threshold.hpp"
#include "analysis/reliability.hpp"
#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/link.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_extreme_values {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kLargest = std::numeric_limits<double>::max();
const double kLeast = std::numeric_limits<double>::denorm_min();

using Value = std::function<double(double size, double input, double draw)>;

struct Kind {
    const char* name;
    Value value;
};

const std::vector<Kind> kValues{
    {"constant", [](double, double, double) { return 3.0; }},
    {"zero", [](double, double, double) { return 0.0; }},
    {"none", [](double, double, double) { return kNan; }},
    {"few", [](double, double, double draw) { return std::abs(draw) < 1.6 ? kNan : draw; }},
    {"finds all", [](double size, double, double) { return size > 0.0 ? 1.0 : 0.0; }},
    {"size itself", [](double size, double, double) { return size; }},
    {"input itself", [](double, double input, double) { return input; }},
    {"input and rounding", [](double, double in, double draw) { return in + 1e-13 * draw; }},
    {"sudden", [](double size, double, double draw) { return (size > 2e-3) + 1e-9 * draw; }},
    {"backwards", [](double size, double, double draw) { return draw - 1e4 * size; }},
    {"large", [](double, double, double draw) { return draw * 0.2 * kLargest; }},
    {"largest", [](double size, double, double) { return size > 2e-3 ? kLargest : -kLargest; }},
    {"least", [](double, double, double draw) { return std::round(draw) * kLeast; }},
};

const std::vector<Kind> kSizes{
    {"few sizes", [](double, double, double draw) { return 1e-3 * std::round(std::abs(draw)); }},
    {"many sizes", [](double, double, double draw) { return 1e-3 * std::abs(draw); }},
    {"one size", [](double, double, double) { return 1e-3; }},
    {"healthy", [](double, double, double) { return 0.0; }},
    {"alike", [](double, double, double draw) { return 2e-3 * (1.0 + 1e-16 * std::round(draw)); }},
    {"tiny", [](double, double, double draw) { return 1e-300 * std::abs(draw); }},
    {"huge", [](double, double, double draw) { return 1e300 * std::abs(draw); }},
};

const std::vector<Kind> kInputs{
    {"normal", [](double, double, double draw) { return draw; }},
    {"two values", [](double, double, double draw) { return draw > 0.0 ? 1.0 : 2.0; }},
    {"same", [](double, double, double) { return 7.0; }},
    {"large", [](double, double, double draw) { return draw * 1e300; }},
};

// One study: every kind of feature over gearboxes with these sizes.
void assess(const Kind& sizes, std::size_t count, double rate, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<double> healthy_size(count, 0.0), test_size;
    std::vector<std::vector<double>> inputs(kInputs.size());
    for (std::size_t i = 0; i < count; ++i) {
        test_size.push_back(sizes.value(0.0, 0.0, normal(engine)));
        for (std::size_t k = 0; k < kInputs.size(); ++k) {
            inputs[k].push_back(kInputs[k].value(0.0, 0.0, normal(engine)));
        }
    }
    DetectionRequest request;
    request.false_alarm_rate = rate;
    request.noise_levels = {1.0};
    request.groups = {{0.0, 0.0}, {kLeast, 1e-3}, {1e-3, 2e-3}, {2e-3, kLargest}};
    ReliabilityData data;
    data.healthy_size = healthy_size;
    data.test_size = test_size;
    std::vector<std::vector<double>> healthy(kValues.size()), test(kValues.size());
    std::vector<FeatureDetection> detections;
    for (std::size_t f = 0; f < kValues.size(); ++f) {
        for (std::size_t i = 0; i < count; ++i) {
            healthy[f].push_back(kValues[f].value(0.0, normal(engine), normal(engine)));
            test[f].push_back(kValues[f].value(test_size[i], inputs[0][i], normal(engine)));
        }
        data.features.push_back({kValues[f].name, Alarm::high, healthy[f], test[f]});
        detections.push_back(detect(kValues[f].name, Alarm::high, {healthy_size, healthy[f]},
                                    {test_size, test[f]}, request));
    }
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        data.inputs.push_back({kInputs[k].name, "1", inputs[k]});
    }
    CAPTURE(sizes.name, count, rate);
    Reliability found;
    REQUIRE_NOTHROW(found = assess_reliability(data, detections, request, 1));
    for (const FeatureReliability& feature : found.features) {
        const LevelReliability& level = feature.levels.front();
        CAPTURE(feature.feature);
        const bool curve = level.hit_miss.refusal.empty();
        CHECK(level.hit_miss.band.empty() != curve);
        for (const PodPoint& point : level.hit_miss.band) {
            CHECK(point.lower <= point.pod + 1e-9);
            CHECK(point.upper >= point.pod - 1e-9);
        }
        for (const InputEffect& effect : level.inputs.inputs) {
            CHECK((effect.refusal.empty() ? effect.p_value >= 0.0 : std::isnan(effect.p_value)));
        }
    }
}

TEST_CASE("finite values never abort the analysis of a study") {
    unsigned seed = 1;
    for (const Kind& sizes : kSizes) {
        for (const std::size_t count : {2u, 3u, 19u, 20u, 60u, 150u, 400u}) {
            assess(sizes, count, 0.05, ++seed);
        }
        assess(sizes, 150, 0.5, ++seed);
    }
}

TEST_CASE("finite values never abort the analysis of a large sample") {
    assess(kSizes[0], 20000, 0.05, 71);
    assess(kSizes[1], 3000, 0.01, 72);
}

TEST_CASE(
    "Healthy test gearboxes that contradict the threshold end in a refusal, not in an error") {
    std::mt19937_64 engine(5);
    std::normal_distribution<double> normal;
    std::vector<double> healthy_size(1500, 0.0), test_size, constant(1500, 1.0), scattered;
    for (std::size_t i = 0; i < healthy_size.size(); ++i) {
        scattered.push_back(normal(engine));
    }
    std::vector<double> test;  // every gearbox alarms, healthy or not
    for (int i = 0; i < 2000; ++i) {
        test_size.push_back(i % 2 == 0 ? 0.0 : 1e-3 * (1 + i % 5));
        test.push_back(50.0 + normal(engine));
    }
    DetectionRequest request;
    request.noise_levels = {1.0};
    request.groups = {{0.0, 0.0}, {kLeast, kLargest}};
    for (const auto& [healthy, rate] :
         {std::pair{constant, 0.05}, std::pair{scattered, 0.05}, std::pair{scattered, 2e-4}}) {
        request.false_alarm_rate = rate;
        CAPTURE(rate);
        ReliabilityData data;
        data.healthy_size = healthy_size;
        data.test_size = test_size;
        data.features.push_back({"drifted", Alarm::high, healthy, test});
        const std::vector<FeatureDetection> detections{
            detect("drifted", Alarm::high, {healthy_size, healthy}, {test_size, test}, request)};
        CHECK_FALSE(detections[0].levels[0].healthy_rate <= 0.05);  // NaN beyond the sample
        Reliability found;
        REQUIRE_NOTHROW(found = assess_reliability(data, detections, request, 1));
        CHECK_FALSE(found.features[0].levels[0].hit_miss.refusal.empty());
    }
}

TEST_CASE("rates have intervals at any count") {
    for (const long tested : {1L, 2L, 7L, 100L, 3000L, 20000L, 10000000L}) {
        for (const long count : {0L, 1L, 2L, tested / 3, tested / 2, tested - 1, tested}) {
            if (count < 0 || count > tested) {
                continue;
            }
            for (const double confidence : {0.5, 0.95, 0.9999}) {
                CAPTURE(tested, count, confidence);
                const double rate = static_cast<double>(count) / static_cast<double>(tested);
                for (const Interval& bounds :
                     {wilson_interval(count, tested, confidence),
                      clopper_pearson_interval(count, tested, confidence)}) {
                    CHECK(bounds.lower <= rate);
                    CHECK(bounds.upper >= rate);
                }
                for (const double alarm : {1e-4, 0.05, 0.9}) {
                    const Interval rates = threshold_rate_interval(tested, alarm, confidence);
                    CHECK((std::isnan(rates.lower) || rates.lower < rates.upper));
                    const Interval expected =
                        expected_rate_interval(tested, count, tested, confidence);
                    CHECK(expected.lower <= expected.upper);
                }
            }
        }
    }
}

TEST_CASE("tails and quantiles have values at the limits of the number range") {
    CHECK(chi_squared_upper_tail(0.0, 3.0) == 1.0);
    CHECK(chi_squared_upper_tail(kLargest, 3.0) == 0.0);
    CHECK(chi_squared_upper_tail(HUGE_VAL, 3.0) == 0.0);
    CHECK(std::isnan(chi_squared_upper_tail(kNan, 3.0)));
    CHECK(f_upper_tail(HUGE_VAL, 2.0, 30.0) == 0.0);
    CHECK(f_upper_tail(kLargest, 2.0, 30.0) == Approx(0.0).margin(1e-300));
    for (const Link link : {Link::logit, Link::probit}) {
        CHECK(link_quantile(link, kLeast) < -30.0);
        CHECK(link_quantile(link, 1.0 - 1.2e-16) > 8.0);
    }
}

}  // namespace gearpod::analysis::test_extreme_values
