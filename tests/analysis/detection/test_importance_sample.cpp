// Checks thresholds from weighted records where the rate beyond every value is known. Gearboxes
// have a normal or an exponential law with normal noise of variance 1, and records are
// exponentially tilted towards alarms by shifts of the noise.
#include "analysis/detection/detection.hpp"
#include "analysis/detection/threshold.hpp"
#include "tests/analysis/detection/gearbox_laws.hpp"

namespace gearpod::analysis::test_importance_sample {

const boost::math::normal kNormal;
struct Records {
    std::vector<double> values, weights;
    std::vector<std::size_t> gearbox;

    Records(double deviation, Law law, int gearboxes, int records, std::mt19937_64& engine,
            double sign = 1.0) {
        std::normal_distribution<double> noise;
        std::exponential_distribution<double> skewed;
        for (int g = 0; g < gearboxes; ++g) {
            const double own =
                deviation * (law == Law::normal ? noise(engine) : skewed(engine) - 1.0);
            for (int r = 0; r < records; ++r) {
                const double z =
                    noise(engine) + kShifts[static_cast<std::size_t>(r) % kShifts.size()];
                values.push_back(sign * (own + z));
                weights.push_back(weight_of(z));
                gearbox.push_back(static_cast<std::size_t>(g));
            }
        }
    }
    ImportanceSample sample(Alarm alarm = Alarm::high) const {
        return {values, weights, gearbox, alarm};
    }
};

struct Coverage {
    double covered = 0.0;  // share of studies whose interval, if there is one, holds the rate
    double median_width = 0.0;
    int refused = 0;
};

Coverage coverage(double deviation, Law law, int gearboxes, int records, double rate, int studies) {
    std::mt19937_64 engine(21);
    Coverage result;
    std::vector<double> widths;
    for (int s = 0; s < studies; ++s) {
        const auto found =
            Records(deviation, law, gearboxes, records, engine).sample().threshold(rate, 0.95);
        if (!found) {
            ++result.refused;
            result.covered += 1.0 / studies;
            continue;
        }
        const double truth = rate_beyond(found->threshold, deviation, law);
        result.covered +=
            found->rate.lower <= truth && truth <= found->rate.upper ? 1.0 / studies : 0.0;
        widths.push_back(found->rate.upper / found->rate.lower);
    }
    std::sort(widths.begin(), widths.end());
    result.median_width = widths.empty() ? kNan : widths[widths.size() / 2];
    return result;
}

TEST_CASE("Thresholds at 1e-2 to 1e-6 from exponentially tilted records match the normal law") {
    std::mt19937_64 engine(1);
    for (const double sign : {1.0, -1.0}) {
        const Alarm alarm = sign > 0.0 ? Alarm::high : Alarm::low;
        const ImportanceSample sample =
            Records(0.2, Law::normal, 200, 64, engine, sign).sample(alarm);
        for (const double rate : {1e-2, 1e-4, 1e-6}) {
            const auto found = sample.threshold(rate, 0.95);
            REQUIRE(found);
            const double truth = sign * quantile(complement(kNormal, rate)) * std::sqrt(1.04);
            INFO(rate << ": " << found->threshold << ", in truth " << truth);
            CHECK(found->threshold == Approx(truth).margin(0.07));
            const Interval bounds = sample.threshold_interval(rate, *found);
            CHECK(bounds.lower < truth);
            CHECK(bounds.upper > truth);
            CHECK(found->rate.lower < rate);
            CHECK(found->rate.upper > rate);
            // The rate beyond a given value, as needed for misses.
            const auto at = sample.at(truth, 0.95);
            REQUIRE(at);
            CHECK(at->rate.lower < rate);
            CHECK(at->rate.upper > rate);
            CHECK(std::sqrt(at->variance) < 0.2);
        }
    }
}

TEST_CASE("Rates from exponentially tilted records are 1 at most") {
    std::mt19937_64 engine(8);
    for (int study = 0; study < 20; ++study) {
        const auto found = Records(0.2, Law::normal, 50, 8, engine).sample().at(-6.0, 0.95);
        REQUIRE(found);
        CHECK(found->expected <= 1.0);
        CHECK(found->expected > 0.8);
        CHECK(found->rate.upper <= 1.0);
        CHECK(found->rate.lower < found->expected);
    }
}

TEST_CASE("Exponentially tilted records agree with counted ones") {
    std::mt19937_64 engine(2);
    constexpr double kRate = 1e-3;
    const auto found = Records(0.3, Law::normal, 300, 32, engine).sample().threshold(kRate, 0.95);
    REQUIRE(found);
    std::normal_distribution<double> noise;
    constexpr int kCounted = 400'000;
    double alarms = 0.0;
    for (int i = 0; i < kCounted; ++i) {
        alarms += 0.3 * noise(engine) + noise(engine) > found->threshold ? 1.0 : 0.0;
    }
    const double counted = alarms / kCounted, error = std::sqrt(kRate / kCounted);
    CHECK(counted > found->rate.lower - 3.0 * error);
    CHECK(counted < found->rate.upper + 3.0 * error);
}

TEST_CASE("Interval coverage of threshold rates from exponentially tilted records") {
    // The standard deviation of a coverage of 0.95 in 100 studies is 0.022.
    const Coverage few = coverage(0.15, Law::normal, 50, 32, 1e-4, 100);
    CHECK(few.covered > 0.95 - 0.06);
    CHECK(few.refused < 20);
    const Coverage many = coverage(0.3, Law::normal, 400, 32, 1e-6, 60);
    CHECK(many.covered > 0.95 - 0.08);
    // Here the alarms come from the gearboxes themselves.
    CHECK(coverage(1.0, Law::normal, 100, 32, 1e-4, 20).refused == 20);
}

TEST_CASE("Interval coverage of threshold rates from exponentially tilted records in 500 studies",
          "[.rare-coverage][tilted-rates]") {
    struct Case {
        double deviation;
        Law law;
        int gearboxes;
        double rate;
    };
    for (const Case& c : {Case{0.0, Law::normal, 50, 1e-6},
                          {0.15, Law::normal, 50, 1e-4},
                          {0.15, Law::normal, 200, 1e-6},
                          {0.3, Law::normal, 200, 1e-4},
                          {0.3, Law::normal, 2000, 1e-4},
                          {0.3, Law::normal, 2000, 1e-6},
                          {0.6, Law::normal, 2000, 1e-4},
                          {0.15, Law::exponential, 2000, 1e-4},
                          {0.15, Law::exponential, 2000, 1e-6},
                          {0.3, Law::exponential, 2000, 1e-4}}) {
        const Coverage found = coverage(c.deviation, c.law, c.gearboxes, 32, c.rate, 500);
        WARN((c.law == Law::normal ? "normal" : "exponential")
             << " gearboxes of deviation " << c.deviation << ", " << c.gearboxes << " of them, "
             << c.rate << ": covered " << found.covered << ", refused " << found.refused
             << ", upper over lower " << found.median_width);
        CHECK(found.covered > (c.law == Law::normal ? 0.93 : 0.88));
    }
}

TEST_CASE("With fewer than 20 gearboxes that alarm, the first records set the threshold") {
    std::mt19937_64 engine(4);
    const Records records(2.0, Law::normal, 300, 8, engine);
    const HealthyThresholds importance_sampled({records.values, records.gearbox, records.weights},
                                               Alarm::high);
    const std::vector<double> first = test::every(8, records.values);
    CHECK(importance_sampled.plain() == first);
    const Threshold threshold = importance_sampled.at(0.01, 0.95);
    CHECK(!threshold.importance_sampled);
    CHECK(threshold.value == SortedSample(first, Alarm::high).threshold(0.01).value);
    CHECK(importance_sampled.rate_bounds(threshold, 0.01, 0.95).upper ==
          threshold_rate_interval(300, 0.01, 0.95).upper);
    CHECK(std::isnan(importance_sampled.at(1e-6, 0.95).value));
}

TEST_CASE("Detection reports which thresholds come from exponentially tilted records") {
    std::mt19937_64 engine(5);
    const Records records(0.1, Law::normal, 100, 16, engine);
    const std::vector<double> none(records.values.size(), 0.0), test(400, 3.0), sizes(400, 1.0);
    DetectionRequest request;
    request.noise_levels = {1.0};
    request.groups = {{1.0, 1.0}};
    request.false_alarm_rate = 1e-5;
    const FeatureDetection found =
        detect_clustered("f", Alarm::high, {none, records.values, records.gearbox, records.weights},
                         records.gearbox, {sizes, test}, request);
    const LevelDetection& level = found.levels[0];
    REQUIRE(level.importance_sampled);
    CHECK(level.importance_sampled->gearboxes == 100);
    CHECK(level.importance_sampled->extrapolation == Approx(1000.0));
    CHECK(level.importance_sampled->contributing > kLeastContributing);
    CHECK(level.threshold == Approx(4.265 * std::sqrt(1.01)).margin(0.1));
    CHECK(level.cells[0].detected == 0);
    CHECK(level.healthy_rate == 1e-5);
    CHECK(!level.tail);
}

TEST_CASE("Plain records of gearboxes give order statistics and no tail beyond them") {
    std::mt19937_64 engine(6);
    std::normal_distribution<double> noise;
    std::vector<double> values;
    std::vector<std::size_t> gearbox;
    for (std::size_t g = 0; g < 500; ++g) {
        for (int r = 0; r < 20; ++r) {
            values.push_back(noise(engine));
            gearbox.push_back(g);
        }
    }
    const HealthyThresholds records({values, gearbox}, Alarm::high);
    const Threshold rare = records.at(1e-3, 0.95);
    CHECK(rare.value == SortedSample(values, Alarm::high).threshold(1e-3).value);
    const Interval bounds = records.value_bounds(rare, 1e-3, 0.95);
    CHECK(bounds.lower < rare.value);
    CHECK(bounds.upper > rare.value);
    CHECK(bounds.lower < quantile(complement(kNormal, 1e-3)));
    CHECK(bounds.upper > quantile(complement(kNormal, 1e-3)));
    CHECK(std::isnan(records.at(5e-5, 0.95).value));
}

}  // namespace gearpod::analysis::test_importance_sample
