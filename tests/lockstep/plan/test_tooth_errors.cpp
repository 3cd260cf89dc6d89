// Pitch errors of single teeth: who meets whom, and what the load makes of it.
#include <catch2/catch.hpp>
#include <numeric>

#include "lockstep/plan/tooth_errors.hpp"
#include "lockstep/tile/quasi_static.hpp"
#include "stiffness/square_wave_mesh.hpp"
#include "tests/lockstep/liang_train.hpp"

using namespace gearpod;
using namespace gearpod::lockstep;
using test::LiangTrain;

namespace {

const gears::PlanetaryTrain kLiang{19, 31, 81, 4};

// Of all gears of the train, without errors: sun, ring, and each planet's two sides.
ToothErrors no_errors(const LoadShares& shares, const PairSet& pairs, std::size_t lanes) {
    ToothErrors errors{&shares, {}, planetary_teeth(pairs, kLiang, gears::PlanetSense::clockwise)};
    for (const int teeth : {19, 81, 31, 31, 31, 31, 31, 31, 31, 31}) {
        const auto size = static_cast<std::size_t>(teeth) * lanes;
        errors.gears.push_back({teeth, machine::AlignedVector(size, 0.0)});
    }
    return errors;
}

MarchPlan error_plan(int samples, int steps, dynamics::Motion motion) {
    MarchPlan plan = LiangTrain::instance().plan(samples, steps, motion);
    plan.mesh_law = dynamics::MeshLaw::with_error;
    return plan;
}

}  // namespace

TEST_CASE("Equal errors of all teeth are one steady error, whoever shares the load") {
    const auto& pairs = LiangTrain::instance().pairs;
    const MarchPlan plan = error_plan(24, 240, dynamics::Motion::torsional);
    const LoadShares shares(pairs, plan.grid);
    ToothErrors errors = no_errors(shares, pairs, 1);
    for (auto& gear : errors.gears) {
        std::fill(gear.error_m.begin(), gear.error_m.end(), 2e-6);
    }
    for (const int k : {-3, 0, 1000}) {
        for (const PairOverride& o : tooth_error_overrides(plan, errors, k)) {
            CHECK(o.stiffness.empty());
            for (std::size_t i = 0; i < o.error.size(); ++i) {
                CHECK(o.error[i] == Approx(4e-6).epsilon(1e-12));  // both gears'
                CHECK(std::abs(o.error_rate[i]) < 1e-12);
            }
        }
    }
}

TEST_CASE("A tooth's error shows while it touches, weighed with its load, and its rate fits") {
    const auto& train = LiangTrain::instance();
    const MarchPlan plan = error_plan(24, 240, dynamics::Motion::torsional);
    const LoadShares shares(train.pairs, plan.grid);
    ToothErrors errors = no_errors(shares, train.pairs, 1);
    const int tooth = 7;
    errors.gears[4].error_m[tooth] = 3e-6;  // planet 2, sun side
    const double ratio = train.sun_planet.contact_ratio();
    for (int k = 0; k < 2 * 31; ++k) {
        const auto all = tooth_error_overrides(plan, errors, k);
        for (std::size_t pair = 0; pair < 8; ++pair) {
            const PairOverride& o = all[pair];
            for (std::size_t s = 0; s < plan.grid.steps.size(); ++s) {
                const Step& step = plan.grid.steps[s];
                const double middle = k % 31 + step.phase + 0.5 * step.length;
                const double since = middle - (tooth + train.pairs.start[1]);
                const bool touches = pair == 1 && since > 0.0 && since < ratio;
                const double e = o.error[3 * s + 1];
                CHECK((e != 0.0) == touches);
                if (touches && since > ratio - 1.0 && since < 1.0) {
                    CHECK(e == Approx(3e-6));  // alone
                } else if (touches) {
                    CHECK((e > 0.6e-6 && e < 2.4e-6));
                }
                const double integral =
                    step.length / 6.0 *
                    (o.error_rate[3 * s] + 4.0 * o.error_rate[3 * s + 1] + o.error_rate[3 * s + 2]);
                CHECK(o.error[3 * s + 2] - o.error[3 * s] ==
                      Approx(integral).epsilon(1e-4).margin(1e-15));
            }
        }
    }
}

TEST_CASE("A sun tooth carries its error from planet to planet, a ring tooth the other way") {
    const auto& pairs = LiangTrain::instance().pairs;
    const MarchPlan plan = error_plan(24, 24, dynamics::Motion::torsional);
    const LoadShares shares(pairs, plan.grid);
    for (const bool on_sun : {true, false}) {
        ToothErrors errors = no_errors(shares, pairs, 1);
        errors.gears[on_sun ? 0 : 1].error_m[0] = 1e-6;
        const int teeth = on_sun ? 19 : 81;
        std::vector<double> met(4, -1.0);  // phase at which the tooth begins to touch
        for (int k = 0; k < teeth; ++k) {
            const auto all = tooth_error_overrides(plan, errors, k);
            for (std::size_t n = 0; n < 4; ++n) {
                const auto pair = n + (on_sun ? 0 : 4);
                const auto& e = all[pair].error;
                const auto before = tooth_error_overrides(plan, errors, k - 1)[pair].error;
                if (before.back() == 0.0 && *std::max_element(e.begin(), e.end()) > 0.0) {
                    met[n] = k + pairs.start[pair];
                }
            }
        }
        // Planets a quarter turn apart: Z / 4 meshes from one to the next.
        for (std::size_t n = 1; n < 4; ++n) {
            const double turn =
                on_sun ? static_cast<double>(n) / 4.0 : 1.0 - static_cast<double>(n) / 4.0;
            CHECK(met[n] - met[0] == Approx(turn * teeth));
        }
    }
}

TEST_CASE(
    "Slowly turned, a train follows its tooth errors by the stiffness of the planets' paths") {
    const auto& train = LiangTrain::instance();
    const auto sun_mesh = stiffness::SquareWaveMesh::constant(3e8);
    const auto ring_mesh = stiffness::SquareWaveMesh::constant(5e8);
    PairSet pairs = train.pairs;
    for (std::size_t pair = 0; pair < 8; ++pair) {
        pairs.mesh[pair] = pair < 4 ? &sun_mesh : &ring_mesh;
    }
    MarchPlan plan = error_plan(12, 12, dynamics::Motion::torsional);
    plan.grid = make_phase_grid(12, 12, contact_transitions(pairs));
    plan.nodes = tabulate(pairs, plan.grid, dynamics::MeshDamping::ratio);
    const LoadShares shares(pairs, plan.grid);
    ToothErrors errors = no_errors(shares, pairs, 1);
    errors.gears[2].error_m[5] = 4e-6;  // planet 1, sun side
    FaultCurves faults;
    faults.pairs = &pairs;
    faults.tooth_errors = &errors;
    const dynamics::GearboxInputs in = train.inputs();
    TileSettings settings;
    settings.march_meshes = 31;
    const TileResult tile = run_quasi_static<1>(plan, std::span(&in, 1), faults, settings);
    const double rise = 4e-6 / 4.0 / train.sun.base_radius();  // one path of four equal ones
    for (int k = 0; k < 31; ++k) {
        const auto& te =
            tile.records[static_cast<std::size_t>(tile.content[static_cast<std::size_t>(k)])].te;
        for (int i = 0; i < 12; ++i) {
            const double since = k + i / 12.0 - (5 + pairs.start[0]);
            const bool touches = since > -1e-9 && since < 1.0 - 1e-9;
            CHECK(te[static_cast<std::size_t>(i)] - tile.records[0].te[0] ==
                  Approx(touches ? rise : 0.0).margin(1e-9 * rise));
        }
    }
    settings.march_meshes = 0;
    CHECK_THROWS_AS(run_quasi_static<1>(plan, std::span(&in, 1), faults, settings),
                    std::invalid_argument);
}

TEST_CASE("Marched with tooth errors, lanes keep their bits; without errors nothing changes") {
    const auto& train = LiangTrain::instance();
    const MarchPlan plan = error_plan(12, 1200, dynamics::Motion::torsional);
    const LoadShares shares(train.pairs, plan.grid);
    ToothErrors errors = no_errors(shares, train.pairs, 8);
    FaultCurves faults =
        train.ring_side_cracks({0.0, 0.5e-3, 1e-3, 2e-3, 3e-3, 3.5e-3, 4e-3, 4.28e-3});
    const std::vector<dynamics::GearboxInputs> inputs(8, train.inputs(10.0));
    TileSettings settings;
    settings.march_meshes = 4;
    const TileResult plain = run_tile<8>(plan, inputs, faults, settings);
    faults.tooth_errors = &errors;
    const TileResult none = run_tile<8>(plan, inputs, faults, settings);
    settings.run_in_meshes = 3;
    for (std::size_t g = 0; g < errors.gears.size(); ++g) {
        for (std::size_t i = 0; i < errors.gears[g].error_m.size(); ++i) {
            errors.gears[g].error_m[i] = 1e-6 * std::sin(static_cast<double>(13 * g + i));
        }
    }
    const TileResult wide = run_tile<8>(plan, inputs, faults, settings);
    for (std::size_t r = 0; r < plain.records.size(); ++r) {
        CHECK(none.records[r].te == plain.records[r].te);
        CHECK(none.records[r].acceleration == plain.records[r].acceleration);
    }
    for (const std::size_t l : {0U, 5U}) {
        ToothErrors own = no_errors(shares, train.pairs, 1);
        for (std::size_t g = 0; g < own.gears.size(); ++g) {
            for (std::size_t i = 0; i < own.gears[g].error_m.size(); ++i) {
                own.gears[g].error_m[i] = errors.gears[g].error_m[8 * i + l];
            }
        }
        FaultCurves one = train.no_fault(1);
        one.pattern = faults.pattern;
        one.curve[0][0] = faults.curve[0][l];
        one.tooth_errors = &own;
        const TileResult narrow = run_tile<1>(plan, std::span(inputs).first(1), one, settings);
        for (std::size_t r = 1; r < narrow.records.size(); ++r) {
            for (std::size_t i = 0; i < 12; ++i) {
                CHECK(narrow.records[r].te[i] == wide.records[r].te[8 * i + l]);
                CHECK(wide.records[r].te[8 * i + l] != plain.records[r].te[8 * i + l]);
            }
        }
    }
}
