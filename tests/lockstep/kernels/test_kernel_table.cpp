// Checks that the program was built with all kernels that the table of integrators requires.
#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/planetary_motion.hpp"
#include "lockstep/integrators/facts.hpp"
#include "lockstep/kernels/kernel_table.hpp"
#include "tests/test.hpp"

namespace gearpod::lockstep::test_kernel_table {

bool has(const KernelKey& key) {
    const std::vector<KernelKey> keys = kernel_table().keys();
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::vector<MotionModel> motion_models(Integrator integrator) {
    return is_explicit(integrator)
               ? std::vector{MotionModel::translational_inertial, MotionModel::translational,
                             MotionModel::torsional, MotionModel::fixed_shaft}
               : std::vector{MotionModel::matrices};
}

TEST_CASE("Every integrator has its declared kernels for every mesh law") {
    const machine::InstructionSet set = built_instruction_sets().back();
    for (const Integrator integrator : all_integrators()) {
        const IntegratorFacts& f = facts(integrator);
        for (const auto law : {dynamics::MeshLaw::linear, dynamics::MeshLaw::with_error,
                               dynamics::MeshLaw::separating}) {
            for (const MotionModel motion_model : motion_models(integrator)) {
                INFO(f.name << ", law " << static_cast<int>(law) << ", moving "
                            << static_cast<int>(motion_model));
                KernelKey key{
                    integrator,   law, ExcitationKind::steady, Precision::double_precision, set,
                    motion_model, 8};
                CHECK(has(key));
                key.excitation = ExcitationKind::forced;
                CHECK(has(key) == f.supports_varying_forces);
                key.excitation = ExcitationKind::variable_speed;
                CHECK(has(key) == f.supports_variable_speed);
                key = {integrator,   law, ExcitationKind::steady, Precision::single_precision, set,
                       motion_model, 16};
                CHECK(has(key) == f.has_single_precision);
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
        CHECK((f.diagonal == 0.0) == f.is_explicit);
    }
}

TEST_CASE("A missing kernel is refused by name and not replaced by one of other lanes") {
    KernelKey key{Integrator::rk4,
                  dynamics::MeshLaw::linear,
                  ExcitationKind::steady,
                  Precision::double_precision,
                  built_instruction_sets().back(),
                  MotionModel::torsional,
                  8};
    CHECK(kernel_table().find<dynamics::PlanetaryLanes<8>>(key) != nullptr);
    CHECK_THROWS_WITH(kernel_table().find<dynamics::FixedShaftLanes<8>>(key),
                      Catch::Contains("unsupported number of lanes"));
    key.lanes = 2;
    CHECK_THROWS_AS(kernel_table().find<dynamics::PlanetaryLanes<2>>(key), MissingKernel);
    CHECK_THROWS_WITH(kernel_table().find<dynamics::PlanetaryLanes<2>>(key),
                      Catch::Contains("no rk4 kernel for 2 double-precision lanes"));
}

}  // namespace gearpod::lockstep::test_kernel_table
