// Reads shipped studies for tests.
#pragma once

#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/realization_features.hpp"
#include "mc/plan/scene.hpp"
#include "tests/mc/gearbox_bits.hpp"
#include "tests/numbers.hpp"
#include "tests/shipped_studies.hpp"

namespace gearpod::test {

inline mc::Study valid_study(const mc::StudyReading& reading) {
    INFO(mc::format(reading.problems));
    REQUIRE(reading.study.has_value());
    return *reading.study;
}

inline mc::Study shipped_study(const std::string& name,
                               const std::vector<std::string>& overrides = {}) {
    return valid_study(mc::read_study(study_path(name), overrides));
}

inline mc::Study study_of_text(const std::string& text,
                               const std::vector<std::string>& overrides = {}) {
    return valid_study(mc::read_study_text(text, "study.toml", overrides));
}

// Whether one of the problems is of this key and has these words.
inline bool has_problem(const mc::Problems& problems, const std::string& key,
                        const std::string& words) {
    return std::ranges::any_of(problems, [&](const mc::Problem& problem) {
        return problem.key == key && contains(problem.what, words);
    });
}

// Checks that the resolved text of a study is read as the same study.
inline void check_reads_back(const mc::Study& study) {
    CHECK(study_of_text(resolved_text(study)) == study);
}

// Checks that the scene of a study is refused for a key, with words in the message or the remedy.
// Returns the message.
inline std::string check_scene_refused(const std::function<void()>& make, const std::string& key,
                                       const std::vector<std::string>& words = {}) {
    try {
        make();
    } catch (const mc::SceneError& error) {
        INFO(error.what() << "; " << error.remedy());
        CHECK(error.key() == key);
        for (const std::string& text : words) {
            INFO(text);
            CHECK(contains(std::string(error.what()) + "; " + error.remedy(), text));
        }
        return error.what();
    }
    FAIL_CHECK("not refused");
    return "";
}
inline std::string check_scene_refused(const mc::Study& study, const std::string& key,
                                       const std::vector<std::string>& words = {}) {
    return check_scene_refused([&] { const mc::Scene scene(study); }, key, words);
}

inline mc::Results run(const mc::Study& study) {
    const mc::Scene scene(study);
    mc::Progress progress(1, true);
    return mc::run_ensemble(scene.tile(), scene.ensemble(), progress);
}

inline Bits feature_bits(const mc::Study& study) {
    Bits all;
    for (const auto& feature : run(study).features) {
        std::ranges::copy(bits_of(feature.values), std::back_inserter(all));
    }
    return all;
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
