// Reads interfering tones as a study file lists them: [{ frequency_Hz = 50, amplitude_m_s2 = 0.1 },
// { shaft = "sun", order = 2, amplitude_m_s2 = 0.1 }].
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mc/study/reading/list_element.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Names in a table of the list.
std::vector<std::string_view> tone_fields();
// Problems name the tone by its position in the list.
std::vector<Tone> read_tones(const Value& list, const RejectElement& reject);

// Table with all values, which reads back to the same tone.
std::string tone_table(const Tone& tone);

}  // namespace gearpod::mc
