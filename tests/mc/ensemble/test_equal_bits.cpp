// Every shipped study by another number of lanes: the same bits. Small ensembles, whose first
// gearboxes are healthy and whose tiles are full and not: a lane's neighbours change with their
// number.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/study/fluctuations.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/shipped_studies.hpp"

using namespace gearpod;
using test::bits;
using test::shipped_study;

namespace {

// Those without teeth have modes only.
std::vector<std::string> studies_with_teeth() {
    std::vector<std::string> names = test::shipped_studies();
    std::erase_if(names, [](const std::string& name) {
        const mc::Study study = shipped_study(name);
        return !study.gearbox.has_teeth() || !study.gearbox.module_m;
    });
    return names;
}

constexpr double kFastCarrier_rpm = 300.0;

// Every mesh of the span is marched, for a second and more a tile.
bool marches_all(const mc::Study& study) {
    return study.numerics.horizon == mc::Horizon::march || !mc::why_no_mesh_repeats(study).empty();
}

// Those that march all have few gearboxes, and slow carriers turn faster, with fewer steps a mesh.
std::vector<std::string> small(const std::string& name) {
    const mc::Study study = shipped_study(name);
    const bool marched = marches_all(study);
    std::vector<std::string> changes{marched ? "ensemble.instances=2" : "ensemble.instances=9",
                                     "ensemble.threshold_instances=1"};
    const double carrier_rpm = study.operation.carrier_speed_rad_s.value_or(0.0) * 30.0 / M_PI;
    if (marched && carrier_rpm > 0.0 && carrier_rpm < kFastCarrier_rpm) {
        changes.push_back(fmt::format("operation.carrier_speed_rpm={}", kFastCarrier_rpm));
    }
    return changes;
}

}  // namespace

// One other width suffices: tests/lockstep marches each mesh law by all. It is one lane, or four
// where every mesh is marched.
TEST_CASE("Every shipped study gives the same bits by eight lanes and by one or four") {
    const auto names = studies_with_teeth();
    REQUIRE(names.size() > 30);
    for (const std::string& name : names) {
        INFO(name);
        const auto changes = small(name);
        // Uneven drives have kernels of four lanes in a portable build only.
        const mc::Study study = shipped_study(name);
        const bool any_width = GEARPOD_PORTABLE || !mc::driven_unevenly(study);
        const auto of_lanes = [&](int lanes) {
            auto of_width = changes;
            of_width.push_back(fmt::format("numerics.lanes={}", lanes));
            return bits(test::run(shipped_study(name, of_width)));
        };
        const auto reference = of_lanes(8);
        CHECK(of_lanes(any_width && marches_all(study) ? 4 : 1) == reference);
    }
}
