// Checks that a gearbox has the same bits in any tile, for every shipped study: whichever gearboxes
// share its tile, however many they are, and for any number of lanes. The tiles hold several
// gearboxes with a fault and one without.
#include <fmt/format.h>

#include "mc/ensemble/batch_workers.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/sensor_signal.hpp"
#include "tests/mc/gearbox_bits.hpp"
#include "tests/mc/study_file.hpp"
#include "tests/shipped_studies.hpp"

namespace gearpod::test_equal_bits {

using namespace test;

// Studies without teeth have modes only and are excluded.
std::vector<std::string> studies_with_teeth() {
    std::vector<std::string> names = shipped_studies();
    std::erase_if(names, [](const std::string& name) {
        const mc::Study study = shipped_study(name);
        return !study.gearbox.has_teeth() || !study.gearbox.module_m;
    });
    return names;
}

// The second one is for gearboxes with neighbouring stages, which turn faster.
constexpr double kFastCarrier_rpm = 300.0, kFastNextToStages_rpm = 60.0;

// True if every mesh of the span is integrated, for a second or more per tile.
bool integrates_all_meshes(const mc::Study& study) {
    return study.numerics.horizon == mc::Horizon::full || !mc::reason_not_periodic(study).empty();
}

// Overrides for fast tiles: a faster carrier with fewer steps per mesh where it is slow and every
// mesh is integrated.
std::vector<std::string> fast(const std::string& name) {
    const mc::Study study = shipped_study(name);
    const double carrier_rpm = study.operation.carrier_speed_rad_s.value_or(0.0) * 30.0 / M_PI;
    const double fast_rpm = study.sensor.stages.empty() ? kFastCarrier_rpm : kFastNextToStages_rpm;
    if (integrates_all_meshes(study) && carrier_rpm > 0.0 && carrier_rpm < fast_rpm) {
        return {fmt::format("operation.carrier_speed_rpm={}", fast_rpm)};
    }
    return {};
}

// Gearboxes of a study: one with a fault, one without, and six more with faults as far as the study
// has any.
std::vector<mc::GearboxId> gearboxes_of(const mc::Scene& scene) {
    constexpr std::size_t kCount = 8;
    constexpr std::uint64_t kSearched = 64;
    std::vector<mc::GearboxId> ids;
    for (std::uint64_t i = 0; i < kSearched && ids.size() < kCount; ++i) {
        const mc::GearboxId id{mc::Group::test, i};
        if (scene.sampler().draw(id).inputs.fault_size > 0.0) {
            ids.push_back(id);
        }
        if (ids.size() == 1) {
            ids.push_back({mc::Group::threshold, 0});
        }
    }
    for (std::uint64_t i = 1; ids.size() < kCount; ++i) {
        ids.push_back({mc::Group::threshold, i});
    }
    return ids;
}

// Rows of the first gearboxes of a study, bit by bit, computed in tiles of these lanes.
class TileRows {
  public:
    TileRows(const std::string& name, int lanes) : scene_(study_with(name, lanes)) {}

    std::vector<Bits> first(std::size_t gearboxes) {
        const auto ids = gearboxes_of(scene_);
        const std::size_t values = scene_.ensemble().shape.values();
        mc::Seconds seconds;
        const mc::BatchRows computed = worker_.compute(std::span(ids).first(gearboxes), 1, seconds);
        std::vector<Bits> rows;
        for (std::size_t row = 0; row < computed.count(); ++row) {
            rows.push_back(bits_of(std::span(computed.values).subspan(row * values, values)));
            rows.back().push_back(static_cast<std::uint64_t>(computed.status[row]));
        }
        return rows;
    }

  private:
    static mc::Study study_with(const std::string& name, int lanes) {
        std::vector<std::string> changes = fast(name);
        changes.push_back(fmt::format("numerics.lanes={}", lanes));
        return shipped_study(name, changes);
    }

    const mc::Scene scene_;
    const mc::BatchTask task_{scene_.tile(), scene_.ensemble()};
    mc::BatchWorker worker_{task_};
};

void check(const std::string& name, const std::vector<TileFilling>& fillings) {
    INFO(name);
    std::unique_ptr<TileRows> rows;
    check_same_bits(fillings, [&, lanes = 0](const TileFilling& filling) mutable {
        if (filling.lanes != lanes) {
            lanes = filling.lanes;
            rows = std::make_unique<TileRows>(name, lanes);
        }
        return rows->first(filling.gearboxes);
    });
}

// Checks that `simulate` gives the features of the first gearbox's row.
void check_simulation(const std::string& name) {
    INFO(name);
    const mc::Scene scene(shipped_study(name, fast(name)));
    const mc::BatchTask task(scene.tile(), scene.ensemble());
    mc::BatchWorker worker(task);
    mc::Seconds seconds;
    const auto ids = gearboxes_of(scene);
    const mc::BatchRows row = worker.compute(std::span(ids).first(5), 1, seconds);
    if (row.status.front() != static_cast<int>(mc::Status::ok)) {
        return;  // `simulate` refuses a gearbox that failed
    }
    const mc::Simulation simulation = mc::simulate(scene.tile(), ids.front(), 1);
    const std::size_t first = scene.ensemble().shape.value_of(0, 0);
    CHECK((bits_of(simulation.features) ==
           bits_of(std::span(row.values).subspan(first, simulation.features.size()))));
}

// Kernels of few lanes for variable excitation and for coupled stages exist in a portable build
// only.
bool any_width(const mc::Study& study) {
    return GEARPOD_PORTABLE || (!mc::has_variable_excitation(study) && !mc::is_coupled(study));
}

// The first filling is the reference. tests/lockstep checks each mesh law with all widths.
TEST_CASE("Every shipped study gives a gearbox the same bits in any tile") {
    const auto names = studies_with_teeth();
    REQUIRE(names.size() > 30);
    for (const std::string& name : names) {
        const mc::Study study = shipped_study(name);
        // A tile takes long where every mesh is integrated; the test below has all fillings.
        if (!integrates_all_meshes(study)) {
            check(name, {{8, 8}, {8, 2}, {8, 5}, {1, 2}});
        } else if (any_width(study)) {
            check(name, {{8, 8}, {4, 3}});
        } else {
            check(name, {{8, 8}, {8, 2}, {1, 1}});
        }
    }
}

TEST_CASE("Every shipped study gives a gearbox the same bits in all tiles", "[.equal-bits]") {
    for (const std::string& name : studies_with_teeth()) {
        const mc::Study study = shipped_study(name);
        std::vector<TileFilling> fillings{{8, 8}, {8, 1}, {8, 2}, {8, 5}, {1, 8}};
        if (any_width(study)) {
            fillings.insert(fillings.end(), {{4, 1}, {4, 2}, {4, 5}, {4, 8}});
        }
        if (study.numerics.precision == mc::Precision::single_precision) {
            fillings.insert(fillings.end(), {{16, 1}, {16, 2}, {16, 5}, {16, 8}});
        }
        check(name, fillings);
    }
}

TEST_CASE("A simulated gearbox with periodic meshes has the bits of a run") {
    check_simulation("planet-crack-ideal.toml");
}

}  // namespace gearpod::test_equal_bits
