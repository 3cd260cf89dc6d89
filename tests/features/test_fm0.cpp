// Checks FM0 of known mesh lines.
#include "features/feature.hpp"
#include "features/vibration_statistics.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "tests/test.hpp"

namespace gearpod::features::test_fm0 {

constexpr int kTeeth = 31, kPerMesh = 16, kPoints = kTeeth * kPerMesh;

// Averaged turn x(angle), angle from 0 to 2 pi, with the parts that features use.
struct Turn {
    template <class Function>
    explicit Turn(const Function& x) {
        for (int i = 0; i < kPoints; ++i) {
            samples.push_back(x(2.0 * std::numbers::pi * i / kPoints));
        }
        parts.load(samples);
        sensor.turn = samples;
        sensor.amplitude = parts.amplitude();
        sensor.mesh_order = kTeeth;
    }
    std::vector<double> samples;
    signals::MeshSeparation parts{kPoints, kTeeth};
    SensorTurn sensor;
};

TEST_CASE("FM0 of one mesh line is 2, and a shock of 3 amplitudes at its peak adds 3") {
    const auto mesh = [](double t) { return 0.4 * std::cos(kTeeth * t); };
    CHECK(fm0(Turn(mesh).sensor) == Approx(2.0));
    // The shock raises every mesh line by up to 2/n of itself.
    const Turn shock([&](double t) { return mesh(t) + (t == 0.0 ? 1.2 : 0.0); });
    const double lines = 0.4 + 7.0 * 2.0 / kPoints * 1.2;
    CHECK(fm0(shock.sensor) == Approx(2.0 / lines));
}

TEST_CASE("Signals without mesh lines have no FM0") {
    const Turn other([](double t) { return 7.0 + std::cos(5.0 * t); });
    const Turn zero([](double) { return 0.0; });
    for (const SensorTurn* turn : {&other.sensor, &zero.sensor}) {
        CHECK(std::isnan(fm0(*turn)));
    }
    CHECK(find_feature("fm0")->from_sensor);
    CHECK(!find_feature("fm0")->basic());
}

}  // namespace gearpod::features::test_fm0
