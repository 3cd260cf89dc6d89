// A small campaign of lives of gearboxes with identical teeth.
#pragma once

#include "tests/mc/study_file.hpp"

namespace gearpod::test {

inline const std::vector<std::string> kLife{
    "life.interval_h=5",
    "life.first_depth_mm=1",
    "life.last_depth_mm=4",
    "life.depth_steps=4",
    "life.paris_factor=1.36e-7",
    "life.paris_exponent=2.25",
    "life.records=40",
    "life.healthy_lives=4",
    "monitoring.baseline_records=6",
    "sensor.noise_levels=[1]",
    "features.use=[\"te_rms\",\"sensor_rms\",\"window_ratio\"]",
    "ensemble.instances=3",
    "ensemble.threshold_instances=4"};

// The same as options of the program.
inline std::string life_arguments() {
    return set_options(kLife);
}

inline mc::Study life_study(const std::vector<std::string>& more = {}) {
    return shipped_study("planet-crack-ideal.toml", joined(kLife, more));
}

}  // namespace gearpod::test
