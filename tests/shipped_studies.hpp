// Names of the shipped studies below studies/.
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

}  // namespace gearpod::test
