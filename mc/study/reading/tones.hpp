// Reads interfering tones as a study file lists them: [{ frequency_Hz = 50, amplitude_m_s2 = 0.1 },
// ...].
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mc/input/document.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Called with a problem, which names the tone by its position in the list, and a remedy.
using RejectTone = std::function<void(std::string what, std::string remedy)>;

std::vector<Tone> read_tones(const Value& list, const RejectTone& reject);

}  // namespace gearpod::mc
