// Checks the path from a bearing to the sensor against the rotated vector of its acceleration, and
// the response to its force against the modal equation.
#include "signals/path/frequency_response.hpp"
#include "signals/sensor/sensor_signal.hpp"
#include "tests/signals/random_tile.hpp"
#include "tests/test.hpp"

namespace gearpod::signals::test_bearing_path {

constexpr int kPlanets = 3, kPhases = 4, kLanes = 4;
constexpr SpanLayout kSpan{.planet_teeth = 7, .ring_teeth = 5, .carrier_meshes = 5};
constexpr double kPi = std::numbers::pi;

// Tile whose last two sources are bearings.
RandomTile with_bearings() {
    return {kLanes, kPlanets + 2, kPhases, 1};
}

PathGrid path_of(int source, CarrierSense sense, const SensorPosition& sensor) {
    return {BearingSource{source}, kPhases, kSpan, sense, sensor};
}

TileSignals views_of(const RandomTile& tile) {
    TileSignals views = tile.signals;
    views.planets = kPlanets;
    views.further_sources = 2;
    return views;
}

TEST_CASE("A bearing's acceleration reaches the sensor as the component of a turning vector") {
    const RandomTile tile = with_bearings();
    const TileSignals views = views_of(tile);
    for (const CarrierSense sense : {CarrierSense::positive, CarrierSense::negative}) {
        for (const SensorPosition& sensor :
             {SensorPosition{}, SensorPosition{.angle_deg = 72, .gain = 0.5},
              SensorPosition{.angle_deg = 18, .tangential = true}}) {
            const PathGrid path = path_of(kPlanets + 1, sense, sensor);
            const int lane = 2;
            const auto signal =
                synthesize(views, LaneId{lane}, {0}, kSpan, path, 0.0, 0, kSpan.meshes());
            for (int i = 0; i < static_cast<int>(signal.size()); ++i) {
                const double turn = 2.0 * kPi * i / (kPhases * kSpan.carrier_meshes);
                const double angle = (sense == CarrierSense::negative ? -turn : turn) -
                                     sensor.angle_deg * kPi / 180.0;
                const auto at = [&](int axis) {
                    const int row = i % kPhases * 2 * (kPlanets + 2);
                    return tile.accel[0][static_cast<std::size_t>(
                        (row + 2 * (kPlanets + 1) + axis) * kLanes + lane)];
                };
                const double expected = sensor.tangential
                                            ? std::cos(angle) * at(0) - std::sin(angle) * at(1)
                                            : std::sin(angle) * at(0) + std::cos(angle) * at(1);
                REQUIRE(signal[static_cast<std::size_t>(i)] ==
                        Approx(sensor.gain * expected).margin(1e-12));
            }
        }
    }
}

TEST_CASE("Paths of planets and bearings read their own sources, with the bits of all ways") {
    const RandomTile tile = with_bearings();
    const TileSignals views = views_of(tile);
    const std::vector<double> exponents(kLanes, 0.0);
    const gearpod::machine::AlignedVector& all = tile.accel[0];
    // The planets alone, as a study without bearings records them.
    gearpod::machine::AlignedVector planets;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i / kLanes % (2 * (kPlanets + 2)) < 2 * kPlanets) {
            planets.push_back(all[i]);
        }
    }
    TileSignals alone{kLanes, kPlanets, kPhases, {planets.data()}, {tile.te[0].data()}};
    const PathGrid window(path_window("hamming"), kPlanets, kPhases, kSpan);
    CHECK(synthesize(views, {0}, kSpan, window, exponents, 0, kSpan.meshes()) ==
          synthesize(alone, {0}, kSpan, window, exponents, 0, kSpan.meshes()));
    const PathGrid sun = path_of(kPlanets, CarrierSense::positive, {});
    for (const PathGrid* path : {&window, &sun}) {
        SensorResponse response(*path, kSpan,
                                {.lanes = kLanes,
                                 .exponents = exponents,
                                 .te_phases = 1,
                                 .signal_meshes = kSpan.meshes(),
                                 .kept_meshes = kSpan.meshes(),
                                 .sources = kPlanets + 2});
        for (int k = 0; k < kSpan.meshes(); ++k) {
            response.record_mesh(k, all.data(), tile.te[0].data());
        }
        CHECK(response.signals(kLanes, kSpan.meshes()) ==
              synthesize(views, {0}, kSpan, *path, exponents, 0, kSpan.meshes()));
    }
    CHECK_THROWS(SensorResponse(path_of(kPlanets + 2, CarrierSense::positive, {}), kSpan,
                                {.lanes = kLanes,
                                 .exponents = exponents,
                                 .te_phases = 1,
                                 .signal_meshes = kSpan.meshes(),
                                 .sources = kPlanets + 2}));
    CHECK_THROWS(synthesize(alone, {0}, kSpan, sun, exponents, 0, 1));
}

// m q'' + c q' + k q = F at one frequency, by its complex amplitudes.
TEST_CASE("A mode responds to the force of a bearing by its equation of motion") {
    constexpr double kMass = 12.0, kNatural_Hz = 90.0, kDamping = 0.04;
    const BearingSupport support{3e7, 2e4};
    const double natural = 2.0 * kPi * kNatural_Hz;
    for (const double f_Hz : {5.0, 60.0, 90.0, 300.0}) {
        INFO(f_Hz);
        const double w = 2.0 * kPi * f_Hz, amplitude = 0.7;  // of the shaft's acceleration
        const std::complex<double> displacement = amplitude / (-w * w);
        const auto force =
            displacement * std::complex(support.stiffness_N_m, w * support.damping_N_s_m);
        const auto motion =
            force / kMass / std::complex(natural * natural - w * w, 2.0 * kDamping * natural * w);
        const HousingResponse modes{.stiff_path = false,
                                    .modes = {{kNatural_Hz, kDamping, 1.0 / kMass}},
                                    .measured = {},
                                    .bearing = support};
        CHECK(std::abs(amplitude * modes.at(f_Hz) + w * w * motion) < 1e-12 * std::abs(force));
        const HousingResponse measured{
            .stiff_path = false,
            .modes = {},
            .measured = MeasuredResponse{{f_Hz, 400.0}, {-w * w * motion / force, 0.0}},
            .bearing = support};
        CHECK(std::abs(measured.at(f_Hz) - modes.at(f_Hz)) < 1e-12 * std::abs(modes.at(f_Hz)));
        CHECK(modes.at(0.0) == 0.0);
    }
}

}  // namespace gearpod::signals::test_bearing_path
