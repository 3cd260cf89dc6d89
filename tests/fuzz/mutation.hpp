// Mutated study files.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gearpod::test {

// One to four mutations of one of `studies`, deterministic for a given number. Lines are dropped,
// doubled or moved to another section. Keys are misspelt. Values are replaced by others of the
// file, by extreme numbers or by other types. Lists of thousands, nested dots and brackets are
// inserted. Bytes are flipped, cut off or inserted.
std::string mutated(const std::vector<std::string>& studies, std::uint64_t number);

}  // namespace gearpod::test
