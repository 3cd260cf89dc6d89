#include "mc/study/study.hpp"

#include <algorithm>

#include "features/feature.hpp"
#include "mc/files/input/find_in.hpp"

namespace gearpod::mc {

const RandomInput* Study::find_random(const std::string& key) const {
    return find_in(random, key, &RandomInput::key);
}

double crack_begin_m(const Life& life) {
    return life.curve_depth_m.empty() ? life.first_depth_m.value() : life.curve_depth_m.front();
}

const features::Feature* find_feature(const Study& study, std::string_view name) {
    for (const PythonFeature& one : study.features.python) {
        if (one.feature->name == name) {
            return one.feature;
        }
    }
    const features::Feature* known = features::find_feature(name);
    return known != nullptr && known->external ? nullptr : known;
}

bool compares_records(const Study& study) {
    return std::ranges::any_of(study.features.use, [&](const std::string& name) {
        const features::Feature* feature = find_feature(study, name);
        return feature != nullptr && feature->baseline_use != features::BaselineUse::nothing;
    });
}

bool redraws(const Study& study, std::string_view property) {
    const std::vector<std::string>& named = study.features.baseline_redraws;
    return std::ranges::find(named, property) != named.end();
}

}  // namespace gearpod::mc
