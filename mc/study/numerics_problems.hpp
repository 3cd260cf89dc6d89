// Checks of the numerics of a study that was not read from a file.
#pragma once

#include <span>
#include <string_view>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Problems of the study's numerics that reading would report if the keys of [numerics] named in
// `keys` were given with their present values.
Problems numerics_problems(const Study& study, std::span<const std::string_view> keys);

}  // namespace gearpod::mc
