#include "machine/instruction_sets.hpp"
#include "stiffness/additive_mesh.hpp"
#include "stiffness/faults/tooth_crack.hpp"
#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/numbers.hpp"
#include "tests/stiffness/gear_pairs.hpp"

namespace gearpod::stiffness::test_tooth_crack {

using namespace test_pairs;

// A cracked pair of teeth for all depths.
struct CrackedPair {
    explicit CrackedPair(const CrackedGear& gear)
        : family(gear.geometry, kLiangSteel, gear.profile, gear.which, kCrackAngle),
          healthy(gear.geometry, kLiangSteel, gear.profile) {}
    double max_depth() const { return family.largest_size(); }
    ToothPairCurve at(double depth) const { return healthy.faulty_pair(*family.at(depth)); }

    ToothCrack family;
    AdditiveMesh healthy;
};

double reference(const CrackedGear& gear, double tau, double depth) {
    const auto compliance = [&](int which, const Crack& crack) {
        const ToothProfile profile(gear.geometry.gear(which), gear.profile);
        return tooth_compliance(profile, kLiangSteel, gear.geometry.contact_angle(which, tau),
                                crack)
            .total();
    };
    return 1 / (1 / hertz_stiffness(kLiangSteel) + compliance(gear.which, {depth, kCrackAngle}) +
                compliance(3 - gear.which, {}));
}

std::vector<double> positions(double contact_ratio, int count) {
    return test::tabulated(count, [&](int i) { return contact_ratio * i / (count - 1); });
}

// Depths in units of the largest: uniform, and dense at zero, at the centre line and at breakage.
std::vector<double> random_depths(std::mt19937_64& engine, int count) {
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> depths;
    for (int i = 0; i < count; ++i) {
        const double tiny = std::pow(10, -6 * uniform(engine));
        const double depth[] = {tiny, 1 - tiny, 0.5 + 0.5e-2 * (uniform(engine) - 0.5)};
        const int kind = i % 10;
        depths.push_back(kind < 3 ? depth[kind] : uniform(engine));
    }
    return depths;
}

TEST_CASE(
    "curves of a cracked pair agree with quadrature to 1e-8 of the healthy stiffness at every "
    "depth") {
    for (const auto& gear : cracked_gears()) {
        const CrackedPair family(gear);
        const AdditiveMesh& healthy = family.healthy;
        std::mt19937_64 engine(20160517);
        std::uniform_real_distribution<double> uniform(0, gear.geometry.contact_ratio());
        double worst = 0;
        for (const double fraction : random_depths(engine, 300)) {
            const double depth = fraction * family.max_depth();
            const ToothPairCurve curve = family.at(depth);
            for (int i = 0; i < 10; ++i) {
                const double tau = uniform(engine);
                const double error = std::abs(curve(tau) - reference(gear, tau, depth));
                worst = std::max(worst, error / healthy.tooth_pair(tau));
            }
        }
        INFO(gear.name);
        CHECK(worst < 1e-8);
    }
}

TEST_CASE("a pair without a crack is the healthy pair, one with a broken tooth carries no load") {
    for (const auto& gear : cracked_gears()) {
        const CrackedPair family(gear);
        const AdditiveMesh& healthy = family.healthy;
        const ToothPairCurve whole = family.at(0), broken = family.at(family.max_depth());
        for (const double tau : positions(healthy.contact_ratio(), 101)) {
            CHECK(whole(tau) == Approx(healthy.tooth_pair(tau)).epsilon(2e-9));
            CHECK(broken(tau) == 0);
        }
        CHECK(family.at(-1)(0.5) == whole(0.5));
        CHECK(family.at(1)(0.5) == 0);
    }
}

TEST_CASE(
    "a deeper crack never makes the pair stiffer, and its stiffness is continuous at the centre "
    "line") {
    for (const auto& gear : cracked_gears()) {
        const CrackedPair family(gear);
        const auto tau = positions(gear.geometry.contact_ratio(), 201);
        std::vector<double> before(tau.size()), now(tau.size());
        family.at(0)(tau, before);
        const double slack = 2e-8 * before[tau.size() / 2];
        for (int step = 1; step <= 100; ++step) {
            family.at(family.max_depth() * step / 100)(tau, now);
            for (std::size_t i = 0; i < tau.size(); ++i)
                REQUIRE(now[i] <= before[i] + slack);
            before = now;
        }
        const double half = family.max_depth() / 2;
        family.at(half * (1 - 1e-10))(tau, before);
        family.at(half * (1 + 1e-10))(tau, now);
        for (std::size_t i = 0; i < tau.size(); ++i)
            REQUIRE(std::abs(now[i] - before[i]) <= slack);
    }
}

TEST_CASE("stiffness falls to zero where the cracked section vanishes, and is never negative") {
    for (const auto& gear : cracked_gears()) {
        const CrackedPair family(gear);
        const ToothProfile profile(gear.geometry.gear(gear.which), gear.profile);
        const auto tau = positions(gear.geometry.contact_ratio(), 1001);
        std::vector<double> k(tau.size());
        for (const double fraction : {0.55, 0.7, 0.8, 0.95, 0.999}) {
            const CrackedSections sections(profile, {fraction * family.max_depth(), kCrackAngle});
            family.at(fraction * family.max_depth())(tau, k);
            for (std::size_t i = 0; i < tau.size(); ++i) {
                REQUIRE(k[i] >= 0);
                const double u =
                    profile.involute_angle(gear.geometry.contact_angle(gear.which, tau[i]));
                if (u < sections.boundary() - 1e-6)
                    REQUIRE(k[i] == 0);
            }
        }
    }
}

TEST_CASE("one position, many positions and every instruction set give the same bits") {
    const auto gear = cracked_gears().front();
    const CrackedPair family(gear);
    const auto tau = positions(gear.geometry.contact_ratio() + 0.1, 1037);
    for (const double fraction : {0.0, 0.1, 0.4, 0.7}) {
        const ToothPairCurve curve = family.at(fraction * family.max_depth());
        std::vector<double> best(tau.size()), other(tau.size());
        curve(tau, best);
        for (std::size_t i = 0; i < tau.size(); ++i)
            REQUIRE(curve(tau[i]) == best[i]);
        const auto active = machine::active_instruction_set();
        for (const auto set :
             {machine::InstructionSet::baseline, machine::InstructionSet::x86_64_v3,
              machine::InstructionSet::x86_64_v4}) {
            if (set > machine::best_instruction_set())
                continue;
            machine::use_instruction_set(set);
            curve(tau, other);
            machine::use_instruction_set(active);
            REQUIRE(other == best);
        }
    }
}

TEST_CASE("an invalid crack is refused") {
    const gears::MeshGeometry mesh(external(19), external(31));
    CHECK_THROWS_AS(ToothCrack(mesh, kLiangSteel, Profile::root_circle, 3, 0.8),
                    std::invalid_argument);
    CHECK_THROWS_AS(ToothCrack(mesh, kLiangSteel, Profile::root_circle, 1, 0.0),
                    std::invalid_argument);
}

}  // namespace gearpod::stiffness::test_tooth_crack
