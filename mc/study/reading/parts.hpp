// Steps of reading a study, in order. Each one adds the problems it finds to the draft.
#pragma once

#include <string>
#include <vector>

#include "features/feature.hpp"
#include "mc/study/draft.hpp"
#include "mc/study/elements/list_element.hpp"
#include "mc/study/keys/key.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// values.cpp: stores one value of a section in the study after checking its type and range.
void read_value(StudyDraft& draft, const Key& key, const Entry& entry);
// values.cpp: rejects a number outside the key's range. True if it lies inside.
bool check_range(StudyDraft& draft, const Position& at, const Key& key, double number);

// random_inputs.cpp: reads the section [random].
void read_random(StudyDraft& draft, const Value& section);

// random_inputs.cpp: reads `correlations` of that section, after its inputs.
void read_correlations(StudyDraft& draft, const Entry& list);

// key_checks.cpp: rejects missing required keys and forbidden keys.
void check_presence(StudyDraft& draft);
void check_presence(StudyDraft& draft, const Key& key);  // the same for one key

// gear_checks.cpp: checks the gears and how they fit together.
void check_gears(StudyDraft& draft);
// toothed_members(): toothed members of the study's kind of gearbox, each once. teeth_key(): key of
// a member's number of teeth. teeth_usable(): true if all of these keys are usable.
std::vector<Member> toothed_members(const Study& study);
std::string teeth_key(Member member);
bool teeth_usable(const StudyDraft& draft);

// gear_checks.cpp: checks planets that differ, tooth deviations and transmission errors.
void check_tooth_errors(StudyDraft& draft);

// sensor_checks.cpp: checks the sensors, their noise and the housing.
void check_sampling(StudyDraft& draft);

// consistency_checks.cpp: remaining checks that involve several keys.
void check_consistency(StudyDraft& draft);

// numerics_checks.cpp: checks the numerics, after the excitation.
void check_numerics(StudyDraft& draft);

// fault_checks.cpp: checks the fault against the tooth that carries it, and the size groups.
// The first one comes before check_presence(), which otherwise asks for the keys of a wrong member.
void check_faulty_member(StudyDraft& draft);
void check_fault(StudyDraft& draft);

// fault_checks.cpp: checks the crack of a life, its depths and the number of records.
void check_life(StudyDraft& draft);

// random_inputs.cpp: checks the distributions of values that vary from record to record.
void check_records(StudyDraft& draft);

// Rejects an unknown key of a section; `prefix` is "random." in [random]. The key that was probably
// meant is marked as bad, so that it is not reported as missing.
void reject_unknown_key(StudyDraft& draft, const std::string& prefix, const std::string& section,
                        const Entry& entry);

// Features of a list of files, or of tables that resolved_text() writes. A file is run to find its
// features, and its path is relative to the folder of the study. A table is taken as it is, so that
// results can be read without the file.
// Files are refused unless `runs` is true.
std::vector<PythonFeature> read_python_features(const Value& list, bool runs,
                                                const RejectElement& reject);

// Parameters of the function, "record, baselines".
std::string_view uses_text(const features::Feature& feature);

}  // namespace gearpod::mc
