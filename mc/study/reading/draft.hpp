// A study while it is being read: what was given where, and what went wrong.
#pragma once

#include <map>
#include <set>
#include <string>

#include "mc/input/document.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {

struct StudyDraft {
    Study study;
    Problems problems;
    std::map<std::string, Position> given;         // by key path, in its section
    std::map<std::string, Position> given_random;  // by key path, in [random]
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

// mc/study/reading/values.cpp: one value of a section into the study, type and range checked.
void read_value(StudyDraft& draft, const Key& key, const Entry& entry);

// mc/study/reading/random_inputs.cpp: the section [random].
void read_random(StudyDraft& draft, const Value& section);

// mc/study/reading/presence_checks.cpp: what is missing, or given where it has no place.
void check_presence(StudyDraft& draft);

// mc/study/reading/gear_checks.cpp: the gears among themselves.
void check_gears(StudyDraft& draft);

// mc/study/reading/checks.cpp: what else no key can know alone.
void check_consistency(StudyDraft& draft);

// mc/study/reading/fluctuation_checks.cpp: what drives the gearbox unevenly, and whether its meshes
// repeat.
void check_fluctuations(StudyDraft& draft);

// mc/study/reading/fault_checks.cpp: the fault against the tooth that carries it, and the size
// groups.
void check_fault(StudyDraft& draft);

// mc/study/reading/until_checks.cpp: whether the study has the rate that ensemble.until speaks of.
void check_until(StudyDraft& draft);

// mc/study/reading/reader.cpp: rejects an unknown key of a section, "random." + section in
// [random]. The key that was probably meant counts as bad, not as missing.
void reject_unknown_key(StudyDraft& draft, const std::string& prefix, const std::string& section,
                        const Entry& entry);

}  // namespace gearpod::mc
