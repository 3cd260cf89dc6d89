// Functions for tests of the problems of studies.
#pragma once

#include "mc/files/input/problems.hpp"
#include "tests/test.hpp"

namespace gearpod::tests {

// Line number of `marker`, 1 for the first line; 0 if the text does not contain it.
inline int line_of(const std::string& text, const std::string& marker) {
    const std::size_t at = text.find(marker);
    return at == std::string::npos
               ? 0
               : 1 + static_cast<int>(std::count(
                         text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// True if the problem or its remedy contains these words.
inline bool mentions(const mc::Problem& problem, const std::string& words) {
    return (problem.what + "; " + problem.remedy).find(words) != std::string::npos;
}

}  // namespace gearpod::tests
