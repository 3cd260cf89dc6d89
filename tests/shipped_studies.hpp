// Names of the shipped studies below studies/, and lists of overrides.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace gearpod::test {

inline std::string study_path(const std::string& name) {
    return std::string(GEARPOD_SOURCE_DIR) + "/studies/" + name;
}

// Sorted names such as "planet-crack.toml" and "published/yang-fig-15.toml".
inline std::vector<std::string> shipped_studies() {
    const std::filesystem::path folder = study_path("");
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".toml") {
            names.push_back(entry.path().lexically_relative(folder).generic_string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

// Both lists; of two overrides of one key the later one takes precedence.
inline std::vector<std::string> joined(std::vector<std::string> first,
                                       const std::vector<std::string>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

// The overrides as options of the program.
inline std::string set_options(const std::vector<std::string>& overrides) {
    std::string text;
    for (const std::string& one : overrides) {
        text += " --set '" + one + "'";
    }
    return text;
}

}  // namespace gearpod::test
