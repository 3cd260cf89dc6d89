// Checks that the program was built with all kernels that the table of integrators requires.
#include <algorithm>
#include <catch2/catch.hpp>

#include "dynamics/fixed_shaft_lanes.hpp"
#include "dynamics/planetary_lanes.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/kernels/kernel_table.hpp"

using namespace gearpod;
using namespace gearpod::lockstep;

namespace {

bool has(const KernelKey& key) {
    const std::vector<KernelKey> keys = kernel_table().keys();
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::vector<Moving> movings(Integrator integrator) {
    return is_explicit(integrator)
               ? std::vector{Moving::translational_inertial, Moving::translational,
                             Moving::torsional, Moving::fixed_shaft}
               : std::vector{Moving::matrices};
}

}  // namespace

TEST_CASE("Every integrator has its declared kernels for every mesh law") {
    const machine::InstructionSet set = built_instruction_sets().back();
    for (const Integrator integrator : all_integrators()) {
        const IntegratorFacts& f = facts(integrator);
        for (const auto law : {dynamics::MeshLaw::linear, dynamics::MeshLaw::with_error,
                               dynamics::MeshLaw::separating}) {
            for (const Moving moving : movings(integrator)) {
                INFO(f.name << ", law " << static_cast<int>(law) << ", moving "
                            << static_cast<int>(moving));
                KernelKey key{integrator, law, Drive::steady, Precision::double_precision, set,
                              moving,     8};
                CHECK(has(key));
                key.drive = Drive::forced;
                CHECK(has(key) == f.marches_forced);
                key.drive = Drive::paced;
                CHECK(has(key) == f.marches_paced);
                key = {integrator, law, Drive::steady, Precision::single_precision, set,
                       moving,     16};
                CHECK(has(key) == f.marches_singles);
            }
        }
    }
}

TEST_CASE("Stage nodes ascend from 0 to 1, and integrator names are unique") {
    for (const Integrator integrator : all_integrators()) {
        const IntegratorFacts& f = facts(integrator);
        INFO(f.name);
        CHECK(std::is_sorted(f.stage_nodes.begin(), f.stage_nodes.end()));
        CHECK(f.stage_nodes.front() >= 0.0);
        CHECK(f.stage_nodes.back() <= 1.0);
        CHECK(std::count_if(all_integrators().begin(), all_integrators().end(),
                            [&](Integrator i) { return std::string(name(i)) == f.name; }) == 1);
        CHECK((f.span.velocity == 0.0) == f.is_explicit);
    }
}

TEST_CASE("A missing kernel is refused by name and not replaced by one of other lanes") {
    KernelKey key{Integrator::rk4,
                  dynamics::MeshLaw::linear,
                  Drive::steady,
                  Precision::double_precision,
                  built_instruction_sets().back(),
                  Moving::torsional,
                  8};
    CHECK(kernel_table().find<dynamics::PlanetaryLanes<8>>(key) != nullptr);
    CHECK_THROWS_WITH(kernel_table().find<dynamics::FixedShaftLanes<8>>(key),
                      Catch::Contains("lanes that it does not take"));
    key.lanes = 2;
    CHECK_THROWS_AS(kernel_table().find<dynamics::PlanetaryLanes<2>>(key), NoSuchKernel);
    CHECK_THROWS_WITH(kernel_table().find<dynamics::PlanetaryLanes<2>>(key),
                      Catch::Contains("not 2 doubles by rk4"));
}
