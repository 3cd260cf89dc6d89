#include "gears/planetary.hpp"
#include "tests/test.hpp"

namespace gearpod::gears::test_planetary {

constexpr PlanetaryTrain kLiang{19, 31, 81, 4};
constexpr PlanetaryTrain kPark{16, 26, 68, 3};
constexpr PlanetaryTrain kYang{28, 34, 96, 4};
constexpr PlanetaryTrain kYangRig{32, 40, 112, 3};

TEST_CASE("mesh phases of 19/31/81 with four planets are Liang's Table 2.2") {
    const double sun[] = {0, 0.75, 0.5, 0.25};
    const double ring[] = {0, -0.25, -0.5, -0.75};
    for (int n = 0; n < 4; ++n) {
        CHECK(sun_mesh_phase(kLiang, PlanetId{n}) == sun[n]);
        CHECK(ring_mesh_phase(kLiang, PlanetId{n}) == ring[n]);
    }
    CHECK(ring_to_sun_phase(kLiang) == 0);
}

TEST_CASE("Park's phases 68/3 and -16/3 of counter-clockwise planets are 2/3 each") {
    const auto fraction = [](double phase) { return phase - std::floor(phase); };
    constexpr auto kSense = PlanetSense::counter_clockwise;
    CHECK(fraction(ring_mesh_phase(kPark, PlanetId{1}, kSense)) == Approx(2.0 / 3));
    CHECK(fraction(sun_mesh_phase(kPark, PlanetId{1}, kSense)) == Approx(2.0 / 3));
    CHECK(fraction(ring_mesh_phase(kPark, PlanetId{1}, kSense)) == Approx(fraction(68.0 / 3)));
    CHECK(fraction(sun_mesh_phase(kPark, PlanetId{1}, kSense)) == Approx(fraction(-16.0 / 3)));
}

TEST_CASE(
    "Yang's planets are in phase and their ring meshes half a mesh later than their sun meshes") {
    // Source: Yang (2022), Table 3.
    for (int n = 0; n < 4; ++n) {
        CHECK(sun_mesh_phase(kYang, PlanetId{n}) == 0);
        CHECK(ring_mesh_phase(kYang, PlanetId{n}) == 0);
    }
    CHECK(ring_to_sun_phase(kYang) == 0.5);
}

TEST_CASE("the ring-to-sun phase follows from a planet's flanks laid out around its pitch circle") {
    for (int teeth = 12; teeth < 60; ++teeth) {
        // Angles in pitches: trailing flanks at integers, leading ones half a pitch ahead; the
        // sun's pitch point at 0, the ring's half a turn away. Computes the distance until a
        // leading flank reaches it.
        const double wait = teeth / 2.0 - 0.5;
        CHECK(ring_to_sun_phase({19, teeth, 19 + 2 * teeth, 3}) == wait - std::floor(wait));
    }
}

TEST_CASE("Yang's characteristic frequencies follow from the sun's 25 Hz") {
    const Speeds speeds = train_speeds(kYang, Member::ring, Member::sun, 25);
    CHECK(speeds.carrier == Approx(5.65).margin(0.006));
    CHECK(std::abs(speeds.planet) == Approx(10.29).margin(0.006));
    CHECK(mesh_frequency(kYang, speeds) == Approx(541.94).margin(0.006));
    CHECK(speeds.sun - speeds.carrier == Approx(19.35).margin(0.006));
    CHECK(4 * (speeds.sun - speeds.carrier) == Approx(77.42).margin(0.006));
}

TEST_CASE("mesh frequencies are Kahraman's for each fixed member") {
    // Source: Liang (2016), Eq. 2.3.9.
    const double s = 19, r = 81;
    const auto frequency = [](Member fixed, Member given) {
        return mesh_frequency(kLiang, train_speeds(kLiang, fixed, given, 3));
    };
    CHECK(frequency(Member::ring, Member::sun) == Approx(3 * s * r / (s + r)));
    CHECK(frequency(Member::sun, Member::ring) == Approx(3 * s * r / (s + r)));
    CHECK(frequency(Member::carrier, Member::sun) == Approx(3 * s));
    CHECK(frequency(Member::carrier, Member::ring) == Approx(3 * r));
}

TEST_CASE(
    "half a planet turn has 15.5 meshes with the carrier fixed, 12.56 at the same sun speed with "
    "the ring fixed") {
    // Source: Liang (2016), Figs. 2.8 and 2.11.
    const Speeds standing = train_speeds(kLiang, Member::carrier, Member::sun, 1);
    const double half_turn = 0.5 / std::abs(standing.planet);
    CHECK(half_turn * mesh_frequency(kLiang, standing) == Approx(15.5));
    const Speeds turning = train_speeds(kLiang, Member::ring, Member::sun, 1);
    CHECK(half_turn * mesh_frequency(kLiang, turning) == Approx(12.56).margin(0.0051));
}

TEST_CASE("no tooth slips: the pitch line velocities of mating gears are equal") {
    for (const Member fixed : {Member::ring, Member::sun, Member::carrier}) {
        const Member given = fixed == Member::ring ? Member::carrier : Member::ring;
        const Speeds v = train_speeds(kLiang, fixed, given, -7);
        CHECK(19 * (v.sun - v.carrier) == Approx(-31 * (v.planet - v.carrier)));
        CHECK(81 * (v.ring - v.carrier) == Approx(31 * (v.planet - v.carrier)));
        CHECK((given == Member::carrier ? v.carrier : v.ring) == Approx(-7));
    }
    CHECK_THROWS_AS(train_speeds(kLiang, Member::ring, Member::ring, 1), std::invalid_argument);
}

TEST_CASE("one carrier turn meets every tooth of the fixed gear once") {
    CHECK(meshes_per_carrier_turn(kLiang, Member::ring) == 81);
    CHECK(meshes_per_carrier_turn(kLiang, Member::sun) == 19);
    CHECK_FALSE(meshes_per_carrier_turn(kLiang, Member::carrier).has_value());
}

TEST_CASE("the published trains can be assembled, and invalid ones give the reasons") {
    for (const auto& train : {kLiang, kPark, kYang, kYangRig})
        CHECK(assembly_problems(train).empty());
    CHECK(assembly_problems({19, 31, 82, 4}).size() == 2);  // ring, spacing
    // Liang's Table 4.3 has modes for 3 and 5 such planets, which cannot be assembled. The number
    // 100 / 3 is no integer, and axes 50 sin 36 = 29.4 modules apart leave no room for tip circles
    // of 33 modules.
    CHECK(assembly_problems({19, 31, 81, 3}).size() == 1);
    const auto crowded = assembly_problems({19, 31, 81, 5});
    REQUIRE(crowded.size() == 1);
    CHECK(test::contains(crowded[0], "at most 4 planets"));
    CHECK(assembly_problems({0, 31, 81, 4}).size() == 1);
}

}  // namespace gearpod::gears::test_planetary

// Checks planets at given positions: assembly, mesh phases and shared teeth.

namespace gearpod::gears::test_planet_positions {

constexpr double kTurn = 2 * std::numbers::pi;

PlanetaryTrain park_at(std::vector<double> degrees) {
    PlanetaryTrain train{16, 26, 68, static_cast<int>(degrees.size()), {}};
    for (const double position : degrees)
        train.positions_rad.push_back(position * kTurn / 360);
    return train;
}

bool contains(const std::vector<std::string>& problems, const std::string& part) {
    return problems.size() == 1 && problems[0].find(part) != std::string::npos;
}

TEST_CASE("Explicit equal positions give the same phases as default positions") {
    const PlanetaryTrain given = park_at({0, 120, 240});
    const PlanetaryTrain equal{16, 26, 68, 3};
    CHECK(assembly_problems(given).empty());
    for (int n = 0; n < 3; ++n)
        for (const auto sense : {PlanetSense::clockwise, PlanetSense::counter_clockwise}) {
            CHECK(sun_mesh_phase(given, PlanetId{n}, sense) ==
                  Approx(sun_mesh_phase(equal, PlanetId{n}, sense)));
            CHECK(ring_mesh_phase(given, PlanetId{n}, sense) ==
                  Approx(ring_mesh_phase(equal, PlanetId{n}, sense)));
            CHECK(sun_tooth_delay(given, PlanetId{n}, sense) ==
                  Approx(sun_tooth_delay(equal, PlanetId{n}, sense)));
            CHECK(planet_angle(planet_positions(given), PlanetId{n}) == Approx(kTurn * n / 3));
        }
}

TEST_CASE("Planets a quarter turn apart are in phase on 16/26/68") {
    // Park et al. (2016), Eqs. 1 and 5: 16 / 4 and 68 / 4 are integers.
    const PlanetaryTrain train = park_at({0, 90, 270});
    CHECK(assembly_problems(train).empty());
    for (int n = 0; n < 3; ++n) {
        CHECK(sun_mesh_phase(train, PlanetId{n}) == 0);
        CHECK(ring_mesh_phase(train, PlanetId{n}, PlanetSense::counter_clockwise) == 0);
    }
}

TEST_CASE("Phases at any position are Parker and Lin's Z psi / 2 pi") {
    const double places = 84;
    const PlanetaryTrain train = park_at({0, 360 * 25 / places, 360 * 51 / places});
    CHECK(assembly_problems(train).empty());
    const auto fraction = [](double phase) { return phase - std::floor(phase); };
    for (int n = 1; n < 3; ++n) {
        const double psi = train.positions_rad[static_cast<std::size_t>(n)];
        CHECK(fraction(sun_mesh_phase(train, PlanetId{n})) == Approx(fraction(16 * psi / kTurn)));
        CHECK(fraction(ring_mesh_phase(train, PlanetId{n})) == Approx(fraction(-68 * psi / kTurn)));
        // The tooth that left planet 0 arrives after the meshes in between, consistent with the
        // phase.
        CHECK(sun_tooth_delay(train, PlanetId{n}) == Approx(16 * psi / kTurn));
        CHECK(ring_tooth_delay(train, PlanetId{n}) == Approx(68 - 68 * psi / kTurn));
        CHECK(fraction(ring_tooth_delay(train, PlanetId{n})) ==
              Approx(fraction(ring_mesh_phase(train, PlanetId{n}))));
    }
}

TEST_CASE("A planet meshes with sun and ring only at the allowed positions") {
    // A sun tooth and a ring tooth that both point at planet 0 lie on one radius. At the next
    // allowed position teeth of both gears coincide again: 1/84 turn further for one more tooth of
    // either.
    CHECK(assembly_problems(park_at({0, 120.00001, 240})).empty());
    CHECK(contains(assembly_problems(park_at({0, 121, 240})), "120.000000 or 124.285714"));
    CHECK(contains(assembly_problems(park_at({0, 360.0 * 14 / 84, 240})), "planets 1 and 2 touch"));
    // Axes 42 sin 30 = 21 modules apart leave no room for tip circles of 28. This is one problem,
    // not six.
    CHECK(contains(assembly_problems(park_at({0, 60, 120, 180, 240, 300})), "(at most 4 planets)"));
    CHECK(contains(assembly_problems(park_at({0, 240, 120})), "does not follow planet 2"));
    CHECK(assembly_problems(park_at({0, 120, 360})).size() ==
          2);  // not below 360; overlaps planet 1
    CHECK(contains(assembly_problems(park_at({360.0 / 84, 120, 240})), "counted from it"));
    PlanetaryTrain two = park_at({0, 120});
    two.planets = 3;
    CHECK(contains(assembly_problems(two), "2 planet positions are given for 3 planets"));
}

}  // namespace gearpod::gears::test_planet_positions

// Checks Park's six working conditions: directions, balanced torques and transmission errors.

namespace gearpod::gears::test_power_flow {

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
        CHECK(sun_tooth_delay(mirrored, PlanetId{n}, PlanetSense::counter_clockwise) ==
              Approx(sun_tooth_delay(real, PlanetId{n}, PlanetSense::clockwise)));
        const double ahead = sun_mesh_phase(mirrored, PlanetId{n}, PlanetSense::counter_clockwise) -
                             sun_mesh_phase(real, PlanetId{n}, PlanetSense::clockwise);
        CHECK(ahead == Approx(std::round(ahead)).margin(1e-12));
        CHECK(ring_tooth_delay(mirrored, PlanetId{n}, PlanetSense::counter_clockwise) ==
              Approx(ring_tooth_delay(real, PlanetId{n}, PlanetSense::clockwise)));
    }
}

TEST_CASE("A fixed member accepts no speed") {
    CHECK_THROWS_AS(signed_speeds(kPark, {Member::ring, Member::sun}, Member::ring, 1.0),
                    std::invalid_argument);
}

}  // namespace gearpod::gears::test_power_flow
