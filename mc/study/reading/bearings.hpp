// Reads faulty bearings as a study file lists them: [{ fault = "outer", shaft = "sun", elements =
// 9, diameter_ratio = 0.2, amplitude_m_s2 = 3, resonance_Hz = 2500 }].
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mc/study/reading/list_element.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Names in a table of the list.
std::vector<std::string_view> bearing_fields();
// Problems name the bearing by its position in the list.
std::vector<Bearing> read_bearings(const Value& list, const RejectElement& reject);

// Table with all values, which reads back to the same bearing.
std::string bearing_table(const Bearing& bearing);

}  // namespace gearpod::mc
