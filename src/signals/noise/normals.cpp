#include "signals/noise/normals.hpp"

#include <stdexcept>

namespace gearpod::signals {

void normals_from_words(std::span<const std::uint64_t> words, std::span<double> normals) {
    if (words.size() != normals.size() || words.size() % kNormalBlock != 0) {
        throw std::invalid_argument("normals: as many words as values, in whole blocks");
    }
    normal_blocks(static_cast<long>(words.size() / kNormalBlock), words.data(), normals.data());
}

}  // namespace gearpod::signals
