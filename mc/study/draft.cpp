#include "mc/study/draft.hpp"

namespace gearpod::mc {

Position StudyDraft::position(const std::string& path) const {
    if (const auto found = given.find(path); found != given.end()) {
        return found->second;
    }
    if (const auto found = given_random.find(path); found != given_random.end()) {
        return found->second;
    }
    for (std::size_t end = path.size(); end != std::string::npos && end > 0;
         end = path.rfind('.', end - 1)) {
        if (const auto found = sections.find(path.substr(0, end)); found != sections.end()) {
            return found->second;
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
