// Functions for tests of the problems of studies.
#pragma once

#include "mc/study/study.hpp"
#include "tests/test.hpp"

namespace gearpod::tests {

// Line number of `marker`, 1 for the first line; 0 if the text does not contain it.
inline int line_of(const std::string& text, const std::string& marker) {
    const std::size_t at = text.find(marker);
    return at == std::string::npos
               ? 0
               : 1 + static_cast<int>(std::count(
                         text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// True if the problem or its remedy contains these words.
inline bool mentions(const mc::Problem& problem, const std::string& words) {
    return (problem.what + "; " + problem.remedy).find(words) != std::string::npos;
}

// The study with settings ("section.key = value", one per line) replaced or added to their section.
// A setting without a value removes its key.
inline std::string with_settings(const std::string& study, const std::string& settings) {
    std::string text = "\n" + study;
    std::istringstream stream(settings);
    for (std::string setting; std::getline(stream, setting);) {
        const std::size_t dot = setting.find('.');
        const bool in_section = dot < setting.find(" =");
        const std::string header = in_section ? "[" + setting.substr(0, dot) + "]\n" : "\n";
        const std::string line = setting.substr(in_section ? dot + 1 : 0);
        const std::string key = line.substr(0, line.find(" =") + 2);
        if (text.find(header) == std::string::npos) {
            text += header;
        }
        const std::size_t begin = text.find(header) + header.size();
        const std::size_t end = text.find("\n[", begin), at = text.find("\n" + key, begin - 1);
        if (at < end) {
            text.erase(at + 1, text.find('\n', at + 1) - at);
        }
        if (key != line) {
            text.insert(at < end ? at + 1 : begin, line + "\n");
        }
    }
    return text.substr(1);
}

// Line of a section ("section"), of a key ("section.key") or of the first key of a table
// ("section.table"); 0 if the study does not have it.
inline int line_of_key(const std::string& study, const std::string& path) {
    std::istringstream stream(study);
    std::string line, section;
    for (int number = 1; std::getline(stream, line); ++number) {
        section = line.starts_with("[") ? line.substr(1, line.find(']') - 1) : section;
        const std::string key = line.substr(0, line.find(" ="));
        const std::string name = line.starts_with("[") ? section
                                 : section.empty()     ? key
                                                       : section + "." + key;
        if (name == path || name.starts_with(path + ".")) {
            return number;
        }
    }
    return 0;
}

// Settings that make a valid study invalid.
struct BadSettings {
    const char* settings;
    const char* words;     // in the problem or in the remedy
    const char* key = "";  // of the problem, if it is not that of the last setting
};

// Checks that the settings cause one problem, on the line of its key. The problem of a key that is
// not in the file has the line of the last setting or, if that removes a key, of its table or
// section.
inline void check_refused(const std::string& study, const BadSettings& bad) {
    const std::string text = with_settings(study, bad.settings);
    const auto reading = mc::read_study_text(text, "bad.toml");
    INFO(bad.settings << "\n" << mc::format(reading.problems));
    CHECK_FALSE(reading.study.has_value());
    REQUIRE(reading.problems.size() == 1);
    const std::string settings = bad.settings, last = settings.substr(settings.rfind('\n') + 1);
    const std::string setting = last.substr(0, last.find(" ="));
    const std::string key = *bad.key == 0 ? setting : bad.key;
    int line = 0;
    for (const std::string& path : {key, setting, key.substr(0, key.rfind('.'))}) {
        line = line == 0 ? line_of_key(text, path) : line;
    }
    CHECK(reading.problems[0].file == "bad.toml");
    CHECK(reading.problems[0].key == key);
    CHECK(reading.problems[0].line == line);
    CHECK(mentions(reading.problems[0], bad.words));
}

}  // namespace gearpod::tests
