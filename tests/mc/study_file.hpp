// Shipped studies as tests use them.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "mc/ensemble/ensemble.hpp"
#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/instance_features.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::test {

inline std::string study_path(const std::string& name) {
    return std::string(GEARPOD_SOURCE_DIR) + "/studies/" + name;
}

inline mc::Study shipped_study(const std::string& name,
                               const std::vector<std::string>& overrides = {}) {
    const mc::StudyReading reading = mc::read_study(study_path(name), overrides);
    INFO(mc::format(reading.problems));
    REQUIRE(reading.study.has_value());
    return *reading.study;
}

inline mc::Results run(const mc::Study& study) {
    const mc::Scene scene(study);
    mc::Progress progress(1, true);
    return mc::run_ensemble(scene, progress);
}

inline std::size_t feature_index(const mc::Results& results, const std::string& name) {
    for (std::size_t f = 0; f < results.features.size(); ++f) {
        if (results.features[f].name == name) {
            return f;
        }
    }
    FAIL("no feature " << name);
    return 0;
}

}  // namespace gearpod::test
