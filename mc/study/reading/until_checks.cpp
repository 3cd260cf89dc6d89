#include <fmt/format.h>

#include <algorithm>

#include "analysis/detection/size_groups.hpp"
#include "features/feature.hpp"
#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

template <class List, class Item>
bool holds(const List& list, const Item& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

void reject(StudyDraft& draft, const std::string& key, std::string what, std::string remedy) {
    const std::string path = "ensemble.until." + key;
    draft.reject(draft.position(path), path, std::move(what), std::move(remedy));
}

}  // namespace

// Runs only on a study without other problems, whose sizes and features are valid.
void check_until(StudyDraft& draft) {
    const Study& study = draft.study;
    const Until& until = study.ensemble.until;
    if (!draft.problems.empty() || !until.half_width) {
        return;
    }
    const auto name = features::all_features()[static_cast<std::size_t>(*until.feature)].name;
    if (!holds(study.features.use, name)) {
        reject(draft, "feature", fmt::format("\"{}\" is not among features.use", name),
               "add it there");
    }
    if (!holds(study.sensor.noise_levels, until.noise_level)) {
        reject(draft, "noise_level",
               fmt::format("{:g} is not among sensor.noise_levels", until.noise_level),
               "name one of them");
    }
    const auto groups = size_groups(study);
    if (!analysis::group_of(size_in_si(study, *until.size), groups)) {
        std::string sizes;
        for (const analysis::SizeGroup& group : groups) {
            sizes += (sizes.empty() ? "" : ", ") + size_text(study, group);
        }
        reject(draft, "size", fmt::format("{:g} is not a fault size of this study", *until.size),
               "its sizes are " + sizes);
    }
}

}  // namespace gearpod::mc
