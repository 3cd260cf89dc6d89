// The parts of reading a study, in turn; each adds what it finds wrong to the draft.
#pragma once

#include <string>
#include <vector>

#include "mc/study/draft.hpp"
#include "mc/study/keys/key.hpp"

namespace gearpod::mc {

// values.cpp: one value of a section into the study, type and range checked.
void read_value(StudyDraft& draft, const Key& key, const Entry& entry);

// random_inputs.cpp: the section [random].
void read_random(StudyDraft& draft, const Value& section);

// correlations.cpp: `correlations` of that section, after its inputs.
void read_correlations(StudyDraft& draft, const Entry& list);

// presence_checks.cpp: what is missing, or given where it has no place.
void check_presence(StudyDraft& draft);

// gear_checks.cpp: the gears among themselves.
void check_gears(StudyDraft& draft);
// Toothed members of this kind of gearbox, each once; the key of a member's tooth number; true if
// all of these keys can be used.
std::vector<Member> toothed_members(const Study& study);
std::string teeth_key(Member member);
bool teeth_usable(const StudyDraft& draft);

// tooth_error_checks.cpp: planets that differ, tooth deviations, transmission errors.
void check_tooth_errors(StudyDraft& draft);

// checks.cpp: what else no key can know alone.
void check_consistency(StudyDraft& draft);

// fluctuation_checks.cpp: what drives the gearbox unevenly, and whether its meshes repeat.
void check_fluctuations(StudyDraft& draft);

// fault_checks.cpp: the fault against the tooth that carries it, and the size groups.
void check_fault(StudyDraft& draft);

// life_checks.cpp: what grows, between which depths, over how many records.
void check_life(StudyDraft& draft);

// record_checks.cpp: what is drawn for every record.
void check_records(StudyDraft& draft);

// until_checks.cpp: whether the study has the rate that ensemble.until speaks of.
void check_until(StudyDraft& draft);

}  // namespace gearpod::mc
