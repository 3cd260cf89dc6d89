// Checks that every shipped study gives the same bits for another number of lanes. The ensembles
// are small; their first gearboxes are healthy and their tiles both full and not, so that a lane's
// neighbours change with the number of lanes.
#include <fmt/format.h>

#include <cmath>

#include "mc/study/fluctuations.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/shipped_studies.hpp"

namespace test_equal_bits {

using namespace gearpod;
using test::bits;
using test::shipped_study;

namespace {

// Studies without teeth have modes only and are excluded.
std::vector<std::string> studies_with_teeth() {
    std::vector<std::string> names = test::shipped_studies();
    std::erase_if(names, [](const std::string& name) {
        const mc::Study study = shipped_study(name);
        return !study.gearbox.has_teeth() || !study.gearbox.module_m;
    });
    return names;
}

constexpr double kFastCarrier_rpm = 300.0;

// True if every mesh of the span is integrated, for a second or more per tile.
bool integrates_all_meshes(const mc::Study& study) {
    return study.numerics.horizon == mc::Horizon::full || !mc::reason_not_periodic(study).empty();
}

// Overrides for a small ensemble: few gearboxes where all meshes are integrated, and a faster
// carrier with fewer steps per mesh where it is slow.
std::vector<std::string> small(const std::string& name) {
    const mc::Study study = shipped_study(name);
    const bool integrates_all = integrates_all_meshes(study);
    std::vector<std::string> changes{
        integrates_all ? "ensemble.instances=2" : "ensemble.instances=9",
        "ensemble.threshold_instances=1"};
    const double carrier_rpm = study.operation.carrier_speed_rad_s.value_or(0.0) * 30.0 / M_PI;
    if (integrates_all && carrier_rpm > 0.0 && carrier_rpm < kFastCarrier_rpm) {
        changes.push_back(fmt::format("operation.carrier_speed_rpm={}", kFastCarrier_rpm));
    }
    return changes;
}

}  // namespace

// One other width suffices: tests/lockstep checks each mesh law with all. It is one lane, or four
// where every mesh is integrated.
TEST_CASE("Every shipped study gives the same bits by eight lanes and by one or four") {
    const auto names = studies_with_teeth();
    REQUIRE(names.size() > 30);
    for (const std::string& name : names) {
        INFO(name);
        const auto changes = small(name);
        // Variable excitation has kernels of four lanes in a portable build only.
        const mc::Study study = shipped_study(name);
        const bool any_width = GEARPOD_PORTABLE || !mc::has_variable_excitation(study);
        const auto of_lanes = [&](int lanes) {
            auto of_width = changes;
            of_width.push_back(fmt::format("numerics.lanes={}", lanes));
            return bits(test::run(shipped_study(name, of_width)));
        };
        const auto reference = of_lanes(8);
        CHECK(of_lanes(any_width && integrates_all_meshes(study) ? 4 : 1) == reference);
    }
}

}  // namespace test_equal_bits
