// A study while it is being read: what was given where, and what went wrong.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "mc/input/document.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct StudyDraft {
    Study study;
    Problems problems;
    std::map<std::string, Position> given;         // by key path, in its section
    std::map<std::string, Position> given_random;  // by key path, in [random]
    std::vector<std::string> random_files = {};    // whose columns are drawn, in their order
    std::set<std::string> bad;                     // keys and sections whose value is not usable
    std::map<std::string, Position> sections;

    bool is_given(const std::string& path) const {
        return given.contains(path) || given_random.contains(path);
    }
    // Neither missing nor bad: safe to use in further checks.
    bool usable(const std::string& path) const { return !bad.contains(path); }
    // All of these keys, and their sections.
    bool all_usable(const std::vector<std::string>& paths) const;
    // Where a key was written (its section if it was not, else the file), to report a problem with
    // it.
    Position position(const std::string& path) const;
    // Appends a problem with a key and marks it bad.
    void reject(const Position& at, const std::string& path, std::string what, std::string remedy);
    // The same where the key was written.
    void reject(const std::string& path, std::string what, std::string remedy);
};

}  // namespace gearpod::mc
