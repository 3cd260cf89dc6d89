// Studies of a stage next to the small gearbox.
#pragma once

#include "tests/mc/ensemble/gearbox/small_runs.hpp"
#include "tests/mc/study_file.hpp"

namespace gearpod::test {

// Sun speed of the stage's study, rpm: its sun is on the carrier's shaft of the small gearbox.
inline constexpr double kSunRpm = 60.0;

// The small gearbox with its sun on the carrier's shaft, and a fault of the stage.
inline std::string stage_file(const Folder& folder, const std::string& name,
                              double sun_rpm = kSunRpm) {
    std::string text = bytes_of(kSmall);
    const auto replace = [&](const std::string& old, const std::string& by) {
        const std::size_t at = text.find(old);
        REQUIRE(at != std::string::npos);
        text.replace(at, old.size(), by);
    };
    replace("carrier_speed_rpm = 60", "carrier_speed_rpm = " + std::to_string(sun_rpm * 13 / 48));
    replace("reduction = 0", "reduction = 0.4");
    const std::string path = folder.file(name);
    std::ofstream(path) << text;
    return path;
}

// Setting of the stage of that file, and the same as an option.
inline std::string stage_setting(const std::string& path, const std::string& more) {
    return "sensor.stages=[{name=\"slow\", study=\"" + path +
           "\", shaft=\"carrier\", stage_shaft=\"sun\"" + more + "}]";
}
inline std::string stages(const std::string& path, const std::string& more) {
    return "--set '" + stage_setting(path, more) + "' ";
}

// Study of the small gearbox next to that stage.
inline mc::Study small_study(const std::string& path, const std::string& more,
                             std::vector<std::string> settings = {}) {
    settings.push_back(stage_setting(path, more));
    return valid_study(mc::read_study(kSmall, settings));
}

// Replaces a text in a file.
inline void replace_in(const std::string& path, const std::string& old, const std::string& by) {
    std::string text = bytes_of(path);
    text.replace(text.find(old), old.size(), by);
    std::ofstream(path) << text;
}

}  // namespace gearpod::test
