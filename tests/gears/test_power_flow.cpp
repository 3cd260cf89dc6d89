// Checks Park's six working conditions: directions, balanced torques and transmission errors.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gears/power_flow.hpp"

namespace test_power_flow {

using namespace gearpod::gears;

namespace {

const PlanetaryTrain kPark{16, 26, 68, 3};
const PowerFlow kConditions[] = {
    {Member::sun, Member::ring},      // 1
    {Member::sun, Member::carrier},   // 2
    {Member::ring, Member::sun},      // 3
    {Member::ring, Member::carrier},  // 4
    {Member::carrier, Member::sun},   // 5
    {Member::carrier, Member::ring},  // 6
};

double of(const Speeds& s, Member m) {
    return m == Member::sun ? s.sun : m == Member::ring ? s.ring : s.carrier;
}

double of(const CentralMembers& v, Member m) {
    return m == Member::sun ? v.sun : m == Member::ring ? v.ring : v.carrier;
}

}  // namespace

TEST_CASE("Speed decreases or increases, along or against the input, as in Park's Table I") {
    const bool decreases[] = {true, false, true, false, true, false};
    const bool same_direction[] = {true, true, true, true, false, false};
    for (int i = 0; i < 6; ++i) {
        INFO("condition " << i + 1);
        const PowerFlow flow = kConditions[i];
        const Speeds s = signed_speeds(kPark, flow, flow.input, 3.0);
        const double ratio = of(s, output_member(flow)) / of(s, flow.input);
        CHECK(std::abs(of(s, flow.input)) == Approx(3.0));
        // The ring drives the smaller sun with the carrier fixed.
        CHECK((std::abs(ratio) < 1) == decreases[i]);
        CHECK((ratio > 0) == same_direction[i]);
    }
}

TEST_CASE("Power enters at the input, leaves at the output, and none is lost") {
    for (const PowerFlow& flow : kConditions) {
        for (const Member on : {Member::sun, Member::ring, Member::carrier}) {
            const Speeds s = signed_speeds(kPark, flow, output_member(flow), 2.0);
            const CentralMembers t = balanced_torques(kPark, on, 180e3);
            CHECK(std::abs(of(t, on)) == Approx(180e3));
            CHECK(t.sun + t.ring + t.carrier == Approx(0).margin(1e-9));
            CHECK(t.sun > 0);
            const double in = of(s, flow.input) * of(t, flow.input);
            const double out = of(s, output_member(flow)) * of(t, output_member(flow));
            CHECK(in > 0);
            CHECK(in == Approx(-out));
        }
    }
}

TEST_CASE("Transmission errors match those printed for conditions 2, 4 and 6, and their reverses") {
    const double zs = 16, zr = 68;
    const auto weights = [](int condition) {
        return transmission_error_weights(kPark, kConditions[condition - 1]);
    };
    const CentralMembers w2 = weights(2), w4 = weights(4), w6 = weights(6);
    CHECK(w2.ring == 1);
    CHECK(w2.carrier == Approx(-(zr + zs) / zr));
    CHECK(w2.sun == 0);
    CHECK(w4.sun == 1);
    CHECK(w4.carrier == Approx(-(zr + zs) / zs));
    CHECK(w6.sun == 1);
    CHECK(w6.ring == Approx(zr / zs));
    const CentralMembers w1 = weights(1), w3 = weights(3), w5 = weights(5);
    CHECK(w1.carrier == 1);
    CHECK(w1.ring == Approx(-zr / (zr + zs)));
    CHECK(w3.carrier == 1);
    CHECK(w3.sun == Approx(-zs / (zr + zs)));
    CHECK(w5.ring == 1);
    CHECK(w5.sun == Approx(zs / zr));
}

TEST_CASE("Rigid rotation gives no transmission error") {
    for (const PowerFlow& flow : kConditions) {
        const Speeds s = signed_speeds(kPark, flow, flow.input, 5.0);
        const CentralMembers w = transmission_error_weights(kPark, flow);
        CHECK(w.carrier * s.carrier + w.ring * s.ring + w.sun * s.sun == Approx(0).margin(1e-13));
    }
}

TEST_CASE("A train driven by its carrier reverses the rotation of the planets") {
    for (const Member fixed : {Member::ring, Member::sun}) {
        const Member geared = fixed == Member::ring ? Member::sun : Member::ring;
        const Speeds by_gear = signed_speeds(kPark, {fixed, geared}, geared, 1.0);
        const Speeds by_carrier = signed_speeds(kPark, {fixed, Member::carrier}, geared, 1.0);
        CHECK(by_carrier.sun == -by_gear.sun);
        CHECK(by_carrier.planet == -by_gear.planet);
        CHECK(by_carrier.ring == -by_gear.ring);
        CHECK(by_carrier.carrier == -by_gear.carrier);
        CHECK(planet_sense(by_carrier) != planet_sense(by_gear));
    }
}

TEST_CASE(
    "Phases of the mirrored train equal those of its mirrored planets in the opposite sense") {
    // Real train: positive sense, planets at -psi. Mirror image: negative sense, planets at psi.
    PlanetaryTrain mirrored{
        16, 26, 68, 3, {0, 2 * std::numbers::pi * 25 / 84, 2 * std::numbers::pi * 51 / 84}};
    PlanetaryTrain real = mirrored;
    for (double& psi : real.positions_rad)
        psi = -psi;
    for (int n = 0; n < 3; ++n) {
        CHECK(sun_tooth_delay(mirrored, n, PlanetSense::counter_clockwise) ==
              Approx(sun_tooth_delay(real, n, PlanetSense::clockwise)));
        const double ahead = sun_mesh_phase(mirrored, n, PlanetSense::counter_clockwise) -
                             sun_mesh_phase(real, n, PlanetSense::clockwise);
        CHECK(ahead == Approx(std::round(ahead)).margin(1e-12));
        CHECK(ring_tooth_delay(mirrored, n, PlanetSense::counter_clockwise) ==
              Approx(ring_tooth_delay(real, n, PlanetSense::clockwise)));
    }
}

TEST_CASE("A fixed member accepts no speed") {
    CHECK_THROWS_AS(signed_speeds(kPark, {Member::ring, Member::sun}, Member::ring, 1.0),
                    std::invalid_argument);
}

}  // namespace test_power_flow
