// Checks the ROC against a small hand-drawn one and against the area from ranks (auc()).
#include "analysis/ranking/feature_ranking.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "tests/analysis/reference_data.hpp"
#include "tests/numbers.hpp"

namespace gearpod::analysis::test_roc {

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
    return test::mapped(test::normal_values(count, seed, mean, 8.0),
                        [](double value) { return std::round(value); });
}

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

}  // namespace gearpod::analysis::test_roc

namespace gearpod::analysis::test_feature_ranking {

const double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("Holm's adjustment agrees with R's p.adjust") {
    // Reference: R, p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm").
    const std::vector<double> adjusted = holm_adjusted({0.01, 0.04, 0.03, 0.005});
    CHECK(adjusted[0] == Approx(0.03));
    CHECK(adjusted[1] == Approx(0.06));
    CHECK(adjusted[2] == Approx(0.06));
    CHECK(adjusted[3] == Approx(0.02));
    const std::vector<double> missing = holm_adjusted({kNan, 0.6, 0.7});
    CHECK(std::isnan(missing[0]));
    CHECK(missing[1] == 1.0);
    CHECK(holm_adjusted({}).empty());
}

struct Columns {
    std::vector<double> healthy[3], faulty[3];
    std::vector<RankedFeature> features() const {
        return {{"a", Alarm::high, healthy[0], faulty[0]},
                {"b", Alarm::high, healthy[1], faulty[1]},
                {"c", Alarm::high, healthy[2], faulty[2]}};
    }
};

Columns reference() {
    const auto columns = reference_columns("features_40");
    Columns out;
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        for (std::size_t f = 0; f < 3; ++f) {
            (columns[0][i] != 0.0 ? out.faulty[f] : out.healthy[f]).push_back(columns[f + 1][i]);
        }
    }
    return out;
}

TEST_CASE("Features are ranked by area, with pROC's paired tests between them") {
    const Columns columns = reference();
    const FeatureRanking ranking = rank_features(columns.features(), 0.95);
    REQUIRE(ranking.ranks.size() == 3);
    CHECK(ranking.ranks[0].name == "c");
    CHECK(ranking.ranks[1].name == "a");
    CHECK(ranking.ranks[2].name == "b");
    // Reference: reference/reference_R.txt, 0.3702 (b, c), 0.4110 (a, c), 0.9039 (a, b); Holm:
    // times 3, 2, 1.
    CHECK(ranking.ranks[0].p_values[2] == Approx(1.0));
    CHECK(ranking.ranks[1].p_values[2] == Approx(1.0));
    const std::vector<RankedFeature> two{columns.features()[0], columns.features()[1]};
    const FeatureRanking pair = rank_features(two, 0.95);
    CHECK(pair.ranks[0].p_values[1] == Approx(0.9038533449).epsilon(1e-8));
}

TEST_CASE("A clearly better feature is significantly different, a low-alarm copy is not") {
    std::mt19937_64 engine(8);
    std::normal_distribution<double> draw;
    Columns columns;
    for (int i = 0; i < 400; ++i) {
        const double common = draw(engine);
        const double fault = i % 2 == 0 ? 0.0 : 1.5;
        auto& good = i % 2 == 0 ? columns.healthy[0] : columns.faulty[0];
        auto& twin = i % 2 == 0 ? columns.healthy[1] : columns.faulty[1];
        auto& poor = i % 2 == 0 ? columns.healthy[2] : columns.faulty[2];
        good.push_back(common + fault);
        twin.push_back(-std::exp(common + fault));  // same order, other alarm side
        poor.push_back(common + 0.2 * fault);
    }
    auto features = columns.features();
    features[1].alarm = Alarm::low;
    const FeatureRanking ranking = rank_features(features, 0.95);
    CHECK(ranking.ranks[2].name == "c");
    CHECK(ranking.ranks[0].p_values[1] == 1.0);
    CHECK(ranking.ranks[0].p_values[2] < 1e-6);
}

TEST_CASE("Features and samples that cannot be ranked are named with the reason") {
    Columns columns = reference();
    columns.faulty[1].assign(columns.faulty[1].size(), kNan);
    const FeatureRanking without = rank_features(columns.features(), 0.95);
    CHECK(without.ranks.size() == 2);
    REQUIRE(without.left_out.size() == 1);
    CHECK(without.left_out[0] == "b: no value for 20 of 40 gearboxes");
    columns = reference();
    columns.faulty[0][3] = kNan;  // one failed gearbox is left out for all features
    CHECK(rank_features(columns.features(), 0.95).faulty == 19);
    const std::vector<double> none;
    CHECK_THAT(rank_features({{"a", Alarm::high, none, none}}, 0.95).refusal,
               Catch::Contains("two of each are needed"));
    CHECK_THAT(rank_features({}, 0.95).refusal, Catch::Contains("no feature has values"));
    // A constant feature has an area of 1/2 and no interval.
    const std::vector<double> flat(20, 3.0);
    const FeatureRanking constant = rank_features({{"flat", Alarm::high, flat, flat}}, 0.95);
    CHECK(constant.ranks[0].auc.auc == 0.5);
    CHECK(std::isnan(constant.ranks[0].auc.bounds.lower));
}

}  // namespace gearpod::analysis::test_feature_ranking
