// Checks which pair a faulty tooth meets and when, from the gears' rotation angles.
#include "gears/planetary.hpp"
#include "lockstep/plan/fault_schedule.hpp"
#include "stiffness/square_wave_mesh.hpp"
#include "tests/numbers.hpp"

namespace gearpod::lockstep::test_fault_pattern {

const stiffness::SquareWaveMesh kSunMesh(1e9, 2e9, 1.6, 0.7), kRingMesh(2e9, 3e9, 1.9, 0.9);

// Pairs of a train with planets at these parts of a turn; phases from Parker and Lin's formulas.
struct Train {
    Train(int sun_teeth, int planet_teeth, int ring_teeth, PlanetPositions planets, bool reversed)
        : sun(sun_teeth), planet(planet_teeth), ring(ring_teeth), turns(std::move(planets)) {
        pairs.reversed = reversed;
        const double sense = reversed ? -1 : 1;
        for (const double psi : turns.position)
            add(sense * sun * psi, kSunMesh);
        const double offset = gears::ring_to_sun_phase({sun, planet, ring, turns.planets()});
        for (const double psi : turns.position)
            add(-sense * ring * psi + offset, kRingMesh);
    }

    void add(double pitch_phase, const stiffness::SquareWaveMesh& mesh) {
        const double since =
            pairs.reversed ? mesh.contact_ratio() - mesh.pitch_position() : mesh.pitch_position();
        pairs.mesh.push_back(&mesh);
        pairs.start.push_back(phase_in_period(pitch_phase - since));
    }

    int sun, planet, ring;
    PlanetPositions turns;
    PairSet pairs;
};

PlanetPositions equal_planets(int planets) {
    return {test::tabulated(planets, [&](int n) { return static_cast<double>(n) / planets; })};
}

// Trains with equally spaced planets, and with planets at positions where (Z_s + Z_r) psi / 2 pi is
// an integer.
std::vector<Train> trains() {
    std::vector<Train> all;
    for (const bool reversed : {false, true}) {
        all.emplace_back(19, 31, 81, equal_planets(4), reversed);
        all.emplace_back(16, 26, 68, equal_planets(3), reversed);
        all.emplace_back(19, 31, 81, PlanetPositions{{0, 0.26, 0.49, 0.77}}, reversed);
    }
    return all;
}

double to_whole(double x) {
    return std::abs(x - std::round(x));
}

TEST_CASE(
    "a sun or ring tooth meets each planet after the corresponding rotation relative to the "
    "carrier") {
    for (const Train& train : trains()) {
        const int n = train.turns.planets();
        for (const bool on_sun : {true, false}) {
            const FaultPattern pattern =
                on_sun ? sun_fault_pattern(train.pairs, train.turns, train.sun)
                       : ring_fault_pattern(train.pairs, train.turns, train.ring);
            const int teeth = on_sun ? train.sun : train.ring;
            REQUIRE(pattern.length == teeth);
            REQUIRE(pattern.passages.size() == static_cast<std::size_t>(n));
            // The sun passes the planets in the order of their positions, the ring in reverse
            // order.
            const double sense = on_sun != train.pairs.reversed ? 1 : -1;
            std::vector<bool> met(static_cast<std::size_t>(n));
            double before = -1;
            for (const FaultPassage& passage : pattern.passages) {
                const int planet = passage.pair - (on_sun ? 0 : n);
                REQUIRE((planet >= 0 && planet < n));
                met[static_cast<std::size_t>(planet)] = true;
                const int first = on_sun ? 0 : n;
                const double turned =
                    (passage.start - train.pairs.start[static_cast<std::size_t>(first)]) / teeth;
                const double apart = train.turns.position[static_cast<std::size_t>(planet)];
                CHECK(to_whole(turned - sense * apart) < 1e-12);
                CHECK(to_whole(passage.start -
                               train.pairs.start[static_cast<std::size_t>(passage.pair)]) < 1e-12);
                CHECK(passage.start > before);
                CHECK(passage.start < teeth + 1);
                CHECK(passage.curve == 0);
                before = passage.start;
            }
            CHECK(std::count(met.begin(), met.end(), true) == n);
        }
    }
}

TEST_CASE("equally spaced planets meet a sun tooth every Z_s / N meshes, in their order") {
    const Train train(20, 30, 80, equal_planets(4), false);
    const FaultPattern pattern = sun_fault_pattern(train.pairs, train.turns, 20);
    for (int i = 0; i < 4; ++i) {
        CHECK(pattern.passages[static_cast<std::size_t>(i)].pair == i);
        CHECK(pattern.passages[static_cast<std::size_t>(i)].start - pattern.passages[0].start ==
              Approx(5 * i).margin(1e-12));
    }
    const Train back(20, 30, 80, equal_planets(4), true);
    CHECK(sun_fault_pattern(back.pairs, back.turns, 20).passages[1].pair == 3);
    CHECK(ring_fault_pattern(train.pairs, train.turns, 80).passages[1].pair == 4 + 3);
}

TEST_CASE("a planet tooth meets sun and ring half a planet turn apart") {
    for (const Train& train : trains()) {
        for (int planet = 0; planet < train.turns.planets(); ++planet) {
            const FaultPattern pattern =
                planet_fault_pattern(train.pairs, PlanetId{planet}, PlanetSide::both, train.planet);
            REQUIRE(pattern.length == train.planet);
            REQUIRE(pattern.passages.size() == 2);
            const bool sun_first = pattern.passages[0].curve == 0;
            const FaultPassage& sun = pattern.passages[sun_first ? 0 : 1];
            const FaultPassage& ring = pattern.passages[sun_first ? 1 : 0];
            CHECK(sun.pair == planet);
            CHECK(ring.pair == train.turns.planets() + planet);
            CHECK(ring.curve == 1);
            // Distance between pitch points: the middle of the tooth makes half a turn, and the two
            // flanks are half a tooth pitch apart.
            const auto pitch = [&](const FaultPassage& p) {
                const auto pair = static_cast<std::size_t>(p.pair);
                return p.start + train.pairs.pitch_phase(p.pair) - train.pairs.start[pair];
            };
            const double apart = pitch(ring) - pitch(sun);
            const double turn = apart / train.planet - std::floor(apart / train.planet);
            const double flanks = train.pairs.reversed ? 0.5 : -0.5;
            CHECK(turn * train.planet == Approx(train.planet / 2.0 + flanks).margin(1e-9));
        }
    }
}

TEST_CASE("a planet tooth meets one side, and a shaft's gear its mate, once a turn") {
    const Train train(19, 31, 81, equal_planets(4), false);
    const FaultPattern ring = planet_fault_pattern(train.pairs, PlanetId{2}, PlanetSide::ring, 31);
    CHECK(ring.length == 31);
    REQUIRE(ring.passages.size() == 1);
    CHECK(ring.passages[0].pair == 6);
    CHECK(ring.passages[0].curve == 0);
    CHECK(ring.passages[0].start == train.pairs.start[6]);
    CHECK(planet_fault_pattern(train.pairs, PlanetId{2}, PlanetSide::sun, 31).passages[0].pair ==
          2);

    PairSet shafts;
    shafts.mesh = {&kSunMesh};
    shafts.start = {0.3};
    const FaultPattern pinion = shaft_fault_pattern(shafts, 19);
    CHECK(pinion.length == 19);
    REQUIRE(pinion.passages.size() == 1);
    CHECK(pinion.passages[0].pair == 0);
    CHECK(pinion.passages[0].start == 0.3);
}

}  // namespace gearpod::lockstep::test_fault_pattern
