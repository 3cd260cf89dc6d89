// Checks detection that is predicted from pairs against that of whole ensembles.
#include <cmath>
#include <random>

#include "analysis/comparison/predicted_detection.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis::test_predicted_detection {

constexpr int kHealthy = 96, kEach = 64, kSizes = 5;

// Values of gearboxes, and those of the same gearboxes with another assumption: their excess over 1
// is `factor` times as large, with scatter of its own.
struct Ensembles {
    std::vector<double> healthy, test, sizes, changed_healthy, changed_test;

    Ensembles(std::uint64_t seed, double factor) {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> unit;
        const auto add = [&](double size, std::vector<double>& own, std::vector<double>& changed) {
            const double excess = std::exp(-1.5 + 0.9 * size + 0.4 * unit(engine));
            own.push_back(1.0 + excess);
            changed.push_back(1.0 + std::pow(factor, size > 0.0 ? 1.0 : 0.0) * excess *
                                        std::exp(0.15 * unit(engine)));
        };
        for (int i = 0; i < kHealthy; ++i) {
            add(0.0, healthy, changed_healthy);
        }
        for (int i = 0; i < kEach * kSizes; ++i) {
            sizes.push_back(0.5 * (1 + i % kSizes));
            add(sizes.back(), test, changed_test);
        }
    }

    FeatureValues own() const { return {Alarm::high, healthy, {}, sizes, test}; }
    FeatureValues changed() const {
        return {Alarm::high, changed_healthy, {}, sizes, changed_test};
    }
    std::vector<ValuePair> pairs(int count) const {
        std::vector<ValuePair> all;
        for (int i = 0; i < count; ++i) {
            const auto row = static_cast<std::size_t>(i);
            all.push_back({0.0, healthy[row], changed_healthy[row]});
            all.push_back({sizes[row], test[row], changed_test[row]});
        }
        return all;
    }
};

DetectionRequest request() {
    DetectionRequest request;
    request.noise_levels = {1.0};
    for (int i = 1; i <= kSizes; ++i) {
        request.groups.push_back({0.5 * i, 0.5 * i});
    }
    return request;
}

TEST_CASE("Predicted detection holds that of the whole ensemble in its interval") {
    for (const double factor : {0.5, 1.0, 2.0}) {
        int sizes_inside = 0, rates_inside = 0;
        constexpr int kEnsembles = 60;
        for (int seed = 0; seed < kEnsembles; ++seed) {
            const Ensembles ensembles(static_cast<std::uint64_t>(seed), factor);
            const PredictedDetection truth = detection_as_is(ensembles.changed(), request()),
                                     found = predicted_detection(ensembles.own(),
                                                                 ensembles.pairs(12), request(), 2);
            sizes_inside += found.size_low <= truth.size && truth.size <= found.size_high ? 1 : 0;
            rates_inside += found.pd_low <= truth.pd && truth.pd <= found.pd_high ? 1 : 0;
        }
        CAPTURE(factor);
        CHECK(sizes_inside >= 52);  // 95 % of 60 are 57; 51 or fewer have a probability of 2e-2 %
        CHECK(rates_inside >= 52);
    }
}

TEST_CASE("A change that halves the excess of faulty gearboxes raises the size found") {
    const Ensembles halved(1, 0.5), doubled(1, 2.0);
    const PredictedDetection as_is = detection_as_is(halved.own(), request()),
                             half =
                                 predicted_detection(halved.own(), halved.pairs(16), request(), 1),
                             twice = predicted_detection(doubled.own(), doubled.pairs(16),
                                                         request(), 1);
    CHECK(half.size > as_is.size);
    CHECK(twice.size < as_is.size);
    CHECK(half.pd <= as_is.pd);
    CHECK(as_is.size_low == as_is.size_high);
    // The same bits with any number of threads.
    CHECK(predicted_detection(halved.own(), halved.pairs(16), request(), 3).size_low ==
          half.size_low);
}

TEST_CASE("Too few pairs predict nothing") {
    const Ensembles ensembles(1, 0.5);
    CHECK(std::isnan(predicted_detection(ensembles.own(), ensembles.pairs(3), request(), 1).pd));
    std::vector<ValuePair> failed = ensembles.pairs(12);
    for (ValuePair& pair : failed) {
        pair.changed = kNan;
    }
    CHECK(std::isnan(predicted_detection(ensembles.own(), failed, request(), 1).size));
}

}  // namespace gearpod::analysis::test_predicted_detection
