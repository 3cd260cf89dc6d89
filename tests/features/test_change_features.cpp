// Checks features of the change since the baseline record against closed forms. Their numpy
// counterparts: tests/features/reference.
#include "features/feature.hpp"
#include "tests/numbers.hpp"

namespace gearpod::features::test_change_features {

std::vector<double> cosine(int cycles, int points, double amplitude, double mean) {
    return test::tabulated(points, [&](int i) {
        return mean + amplitude * std::cos(2.0 * std::numbers::pi * cycles * i / points);
    });
}

double value(const char* name, const std::vector<double>& record,
             const std::vector<double>& baseline) {
    const std::vector<double> since = test::difference(record, baseline);
    FeatureInput input, change;
    input.change = &change;
    input.get<SensorTurn>().turn = record;
    change.get<SensorTurn>().turn = since;
    return find_feature(name)->value(input);
}

TEST_CASE("The correlation with the baseline is the cosine of the angle between both") {
    const auto baseline = cosine(3, 240, 2.0, 5.0);
    // Two orthogonal tones of amplitudes 3 and 4: 3/5 of the record lies along the baseline.
    auto record = cosine(3, 240, 3.0, -1.0);
    const auto other = cosine(7, 240, 4.0, 0.0);
    for (std::size_t i = 0; i < record.size(); ++i) {
        record[i] += other[i];
    }
    CHECK(value("baseline_correlation", record, baseline) == Approx(0.6).epsilon(1e-12));
    // It does not depend on the level of either.
    for (double& one : record) {
        one = 40.0 * one + 8.0;
    }
    CHECK(value("baseline_correlation", record, baseline) == Approx(0.6).epsilon(1e-12));
    CHECK(std::isnan(value("baseline_correlation", record, std::vector<double>(240, 1.0))));
}

TEST_CASE("A change of one sample in n has a kurtosis near n, and a tone 3/2") {
    const auto baseline = cosine(3, 1000, 2.0, 5.0);
    auto record = baseline;
    record[400] += 1.0;
    const double p = 1e-3, q = 1.0 - p;
    CHECK(value("change_kurtosis", record, baseline) ==
          Approx((p * q * q * q * q + q * p * p * p * p) / (p * q * p * q)).epsilon(1e-9));
    CHECK(value("change_crest_factor", record, baseline) == Approx(q / std::sqrt(p * q)));
    CHECK(value("change_kurtosis", cosine(3, 1000, 7.0, 1.0), baseline) == Approx(1.5));
    CHECK(value("change_crest_factor", cosine(3, 1000, 7.0, 1.0), baseline) ==
          Approx(std::numbers::sqrt2));
}

TEST_CASE("The correlation needs the turns of the record and of its change") {
    const Feature& correlation = *find_feature("baseline_correlation");
    CHECK(correlation.baseline_use == BaselineUse::record_and_change);
    CHECK(correlation.alarm == AlarmSide::low);
    CHECK(correlation.from_sensor);
    CHECK(correlation.needs.has<SensorTurn>());
    CHECK(!correlation.basic());
}

}  // namespace gearpod::features::test_change_features
