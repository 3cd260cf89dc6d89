// Simulated gearboxes of Liang's study with a crack of 3 mm, and their features.
#pragma once

#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test {

inline mc::Study ideal_crack_study(std::vector<std::string> overrides) {
    overrides.insert(overrides.end(), {"random.fault.depth_mm={distribution=\"constant\",value=3}",
                                       "numerics.steps_per_mesh=9600"});
    return shipped_study("planet-crack-ideal.toml", overrides);
}

class Computed {
  public:
    explicit Computed(const mc::Study& study,
                      const std::vector<mc::GearboxId>& ids = {{mc::Group::test, 4}})
        : scene_(study),
          levels_(study.sensor.noise_levels.size()),
          tile_(run_gearboxes(scene_.tile(), ids, ids.size() == 1 ? 1 : 8)) {
        mc::RealizationFeatures features(scene_.tile(), &healthy_);
        for (std::size_t lane = 0; lane < ids.size(); ++lane) {
            REQUIRE(tile_.status[lane] == mc::Status::ok);
            values_.push_back(
                features.compute(signals(static_cast<int>(lane)), tile_.realizations[lane]));
        }
    }
    double value(std::size_t feature, std::size_t level = 0) const {
        return values_[0][feature * levels_ + level];
    }
    const std::vector<std::vector<double>>& values() const { return values_; }
    const mc::Scene& scene() const { return scene_; }
    mc::LaneSignals signals(int lane = 0) const {
        return lane_signals(scene_.tile(), tile_, LaneId{lane}, scene_.record().signal_meshes);
    }
    int meshes() const { return tile_.meshes; }
    double noise_m_s2() const { return tile_.realizations[0].inputs.noise_m_s2; }
    mc::RecordWindow window() const {
        const mc::Realization& one = tile_.realizations[0];
        return record_window(scene_.record(), one.id, scene_.record().turns(one.inputs));
    }

  private:
    mc::Scene scene_;
    std::size_t levels_;
    mc::GearboxTile tile_;
    mc::HealthyReference healthy_;
    std::vector<std::vector<double>> values_;
};

inline double rms(std::span<const double> values) {
    return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
                     static_cast<double>(values.size()));
}

}  // namespace gearpod::test
