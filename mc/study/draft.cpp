#include "mc/study/draft.hpp"

#include <algorithm>

namespace gearpod::mc {

Position StudyDraft::position(const std::string& path) const {
    if (const auto found = given.find(path); found != given.end()) {
        return found->second;
    }
    if (const auto found = given_random.find(path); found != given_random.end()) {
        return found->second;
    }
    for (std::string table = path; !table.empty();
         table.resize(std::min(table.rfind('.'), table.size()))) {
        if (const auto found = sections.find(table); found != sections.end()) {
            return found->second;
        }
        if (table.find('.') == std::string::npos) {
            break;
        }
    }
    return sections.at("");
}

void StudyDraft::reject(const Position& at, const std::string& path, std::string what,
                        std::string remedy) {
    problems.push_back({at.file, at.line, path, std::move(what), std::move(remedy)});
    bad.insert(path);
    if (path.starts_with("random.")) {
        bad.insert(path.substr(7));
    }
}

void StudyDraft::reject(const std::string& path, std::string what, std::string remedy) {
    reject(position(path), path, std::move(what), std::move(remedy));
}

bool StudyDraft::all_usable(const std::vector<std::string>& paths) const {
    return std::all_of(paths.begin(), paths.end(), [&](const std::string& path) {
        return usable(path) && usable(path.substr(0, path.find('.')));
    });
}

}  // namespace gearpod::mc
