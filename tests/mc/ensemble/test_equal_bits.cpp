// Every shipped study by every number of lanes: the same bits. Small ensembles, whose first
// gearboxes are healthy and whose tiles are full and not: a lane's neighbours change with their
// number.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/study/fluctuations.hpp"
#include "tests/mc/program.hpp"
#include "tests/mc/study_file.hpp"

using namespace gearpod;
using test::bits;
using test::shipped_study;

namespace {

std::vector<std::string> shipped_studies() {
    std::vector<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(GEARPOD_SOURCE_DIR) + "/studies")) {
        const std::string name = entry.path().filename().string();
        // Those without teeth have modes only.
        if (name.ends_with(".toml") && shipped_study(name).gearbox.has_teeth() &&
            shipped_study(name).gearbox.module_m) {
            names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

// Every mesh of the span is marched, for a second and more a tile.
bool marches_all(const mc::Study& study) {
    return study.numerics.horizon == mc::Horizon::march || !mc::why_no_mesh_repeats(study).empty();
}

// Those that march all have few gearboxes; slow carriers turn ten times as fast, with a tenth of
// the steps a mesh.
std::vector<std::string> small(const std::string& name) {
    const mc::Study study = shipped_study(name);
    const bool marched = marches_all(study);
    std::vector<std::string> changes{marched ? "ensemble.instances=2" : "ensemble.instances=9",
                                     "ensemble.threshold_instances=1"};
    const double carrier_rpm = study.operation.carrier_speed_rad_s.value_or(0.0) * 30.0 / M_PI;
    if (marched && carrier_rpm > 0.0 && carrier_rpm < 12.0) {
        changes.push_back(fmt::format("operation.carrier_speed_rpm={}", 10.0 * carrier_rpm));
    }
    return changes;
}

}  // namespace

// Of a study that marches every mesh one other width suffices: tests/lockstep marches each mesh law
// by all.
TEST_CASE("Every shipped study gives the same bits by one, four and eight lanes") {
    const auto names = shipped_studies();
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
        if (any_width) {
            CHECK(of_lanes(4) == reference);
        }
        if (!any_width || !marches_all(study)) {
            CHECK(of_lanes(1) == reference);
        }
    }
}
