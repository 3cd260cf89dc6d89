// Study while it is being read: the keys given, their positions, and the problems found.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

struct StudyDraft {
    Study study;
    bool runs_python = false;  // true if Python files are run to find their features
    Problems problems;
    Problems notices = {};                         // accepted, but written as in an earlier version
    std::map<std::string, Position> given;         // by key path, in its section
    std::map<std::string, Position> given_random;  // by key path, in [random]
    std::vector<std::string> random_files = {};    // CSV files of random inputs, in their order
    std::set<std::string> bad;                     // keys and sections without a usable value
    std::map<std::string, Position> sections;

    bool is_given(const std::string& path) const {
        return given.contains(path) || given_random.contains(path);
    }
    // True if the key is neither missing nor bad, so that further checks may use it.
    bool usable(const std::string& path) const { return !bad.contains(path); }
    // True if all of these keys and their sections are usable.
    bool all_usable(const std::vector<std::string>& paths) const;
    // Position of a key in the file, for messages: that of its section if the key was not given,
    // else that of the file.
    Position position(const std::string& path) const;
    // Appends a problem with a key and marks the key as bad.
    void reject(const Position& at, const std::string& path, std::string what, std::string remedy);
    // The same at the key's own position.
    void reject(const std::string& path, std::string what, std::string remedy);
};

}  // namespace gearpod::mc
