// What superposition makes of gearboxes with real teeth, held against marching every mesh.
#include <catch2/catch.hpp>
#include <cmath>

#include "mc/gearbox/healthy_march.hpp"
#include "mc/gearbox/mesh_time.hpp"
#include "tests/mc/study_file.hpp"

using namespace gearpod;
using namespace gearpod::mc;

namespace {

// 24/20/64 teeth of grade 6, pins 20 um off; cracked ones and their baselines. At 3 kN m no tooth
// pair of the healthy ones leaves contact, at less of it some do.
Study study_with(const std::string& horizon, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"numerics.horizon=" + horizon, "operation.carrier_speed_rpm=20",
                             "numerics.precision=double", "numerics.settle_tolerance=1e-10",
                             "sensor.noise_levels=[0]", "ensemble.threshold_records=1",
                             "detection.false_alarm_rate=0.05"});
    Study study = test::shipped_study("fleet-alarms.toml", more);
    study.ensemble.threshold_instances = 2;
    study.ensemble.instances = 6;
    return study;
}

// Of the graded gearboxes 0 to 7.
class Tile {
  public:
    explicit Tile(const Study& study) : scene_(study), path_(path_grid(scene_)) {
        std::vector<GearboxId> ids;
        for (std::uint64_t i = 0; i < 8; ++i) {
            ids.push_back({Group::graded, i});
        }
        tile_ = run_gearboxes(scene_, Sampler(study), path_, ids, 8);
    }
    const GearboxTile& operator*() const { return tile_; }
    const GearboxTile* operator->() const { return &tile_; }
    std::vector<double> sensor(int lane) const {
        return lane_signals(scene_, path_, tile_, lane, scene_.signal_meshes()).sensor;
    }
    double forecast_meshes() const { return marched_meshes(scene_); }

  private:
    Scene scene_;
    signals::PathGrid path_;
    GearboxTile tile_;
};

double relative_rms(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0.0, size = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        size += b[i] * b[i];
    }
    return std::sqrt(difference / size);
}

const std::string kLight =
    "random.operation.torque_N_m={distribution=\"uniform\",low=300,high=2500}";

}  // namespace

TEST_CASE("Superposed gearboxes with real teeth, healthy and cracked, are those of the march") {
    const Tile superposed(study_with("superpose")), marched(study_with("march"));
    CHECK(superposed->superposed == 16);  // their baselines too
    CHECK(superposed->marched_instead == 0);
    CHECK(marched->superposed + marched->marched_instead == 0);
    CHECK(2 * superposed->meshes < marched->meshes);
    // Of a record with the fault: baselines march less.
    CHECK(superposed.forecast_meshes() < marched.forecast_meshes());
    CHECK(superposed->meshes < 2.0 * superposed.forecast_meshes());
    for (int lane = 0; lane < 8; ++lane) {
        INFO("lane " << lane);
        CHECK(superposed->status[static_cast<std::size_t>(lane)] == Status::ok);
        CHECK(relative_rms(superposed.sensor(lane), marched.sensor(lane)) < 1e-8);
    }
    const Results few = test::run(study_with("superpose")), all = test::run(study_with("march"));
    for (std::size_t f = 0; f < few.features.size(); ++f) {
        INFO(few.features[f].name);
        for (std::size_t row = 0; row < few.status.size(); ++row) {
            CHECK(few.features[f].values[row] == Approx(all.features[f].values[row]).epsilon(1e-6));
        }
    }
}

TEST_CASE("Gearboxes whose tooth pairs lose contact are marched whole, to the bit") {
    const Tile superposed(study_with("superpose", {kLight})),
        marched(study_with("march", {kLight}));
    CHECK(superposed->superposed > 0);
    CHECK(superposed->marched_instead > 0);
    int same = 0;
    for (int lane = 0; lane < 8; ++lane) {
        INFO("lane " << lane);
        const auto a = superposed.sensor(lane), b = marched.sensor(lane);
        same += a == b ? 1 : 0;
        CHECK(relative_rms(a, b) < 1e-8);
    }
    CHECK(same > 0);
    CHECK(same < 8);
}

TEST_CASE("Superposed gearboxes have the same bits for any lanes") {
    const auto bits = [](int lanes) {
        return test::feature_bits(
            study_with("superpose", {kLight, "numerics.lanes=" + std::to_string(lanes)}));
    };
    const auto eight = bits(8);
    CHECK(bits(4) == eight);
    CHECK(bits(1) == eight);
}

// A fault of any size from the states of the superposed march without one.
TEST_CASE("Lives' marches start from superposed states as from marched ones") {
    const auto cracked = [](const std::string& horizon) {
        const Study study = study_with(horizon);
        const Scene scene(study);
        const signals::PathGrid path = path_grid(scene);
        const std::vector<GearboxId> ids{{Group::graded, 1}};
        const HealthyMarch march(scene, path, ids, {Sampler(study).sample(ids[0])}, 1);
        return march.with_fault(2e-3).lane[0].sensor;
    };
    CHECK(relative_rms(cracked("superpose"), cracked("march")) < 1e-7);
}
