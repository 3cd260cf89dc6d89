// Reads interfering tones as a study file lists them: [{ frequency_Hz = 50, amplitude_m_s2 = 0.1 },
// { shaft = "sun", order = 2, amplitude_m_s2 = 0.1 }].
#pragma once

#include <string>
#include <vector>

#include "mc/study/elements/list_element.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

inline constexpr TableField kToneFields[] = {{"frequency_Hz"},
                                             {.name = "amplitude_m_s2", .required = true},
                                             {"shaft", TableField::Kind::text, false, kShafts},
                                             {"order"}};
// Problems name the tone by its position in the list.
std::vector<Tone> read_tones(const Value& list, const RejectElement& reject);

// Table with all values, which reads back to the same tone.
std::string tone_table(const Tone& tone);

}  // namespace gearpod::mc
