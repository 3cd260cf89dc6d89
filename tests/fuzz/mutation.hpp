// Study files that somebody or something has garbled.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gearpod::test {

// One to four mutations of one of `studies`, the same for the same number: lines that are dropped,
// doubled, moved to another section; keys misspelt; values exchanged for others of the file, for
// numbers at the edge of what is possible, for other types; lists of thousands, dots and brackets
// nested; bytes flipped, cut off or put in.
std::string mutated(const std::vector<std::string>& studies, std::uint64_t number);

}  // namespace gearpod::test
