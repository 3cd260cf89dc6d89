// Checks the peak of the kurtogram of a record against closed forms of modulated noise.
#include "features/feature.hpp"
#include "features/kurtogram_peak.hpp"
#include "tests/test.hpp"

namespace gearpod::features::test_kurtogram_peak {

constexpr std::size_t kTeeth = 31, kTurns = 80;

// White noise times 1 + depth cos(2 pi cycles t), t in planet turns.
struct Record {
    Record(std::size_t per_mesh, double depth, double cycles) : turn(kTeeth * per_mesh, 0.0) {
        std::mt19937_64 engine(7);
        std::normal_distribution<double> normal(0.0, 2.0);
        const std::size_t points = kTeeth * per_mesh;
        for (std::size_t i = 0; i < kTurns * points; ++i) {
            const double t = static_cast<double>(i) / static_cast<double>(points);
            samples.push_back(normal(engine) *
                              (1.0 + depth * std::cos(2.0 * std::numbers::pi * cycles * t)));
        }
    }
    double kurtosis() const { return kurtogram_peak({samples}, average()); }
    SensorTurn average() const {
        SensorTurn sensor;
        sensor.turn = turn;
        sensor.mesh_order = kTeeth;
        return sensor;
    }
    std::vector<double> turn, samples;
};

TEST_CASE(
    "The kurtogram of noise peaks at 0, that of modulated noise at the modulation's kurtosis") {
    // The largest of 24 bands of 2480 orders and more scatters by some 2 / sqrt(2480) = 0.04.
    CHECK(Record(16, 0.0, 1.0).kurtosis() == Approx(0.08).margin(0.08));
    // With g = 1 + m cos, <|b|^4> = 2 <g^4> P^2 and <|b|^2> = <g^2> P.
    constexpr double kDepth = 0.8, kPower = kDepth * kDepth;
    const double expected =
        2.0 * (1.0 + 3.0 * kPower + 0.375 * kPower * kPower) / std::pow(1.0 + 0.5 * kPower, 2) -
        2.0;
    CHECK(Record(2, kDepth, 1.0).kurtosis() == Approx(expected).margin(0.25));
}

TEST_CASE("A record without a signal has no kurtogram") {
    Record record(8, 0.5, 1.0);
    record.samples.assign(record.samples.size(), 0.0);
    CHECK(std::isnan(record.kurtosis()));
    for (const char* name : {"kurtogram_peak", "whitened_window_ratio"}) {
        CHECK(find_feature(name)->from_sensor);
        CHECK(!find_feature(name)->basic());
    }
}

}  // namespace gearpod::features::test_kurtogram_peak
